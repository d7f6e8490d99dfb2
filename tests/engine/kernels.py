"""Where tests reach the engine's kernels: this file alone knows their arguments, their work arrays and their columns.

Arrays are per node: state Y (n, 6) in a plane and (n, 13) in space, conserved C = (q, V) (n, 4) or (n, 6), places X
(n, 2) or (n, 3), water F = (velocity, local acceleration) (n, 4) or (n, 6), a Newton update D (n, 6) or (n, 12).
"""

import numpy as np
from numba import njit

from engine import arrays
from engine import run as engine_run
from engine.parameters import record_of
from engine.perturbations.exponents import carry
from engine.perturbations.lateral import COEFFICIENTS, WIDTH, lateral_stage
from engine.perturbations.tangent import Base
from engine.physics import sea_series, sea_sum
from engine.physics.ends import upper_end, upper_end_3d
from engine.physics.water import current_field, water, water_and_slopes
from engine.physics.waves import wave_field
from engine.planar import elimination as planar_elimination
from engine.planar import node as planar_node
from engine.planar import state as planar
from engine.record import STATE
from engine.spatial import elimination as spatial_elimination
from engine.spatial import node as spatial_node
from engine.spatial import state as spatial
from engine.time.energy import WIDTH as ENERGIES
from engine.time.energy import energies_of
from engine.time.newton import newton
from engine.time.status import OK
from engine.time.steps import runge_kutta_step
from engine.time.time_loop import guard_turns, hold_turn, march, next_step


def parameters_of(scene, preceding_tables=()):
    """The record of a scene, and its tables as one array; `preceding_tables` lie in front of its own."""
    tables = [np.zeros(0), *preceding_tables]
    p = record_of(scene, tables)[0]
    return p, np.concatenate(tables)


def of_kind(choice, p, *arguments):
    """What the kernel returns that is chosen by the kind of a record (`engine.compiled.by_kind`)."""
    return njit(lambda p, *others: choice(p, *others))(p, *arguments)


class Stage:
    """The kernels of one stage of a scene and their work arrays."""

    def __init__(self, scene, **changes):
        self.p, self.tables = parameters_of(scene)
        for name, value in changes.items():
            self.p[name] = value
        space = scene.motion.dimensions == 3
        self.n = int(self.p["nodes"])
        self.state, self.node = (spatial, spatial_node) if space else (planar, planar_node)
        self.eliminate = (spatial_elimination if space else planar_elimination).eliminate
        self.work = self.state.work_arrays.py_func(self.p, self.n)
        self.X, self.F, self.Q, self.E, self.D, self.C_tilde, self.sea = self.work

    def places(self, Y):
        """X of a state."""
        self.node.shape(self.p, self.tables, Y, self.Q, self.X)
        return self.X.copy()

    def water(self, t, Y):
        """F of a state at time t."""
        self.places(Y)
        water(self.p, self.tables, t, 1.0, self.X, self.F, self.sea)
        return self.F.copy()

    def conserved(self, Y):
        """C of a state."""
        C = np.zeros_like(self.C_tilde)
        self.state.conserved(self.p, Y, C)
        return C

    def energies(self, Y):
        """Kinetic, strain and gravity energy (J) of the line in a state."""
        row = np.zeros(ENERGIES)
        energies_of(self.p, self.tables, self.conserved(Y), row)
        return row[1:4]

    def update(self, cq, cv, in_motion, Y, C_tilde, F, viscosity=None, t=0.0):
        """Newton update D at a state, with the water F and the viscosity (n, 2) frozen."""
        if viscosity is not None:
            self.Q[:, -2:] = viscosity
        self.places(Y)
        stage = arrays.Stage(t, in_motion, cq, cv)
        self.C_tilde[:], self.F[:] = C_tilde, F
        self.node.node_quantities(self.p, self.tables, stage, Y, self.work)
        assert self.eliminate(self.p, self.tables, stage, Y, self.work)
        return self.D.copy()

    def newton(self, t, cq, cv, tolerance, max_iterations, Y, C_tilde):
        """Solve a stage for Y in place: (code, iterations)."""
        self.C_tilde[:] = C_tilde
        return newton(self.p, self.tables, arrays.Stage(t, 1.0, cq, cv), tolerance, max_iterations, Y, self.work)

    def lateral(self, rate, Y, K, F, dC_tilde):
        """Change dC (n, 2) = (q_y, V_y) of a stage in the plane with rates K (n, 4) for a change dC_tilde (n, 2)."""
        dC = np.zeros((self.n, 2))
        work = np.zeros((self.n, COEFFICIENTS)), np.zeros((self.n, WIDTH))
        self.places(Y)
        base = Base(0.0, rate, 1.0, Y, K)
        lateral_stage(self.p, self.tables, base, self.work._replace(F=F), dC_tilde, *work, dC)
        return dC


