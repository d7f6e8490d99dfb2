"""The periodic orbit under a run of a buoy in regular waves: its multipliers, with their errors.

A run near a stable orbit shows the orbit, not how fast perturbations die out along each direction, and not that the
orbit is one. Newton's method on the map over a wave period (`engine.period_map`) finds it to 1e-9 from the last state.
"""

import math
from collections.abc import Callable

from campaigns.columns import Column

TOLERANCE = 1e-3  # of the steps of an orbit, or that of the scene where that is smaller; at 0.03 multipliers are false
QUICK = 3e-3  # the same for the rows of a sweep
COUNT = 4  # multipliers
MULTIPLIERS = (
    Column(
        "multiplier_modulus", "", "|μ|",
        "modulus of the leading multiplier of the periodic orbit: what a period of it makes of a perturbation", 3,
    ),
    Column("multiplier_angle_rad", "rad", "arg μ", "angle of the leading multiplier in the complex plane, 0 to π", 3),
    Column("multiplier_error", "", "± μ", "largest change of the multiplier over steps of the same tolerance", 3),
)  # fmt: skip


def cable_map(scene_of: Callable, state, value: float, size: float = 1.0):
    """The PeriodMap of a state, and the OrbitMap of it. size: the change of the parameter that counts as 1.

    Raises ValueError and ArithmeticError as `engine.period_map.PeriodMap`.
    """
    from analysis.orbits import OrbitMap
    from engine.period_map import PeriodMap

    cable = PeriodMap(scene_of, state, value)
    return cable, OrbitMap(cable.step, frozen=cable.frozen, parameter_size=size, meshes=cable.meshes, seen=cable.seen)


def orbit_row(trajectory, period: int) -> tuple[dict[str, float | None], str]:
    """The columns MULTIPLIERS of the orbit under a run that repeats after `period` wave periods; the same in words.

    Where there is none, or one of another period than the run's, the words say why.
    """
    from analysis.orbits import find_orbit, scatter_of
    from engine.scene import scene_from_toml

    own = trajectory.scene
    scene = scene_from_toml(own.to_toml(), {"solver.rtol": min(QUICK, own.solver.rtol)})
    try:
        cable, system = cable_map(lambda _: scene, trajectory.final_state, 0.0)
    except (ArithmeticError, ValueError) as why:
        return {}, f"no multipliers: {why}"
    orbit = find_orbit(system, cable.first, 0.0, period, count=2)
    if not orbit.found or orbit.period != period:
        return {}, f"no multipliers: {orbit.reason or f'the orbit under it has period {orbit.period}'}"
    first, error = complex(orbit.multipliers[0]), float(scatter_of(system, orbit).multipliers[0])
    values = abs(first), abs(math.atan2(first.imag, first.real)), error if math.isfinite(error) else None
    return dict(zip((column.name for column in MULTIPLIERS), values, strict=True)), _said(first, error)


def _said(first: complex, error: float) -> str:
    """A leading multiplier in words."""
    value = f"{first.real:.2f}" if first.imag == 0.0 else f"{abs(first):.2f} at {_degrees(first):.0f} degrees"
    kept = abs(first) - error < 1.0
    doubt = "" if abs(first) < 1.0 else ", not known to be stable" if kept else ": NOT stable, the run lies beside it"
    return f"leading multiplier {value}, ± {error:.2g}{doubt}"


def _degrees(value: complex) -> float:
    return math.degrees(abs(math.atan2(value.imag, value.real)))
