"""The works of the accuracy campaign and the other codes on them, read from works.toml; the list of the engine's runs.

Errors, over the even samples of a run:

    radius   rms of r(t) - r(t) of the reference, mm
    place    rms of the distance between the upper end's places, mm
    strain   mean over line and time of |strain - exact strain|, per cent of the static strain

The buoy is that of Table 1. The pendulum is a rope of its diameter, softer and shorter, with 2 kg at its lower end, in
air, pushed along and across: smooth, in three dimensions. The breaking line is that of section 4.1 without gravity on
an even grid: it stays straight, so that the exact solution in one dimension (`campaigns.breaking_line.theory`) is the
reference.

kind of a run, in the order of the table:

    reference   what errors are taken against        check    how far that is converged
    point       timed: error against run time, in rounds that take turns
    time        steps halved on one grid             space    grids doubled, one step or tolerance
    tolerance   tolerances of one grid               grid     what errors of tolerances are taken against
    both        elements and steps halved, at a Courant number of one

Near a snap the error of a loose setting is partly luck: every round takes another tolerance or step, `FACTORS` times
the one named, and tables give medians over the rounds.
"""

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product
from pathlib import Path

import engine

BUOY = "tethered_buoy"
RADIUS, PLACE, STRAIN = "radius", "place", "strain"
UNITS = {RADIUS: "mm", PLACE: "mm", STRAIN: "%"}
PERIOD_S = 5.0


@dataclass(frozen=True)
class Work:
    """One work: a shipped scene with the changes of a set and its own.

    rough: why methods do not show their orders on it, "" where it is smooth. reference, checks: (nodes, rtol) of the
    reference and of runs that show how far it is converged; no reference: the exact solution. The wave period, or
    1 s where there is none, is what steps per period are counted in. timed: False for a work that shows orders only.
    """

    name: str
    title: str
    scene: str
    set: str
    changes: dict
    duration_s: float
    measure: str
    rough: str = ""
    reference: tuple[int, float] | None = None
    checks: tuple[tuple[int, float], ...] = ()
    period_s: float = PERIOD_S
    timed: bool = True

    def made(self, changes: dict):
        """The scene with further changes. Raises SceneError."""
        own = FILE["sets"][self.set] | self.changes
        for key, value in own.items():
            if value == "none":
                own[key] = None
        return engine.load_scene(self.scene, own | changes)


@dataclass(frozen=True, eq=False)
class Peer:
    """Another code. package, module: as installed and as imported.

    settings, quick: (nodes or segments, value) that are timed, by work; control: what the value is. refined: its
    reference, then a check, by work; none: ours is its own. ours: changes of the scene with which our refined run is
    the one to compare with. notes: what is left different.
    """

    name: str
    package: str
    module: str
    control: str
    notes: str
    settings: dict[str, list]
    quick: dict[str, list] = field(default_factory=dict)
    refined: dict[str, list] = field(default_factory=dict)
    ours: dict = field(default_factory=dict)


FILE = tomllib.loads(Path(__file__).with_name("works.toml").read_text(encoding="utf-8"))
BY_NAME = {name: Work(name, **row) for name, row in FILE["works"].items()}
PEERS = tuple(Peer(name, **row) for name, row in FILE["peers"].items())

