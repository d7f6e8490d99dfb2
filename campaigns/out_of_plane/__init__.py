"""Does the buoy leave the plane of the waves? Runs in three dimensions with a small push, a table, a report (fig. 20).

    python -m campaigns.out_of_plane                     both steepnesses of the paper and all that may matter
    python -m campaigns.out_of_plane --periods 60        shorter runs
    python -m campaigns.out_of_plane --set water.depth_m=22.0 solver.rtol=0.003
    python -m campaigns.out_of_plane --scene FILE        its own wave, and one of an eighth of its height

Protocol: the large wave is that of the scene, the small one is lower in the ratio of the paper's two. The buoy is
pushed at t = 0 (1e-5 m/s across the waves, as in the paper). One thing at a time is varied: the size and the direction
of the push, the depth, the bending stiffness, the nodes. A rope of another length than the paper's has one depth, that
of its scene. Planar runs carry an infinitesimal perturbation across their plane, whose exponent needs no push, and
those with loop releases are compared with their counterparts in three dimensions. Nothing is random.
"""

from argparse import SUPPRESS
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from functools import partial
from itertools import product

import engine
from campaigns.explore.space import SEED_MPS, velocity
from campaigns.explore.sweep import ROW_SOURCES
from campaigns.judge import LEAST_JUDGED, judged_scene
from campaigns.machinery import Job, Plan, Summary, cli
from campaigns.study import Lengths, Measures, Order, Study
from tables import LARGE, SMALL, Rows, number_of, read_table, typed, write_table

DEPTHS_M = (21.0, 21.6, 22.0, 22.5, 25.0)
LOOPING_DEPTHS_M = (21.0, 21.6, 22.0)  # where planar runs of the large wave have to release loops
SOFTER, STIFFER = 0.25, 10.0  # times the bending stiffness
NODES = (41, 81, 161)
PUSH_NODES = 81  # on 41 the rope answers a small push before the first loop by what the steps happen to be
SEEDS_MPS = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
SHAPE_PERIODS, SHAPE_STEP_S = 40, 0.1
_TAKEN = {
    "waves.direction_rad": "waves run along x, pushes across them along y",
    "motion.dimensions": "three, and two for comparison",
    "start.buoy_velocity_mps": "the push is what it varies",
    "output.profiles": "it asks for them where it needs them",
    "output.profiles_step_s": "it asks for profiles where it needs them",
    "output.tangent_vectors": "its planar runs carry one",
    "output.lateral_growth": "its planar runs carry one perturbation across their plane",
}


@dataclass(frozen=True)
class Variant:
    """One run: what varies over the campaign, in the words of the table. profiles: 1 keeps the shape of the rope."""

    steepness: float
    depth_m: float
    bending_stiffness_Nm2: float
    nodes: int
    dimensions: int = 3
    seed_mps: float = SEED_MPS
    seed_direction: str = "lateral"
    profiles: int = 0

    def changes(self, kick_mps: Sequence[float]) -> dict:
        """The keys of the scene that make it this variant. kick_mps: velocity at the start without a push."""
        keys = {
            "waves.amplitude_m": None,
            "waves.steepness": self.steepness,
            "water.depth_m": self.depth_m,
            "tether.bending_stiffness_Nm2": self.bending_stiffness_Nm2,
            "tether.nodes": self.nodes,
            "motion.dimensions": self.dimensions,
        }
        if self.dimensions == 3:
            push_mps = velocity(self.seed_mps, self.seed_direction)
            keys["start.buoy_velocity_mps"] = [kick + push for kick, push in zip(kick_mps, push_mps, strict=True)]
        if self.profiles:
            keys |= {"output.profiles": True, "output.profiles_step_s": SHAPE_STEP_S}
        return keys


