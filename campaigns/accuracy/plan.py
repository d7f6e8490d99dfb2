"""The list of the engine's runs of the accuracy campaign, in the order of its table (`points` says what kinds)."""

from campaigns.accuracy.points import ADAPTIVE, FIXED, LONG, ORDERS, STRETCHED, VISCOUS, Effort, Point
from campaigns.accuracy.works import BUOY, BY_NAME, STRAIN, Work

TIME_NODES = {BUOY: 21, "pendulum": 11}  # grids on which orders in time are measured
SPACE_NODES = {BUOY: 11, "pendulum": 6}  # the coarsest grids of orders in space
FIRST_STEPS = {4: 100, 2: 200, 1: 1600}  # per period, of a series in time, by order
DOUBLINGS = 3  # of a series, in time and space
SPACE_STEPS = 400  # per period, of smooth works in space; rough ones need a tolerance
SPACE_RTOL = 1e-5
LINE_WAVE_MPS = 1000.0  # about the fastest wave of the breaking line: steps are an element's length over it
MOST_ADAPTIVE_LINE = 401  # nodes of breaking lines with steps under control: beyond, some take minutes to fail
TOLERANCE_NODES, TOLERANCE_REFERENCE = 161, 1e-6
COURANTS, LINE_RTOLS = (4.0, 2.0, 1.0, 0.5), (0.01, 1e-3, 1e-4)  # of breaking lines
BOX_NODES, BOX_STEPS = 21, (50, 100, 200)  # of the paper's scheme
BEST = "esdirk43"  # the method of references
Setting = tuple[str, int, str, float]  # method, nodes, control, its value


def own(table: dict, work: Work):
    """The entry for a work, or for its scene."""
    return table[work.name if work.name in table else work.scene]


def made(work: Work, kind: str, settings: list[Setting], round: int = 0) -> list[Point]:
    """A point of that kind for each setting."""
    return [Point(work.name, kind, *setting, round) for setting in settings]


def first_phase(effort: Effort) -> list[Point]:
    """References alone: everything else is described by its distance from them."""
    points = []
    for work in _works(effort):
        if work.reference is not None:
            nodes, rtol = work.reference
            points += made(work, "reference", [(BEST, nodes, "rtol", rtol)])
            # on the grid of the tolerances, at a tolerance beyond them: errors against it are those in time alone
            points += made(work, "grid", [(BEST, TOLERANCE_NODES, "rtol", TOLERANCE_REFERENCE)])
    return points


def second_phase(effort: Effort) -> list[Point]:
    """All that is not timed."""
    points = []
    for work in _works(effort):
        if work.reference is not None:
            points += made(work, "check", [(BEST, nodes, "rtol", rtol) for nodes, rtol in work.checks])
        if work.measure == STRAIN:
            points += made(work, "both", in_both(work, effort))
        else:
            points += made(work, "time", in_time(work)) + made(work, "space", in_space(work))
        if work.reference is not None:
            over = [(method, TOLERANCE_NODES, "rtol", rtol) for method in ADAPTIVE for rtol in effort.rtols]
            points += made(work, "tolerance", over)
        if effort.whole and work.name == "violent":
            points += made(work, "long", [(BEST, nodes, "rtol", rtol) for nodes, rtol in LONG])
    return points


def third_phase(effort: Effort) -> list[Point]:
    """What is timed, one at a time: all works' settings take turns, round by round; the paper's scheme runs once."""
    points = []
    for round in range(effort.rounds):
        for work in _works(effort):
            settings = of_a_line(work, effort) if work.measure == STRAIN else of_a_motion(work, effort)
            chosen = [setting for setting in settings if round == 0 or setting[0] != "paper-box"]
            points += made(work, "point", chosen, round) if work.timed else []
    return points


def _works(effort: Effort) -> list[Work]:
    return [BY_NAME[name] for name in effort.works]


def in_time(work: Work) -> list[Setting]:
    """Fixed steps, halved; every method but the paper's scheme, which is too slow for them."""
    nodes, halvings = own(TIME_NODES, work), range(DOUBLINGS + 1)
    return [
        (method, nodes, "step_s", work.period_s / (FIRST_STEPS[order] << halving))
        for method, order in ORDERS.items()
        if method != "paper-box"
        for halving in halvings
    ]


def in_space(work: Work) -> list[Setting]:
    """Elements halved."""
    control, setting = ("rtol", SPACE_RTOL) if work.rough else ("step_s", work.period_s / SPACE_STEPS)
    coarsest = own(SPACE_NODES, work) - 1
    return [(BEST, (coarsest << doubling) + 1, control, setting) for doubling in range(DOUBLINGS + 2)]


def in_both(work: Work, effort: Effort) -> list[Setting]:
    """Elements and steps halved together, every method with and without shock viscosity."""
    length_m = work.made({}).tether.length_m
    methods = (*(method + VISCOUS for method in FIXED), *FIXED, *ADAPTIVE)
    nodes = own(effort.nodes, work)
    return [(method, n, "step_s", length_m / (n - 1) / LINE_WAVE_MPS) for method in methods for n in nodes]


def of_a_motion(work: Work, effort: Effort) -> list[Setting]:
    """Timed settings of a buoy or a pendulum."""
    nodes, steps = own(effort.nodes, work), own(effort.steps, work)
    found = [(method, n, "rtol", rtol) for method in ADAPTIVE for n in nodes for rtol in effort.rtols]
    found += [(method, n, "step_s", work.period_s / m) for method in FIXED for n in nodes[:3] for m in steps]
    if work.scene == BUOY and work.name != "pendulum":
        found += [(BEST + STRETCHED, n, "rtol", rtol) for n in nodes[:4] for rtol in effort.rtols[:3]]
        found += [("paper-box", BOX_NODES, "step_s", work.period_s / m) for m in BOX_STEPS if effort.whole]
    return found


def of_a_line(work: Work, effort: Effort) -> list[Setting]:
    """Timed settings of a breaking line."""
    nodes = own(effort.nodes, work)
    middle, few = nodes[len(nodes) // 2], [n for n in nodes if n <= MOST_ADAPTIVE_LINE]
    found = []
    for viscous in (VISCOUS, ""):
        for method in FIXED:
            found += [(method + viscous, n, "courant", 1.0) for n in nodes]
            found += [(method + viscous, middle, "courant", courant) for courant in COURANTS if courant != 1.0]
        found += [(method + viscous, n, "rtol", rtol) for method in ADAPTIVE for n in few for rtol in LINE_RTOLS]
    return found
