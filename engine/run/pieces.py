"""The machine code that runs need, in pieces that processes can compile at the same time.

A piece is what one call from Python compiles. Pieces that have kernels in common are one share of the work: a process
that compiles the second of them is done in half the time.
"""

from collections.abc import Iterable, Mapping

from ..parameters import record_of
from ..parameters.cover import goes_in_lanes
from ..record import ONE_STAGE
from ..scene.models import Scene
from . import Idle, Run

# seconds of processor time (measured, in a plane): which share is begun first
SECONDS = {"rest": 3.2, "march": 3.5, "carry": 5.0, "advance": 7.7, "follow": 6.3, "paper-box": 3.5}
SPACE = 2.2  # of them, in three dimensions


def shares_of(scenes: Iterable[tuple[Scene, bool, bool]]) -> list[dict[tuple, Scene]]:
    """What processes may compile side by side, the longest first: keys of pieces, each with a scene that needs it.

    scenes: (scene, in_batch, carrying). in_batch: whether its run shares a batch with others, where it may; carrying:
    whether it may go on with a perturbation in the plane. Runs begin at rest.
    """
    shares: dict[tuple, dict[tuple, Scene]] = {}  # keys of pieces: kind of record, what is compiled, for which runs
    for scene, in_batch, carrying in scenes:
        record = record_of(scene, [])[0]
        kind = record.dtype.names[0]
        if scene.solver.scheme == "paper-box":
            shares[("paper-box",)] = {(kind, "paper-box"): scene}
            continue
        single = shares.setdefault((False, kind), {})
        single[(kind, "rest", any(scene.start.buoy_displacement_m))] = scene
        carried = carrying or scene.output.tangent_vectors > 0, scene.output.lateral_growth
        if in_batch and goes_in_lanes(scene):
            share = shares.setdefault((True, kind), {})
            marching, following = (kind, "advance"), (kind, "follow", True, True)
        else:
            share = single
            parts = bool(record["method"] == ONE_STAGE), bool(record["viscous"]), scene.output.energy
            marching, following = (kind, "march", *parts), (kind, "carry", *carried)
        share[marching] = scene
        if any(carried):
            share[following] = scene
    return sorted(shares.values(), key=seconds_of, reverse=True)


def seconds_of(pieces: Mapping[tuple, Scene]) -> float:
    """About how much processor time the compilation of pieces takes."""
    return sum(
        SECONDS[name] * (SPACE if scene.motion.dimensions == 3 else 1.0) for (_, name, *_), scene in pieces.items()
    )


def compile_piece(key: tuple, scene: Scene) -> None:
    """Compile a piece, or load it compiled; no step is made, but in the paper's own scheme."""
    _, name, *options = key
    if name in ("carry", "follow"):
        scene = scene.with_values("output", tangent_vectors=int(options[0]), lateral_growth=options[1])
    if name == "paper-box":
        from ..paper_box import driver

        driver.run(scene, scene.sample_step_s())
    elif name == "rest":
        Run(scene, 0.0)
    elif name in ("march", "carry"):
        Idle(scene, 0.0).compile()
    else:
        from .batch import Machine

        run = Idle(scene, 0.0)
        machine = Machine(run)
        machine.load(0, run)
        machine.compile()
