"""The parts of the campaign of the whole paper, in the order in which they run."""

PARTS = ("breaking_line", "buoy", "doubled", "sweep", "dependence", "out_of_plane", "oscillator")
