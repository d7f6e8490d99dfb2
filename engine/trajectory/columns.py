"""Columns and statistics of a trajectory, and how they follow from the samples and the STATE of the kernels."""

from collections.abc import Mapping

import numpy as np

from .. import record as col
from ..scene.models import Scene

Columns = Mapping[str, np.ndarray]  # of a trajectory: a name of COLUMNS -> (n,) array, evenly sampled

COLUMNS = {  # name -> (unit, long name), in the order of the table
    "time_s": ("s", "time"),
    "x_m": ("m", "position of the upper end along x, from the anchor"),
    "y_m": ("m", "position of the upper end along y, from the anchor"),
    "z_m": ("m", "height of the upper end above the anchor"),
    "radius_m": ("m", "distance of the upper end from the anchor"),
    "radius_rate_mps": ("m s-1", "rate of the distance of the upper end from the anchor"),
    "angle_rad": ("rad", "angle of the upper end from the vertical, positive where the waves go, unwrapped"),
    "angle_rate_radps": ("rad s-1", "rate of the angle of the upper end from the vertical"),
    "offplane_m": ("m", "largest distance of any node from the plane of the waves"),
    "tension_top_N": ("N", "tension at the upper end"),
    "tension_min_N": ("N", "least tension along the tether"),
    "tension_top_low_N": ("N", "least tension at the upper end over all steps since the previous sample"),
    "tension_top_high_N": ("N", "largest tension at the upper end over all steps since the previous sample"),
    "loop_releases": ("1", "loops of slack tether released since t = 0"),
    "line_lowest_m": ("m", "height of the lowest node of the tether above the anchor"),
    "unresolved_N": ("N", "axial ringing that steps and grid did not resolve since the previous sample"),
    "tension_anchor_N": ("N", "tension at the lower end"),
    "tension_max_N": ("N", "largest tension along the tether"),
    "tension_max_s_m": ("m", "unstretched arc length, from the lower end, at which the tension is largest"),
    "tension_anchor_high_N": ("N", "largest tension at the lower end over all steps since the previous sample"),
}
MEASURED = (  # columns of a sample that are columns of the table as they are, in its order
    col.OFFPLANE, col.TOP, col.LEAST, col.TOP_LOW, col.TOP_HIGH, col.RELEASES, col.LOWEST, col.MISSED,
    col.FOOT, col.MOST, col.MOST_AT, col.FOOT_HIGH,
)  # fmt: skip

STATISTICS = {  # of a trajectory: the fields of STATE that they come from
    "steps": "steps", "rejected_steps": "rejected", "newton_iterations": "newton", "newton_failures": "failures",
    "loop_releases": "releases", "max_turn_rad": "max_turn", "min_strain": "min_strain", "end_time_s": "t",
}  # fmt: skip
# of runs that follow each other; all other statistics are sums
EXTREMES = {"max_turn_rad": max, "end_time_s": max, "unresolved_ringing_N": max, "min_strain": min}


def statistics_of(state: np.void, wall_s: float) -> dict[str, int | float]:
    """What a run has done by this STATE, and how long (s) that has taken."""
    return {name: state[field].item() for name, field in STATISTICS.items()} | {"wall_s": wall_s}


def sample_count(duration_s: float, step_s: float) -> int:
    """Samples from t = 0 to the end, both included where the rounding of a step is all that is missing; 0 without."""
    return int(duration_s / step_s * (1 + 1e-12) + 1e-9) + 1 if step_s > 0 else 0


def heading_of(scene: Scene) -> float:
    """Direction (rad) of the waves; 0 without waves."""
    return 0.0 if scene.waves is None else float(scene.waves.heading_rad)


def along_waves(heading: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The component along waves that travel in the direction `heading` (rad) of vectors with components x and y."""
    return x if heading == 0 else np.cos(heading) * x + np.sin(heading) * y


def across_waves(heading: float, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The component across such waves, to their left, of vectors with components x and y."""
    return y if heading == 0 else np.cos(heading) * y - np.sin(heading) * x


def largest_along(columns: Columns, length_m: float) -> tuple[np.ndarray, np.ndarray]:
    """Largest tension (N) along a line of this length since the sample before, and how far from the anchor (m) it was.

    Steps of the solver count at both ends, where the waves of a snap are reflected and add up; samples count between.
    """
    largest_N, places_m = columns["tension_max_N"], columns["tension_max_s_m"]
    for name, place_m in (("tension_anchor_high_N", 0.0), ("tension_top_high_N", length_m)):
        larger = columns[name] > largest_N
        largest_N, places_m = np.where(larger, columns[name], largest_N), np.where(larger, place_m, places_m)
    return largest_N, places_m


def columns_of(samples: np.ndarray, scene: Scene) -> Columns:
    """The COLUMNS of a run of the scene, from its samples (n, SAMPLE_WIDTH) with the columns of `engine.record`.

    The angle from the vertical is taken in the plane of the waves, from place and rate in their direction.
    """
    t, x, y, z, u, v, w = samples[:, : col.AT_W + 1].T
    heading = heading_of(scene)
    r = np.sqrt(x**2 + y**2 + z**2) if y.any() else np.hypot(x, z)
    place, rate = along_waves(heading, x, y), along_waves(heading, u, v)
    with np.errstate(invalid="ignore", divide="ignore"):
        radius_rate = (x * u + y * v + z * w) / np.where(r > 0, r, np.nan)
        square = place**2 + z**2
        angle_rate = (z * rate - place * w) / np.where(square > 0, square, np.nan)
    angle = np.unwrap(np.arctan2(place, z))
    values = t, x, y, z, r, radius_rate, angle, angle_rate, *samples[:, MEASURED].T
    return {name: np.array(column) for name, column in zip(COLUMNS, values, strict=True)}
