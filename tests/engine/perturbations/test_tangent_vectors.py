"""Law: what `carry` moves along a run is the derivative of the map that its accepted steps make.

Two copies take the steps of the run, displaced by +d and -d along one direction, Newton's method driven to rounding.
Half their difference over d is the derivative, with an error of d^2 times the bend of the map plus rounding over d.
With d = 3e-7 of the scene's scales both are 1e-6 where a perturbation has grown and below 1e-4 where it has shrunk; in
a snap, where the map bends most (a factor 1e3 in growth), the first is the larger. Hence 1e-4 of the length of the
perturbation, in direction and length together. Rates, differences over a step, enter the next step as dt K and are
held to 1e-4 of what they add up to there, dC + dt dK.

Law: about a state of rest the growths are those of the linearised box equations under the integrator.

Tether and buoy lean in a steady current. The eigenvalues lambda are those of the small motions of the discrete line
(`modes`). One step of a Runge-Kutta method multiplies each by its stability function R(lambda dt), so the growths are
ln|R(lambda dt)| per dt.
What the box equations leave undetermined is gone after one step of these L-stable methods.

Growths of single vectors of an oscillating pair swing with its angle; sums of the fastest j do not, where there is a
gap behind the j-th. They then differ from the law by exp(-gap t) over the time of the average: below 1e-6 here.
"""

import numpy as np
import pytest

from engine import simulate
from engine.time.integrators import esdirk43, trbdf2
from engine.time.status import OK
from tests.engine.kernels import Stage, Steps, new_state
from tests.engine.lines import DRY, STILL, equilibrium, free, held, kick, line
from tests.engine.modes import rates
from tests.engine.physics.caps import CAP
from tests.engine.time.test_order import stability

ROUNDING = 1e-20  # Newton's tolerance: it stops once an update is below 7e-11, one more step of it from rounding


class Run(Steps):
    """A simulation of one scene, advanced chunk by chunk, its stages solved to rounding."""

    def __init__(self, scene, duration_s):
        super().__init__(scene, duration_s, newton_tolerance=ROUNDING, max_newton=40)
        self.weight = float(self.record["per_speed"]) ** 2
        self.stage = Stage(scene)

    def norm(self, dC):
        """Length of a displacement of C (n, 4), as the engine measures it."""
        return np.sqrt(np.sum(dC[:, :2] ** 2) + self.weight * np.sum(dC[:, 2:] ** 2))

    def direction(self, seed):
        """A random displacement of C of length one that leaves the anchor at rest."""
        dC = np.random.default_rng(seed).normal(size=(int(self.record["nodes"]), 4))
        dC[0, 2:] = 0.0
        return dC / self.norm(dC)

    def copies(self, apart, vectors):
        """Two copies, displaced by +-apart vectors (n, 4) from where the run is."""
        return [Copy(self, sign * apart * vectors) for sign in (1, -1)]


class Carried:
    """The engine's perturbations along a run, from vectors (k, n, 4) with rates that do not matter; `growth` (nats)
    per vector since the start."""

    def __init__(self, run, vectors):
        self.run, self.vectors = run, vectors.copy()
        self.rates, self.growth = np.zeros_like(vectors), np.zeros(len(vectors))

    def follow(self, step):
        """Along one kept step."""
        self.growth += self.run.carry(step, 1, self.vectors, self.rates)


class Copy:
    """A second state on the steps of a run, displaced by dC from where the run is."""

    def __init__(self, run, dC):
        Y = run.inner.motion.Y
        self.run, self.state, self.dt_before = run, new_state(), 0.0
        self.C, self.K, self.Y = run.stage.conserved(Y) + dC, run.inner.motion.K.copy(), Y.copy()
        turn = np.arctan2(self.C[:, 1], self.C[:, 0]) - Y[:, 4]
        self.Y[:, 4] += (turn + np.pi) % (2 * np.pi) - np.pi
        self.Y[:, 0] = np.hypot(self.C[:, 0], self.C[:, 1]) - 1
        self.Y[:, 2:4] = self.C[:, 2:]
        self.Y_before = self.Y.copy()
        self.new = np.zeros(run.Ys.shape[1:]), np.zeros(run.Ks.shape[1:]), np.zeros_like(self.C)

    def step(self, t, dt, one_stage):
        """Returns whether a loop was released after the step."""
        state = self.Y, self.Y_before, self.C, self.K
        code = self.run.repeat(t, dt, self.dt_before, one_stage, state, self.new, self.state)
        if code != OK and self.dt_before > 0.0:  # as after a step that the run had to repeat: another first guess
            code = self.run.repeat(t, dt, 0.0, one_stage, state, self.new, self.state)
        assert code == OK, f"the copy fails at {t} s"
        Ys, Ks, C_new = self.new
        self.Y_before[:], self.Y[:], self.C[:], self.K[:] = self.Y, Ys[-1], C_new, Ks[-1]
        self.state["small"] = one_stage
        code, released = self.run.guard(self.state, self.Y)
        assert code == OK
        self.dt_before = 0.0 if released else dt
        return released


