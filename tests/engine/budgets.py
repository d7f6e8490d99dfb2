"""Budgets of energy and momentum of a run in a plane or in space, from its accepted steps.

Energy (J): kinetic, of line and buoy (with the buoy's added mass); gravity, of the wet weight and the lift; stretching,
int T deps; bending, EI/2 |O|^2. Power (W): drag and wave load of the buoy; drag and fluid inertia of the line; an end
that is moved. A Runge-Kutta step of rates K_i changes C = (q, V) by dt sum(b_i K_i), and the box equations hold at
every stage, so the same weights are put on the powers and the forces of the stages. Between element means the box
exchanges momentum exactly, and kinetic energy, gravity and loads against the work of N on q_t; that work is the change
of stretching and bending to second order in the element.

The water comes from the engine (it has tests of its own); every force is written out here.
"""

import math
from dataclasses import dataclass

import numpy as np

from engine.parameters import record_of
from engine.planar import node as planar_node
from engine.scales import tension_at
from engine.spatial import node as spatial_node
from engine.time.time_loop import march
from tests.engine.lines import Motion
from tests.engine.spatial.lines import frames


def accepted_steps(scene, duration_s):
    """Yields (t, dt, whether it is a Runge-Kutta step, stages Y (s, n, unknowns), their rates K (s, n, conserved))."""
    motion = Motion(scene, duration_s)
    assert motion.status == 0
    run, p = motion.inner, motion.record
    n, s = int(p["nodes"]), max(int(p["stages"]), 2)
    trail = np.zeros((1, 3)), np.zeros((1, s, *run.Y.shape)), np.zeros((1, s, *run.C.shape))
    state = run.state
    assert n == run.Y.shape[0]
    while state["status"] == 0 and state["samples"] < run.goal:
        state["trail"] = 0
        march(p, run.tables, state, run.Y, run.Y_before, run.C, run.K, run.samples,
              run.profiles, run.energies, run.sums, *trail, run.goal)  # fmt: skip
        if state["trail"]:
            t, dt, kind = trail[0][0]
            yield t, dt, kind == 0.0, trail[1][0], trail[2][0]
    assert state["status"] == 0


@dataclass
class Line:
    """One state, the same in a plane and in space: vectors (n, 3)."""

    eps: np.ndarray
    t: np.ndarray
    N: np.ndarray
    V: np.ndarray
    turn: np.ndarray  # O without torsion, or kappa, (n, k)
    Y: np.ndarray


def state_of(scene, Y):
    tension = np.array([tension_at(eps, scene.tether.tension) for eps in Y[:, 0]])[:, None]
    if Y.shape[1] == 13:
        F = frames(Y[:, 6:10])
        N = tension * F[:, 0] + Y[:, 1:2] * F[:, 1] + Y[:, 2:3] * F[:, 2]
        return Line(Y[:, 0], F[:, 0], N, Y[:, 3:6], Y[:, 11:13], Y)
    zero = np.zeros(len(Y))
    t = np.stack([np.cos(Y[:, 4]), zero, np.sin(Y[:, 4])], 1)
    n = np.stack([-np.sin(Y[:, 4]), zero, np.cos(Y[:, 4])], 1)
    V = np.stack([Y[:, 2], zero, Y[:, 3]], 1)
    return Line(Y[:, 0], t, tension * t + Y[:, 1:2] * n, V, Y[:, 5:6], Y)


def in_three(rates):
    """(q_t, V_t) as (n, 3) each from rates of conserved variables of either kind."""
    if rates.shape[1] == 6:
        return rates[:, :3], rates[:, 3:]
    zero = np.zeros(len(rates))
    return np.stack([rates[:, 0], zero, rates[:, 1]], 1), np.stack([rates[:, 2], zero, rates[:, 3]], 1)


def mean(values):
    return 0.5 * (values[1:] + values[:-1])


