"""Sweep of wave steepness for the tethered buoy: one run for each value, a table of what each did, a report.

    python -m campaigns.buoy_sweep                          the whole range, four to five minutes on two cores
    python -m campaigns.buoy_sweep --steepness 0.016 0.13   the paper's two cases (section 4.2)

Protocol: the same scene from rest for every value of waves.steepness, each as long as its regime needs
(docs/motions.md) and not beyond --budget, or all of --periods; then every other motion that is found there
(docs/motions.md), one row a motion. `--starts rest` leaves these out. The transient, found by the verdict or given, is
left out of extremes, slack and section. Kicks are drawn by --seed; nothing else is random.

In a plane a loop of slack tether cannot open; the run releases it and counts (`loop_releases`). `--dimensions 3` runs
every value in three dimensions, `--dimensions auto` those whose planar run released loops.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import engine
from campaigns.explore import sweep as motions
from campaigns.explore.grid import STEEPNESS as COLUMN
from campaigns.explore.grid import Grid, Varied
from campaigns.explore.space import SEED_MPS, in_space, run_where_needed
from campaigns.judge import judged_job, judged_scene
from campaigns.machinery import Job, Jobs, Plan, Summary, cli
from campaigns.study import Lengths, Measures, Order, Study
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE
from tables import Rows

# From the paper's small wave (0.016) to beyond its large one (0.13); a step of 0.003 meets 0.13 too.
STEEPNESS = tuple(round(0.016 + 0.003 * step, 3) for step in range(49))
SWEPT = "waves.steepness"
DIMENSIONS = ("2", "3", "auto")


@dataclass
class Options(motions.SweepOptions):
    """The options of this campaign."""

    steepness: list[float] | None = cli.option(
        "A B ...", "wave steepnesses kA (default: 49 values from 0.016 to 0.16)", cli.FRACTION, many=True
    )
    steepness_range: list | None = cli.option("LO HI COUNT", "evenly spaced steepnesses, both ends included")
    dimensions: str | None = cli.option(
        "|".join(DIMENSIONS),
        "2, 3, or auto: 3 where the planar run released loops (default: as the scene says; the shipped one says 2)",
        cli.one_of(DIMENSIONS),
    )
    no_between: bool = cli.flag(
        "do not run further values between for the orbit diagram of a sweep of nine values or more"
    )

    grid: Grid | None = None  # the steepnesses

    def read(self, faults: list[str]) -> None:
        """The steepnesses of --steepness or --steepness-range, or STEEPNESS without either."""
        if self.steepness is not None and self.steepness_range is not None:
            faults.append("--steepness and --steepness-range: given both; allowed: one of them")
        elif self.steepness_range is not None:
            self.steepness = cli.evenly(self.steepness_range, "--steepness-range", faults, least=0.0)
        self.grid = grid_of(self.steepness or STEEPNESS)


def grid_of(values) -> Grid:
    """The places of a sweep over the wave steepness, whose column has a short name."""
    return Grid((Varied(SWEPT, SWEPT, (), tuple(values), COLUMN),))


def cases(order: Order) -> Iterator[Job]:
    """A run for every steepness, in a plane or (`--dimensions 3`) in space; `auto` checks both, and runs the plane."""
    dimensions, base = dimensions_of(order), order.base()
    for place in order.options.grid.places():
        changes, _ = order.options.grid.changes(place, base)
        scene = judged_scene(order, {**_changes(dimensions), **changes})
        if scene is not None and dimensions != "2":
            try:
                spatial, _ = in_space(scene)
            except engine.SceneError as error:
                order.tell(*error.faults)
                continue
            if dimensions == "3":
                scene = spatial
        if scene is not None:
            labels = place | {"dimensions": scene.motion.dimensions}
            yield judged_job(order, labels, scene, motions.start_of(order, scene))


def _changes(dimensions: str) -> dict:
    """What a scene is changed by so that its runs have these dimensions; `auto` begins in the plane."""
    return {"motion.dimensions": (2, 3)[dimensions == "3"]}


def dimensions_of(order: Order) -> str:
    """One of DIMENSIONS: as the command line says, or the scene."""
    if order.options.dimensions is not None:
        return order.options.dimensions
    scene = order.base()
    if scene is None:
        return "2"
    return str(scene.motion.dimensions)


def runs(order: Order, plan: Plan, jobs: Jobs) -> Summary:
    """The runs in a plane, in space where needed, or of every motion."""
    from campaigns.explore.batches import between_ahead, companions_ahead

    if has_between(order):
        between_ahead(plan, SWEPT, order.cases)
    if dimensions_of(order) == "auto":
        return run_where_needed(plan, jobs)
    ahead = None
    if not order.options.no_accuracy:
        ahead = partial(companions_ahead, plan, key=SWEPT, periods=order.periods)
    return motions.runs(order, plan, jobs, ahead)


def measures(order: Order) -> Measures:
    """How a run becomes a row of table.csv: by `rows.buoy_row`."""
    from campaigns.explore.rows import COLUMNS

    return motions.measures_of(order, COLUMNS)


def parameters(order: Order) -> dict:
    """What the provenance says of this campaign; push_mps: of the push that starts a motion out of the plane."""
    dimensions, push_mps = dimensions_of(order), None
    if dimensions != "2":
        _, pushed = in_space(order.base(_changes(dimensions)))
        if pushed:
            push_mps = SEED_MPS
    return {
        "steepness": [case.labels["steepness"] for case in order.cases],
        "strobe_tolerance": STROBE_TOLERANCE,
        "longest_period": LONGEST_PERIOD,
        "dimensions": dimensions,
        "push_mps": push_mps,
        "accuracy": not order.options.no_accuracy,
        **motions.parameters(order),
    }


def has_between(order: Order) -> bool:
    """Whether there are runs between the values of the sweep."""
    from campaigns.explore.batches import LEAST_VALUES

    return order.looks and not order.options.no_between and len(order.cases) >= LEAST_VALUES


def beside(order: Order) -> Iterator[Callable]:
    """What follows the runs (`campaigns.explore.batches`): values between, the wetted cap, errors, a close-up."""
    from campaigns.explore import batches
    from campaigns.explore.errors import errors

    if has_between(order):
        yield partial(batches.between, key=SWEPT, cases=order.cases)
    if not order.options.no_accuracy:
        yield partial(batches.companions, key=SWEPT, periods=order.periods)
        yield errors
    yield partial(batches.close_up, periods=order.periods)


def answer(order: Order, rows: Rows) -> list[str]:
    """The findings of the sweep (`campaigns.explore.answer`)."""
    if order.options.no_accuracy:
        return motions.answer(order, rows, COLUMN.symbol)
    return motions.answer(order, rows, COLUMN.symbol, "companions")


STUDY = Study(
    name="buoy_sweep",
    protocol=__doc__,
    scene="tethered_buoy",
    lengths=Lengths(periods=300, transient=100, budget=motions.BUDGET),
    in_waves=True,
    taken={
        SWEPT: "use --steepness",
        "waves.amplitude_m": "use --steepness",
        "motion.dimensions": "use --dimensions",
    },
    options=Options,
    cases=partial(motions.with_kicks, cases),
    measures=measures,
    parameters=parameters,
    runs=runs,
    beside=beside,
    answer=answer,
)
main, read_order = STUDY.main, STUDY.read_order
