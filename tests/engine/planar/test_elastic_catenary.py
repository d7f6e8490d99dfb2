"""Law: the elastic catenary (Irvine, Cable Structures, 1981, section 1.3), weight w per unstretched length, EA linear.

With (H, V) the force in the line at the lower end, N = (H, V + w s), T = |N|:

    x(s) = H s/EA + (H/w) [asinh((V + w s)/H) - asinh(V/H)]
    z(s) = (V s + w s^2/2)/EA + [T(s) - T(0)]/w

H and V are what the engine finds at the lower end, and the ends are where they are held. In water w is the wet weight;
below zero the line rises between its ends.

Tolerance: the box keeps N exactly (its load is constant) and sums q = (1 + T/EA) N/T by trapezoids: 1e-8 of wL. Those
sums are off from the integrals with order 2 (within 0.1, from 81 to 161 to 321 nodes), at 161 nodes by less than twice
the trapezoidal h^2/12 times a change of dq/ds of twice its largest value.
"""

import numpy as np
import pytest

from tests.engine.lines import DRY, STILL, equilibrium, forces, held, line, linear, orders, positions

LENGTH, AREA, RHO_W, G = 20.0, 1e-4, 1027.0, 9.81
# end (x, z), EA, density of the line, water
CASES = {
    "level ends": ((15.0, 0.0), 1e4, 5000.0, DRY),
    "level ends, in water": ((15.0, 0.0), 1e4, 5000.0, STILL),
    "light line in water": ((15.0, 0.0), 1e4, 500.0, STILL),
    "light line, uneven ends": ((14.0, 6.0), 1e4, 500.0, STILL),
    "uneven ends": ((14.0, 6.0), 1e4, 5000.0, DRY),
    "upper end below the anchor": ((14.0, -6.0), 1e4, 5000.0, DRY),
    "to the left": ((-14.0, 6.0), 1e4, 5000.0, DRY),
    "stretched": ((20.5, 3.0), 1e4, 5000.0, DRY),
    "very elastic": ((22.0, 8.0), 200.0, 5000.0, DRY),
    "slack": ((6.0, 2.0), 1e4, 5000.0, DRY),
    "steep": ((4.0, 18.0), 1e4, 5000.0, DRY),
}


def place(s, H, V, w, EA):
    T0, T = np.hypot(H, V), np.hypot(H, V + w * s)
    x = H * s / EA + H / w * (np.arcsinh((V + w * s) / abs(H)) - np.arcsinh(V / abs(H)))
    return np.array([x, (V * s + 0.5 * w * s**2) / EA + (T - T0) / w])


def at_rest(case, nodes):
    """Stations (n,), nodes (n, 2) and force (n, 2) of the engine."""
    end, EA, density, water = CASES[case]
    scene = line(
        water, held(*end), length_m=LENGTH, area_m2=AREA, density_kgpm3=density, nodes=nodes,
        bending_stiffness_Nm2=0.0, tension=linear(EA),
    )  # fmt: skip
    motion = equilibrium(scene)
    return motion.s, positions(motion.Y, motion.h), forces(motion.Y, EA)[:, [0, 2]]


@pytest.mark.parametrize("case", CASES)
def test_shape_and_forces(case):
    end, EA, density, water = CASES[case]
    w, errors = (density - (RHO_W if water is STILL else 0.0)) * AREA * G, []
    for nodes in (81, 161, 321):
        s, X, N = at_rest(case, nodes)
        (H, V), T = N[0], np.linalg.norm(N, axis=1, keepdims=True)
        assert N == pytest.approx(np.column_stack([np.full_like(s, H), V + w * s]), abs=1e-8 * abs(w) * LENGTH)
        assert X[-1] == pytest.approx(end, abs=1e-6)
        assert np.trapezoid((1 + T / EA) * N / T, s, axis=0) == pytest.approx(end, abs=1e-6)
        errors.append(np.max(np.abs(X - place(s, H, V, w, EA).T)))
    assert orders(errors) == pytest.approx(2, abs=0.1)
    bend = abs(w * H) / np.hypot(H, V + w * s) ** 2  # dphi/ds, the size of dq/ds
    assert errors[1] < 2 * (LENGTH / 160) ** 2 / 12 * 2 * bend.max()


@pytest.mark.parametrize("distance", [1e-3, 0.0])
def test_ends_at_one_place_hang_as_two_vertical_halves(distance):
    """A bight: each end carries half the weight, and the lowest point lies a stretched half below, L/2 + w L^2/(8 EA),
    within the width of the bight, which the grid does not resolve (one element, 0.25 m)."""
    scene = line(
        DRY, held(distance, 0.0), length_m=LENGTH, area_m2=AREA, density_kgpm3=5000.0, nodes=81,
        bending_stiffness_Nm2=1e-3, tension=linear(1e4),
    )  # fmt: skip
    motion = equilibrium(scene)
    X, w = positions(motion.Y, motion.h), 5000.0 * AREA * G
    assert 1e4 * motion.Y[[0, -1], 0] == pytest.approx(0.5 * w * LENGTH, rel=1e-3)
    assert -X[:, 1].min() == pytest.approx(LENGTH / 2 + w * LENGTH**2 / 8 / 1e4, abs=LENGTH / 80)
