"""The cable in regular waves as a map of its state over one wave period, with the derivative: what orbits are found on.

    map    z -> z',  z = (C/c, K/k) at the strobe,  C = (q, V) of every node, K = dC/dt

The steps of one adaptive pass are kept (`engine.time.given_steps`): with them the map is smooth, and it repeats to the
last bit. They end at the strobe, so nothing is interpolated. The derivative carries perturbations through the same
steps by the tangent equations of the exponents (`engine.perturbations`), at their own lengths. With other first steps
the pass takes other steps, of the same tolerance: what that changes is the error of whatever is found on the map.

c makes |z| the root mean square over the nodes of stretch, and of speed by its scale. k = 100 omega c, as K follows
from C. Other steps change fine motions of the line, and with them z, by more than the motion of the buoy: `seen` takes
from z what a branch is measured in. The map is that of waves that have grown to their full height.
"""

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np

from .. import record as col
from ..arrays import Motion, Trail
from ..perturbations.abreast import carried_through
from ..planar.columns import CX, CZ, EPS, PHI, VX, VZ
from ..scene.models import Scene
from ..simd.vector import COUNT
from ..time.given_steps import BEFORE_RELEASE, march_over
from ..time.status import OK, TURN_UNRESOLVED
from ..time.time_loop import march
from ..trajectory.columns import columns_of
from ..trajectory.final_state import FinalState
from . import Idle, advice

FIRST_STEPS = 0.3, 0.2, 0.45  # of the longest step: one of every mesh
SPHERE_M = 1.5  # diameter of the paper's sphere
RATES = 100.0  # by which rates count less than their frequency says
PASSES, NEARBY = 64, 1e-3  # maps that are kept; distance of states that have one map
GRADE = 2.0  # longest step, in lengths of the next one
LEAST_SHARE = 0.3  # of the step before: a last step that is shorter shares its way with it
NEWTON = 1e-10  # the map must be smooth to below the gaps of an orbit
SPLITS = 8  # steps of a mesh that may be halved because Newton's method refuses them
ROOM = 256  # steps of a pass between two looks


def why_no_map(scene: Scene) -> str:
    """Why a scene has no period map, as the end of a sentence; empty where it has one."""
    if scene.end.kind != "buoy" or scene.waves is None or scene.waves.irregular:
        return "no buoy in regular waves"
    if scene.motion.dimensions != 2 or not scene.tether.bending_stiffness_Nm2 > 0:
        return "no line in a plane with bending stiffness"
    if scene.solver.integrator not in ("esdirk43", "trbdf2") or scene.solver.scheme == "paper-box":
        return "an integrator without error control"
    return ""


def _graded(steps: np.ndarray) -> np.ndarray:
    """Steps (l, 3) that grow shorter slowly. A pass that meets a snap goes from its longest step to its shortest at
    once; an orbit nearby meets it a little earlier, within that longest step, and its multipliers scatter ten times
    as much. The steps of a release stay as they are, and so does the one before them, at whose end it begins."""
    graded, step = [], np.inf  # from the last step back
    for begin, length, kind in steps[::-1]:
        if kind == col.RESTART:
            graded.append((begin, length, kind))
            step = np.inf
            continue
        rest = length
        while rest > 0.0:
            step = rest if rest <= 1.3 * GRADE * step else GRADE * step
            rest = rest - step if rest > step else 0.0
            graded.append((begin + rest, step, kind))
    return np.array(graded[::-1])


