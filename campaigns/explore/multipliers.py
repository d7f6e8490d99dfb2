"""The periodic orbit under a run of a buoy in regular waves: its multipliers, with their errors.

A run near a stable orbit shows the orbit, not how fast perturbations die out along each direction, and not that the
orbit is one. Newton's method on the map over a wave period (`engine.run.period_map`) finds it to 1e-9 from the last
state.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

from tables import SHEET, Column

if TYPE_CHECKING:
    import numpy as np

    from analysis.orbits import Orbit
    from engine.trajectory import Trajectory

TOLERANCE = 1e-3  # of the steps of an orbit, or that of the scene where that is smaller; at 0.03 multipliers are false
QUICK = 3e-3  # the same for the rows of a sweep
COUNT = 4  # multipliers
LONG = 40  # wave periods of a run on an orbit, or eight of its periods
MULTIPLIERS = (
    Column(
        "multiplier_modulus", "", "|μ|",
        "modulus of the leading multiplier of the periodic orbit: what a period of it makes of a perturbation", 3,
    ),
    Column(
        "multiplier_angle_rad", "rad", "arg μ",
        "angle of the leading multiplier in the complex plane, 0 to π", 3, SHEET,
    ),
    Column("multiplier_error", "", "± |μ|", "largest change of the multiplier over steps of the same tolerance", 3),
)  # fmt: skip


def cable_map(scene_of: Callable, state, value: float, size: float = 1.0):
    """The PeriodMap of a state, and the OrbitMap of it. size: the change of the parameter that counts as 1.

    Raises ValueError and ArithmeticError as `engine.run.period_map.PeriodMap`.
    """
    from analysis.orbits import OrbitMap
    from engine.run.period_map import PeriodMap

    cable = PeriodMap(scene_of, state, value)
    return cable, OrbitMap(cable.step, frozen=cable.frozen, parameter_size=size, meshes=cable.meshes, seen=cable.seen)


class OrbitUnder(NamedTuple):
    """The periodic orbit under a run (`analysis.orbits.Orbit`), the errors of its multipliers, and a run on it that is
    long enough to be judged."""

    orbit: Orbit
    errors: np.ndarray
    run: Trajectory

    def row(self) -> tuple[dict[str, float | None], str]:
        """The columns MULTIPLIERS, and the leading multiplier in words."""
        first, error = complex(self.orbit.multipliers[0]), float(self.errors[0])
        modulus, angle = abs(first), abs(math.atan2(first.imag, first.real))
        values = modulus, angle, error if math.isfinite(error) else None
        said = f"{modulus:.4f} at {math.degrees(angle):.0f} degrees" if first.imag else f"{first.real:.4f}"
        doubt = ", not known to be stable" if modulus - error < 1.0 else ": NOT stable, the run lies beside it"
        words = f"leading multiplier {said}, ± {error:.2g}{doubt if modulus >= 1.0 else ''}"
        return dict(zip((column.name for column in MULTIPLIERS), values, strict=True)), words


def orbit_under(trajectory: Trajectory, period: int, iterations: int = 20) -> OrbitUnder:
    """The orbit under a run that repeats, or comes to repeat, after `period` wave periods or a divisor of them.

    Raises ArithmeticError, with the end of a sentence, where Newton's method finds none in so many iterations.
    """
    import numpy as np

    from analysis.orbits import NoImage, find_orbit, scatter_of
    from engine.scene import scene_from_toml

    own = trajectory.scene
    scene = scene_from_toml(own.to_toml(), {"solver.rtol": min(QUICK, own.solver.rtol)})
    cable, system = cable_map(lambda _: scene, trajectory.final_state, 0.0)
    orbit = find_orbit(system, cable.first, 0.0, period, count=2, iterations=iterations)
    if not orbit.found:
        raise NoImage(orbit.reason)
    once = cable.history(orbit.points, 0.0)
    samples = max(LONG, 8 * orbit.period) * cable.samples_of(scene) + 1
    columns = {name: np.resize(values, samples) for name, values in once.items()}
    columns["time_s"] = np.arange(samples) * own.sample_step_s()
    state = replace(cable.state_of(orbit.points[0], 0.0), scene=own)
    run = replace(trajectory, columns=columns, final_state=state)
    return OrbitUnder(orbit, scatter_of(system, orbit).multipliers, run)


def orbit_row(trajectory: Trajectory, period: int) -> tuple[dict[str, float | None], str]:
    """The columns MULTIPLIERS of the orbit under a run that repeats after `period` wave periods; the same in words.

    Where there is none, or one of another period than the run's, the words say why.
    """
    try:
        under = orbit_under(trajectory, period)
    except (ArithmeticError, ValueError) as why:
        return {}, f"no multipliers: {why}"
    if under.orbit.period != period:
        return {}, f"no multipliers: the orbit under it has period {under.orbit.period}"
    return under.row()
