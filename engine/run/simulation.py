"""Scene in, trajectory out: the driver of the kernels, for one scene or a batch."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from numbers import Real
from pathlib import Path

from ..parameters.limits import check_room
from ..scene.load import load_scene
from ..scene.models import Scene
from ..trajectory import Trajectory
from . import Run
from .start import Start, checked_start

Progress = Callable[[float], None]
SceneOrName = Scene | str | Path


def simulate(
    scene: SceneOrName,
    periods: float | None = None,
    duration_s: float | None = None,
    progress: Progress | None = None,
    start: Start = None,
) -> Trajectory:
    """Simulate one scene, from its static equilibrium or from the final state of another run.

    scene        a Scene, the name of a shipped one, or the path of a scene file
    periods      run length in wave periods (scenes with waves), or
    duration_s   run length in s
    progress     callable(fraction of the run), called now and then; optional
    start        a Trajectory, its final_state, or its file: the run goes on from this state and time. None: from rest
    Returns a Trajectory with status "ok", or with the reason why the run ended early and the samples up to then. Bad
    arguments raise ValueError; a run itself never raises. Ctrl-C stops it between two samples.

    If the scene is the one of the earlier run (solver and output may differ), the two runs together equal one long run
    to the last bit. Another scene takes the state over, and `began` of the trajectory says what has changed
    (`engine.run.start`): another grid gets the state by interpolation; a scene in space gets a planar state in its
    plane; with another wave period or output step the run begins at t = 0. A run with `start` does not use the section
    `start` of the scene.
    """
    ((_, trajectory),) = simulate_each([scene], periods, duration_s, progress, [start])
    return trajectory


def simulate_batch(
    scenes: Iterable[SceneOrName],
    periods: float | None = None,
    duration_s: float | None = None,
    progress: Progress | None = None,
) -> list[Trajectory]:
    """Simulate many scenes, which may differ in every parameter; each run has its own steps and its own end.

    Arguments as for `simulate`; periods are wave periods of each scene. Returns the Trajectories in the order of the
    scenes.
    """
    if isinstance(scenes, str | Path | Scene):
        raise TypeError(f"scenes: given {scenes!r}; allowed: several scenes, as in a list")
    runs = dict(simulate_each(scenes, periods, duration_s, progress))
    return [runs[i] for i in range(len(runs))]


def simulate_each(
    scenes: Iterable[SceneOrName],
    periods: float | Iterable[float] | None = None,
    duration_s: float | None = None,
    progress: Progress | None = None,
    starts: Iterable[Start] | None = None,
    then: Callable[[int, Trajectory], tuple[Scene, float, Start] | None] | None = None,
) -> Iterator[tuple[int, Trajectory]]:
    """As `simulate_batch`, but yields (number of the scene, its Trajectory) whenever a run ends, in no fixed order.

    Scenes that may share a batch run side by side in the lanes of vectors (`engine.simd`), as many as there are lanes;
    the other scenes run one after another. The results are the same in both ways, bit for bit.

    periods      one number, or one for each scene
    starts       one for each scene, as `start` of `simulate`
    then         then(number, Trajectory) -> (scene, wave periods, start) of a run that follows the run that has ended,
                 with the same number; None: no run follows. In this way lanes stay full while single runs are judged
    progress     callable(simulated time of all runs over the time to simulate, as far as it is known)
    """
    from . import batch

    if not (progress is None or callable(progress)):
        raise ValueError(f"progress: given {progress!r}; allowed: a function of one number")
    scenes = [_scene_of(scene) for scene in scenes]
    one_length = periods is None or isinstance(periods, Real | str)
    lengths = [periods] * len(scenes) if one_length else list(periods)
    starts = [None] * len(scenes) if starts is None else list(starts)
    waiting: dict[object, deque] = {}  # requests by `batch.kind_of` their scene; None: runs that go alone
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
    for kind, requests in waiting.items():  # the longest first, because lanes run empty while the last runs end
        waiting[kind] = deque(sorted(requests, key=_work, reverse=True))
    while waiting:
        kind = max(waiting, key=lambda kind: len(waiting[kind]))
        side_by_side = kind is not None and len(waiting[kind]) >= batch.LEAST
        run_through = batch.run_through if side_by_side else _alone
        for request, trajectory in run_through(waiting[kind], report):
            done_s += request.duration_s
            following = None if then is None else then(request.number, trajectory)
            if following is not None:
                add(request.number, *following)
            yield request.number, trajectory
        if not waiting[kind]:
            del waiting[kind]


def _scene_of(scene: SceneOrName) -> Scene:
    """The scene itself, or that of a name or a file. Raises SceneError, and TypeError for anything else."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, str | Path):
        return load_scene(scene)
    raise TypeError(f"scene: given {scene!r}; allowed: a Scene, the name of one, or the path of a scene file")


def _work(request: object) -> float:
    """A rough measure of the computing time of a run, to compare it with others."""
    return request.duration_s * request.scene.solver.rtol**-0.25


def _alone(waiting: deque, progress: Progress) -> Iterator[tuple[object, Trajectory]]:
    """Do the first of the waiting runs by itself; progress: callable(seconds simulated)."""
    request = waiting.popleft()
    scene, duration_s = request.scene, request.duration_s
    if scene.solver.scheme == "paper-box":
        from ..paper_box import driver

        yield request, driver.run(scene, duration_s, lambda share: progress(share * duration_s))
        return
    run = Run(scene, duration_s, request.start)
    run.finish(progress)
    yield request, run.trajectory()


def _duration(scene: Scene, periods: float | None, duration_s: float | None) -> float:
    """The length of a run in s. Raises ValueError for a length that is missing, given twice, or impossible."""
    if (periods is None) == (duration_s is None):
        raise ValueError("give exactly one of periods and duration_s")
    for name, length in (("periods", periods), ("duration_s", duration_s)):
        number = isinstance(length, Real) and not isinstance(length, bool)
        if length is not None and not (number and 0 < length < math.inf):
            raise ValueError(f"{name}: given {length!r}; allowed: a number above 0")
    if periods is not None:
        if scene.waves is None:
            raise ValueError("periods needs a scene with waves; give duration_s")
        duration_s = periods * scene.waves.period_s
    check_room(scene, duration_s)
    return float(duration_s)
