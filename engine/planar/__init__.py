"""The planar cable: six unknowns a node (THEORY.md, section 3)."""
