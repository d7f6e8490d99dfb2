"""Scene in, trajectory out: the driver of the kernels, for one scene or a batch."""

import math
import time

import numpy as np

from . import energy, parameters
from .ends import HELD
from .exponents import Trail
from .guards import ADVICE, OK, TURN_UNRESOLVED, WORDS
from .integrators import RUNGE_KUTTA
from .march import SMALL_STEPS, STATE, march
from .planar import state as planar
from .spatial import lift
from .spatial import state as spatial
from .statics import first_guess, settle
from .trajectory import EnergyBudget, Profiles, Trajectory

PERIODS_PER_CALL = 10


def simulate(scene, periods=None, duration_s=None, progress=None):
    """Simulate one scene from its static equilibrium.

    Parameters
    ----------
    scene : Scene
    periods : float, run length in wave periods (scenes with waves), or
    duration_s : float, run length in s
    progress : callable(fraction) called now and then, optional

    Returns
    -------
    Trajectory
        status "ok", or the reason why it ended early, with the samples up to there. Bad arguments raise ValueError;
        a run never raises.
    """
    return simulate_batch([scene], periods, duration_s, progress)[0]


def simulate_batch(scenes, periods=None, duration_s=None, progress=None):
    """Simulate scenes that differ in any parameter; each has its own steps and its own end.

    Arguments as for `simulate`; the run length in periods is taken for each scene's own wave. Returns a list.
    """
    scenes = list(scenes)
    durations = [_duration(scene, periods, duration_s) for scene in scenes]
    runs = [None] * len(scenes)
    for kind in ("paper-box", 2, 3):
        chosen = [i for i, scene in enumerate(scenes) if _kind(scene) == kind]
        before = sum(run is not None for run in runs)

        count = len(chosen)

        def share(fraction, before=before, count=count):
            if progress is not None:
                progress((before + fraction * count) / len(scenes))

        group = [scenes[i] for i in chosen], [durations[i] for i in chosen]
        for i, run in zip(chosen, (_by_paper if kind == "paper-box" else _by_batch)(*group, share), strict=True):
            runs[i] = run
    return runs


def _kind(scene):
    return "paper-box" if scene.solver.scheme == "paper-box" else scene.motion.dimensions


def _by_batch(scenes, durations, progress):
    if not scenes:
        return []
    batch = _Batch(scenes, durations)
    chunk = max(1, round(PERIODS_PER_CALL * _period(scenes[0]) / float(batch.records[0]["output_step"])))
    while not batch.done():
        batch.advance(chunk)
        progress(batch.fraction())
    return [batch.trajectory(b) for b in range(len(scenes))]


def _by_paper(scenes, durations, progress):
    if not scenes:
        return []
    from .paper_box import run

    count = len(scenes)
    return [
        run(scene, duration_s, lambda fraction, done=i: progress((done + fraction) / count))
        for i, (scene, duration_s) in enumerate(zip(scenes, durations, strict=True))
    ]


def _period(scene):
    return scene.waves.period_s if scene.waves is not None else 5.0


def _duration(scene, periods, duration_s):
    if (periods is None) == (duration_s is None):
        raise ValueError("give exactly one of periods and duration_s")
    if periods is not None:
        if scene.waves is None:
            raise ValueError("periods needs a scene with waves; give duration_s")
        duration_s = periods * scene.waves.period_s
    if not (math.isfinite(duration_s) and duration_s > 0):
        raise ValueError(f"the run length must be positive and finite, given {duration_s!r} s")
    return float(duration_s)


