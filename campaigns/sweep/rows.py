"""A run of any scene as one row of numbers: a buoy in regular waves as in the buoy sweep, any other line in general."""

from campaigns.buoy_sweep.rows import COLUMNS, DIMENSIONS, EXTREMES, STEEPNESS, buoy_row, settled, sound_part
from campaigns.columns import MESSAGE, RUN_KEY, STATISTICS, STATUS, counted
from campaigns.judge import in_regular_waves

BUOY = tuple(column for column in COLUMNS if column is not STEEPNESS and not column.name.startswith("planar_"))
LINE = (DIMENSIONS, STATUS, *EXTREMES, *STATISTICS, RUN_KEY, MESSAGE)


def sweep_row(trajectory, transient_periods: int, simulate=None) -> dict[str, object]:
    """The columns of `BUOY` or `LINE` that a trajectory fills; those left out are unknown. Arguments: `buoy_row`.

    The upper end of a line without a buoy has a radius and an angle as the buoy has; without waves nothing is left out.
    """
    scene = trajectory.scene
    if in_regular_waves(scene):
        return buoy_row(trajectory, transient_periods, simulate)
    row, columns, step_s = counted(trajectory), sound_part(trajectory.columns), scene.sample_step_s()
    transient_s = transient_periods * scene.waves.period_s if scene.waves is not None else 0.0
    if len(columns["time_s"]) > 1 and columns["time_s"][-1] > transient_s:
        row |= settled(columns, step_s, transient_s)
    return row