APART = 3e-7
TOLERANCE = 1e-4
TAUT = {"waves.steepness": 0.016}
STEEP = {"waves.steepness": 0.13, "water.depth_m": 22.5}
TANH = {"tether.tension": {"law": "tanh", "p": [2.0e4, 5.0, 0.3, -2.0e4 * np.tanh(0.3), 1.0e4]}}
TABLE = {"tether.tension": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1, 0.3], "tension_N": [-500.0, 0.0, 3e3, 2e4]}}
HEIGHTS = np.linspace(0.0, 30.0, 16).tolist()
PROFILE = {"law": "profile", "height_m": HEIGHTS, "velocity_mps": [[0.02 * z, 0.0, 0.01 * z - 0.1] for z in HEIGHTS]}
VARIABLE = {
    "law": "table",
    "x_m": [-30.0, 30.0],
    "height_m": [0.0, 40.0],
    "time_s": [0.0, 30.0],
    "velocity_x_mps": [[[0.1, 0.3], [0.6, 1.0]], [[0.3, 0.1], [0.9, 0.7]]],
    "velocity_z_mps": [[[0.0, 0.1], [0.2, 0.0]], [[0.1, 0.0], [0.0, 0.2]]],
}
# the line leaves the water by metres; and one that lies on the bed in part, and is dragged over it
FLYING = STEEP | CAP | {"water.depth_m": 20.0, "tether.submergence": "free-surface", "tether.diameter_m": 0.3}
SOFT_BED = {"stiffness_Npm3": 1e5, "damping_Nspm3": 1e4, "friction": 0.5, "friction_speed_mps": 0.1}
ON_THE_BED = TAUT | held(17.0, 6.0) | {"floor": SOFT_BED, "tether.tension.stiffness_N": 5e3}
OTHER_WAY = {"waves.direction_rad": np.pi, "waves.phase_rad": 0.7, "waves.ramp_s": 6.0}
RUNS = {  # overrides, duration in s
    "steep, slack and snap": (STEEP, 15.0),
    "variable current, tanh law, stretched grid": (
        STEEP | TANH | {"current": VARIABLE, "tether.grid_stretching": 2.0},
        12.0,
    ),
    "no waves": (STILL | {"current": PROFILE} | kick(2.0), 10.0),
    "dry swing": (DRY | kick(2.0, 0.0, 1.0), 12.0),
    "tabulated law, wheeler": (STEEP | TABLE | {"water.depth_m": 21.0, "waves.above_still_water": "wheeler"}, 12.0),
    "in and out of the water": (
        STEEP | CAP | {"water.depth_m": 21.0, "waves.phase_rad": 0.3, "buoy.impact_loss": 0.4},
        12.0,
    ),
    "dry above, other way, phase, ramp": (
        STEEP | OTHER_WAY | {"water.depth_m": 21.0, "waves.above_still_water": "zero"},
        15.0,
    ),
    "damped": (STEEP | {"tether.damping_Ns": 2e3}, 12.0),
    "damped, free": (TAUT | free(100.0, 900.0) | {"tether.damping_Ns": 2e3}, 1.0),
    "damped, held": (TAUT | held(8.0, 17.0) | {"tether.damping_critical": 0.5}, 5.0),
    "through the surface": (FLYING | {"waves.phase_rad": 0.3}, 12.0),
    "on the bed": (ON_THE_BED, 8.0),
    "trbdf2": (STEEP | {"solver.integrator": "trbdf2"}, 12.0),
    "backward Euler": (STEEP | {"solver.integrator": "backward-euler", "water.depth_m": 21.0}, 10.0),
}


