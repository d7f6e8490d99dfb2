"""A stand-in for engine.simulate whose errors are known: order 2 in the grid, the integrator's order in time."""

from dataclasses import dataclass, replace

import numpy as np

from engine.trajectory import COLUMNS, Trajectory
from tests.campaigns.fake_engine import STATISTICS

ORDER = {"esdirk43": 4, "trbdf2": 2, "generalized-alpha": 2, "midpoint": 2, "backward-euler": 1}
GRID_M, STEP_M = 0.3, 0.2  # error of one element; of a step of one second


@dataclass(frozen=True)
class KnownErrors:
    """Called like engine.simulate. failing: integrators whose runs end early; raises: nodes at which it breaks."""

    failing: tuple[str, ...] = ()
    raises: tuple[int, ...] = ()

    def __call__(self, scene, periods=None, duration_s=None):
        solver, nodes = scene.solver, scene.tether.nodes
        if nodes in self.raises and duration_s > 1.0:
            raise ZeroDivisionError("a fault of the code")
        order = ORDER[solver.integrator]
        step_s = solver.step_s or solver.rtol ** (1.0 / order)
        t = scene.sample_step_s() * np.arange(round(duration_s / scene.sample_step_s()) + 1)
        off = GRID_M * np.sin(t) / (nodes - 1) ** 2 + STEP_M * np.cos(t) * step_s**order
        radius = 20.8 + 0.5 * np.sin(1.3 * t) + off
        columns = {name: np.zeros_like(t) for name in COLUMNS}
        columns |= {"time_s": t, "radius_m": radius, "x_m": radius, "tension_min_N": 1000.0 * np.cos(0.1 * t)}
        work = {"newton_iterations": 10 * round(duration_s / step_s), "wall_s": 1e-4 * nodes / step_s}
        statistics = STATISTICS | work | {"max_turn_rad": 0.1, "min_strain": 0.01, "end_time_s": duration_s}
        run = Trajectory(scene, "ok", "", columns, statistics)
        if solver.integrator in self.failing:
            half = {name: values[: len(t) // 2] for name, values in columns.items()}
            run = replace(run, status="newton-failed", message="no convergence", columns=half)
        return run
