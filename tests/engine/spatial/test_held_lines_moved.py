"""Law: a held end is where it is said to be, and a taut line shaken across at one end settles to

    w(s, t) = w_0 sin(k s)/sin(k L) sin(omega t),   m (1+eps) omega^2 = T k^2        (k per unstretched length)

the string driven off resonance.

Tolerance: the equations hold the end's speed, so that its place carries what Newton's method leaves over in each step;
with Newton's method converged it is 8e-7 m. Steps end where the acceleration of the end jumps (at rows of a table, at
the end of a ramp), or each such jump would leave 1e-5 m. The string: the box has (2/h) tan(kh/2) for k; T rises by
EA mean(w_s^2)/2, 5e-5 of itself at 1 mm; the ramp of 20 s leaves 2e-3 of free motion.
"""

import numpy as np
import pytest

from engine import load_scene, simulate
from tests.engine.lines import held, line

TABLE_S, TABLE_M = [0.0, 4.0, 12.0, 20.0], np.array([[0, 0, 0], [1.0, 0.5, -0.5], [1.5, -1.0, 0.5], [0.5, 0.0, 0.0]])


@pytest.mark.parametrize("dimensions", [2, 3])
def test_an_end_moved_by_a_table_passes_its_rows(dimensions):
    way = TABLE_M * [1, dimensions - 2, 1]
    end = held(10.0, 0.0, 16.0, motion={"law": "table", "time_s": TABLE_S, "displacement_m": way.tolist()})
    changes = {"motion.dimensions": dimensions, "waves.steepness": 0.05, "output.step_s": 1.0}
    table = simulate(line(end, changes, {"solver.newton_tolerance": 1e-8}), duration_s=50.0).table()
    rows = table.set_index("time_s").loc[[*TABLE_S, 50.0], ["x_m", "y_m", "z_m"]].to_numpy()
    assert rows == pytest.approx(np.array([10.0, 0.0, 16.0]) + np.array([*way, way[-1]]), abs=1e-6)
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
