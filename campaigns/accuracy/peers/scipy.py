"""scipy's solve_ivp on the engine's own semi-discrete equations.

The box equations are discrete in space and continuous in time here. They are differential-algebraic: the rates of q and
V appear as sums over neighbouring nodes, and shear forces and curvatures have no rates. For a solver of ordinary
differential equations they are therefore turned into rates by one step of backward Euler. If a step of length e leads
from the state C to the state E(C), the rate is

    dC/dt = f(t, C) = (E(C) - C)/e,        e = 1e-7 s

E is one call of the engine's Newton method, which ends when the square of its last update is below 1e-14. The equations
are therefore exactly those of the engine: the same box, water, ends and positions. f is a function of the conserved
variables alone. It differs from its limit for e -> 0 by e/2 times the second derivative; for a motion of one radian a
second this is below 1e-7. A state that violates an algebraic equation decays at the rate 1/e. The equations are thus
stiff, and Radau and BDF are methods for stiff equations. Compiled code makes their Jacobian by differences, because
this costs less than scipy's own differences. Loops are not released.

Only solve_ivp is timed, after everything has been compiled.
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
NEWTON_TOLERANCE, MOST_ITERATIONS = 1e-14, 20
NUDGE = 1e-7  # change of a conserved variable for a column of the Jacobian
LONGEST_RUN_S = 10.0  # run time after which a solver is stopped


@kernel
def rates(p, tables, t, C, Y, work, out):
    """Put f(t, C) into out (n, conserved). Y (n, unknowns) has the guess before the call and the solution after it.

    Returns the code of Newton's method.
    """
    Q, rate = work.Q, 1.0 / RESOLVENT_S
    half = size_of(p)[1] // 2
    copy_into(work.C_tilde, C)
    code, _ = newton(p, tables, Stage(t, 1.0, rate, rate), NEWTON_TOLERANCE, MOST_ITERATIONS, Y, work)
    for k in range(C.shape[0]):
        for i in range(half):
            out[k, i] = (Q[k, STRETCH + i] - C[k, i]) / RESOLVENT_S
            out[k, half + i] = (Y[k, half + i] - C[k, half + i]) / RESOLVENT_S
    return code


@kernel
def jacobian(p, tables, t, C, Y, work, base, moved, J):
    """Put df/dC into J (n c, n c), column by column, by differences. Returns the worst code of Newton's method."""
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
    """f and its Jacobian for solve_ivp, with the number of calls.

    newton_failures: calls in which Newton's method did not converge. deadline_s: time of perf_counter at which f stops
    the solver.
    """

    def __init__(self, scene):
        run = Run(scene, scene.sample_step_s())  # at rest, with the velocities of the start
        self.status, self.record, self.tables, self.Y = run.state["status"], run.record, run.tables, run.motion.Y
        self.C0, self.size = run.motion.C, run.motion.C.shape[1]
        run.kind.conserved(self.record, self.Y, self.C0)
        self.work = run.kind.work_arrays(self.record, len(self.Y))
        self.base, self.moved = np.zeros_like(self.C0), np.zeros_like(self.C0)
        self.J = np.zeros((self.C0.size, self.C0.size))
        self.calls = self.jacobians = self.newton_failures = 0
        self.deadline_s = np.inf

    def f(self, t, C):
        if time.perf_counter() > self.deadline_s:
            raise TimeoutError
        self.calls += 1
        code = rates(self.record, self.tables, t, C.reshape(-1, self.size), self.Y, self.work, self.base)
        self.newton_failures += code != OK
        return self.base.ravel().copy()

    def jac(self, t, C):
        self.jacobians += 1
        shape = C.reshape(-1, self.size)
        code = jacobian(self.record, self.tables, t, shape, self.Y, self.work, self.base, self.moved, self.J)
        self.newton_failures += code == NEWTON_FAILED
        return self.J.copy()


def simulate(scene: Scene, duration_s: float, nodes: int, rtol: float, method: str) -> Trajectory:
    """One run of solve_ivp: a Trajectory with the places of the upper end and, if the scene has them, strain profiles.

    method: "Radau" or "BDF". rtol: relative tolerance; the absolute tolerance is rtol/100, for strains of the order
    0.04 and velocities of the order 1 m/s. nodes: of the scene. statistics: rhs_calls, jacobians, newton_failures,
    steps, and wall_s, the time of solve_ivp alone.
    """
    from scipy.integrate import solve_ivp

    equations = Equations(scene)
    if equations.status != OK:
        return nothing(scene, "statics-failed", "no static equilibrium")
    C0 = equations.C0.ravel()
    equations.f(0.0, C0)
    equations.jac(0.0, C0)
    equations.calls = equations.jacobians = equations.newton_failures = 0
    t = scene.sample_step_s() * np.arange(math.floor(duration_s / scene.sample_step_s() * (1 + 1e-12) + 1e-9) + 1)
    settings = {"method": method, "t_eval": t, "rtol": rtol, "atol": 1e-2 * rtol, "jac": equations.jac}
    status, message, solution = "ok", "", None
    start_s = time.perf_counter()
    equations.deadline_s = start_s + LONGEST_RUN_S
    try:
        solution = solve_ivp(equations.f, (0.0, t[-1]), C0, **settings)
    except TimeoutError:
        status, message = "too-slow", f"stopped after {LONGEST_RUN_S:g} s of run time"
    except (ValueError, np.linalg.LinAlgError) as error:
        status, message = "solver-failed", str(error)
    statistics = {
        "wall_s": time.perf_counter() - start_s,
        "rhs_calls": equations.calls,
        "jacobians": equations.jacobians,
        "newton_failures": equations.newton_failures,
        "steps": 0 if solution is None else solution.nlu,
    }
    if solution is None:
        return nothing(scene, status, message, **statistics)
    if not solution.success:
        status, message = "solver-failed", solution.message
    places, strain, s = _places_and_strain(solution.y.T.reshape(len(solution.t), -1, equations.size), equations)
    return as_trajectory(scene, status, message, solution.t, places, statistics, strain, s)


def _places_and_strain(C, equations):
    """Places of the upper end (m, 3), strain (m, n) and arc length (n,) from conserved variables (m, n, c)."""
    record, half = equations.record, equations.size // 2
    h = equations.tables[record["grid_at"] : record["grid_at"] + int(record["nodes"]) - 1]
    q = C[:, :, :half]
    places = np.einsum("k,mki->mi", 0.5 * h, q[:, 1:] + q[:, :-1])
    places = places if half == 3 else np.insert(places, 1, 0.0, axis=1)
    return places, np.linalg.norm(q, axis=2) - 1.0, np.concatenate([[0.0], np.cumsum(h)])