class SeaLine:
    """The water of a sea at the nodes of a line in a plane; its series goes on from call to call."""

    def __init__(self, scene, nodes):
        self.p, self.tables = parameters_of(scene)
        self.series = np.zeros((nodes + 1, sea_series.WIDTH))

    @property
    def summed_s(self):
        """Time of the last sum over all waves."""
        return self.series[-1, 0]

    def water(self, t, X, F=None):
        """F (nodes, 4) at places X (nodes, 2), added to F."""
        F = np.zeros((len(X), 4)) if F is None else F
        sea_series.sea_in_plane(self.p, self.tables, t, X, F, None, self.series)
        return F

    def slopes(self, t, X):
        """dF/dx and dF/dz (nodes, 8) of sea and current at places X (nodes, 2)."""
        J = np.zeros((len(X), 8))
        of_kind(water_and_slopes, self.p, self.tables, t, X, np.zeros((len(X), 4)), J, self.series)
        return J


def waves_at(scene, t, X, background=0.0):
    """F (m, 4) or (m, 6) of the waves of a scene, at places X (m, 2) or (m, 3), added to `background`."""
    p, tables = parameters_of(scene)
    X = np.ascontiguousarray(X, float)
    F = np.full((len(X), 2 * X.shape[1]), background)
    if p["sea_n"] and X.shape[1] == 2:
        SeaLine(scene, len(X)).water(t, X, F)
    elif p["sea_n"]:
        sea_sum.sea_field(p, tables, t, X, F, np.zeros((len(X) + 1, sea_sum.WIDTH)))
    else:
        wave_field(p, tables, t, X, F)
    return F


def current_at(scene, t, X, preceding_tables=()):
    """F (m, 4) or (m, 6) of the current of a scene at any places X (m, 2) or (m, 3)."""
    p, tables = parameters_of(scene, preceding_tables)
    X = np.ascontiguousarray(X, float)
    F = np.zeros((len(X), 2 * X.shape[1]))
    current_field(p, tables, t, X, F)
    return F


def upper_end_of(p, tables, t, rate, in_motion, N, V, V_tilde, F):
    """Condition e (2,) or (3,) of the upper end, its factor e_N of N, and its derivative D by V, (2, 2) or (3, 3)."""
    stage = arrays.Stage(t, in_motion, 1.0, rate)
    if len(N) == 2:
        ex, ez, e_N, xx, xz, zz = upper_end(p, tables, stage, tuple(N), tuple(V), tuple(V_tilde), F)
        return np.array([ex, ez]), e_N, np.array([[xx, xz], [xz, zz]])
    e, e_N, D = upper_end_3d(p, tables, stage, tuple(N), tuple(V), tuple(V_tilde), F)
    return np.array(e), e_N, np.array(D)[[0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(3, 3)


class Steps:
    """A run whose accepted steps are kept, chunk by chunk: T (m, 3) = (t, dt, whether it is of one stage), stages Ys
    (m, s, n, unknowns), their rates Ks (m, s, n, conserved)."""

    def __init__(self, scene, duration_s, chunk=400, **changes):
        self.inner = engine_run.Run(scene, duration_s)
        self.record, self.tables, self.state = self.inner.record, self.inner.tables, self.inner.state
        for name, value in changes.items():
            self.record[name] = value
        s = max(int(self.record["stages"]), 2)
        self.T = np.zeros((chunk, 3))
        motion = self.inner.motion
        self.Ys, self.Ks = np.zeros((chunk, s, *motion.Y.shape)), np.zeros((chunk, s, *motion.C.shape))

    def chunks(self):
        """Yield the number of steps kept, until the run is over; fails if it ends early."""
        run = self.inner
        assert self.state["status"] == OK
        while not run.done():
            self.state["trail"] = 0
            trail = arrays.Trail(self.T, self.Ys, self.Ks)
            march(self.record, self.tables, self.state, run.motion, run.output, trail, run.goal, *run.parts)
            assert self.state["status"] == OK
            yield int(self.state["trail"])

    def trail(self, first, count):
        return arrays.Trail(*(part[first : first + count] for part in (self.T, self.Ys, self.Ks)))

    def carry(self, first, count, vectors, rates):
        """Perturbations (k, n, 4) in place along kept steps; returns the growth (k,) of each, nats."""
        growth = np.zeros((1, len(vectors)))
        perturbations = vectors, rates, growth
        carry(self.record, self.tables, 1e9, count, self.trail(first, count), perturbations, None)
        return growth[0]

    def carry_lateral(self, first, count, weights, across, rates):
        """A perturbation (n, 2) across the plane in place along kept steps; returns its growth, nats."""
        growth = np.zeros(1)
        sideways = weights, across, rates, growth
        carry(self.record, self.tables, 1e9, count, self.trail(first, count), None, sideways)
        return growth[0]

    def repeat(self, t, dt, dt_before, one_stage, state, new, numbers):
        """One Runge-Kutta step from state = (Y, Y_before, C, K) into new = (Ys, Ks, C_new); returns its code.

        numbers: STATE record of `new_state`, of which the turn held of a loop is read.
        """
        work = self.inner.kind.work_arrays.py_func(self.record, len(state[0]))
        hold_turn(numbers, work.Q)
        step, motion, trial = arrays.Step(t, dt, dt_before, bool(one_stage)), arrays.Motion(*state), arrays.Trial(*new)
        return runge_kutta_step(self.record, self.tables, step, motion, trial, work)[0]

    def guard(self, state, Y):
        """After a step: (code, whether a loop was released); state: (1,) of `new_state`."""
        code, released = guard_turns(self.record, self.tables, state, Y)
        next_step(self.record, state, code, released, 1.0, 1.0)
        return code, released


def new_state():
    return np.zeros(1, STATE)[0]
