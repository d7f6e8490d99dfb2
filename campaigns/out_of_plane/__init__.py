"""Does the buoy leave the plane of the waves? Runs in three dimensions with a small push, a table, a report (fig. 20).

    python -m campaigns.out_of_plane                     both steepnesses of the paper and all that may matter
    python -m campaigns.out_of_plane --periods 60        shorter runs
    python -m campaigns.out_of_plane --set water.depth_m=22.0 solver.rtol=0.003

Protocol: the buoy is pushed at t = 0 (1e-5 m/s across the waves, as in the paper). One thing at a time is varied: the
size and the direction of the push, the depth, the bending stiffness, the nodes. Planar runs carry an infinitesimal
perturbation across their plane, whose exponent needs no push, and those with loop releases are compared with their
counterparts in three dimensions. Nothing is random.
"""

from dataclasses import asdict, dataclass, replace
from functools import partial

from campaigns.buoy_sweep.seeds import SEED_MPS, velocity
from campaigns.machinery import cli

CAMPAIGN = "out_of_plane"
MODULE = "campaigns.out_of_plane"
SCENE = "tethered_buoy"
SMALL, LARGE = 0.016, 0.13  # the paper's two waves
DEPTHS_M = (21.0, 21.6, 22.0, 22.5, 25.0)
LOOPING_DEPTHS_M = (21.0, 21.6, 22.0)  # where planar runs of the large wave have to release loops
STIFFNESSES_NM2 = (0.1, 0.4, 4.0)
NODES = (41, 81, 161)
PUSH_NODES = 81  # on 41 the rope answers a small push before the first loop by what the steps happen to be
SEEDS_MPS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
PERIODS, TRANSIENT = 250, 50
SHAPE_PERIODS, SHAPE_STEP_S = 40, 0.1
_TAKEN = {
    "waves.steepness": "it runs the paper's two",
    "waves.amplitude_m": "it runs the paper's two steepnesses",
    "waves.direction_rad": "waves run along x, pushes across them along y",
    "motion.dimensions": "three, and two for comparison",
    "start.buoy_velocity_mps": "the push is what it varies",
    "output.profiles": "it asks for them where it needs them",
    "output.profiles_step_s": "it asks for profiles where it needs them",
    "output.tangent_vectors": "its planar runs carry one",
    "output.lateral_growth": "its planar runs carry one perturbation across their plane",
}