class PeriodMap:
    """Maps over one wave period, of a scene that depends on one number.

    scene_of : value -> Scene; SceneError or ValueError where there is none. All have one grid (n nodes).
    start : state of a run; `first` (8 n,) is it at the next whole number of periods, in the scene of `value`.
    seen : (8 n, 4); seen.T @ z is the place of the buoy and its velocity over the frequency of the waves, in metres for
    a sphere of the diameter SPHERE_M, and in proportion for another one: a model has the numbers of its prototype.
    Raises ValueError for a scene that has no such map, and ArithmeticError, with the end of a sentence, where a state
    has no image: the release of a loop begins or ends near it, or lasts over the strobe, or Newton's method fails.
    """

    meshes, abreast = len(FIRST_STEPS), COUNT  # `abreast`: perturbations that the derivative carries side by side

    def __init__(self, scene_of: Callable[[float], Scene], start: FinalState, value: float) -> None:
        if why := why_no_map(scene_of(value)):
            raise ValueError(f"a map over a wave period: {why}")
        self.scene_of, self._run = scene_of, lru_cache(16)(self._run)  # arrays of the last ones are kept
        self._maps: deque = deque(maxlen=PASSES)
        self.start = start.at_zero(with_samples=False)
        self.nodes = scene_of(value).tether.nodes
        self.scale = self._scale(value)
        self.seen = self._seen(value)
        self.trail = self.trail_of(ROOM, value)
        self.first = self.at_strobe(start, value)

    def at_strobe(self, state: FinalState, value: float) -> np.ndarray:
        """z (8 n,) of the state of a run at the next whole number of periods, in the scene of `value`."""
        z = self.packed(state)
        period_s = self.scene_of(value).waves.period_s
        return OverSteps(self, self._pass(z, value, float(state.state()["t"]) % period_s, 0))(z, value)[0]

    def packed(self, state: FinalState) -> np.ndarray:
        """z (8 n,) of a state where it is, at a strobe or not."""
        return np.concatenate([state.C.ravel(), state.K.ravel()]) / self.scale

    def step(self, z: np.ndarray, value: float) -> tuple[np.ndarray, Callable]:
        """The image (8 n,) and its derivative, V (8 n, k) -> (8 n, k), by steps of its own."""
        return self.frozen([z], value)[0](z, value)

    def frozen(self, points: Sequence[np.ndarray], value: float, mesh: int = 0) -> list[Callable]:
        """A map (z, value) -> (image, derivative) for each point, with the steps that a pass takes from there."""
        return [self._near(z, value, mesh) for z in points]

    def state_of(self, z: np.ndarray, value: float) -> FinalState:
        """The state, at t = 0, for a run to go on from; its curvatures and shear forces are those of `start`."""
        (image,) = self.frozen([z], value)
        image(z, value)
        run, (C, K) = self._run(value), self._unpacked(z)
        Y, row = self._unknowns(C), image.samples[:1].copy()
        state = replace(self.start, scene=self.scene_of(value), Y=Y, Y_before=Y.copy(), C=C, K=K, samples=row)
        first_step = FIRST_STEPS[0] * float(run.record["max_step"])
        begin = {"t": 0.0, "window_end": 0.0, "corner": 0.0, "dt": first_step, "dt_before": 0.0, "small_steps": 0}
        return state.with_numbers(**begin, first=0, samples=1, low=row[0, col.TOP], high=row[0, col.TOP])

    def history(self, points: Sequence[np.ndarray], value: float) -> dict[str, np.ndarray]:
        """Columns of a trajectory (`engine.trajectory.COLUMNS`) over the periods that begin at points of an orbit.

        The extremes between the last sample and the strobe at the end of a period are those of the next first sample.
        """
        parts, at_ends = [], []
        for number, (z, image) in enumerate(zip(points, self.frozen(points, value), strict=True)):
            image(z, value)
            run = self._run(value)
            count = self.samples_of(run.scene)
            part = image.samples[:count].copy()
            part[:, col.TIME] += number * run.scene.waves.period_s
            parts.append(part)
            at_ends.append(image.samples[count, [col.TOP_LOW, col.TOP_HIGH, col.FOOT_HIGH]])
        for part, (low, high, foot) in zip(parts, [at_ends[-1], *at_ends[:-1]], strict=True):
            part[0, col.TOP_LOW] = min(part[0, col.TOP_LOW], low)
            part[0, col.TOP_HIGH] = max(part[0, col.TOP_HIGH], high)
            part[0, col.FOOT_HIGH] = max(part[0, col.FOOT_HIGH], foot)
        return columns_of(np.concatenate(parts), run.scene)

    def _run(self, value: float) -> Idle:
        """Arrays of the scene of a value; the last ones are kept."""
        scene = self.scene_of(value)
        if scene.tether.nodes != self.nodes:
            raise ValueError("a map over a wave period: all scenes must have one grid")
        bare = scene.with_values("output", profiles=False, energy=False, tangent_vectors=0, lateral_growth=False)
        run = Idle(bare, scene.waves.period_s)
        run.record["output_step"] = scene.waves.period_s / self.samples_of(scene)
        run.record["newton_tolerance"] = min(NEWTON, float(run.record["newton_tolerance"]))
        run.record["ramp"] = 0.0
        return run

    def samples_of(self, scene: Scene) -> int:
        """Samples of a period in `history`."""
        return max(round(scene.waves.period_s / scene.sample_step_s()), 1)

    def _scale(self, value: float) -> np.ndarray:
        """c and k (8 n,)."""
        run = self._run(value)
        speed = 1.0 / float(run.record["per_speed"])
        c = np.tile(np.array([1.0, 1.0, speed, speed]) * math.sqrt(self.nodes), self.nodes)
        return np.concatenate([c, c * RATES * 2.0 * math.pi / run.scene.waves.period_s])

    def _seen(self, value: float) -> np.ndarray:
        run, n = self._run(value), self.nodes
        shares = np.zeros((2, n, 4, 4))
        h = col.lengths_of(run.record, run.tables)
        for i in (CX, CZ):
            shares[0, 1:, i, i] += 0.5 * h
            shares[0, :-1, i, i] += 0.5 * h
        for i in (VX, VZ):
            shares[0, -1, i, i] = run.scene.waves.period_s / (2.0 * math.pi)
        return shares.reshape(8 * n, 4) * self.scale[:, None] * (SPHERE_M / run.scene.buoy.diameter_m)

    def trail_of(self, rows: int, value: float) -> Trail:
        """Room for the stages of so many steps."""
        s, n = int(self._run(value).record["stages"]), self.nodes
        return Trail(np.zeros((rows, 3)), np.zeros((rows, s, n, 6)), np.zeros((rows, s, n, 4)))

    def _unpacked(self, z: np.ndarray) -> np.ndarray:
        """C and K (2, n, 4) of a state (8 n,)."""
        return (z * self.scale).reshape(2, self.nodes, 4)

    def _unknowns(self, C: np.ndarray) -> np.ndarray:
        """Y (n, 6) that belongs to C, but for the curvature and the shear force: a first guess of Newton's method."""
        Y = self.start.Y.copy()
        Y[:, EPS] = np.hypot(C[:, CX], C[:, CZ]) - 1.0
        turned = np.arctan2(C[:, CZ], C[:, CX])
        Y[:, PHI] = np.unwrap(turned) + 2.0 * math.pi * round((Y[0, PHI] - turned[0]) / (2.0 * math.pi))
        Y[:, VX : VZ + 1] = C[:, VX : VZ + 1]
        return Y

    def begin(self, z: np.ndarray, value: float) -> tuple[Idle, Motion]:
        """The run of a value at a state, not the first of a run, for which C would be computed."""
        run = self._run(value)
        C, K = self._unpacked(z)
        Y = self._unknowns(C)
        run.state.fill(0)
        run.state["steps"], run.state["low"] = 1, np.inf
        run.state["high"] = run.state["foot"] = -np.inf
        return run, Motion(Y, Y.copy(), C.copy(), K.copy())

    def _near(self, z: np.ndarray, value: float, mesh: int) -> Callable:
        """The map over the steps of a pass from z, or one from nearby, so that an orbit found twice is the same."""
        maps = [(np.linalg.norm(z - point), image) for key, point, image in self._maps if key == (value, mesh)]
        distance, image = min(maps, key=lambda pair: pair[0], default=(np.inf, None))
        if distance >= NEARBY:
            image = OverSteps(self, self._pass(z, value, 0.0, mesh))
            self._maps.append(((value, mesh), z, image))
        return image

    def _pass(self, z: np.ndarray, value: float, begin_s: float, mesh: int) -> np.ndarray:
        """Begin and length, in wave periods, and kind (l, 3) of the steps that an adaptive pass takes to the strobe."""
        run, motion = self.begin(z, value)
        state, period_s, taken = run.state, run.scene.waves.period_s, []
        state["t"], state["dt"] = begin_s, FIRST_STEPS[mesh] * float(run.record["max_step"])
        state["first"] = math.ceil(begin_s / float(run.record["output_step"]))
        until = self.samples_of(run.scene) + 1 - int(state["first"])
        while state["samples"] < until:
            state["trail"] = 0
            march(run.record, run.tables, state, motion, run.output, self.trail, until, *run.parts)
            taken.append(self.trail.T[: int(state["trail"])].copy())
            if state["status"] != OK:
                raise ArithmeticError(advice(state).partition(": ")[0])
        T = np.concatenate(taken) / np.array([period_s, period_s, 1.0])
        T = T[T[:, 0] < 1.0 - 1e-9]
        if T[-1, 2] == col.RESTART:
            raise ArithmeticError("a loop is released at the strobe")
        T[-1, 1] = 1.0 - T[-1, 0]
        if len(T) > 1 and T[-1, 1] < LEAST_SHARE * T[-2, 1] and T[-2, 2] != col.RESTART:
            half = 0.5 * (1.0 - T[-2, 0])
            T[-2:, :2] = (T[-2, 0], half), (T[-2, 0] + half, half)
        return _graded(T)


