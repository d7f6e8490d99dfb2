"""One scene, a grid of starts: which start ends in which motion, the smallest to the worst, and what lies between.

    python -m campaigns.basins                                     kicks of the buoy along and across the waves
    python -m campaigns.basins --set water.depth_m=25 --grid 49
    python -m campaigns.basins --across vx phase --grid 25 24      when in a wave does a gust matter?

Protocol: without --scene the buoy is in 22.5 m of water, where it has two motions. The motions are found from rest,
from motions of a massless tether, and from starts spread over the grid until 24 of them find no new one. Then all other
starts run until they join a motion or settle on one of their own, at most for 160 wave periods; what has not settled by
then is counted as unsettled. Each motion is judged by a run of its own (docs/motions.md), and goes on at a tenth of
the tolerance and on a finer grid of the line. The smallest start that leads to the motion of the largest tension is
searched over its direction, and bisected in size to 1 %, on both grids. The edge state between that motion and the one
from rest is found by bisection of states. The order of the starts is drawn by --seed; nothing else is random.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from campaigns.basins.grid import PAIRS, StartGrid
from campaigns.explore.sweep import BUDGET, ONLY, columns_of, kick_speed, measures_of, tables_of
from campaigns.judge import judged_job, judged_scene
from campaigns.machinery import Job, Jobs, Plan, Summary, cli
from campaigns.study import Measures, Order, Study
from engine.views import carries_tangents
from tables import Rows

COUNT, MOVED = 15, 4.0 / 3.0  # starts along an axis; farthest place of the buoy, of its diameter
DEPTH_M = 22.5  # of the tethered buoy unless --set says otherwise: at its 21.0 m every start ends in one motion
REST = {"start.buoy_velocity_mps": [0.0, 0.0, 0.0], "start.buoy_displacement_m": [0.0, 0.0, 0.0]}


@dataclass
class Options(cli.Options):
    """The options of this campaign. grid: what the starts are, read from the first four."""

    across: list[str] = cli.option(
        "|".join(PAIRS), "what the starts differ in: velocity or place of the buoy, phase of the wave", usual=PAIRS[0]
    )
    grid: list[str] | StartGrid = cli.option("N|N M", "starts along both, or along each of the two", usual=str(COUNT))
    kick_speed: float = kick_speed("velocities go up to this both ways, m/s")
    displacement: float = cli.option(
        "M", "places go so far from that of rest both ways, m (default: 4/3 of the buoy's diameter)", cli.POSITIVE
    )
    seed: int = cli.seed("of the order of the starts, that of a scrambled Halton sequence")

    def read(self, faults: list[str]) -> None:
        """The grid in place of the words of --across and --grid."""
        across = " ".join(self.across)
        if across not in PAIRS:
            faults.append(f"--across: given {across or 'nothing'}; allowed: one of {', '.join(PAIRS)}")
            across = PAIRS[0]
        kind, words = cli.whole(2, 199), self.grid
        try:
            counts = [kind.convert(word) for word in words]
            if not 1 <= len(counts) <= 2:
                raise ValueError(words)
        except ValueError:
            faults.append(f"--grid: given {' '.join(words) or 'nothing'}; allowed: once or twice {kind.allowed}")
            counts = [COUNT]
        size = self.kick_speed
        if across == "x z":
            size = self.displacement
        self.grid = StartGrid(tuple(across.split()), (counts[0], counts[-1]), size)


def usual_size(grid: StartGrid, scene) -> float:
    """How far the starts of a grid go where no option says it."""
    if grid.across == ("x", "z"):
        return MOVED * scene.buoy.diameter_m
    from campaigns.explore.starts import kick_speed_mps

    return kick_speed_mps(None, scene)


def cases(order: Order) -> Iterator[Job]:
    """The scene from rest, judged as long as it needs; the starts follow from it (`exploration`)."""
    order.look_by_look(BUDGET)
    if order.name == STUDY.scene:
        order.changes.setdefault("water.depth_m", DEPTH_M)
    scene = order.base(REST, tell=True)
    if scene is None:
        return
    if not carries_tangents(scene):
        order.tell(f"campaigns.basins: given {order.name!r} as it is; allowed: {ONLY}")
        return
    scene = judged_scene(order, REST)
    if scene is not None:
        if order.options.grid.size is None:
            order.options.grid = replace(order.options.grid, size=usual_size(order.options.grid, scene))
        from engine.physics.sea import steepness_of  # half a second, which a list of options does not need

        labels = {"steepness": steepness_of(scene), "dimensions": scene.motion.dimensions}
        yield judged_job(order, labels, scene)


def measures(order: Order) -> Measures:
    """The rows of the judged runs: those of `campaigns.buoy_sweep`."""
    from campaigns.explore.grid import STEEPNESS

    return measures_of(order, columns_of((STEEPNESS,)))


def runs(order: Order, plan: Plan, jobs: Jobs) -> Summary:
    """In place of `runner.run`: motions, starts, smallest start and edge state, each in a folder of its own."""
    from campaigns.basins.edge import edge_state
    from campaigns.basins.exploration import Exploration
    from campaigns.basins.shocks import shocks
    from campaigns.explore.ends import confirm
    from campaigns.explore.motions import Search

    exploration = Exploration(plan, order.options.grid)
    exploration.find(jobs[0], Search(order, 0, order.options.kick_speed, order.options.seed))
    rest, *kicked = exploration.motions or [None]
    if kicked:
        worst = max(kicked, key=lambda motion: motion.tension_N)
        shocks(exploration, worst)
        edge_state(exploration, rest, worst)
    confirm(exploration)
    return exploration.write()


def parameters(order: Order) -> dict:
    options = order.options
    return {
        "across": list(options.grid.across),
        "grid": list(options.grid.counts),
        "size": options.grid.size,
        "seed": options.seed,
    }


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """The findings (`answer.sentences`)."""
    from campaigns.basins.answer import sentences

    tables = tables_of(order.how.out, "motions", "shock", "edge")  # without the last two where there is one motion
    return sentences(rows, order.options.grid.across, order.cases[0].scene, tables)


STUDY = Study(
    name="basins",
    protocol=__doc__,
    scene="tethered_buoy",
    in_waves=True,
    taken=dict.fromkeys(REST, "use --across"),
    options=Options,
    cases=cases,
    measures=measures,
    parameters=parameters,
    runs=runs,
    answer=answer,
)
main, read_order = STUDY.main, STUDY.read_order
