"""Machine code of kernels on disk, for the engine and the analysis alike: by which sources, where, and who may write.

Neither package knows the other; this one knows neither (`machine_code.store`).
"""