FACTORS = (1.0, 0.9, 1.1)
ORDERS = {"esdirk43": 4, "trbdf2": 2, "generalized-alpha": 2, "midpoint": 2, "backward-euler": 1, "paper-box": 2}
ADAPTIVE = ("esdirk43", "trbdf2")
FIXED = ("generalized-alpha", "midpoint", "backward-euler")
BEST = "esdirk43"  # the method of references
VISCOUS, STRETCHED = ", shock viscosity", ", stretched grid"  # of a line with either
STRETCHING = 1.0
EXACT_NEWTON = {"solver.newton_tolerance": 1e-20, "solver.max_newton_iterations": 50}
TIGHT_NEWTON = {"solver.newton_tolerance": 1e-6}  # of timed points with fixed steps: their error is that of the step
LONGEST_STEP_S = 2.0  # where errors over tolerances are shown: the shipped 0.1 s would decide, not the tolerance
TIME_NODES = {BUOY: 21, "pendulum": 11}  # grids on which orders in time are measured
SPACE_NODES = {BUOY: 11, "pendulum": 6}  # the coarsest grids of orders in space
FIRST_STEPS = {4: 100, 2: 200, 1: 1600}  # per period, of a series in time, by order
DOUBLINGS = 3  # of a series, in time and space
SPACE_STEPS = 400  # per period, of smooth works in space; rough ones need a tolerance
SPACE_RTOL = 1e-5
LINE_WAVE_MPS = 1000.0  # about the fastest wave of the breaking line: steps are an element's length over it
MOST_ADAPTIVE_LINE = 401  # nodes of breaking lines with steps under control: beyond, some take minutes to fail
TOLERANCE_NODES = 161
TOLERANCE_REFERENCE = TOLERANCE_NODES, 1e-6  # nodes, rtol
COURANTS, LINE_RTOLS = (4.0, 2.0, 0.5), (0.01, 1e-3, 1e-4)  # of breaking lines, beside a Courant number of one
BOX_NODES, BOX_STEPS = 21, (50, 100, 200)  # of the paper's scheme
Setting = tuple[str, int, str, float]  # method, nodes, control, its value


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

    def changes(self) -> dict:
        """The keys of the scene that make it this point."""
        method = plain(self.method)
        keys = {"tether.nodes": self.nodes}
        if self.method.endswith(STRETCHED):
            keys["tether.grid_stretching"] = STRETCHING
        keys["solver.scheme" if method == "paper-box" else "solver.integrator"] = method
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
    scheme.
    """

    works: Sequence[str]
    nodes: Mapping[str, Sequence[int]]
    rtols: Sequence[float]
    steps: Mapping[str, Sequence[int]]
    rounds: int
    whole: bool


FULL = Effort(works=tuple(BY_NAME), **FILE["effort"]["full"])
QUICK = Effort(**FILE["effort"]["quick"])


def phases(effort: Effort) -> tuple[list, list, list]:
    """References alone, from which everything else is described by its distance; what is not timed; what is timed, all
    works' settings in turns, round by round, and the paper's scheme once."""
    works = [BY_NAME[name] for name in BY_NAME if name in effort.works]
    # The reference of a work, and that of its tolerances: on their grid, at a tolerance beyond them, so that errors
    # against it are those in time alone.
    references, untimed, timed = [], [], []
    for work in works:
        untimed += series(work, effort)
        if work.reference is not None:
            for kind, (nodes, rtol) in (("reference", work.reference), ("grid", TOLERANCE_REFERENCE)):
                references.append(Point(work.name, kind, BEST, nodes, "rtol", rtol))
    for number in range(effort.rounds):
        for work in works:
            for setting in timed_settings(work, effort):
                if number == 0 or setting[0] != "paper-box":
                    timed.append(Point(work.name, "point", *setting, number))
    return references, untimed, timed


def timed_settings(work: Work, effort: Effort) -> list[Setting]:
    """The settings that are timed on a work."""
    if not work.timed:
        return []
    if work.measure == STRAIN:
        return of_a_line(work, effort)
    return of_a_motion(work, effort)


def series(work: Work, effort: Effort) -> list[Point]:
    """All of a work that is not timed."""
    kinds = {"check": [(BEST, nodes, "rtol", rtol) for nodes, rtol in work.checks]}
    if work.measure == STRAIN:
        kinds["both"] = in_both(work, effort)
    else:
        kinds |= {"time": in_time(work), "space": in_space(work)}
    if work.reference is not None:
        kinds["tolerance"] = list(product(ADAPTIVE, [TOLERANCE_NODES], ["rtol"], effort.rtols))
    points = []
    for kind, settings in kinds.items():
        for setting in settings:
            points.append(Point(work.name, kind, *setting))
    return points


def entry_of(table: dict, work: Work):
    """The entry for a work, or for its scene."""
    return table.get(work.name, table.get(work.scene))


def in_time(work: Work) -> list[Setting]:
    """Fixed steps, halved; every method but the paper's scheme, which is too slow for them."""
    settings, nodes = [], entry_of(TIME_NODES, work)
    for method, order in ORDERS.items():
        if method != "paper-box":
            for halving in range(DOUBLINGS + 1):
                settings.append((method, nodes, "step_s", work.period_s / (FIRST_STEPS[order] << halving)))
    return settings


def in_space(work: Work) -> list[Setting]:
    """Elements halved."""
    control, setting = "step_s", work.period_s / SPACE_STEPS
    if work.rough:
        control, setting = "rtol", SPACE_RTOL
    coarsest = entry_of(SPACE_NODES, work) - 1
    return [(BEST, (coarsest << doubling) + 1, control, setting) for doubling in range(DOUBLINGS + 2)]


def in_both(work: Work, effort: Effort) -> list[Setting]:
    """Elements and steps halved together, every method with and without shock viscosity."""
    length_m = work.made({}).tether.length_m
    methods = (*(method + VISCOUS for method in FIXED), *FIXED, *ADAPTIVE)
    nodes = entry_of(effort.nodes, work)
    return [(method, n, "step_s", length_m / (n - 1) / LINE_WAVE_MPS) for method, n in product(methods, nodes)]


def of_a_motion(work: Work, effort: Effort) -> list[Setting]:
    """Timed settings of a buoy or a pendulum."""
    nodes = entry_of(effort.nodes, work)
    steps_s = [work.period_s / count for count in entry_of(effort.steps, work)]
    settings = list(product(ADAPTIVE, nodes, ["rtol"], effort.rtols))
    settings += product(FIXED, nodes[:3], ["step_s"], steps_s)
    if work.scene == BUOY and work.name != "pendulum":
        settings += product([BEST + STRETCHED], nodes[:4], ["rtol"], effort.rtols[:3])
        if effort.whole:
            settings += [("paper-box", BOX_NODES, "step_s", work.period_s / count) for count in BOX_STEPS]
    return settings


def of_a_line(work: Work, effort: Effort) -> list[Setting]:
    """Timed settings of a breaking line."""
    nodes = entry_of(effort.nodes, work)
    middle, coarse = nodes[len(nodes) // 2], [n for n in nodes if n <= MOST_ADAPTIVE_LINE]
    settings = []
    for viscous in (VISCOUS, ""):
        for method in FIXED:
            settings += product([method + viscous], nodes, ["courant"], [1.0])
            settings += product([method + viscous], [middle], ["courant"], COURANTS)
        for method in ADAPTIVE:
            settings += product([method + viscous], coarse, ["rtol"], LINE_RTOLS)
    return settings