def faults(run, vectors):
    """Yield (t, fault, fault of the rates, release) after each step: carried perturbation against the two copies."""
    copies, carried = run.copies(APART, vectors), Carried(run, vectors[None])
    for count in run.chunks():
        for i in range(count):
            t, dt, one_stage = run.T[i]
            released = [copy.step(t, dt, one_stage > 0) for copy in copies]
            assert released[0] == released[1]
            carried.follow(i)
            factor = np.exp(carried.growth[0])
            dC, dK = ((getattr(copies[0], name) - getattr(copies[1], name)) / (2 * APART) for name in "CK")
            fault = run.norm(dC - factor * carried.vectors[0]) / run.norm(dC)
            of_rates = dt * run.norm(dK - factor * carried.rates[0]) / (run.norm(dC) + dt * run.norm(dK))
            yield t + dt, fault, of_rates, any(released)


@pytest.mark.parametrize("name", RUNS)
def test_carried_perturbation_is_the_derivative(name):
    overrides, duration_s = RUNS[name]
    run = Run(line(overrides, nodes=21), duration_s)
    computed = np.array(list(faults(run, run.direction(5))))
    assert computed[-1, 0] >= duration_s
    assert computed[:, 1].max() < TOLERANCE
    assert computed[:, 2].max() < TOLERANCE
    if overrides.items() >= STEEP.items():
        assert run.state["min_strain"] < 0, "the run was meant to go slack"


def test_through_a_loop_release():
    """The shipped scene in 21.6 m releases its first loop after 53 s; run and copies do so after the same step."""
    run = Run(line({"water.depth_m": 21.6}), 56.0)
    computed = np.array(list(faults(run, run.direction(5))))
    released = np.flatnonzero(computed[:, 3])
    assert len(released) == run.state["releases"] >= 1
    assert len(computed) > released[0] + 20, "the run was meant to go on after the release"
    assert computed[:, 1].max() < TOLERANCE
    assert computed[:, 2].max() < TOLERANCE


NODES, SPEED = 5, (0.8, 0.1)
SCENE = {
    "waves": None,
    "water.depth_m": 60.0,  # the soft line is twice as long at rest
    "current": {"law": "uniform", "velocity_mps": [SPEED[0], 0.0, SPEED[1]]},
    "tether.tension": {"law": "linear", "stiffness_N": 2e3},
    "buoy.drag": 4.0,
    "output.tangent_vectors": 4 * NODES,
}
SETTLED, UNTIL = 100, 200  # s


def leaning(**solver):
    return line(SCENE, {f"solver.{key}": value for key, value in solver.items()}, nodes=NODES, bending_stiffness_Nm2=24)


def growths(scene):
    """Mean growth of each vector (nats/s) once directions have settled."""
    run = simulate(scene, duration_s=UNTIL)
    assert run.status == "ok" and run.tangent.growth_nats.shape == (UNTIL, 4 * NODES)
    assert run.tangent.period_s == 1.0
    assert not run.tangent.released.any()
    return run.tangent.growth_nats[SETTLED:].mean(axis=0)


@pytest.fixture(scope="module")
def eigenvalues():
    """lambda (1/s) of small motions about the rest of the leaning line."""
    computed = rates(equilibrium(leaning()), 10.0)
    assert np.all(computed.real < 0), "the line was meant to be stable"
    return computed


@pytest.mark.parametrize(
    "method, A, step_s",
    [("esdirk43", esdirk43.A, 0.05), ("trbdf2", trbdf2.A, 0.02), ("backward-euler", np.eye(1), 0.05)],
)
def test_growths_are_those_of_the_stability_function(method, A, step_s, eigenvalues):
    decays = [np.log(abs(stability(A, A[-1], step_s * value))) / step_s for value in eigenvalues]
    expected = np.sort(decays)[::-1]
    computed = growths(leaning(integrator=method, step_s=step_s))
    count = len(expected)
    gaps = np.append(-np.diff(expected) > 0.1, True)
    assert gaps.sum() >= 5
    sums = np.cumsum(expected)[gaps], np.cumsum(computed[:count])[gaps]
    assert sums[1] == pytest.approx(sums[0], rel=1e-5)
    # nothing else is left after one step: the rest loses all but rounding in each
    assert np.all(computed[count:] < -20 / step_s)
