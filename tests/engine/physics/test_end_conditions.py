"""Law: the end conditions know no horizontal direction of their own, and in a plane they are those of the plane.

With all that is given turned about the vertical, e is turned, and D = de/dV with it; without anything across the plane
they are the numbers of the planar condition. D against central differences of step 1e-4 m/s (error of the square).
"""

import numpy as np
import pytest

from engine.parameters import record_of
from engine.physics.ends import upper_end, upper_end_3d
from engine.record import RECORD, SPATIAL
from tests.engine.lines import STILL, free, held, line
from tests.engine.physics.test_water_in_space import turned

SPACE = {"motion.dimensions": 3}
RNG = np.random.default_rng(4)
N, V, V_TILDE, WATER = 900 * RNG.normal(size=3), *RNG.normal(size=(2, 3)), RNG.normal(size=(2, 3))
ENDS = {
    "buoy": {},
    "dry buoy": {"water": None, "waves": None},
    "held": held(3, 19),
    "moved": {
        "end": {"kind": "held", "position_m": [3.0, 0.0, 19.0],
                "motion": {"law": "harmonic", "amplitude_m": [0.4, 0.0, 0.3], "period_s": 3.0}},
        "buoy": None,
    },
    "released": {"end": {"kind": "held", "position_m": [3.0, 0.0, 19.0], "release_s": 1.0, "force_N": [30.0, 0.0, 9.0]},
                 "buoy": None},
    "free": free(30, 9),
}  # fmt: skip
T = 1.7


def condition(changes, N, V, V_tilde, water, in_motion=1.0, rate=8.0):
    """e (3,), e_N and D (3, 3) of the upper end at t = T."""
    tables = []
    p = record_of(line(SPACE, changes), tables)[0]
    F = np.ascontiguousarray(water, float).ravel()
    e, e_N, D = upper_end_3d(p, np.concatenate(tables), T, rate, in_motion, tuple(N), tuple(V), tuple(V_tilde), F)
    return np.array(e), e_N, np.array(D)[[0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(3, 3)


def turned_end(changes, angle):
    """The end section with its vectors turned."""
    end = {key: list(turned(np.array(value), angle)) if isinstance(value, list) else value
           for key, value in changes.get("end", {}).items()}  # fmt: skip
    if "motion" in end:
        end["motion"] = {**end["motion"], "amplitude_m": list(turned(np.array(end["motion"]["amplitude_m"]), angle))}
    return {**changes, "end": end} if end else changes


@pytest.mark.parametrize("name", ENDS)
@pytest.mark.parametrize("angle", [0.3, np.pi / 2, 2.5, -1.2])
def test_a_turned_end_is_the_end_turned(name, angle):
    e, e_N, D = condition(ENDS[name], N, V, V_TILDE, WATER)
    args = (turned(part, angle) for part in (N, V, V_TILDE, WATER))
    there, e_N_there, D_there = condition(turned_end(ENDS[name], angle), *args)
    assert there == pytest.approx(turned(e, angle), rel=1e-12, abs=1e-12)
    assert e_N_there == e_N
    assert D_there == pytest.approx(turned(turned(D, angle).T, angle).T, rel=1e-11, abs=1e-9)


@pytest.mark.parametrize("in_motion", [1.0, 0.0])
@pytest.mark.parametrize("name", ENDS)
def test_in_a_plane_it_is_that_of_the_plane(name, in_motion):
    flat = [part * [1, 0, 1] for part in (N, V, V_TILDE, WATER)]
    e, e_N, D = condition(ENDS[name], *flat, in_motion)
    tables = []
    p = record_of(line(ENDS[name]), tables)[0]
    n, v, v_tilde, water = (np.ascontiguousarray(part[..., [0, 2]]) for part in flat)
    planar = upper_end(p, np.concatenate(tables), T, 8.0, in_motion, *n, *v, *v_tilde, water.ravel())
    assert np.array([*e[[0, 2]], e_N, D[0, 0], D[0, 2], D[2, 2]]) == pytest.approx(planar, rel=1e-14, abs=1e-14)
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


def test_water_at_rest_with_the_buoy_does_not_divide_by_zero():
    for moving in (V, 0 * V):
        e, _, D = condition(STILL, N, moving, V_TILDE, [moving, 0 * moving])
        assert np.all(np.isfinite(e)) and np.all(np.isfinite(D))


@pytest.mark.parametrize("angle", [0.3, 2.5])
def test_the_record_of_a_turned_scene_holds_the_vectors_turned(angle):
    end = {"kind": "held", "position_m": [3.0, 1.0, 19.0], "rotation": "clamped", "release_s": 1.0,
           "force_N": [30.0, 5.0, 9.0], "direction": [0.0, 3.0, 4.0]}  # fmt: skip

    def record(angle):
        anchor = {"rotation": "clamped", "direction": list(turned(np.array([2.0, 0.0, 0.0]), angle))}
        return record_of(line(SPACE, turned_end({"end": end, "buoy": None}, angle), {"anchor": anchor}), [])[0]

    plain, there = record(0.0), record(angle)
    vectors = [[f"{name}{axis}" for axis in "xyz"] for name in ("below_", "above_", "end_f")]
    vectors.append(["carry1", "carry2", "carry3"])  # the axis of a rotation, which turns with the scene
    for names in vectors:
        vector, turned_vector = (np.array([p[name] for name in names]) for p in (plain, there))
        assert turned_vector == pytest.approx(turned(vector, angle), rel=1e-14, abs=1e-15)
        assert vector.any()
    assert there["carry0"] == pytest.approx(plain["carry0"], rel=1e-14)  # its angle, which does not
    same = set(SPATIAL.names) - {name for names in vectors for name in names} - {"carry0"}
    assert all(plain[name] == there[name] for name in same if not name.startswith("per_"))


def test_a_clamp_points_along_the_line_between_the_ends_unless_told_otherwise():
    clamped = {"anchor.rotation": "clamped"}
    upwards = record_of(line(SPACE, clamped), [])[0]
    assert [upwards[f"below_{axis}"] for axis in "xyz"] == [0.0, 0.0, 1.0]
    end = {"end": {"kind": "held", "position_m": [3.0, 4.0, 12.0], "rotation": "clamped"}, "buoy": None}
    p = record_of(line(SPACE, clamped, end), [])[0]
    for name in ("below", "above"):
        found = [p[f"{name}_{axis}"] for axis in "xyz"]
        assert found == pytest.approx([3 / 13, 4 / 13, 12 / 13], rel=1e-15)


def test_kernels_are_compiled_apart_for_a_plane_and_for_space():
    """Numba takes a record that begins with all fields of another for that other: it would run the wrong kernels."""
    from numba import from_dtype

    planar, spatial = from_dtype(RECORD), from_dtype(SPATIAL)
    assert spatial.can_convert_to(None, planar) is None and planar.can_convert_to(None, spatial) is None
