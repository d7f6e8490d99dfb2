"""Scene in, trajectory out: the driver of the kernels, for one scene or a batch."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from ..parameters.limits import MOST_SAMPLES, check_room
from ..scene.models import Scene
from ..trajectory import Trajectory
from ..trajectory.final_state import FinalState
from . import Run
from .going_on import fault_of

CALL_S = 0.1  # of machine code, which hears of Ctrl-C between two calls only
Progress = Callable[[float], None]
Start = Trajectory | FinalState | str | Path | None


def simulate(
    scene: Scene,
    periods: float | None = None,
    duration_s: float | None = None,
    progress: Progress | None = None,
    start: Start = None,
) -> Trajectory:
    """Simulate one scene, from its static equilibrium or from the final state of another run.

    periods      run length in wave periods (scenes with waves), or
    duration_s   run length in s
    progress     callable(fraction) called now and then, optional
    start        a Trajectory, its final_state, or its file: the run goes on from there, in time as well. With the same
                 scene (solver and output may change) it is the run that did not stop, to the last bit; another scene
                 takes the state over, and `began` of the trajectory says what was changed (`engine.run.going_on`): on
                 another grid by interpolation, from a plane into space, with another wave period or output step at
                 t = 0. `start` of the scene is not used. None: from rest
    Returns a Trajectory: status "ok", or the reason why it ended early, with the samples up to there. Bad arguments
    raise ValueError; a run never raises. Ctrl-C stops it between two samples.
    """
    ((_, found),) = simulate_each([scene], periods, duration_s, progress, [start])
    return found


def simulate_batch(
    scenes: Iterable[Scene],
    periods: float | None = None,
    duration_s: float | None = None,
    progress: Progress | None = None,
) -> list[Trajectory]:
    """Simulate scenes that differ in any parameter; each has its own steps and its own end.

    Arguments as for `simulate`; the run length in periods is taken for each scene's own wave. Returns a list.
    """
    runs = dict(simulate_each(scenes, periods, duration_s, progress))
    return [runs[i] for i in range(len(runs))]


def simulate_each(
    scenes: Iterable[Scene],
    periods: float | Iterable[float] | None = None,
    duration_s: float | None = None,
    progress: Progress | None = None,
    starts: Iterable[Start] | None = None,
    then: Callable[[int, Trajectory], tuple[Scene, float, Start] | None] | None = None,
) -> Iterator[tuple[int, Trajectory]]:
    """As `simulate_batch`, but yields (number of the scene, its Trajectory) as the runs end, in no order.

    Scenes that may share a batch run side by side in the lanes of vectors (`engine.simd`), eight at a time; the
    others one after another. The results are the same, bit for bit.

    periods      one number, or one for each scene
    starts       of each scene, as `start` of `simulate`
    then         then(number, Trajectory) -> scene, wave periods and start of a run that takes the place of the one that
                 has ended, under its number; None: none does. So lanes stay full while runs are judged one by one
    progress     callable(share of the time to simulate, of all runs that are known by now)
    """
    from . import batch

    scenes = list(scenes)
    lengths = [periods] * len(scenes) if periods is None or isinstance(periods, int | float) else list(periods)
    given = [None] * len(scenes) if starts is None else list(starts)
    waiting: dict[object, deque] = {}  # by what scenes must share to go together; None: alone
    known_s = done_s = 0.0

    def add(i, scene, periods, start, duration_s=None):
        nonlocal known_s
        length_s, start = _duration(scene, periods, duration_s), checked_start(scene, start)
        waiting.setdefault(batch.kind_of(scene), deque()).append(batch.Asked(i, scene, length_s, start))
        known_s += length_s

    def share(going_s):
        if progress is not None:
            progress(min((done_s + going_s) / known_s, 1.0))

    for i, (scene, length, start) in enumerate(zip(scenes, lengths, given, strict=True)):
        add(i, scene, length, start, duration_s)
    for kind, runs in waiting.items():  # the longest first, because lanes run empty while the last ones end
        waiting[kind] = deque(sorted(runs, key=lambda one: one.duration_s * one.scene.solver.rtol**-0.25, reverse=True))
    while waiting:
        kind = max(waiting, key=lambda one: len(waiting[one]))
        together = kind is not None and len(waiting[kind]) >= batch.LEAST
        runs = batch.run_through(waiting[kind], share) if together else _alone(waiting[kind], share)
        for asked, found in runs:
            done_s += asked.duration_s
            more = None if then is None else then(asked.number, found)
            if more is not None:
                add(asked.number, *more)
            yield asked.number, found
        if not waiting[kind]:
            del waiting[kind]


def checked_start(scene: Scene, start: Start) -> FinalState | None:
    """The state to start from. Raises ValueError for one that a run of this scene cannot go on from."""
    if start is None:
        return None
    if isinstance(start, str | Path):
        start = Trajectory.load(start)
    state = start.final_state if isinstance(start, Trajectory) else start
    if state is None:
        fault = "a run without a final state: it ended early, kept energies, or is of the paper's own scheme"
    elif isinstance(state, FinalState):
        fault = fault_of(state, scene)
    else:
        fault = f"{state!r}; allowed: a Trajectory, its final_state, or its file"
    if fault:
        raise ValueError(f"start: given {fault}")
    return state


def _alone(waiting: deque, progress: Progress) -> Iterator[tuple[object, Trajectory]]:
    """The first run of those that wait, by itself; progress: callable(seconds simulated)."""
    asked = waiting.popleft()
    scene, duration_s = asked.scene, asked.duration_s
    if scene.solver.scheme == "paper-box":
        from ..paper_box.driver import run as by_paper

        yield asked, by_paper(scene, duration_s, lambda fraction: progress(fraction * duration_s))
        return
    run = Run(scene, duration_s, asked.start)
    run.compile()
    chunk, before_s = 1, 0.0
    while not run.done():
        run.advance(chunk)
        took_s, before_s = run.wall_s - before_s, run.wall_s
        chunk = max(1, min(MOST_SAMPLES, int(chunk * min(2.0, CALL_S / max(took_s, 1e-9)))))
        progress(run.fraction() * duration_s)
    yield asked, run.trajectory()


def _duration(scene: Scene, periods: float | None, duration_s: float | None) -> float:
    if (periods is None) == (duration_s is None):
        raise ValueError("give exactly one of periods and duration_s")
    if periods is not None:
        if scene.waves is None:
            raise ValueError("periods needs a scene with waves; give duration_s")
        duration_s = periods * scene.waves.period_s
    if not (math.isfinite(duration_s) and duration_s > 0):
        raise ValueError(f"the run length must be positive and finite, given {duration_s!r} s")
    check_room(scene, duration_s)
    return float(duration_s)
