"""The cases of `campaigns.stability` as tables; every case starts from the scene `tethered_buoy`.

`line`: stiffness, tension law, grid, mass; `water`: water, waves, seas; `motion`: starts, snaps, compression, steps;
`inputs`: values that no scene should have. `campaigns.stability.run` runs any of them.
"""

from campaigns.stability.cases import inputs, line, motion, water
from campaigns.stability.cases.case import Case


def all_cases() -> list[Case]:
    """Every case, in the order of the report."""
    return [*line.CASES, *water.CASES, *motion.CASES, *inputs.CASES]
