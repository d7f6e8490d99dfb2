"""The cable in space: thirteen unknowns a node, Euler parameters (model.md 2.2, 2.5, 2.6)."""
