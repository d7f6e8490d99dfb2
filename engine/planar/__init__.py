"""The planar cable: six unknowns a node (model.md 2.2)."""
