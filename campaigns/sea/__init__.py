"""Irregular waves: is the start forgotten, which motion does the buoy have, how many snaps are there, what is the load?

    python -m campaigns.sea                                        the paper's buoy in a sea as steep as its large wave
    python -m campaigns.sea --seeds 20 --hours 3 --starts 1        loads only
    python -m campaigns.sea --scene FILE --set waves.jonswap.significant_height_m=4
    python -m campaigns.sea --vary waves.significant_steepness 0.02 0.14 6 --vary waves.relative_width 0 0.1 5 --seeds 3

Protocol: every sea is drawn anew for each of --seeds, and runs from rest and from kicks of the buoy, with the same
waves for all starts. The run from rest gives the loads. It carries a perturbation in three seas at least, and in as
many as make up two hours, or --most-hours if that is more; the mean growth of the perturbation is the exponent of the
sea. While the exponent is within three errors of 0, twice as many seas run from rest, up to --most-hours; in a map only
where that is given. The first quarter of an hour of up to four runs, an hour in all at most, is repeated with twice the
elements and a quarter of the tolerance.
Motions of regular waves up to 1.86 times the significant height are looked for as in `campaigns.sweep`; the folds
between two of them give the forecast of a slow envelope. Kicks are drawn by --seed.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial

from campaigns.explore.grid import Grid, grid_of
from campaigns.explore.sweep import kick_speed, table_of
from campaigns.machinery import TANGENTS, Job, Jobs, Plan, Summary, cli, run
from campaigns.study import Measures, Order, Study
from engine.scene.finer import finer
from engine.views import carries_tangents
from tables import LARGE, Row, Rows, names

HEIGHT = "waves.jonswap.significant_height_m"
HEIGHTS = (
    "waves.jonswap.significant", "waves.components", "waves.significant", "waves.record", "waves.steepness",
    "waves.amplitude_m",
)  # fmt: skip
SHARE = cli.number("a number between 0 and 1", lambda value: 0.0 < value < 1.0)
AS_GIVEN, FINER = "", "finer"
SCREEN_NODES = 9
FINER_ELEMENTS, FINER_STEPS = 2, 4
FINER_HOURS, FINER_SEAS = 0.25, 4  # of each finer run, and the most of them
EXPONENT_SEAS, EXPONENT_HOURS = 3, 2.0  # with a perturbation, at least: from three seas on their scatter counts
SEEDS, MOST_HOURS = 8, 12.0


@dataclass
class Options(cli.Options):
    """The options of this campaign. grid: the keys of a map, read from --vary; without one there is one sea state."""

    vary: list = cli.option("KEY LO HI COUNT", "a key of the scene and its values, both ends included; once or twice")
    seeds: int | None = cli.option(
        "N",
        f"seas of each state, with seeds 1 to N (default: {SEEDS}; listed and measured waves are one sea)",
        cli.whole(1, 1000),
    )
    starts: int = cli.option("N", "starts in each sea: from rest, and N - 1 kicks", cli.whole(1, 100), 4)
    hours: float = cli.option("H", "length of every run after the transient, hours", cli.POSITIVE, 0.25)
    most_hours: float | None = cli.option(
        "H",
        "hours of all seas of a state, up to which more are run until its exponent is beyond three errors of 0 "
        f"(default: {MOST_HOURS:g}, in a map and for waves that are not drawn 0)",
        cli.number("a finite number, at least 0", lambda hours: 0.0 <= hours < math.inf),
    )
    transient: int = cli.option(
        "N", "peak periods left out of exponent, events and loads", cli.whole(0, cli.MOST_PERIODS), 40
    )
    kick_speed: float = kick_speed()
    seed: int = cli.seed("of the kicks")
    distance: float = cli.option("SHARE", "of the size of the motion: nearer starts are one response", SHARE, 0.05)
    window: int = cli.option("N", "peak periods of a window in which starts part or come together", cli.whole(1), 10)
    slack_share: float = cli.option("SHARE", "of the static tension: below it the line is slack", SHARE, 0.05)
    snap_share: float = cli.option("RATIO", "of the static tension: what a snap reaches", cli.POSITIVE, 1.0)
    slope: float = cli.option("M", "of the S-N curve: 3 chain, 4 to 5 wire, 13 polyester", cli.POSITIVE, 5.0)
    breaking_load: float | None = cli.option(
        "N", "minimum breaking load of the line; by default tether.breaking_load_N", cli.POSITIVE
    )
    no_regular: bool = cli.flag("leave out the regular waves beside the sea")
    screen: bool = cli.flag(
        "a look at a map in a sixth of the time: a line of nine nodes, one run from rest in each sea"
    )
    grid: Grid = field(default_factory=Grid)
    one_sea: bool = False  # whether no seed draws other waves

    def read(self, faults: list[str]) -> None:
        """The keys with their values in the words of --vary; thresholds that contradict each other."""
        if self.screen:
            self.starts = 1
        self.grid = grid_of(self.vary or [], faults)
        if not self.slack_share < self.snap_share:
            allowed = f"above --slack-share {self.slack_share:g}"
            faults.append(f"--snap-share: given {self.snap_share:g}; allowed: {allowed}")


def kicks(options: Options, scene) -> list[tuple]:
    """Velocities (x, z) of the starts in m/s: rest, then even in a disc."""
    import numpy as np

    from campaigns.explore.starts import kick_speed_mps

    rng, fastest_mps = np.random.default_rng(options.seed), kick_speed_mps(options.kick_speed, scene)
    velocities = [(0.0, 0.0)]
    for _ in range(options.starts - 1):
        speed, angle = fastest_mps * math.sqrt(rng.random()), 2.0 * math.pi * rng.random()
        velocities.append((round(speed * math.cos(angle), 6), round(speed * math.sin(angle), 6)))
    return velocities


def usual_sea(order: Order) -> dict:
    """What makes the shipped buoy float in a sea as steep as the paper's large wave, but for what the order says."""
    if order.name != STUDY.scene:
        return {}
    usual = {"buoy.submergence": "spherical-cap"}
    keys = *order.changes, *names(order.options.grid.columns)
    if not any(key.startswith(HEIGHTS) for key in keys):
        usual[HEIGHT] = 1.0  # other keys of the spectrum may be given without it
        base = order.base(usual | order.changes)
        if base is not None:
            from engine.physics.waves import wave_number

            k = wave_number(base.waves.period_s, base.water.depth_m, base.gravity_mps2)
            usual[HEIGHT] = round(2.0 * LARGE / k, 4)
    return usual


