"""Conditions at the two ends, 13 = 7 + 6; in a plane 7 = 4 + 3.

    below  u = v = w = 0,  |beta|^2 = 1,  no roll of the frame about t in the step,  Omega_2 = Omega_3 = 0
    above  three equations of the end in the paper's fixed axes,  Omega_1 = Omega_2 = Omega_3 = 0

buoy (30), at the middle of the step:  (M + M_a) (V_i - V_(i-1))/dt + mean over i-1, i of (N + C |v| v - M_wave dU_w/dt)
= (B - W) up; held: V_i = V_e(t_i); free, and held after its release: N_i = F(t_i). The vertical of the paper's axes is
axis 1. Rows are written without absolute values, for complex steps.
"""

import numpy as np

from ..physics.ends import end_velocity, released
from ..record import BUOY, HELD
from ..spatial.vectors import dot_of
from .line import EPS, EULER, O2, O3, OMEGA, S_B, S_N, SPEEDS, TO_PAPER, Line, roll, to_fixed
from .nodal import Level


def lower(Y: np.ndarray, Y_old: np.ndarray) -> np.ndarray:
    """Residuals (7, ...) at the anchor. Y, Y_old: (13, ...) its unknowns now and a step ago."""
    beta = Y[EULER]
    b0, b1, b2, b3 = beta
    turned = np.sum(roll(Y_old[EULER]) * beta, axis=0)
    return np.array([*Y[SPEEDS], b0 * b0 + b1 * b1 + b2 * b2 + b3 * b3 - 1, turned, Y[O2], Y[O3]])


def force_and_velocity(line: Line, Y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """N (N) and V (m/s) of nodes Y (13, ...) in the paper's fixed axes, (3, ...) each."""
    T = line.tension(Y[EPS])[0]
    return to_fixed(Y[EULER], np.array([T, Y[S_N], Y[S_B]])), to_fixed(Y[EULER], Y[SPEEDS])


def buoy_load(line: Line, Y: np.ndarray, water: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What the inertia of the buoy balances in (30), N + drag - wave load - net buoyancy, and its velocity: (3, ...)"""
    record = line.record
    N, V = force_and_velocity(line, Y)
    slip = V - water[:3]
    speed = np.sqrt(dot_of(slip, slip))
    load = N + record["C_buoy"] * speed * slip - record["M_wave"] * water[3:]
    load[0] = load[0] - record["lift"]
    return load, V


def upper(
    line: Line, t: float, Y: np.ndarray, water: np.ndarray, old: Level | None, force: np.ndarray | None
) -> np.ndarray:
    """Residuals (6, m) at the upper end at time t.

    Y (13, m) and water (6, m) there. old: the `Level` before, or None at rest with force (3,) on an end without a buoy.
    """
    if line.record["end"] == BUOY:
        balance, V = buoy_load(line, Y, water)
        if old is not None:
            balance_old, V_old = buoy_load(line, old.Y[:, -1:], old.water[:, -1:])
            balance = line.record["M_total"] * (V - V_old) / (t - old.t) + 0.5 * (balance + balance_old)
    elif old is not None and is_kept(line, t):
        moved = np.array(end_velocity(line.record, line.tables, t))[TO_PAPER]
        balance = force_and_velocity(line, Y)[1] - moved[:, None]
    else:
        force = end_force(line) if old is not None else force
        balance = force_and_velocity(line, Y)[0] - force[:, None]
    return np.array([*balance, *Y[OMEGA]])


def is_kept(line: Line, t: float) -> bool:
    """Is the upper end a held one that has not been let go at time t?"""
    return line.record["end"] == HELD and not released(line.record, t)


def end_force(line: Line) -> np.ndarray:
    """Steady force (3,) on a free end, or on a held one after its release, in the paper's axes."""
    record = line.record
    name = "end_f" if record["end"] == HELD else "end_"
    y = record[name + "y"] if line.spatial else 0.0
    return np.array([record[name + "z"], record[name + "x"], y])