class _Batch:
    """Arrays of a batch of scenes of one number of dimensions, padded to the longest run and the most nodes."""

    def __init__(self, scenes, durations):
        self.scenes = scenes
        self.state = spatial if scenes[0].motion.dimensions == 3 else planar
        unknowns, conserved = self.state.size_of.py_func(None)
        tables = []
        self.records = np.concatenate([parameters.record_of(scene, tables) for scene in scenes])
        self.tables = np.concatenate(tables)
        size, nodes = len(scenes), int(self.records["nodes"].max())
        ratio = np.asarray(durations) / self.records["output_step"]
        self.goals = np.floor(ratio * (1 + 1e-12) + 1e-9).astype(np.int64) + 1
        with np.errstate(divide="ignore"):
            profiled = np.where(
                self.records["profile_step"] > 0,
                np.floor(np.asarray(durations) / self.records["profile_step"] * (1 + 1e-12) + 1e-9) + 1,
                0,
            ).astype(np.int64)
        self.samples = np.zeros((size, int(self.goals.max()), 12))
        # contiguous, one by one: another layout would be another compilation of `march`, which may round otherwise
        self.profiles = [np.zeros((m, int(k), 6)) for m, k in zip(profiled, self.records["nodes"], strict=True)]
        kept = [goal if scene.output.energy else 0 for scene, goal in zip(scenes, self.goals, strict=True)]
        self.energies = [np.zeros((rows, energy.WIDTH)) for rows in kept]
        self.sums = np.zeros((size, 5))
        self.states = np.zeros(size, STATE)
        self.Y = np.zeros((size, nodes, unknowns))
        self.C = np.zeros((size, nodes, conserved))
        self.K = np.zeros((size, nodes, conserved))
        self.trails = [
            Trail(scene, record, self.tables, duration_s)
            for scene, record, duration_s in zip(scenes, self.records, durations, strict=True)
        ]
        self.walls = np.zeros(size)
        for b in range(size):
            self._start(b)
        self.Y_before = self.Y.copy()
        self.advance(-int(self.goals.max()))  # computes nothing: compilation and its cache stay out of wall_s
        self.walls = np.zeros(size)

    def _start(self, b):
        record, state, scene = self.records[b], self.states[b], self.scenes[b]
        n = int(record["nodes"])
        h = self.tables[record["grid_at"] : record["grid_at"] + n - 1]
        Y = first_guess(record, scene, h)
        target = scene.end.position_m if record["end"] == HELD else (0.0, 0.0, 0.0)
        axes = "xyz" if self.state is spatial else "xz"
        state["status"] = settle(record, self.tables, Y, np.array([target["xyz".index(axis)] for axis in axes]))
        s = np.concatenate([[0.0], np.cumsum(h)])
        for i, axis in enumerate(axes):
            Y[:, len(axes) + i] = record[f"start_{axis}"] * s / s[-1]
        self.Y[b, :n] = Y
        state["low"], state["high"] = np.inf, -np.inf
        state["min_strain"] = Y[:, 0].min()
        state["max_turn"] = lift.turns(Y).max() if self.state is spatial else np.abs(np.diff(Y[:, 4])).max()
        if state["status"] == OK and record["bent"] and state["max_turn"] > math.pi:
            state["status"] = TURN_UNRESOLVED
        # a sudden start has rates at t = 0 that are not zero: steps that need none come first, or the order falls to 1
        needs_rates = record["method"] == RUNGE_KUTTA or record["alpha_m"] != record["gamma"]
        starter = needs_rates and not record["at_rest"]
        state["small_steps"] = SMALL_STEPS if starter else 0
        state["dt"] = 1e-3 * record["max_step"] if record["adaptive"] or starter else record["fixed_step"]

    def done(self):
        return bool(np.all((self.states["status"] != OK) | (self.states["samples"] >= self.goals)))

    def fraction(self):
        ended = np.where(self.states["status"] != OK, self.goals, self.states["samples"])
        return float(ended.sum() / self.goals.sum())

    def advance(self, chunk):
        for b, record in enumerate(self.records):
            began = time.perf_counter()
            n = int(record["nodes"])
            until = min(self.goals[b], self.states[b]["samples"] + chunk)
            trail = self.trails[b]
            while True:
                march(
                    record, self.tables, self.states[b], self.Y[b, :n], self.Y_before[b, :n], self.C[b, :n],
                    self.K[b, :n], self.samples[b], self.profiles[b], self.energies[b], self.sums[b],
                    *trail.steps, until,
                )
                trail.follow(record, self.tables, self.states[b])
                if self.states[b]["status"] != OK or self.states[b]["samples"] >= until:
                    break
            self.walls[b] += time.perf_counter() - began

    def trajectory(self, b):
        record, state, scene = self.records[b], self.states[b], self.scenes[b]
        status = int(state["status"])
        message = ADVICE[status].format(
            t=float(state["t"]), dt=float(state["dt"]), turn=float(state["max_turn"]), releases=int(state["releases"])
        )
        statistics = {
            "steps": int(state["steps"]),
            "rejected_steps": int(state["rejected"]),
            "newton_iterations": int(state["newton"]),
            "newton_failures": int(state["failures"]),
            "loop_releases": int(state["releases"]),
            "max_turn_rad": float(state["max_turn"]),
            "min_strain": float(state["min_strain"]),
            "end_time_s": float(state["t"]),
            "wall_s": float(self.walls[b]),
        }
        heading = float(scene.waves.direction_rad) if self.state is spatial and scene.waves is not None else 0.0
        columns = _columns(self.samples[b, : min(int(state["samples"]), int(self.goals[b]))], heading)
        profiles, tangent = self._profiles(b, record, state), self.trails[b].growth(state)
        return Trajectory(scene, WORDS[status], message, columns, statistics, profiles, tangent, self._budget(b))

    def _budget(self, b):
        if not self.scenes[b].output.energy:
            return None
        rows = self.energies[b][: int(self.states[b]["energies"])]
        time_s, kinetic, strain, gravity, work, shear, viscous, space, powers = rows.T.copy()
        total = kinetic + strain + gravity
        return EnergyBudget(time_s, kinetic, strain, gravity, work, shear, viscous, space, powers - (total - total[:1]))

    def _profiles(self, b, record, state):
        count = int(state["profiles"])
        if self.scenes[b].output.profiles is False:
            return None
        n = int(record["nodes"])
        h = self.tables[record["grid_at"] : record["grid_at"] + n - 1]
        values = self.profiles[b][:count]
        return Profiles(
            np.arange(count) * float(record["profile_step"]),
            np.concatenate([[0.0], np.cumsum(h)]),
            *(np.ascontiguousarray(values[:, :, i]) for i in range(6)),
        )


