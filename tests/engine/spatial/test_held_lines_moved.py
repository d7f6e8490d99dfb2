"""Law: a held end is where it is said to be, and a taut line shaken across at one end settles to

    w(s, t) = w_0 sin(k s)/sin(k L) sin(omega t),   m (1+eps) omega^2 = T k^2        (k per unstretched length)

the string driven off resonance; moved slowly, a line goes through its equilibria.

Tolerance: the equations hold the end's speed, so that its place carries what Newton's method leaves over in each step:
up to 0.5 mm (plane) and 1 mm (space) in ten oscillations of 1 m at the default tolerances. With Newton's method
converged it is 8e-7 m; steps end where the acceleration of the end jumps (at rows of a table, at the end of a ramp), or
each such jump would leave 1e-5 m. The string: the box has (2/h) tan(kh/2) for k; T rises by EA mean(w_s^2)/2, 5e-5 of
itself at 1 mm; the ramp of 20 s leaves 2e-3 of free motion.
"""

import numpy as np
import pytest

from engine import load_scene, simulate
from tests.engine.lines import equilibrium, positions

PERIOD, AMPLITUDE, RAMP = 5.0, np.array([1.0, 0.4, 0.5]), 5.0
CONVERGED = {"solver.newton_tolerance": 1e-8}
TABLE_S, TABLE_M = [0.0, 4.0, 12.0, 20.0], [[0, 0, 0], [1.0, 0.5, -0.5], [1.5, -1.0, 0.5], [0.5, 0.0, 0.0]]


def moved(dimensions, motion, **changes):
    mask = [1, dimensions - 2, 1]
    if motion["law"] == "harmonic":
        motion = motion | {"amplitude_m": list(AMPLITUDE * mask)}
    else:
        motion = motion | {"displacement_m": (np.array(TABLE_M) * mask).tolist()}
    end = {"kind": "held", "position_m": [10.0, 0.0, 16.0], "motion": motion}
    scene = load_scene(
        "tethered_buoy",
        {"motion.dimensions": dimensions, "end": end, "buoy": None, "waves.steepness": 0.05, **changes},
    )
    return simulate(scene, duration_s=50.0).table(), np.array(mask)


def smooth(t, ramp):
    return np.where(t < ramp, np.sin(0.5 * np.pi * t / ramp) ** 2, 1.0)


@pytest.mark.parametrize("dimensions", [2, 3])
@pytest.mark.parametrize("phase", [0.0, 1.1])
def test_a_shaken_end_is_where_it_is_said_to_be(dimensions, phase):
    motion = {"law": "harmonic", "period_s": PERIOD, "phase_rad": phase, "ramp_s": RAMP}
    worst = []
    for changes in ({}, CONVERGED):
        table, mask = moved(dimensions, motion, **changes)
        t = table.time_s.to_numpy()
        share = smooth(t, RAMP) * np.sin(2 * np.pi * t / PERIOD + phase)
        stated = np.array([10.0, 0.0, 16.0]) + share[:, None] * AMPLITUDE * mask
        worst.append(np.abs(table[["x_m", "y_m", "z_m"]].to_numpy() - stated).max())
    assert worst[0] < 2e-3 and worst[1] < 2e-6


@pytest.mark.parametrize("dimensions", [2, 3])
def test_an_end_moved_by_a_table_passes_its_rows(dimensions):
    table, mask = moved(dimensions, {"law": "table", "time_s": TABLE_S}, **{"output.step_s": 1.0}, **CONVERGED)
    rows = table.set_index("time_s").loc[[*TABLE_S, 50.0], ["x_m", "y_m", "z_m"]].to_numpy()
    stated = np.array([10.0, 0.0, 16.0]) + np.array([*TABLE_M, TABLE_M[-1]]) * mask
    assert rows == pytest.approx(stated, abs=1e-6)
    between = table[table.time_s.between(12.0, 20.0)]
    assert between.x_m.is_monotonic_decreasing  # no overshoot between rows


def shaken(nodes, amplitude, **changes):
    """Amplitude of the steady part over that of the end, in y and z, in and out of phase, at the nodes."""
    motion = {"end.motion.amplitude_m": [0.0, 0.6 * amplitude, 0.8 * amplitude]}
    scene = load_scene("shaken_line", {"tether.nodes": nodes, **motion, **changes})
    p = simulate(scene, duration_s=60.0).profiles
    late = p.time_s > 40
    angle = 2 * np.pi / scene.end.motion.period_s * p.time_s[late]
    basis = np.stack([np.sin(angle), np.cos(angle)], 1)
    parts = [np.linalg.lstsq(basis, w[late], rcond=None)[0] for w in (p.y_m / 0.6, p.z_m / 0.8)]
    return p.s_m, np.array(parts) / amplitude


def string(s, nodes=None):
    """sin(k s)/sin(k L) of the shipped scene, of the string or of the box on as many nodes."""
    scene = load_scene("shaken_line")
    tether, L = scene.tether, scene.tether.length_m
    strain = scene.end.position_m[0] / L - 1
    mass = tether.density_kgpm3 * tether.area_m2
    k = 2 * np.pi / scene.end.motion.period_s * np.sqrt(mass * (1 + strain) / (tether.tension.stiffness_N * strain))
    if nodes is not None:
        h = L / (nodes - 1)
        k = 2 / h * np.arctan(k * h / 2)
    return np.sin(k * s) / np.sin(k * L)


def test_a_string_shaken_off_resonance():
    s, (y, z) = shaken(81, 1e-3)
    assert y[0] == pytest.approx(string(s, 81), abs=2e-3)
    assert y[0] == pytest.approx(string(s), abs=4e-3)
    assert np.abs(y[1]).max() < 1e-3  # no phase: nothing damps it
    assert z == pytest.approx(y, abs=1e-9)
    assert np.abs(string(s)).max() > 1.7  # larger than the shaking


def test_a_line_moved_slowly_rests_where_statics_puts_it():
    """The mooring of the buoy's tether, its top taken 2 m along and 3 m across in a minute, in still water."""
    rows = [[0.0, 0.0, 0.0], [2.0, 3.0, -0.5]]
    end = {"kind": "held", "position_m": [10.0, 0.0, 16.0]}
    base = {"motion.dimensions": 3, "buoy": None, "waves": None, "output.profiles": True, "output.step_s": 10.0}
    moving = load_scene(
        "tethered_buoy", base | {"end": end | {"motion": {"law": "table", "time_s": [0, 60], "displacement_m": rows}}}
    )
    at_last = simulate(moving, duration_s=600.0).profiles
    there = equilibrium(load_scene("tethered_buoy", base | {"end": end | {"position_m": [12.0, 3.0, 15.5]}}))
    x = np.stack([at_last.x_m[-1], at_last.y_m[-1], at_last.z_m[-1]], 1)
    assert x == pytest.approx(positions(there.Y, there.h), abs=2e-3)
