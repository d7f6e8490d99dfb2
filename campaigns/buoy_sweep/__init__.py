"""Sweep of wave steepness for the tethered buoy: one run a value, a table of what each did, a report.

    python -m campaigns.buoy_sweep                          a picture of the whole range, in about a minute
    python -m campaigns.buoy_sweep --steepness 0.016 0.13   the paper's two cases (section 4.2)

Protocol: the same scene, start and length for every value of waves.steepness; the first wave periods of every run are
left out of extremes, slack and section as the transient. Nothing is random.

In a plane a loop of slack tether cannot open; the run releases it and counts (`loop_releases`). `--dimensions 3` runs
every value in three dimensions, `--dimensions auto` those whose planar run released loops.
"""

from dataclasses import dataclass
from functools import partial

from campaigns.machinery import cli

CAMPAIGN = "buoy_sweep"
MODULE = "campaigns.buoy_sweep"
SCENE = "tethered_buoy"
# From the paper's small wave (0.016) to beyond its large one (0.13); a step of 0.003 meets 0.13 too.
STEEPNESS = tuple(round(0.016 + 0.003 * step, 3) for step in range(49))
PAPER_STEEPNESS = (0.016, 0.13)
PERIODS, TRANSIENT = 300, 100
LEAST_ANALYSED = 40  # periods after the transient below which no verdict is possible: exponents are then left out
SWEPT, TANGENTS, LATERAL = "waves.steepness", "output.tangent_vectors", "output.lateral_growth"
DIMENSIONS = ("2", "3", "auto")
MOST_RUNS = 10_000


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked: the scenes to run (by steepness) and how.

    dimensions: one of DIMENSIONS. scenes: those to begin with, planar ones for auto; spatial: those in three dimensions
    (empty for 2); push_added: whether the scene had no velocity across the waves and got one for them.
    """

    scenes: dict
    spatial: dict
    dimensions: str
    push_added: bool
    periods: int
    transient: int
    accuracy: bool
    how: cli.Running
    source: dict


def main(argv: list[str] | None = None, simulate=None) -> int:
    """The command. simulate: in place of engine.simulate, same signature. Returns the exit code (0, 1, 2 or 130)."""
    return cli.command(MODULE, argv, read_order, partial(sweep, simulate=simulate))


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is run")
    cli.add(what, "--steepness", "A B ...", "wave steepnesses kA (default: 49 values from 0.016 to 0.16)")
    cli.add(what, "--steepness-range", "LO HI COUNT", "evenly spaced steepnesses, both ends included")
    usual = {"periods": PERIODS, "transient": TRANSIENT, "scene": SCENE}
    cli.add_lengths_and_scene(what, usual, "analysis", "a third")
    three = "2, 3, or auto: 3 where the planar run released loops (default: as the scene says; the shipped one says 2)"
    cli.add(what, "--dimensions", "2|3|auto", three)
    cli.add_accuracy(what)
    cli.add_running(parser.add_argument_group("how and where"), f"results/{CAMPAIGN}")
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault, of options and scenes, is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    periods, transient = cli.lengths(options, PERIODS, TRANSIENT, 3, faults)
    steepness = _steepness(options, faults)
    how = cli.running(options, CAMPAIGN, faults)
    name = cli.scene_name(options, SCENE, faults)
    taken = {SWEPT: "use --steepness", "waves.amplitude_m": "use --steepness", "motion.dimensions": "use --dimensions"}
    changes = cli.assignments(options.set, taken, faults)
    allowed = "one of " + ", ".join(DIMENSIONS)
    dimensions = cli.value(options.dimensions, "--dimensions", None, cli.one_of(DIMENSIONS), allowed, faults)
    told = {} if dimensions is None else {"motion.dimensions": 3 if dimensions == "3" else 2}
    analysed = periods - transient >= LEAST_ANALYSED
    scenes = _scenes(name, {**changes, **told}, steepness, periods, analysed, faults)
    if dimensions is None:
        dimensions = "3" if any(scene.motion.dimensions == 3 for scene in scenes.values()) else "2"
    spatial, added = ({}, False) if dimensions == "2" or faults else _in_space(scenes, faults)
    scenes = spatial if dimensions == "3" else scenes
    source = {"scene": name, "set": changes}
    return Order(scenes, spatial, dimensions, added, periods, transient, not options.no_accuracy, how, source)


def _in_space(scenes: dict, faults: list[str]) -> tuple[dict, bool]:
    """The scenes in three dimensions, and whether any had to be given a push across the waves."""
    from campaigns.buoy_sweep.seeds import in_space
    from engine import SceneError

    found, pushed = {}, False
    for value, scene in scenes.items():
        try:
            found[value], added = in_space(scene)
        except SceneError as error:
            faults.extend(fault for fault in error.faults if fault not in faults)
            continue
        pushed = pushed or added
    return found, pushed


def _steepness(options, faults: list[str]) -> list[float]:
    if options.steepness is not None and options.steepness_range is not None:
        faults.append("--steepness and --steepness-range: given both; allowed: one of them")
    if options.steepness is not None:
        if not options.steepness:
            faults.append(f"--steepness: given nothing; allowed: one value or more, each {cli.FRACTION}")
        return cli.values(options.steepness, "--steepness", list(STEEPNESS), cli.fraction, cli.FRACTION, faults)
    if options.steepness_range is None:
        return list(STEEPNESS)
    words = options.steepness_range
    allowed = f"LO HI COUNT: two finite numbers, 0 <= LO < HI, and a whole number, 2 or above and at most {MOST_RUNS}"
    try:
        low, high, count = cli.fraction(words[0]), cli.fraction(words[1]), cli.whole(2, MOST_RUNS)(words[2])
        if len(words) != 3 or low >= high:
            raise ValueError(words)
    except (ValueError, IndexError):
        faults.append(f"--steepness-range: given {' '.join(words) or 'nothing'}; allowed: {allowed}")
        return list(STEEPNESS)
    # Twelve digits: 0.13 of a range is the 0.13 that --steepness reads, and so the same run.
    return [float(f"{low + (high - low) * step / (count - 1):.12g}") for step in range(count)]


def carries_tangents(scene) -> bool:
    """Whether the engine can carry perturbations through this scene, for exponents and a verdict on its regime."""
    implicit = scene.solver.integrator in ("esdirk43", "trbdf2")
    return implicit and scene.tether.bending_stiffness_Nm2 > 0 and scene.motion.dimensions == 2


def _growths(scene, changes: dict) -> dict:
    """The perturbations that a run is to carry where the order does not say: one in the plane and, unless the order
    wants none there, one across it.
    """
    extra = {} if TANGENTS in changes else {TANGENTS: 1}
    if LATERAL not in changes and scene.motion.dimensions == 2 and (extra or scene.output.tangent_vectors):
        extra[LATERAL] = True
    return extra


def _scenes(name: str, changes: dict, steepness: list[float], periods: int, analysed: bool, faults: list[str]) -> dict:
    from campaigns.machinery.plausible import doubts, endless, irregular, waveless
    from engine import SceneError, load_scene

    if lacking := list(waveless(name, changes)):
        faults.extend(lacking)
        return {}
    faults.extend(irregular(name, changes))
    scenes = {}
    for value in steepness:
        try:
            scene = load_scene(name, {**changes, SWEPT: value})
            if analysed and carries_tangents(scene) and (extra := _growths(scene, changes)):
                scene = load_scene(name, {**changes, SWEPT: value, **extra})
        except SceneError as error:
            faults.extend(fault for fault in error.faults if fault not in faults)
            continue
        found = [*doubts(scene), *endless(scene, periods * scene.waves.period_s)]
        faults.extend(line for line in found if line not in faults)
        scenes[value] = scene
    return scenes


def sweep(order: Order, argv: list[str], simulate) -> int:
    """Run it: compile, run, table, provenance, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.buoy_sweep import repeats
    from campaigns.buoy_sweep.close_up import and_close_up
    from campaigns.buoy_sweep.dimensions import run_where_needed
    from campaigns.buoy_sweep.rows import COLUMNS, buoy_row, regime_of
    from campaigns.buoy_sweep.seeds import SEED_MPS
    from campaigns.judge import LONGEST_PERIOD, STROBE_TOLERANCE
    from campaigns.machinery import session
    from campaigns.machinery.row_store import made_by
    from campaigns.machinery.runner import make_job, plan_of

    simulate_each = None
    if simulate is None:
        from engine import simulate, simulate_each
    describe = partial(buoy_row, transient_periods=order.transient, simulate=simulate)
    sources = (
        "analysis",
        "engine",
        "campaigns/buoy_sweep/rows.py",
        "campaigns/buoy_sweep/repeats.py",
        "campaigns/judge.py",
    )
    maker = made_by({"transient": order.transient}, *sources)
    plan = plan_of(order.how, simulate, describe, COLUMNS, maker, simulate_each=simulate_each)
    jobs = [
        make_job(scene, order.periods, labels={"steepness": value, "dimensions": scene.motion.dimensions})
        for value, scene in order.scenes.items()
    ]
    parameters = {
        **order.source,
        "steepness": list(order.scenes),
        "periods": order.periods,
        "transient": order.transient,
        "strobe_tolerance": STROBE_TOLERANCE,
        "longest_period": LONGEST_PERIOD,
        "dimensions": order.dimensions,
        "push_mps": SEED_MPS if order.push_added else None,
        "accuracy": order.accuracy,
    }
    runs = session.run
    if order.dimensions == "auto":
        runs = partial(run_where_needed, spatial=order.spatial, periods=order.periods)
    if order.accuracy:
        verdict = partial(regime_of, transient_periods=order.transient)
        runs = repeats.and_again(runs, order.periods, "steepness", verdict)
    runs = and_close_up(runs, order.periods)
    return session.conduct(CAMPAIGN, MODULE, argv, plan, jobs, parameters, report=order.how.report, runs=runs)
