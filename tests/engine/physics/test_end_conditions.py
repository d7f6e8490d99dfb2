"""Law: without anything across the plane the end conditions in space are those of the plane, and D = de/dV is their
derivative, by central differences of step 1e-4 m/s (error of the square).
"""

import numpy as np
import pytest

from engine.record import RECORD, SPATIAL
from tests.engine.kernels import parameters_of, upper_end_of
from tests.engine.lines import DRY, SPACE, free, held, line

RNG = np.random.default_rng(4)
N, V, V_TILDE, WATER = 900 * RNG.normal(size=3), *RNG.normal(size=(2, 3)), RNG.normal(size=(2, 3))
SHAKEN = {"law": "harmonic", "amplitude_m": [0.4, 0.0, 0.3], "period_s": 3.0}
ENDS = {
    "buoy": {},
    "dry buoy": DRY,
    "held": held(3, 19),
    "moved": held(3, 19, motion=SHAKEN),
    "released": held(3, 19, release_s=1.0, force_N=[30.0, 0.0, 9.0]),
    "free": free(30, 9),
}
T = 1.7


def condition(changes, N, V, V_tilde, water, in_motion=1.0, dimensions=3):
    """e, e_N and D of the upper end at t = T."""
    p, tables = parameters_of(line(changes, {"motion.dimensions": dimensions}))
    F = np.ascontiguousarray(water, float).ravel()
    return upper_end_of(p, tables, T, 8.0, in_motion, N, V, V_tilde, F)


@pytest.mark.parametrize("in_motion", [1.0, 0.0])
@pytest.mark.parametrize("name", ENDS)
def test_in_a_plane_it_is_that_of_the_plane(name, in_motion):
    flat = [part * [1, 0, 1] for part in (N, V, V_TILDE, WATER)]
    e, e_N, D = condition(ENDS[name], *flat, in_motion)
    planar = condition(ENDS[name], *(part[..., [0, 2]] for part in flat), in_motion, dimensions=2)
    for found, expected in zip((e[[0, 2]], e_N, D[::2, ::2]), planar, strict=True):
        assert found == pytest.approx(expected, rel=1e-14, abs=1e-14)
    assert e[1] == 0 and D[0, 1] == D[1, 2] == 0


@pytest.mark.parametrize("in_motion", [1.0, 0.0])
@pytest.mark.parametrize("name", ENDS)
def test_the_derivatives_are_those_of_the_condition(name, in_motion):
    _, e_N, D = condition(ENDS[name], N, V, V_TILDE, WATER, in_motion)
    for j, d in enumerate(1e-4 * np.eye(3)):
        ahead, behind = (condition(ENDS[name], N, V + step, V_TILDE, WATER, in_motion)[0] for step in (d, -d))
        assert (ahead - behind) / 2e-4 == pytest.approx(D[:, j], rel=1e-7, abs=1e-5)
        ahead, behind = (condition(ENDS[name], N + step, V, V_TILDE, WATER, in_motion)[0] for step in (d, -d))
        assert (ahead - behind) / 2e-4 == pytest.approx(e_N * d / 1e-4, abs=1e-7)


def test_a_clamp_points_along_the_line_between_the_ends_unless_told_otherwise():
    clamped = {"anchor.rotation": "clamped"}
    upwards = parameters_of(line(SPACE, clamped))[0]
    assert [upwards[f"below_{axis}"] for axis in "xyz"] == [0.0, 0.0, 1.0]
    p = parameters_of(line(SPACE, clamped, held(3.0, 4.0, 12.0, rotation="clamped")))[0]
    for name in ("below", "above"):
        found = [p[f"{name}_{axis}"] for axis in "xyz"]
        assert found == pytest.approx([3 / 13, 4 / 13, 12 / 13], rel=1e-15)


def test_kernels_are_compiled_apart_for_a_plane_and_for_space():
    """Numba takes a record that begins with all fields of another for that other: it would run the wrong kernels."""
    from numba import from_dtype

    planar, spatial = from_dtype(RECORD), from_dtype(SPATIAL)
    assert spatial.can_convert_to(None, planar) is None and planar.can_convert_to(None, spatial) is None