class Books:
    """The books of one scene."""

    def __init__(self, scene):
        tables = []
        self.scene, self.p = scene, record_of(scene, tables)[0]
        self.tables = np.concatenate(tables)
        n = int(self.p["nodes"])
        self.h = self.tables[self.p["grid_at"] :][: n - 1]
        self.kind = spatial_node if scene.motion.dimensions == 3 else planar_node
        axes = scene.motion.dimensions
        self.work = np.zeros((n, self.kind.WIDTH)), np.zeros((n, axes)), np.zeros((n, 2 * axes))
        tether, buoy = scene.tether, scene.buoy
        rho, g, d = scene.water.density_kgpm3 if scene.water else 0.0, scene.gravity_mps2, tether.diameter_m
        self.m = tether.density_kgpm3 * tether.area_m2
        self.weight = np.array([0, 0, (tether.density_kgpm3 - rho) * tether.area_m2 * g])
        self.displaced = rho * math.pi * d**2 / 4
        self.added = tether.added_mass * self.displaced
        self.c_t, self.c_n = 0.5 * rho * math.pi * d * tether.drag_tangential, 0.5 * rho * d * tether.drag_normal
        if buoy:
            volume = math.pi * buoy.diameter_m**3 / 6
            self.M = buoy.mass_kg + (buoy.added_mass_kg if rho else 0.0)
            self.M_wave = rho * volume + (buoy.added_mass_kg if rho else 0.0)
            self.lift = np.array([0, 0, (rho * volume - buoy.mass_kg) * g])
            self.C = 0.5 * rho * buoy.drag * math.pi * buoy.diameter_m**2 / 4

    def water(self, t, Y):
        """Velocity and acceleration (n, 3) of the water at the nodes, and the places (n, 3)."""
        Q, X, F = self.work
        self.kind.shape(self.p, self.tables, Y, Q, X)
        self.kind.water(self.p, self.tables, t, 1.0, X, F)
        if F.shape[1] == 6:
            return F[:, :3].copy(), F[:, 3:].copy(), X.copy()
        zero = np.zeros(len(F))
        return np.stack([F[:, 0], zero, F[:, 1]], 1), np.stack([F[:, 2], zero, F[:, 3]], 1), np.insert(X, 1, 0.0, 1)

    def energy(self, Y):
        """J: kinetic, gravity, stretching, bending."""
        line, X = state_of(self.scene, Y), self.water(0.0, Y)[2]
        h, law = self.h[:, None], self.scene.tether.tension
        kinetic = 0.5 * self.m * np.sum(h * mean(line.V) ** 2)
        if self.scene.buoy:
            kinetic += 0.5 * self.M * np.sum(line.V[-1] ** 2)
        assert law.law == "linear"
        stretching = np.sum(self.h * mean(0.5 * law.stiffness_N * line.eps**2))
        bending = 0.5 * self.scene.tether.bending_stiffness_Nm2 * np.sum(h * mean(line.turn) ** 2)
        gravity = np.sum(h * mean(X) @ self.weight) - (X[-1] @ self.lift if self.scene.buoy else 0.0)
        return np.array([kinetic, gravity, stretching, bending])

    def rates(self, t, Y, K):
        """Powers (W) and forces (N, (., 3)) from outside on line and buoy, and the work on the line within (W).

        powers: drag of the buoy, wave load of the buoy, drag of the line, fluid inertia of the line, other ends.
        forces: weight of the line, drag and inertia of the line, upper end, anchor. Last: mean(N) . mean(q_t).
        """
        line, (q_t, V_t), (U, A, _) = state_of(self.scene, Y), in_three(K), self.water(t, Y)
        h, root = self.h[:, None], np.sqrt(1 + line.eps)[:, None]

        def along(x):
            return np.sum(x * line.t, 1)[:, None] * line.t

        v = line.V - U
        vt, vp = along(v), v - along(v)
        size = np.sqrt(np.sum(vt**2, 1))[:, None], np.sqrt(np.sum(vp**2, 1))[:, None]
        drag = -root * (self.c_t * size[0] * vt + self.c_n * size[1] * vp)
        push = (self.displaced + self.added) * A - self.added * V_t
        push = push - along(push)
        shares = [np.sum(h * mean(load) * mean(line.V)) for load in (drag, push)]
        line_force = np.sum(h * mean(drag + push), 0)
        top, end = line.V[-1], line.N[-1]
        if self.scene.buoy:
            w = top - U[-1]
            parts = self.lift, -self.C * np.linalg.norm(w) * w, self.M_wave * A[-1]
            powers = [part @ top for part in parts[1:]] + [*shares, 0.0]
            outer = sum(parts)
        else:
            powers, outer = [0.0, 0.0, *shares, end @ top], end
        forces = np.array([-self.weight * np.sum(self.h), line_force, outer, -line.N[0]])
        return np.array(powers), forces, np.sum(h * mean(line.N) * mean(q_t))

    def momentum(self, Y):
        V = state_of(self.scene, Y).V
        return self.m * np.sum(self.h[:, None] * mean(V), 0) + (self.M * V[-1] if self.scene.buoy else 0.0)


def balance(scene, duration_s):
    """Dict of running sums over the accepted Runge-Kutta steps (steps of the starter left out): arrays by step.

    t (s); energy (4), work (5), inner: changes of the energies, works of the powers, work of N on q_t (J); passed: sum
    of the sizes of the works of the single steps (J); momentum (3), impulse (3), passed_impulse (N s).
    """
    books = Books(scene)
    s = int(books.p["stages"])
    b = books.tables[books.p["method_at"] :][: s * s].reshape(s, s)[-1]
    c = books.tables[books.p["method_at"] :][: s * s].reshape(s, s).sum(1)
    rows = {key: [] for key in ("t", "energy", "work", "inner", "passed", "momentum", "impulse", "passed_impulse")}
    end = None
    for t, dt, regular, Ys, Ks in accepted_steps(scene, duration_s):
        if not regular:
            end = None
            continue
        start = end if end is not None else (books.energy(Ys[0]), books.momentum(Ys[0]))
        found = [books.rates(t + c[i] * dt, Ys[i], Ks[i]) for i in range(s)]
        powers, forces, inner = (dt * sum(b[i] * found[i][j] for i in range(s)) for j in range(3))
        end = books.energy(Ys[-1]), books.momentum(Ys[-1])
        rows["t"].append(t + dt)
        rows["energy"].append(end[0] - start[0])
        rows["work"].append(powers)
        rows["inner"].append(inner)
        rows["passed"].append(np.abs(powers).sum())
        rows["momentum"].append(end[1] - start[1])
        rows["impulse"].append(forces.sum(0))
        rows["passed_impulse"].append(np.linalg.norm(forces, axis=1).sum())
    return {key: np.array(values) if key == "t" else np.cumsum(values, axis=0) for key, values in rows.items()}
