"""Several runs at once, one in each lane of a vector of numbers (docs/developing.md#runs-side-by-side).

A run gives the same numbers alone and among others. To read or change the physics you need not open this folder.
"""
