"""What one run of the accuracy campaign is: a setting of a method on a work, over nodes and over steps or tolerances.

kind of a point:

    reference   what errors are taken against        check    how far that is converged
    point       timed: error against run time, in rounds that take turns
    time        steps halved on one grid             space    grids doubled, one step or tolerance
    tolerance   tolerances of one grid               grid     what errors of tolerances are taken against
    long        how long refined runs stay together
    both        elements and steps halved, at a Courant number of one

Near a snap the error of a loose setting is partly luck: every round takes another tolerance or step, `FACTORS` times
the one named, and tables give medians over the rounds.
"""

from dataclasses import dataclass

from campaigns.accuracy.works import BUOY, LINE, WORKS

FACTORS = (1.0, 0.9, 1.1)
ORDERS = {"esdirk43": 4, "trbdf2": 2, "generalized-alpha": 2, "midpoint": 2, "backward-euler": 1, "paper-box": 2}
ADAPTIVE = ("esdirk43", "trbdf2")
FIXED = ("generalized-alpha", "midpoint", "backward-euler")
VISCOUS, STRETCHED = ", shock viscosity", ", stretched grid"  # of a line with either
STRETCHING = 1.0
EXACT_NEWTON = {"solver.newton_tolerance": 1e-20, "solver.max_newton_iterations": 50}
TIGHT_NEWTON = {"solver.newton_tolerance": 1e-6}  # of timed points with fixed steps: their error is that of the step
LONGEST_STEP_S = 2.0  # where errors over tolerances are shown: the shipped 0.1 s would decide, not the tolerance
LONG_PERIODS = 24
LONG = ((161, 1e-4), (161, 1e-6), (161, 1e-5), (321, 1e-5), (641, 1e-5))  # neighbours differ in one of the two


def plain(method: str) -> str:
    """The integrator or scheme of a line."""
    return method.removesuffix(VISCOUS).removesuffix(STRETCHED)


@dataclass(frozen=True)
class Point:
    """One run, in the words of the table.

    control: the key of the solver that is varied, "rtol", "step_s" or "courant"; setting: its value, taken times the
    factor of the round.
    """

    work: str
    kind: str
    method: str
    nodes: int
    control: str
    setting: float
    round: int = 0

    def changes(self) -> dict[str, object]:
        """The keys of the scene that make it this point."""
        method = plain(self.method)
        keys = {"tether.nodes": self.nodes}
        if self.method.endswith(STRETCHED):
            keys["tether.grid_stretching"] = STRETCHING
        if method == "paper-box":
            keys["solver.scheme"] = method
        else:
            keys["solver.integrator"] = method
        if self.work.startswith("break"):
            keys["solver.courant"] = None
            if method == self.method:
                keys["solver.shock_viscosity"] = None
        keys[f"solver.{self.control}"] = self.setting * FACTORS[self.round]
        if self.kind in ("time", "space"):
            keys |= EXACT_NEWTON
        elif self.kind == "tolerance":
            keys["solver.max_step_s"] = LONGEST_STEP_S
        elif self.control != "rtol" and method != "paper-box":
            keys |= TIGHT_NEWTON
        return keys


@dataclass(frozen=True)
class Effort:
    """How much is run.

    nodes: by scene, or by work where it has its own. steps: per period of the work, likewise. whole: with the paper's
    scheme and the long runs.
    """

    works: tuple[str, ...]
    nodes: dict[str, tuple[int, ...]]
    rtols: tuple[float, ...]
    steps: dict[str, tuple[int, ...]]
    rounds: int
    whole: bool


_NODES = {"regular": (6, 11, 21, 41), BUOY: (21, 41, 81, 101, 161), LINE: (51, 101, 201, 401, 801)}
FULL = Effort(
    works=tuple(work.name for work in WORKS),
    nodes={**_NODES, "pendulum": (6, 11, 21, 41, 81)},
    rtols=(0.1, 0.03, 0.01, 3e-3, 1e-3, 1e-4, 1e-5),
    steps={BUOY: (100, 200, 400, 800, 1600, 3200), "pendulum": (10, 25, 50, 100, 200, 400)},
    rounds=3,
    whole=True,
)
QUICK = Effort(
    works=("regular", "regular-smooth", "pendulum"),
    nodes={BUOY: (11, 41), LINE: (), "pendulum": (6, 11)},
    rtols=(0.1, 0.03, 1e-3),
    steps={BUOY: (200, 800), "pendulum": (25, 100)},
    rounds=1,
    whole=False,
)