def _columns(samples, heading):
    """Columns of the table; the angle from the vertical is taken in the plane of waves that travel along `heading`."""
    t, x, y, z, u, v, w = samples[:, :7].T
    r = np.sqrt(x**2 + y**2 + z**2) if y.any() else np.hypot(x, z)
    along, rate = (x, u) if heading == 0 else tuple(
        np.cos(heading) * a + np.sin(heading) * b for a, b in ((x, y), (u, v))
    )
    with np.errstate(invalid="ignore", divide="ignore"):
        radius_rate = (x * u + y * v + z * w) / np.where(r > 0, r, np.nan)
        square = along**2 + z**2
        angle_rate = (z * rate - along * w) / np.where(square > 0, square, np.nan)
    return {
        "time_s": t.copy(),
        "x_m": x.copy(),
        "y_m": y.copy(),
        "z_m": z.copy(),
        "radius_m": r,
        "radius_rate_mps": radius_rate,
        "angle_rad": np.unwrap(np.arctan2(along, z)),
        "angle_rate_radps": angle_rate,
        "offplane_m": samples[:, 11].copy(),
        "tension_top_N": samples[:, 7].copy(),
        "tension_min_N": samples[:, 8].copy(),
        "tension_top_low_N": samples[:, 9].copy(),
        "tension_top_high_N": samples[:, 10].copy(),
    }
