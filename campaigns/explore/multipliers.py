"""The periodic orbit under a run of a buoy in regular waves, or that it comes nearer to (`analysis.approaches`): its
multipliers, with their errors.

A run near a stable orbit shows the orbit, not how fast perturbations die out along each direction, and not that the
orbit is one. Newton's method on the map over a wave period (`engine.run.period_map`) finds it to 1e-6 from the last
state.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import TYPE_CHECKING

import engine
from campaigns.judge import periods_of
from campaigns.machinery import EARLY, Store, filled, key_of, made_by
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carries_tangents, strobed_states
from tables import REGIMES, SHEET, Column, finite

if TYPE_CHECKING:
    import numpy as np

    from analysis import Evidence
    from engine.trajectory import Trajectory

SOURCES = "analysis/orbits", "analysis/sampling.py", "campaigns/explore/multipliers.py"

TOLERANCE = 1e-3  # of the steps of an orbit, or that of the scene where that is smaller; at 0.03 multipliers are false
QUICK = 3e-3  # the same for the rows of a sweep
COUNT = 4  # multipliers
UNSTABLE = "NOT stable, the run lies beside it"
THIN = 2.0  # modulus of a multiplier, beyond a flip, up to which two branches may be nearer than the tolerance
ITERATIONS, HALVINGS = 6, 2  # of Newton's method: from a run that comes nearer to an orbit three are enough
LONG = 40  # wave periods of a run on an orbit, or eight of its periods
MULTIPLIERS = (
    Column(
        "multiplier_modulus", "", "|μ|",
        "modulus of the leading multiplier of the periodic orbit: what a period of it makes of a perturbation",
        3, REGIMES,
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
    settings = {"parameter_size": size, "meshes": cable.meshes, "abreast": cable.abreast, "seen": cable.seen}
    return cable, OrbitMap(cable.step, frozen=cable.frozen, **settings)


@dataclass(frozen=True)
class OrbitUnder:
    """The periodic orbit under a run, as its computation is kept.

    multipliers (k,)    complex, the largest first
    errors (k,)         of the multipliers
    run                 on the orbit, long enough to be judged
    """

    period: int
    multipliers: np.ndarray
    errors: np.ndarray
    run: Trajectory

    def row(self) -> dict[str, float | None]:
        """The columns MULTIPLIERS."""
        return filled(MULTIPLIERS, map(finite, self._leading()))

    def words(self) -> str:
        """The leading multiplier, and whether the orbit is stable."""
        first = self.multipliers[0]
        modulus, angle, error = self._leading()
        size, doubt = f"{first.real:.4f}", ""
        if first.imag:
            size = f"{modulus:.4f} at {math.degrees(angle):.0f} degrees"
        if self.is_unstable():
            doubt = f": {UNSTABLE}"
        elif abs(modulus - 1.0) <= error:
            doubt = ", not known to be stable"
        return f"leading multiplier {size}, ± {error:.2g}{doubt}"

    def is_unstable(self) -> bool:
        """Whether its leading multiplier is beyond 1 by more than its error: no motion stays on such an orbit."""
        modulus, _, error = self._leading()
        return modulus - 1.0 > error

    def growth_bits(self, periods: int) -> float:
        """Bits by which a perturbation of the orbit grows at least in so many wave periods; below 0: it may shrink."""
        modulus, _, error = self._leading()
        return periods / self.period * math.log2(max(modulus - error, 1e-300))

    def _leading(self) -> tuple[float, float, float]:
        """Modulus, angle and error of the leading multiplier."""
        first = complex(self.multipliers[0])
        return abs(first), abs(math.atan2(first.imag, first.real)), float(self.errors[0])


def orbit_under(trajectory: Trajectory, period: int, orbits: Store, iterations: int = 20) -> OrbitUnder:
    """The orbit under a run that repeats, or comes to repeat, after `period` wave periods or a divisor of them.

    orbits: where its computation is kept. Raises ArithmeticError, with the end of a sentence, where Newton's method
    finds none in so many iterations.
    """
    import numpy as np

    from engine.trajectory.final_state import state_of_file

    scene = trajectory.scene
    key = key_of(trajectory.final_state, scene.key(), period, iterations, engine.source_hash(), _maker())
    result = orbits.finished(key, partial(_computed, trajectory, period, iterations))
    if result["reason"]:
        raise ArithmeticError(result["reason"])
    arrays = {name: np.array(values) for name, values in result["state"].items()}
    samples = max(LONG, 8 * result["period"]) * (len(result["history"]["time_s"]) // result["period"]) + 1
    columns = {name: np.resize(np.array(values), samples) for name, values in result["history"].items()}
    columns["time_s"] = np.arange(samples) * scene.sample_step_s()
    run = replace(trajectory, columns=columns, final_state=state_of_file(scene, arrays))
    multipliers = np.array([complex(*parts) for parts in result["multipliers"]])
    return OrbitUnder(result["period"], multipliers, np.array(result["errors"]), run)


@cache
def _maker() -> str:
    return made_by(*SOURCES)


def _computed(trajectory: Trajectory, period: int, iterations: int) -> dict:
    """The orbit under a run: `reason` why there is none, or its period, multipliers, errors, history and state."""
    from analysis.orbits import find_orbit, scatter_of
    from engine.scene import scene_from_toml

    scene = trajectory.scene
    scene = scene_from_toml(scene.to_toml(), {"solver.rtol": min(QUICK, scene.solver.rtol)})
    try:
        cable, system = cable_map(lambda _: scene, trajectory.final_state, 0.0)
        orbit = find_orbit(system, cable.first, 0.0, period, count=2, iterations=iterations, halvings=HALVINGS)
        if not orbit.found:
            return {"reason": orbit.reason}
        history = cable.history(orbit.points, 0.0)
        state = cable.state_of(orbit.points[0], 0.0)
        errors = scatter_of(system, orbit).multipliers
    except (ArithmeticError, ValueError) as why:
        return {"reason": str(why)}
    return {
        "reason": "",
        "period": orbit.period,
        "multipliers": orbit.multipliers,
        "errors": errors,
        "history": history,
        "state": {name: values for name, _, values, *_ in state.variables()},
    }


def orbit_of_twice(trajectory: Trajectory, flipped: OrbitUnder, orbits: Store) -> OrbitUnder | None:
    """The orbit of twice the period under a run that repeats beside an unstable orbit; None: none is found, it is
    unstable too, or the run does not lie on it.

    Beyond a flip the orbit is unstable, and at first the two branches of the motion are nearer than the tolerance.
    """
    from analysis import approach_evidence

    if not -THIN < flipped.multipliers[0].real < -1.0:
        return None
    try:
        orbit = orbit_under(trajectory, 2 * flipped.period, orbits)
    except (ArithmeticError, ValueError):
        return None
    if orbit.period != 2 * flipped.period or orbit.is_unstable():
        return None
    strobed, _ = strobed_states(trajectory, 0)
    points, scale = strobed_states(orbit.run, 0)
    approach = approach_evidence(strobed, points[: orbit.period], orbit.multipliers, orbit.errors, scale)
    return orbit if approach.passed else None


def orbit_ahead(trajectory: Trajectory, orbits: Store) -> tuple[OrbitUnder, Evidence] | None:
    """The orbit near a run, and whether the run comes nearer to it; None where no orbit is looked for or found.

    It is looked for where the run repeats, and from the second look on where its steps shrink. That the orbit attracts,
    and that the run lies on it or comes nearer, proves a period after fewer wave periods than the run alone could.
    """
    from analysis import approach_evidence, approached_period, detect_period, next_look

    scene = trajectory.scene
    periods = round(periods_of(scene, trajectory.columns))
    if periods < EARLY or not carries_tangents(scene) or trajectory.final_state is None:
        return None
    strobed, scale = strobed_states(trajectory, periods // 2)
    period = detect_period(strobed[periods // 2 :], LONGEST_PERIOD, STROBE_TOLERANCE, scale).period
    if period is None and periods >= next_look(next_look()):
        period = approached_period(strobed, scale, LONGEST_PERIOD)
    if period is None:
        return None
    try:
        orbit = orbit_under(trajectory, period, orbits, ITERATIONS)
    except (ArithmeticError, ValueError):
        return None
    points, scale = strobed_states(orbit.run, 0)
    return orbit, approach_evidence(strobed, points[: orbit.period], orbit.multipliers, orbit.errors, scale)
