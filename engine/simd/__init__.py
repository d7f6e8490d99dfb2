"""Batches: several runs at once, one in each lane of a vector of numbers (docs/lanes.md)."""
