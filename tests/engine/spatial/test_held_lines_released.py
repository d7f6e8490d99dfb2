"""Law: a line held at both ends rests until one end is let go, and then moves as the free end demands.

A folded chain: against the energy of a chain folded without gap (Calkin & March, Am. J. Phys. 57, 1989: the tip's speed
after a fall x is v^2 = 2 g x (1 - x/2L)/(1 - x/L), more than g can give). A line let go under a float in a cross
current: against the rest that follows from its free end downwards, N_s = w_0 z - drag, N(L) = F, without bending.
"""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from engine import load_scene, simulate

LENGTH, G = 1.022, 9.81


def fall(duration_s=0.5, **changes):
    """Time since the release, x, z of the tip."""
    scene = load_scene("falling_chain", changes)
    table = simulate(scene, duration_s=duration_s).table()
    t = table.time_s.to_numpy() - scene.end.release_s
    return t, table.x_m.to_numpy(), table.y_m.to_numpy(), table.z_m.to_numpy()


def test_nothing_moves_before_the_release():
    t, x, _, z = fall(0.2)
    held = t < 1e-12
    assert held.sum() == 21
    assert np.abs(x[held] - 0.25).max() < 1e-9 and np.abs(z[held]).max() < 1e-9
    assert z[held.sum()] < -0.5 * G * t[held.sum()] ** 2  # and at once after it


def test_a_tight_fold_falls_as_its_energy_says():
    def time_of(x):  # x = u^2 takes the singular start out of the integral of dx/v
        def rate(u):
            return 2 * np.sqrt((1 - u * u / LENGTH) / (2 * G * (1 - u * u / (2 * LENGTH))))

        return quad(rate, 0, np.sqrt(x))[0]

    t, _, _, z = fall(0.475, **{"end.position_m": [0.02, 0.0, 0.0], "tether.nodes": 641, "output.step_s": 1e-3,
                                "tether.bending_stiffness_Nm2": 1e-7})  # fmt: skip
    for x in (0.2, 0.4, 0.6, 0.8, 0.88):
        assert np.interp(x, -z[t > 0], t[t > 0]) == pytest.approx(time_of(x), rel=2e-3)
        assert time_of(x) < np.sqrt(2 * x / G)


def hanging_free(scene):
    """Rest of a line without bending under the force on its free end and a current of the given profile: x(L)."""
    tether, water = scene.tether, scene.water
    area, d, rho = tether.area_m2, tether.diameter_m, water.density_kgpm3
    w0 = (tether.density_kgpm3 - rho) * area * scene.gravity_mps2
    heights, velocities = scene.current.height_m, np.array(scene.current.velocity_mps)

    def rates(s, y, top):
        x, N = y[:3], y[3:]
        T = np.linalg.norm(N)
        t, lam = N / T, 1 + T / tether.tension.stiffness_N
        U = np.array([np.interp(top + x[2], heights, velocities[:, i]) for i in range(3)])
        along = U @ t
        across = U - along * t
        drag = 0.5 * rho * np.sqrt(lam) * (
            np.pi * d * tether.drag_tangential * abs(along) * along * t
            + d * tether.drag_normal * np.linalg.norm(across) * across
        )  # fmt: skip
        return np.concatenate([lam * t, [0, 0, w0] - drag])

    top = tether.length_m
    for _ in range(50):  # the height of the free end, so that the anchor is at 0
        down = solve_ivp(
            rates, (tether.length_m, 0), [0, 0, 0, *scene.end.force_N], args=(top,), rtol=1e-10, atol=1e-10
        )
        top = -down.y[2, -1]
    return -down.y[:3, -1]


def test_a_line_let_go_comes_to_rest_in_the_current():
    scene = load_scene("swinging_line")
    run = simulate(scene, duration_s=200.0)
    table = run.table()
    assert run.status == "ok"
    held = table[table.time_s <= 2.0]
    assert held[["x_m", "y_m", "z_m"]].to_numpy() == pytest.approx(np.tile([14.0, 0.0, 12.0], (21, 1)), abs=1e-6)
    assert table.tension_top_N.iloc[30:].to_numpy() == pytest.approx(50.0, rel=2e-3)
    rest = hanging_free(scene)
    assert table[["x_m", "y_m", "z_m"]].to_numpy()[-1] == pytest.approx(rest, abs=0.01)
    assert rest[1] > 1.0
