"""Law: the condition of a buoy partly in the water is Lagrange's equation of the wetted cap, in a plane and in space,
and its derivatives are those of the condition; a sphere in the water is the whole sphere, to the last bit.
"""

import numpy as np
import pytest

from engine import load_scene
from engine.parameters import record_of
from engine.physics.ends import upper_end, upper_end_3d
from engine.physics.submergence import cap_across, cap_end, cap_end_3d, wetted
from tests.engine.physics.caps import CAP, condition, section, volume

RNG = np.random.default_rng(11)
D, DEPTH, CV, CQ, T = 1.5, 21.0, 80.0, 120.0, 1.7
SPACE = {"motion.dimensions": 3, "waves.direction_rad": 0.7}
HEIGHTS = [DEPTH + 0.7 * step for step in (-2.5, -1.5, -0.6, 0.1, 0.9, 1.8, 3.0)]  # from under water to the air


def record(scene):
    tables = []
    return record_of(scene, tables)[0], np.concatenate(tables)


def total(p, tables, in_motion, place, V, V_tilde, N, F):
    """e and D of the end with its cap, in space or in a plane (then without y)."""
    if "GI" in p.dtype.names:
        e, _, S = upper_end_3d(p, tables, T, CV, in_motion, tuple(N), tuple(V), tuple(V_tilde), F)
        more, rows = cap_end_3d(p, T, CQ, CV, in_motion, tuple(place), tuple(V), tuple(V_tilde), F)
        whole = np.array([[S[0], S[1], S[2]], [S[1], S[3], S[4]], [S[2], S[4], S[5]]])
        return np.add(e, more), whole + np.array(rows)
    ex, ez, _, Dxx, Dxz, Dzz = upper_end(p, tables, T, CV, in_motion, *N, *V, *V_tilde, F)
    more = cap_end(p, T, CQ, CV, in_motion, *place, *V, *V_tilde, F)
    D = np.array([[Dxx, Dxz], [Dxz, Dzz]]) + np.array([more[2:4], more[4:]])
    return np.array([ex + more[0], ez + more[1]]), D


def drawn(axes):
    """V, V~, N, and the water's velocity and acceleration."""
    V, U, U_t = 3 * RNG.normal(size=(3, axes))
    return V, V + 0.1 * RNG.normal(size=axes), 900 * RNG.normal(size=axes), np.concatenate([U, U_t])


