"""Lanes: eight runs that share the vectors of `engine.simd` and march together; you need not open this room."""