class OverSteps:
    """The map of a PeriodMap over steps (l, 3) as `_pass` gives them: (z, value) -> (image, derivative).

    A step that Newton's method refuses is halved, for good. The last image is kept, with its samples (m, 13).
    """

    def __init__(self, cable: PeriodMap, steps: np.ndarray) -> None:
        self.cable, self.steps = cable, steps
        self.last, self.result, self.samples = None, None, None

    def __call__(self, z: np.ndarray, value: float) -> tuple[np.ndarray, Callable]:
        place = z.tobytes(), value
        if place != self.last:
            self.result = self._image(z, value)
            self.last = place
        return self.result

    def _image(self, z: np.ndarray, value: float) -> tuple[np.ndarray, Callable]:
        cable = self.cable
        for split in range(SPLITS):
            run, motion = cable.begin(z, value)
            period_s = run.scene.waves.period_s
            taken = self.steps * np.array([period_s, period_s, 1.0])
            trail = cable.trail_of(len(taken), value)
            code, at = march_over(run.record, run.tables, run.state, taken, motion, run.output, trail)
            if code == TURN_UNRESOLVED:
                raise ArithmeticError("the release of a loop begins or ends")
            if run.state["max_turn"] > BEFORE_RELEASE:
                raise ArithmeticError("a loop is about to be released")
            if code == OK:
                break
            if taken[at, 2] == col.RESTART or split == SPLITS - 1:
                run.state["status"], run.state["t"], run.state["dt"] = code, *taken[at, :2]
                raise ArithmeticError(advice(run.state).partition(": ")[0])
            begin, half, kind = self.steps[at, 0], 0.5 * self.steps[at, 1], self.steps[at, 2]
            halves = (begin, half, kind), (begin + half, half, kind)
            self.steps = np.concatenate([self.steps[:at], halves, self.steps[at + 1 :]])
        self.samples = run.output.samples[: cable.samples_of(run.scene) + 1].copy()

        def derivative(V: np.ndarray) -> np.ndarray:
            changes = (np.asarray(V).T * cable.scale).reshape(-1, 2, cable.nodes, 4).transpose(1, 0, 2, 3).copy()
            changes[:, :, 0, 2:] = 0.0  # the anchor does not move
            images = np.stack(carried_through(run.record, run.tables, trail, len(taken), *changes), axis=1)
            return (images.reshape(len(images), -1) / cable.scale).T

        return np.concatenate([motion.C.ravel(), motion.K.ravel()]) / cable.scale, derivative
