"""Law: a held end is where it is said to be, moved or not; and a line that is let go moves as the free end demands.

Moved: the equations hold the end's speed, so that its place carries what Newton's method leaves over in each step; with
Newton's method converged it is 8e-7 m. Steps end where the acceleration of the end jumps (at rows of a table, at the
end of a ramp), or each such jump would leave 1e-5 m. A taut line shaken across at one end settles to the string driven
off resonance,

    w(s, t) = w_0 sin(k s)/sin(k L) sin(omega t),   m (1+eps) omega^2 = T k^2        (k per unstretched length);

the box has (2/h) tan(kh/2) for k; T rises by EA mean(w_s^2)/2, 5e-5 of itself at 1 mm; the ramp of 20 s leaves 2e-3 of
free motion.

Let go: a folded chain against the energy of a chain folded without gap (Calkin & March, Am. J. Phys. 57, 1989: the
tip's speed after a fall x is v^2 = 2 g x (1 - x/2L)/(1 - x/L), more than g can give). A line let go under a float in a
cross current comes to the rest of the line whose end was never held.

Jerked: an end pulled away at V(t) from a taut straight line carries T = T_0 + V sqrt(m EA) until the wave comes back
from the anchor (d'Alembert), to 1 % of the jump, also where the motion begins with a jerk (no ramp).
"""

import numpy as np
import pytest
from scipy.integrate import quad

from engine import load_scene, simulate
from tests.engine.lines import DRY, STILL, by_table, equilibrium, harmonic, held, line, linear, positions, ran

LENGTH, G = 1.022, 9.81
TABLE_S, TABLE_M = [0.0, 4.0, 12.0, 20.0], np.array([[0, 0, 0], [1.0, 0.5, -0.5], [1.5, -1.0, 0.5], [0.5, 0.0, 0.0]])


def test_an_end_moved_by_a_table_passes_its_rows(dimensions):
    way = TABLE_M * [1, dimensions - 2, 1]
    end = held(10.0, 0.0, 16.0, motion=by_table(TABLE_S, way.tolist()))
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


def fall(duration_s=0.5, **changes):
    """Time since the release, x, z of the tip."""
    scene = load_scene("falling_chain", changes)
    columns = simulate(scene, duration_s=duration_s).columns
    return columns["time_s"] - scene.end.release_s, columns["x_m"], columns["z_m"]


def test_a_tight_fold_falls_as_its_energy_says():
    def time_of(x):  # x = u^2 takes the singular start out of the integral of dx/v
        def rate(u):
            return 2 * np.sqrt((1 - u * u / LENGTH) / (2 * G * (1 - u * u / (2 * LENGTH))))

        return quad(rate, 0, np.sqrt(x))[0]

    t, _, z = fall(0.475, **{"end.position_m": [0.02, 0.0, 0.0], "tether.nodes": 641, "output.step_s": 1e-3,
                                "tether.bending_stiffness_Nm2": 1e-7})  # fmt: skip
    for x in (0.2, 0.4, 0.6, 0.8, 0.88):
        assert np.interp(x, -z[t > 0], t[t > 0]) == pytest.approx(time_of(x), rel=2e-3)
        assert time_of(x) < np.sqrt(2 * x / G)


def test_a_line_let_go_comes_to_rest_in_the_current():
    scene = load_scene("swinging_line")
    table = ran(scene, duration_s=200.0).table()
    held = table[table.time_s <= 2.0]
    assert held[["x_m", "y_m", "z_m"]].to_numpy() == pytest.approx(np.tile([14.0, 0.0, 12.0], (21, 1)), abs=1e-6)
    assert table.tension_top_N.iloc[30:].to_numpy() == pytest.approx(50.0, rel=2e-3)
    free = equilibrium(load_scene("swinging_line", {"end": {"kind": "free", "force_N": scene.end.force_N}}))
    rest = positions(free.Y, free.h)[-1]
    assert table[["x_m", "y_m", "z_m"]].to_numpy()[-1] == pytest.approx(rest, abs=0.01)
    assert rest[1] > 1.0


MASS, EA, JERKED = 0.5, 5e4, 20.0  # kg/m, N, m of the jerked line
C = np.sqrt(EA / MASS)


def test_the_force_of_a_jerk(dimensions):
    stretch, amplitude, period = 1e-3, 0.1, 1.0
    motion = harmonic([amplitude, 0.0, 0.0], period)
    scene = line(
        DRY, held(JERKED * (1 + stretch), 0.0, motion=motion), {"motion.dimensions": dimensions, "gravity_mps2": 0.0},
        {"solver.rtol": 1e-2, "output.step_s": JERKED / C / 20},
        length_m=JERKED, area_m2=5e-4, density_kgpm3=1000.0, nodes=161, tension=linear(EA),
    )  # fmt: skip
    run = ran(scene, duration_s=1.6 * JERKED / C)
    t = run.columns["time_s"]
    jump = amplitude * 2 * np.pi / period * np.sqrt(MASS * EA)
    expected = EA * stretch + jump * np.cos(2 * np.pi * t / period)
    assert jump > EA * stretch
    assert np.abs(run.columns["tension_top_N"] - expected)[1:].max() < 0.01 * jump


@pytest.mark.parametrize("EI, period_s, position", [(0.4, 2.0, [15.0, 0.0, 8.0]), (50.0, 0.5, [5.0, 0.0, 18.0])])
def test_a_slack_line_stands_a_jerk(dimensions, EI, period_s, position):
    """It weighs 2 N in water, and the jerk at its end is of 40 N and more."""
    motion = harmonic([0.3, 0.0, 0.3], period_s)
    end = held(*position, motion=motion)
    scene = line(STILL, end, {"motion.dimensions": dimensions}, bending_stiffness_Nm2=EI)
    run = ran(scene, duration_s=2.0)
    assert run.statistics["steps"] < 300