@pytest.mark.parametrize("loss", [0.0, 0.7])
@pytest.mark.parametrize("height", HEIGHTS)
def test_it_is_lagranges_equation_in_space(height, loss):
    scene = load_scene("tethered_buoy", CAP | SPACE | {"buoy.impact_loss": loss})
    p, tables = record(scene)
    for _ in range(5):
        place = np.array([*RNG.normal(size=2), height])
        V, V_tilde, N, F = drawn(3)
        e, _ = total(p, tables, 1.0, place, V, V_tilde, N, F)
        exact = condition(scene, T, place, V, CV * (V - V_tilde), N, F[:3], F[3:])
        assert e == pytest.approx(exact, rel=1e-11, abs=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("heading", [0.0, np.pi])
@pytest.mark.parametrize("loss", [0.0, 0.7])
@pytest.mark.parametrize("height", HEIGHTS)
def test_it_is_lagranges_equation_in_a_plane(height, loss, heading):
    more = {"waves.direction_rad": heading, "waves.phase_rad": 0.4, "buoy.impact_loss": loss}
    scene = load_scene("tethered_buoy", CAP | more)
    p, tables = record(scene)
    for _ in range(5):
        place = np.array([RNG.normal(), height])
        V, V_tilde, N, F = drawn(2)
        e, _ = total(p, tables, 1.0, place, V, V_tilde, N, F)
        x, v, n, u, u_t = (np.insert(part, 1, 0.0) for part in (place, V, N, F[:2], F[2:]))
        exact = condition(scene, T, x, v, CV * np.insert(V - V_tilde, 1, 0.0), n, u, u_t)
        assert e == pytest.approx(exact[[0, 2]], rel=1e-11, abs=1e-9 * np.abs(exact).max())


@pytest.mark.parametrize("in_motion", [1.0, 0.0])
@pytest.mark.parametrize("height", HEIGHTS)
@pytest.mark.parametrize("axes", [2, 3])
def test_the_derivatives_are_those_of_the_condition(axes, height, in_motion):
    """By velocity, with which the place moves by dV/cq: central differences."""
    loss = {"buoy.impact_loss": 0.7}
    p, tables = record(load_scene("tethered_buoy", CAP | loss | (SPACE if axes == 3 else {})))
    place = np.array([0.3, 0.2, height])[: axes - 1]
    place = np.append(place, height)
    V, V_tilde, N, F = drawn(axes)
    if in_motion == 0.0:
        F[axes:] = 0.0
    D = total(p, tables, in_motion, place, V, V_tilde, N, F)[1]
    for j, d in enumerate(1e-4 * np.eye(axes)):
        ahead, behind = (total(p, tables, in_motion, place + d * s / CQ, V + d * s, V_tilde, N, F)[0] for s in (1, -1))
        assert (ahead - behind) / 2e-4 == pytest.approx(D[:, j], rel=1e-6, abs=1e-3)


@pytest.mark.parametrize("axes", [2, 3])
def test_a_sphere_in_the_water_is_the_whole_sphere(axes):
    scene = load_scene("tethered_buoy", CAP | (SPACE if axes == 3 else {}))
    p, tables = record(scene)
    full, _ = record(load_scene("tethered_buoy", SPACE if axes == 3 else {}))
    for _ in range(20):
        place = np.append(RNG.normal(size=axes - 1), DEPTH - D / 2 - scene.waves.steepness / p["k"] - RNG.exponential())
        V, V_tilde, N, F = drawn(axes)
        e, J = total(p, tables, 1.0, place, V, V_tilde, N, F)
        whole = upper_end if axes == 2 else upper_end_3d
        arguments = (*N, *V, *V_tilde) if axes == 2 else (tuple(N), tuple(V), tuple(V_tilde))
        answer = whole(full, tables, T, CV, 1.0, *arguments, F)
        if axes == 2:
            assert [*e, J[0, 0], J[0, 1], J[1, 0], J[1, 1]] == [*answer[:2], *answer[3:5], *answer[4:]]
        else:
            assert np.array_equal(e, answer[0])
            assert np.array_equal(J, np.array(answer[2])[[0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(3, 3))


def test_shares_and_their_derivatives_are_those_of_the_geometry():
    p, _ = record(load_scene("tethered_buoy", CAP))
    for h in np.linspace(-0.2, D + 0.2, 41):
        dry, ds, bend, bare, da = wetted(p, h)
        assert 1 - dry == pytest.approx(volume(h, D) / volume(D, D), abs=1e-15)
        assert 1 - bare == pytest.approx(section(h, D) / section(D, D), abs=1e-15)
        step = 1e-5
        ahead, behind = wetted(p, h + step), wetted(p, h - step)
        assert ds == pytest.approx((behind[0] - ahead[0]) / (2 * step), abs=1e-9)
        assert da == pytest.approx((behind[3] - ahead[3]) / (2 * step), abs=3e-3)  # square roots at both ends
        if 2 * step < h < D - 2 * step:
            assert bend == pytest.approx((ahead[1] - behind[1]) / (2 * step), abs=1e-8)
    assert wetted(p, D) == wetted(p, 9.0) == (0.0, 0.0, 0.0, 0.0, 0.0)
    assert wetted(p, 0.0)[:2] == wetted(p, -9.0)[:2] == (1.0, 0.0)


@pytest.mark.parametrize("height", HEIGHTS)
def test_across_the_plane_it_is_the_condition_in_space(height):
    """To first order in a velocity across the plane of motion: `engine.perturbations.lateral`."""
    flat, _ = record(load_scene("tethered_buoy", CAP))
    space, _ = record(load_scene("tethered_buoy", CAP | {"motion.dimensions": 3}))
    V, V_tilde, _, F = drawn(2)
    Y = np.array([0.0, 0.0, *V, 0.0, 0.0])
    factor, known = cap_across(flat, T, CV, np.array([0.4, height]), Y, F, 0.3)
    place, v, water = (0.4, 0.0, height), (V[0], 0.0, V[1]), np.insert(F, [1, 3], 0.0)
    e, rows = cap_end_3d(space, T, 1e30, CV, 1.0, place, v, (V_tilde[0], 0.3, V_tilde[1]), water)
    assert factor == pytest.approx(rows[1][1], rel=1e-12, abs=1e-9)
    assert known == pytest.approx(e[1], rel=1e-12, abs=1e-9)
