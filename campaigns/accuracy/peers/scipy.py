"""scipy's solve_ivp on the engine's own semi-discrete equations.

The box equations in space, left continuous in time, are differential-algebraic: rates of q and V appear as sums of
neighbouring nodes, shear forces and curvatures without rates at all. A solver of ordinary differential equations gets
them through the resolvent of backward Euler. With E(C) the state to which one step of length e leads from C,

    dC/dt = f(t, C) = (E(C) - C)/e,        e = 1e-7 s

E is one call of the engine's Newton method, converged until the square of its last update is 1e-14, so the equations
are those of the engine letter for letter: same box, same water, same ends, same positions. f is a function of the
conserved variables alone. It differs from the limit e -> 0 by e/2 times the second derivative, 1e-7 of a motion of one
radian a second, and whatever violates an algebraic equation decays at 1/e: stiff, which is what Radau and BDF are for.
Their Jacobian is made by differences in compiled code, which costs them less than scipy's own would. Loop releases are
no part of it.

What is timed is solve_ivp alone, after everything is compiled.
"""

import math
import time

import numpy as np

from campaigns.accuracy.peers.record import as_trajectory, nothing
from engine import Scene, Trajectory
from engine.arrays import Stage
from engine.compiled import kernel
from engine.dimensions import size_of
from engine.record import STRETCH
from engine.run import Run
from engine.simd.elementary import copy_into
from engine.time.newton import newton
from engine.time.status import NEWTON_FAILED, OK

RESOLVENT_S = 1e-7
NEWTON_TOLERANCE, MOST = 1e-14, 20
NUDGE = 1e-7
LONGEST_S = 10.0  # of run time; a solver that needs more is stopped


@kernel
def rates(p, tables, t, C, Y, work, out):
    """f(t, C) into out (n, conserved); Y (n, unknowns): guess in, solution out. Returns the code of Newton's method."""
    Q, rate = work.Q, 1.0 / RESOLVENT_S
    half = size_of(p)[1] // 2
    copy_into(work.C_tilde, C)
    code, _ = newton(p, tables, Stage(t, 1.0, rate, rate), NEWTON_TOLERANCE, MOST, Y, work)
    for k in range(C.shape[0]):
        for i in range(half):
            out[k, i] = (Q[k, STRETCH + i] - C[k, i]) / RESOLVENT_S
            out[k, half + i] = (Y[k, half + i] - C[k, half + i]) / RESOLVENT_S
    return code


@kernel
def jacobian(p, tables, t, C, Y, work, base, moved, J):
    """df/dC by differences, column by column, into J (n c, n c)."""
    code = rates(p, tables, t, C, Y, work, base)
    n, size = C.shape
    trial, shifted = Y.copy(), C.copy()
    for k in range(n):
        for i in range(size):
            copy_into(trial, Y)
            shifted[k, i] = C[k, i] + NUDGE
            code = max(code, rates(p, tables, t, shifted, trial, work, moved))
            shifted[k, i] = C[k, i]
            J[:, k * size + i] = (moved - base).ravel() / NUDGE
    return code


class Equations:
    """f and its Jacobian for solve_ivp, with counts. faults: calls in which Newton's method did not converge."""

    def __init__(self, scene):
        run = Run(scene, scene.sample_step_s())  # at rest, with the velocities of the start
        self.status, self.record, self.tables, self.Y = run.state["status"], run.record, run.tables, run.motion.Y
        self.C0, self.size = run.motion.C, run.motion.C.shape[1]
        run.kind.conserved(self.record, self.Y, self.C0)
        self.work = run.kind.work_arrays(self.record, len(self.Y))
        self.base, self.moved = np.zeros_like(self.C0), np.zeros_like(self.C0)
        self.J = np.zeros((self.C0.size, self.C0.size))
        self.calls = self.jacobians = self.faults = 0
        self.ends_s = np.inf

    def f(self, t, C):
        if time.perf_counter() > self.ends_s:
            raise TimeoutError
        self.calls += 1
        code = rates(self.record, self.tables, t, C.reshape(-1, self.size), self.Y, self.work, self.base)
        self.faults += code != OK
        return self.base.ravel().copy()

    def jac(self, t, C):
        self.jacobians += 1
        shape = C.reshape(-1, self.size)
        code = jacobian(self.record, self.tables, t, shape, self.Y, self.work, self.base, self.moved, self.J)
        self.faults += code == NEWTON_FAILED
        return self.J.copy()


def simulate(scene: Scene, duration_s: float, nodes: int, rtol: float, method: str) -> Trajectory:
    """One run of solve_ivp: a Trajectory with the upper end's places and, where the scene asks, strain profiles.

    method: "Radau" or "BDF"; rtol: its relative tolerance, the absolute one is rtol times 1e-2 (strain, m/s, of order
    0.04 and 1); nodes: those of the scene. statistics: rhs_calls, jacobians; wall_s of solve_ivp alone.
    """
    from scipy.integrate import solve_ivp

    equations = Equations(scene)
    if equations.status != OK:
        return nothing(scene, "statics-failed", "no static equilibrium")
    C0 = equations.C0.ravel()
    equations.f(0.0, C0)
    equations.jac(0.0, C0)
    equations.calls = equations.jacobians = equations.faults = 0
    t = scene.sample_step_s() * np.arange(math.floor(duration_s / scene.sample_step_s() * (1 + 1e-12) + 1e-9) + 1)
    settings = {"method": method, "t_eval": t, "rtol": rtol, "atol": 1e-2 * rtol, "jac": equations.jac}
    status, message, solution = "ok", "", None
    start_s = time.perf_counter()
    equations.ends_s = start_s + LONGEST_S
    try:
        solution = solve_ivp(equations.f, (0.0, t[-1]), C0, **settings)
    except TimeoutError:
        status, message = "too-slow", f"stopped after {LONGEST_S:g} s of run time"
    except (ValueError, np.linalg.LinAlgError) as error:
        status, message = "solver-failed", str(error)
    statistics = {
        "wall_s": time.perf_counter() - start_s,
        "rhs_calls": equations.calls,
        "jacobians": equations.jacobians,
    }
    statistics |= {"newton_failures": equations.faults, "steps": 0 if solution is None else solution.nlu}
    if solution is None:
        return nothing(scene, status, message, **statistics)
    if not solution.success:
        status, message = "solver-failed", solution.message
    places, strain, s = _lines(solution.y.T.reshape(len(solution.t), -1, equations.size), equations)
    return as_trajectory(scene, status, message, solution.t, places, statistics, strain, s)


def _lines(C, equations):
    """Upper end (m, 3), strain (m, n) and arc length (n,) of conserved variables (m, n, c)."""
    record, half = equations.record, equations.size // 2
    h = equations.tables[record["grid_at"] : record["grid_at"] + int(record["nodes"]) - 1]
    q = C[:, :, :half]
    places = np.einsum("k,mki->mi", 0.5 * h, q[:, 1:] + q[:, :-1])
    places = places if half == 3 else np.insert(places, 1, 0.0, axis=1)
    return places, np.linalg.norm(q, axis=2) - 1.0, np.concatenate([[0.0], np.cumsum(h)])
