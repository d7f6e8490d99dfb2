"""Scenes, runs and states for the tests: lines without water or waves, states that no scene can express, their forces.

A state is Y (n, 6) = (eps, S, U, W, phi, kappa) in a plane, Y (n, 13) = (eps, Sn, Sb, V, beta, O) in space.
"""

from functools import lru_cache

import numpy as np

from engine import load_scene, simulate
from engine.physics.strains import tension_at
from engine.run import Run
from tests.engine.box_equations import lifted
from tests.engine.rotations import frames

DRY = {"water": None, "waves": None}
STILL = {"waves": None}
SEA = {"waves.steepness": None, "waves.jonswap.significant_height_m": 1.6, "waves.jonswap.components": 20}
SPACE = {"motion.dimensions": 3}
QUIET = {"solver.newton_tolerance": 1e-14, "solver.max_newton_iterations": 50}  # stages solved to rounding
WHOLE_STARTER_S = 1e-6  # of a run from a state out of equilibrium: its rates come from steps this short


def held(*place, **keys):
    """Overrides for an upper end held at (x, z) or (x, y, z), m from the anchor; `more` keys of the end."""
    x, *y, z = (float(p) for p in place)
    return {"end": {"kind": "held", "position_m": [x, *(y or [0.0]), z], **keys}, "buoy": None}


def free(x=0.0, z=0.0):
    """Overrides for an upper end that carries the force (x, z), N."""
    return {"end": {"kind": "free", "force_N": [float(x), 0.0, float(z)]}, "buoy": None}


def harmonic(amplitude_m, period_s, **keys):
    """The motion of a held end that oscillates."""
    return {"law": "harmonic", "amplitude_m": amplitude_m, "period_s": period_s, **keys}


def by_table(time_s, displacement_m):
    """The motion of a held end that passes these displacements."""
    return {"law": "table", "time_s": time_s, "displacement_m": displacement_m}


def uniform(u=0.0, v=0.0, w=0.0):
    """Overrides for a uniform current, m/s."""
    return {"current": {"law": "uniform", "velocity_mps": [u, v, w]}}


def kick(u=0.0, v=0.0, w=0.0):
    """Overrides for the velocity (m/s) with which the buoy starts."""
    return {"start.buoy_velocity_mps": [u, v, w]}


def line(*parts, **tether):
    """The shipped scene with overrides: dicts of dotted keys, and keys of the tether as words."""
    changes = {}
    for part in parts:
        changes.update(part)
    changes.update({f"tether.{key}": value for key, value in tether.items()})
    return load_scene("tethered_buoy", changes)


def in_space(*parts, **tether):
    """`line` in three dimensions."""
    return line(*parts, SPACE, **tether)


@lru_cache(maxsize=32)
def ran(scene, periods=None, duration_s=None):
    """The run of a scene, which must come to its end; made once for all tests of a process that ask for it."""
    run = simulate(scene, periods, duration_s)
    assert run.status == "ok", run.message
    return run


def assert_same(one, other):
    """Two runs are the same in everything but the time they took, bit for bit."""
    assert (one.status, one.message, one.scene) == (other.status, other.message, other.scene)
    for name, column in one.columns.items():
        np.testing.assert_array_equal(column, other.columns[name], name)
    for name, value in one.statistics.items():
        assert name == "wall_s" or value == other.statistics[name], name
    for part in ("profiles", "tangent"):
        mine, theirs = getattr(one, part), getattr(other, part)
        assert (mine is None) == (theirs is None)
        for name, values in vars(mine).items() if mine is not None else ():
            np.testing.assert_array_equal(values, getattr(theirs, name), name)


def orders(sizes):
    """Slopes between neighbours of a sequence of errors, or of differences, of halved steps or elements."""
    return np.log2(np.divide(sizes[:-1], sizes[1:]))


def linear(stiffness_N):
    return {"law": "linear", "stiffness_N": float(stiffness_N)}


class Motion:
    """One simulation, stepped from outside: its state, and the arrays that the kernels take."""

    def __init__(self, scene, duration_s=1.0, start=None):
        self.scene, self.inner = scene, Run(scene, duration_s)
        self.record, self.tables = self.inner.record, self.inner.tables
        self.status = int(self.inner.state["status"])
        self.h = self.tables[self.record["grid_at"] :][: int(self.record["nodes"]) - 1]
        self.s = np.concatenate([[0.0], np.cumsum(self.h)])
        if start is not None:
            self.inner.motion.Y[:] = self.inner.motion.Y_before[:] = start
            self.inner.state["small_steps"] = 3
            self.inner.state["dt"] = WHOLE_STARTER_S / 3

    @property
    def Y(self):
        return self.inner.motion.Y

    @property
    def time_s(self):
        return float(self.inner.state["t"])

    def states(self):
        """Yields (t, Y) after the first step past each output sample, the start included."""
        yield self.time_s, self.Y.copy()
        while not self.inner.done():
            self.inner.advance(1)
            yield self.time_s, self.Y.copy()

    def run(self):
        while not self.inner.done():
            self.inner.advance(1000)
        return self.inner.trajectory()


def equilibrium(scene):
    """The static state of a scene as a `Motion` that has not moved yet; fails where the engine finds none."""
    motion = Motion(scene)
    assert motion.status == 0, "no static equilibrium"
    return motion


def axes_of(Y):
    """t, n, b of a state, (n, 3) each."""
    return frames((lifted(Y) if Y.shape[1] == 6 else Y)[:, 6:10]).transpose(1, 0, 2)


def positions(Y, h):
    """Nodes (n, 2) or (n, 3), m, of a state: the anchor, then sums of h times the mean of q = (1 + eps) t."""
    q = (1 + Y[:, :1]) * axes_of(Y)[0]
    if Y.shape[1] == 6:
        q = q[:, [0, 2]]
    return np.vstack([0 * q[:1], np.cumsum(0.5 * h[:, None] * (q[1:] + q[:-1]), axis=0)])


def forces(Y, tension):
    """Internal force N (n, 3) of a state under a law: its stiffness, N, or that part of a scene."""
    t, n, b = axes_of(Y)
    T = tension * Y[:, 0] if isinstance(tension, float) else np.array([tension_at(eps, tension) for eps in Y[:, 0]])
    shear = Y[:, 1:2] * n + (Y[:, 2:3] * b if Y.shape[1] == 13 else 0.0)
    return T[:, None] * t + shear


def mean(values):
    """Mean of the two nodes of each element."""
    return 0.5 * (values[1:] + values[:-1])
