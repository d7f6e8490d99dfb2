"""Budgets of energy and momentum of a run in a plane or in space, from its accepted steps.

Energy (J): kinetic, of line and buoy (with the buoy's added mass); gravity, of the wet weight and the lift; stretching,
int T deps; bending, EI/2 |O|^2. Power (W): drag and wave load of the buoy; drag and fluid inertia of the line; an end
that is moved. A Runge-Kutta step of rates K_i changes C = (q, V) by dt sum(b_i K_i), and the box equations hold at
every stage, so the same weights are put on the powers and the forces of the stages. Between element means the box
exchanges momentum exactly, and kinetic energy, gravity and loads against the work of N on q_t; that work is the change
of stretching and bending to second order in the element.

The water comes from the engine (it has tests of its own); the forces are those written out in `box_equations`.
"""

import numpy as np

from tests.engine.box_equations import buoy_of, elements, water_on_line, wet_weight
from tests.engine.kernels import Stage, Steps
from tests.engine.lines import axes_of, forces, mean


def in_three(pairs):
    """(q, V), or their rates, or (U, A), as (n, 3) each, from arrays of either kind."""
    if pairs.shape[1] == 4:
        pairs = np.insert(pairs, [1, 3], 0.0, axis=1)
    return pairs[:, :3], pairs[:, 3:]


class Books:
    """The books of one scene."""

    def __init__(self, scene):
        self.scene, self.stage = scene, Stage(scene)
        self.h, self.weight = elements(scene), wet_weight(scene)
        self.m = scene.tether.density_kgpm3 * scene.tether.area_m2
        if scene.buoy:
            self.M, self.lift, self.drag, self.load = buoy_of(scene)

    def velocity(self, Y):
        return in_three(self.stage.conserved(Y))[1]

    def energy(self, Y):
        """J: kinetic, gravity, stretching, bending."""
        V, X, h = self.velocity(Y), self.stage.places(Y), self.h[:, None]
        law, turn = self.scene.tether.tension, Y[:, 5:6] if Y.shape[1] == 6 else Y[:, 11:]
        kinetic = 0.5 * self.m * np.sum(h * mean(V) ** 2)
        if self.scene.buoy:
            kinetic += 0.5 * self.M * np.sum(V[-1] ** 2)
        assert law.law == "linear"
        stretching = np.sum(self.h * mean(0.5 * law.stiffness_N * Y[:, 0] ** 2))
        bending = 0.5 * self.scene.tether.bending_stiffness_Nm2 * np.sum(h * mean(turn) ** 2)
        gravity = self.weight[2] * np.sum(self.h * mean(X[:, -1]))
        gravity -= X[-1, -1] * self.lift[2] if self.scene.buoy else 0.0
        return np.array([kinetic, gravity, stretching, bending])

    def rates(self, t, Y, K):
        """Powers (W) and forces (N, (., 3)) from outside on line and buoy, and the work on the line within (W).

        powers: drag of the buoy, wave load of the buoy, drag of the line, fluid inertia of the line, other ends.
        forces: weight of the line, drag and inertia of the line, upper end, anchor. Last: mean(N) . mean(q_t).
        """
        (q_t, V_t), (U, A), V = in_three(K), in_three(self.stage.water(t, Y)), self.velocity(Y)
        N, axis, h = forces(Y, self.scene.tether.tension), axes_of(Y)[0], self.h[:, None]
        drag, push = water_on_line(self.scene, 1 + Y[:, :1], axis, V - U, V_t, A)
        shares = [np.sum(h * mean(load) * mean(V)) for load in (drag, push)]
        if self.scene.buoy:
            parts = self.lift, self.drag(V[-1] - U[-1]), self.load(A[-1])
            powers, outer = [part @ V[-1] for part in parts[1:]] + [*shares, 0.0], sum(parts)
        else:
            powers, outer = [0.0, 0.0, *shares, N[-1] @ V[-1]], N[-1]
        outside = np.array([-self.weight * np.sum(self.h), np.sum(h * mean(drag + push), 0), outer, -N[0]])
        return np.array(powers), outside, np.sum(h * mean(N) * mean(q_t))

    def momentum(self, Y):
        V = self.velocity(Y)
        return self.m * np.sum(self.h[:, None] * mean(V), 0) + (self.M * V[-1] if self.scene.buoy else 0.0)


def balance(scene, duration_s):
    """Dict of running sums over the accepted Runge-Kutta steps (steps of the starter left out): arrays by step.

    t (s); energy (4), work (5), inner: changes of the energies, works of the powers, work of N on q_t (J); passed: sum
    of the sizes of the works of the single steps (J); momentum (3), impulse (3), passed_impulse (N s).
    """
    books, run = Books(scene), Steps(scene, duration_s, chunk=1)
    s, at = int(run.record["stages"]), run.record["method_at"]
    A = run.tables[at:][: s * s].reshape(s, s)
    rows = {key: [] for key in ("t", "energy", "work", "inner", "passed", "momentum", "impulse", "passed_impulse")}
    end = None
    for count in run.chunks():
        if not count or run.T[0, 2] != 0.0:
            end = None if count else end
            continue
        (t, dt, _), Ys, Ks = run.T[0], run.Ys[0], run.Ks[0]
        start = end if end is not None else (books.energy(Ys[0]), books.momentum(Ys[0]))
        found = [books.rates(t + A[i].sum() * dt, Ys[i], Ks[i]) for i in range(s)]
        powers, outside, inner = (dt * sum(A[-1, i] * found[i][j] for i in range(s)) for j in range(3))
        end = books.energy(Ys[-1]), books.momentum(Ys[-1])
        rows["t"].append(t + dt)
        rows["energy"].append(end[0] - start[0])
        rows["work"].append(powers)
        rows["inner"].append(inner)
        rows["passed"].append(np.abs(powers).sum())
        rows["momentum"].append(end[1] - start[1])
        rows["impulse"].append(outside.sum(0))
        rows["passed_impulse"].append(np.linalg.norm(outside, axis=1).sum())
    return {key: np.array(values) if key == "t" else np.cumsum(values, axis=0) for key, values in rows.items()}