def cases(order: Order) -> Iterator[Job]:
    """Every start in every sea of every state; a few of a single state once more, on a finer grid."""
    options = order.options
    options.grid.refuse_set(order)
    taken = [key for key in options.grid.keys if key.name in STUDY.taken]
    for key in taken:
        order.tell(f"--vary {key.key}: this campaign sets it; {STUDY.taken[key.name]}")
    if taken:
        return
    order.changes = {**usual_sea(order), **order.changes}
    if options.screen:
        order.changes["tether.nodes"] = SCREEN_NODES
    for place in options.grid.places():
        changes, faults = options.grid.changes(place, options.grid.base(order))
        order.tell(*faults)
        scene = order.base(changes, tell=True)
        if scene is None:
            return
        if scene.end.kind != "buoy" or scene.waves is None or not scene.waves.irregular:
            allowed = f"a buoy in irregular waves, as with --set {HEIGHT}=2"
            order.tell(f"campaigns.sea: given {order.name!r} as it is; allowed: {allowed}")
            return
        # in a map, a sea of width 0 stands beside seas that are drawn
        drawn = _seed_key(scene) is not None or (scene.waves.relative_width == 0.0 and options.grid.keys)
        options.one_sea = not drawn
        if options.seeds is None:
            options.seeds = SEEDS if drawn else 1
        if options.most_hours is None:
            options.most_hours = MOST_HOURS if drawn and not options.grid.keys else 0.0
        if options.one_sea:
            for name, given, allowed in (("seeds", options.seeds, 1), ("most-hours", options.most_hours, 0)):
                if given > allowed:
                    order.tell(f"--{name}: given {given:g} for waves that are not drawn; allowed: {allowed}")
        if order.faults:
            return
        yield from _runs(order, place, range(1, options.seeds + 1), options.starts)


def seas_with_exponent(options: Options) -> int:
    """Seas of a state whose run from rest carries a perturbation, which nearly doubles the cost of the run."""
    return max(EXPONENT_SEAS, math.ceil(max(EXPONENT_HOURS, options.most_hours) / options.hours))


def finer_seas(options: Options) -> int:
    """Seas of a single state whose run from rest is repeated with finer elements and steps."""
    return min(FINER_SEAS, seas_with_exponent(options), max(1, int(options.hours / FINER_HOURS)))


