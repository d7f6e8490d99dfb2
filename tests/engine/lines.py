"""Scenes and states for the tests against closed forms: lines without water or waves, states that no scene can express,
their energy. A state is Y (n, 6) = (eps, S, U, W, phi, kappa), as in `engine.planar.node`."""

import importlib

import numpy as np

from engine import load_scene
from engine.scales import tension_at

DRY = {"water": None, "waves": None}
STILL = {"waves": None}
WHOLE_STARTER_S = 1e-6  # of a run from a state out of equilibrium: its rates come from steps this short


def held(x, z):
    """Overrides for an upper end held at (x, z), m from the anchor."""
    return {"end": {"kind": "held", "position_m": [float(x), 0.0, float(z)]}, "buoy": None}


def free(x=0.0, z=0.0):
    """Overrides for an upper end that carries the force (x, z), N."""
    return {"end": {"kind": "free", "force_N": [float(x), 0.0, float(z)]}, "buoy": None}


def line(*parts, **tether):
    """The shipped scene with overrides: dicts of dotted keys, and keys of the tether as words."""
    changes = {}
    for part in parts:
        changes.update(part)
    changes.update({f"tether.{key}": value for key, value in tether.items()})
    return load_scene("tethered_buoy", changes)


def linear(stiffness_N):
    return {"law": "linear", "stiffness_N": float(stiffness_N)}


class Motion:
    """One simulation, stepped from outside: its state, and the arrays that the kernels take."""

    def __init__(self, scene, duration_s=1.0, start=None):
        module = importlib.import_module("engine.simulate")
        self.batch = module._Batch([scene], [duration_s])
        self.record, self.tables = self.batch.records[0], self.batch.tables
        self.status = int(self.batch.states[0]["status"])
        self.h = self.tables[self.record["grid_at"] :][: int(self.record["nodes"]) - 1]
        self.s = np.concatenate([[0.0], np.cumsum(self.h)])
        if start is not None:
            self.batch.Y[0] = self.batch.Y_before[0] = start
            self.batch.states[0]["small_steps"] = 3
            self.batch.states[0]["dt"] = WHOLE_STARTER_S / 3

    @property
    def Y(self):
        return self.batch.Y[0]

    @property
    def time_s(self):
        return float(self.batch.states[0]["t"])

    def states(self):
        """Yields (t, Y) after the first step past each output sample, the start included."""
        yield self.time_s, self.Y.copy()
        while not self.batch.done():
            self.batch.advance(1)
            yield self.time_s, self.Y.copy()

    def run(self):
        while not self.batch.done():
            self.batch.advance(1000)
        return self.batch.trajectory(0)


def equilibrium(scene):
    """The static state of a scene as a `Motion` that has not moved yet; fails where the engine finds none."""
    motion = Motion(scene)
    assert motion.status == 0, "no static equilibrium"
    return motion


def positions(Y, h):
    """Nodes (n, 2), m, of a state: the anchor, then sums of h times the mean of q = (1 + eps) t."""
    q = (1 + Y[:, 0])[:, None] * np.column_stack([np.cos(Y[:, 4]), np.sin(Y[:, 4])])
    return np.vstack([[0.0, 0.0], np.cumsum(0.5 * h[:, None] * (q[1:] + q[:-1]), axis=0)])


def mean(values):
    """Mean of the two nodes of each element."""
    return 0.5 * (values[1:] + values[:-1])


def energy(scene, Y, h):
    """Kinetic, gravity, stretching and bending energy (J) of a dry line under a linear law, without an end body.

    Kinetic, gravity and bending energy (EI kappa^2/2, right while strains are small against one) are those of element
    means, between which the box equations exchange without error; stretching is the mean of two nodes.
    """
    tether = scene.tether
    m = tether.density_kgpm3 * tether.area_m2
    V, z = mean(Y[:, 2:4]), mean(positions(Y, h)[:, 1])
    stretching = [0.5 * eps * tension_at(eps, tether.tension) for eps in Y[:, 0]]
    return np.array(
        [
            0.5 * m * np.sum(h * (V**2).sum(axis=1)),
            m * scene.gravity_mps2 * np.sum(h * z),
            np.sum(h * mean(np.array(stretching))),
            0.5 * tether.bending_stiffness_Nm2 * np.sum(np.diff(Y[:, 4]) ** 2 / h),
        ]
    )