def depths_of(order: Order) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Depths (m) that are varied, because the paper states none, and those of them where runs are compared."""
    scene = order.base()
    if scene.tether.length_m == engine.load_scene(STUDY.scene).tether.length_m:
        return DEPTHS_M, LOOPING_DEPTHS_M
    return (scene.water.depth_m,), (scene.water.depth_m,)


def variants(base: Variant, depths_m: Sequence[float], looping_depths_m: Sequence[float]) -> list[Variant]:
    """Every run, each once. base: the scene as it is, in its large wave; it leads, its small counterpart follows.

    depths_m, looping_depths_m: as of `depths_of`.
    """
    small = replace(base, steepness=base.steepness * SMALL / LARGE)
    fine = replace(base, nodes=max(base.nodes, PUSH_NODES))
    runs = [base, small]
    # the longest runs first, so that no worker is left with one at the end
    runs += varied(base, nodes=reversed(NODES), depth_m=looping_depths_m)
    all_depths_m = (base.depth_m, *depths_m)
    EI = base.bending_stiffness_Nm2
    stiffnesses_Nm2 = (SOFTER * EI, EI, STIFFER * EI)
    runs += varied(in_plane(base), in_plane(small), depth_m=all_depths_m)
    runs += varied(fine, small, seed_mps=SEEDS_MPS)
    runs += varied(base, small, depth_m=depths_m)
    runs += varied(base, bending_stiffness_Nm2=stiffnesses_Nm2, depth_m=all_depths_m)
    runs += varied(small, bending_stiffness_Nm2=stiffnesses_Nm2)
    runs += varied(base, small, seed_direction=("mirrored", "oblique"))
    runs += varied(base, seed_direction=("along",))
    runs += varied(small, nodes=NODES)
    runs += varied(fine, profiles=(1,))
    return list(dict.fromkeys(runs))


def varied(*cases: Variant, **values: Iterable) -> Iterator[Variant]:
    """Each case with every combination of these values of its fields."""
    for case, *combination in product(cases, *values.values()):
        yield replace(case, **dict(zip(values, combination, strict=True)))


def in_plane(case: Variant) -> Variant:
    """The planar run of the same scene."""
    return replace(case, dimensions=2, seed_mps=0.0, seed_direction="")


def compared(case: Variant, base: Variant, looping_depths_m: Sequence[float]) -> bool:
    """Whether a variant takes part in the comparison of planar runs with runs in three dimensions."""
    spatial = replace(base, depth_m=case.depth_m)
    return case.depth_m in looping_depths_m and case in (spatial, in_plane(spatial))


@dataclass
class Options(cli.Options):
    """The options of this campaign."""

    # It left out runs that this campaign no longer makes: hidden, and accepted because scripts of users have it.
    no_accuracy: bool = cli.flag(SUPPRESS)


def cases(order: Order) -> Iterator[Job]:
    """Every run of `variants` with its scene; planar ones carry perturbations."""
    base = base_of(order)
    if base is None:
        return
    kick_mps = order.base().start.buoy_velocity_mps
    for case in variants(base, *depths_of(order)):
        scene = judged_scene(order, case.changes(kick_mps), least=0)
        if scene is not None:
            periods = order.periods
            if case.profiles:
                periods = min(periods, SHAPE_PERIODS)
            yield Job({**asdict(case), "periods": periods}, scene, periods)


def base_of(order: Order) -> Variant | None:
    """The scene as it is, from which the campaign varies; None, and told why, where it cannot be."""
    from engine.physics.sea import steepness_of

    scene = order.base(tell=True)
    if scene is None:
        return None
    tether = scene.tether
    return Variant(steepness_of(scene), scene.water.depth_m, tether.bending_stiffness_Nm2, tether.nodes)


def measures(order: Order) -> Measures:
    """`rows.offplane_row` of every run."""
    from campaigns.out_of_plane.rows import COLUMNS, offplane_row

    base = base_of(order)
    _, looping_depths_m = depths_of(order)
    judged = set()
    for case in order.cases:
        if compared(variant(case.labels), base, looping_depths_m):
            judged.add(case.scene.key())
    row = partial(offplane_row, transient_periods=order.transient, judged=frozenset(judged))
    sources = (*ROW_SOURCES, "campaigns/out_of_plane/rows.py")
    return Measures(COLUMNS, row, sources, {"transient": order.transient, "judged": sorted(judged)})


def variant(row: Mapping[str, object]) -> Variant:
    """The variant that the labels of a case, or a row of the table, name."""
    return Variant(**{name: row[name] for name in Variant.__dataclass_fields__})


def parameters(order: Order) -> dict:
    _, looping_depths_m = depths_of(order)
    return {"base": asdict(base_of(order)), "looping_depths_m": list(looping_depths_m)}


def beside(order: Order) -> Iterator[Callable]:
    """pairs.csv, and statements.csv on figure 20."""
    base = base_of(order)
    yield partial(judge, base=base, transient=order.transient, quick=order.periods - order.transient < LEAST_JUDGED)


def judge(plan: Plan, summary: Summary, base: Variant, transient: int, quick: bool) -> float:
    """Planar runs that released loops against those in space, and the statements on figure 20; no worker's time."""
    from campaigns.out_of_plane import pairs
    from campaigns.paper.measured import Results
    from campaigns.paper.statements import claims
    from campaigns.statements import write_statements

    good = {variant(row): row for row in summary.rows if row["status"] == "ok"}
    looped = []
    for depth_m in sorted({case.depth_m for case in good}):
        spatial = good.get(replace(base, depth_m=depth_m))
        planar = good.get(in_plane(replace(base, depth_m=depth_m)))
        if spatial and planar and planar["loop_releases"]:
            looped.append(pairs.pair_row(plan.how.out, planar, spatial, transient))
    write_table(plan.how.out / "pairs.csv", pairs.COLUMNS, looped)
    results = Results(plane=read_table(plan.how.out / "table.csv"), plane_large=base.steepness)
    of_paper = []
    if base.steepness == LARGE:
        of_paper = [claim for claim in claims(quick) if "fig. 20" in claim.place]
    write_statements(plan.how.out, of_paper, results)
    return 0.0


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """How far buoy and rope leave the plane, and the paper's statements on figure 20 that do not hold."""
    from campaigns.answers import greatest, verdicts

    for steepness in sorted({row["steepness"] for row in rows}):
        good = [row for row in rows if row["steepness"] == steepness and row["status"] == "ok"]
        buoy, rope = greatest(good, "buoy_lateral_max_m"), greatest(good, "rope_lateral_max_m")
        if buoy is not None and rope is not None:
            buoy_m, rope_m = number_of(buoy, "buoy_lateral_max_m"), number_of(rope, "rope_lateral_max_m")
            words = f"kA = {steepness:.4g}: the buoy leaves the plane by at most {buoy_m:.2g} m ({_place(buoy)})"
            yield f"{words}, the rope by {rope_m:.2g} m ({_place(rope)})."
    yield from verdicts(order.how.out, quoted=4)


def _place(row: Mapping[str, object]) -> str:
    return f"H = {typed(row['depth_m'])} m, EI = {typed(row['bending_stiffness_Nm2'])} N m2, {row['nodes']} nodes"


STUDY = Study(
    name="out_of_plane",
    protocol=__doc__,
    scene="tethered_buoy",
    lengths=Lengths(periods=250, transient=50, share=5),
    in_waves=True,
    taken=_TAKEN,
    options=Options,
    cases=cases,
    measures=measures,
    parameters=parameters,
    beside=beside,
    answer=answer,
    together=False,
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