def _seed_key(scene) -> str | None:
    """The key by which the waves of a scene are drawn anew; None where they are listed or measured, or a single one."""
    if scene.waves.jonswap is not None:
        return "waves.jonswap.seed"
    if scene.waves.significant_steepness is None or scene.waves.relative_width == 0.0:
        return None
    return "waves.seed"


def _runs(order: Order, place: Row, seeds: Iterable[int], starts: int) -> Iterator[Job]:
    """The runs of one sea state: its first starts in the seas of these seeds; waves that are not drawn are one sea."""
    options = order.options
    changes, _ = options.grid.changes(place, options.grid.base(order))
    base = order.base(changes)
    seed_key = _seed_key(base)
    transient_s = options.transient * base.waves.period_s
    duration_s = transient_s + options.hours * 3600.0
    for seed in seeds:
        if seed_key is None and seed > 1:
            return
        for start, (x_mps, z_mps) in enumerate(kicks(options, base)[:starts]):
            further = {}
            if seed_key is not None:
                further[seed_key] = seed
            if start > 0:
                further["start.buoy_velocity_mps"] = [x_mps, 0.0, z_mps]
            elif seed <= seas_with_exponent(options) and carries_tangents(base):
                further[TANGENTS] = 1
            scene = order.scene({**changes, **further}, duration_s)
            if scene is None:
                return
            labels = {**place, "solver": AS_GIVEN, "sea": seed, "start": start}
            labels |= {"kick_x_mps": x_mps, "kick_z_mps": z_mps}
            yield Job(labels, scene, duration_s=duration_s)
            if seed <= finer_seas(options) and start == 0 and not options.grid.keys:
                finer_scene = finer(scene, FINER_ELEMENTS, FINER_STEPS)
                finer_s = transient_s + min(options.hours, FINER_HOURS) * 3600.0
                yield Job({**labels, "solver": FINER}, finer_scene, duration_s=finer_s)


def runs(order: Order, plan: Plan, jobs: Jobs) -> Summary:
    """In place of `runner.run`: a state whose exponent has no clear sign gets twice as many seas, again and again."""
    from campaigns.sea.regular import regular_ahead
    from campaigns.sea.rows import unclear_places

    options = order.options
    if not options.no_regular:
        regular_ahead(order, plan)
    summary = run(plan, jobs)
    seeds, most = options.seeds, int(options.most_hours / options.hours)
    while seeds < most:
        unclear = unclear_places(summary.rows, options.grid.columns)
        further = range(seeds + 1, min(2 * seeds, most) + 1)
        more = []
        for place in options.grid.places():
            if tuple(place.values()) in unclear:
                more += _runs(order, place, further, 1)
        if not more:
            break
        jobs = [*jobs, *more]
        summary = run(plan, jobs).joined_to(summary)
        seeds = further[-1]
    return summary


def measures(order: Order) -> Measures:
    """A row a run (`rows.run_row`)."""
    from campaigns.sea.rows import columns_of, run_row

    options = order.options
    settings = {name: getattr(options, name) for name in ("transient", "window", "slack_share", "snap_share", "slope")}
    sources = ("analysis", "engine", "campaigns/sea/rows.py")
    return Measures(columns_of(options.grid.columns), partial(run_row, **settings), sources, settings)


def beside(order: Order) -> Iterator[Callable]:
    """What follows the runs: the motions of regular waves, then what all runs of a sea state say together."""
    from campaigns.sea.cells import write_cells
    from campaigns.sea.regular import regular_waves

    if not order.options.no_regular:
        yield partial(regular_waves, order)
    yield partial(write_cells, order)


def parameters(order: Order) -> dict:
    options = order.options
    values = {entry.name: getattr(options, entry.name) for entry in Options.offered() if entry.metadata}
    del values["vary"]
    return {"sea_keys": [key.key for key in options.grid.keys], **values}


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """The findings (`answer.sentences`)."""
    from campaigns.sea.answer import sentences
    from campaigns.sea.cells import FOLDER

    return sentences(table_of(order.how.out / FOLDER), order.options)


STUDY = Study(
    name="sea",
    protocol=__doc__,
    scene="tethered_buoy",
    taken={
        "waves.jonswap.seed": "use --seeds",
        "waves.seed": "use --seeds",
        "start.buoy_velocity_mps": "use --starts and --kick-speed",
    },
    options=Options,
    cases=cases,
    measures=measures,
    runs=runs,
    parameters=parameters,
    beside=beside,
    answer=answer,
)
main, read_order = STUDY.main, STUDY.read_order