@dataclass(frozen=True)
class Case:
    """One run: what varies over the campaign, in the words of the table. profiles: 1 keeps the shape of the rope."""

    steepness: float
    depth_m: float
    bending_stiffness_Nm2: float
    nodes: int
    dimensions: int = 3
    seed_mps: float = SEED_MPS
    seed_direction: str = "lateral"
    profiles: int = 0

    def changes(self) -> dict[str, object]:
        """The keys of the scene that make it this case."""
        keys = {
            "waves.steepness": self.steepness,
            "water.depth_m": self.depth_m,
            "tether.bending_stiffness_Nm2": self.bending_stiffness_Nm2,
            "tether.nodes": self.nodes,
            "motion.dimensions": self.dimensions,
        }
        if self.dimensions == 3:
            keys["start.buoy_velocity_mps"] = velocity(self.seed_mps, self.seed_direction)
        if self.profiles:
            keys |= {"output.profiles": True, "output.profiles_step_s": SHAPE_STEP_S}
        return keys


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked: the scene of every case, and how to run them."""

    scenes: dict
    base: Case
    periods: int
    transient: int
    accuracy: bool
    how: cli.Running
    source: dict


def main(argv: list[str] | None = None, simulate=None) -> int:
    """The command. simulate: in place of engine.simulate, same signature. Returns the exit code (0, 1, 2 or 130)."""
    return cli.command(MODULE, argv, read_order, partial(study, simulate=simulate))


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is run")
    usual = {"periods": PERIODS, "transient": TRANSIENT, "scene": SCENE}
    cli.add_lengths_and_scene(what, usual, "comparison", "a fifth")
    cli.add_accuracy(what)
    cli.add_running(parser.add_argument_group("how and where"), f"results/{CAMPAIGN}")
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault, of options and scenes, is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    periods, transient = cli.lengths(options, PERIODS, TRANSIENT, 5, faults)
    how = cli.running(options, CAMPAIGN, faults)
    name = cli.scene_name(options, SCENE, faults)
    changes = cli.assignments(options.set, _TAKEN, faults)
    base, scenes = _scenes(name, changes, periods, faults)
    source = {"scene": name, "set": changes}
    return Order(scenes, base, periods, transient, not options.no_accuracy, how, source)


def cases(base: Case) -> list[Case]:
    """Every run, each once. base: the large wave in the scene as it is; it leads, its small counterpart follows."""
    small = replace(base, steepness=SMALL)
    fine = replace(base, nodes=max(base.nodes, PUSH_NODES))
    found = [base, small]
    # the longest runs first, so that no worker is left with one at the end
    found += [replace(base, depth_m=depth, nodes=nodes) for nodes in reversed(NODES) for depth in LOOPING_DEPTHS_M]
    planar = [replace(one, dimensions=2, seed_mps=0.0, seed_direction="") for one in (base, small)]
    found += [replace(one, depth_m=depth) for one in planar for depth in (base.depth_m, *DEPTHS_M)]
    found += [replace(one, seed_mps=seed) for one in (fine, small) for seed in SEEDS_MPS]
    found += [replace(one, depth_m=depth) for one in (base, small) for depth in DEPTHS_M]
    stiffnesses = [replace(base, bending_stiffness_Nm2=stiffness) for stiffness in STIFFNESSES_NM2]
    found += [replace(one, depth_m=depth) for one in stiffnesses for depth in (base.depth_m, *DEPTHS_M)]
    found += [replace(small, bending_stiffness_Nm2=stiffness) for stiffness in STIFFNESSES_NM2]
    found += [replace(one, seed_direction=word) for one in (base, small) for word in ("mirrored", "oblique")]
    found += [replace(base, seed_direction="along")]
    found += [replace(small, nodes=nodes) for nodes in NODES]
    found += [replace(fine, profiles=1)]
    return list(dict.fromkeys(found))


def compared(case: Case, base: Case) -> bool:
    """Whether a case takes part in the comparison of planar runs with runs in three dimensions."""
    spatial = replace(base, depth_m=case.depth_m)
    planar = replace(spatial, dimensions=2, seed_mps=0.0, seed_direction="")
    return case.depth_m in LOOPING_DEPTHS_M and case in (spatial, planar)


def _scenes(name: str, changes: dict, periods: int, faults: list[str]) -> tuple[Case | None, dict]:
    from campaigns.buoy_sweep import carries_tangents
    from campaigns.machinery.plausible import doubts, endless, irregular, waveless
    from engine import SceneError, load_scene

    try:
        scene = load_scene(name, changes)
    except SceneError as error:
        faults.extend(error.faults)
        return None, {}
    if lacking := list(waveless(name, changes)):
        faults.extend(lacking)
        return None, {}
    if scene.waves.irregular:
        faults.extend(irregular(name, changes))
        return None, {}
    tether = scene.tether
    base = Case(LARGE, scene.water.depth_m, tether.bending_stiffness_Nm2, tether.nodes)
    scenes = {}
    for case in cases(base):
        try:
            made = load_scene(name, {**changes, **case.changes()})
            if carries_tangents(made):
                carried = {"output.tangent_vectors": 1, "output.lateral_growth": True}
                made = load_scene(name, {**changes, **case.changes(), **carried})
        except SceneError as error:
            faults.extend(fault for fault in error.faults if fault not in faults)
            continue
        found = [*doubts(made), *endless(made, periods * made.waves.period_s)]
        faults.extend(line for line in found if line not in faults)
        scenes[case] = made
    return base, scenes


def study(order: Order, argv: list[str], simulate) -> int:
    """Run it: compile, run, table, provenance, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.buoy_sweep import repeats
    from campaigns.machinery import session
    from campaigns.machinery.row_store import made_by
    from campaigns.machinery.runner import make_job, plan_of
    from campaigns.out_of_plane.rows import COLUMNS, offplane_row, rope_motion

    if simulate is None:
        from engine import simulate
    judged = frozenset(scene.key() for case, scene in order.scenes.items() if compared(case, order.base))
    describe = partial(offplane_row, transient_periods=order.transient, judged=judged)
    sources = (
        "analysis",
        "engine",
        "campaigns/out_of_plane/rows.py",
        "campaigns/buoy_sweep/rows.py",
        "campaigns/judge.py",
    )
    maker = made_by({"transient": order.transient, "judged": sorted(judged)}, *sources)
    plan = plan_of(order.how, simulate, describe, COLUMNS, maker)
    jobs = []
    for case, scene in order.scenes.items():
        periods = min(order.periods, SHAPE_PERIODS) if case.profiles else order.periods
        jobs.append(make_job(scene, periods, labels={**asdict(case), "periods": periods}))
    parameters = {
        **order.source,
        "base": asdict(order.base),
        "looping_depths_m": list(LOOPING_DEPTHS_M),
        "periods": order.periods,
        "transient": order.transient,
    }
    runs = session.run
    if order.accuracy:
        verdict = partial(rope_motion, transient_periods=order.transient)
        runs = repeats.and_again(runs, order.periods, "steepness", verdict, _waves(jobs, order.base))
    return session.conduct(CAMPAIGN, MODULE, argv, plan, jobs, parameters, report=order.how.report, runs=runs)


def _waves(jobs: list, base: Case) -> set[str]:
    """Keys of the runs in three dimensions from which the campaign varies: the paper's two waves."""
    wanted = [asdict(base), asdict(replace(base, steepness=SMALL))]
    return {job.key for job in jobs if {key: job.labels[key] for key in wanted[0]} in wanted}
