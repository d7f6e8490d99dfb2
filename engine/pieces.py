"""The machine code that runs need, in pieces that processes can compile at the same time.

A piece is what one call from Python compiles. Pieces that have kernels in common are one share of the work: a process
that compiles the second of them is done in half the time.
"""

from collections.abc import Iterable, Mapping

from .parameters import record_of
from .record import ONE_STAGE
from .run import Run
from .scene.models import Scene
from .simd.cover import goes_in_lanes
from .time.status import OK

# seconds of processor time (measured, in a plane): which share is begun first, and the time left
SECONDS = {"rest": 3.2, "march": 3.5, "carry": 5.0, "advance": 7.7, "follow": 6.3, "paper-box": 3.5}
SPACE = 2.2  # of them, in three dimensions


class _Idle(Run):
    """Arrays of a run that never begins, not even at rest: only their types count."""

    def _start(self) -> None:
        self.state["status"] = OK


def pieces_of(scene: Scene, together: bool = False, carrying: bool = False) -> dict[tuple, list[tuple]]:
    """The pieces that a run from rest needs: {key of what one process compiles: keys of pieces, their names first}.

    together: whether it shares a batch with others, where it may; carrying: whether it may go on with a perturbation in
    the plane and one across it.
    """
    if scene.solver.scheme == "paper-box":
        return {("paper-box",): [("paper-box",)]}
    record = record_of(scene, [])[0]
    kind = record.dtype.names[0]
    one_stage, viscous = bool(record["method"] == ONE_STAGE), bool(record["viscous"])
    carried = (True, True) if carrying else (scene.output.tangent_vectors > 0, scene.output.lateral_growth)
    lanes = together and goes_in_lanes(scene)
    found: dict[tuple, list[tuple]] = {("alone", kind): [("rest",)]}
    own = found.setdefault(("lanes" if lanes else "alone", kind), [])
    own.append(("advance",) if lanes else ("march", one_stage, viscous, scene.output.energy))
    if any(carried):
        own.append(("follow", True, True) if lanes else ("carry", *carried))
    return found


def shares_of(scenes: Iterable[tuple]) -> list[dict[tuple, Scene]]:
    """What processes may compile side by side, the longest first: the pieces that scenes need, each with one of these.

    scenes: arguments of `pieces_of`.
    """
    found: dict[tuple, dict[tuple, Scene]] = {}
    for scene, *how in scenes:
        for share, pieces in pieces_of(scene, *how).items():
            found.setdefault(share, {}).update(dict.fromkeys(pieces, scene))
    return sorted(found.values(), key=seconds_of, reverse=True)


def seconds_of(pieces: Mapping[tuple, Scene]) -> float:
    """About how much processor time the compilation of pieces takes."""
    return sum(SECONDS[name] * (SPACE if scene.motion.dimensions == 3 else 1.0) for (name, *_), scene in pieces.items())


def compile_piece(key: tuple, scene: Scene) -> None:
    """Compile a piece, or load it compiled; no step is made, but in the paper's own scheme."""
    name, *how = key
    if name in ("carry", "follow"):
        carried = {"tangent_vectors": int(how[0]), "lateral_growth": how[1]}
        scene = scene.model_copy(update={"output": scene.output.model_copy(update=carried)})
    if name == "paper-box":
        from .paper_box.driver import run

        run(scene, scene.sample_step_s())
    elif name == "rest":
        Run(scene, 0.0)
    elif name in ("march", "carry"):
        _Idle(scene, 0.0).compile()
    else:
        from .simd.batch import Machine

        machine = Machine(idle := _Idle(scene, 0.0))
        machine.load(0, idle)
        machine.compile()
