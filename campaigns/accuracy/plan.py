"""The list of the engine's runs of the accuracy campaign, in the order of its table (`points` says what kinds)."""

from campaigns.accuracy.points import ADAPTIVE, DEFAULT_RTOL, FIXED, LONG, ORDERS, STRETCHED, VISCOUS, Effort, Point
from campaigns.accuracy.works import BUOY, BY_NAME, STRAIN, Work

TIME_NODES = {BUOY: 21, "pendulum": 11}  # grids on which orders in time are measured
SPACE_NODES = {BUOY: 11, "pendulum": 6}  # the coarsest grids of orders in space
SPACE_STEPS = 400  # per period, of smooth works in space; rough ones need a tolerance
SPACE_RTOL = 1e-5
LINE_WAVE_MPS = 1000.0  # about the fastest wave of the breaking line: steps are an element's length over it
MOST_ADAPTIVE_LINE = 401  # nodes of breaking lines with steps under control: beyond, some take minutes to fail
TOLERANCE_NODES, TOLERANCE_REFERENCE = 161, 1e-6
REFERENCE_METHOD = "esdirk43"


def own(table: dict, work: Work):
    """The entry for a work, or for its scene."""
    return table[work.name if work.name in table else work.scene]


def references(work: Work) -> list[Point]:
    """The reference first, then what shows how far it is converged."""
    if work.reference is None:
        return []
    settings = (work.reference, *work.checks)
    return [
        Point(work.name, "check" if i else "reference", REFERENCE_METHOD, nodes, "rtol", rtol)
        for i, (nodes, rtol) in enumerate(settings)
    ]


def grid_reference(work: Work) -> list[Point]:
    """A run on the grid of `tolerances` at a tolerance beyond them: their errors against it are those in time alone."""
    return [Point(work.name, "grid", REFERENCE_METHOD, TOLERANCE_NODES, "rtol", TOLERANCE_REFERENCE)]


def long_runs(work: Work) -> list[Point]:
    """Refined runs that go on until they part."""
    return [Point(work.name, "long", REFERENCE_METHOD, nodes, "rtol", rtol) for nodes, rtol in LONG]


def in_time(work: Work, effort: Effort) -> list[Point]:
    """Fixed steps, halved; every method but the paper's scheme, which is too slow for them."""
    points = []
    for method, order in ORDERS.items():
        if method == "paper-box":
            continue
        for doubling in range(effort.doublings + 1):
            step_s = work.period_s / (effort.orders[order] << doubling)
            points.append(Point(work.name, "time", method, own(TIME_NODES, work), "step_s", step_s))
    return points


def in_space(work: Work, effort: Effort) -> list[Point]:
    """Elements halved."""
    control, setting = ("rtol", SPACE_RTOL) if work.rough else ("step_s", work.period_s / SPACE_STEPS)
    coarsest = own(SPACE_NODES, work) - 1
    return [
        Point(work.name, "space", REFERENCE_METHOD, (coarsest << doubling) + 1, control, setting)
        for doubling in range(effort.doublings + 2)
    ]


def in_both(work: Work, effort: Effort) -> list[Point]:
    """Elements and steps halved together, every method with and without shock viscosity."""
    length_m = work.made({}).tether.length_m
    found = []
    for method in (*(method + VISCOUS for method in FIXED), *FIXED, *ADAPTIVE):
        for n in own(effort.nodes, work):
            step_s = length_m / (n - 1) / LINE_WAVE_MPS
            found.append(Point(work.name, "both", method, n, "step_s", step_s))
    return found


def tolerances(work: Work, effort: Effort) -> list[Point]:
    """One fine grid over tolerances."""
    return [
        Point(work.name, "tolerance", method, TOLERANCE_NODES, "rtol", rtol)
        for method in ADAPTIVE
        for rtol in effort.rtols
    ]


def timed(work: Work, effort: Effort) -> list[Point]:
    """Settings of every method, round by round."""
    settings = _of_a_line(work, effort) if work.measure == STRAIN else _of_a_motion(work, effort)
    return [
        Point(work.name, "point", *setting, round)
        for round in range(effort.rounds)
        for setting in settings
        if round == 0 or setting[0] != "paper-box"
    ]


def _of_a_motion(work: Work, effort: Effort) -> list[tuple[str, int, str, float]]:
    nodes = own(effort.nodes, work)
    found = [(method, n, "rtol", rtol) for method in ADAPTIVE for n in nodes for rtol in effort.rtols]
    found += [
        (method, n, "step_s", work.period_s / steps)
        for method in FIXED
        for n in nodes[:3]
        for steps in own(effort.steps, work)
    ]
    if work.scene == BUOY and work.name != "pendulum":
        stretched = REFERENCE_METHOD + STRETCHED
        found += [(stretched, n, "rtol", rtol) for n in nodes[:4] for rtol in effort.rtols[:3]]
        box = [(n, steps) for n in effort.box_nodes for steps in effort.box_steps]
        found += [("paper-box", n, "step_s", work.period_s / steps) for n, steps in box]
    return found


def _of_a_line(work: Work, effort: Effort) -> list[tuple[str, int, str, float]]:
    nodes = own(effort.nodes, work)
    middle = nodes[len(nodes) // 2]
    found = []
    for viscous in (VISCOUS, ""):
        for method in FIXED:
            found += [(method + viscous, n, "courant", 1.0) for n in nodes]
            found += [(method + viscous, middle, "courant", courant) for courant in effort.courants if courant != 1.0]
        few = [n for n in nodes if n <= MOST_ADAPTIVE_LINE]
        found += [(method + viscous, n, "rtol", rtol) for method in ADAPTIVE for n in few for rtol in effort.line_rtols]
    return found


def first_phase(effort: Effort) -> list[Point]:
    """References alone: everything else is described by its distance from them."""
    works = [work for name in effort.works if (work := BY_NAME[name]).reference is not None]
    return [point for work in works for point in (references(work)[0], *grid_reference(work))]


def second_phase(effort: Effort) -> list[Point]:
    """All that is not timed."""
    points = []
    for name in effort.works:
        work = BY_NAME[name]
        points += references(work)[1:]
        if work.measure != STRAIN:
            points += in_time(work, effort) + in_space(work, effort)
        else:
            points += in_both(work, effort)
        if work.reference is not None:
            points += tolerances(work, effort)
        if effort.long and name == "violent":
            points += long_runs(work)
    return points


def third_phase(effort: Effort) -> list[Point]:
    """What is timed, one at a time: all works' settings take turns, round by round."""
    points = [point for name in effort.works if BY_NAME[name].timed for point in timed(BY_NAME[name], effort)]
    return sorted(points, key=lambda point: point.round)


def default_setting(point: Point) -> bool:
    """Whether a point is the shipped setting of the engine, but for its grid."""
    return point.method == REFERENCE_METHOD and point.control == "rtol" and point.setting == DEFAULT_RTOL
