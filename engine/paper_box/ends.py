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
from .frame import TO_PAPER, roll, to_fixed
from .law import tension_law
from .line import EULER, OMEGA, SPEEDS, Line


def lower(Y: np.ndarray, Y_old: np.ndarray) -> np.ndarray:
    """Residuals (7, ...) at the anchor. Y, Y_old: (13, ...) its unknowns now and a step ago."""
    beta = Y[EULER]
    b0, b1, b2, b3 = beta
    turned = np.sum(roll(Y_old[EULER]) * beta, axis=0)
    return np.array([*Y[SPEEDS], b0 * b0 + b1 * b1 + b2 * b2 + b3 * b3 - 1, turned, Y[11], Y[12]])


def force_and_velocity(line: Line, Y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """N (N) and V (m/s) of nodes Y (13, ...) in the paper's fixed axes, (3, ...) each."""
    T = tension_law(line.record, line.tables, Y[0])[0]
    return to_fixed(Y[EULER], np.array([T, Y[1], Y[2]])), to_fixed(Y[EULER], Y[SPEEDS])


def buoy_load(line: Line, N: np.ndarray, V: np.ndarray, water: np.ndarray) -> np.ndarray:
    """What the inertia of the buoy balances in (30), on the left: N + drag - wave load - net buoyancy, (3, ...)."""
    record = line.record
    slip = V - water[:3]
    speed = np.sqrt(slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2])
    load = N + record["C_buoy"] * speed * slip - record["M_wave"] * water[3:]
    load[0] = load[0] - record["lift"]
    return load


def upper(
    line: Line, t: float, dt: float, Y: np.ndarray, Y_old: np.ndarray, water: np.ndarray, water_old: np.ndarray
) -> np.ndarray:
    """Residuals (6, ...) at the upper end after a step of dt to t. Y (13, ...); water (6, ...)."""
    record, tables = line.record, line.tables
    N, V = force_and_velocity(line, Y)
    if record["end"] == BUOY:
        N_old, V_old = force_and_velocity(line, Y_old)
        now, before = buoy_load(line, N, V, water), buoy_load(line, N_old, V_old, water_old)
        balance = record["M_total"] * (V - V_old) / dt + 0.5 * (now + before)
    elif record["end"] == HELD and not released(record, t):
        moved = np.array(end_velocity(record, tables, t))[TO_PAPER]
        balance = V - moved.reshape(3, *(1 for _ in Y.shape[1:]))
    else:
        balance = N - end_force(line).reshape(3, *(1 for _ in Y.shape[1:]))
    return np.array([*balance, *Y[OMEGA]])


def upper_at_rest(line: Line, force: np.ndarray, Y: np.ndarray, water: np.ndarray) -> np.ndarray:
    """Residuals (6, ...) of the upper end in equilibrium; force (3,): on an end without a buoy, paper's axes."""
    N, V = force_and_velocity(line, Y)
    if line.record["end"] == BUOY:
        balance = buoy_load(line, N, V, water)
    else:
        balance = N - force.reshape(3, *(1 for _ in Y.shape[1:]))
    return np.array([*balance, *Y[OMEGA]])


def end_force(line: Line) -> np.ndarray:
    """Steady force (3,) on a free end, or on a held one after its release, in the paper's axes."""
    record = line.record
    name = "end_f" if record["end"] == HELD else "end_"
    y = record[name + "y"] if line.spatial else 0.0
    return np.array([record[name + "z"], record[name + "x"], y])


def force_per(line: Line, t: float) -> float:
    """Inverse scale of the three balances above: a speed's where the end is held, a force's elsewhere."""
    held = line.record["end"] == HELD and not released(line.record, t)
    return float(line.record["per_speed"] if held else line.record["per_force"])
