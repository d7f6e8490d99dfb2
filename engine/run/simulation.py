"""Scene in, trajectory out: the driver of the kernels, for one scene or a batch."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator

from ..parameters.limits import MOST_SAMPLES, check_room
from ..scene.models import Scene
from ..trajectory import Trajectory
from . import Run
from .start import Start, checked_start

CALL_S = 0.1  # of machine code, which hears of Ctrl-C between two calls only
Progress = Callable[[float], None]


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
                 takes the state over, and `began` of the trajectory says what was changed (`engine.run.start`): on
                 another grid by interpolation, from a plane into space, with another wave period or output step at
                 t = 0. `start` of the scene is not used. None: from rest
    Returns a Trajectory: status "ok", or the reason why it ended early, with the samples up to there. Bad arguments
    raise ValueError; a run never raises. Ctrl-C stops it between two samples.
    """
    ((_, trajectory),) = simulate_each([scene], periods, duration_s, progress, [start])
    return trajectory


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
    starts = [None] * len(scenes) if starts is None else list(starts)
    waiting: dict[object, deque] = {}  # by what scenes must share to go together; None: alone
    known_s = done_s = 0.0

    def add(number, scene, periods, start, duration_s=None):
        nonlocal known_s
        length_s, state = _duration(scene, periods, duration_s), checked_start(scene, start)
        waiting.setdefault(batch.kind_of(scene), deque()).append(batch.Request(number, scene, length_s, state))
        known_s += length_s

    def report(going_s):
        if progress is not None:
            progress(min((done_s + going_s) / known_s, 1.0))

    for number, (scene, length, start) in enumerate(zip(scenes, lengths, starts, strict=True)):
        add(number, scene, length, start, duration_s)
    for kind, runs in waiting.items():  # the longest first, because lanes run empty while the last ones end
        waiting[kind] = deque(sorted(runs, key=_work, reverse=True))
    while waiting:
        kind = max(waiting, key=lambda kind: len(waiting[kind]))
        together = kind is not None and len(waiting[kind]) >= batch.LEAST
        run_through = batch.run_through if together else _alone
        for run, trajectory in run_through(waiting[kind], report):
            done_s += run.duration_s
            following = None if then is None else then(run.number, trajectory)
            if following is not None:
                add(run.number, *following)
            yield run.number, trajectory
        if not waiting[kind]:
            del waiting[kind]


def _work(run: object) -> float:
    """How long a run takes beside others, about."""
    return run.duration_s * run.scene.solver.rtol**-0.25


def _alone(waiting: deque, progress: Progress) -> Iterator[tuple[object, Trajectory]]:
    """The first run of those that wait, by itself; progress: callable(seconds simulated)."""
    waited = waiting.popleft()
    scene, duration_s = waited.scene, waited.duration_s
    if scene.solver.scheme == "paper-box":
        from ..paper_box import driver

        yield waited, driver.run(scene, duration_s, lambda share: progress(share * duration_s))
        return
    run = Run(scene, duration_s, waited.start)
    run.compile()
    chunk, earlier_s = 1, 0.0
    while not run.done():
        run.advance(chunk)
        call_s, earlier_s = run.wall_s - earlier_s, run.wall_s
        chunk = max(1, min(MOST_SAMPLES, int(chunk * min(2.0, CALL_S / max(call_s, 1e-9)))))
        progress(run.fraction() * duration_s)
    yield waited, run.trajectory()


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
