"""The report on the whole paper: its figures redrawn, its statements judged, and what its answer depends on."""
