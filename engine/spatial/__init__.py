"""The cable in space: thirteen unknowns a node, Euler parameters (THEORY.md, section 3)."""
