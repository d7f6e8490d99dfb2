"""What a run says of a perturbation across its plane: its growth, only where asked, without a trace on the motion."""

import math

import numpy as np
import pytest

from analysis import transverse_lyapunov
from engine import SceneError, Trajectory, load_scene, simulate, simulate_batch
from tests.engine.lines import line

STEEP = {"waves.steepness": 0.13, "water.depth_m": 21.6, "tether.nodes": 21}
SMALL, LARGE = {"waves.steepness": 0.016}, {"waves.steepness": 0.13}


def run_of(*parts, periods, vectors=0, lateral=True):
    changes = {"output.lateral_growth": lateral, "output.tangent_vectors": vectors}
    return simulate(line(*parts, changes), periods=periods)


def rate(*parts, periods=300, transient=100):
    """Exponent and error in nats per wave period, in 22.5 m of water, where neither motion releases a loop."""
    run = run_of({"water.depth_m": 22.5}, *parts, periods=periods)
    assert run.status == "ok" and not run.tangent.released.any()
    found = transverse_lyapunov(run.tangent.lateral_nats, transient, run.tangent.released)
    return found.value * math.log(2.0), found.error * math.log(2.0)


@pytest.mark.parametrize("wave, seen", [(SMALL, -0.023), (LARGE, -0.13)], ids=["small", "large"])
def test_pushed_out_of_their_plane_the_papers_two_motions_return(wave, seen):
    """Motions in space with a small push came back at about these rates, read off decays over tens of periods.

    "About" is taken as a fifth: on the way the amplitude swings with the phase of its pendulum.
    """
    found, error = rate(wave)
    assert found < -10 * error
    assert found == pytest.approx(seen, rel=0.2)


@pytest.mark.slow
@pytest.mark.parametrize("wave", [SMALL, LARGE], ids=["small", "large"])
def test_grid_and_tolerance_do_not_make_the_rate(wave):
    """Equal within two errors and, where the motion has period 1, to what the grid leaves of it: 1e-4 nats of 0.02."""
    changes = {"solver.rtol": 0.003}, {"solver.rtol": 0.003, "tether.nodes": 81}
    usual, error = rate(wave)
    for found, its_error in (rate(wave, change) for change in changes):
        assert abs(found - usual) < 2 * math.hypot(error, its_error)
        if wave is SMALL:
            assert found == pytest.approx(usual, abs=1e-4)


@pytest.mark.slow
def test_a_buoy_that_moves_along_its_tether_is_damped_alike_to_both_sides():
    """Drag C |v| v on a motion along r damps what is across it by C |v|, along x or y, and along r by 2 C |v|.

    At kA = 0.016 the buoy moves along r, but for a tenth: the slower pair of exponents in the plane is the one across
    it, and the faster pair twice that.
    """
    run = run_of({"water.depth_m": 22.5}, SMALL, periods=500, vectors=4)
    planar = run.tangent.growth_nats[100:].mean(axis=0)
    across = run.tangent.lateral_nats[100:].mean()
    assert planar[:2].mean() == pytest.approx(across, rel=0.05)
    assert planar[2:].mean() == pytest.approx(2 * across, rel=0.1)


def test_waves_from_the_other_side_and_torsional_stiffness_change_nothing():
    usual = run_of(SMALL, periods=12).tangent.lateral_nats
    np.testing.assert_allclose(run_of(SMALL, {"waves.direction_rad": math.pi}, periods=12).tangent.lateral_nats, usual,
                               atol=1e-6)  # fmt: skip
    np.testing.assert_array_equal(run_of(SMALL, torsion(4.0), periods=12).tangent.lateral_nats, usual)


def torsion(value):
    return {"tether.torsion_stiffness_Nm2": value}


@pytest.fixture(scope="module")
def steep():
    return run_of(STEEP, periods=6.5)


@pytest.mark.parametrize("vectors", [0, 2])
def test_the_motion_and_the_growth_in_the_plane_are_bitwise_the_same(vectors):
    plain, found = (run_of(STEEP, periods=6.5, vectors=vectors, lateral=lateral) for lateral in (False, True))
    for name, column in plain.columns.items():
        np.testing.assert_array_equal(column, found.columns[name])
    if vectors:
        np.testing.assert_array_equal(plain.tangent.growth_nats, found.tangent.growth_nats)
        np.testing.assert_array_equal(plain.tangent.released, found.tangent.released)
        assert plain.tangent.lateral_nats is None
    else:
        assert plain.tangent is None
        assert found.tangent.growth_nats.shape == (6, 0)
    assert found.tangent.lateral_nats.shape == found.tangent.released.shape == (6,)


def test_company_leaves_no_trace(steep):
    """Neither vectors in the plane, a longer run nor another scene in the batch change a bit of the growth across."""
    scenes = [line(STEEP | {"output.lateral_growth": True, "output.tangent_vectors": k, "tether.nodes": n})
              for k, n in ((1, 11), (2, 21))]  # fmt: skip
    other = simulate_batch(scenes, periods=9)[1].tangent.lateral_nats
    np.testing.assert_array_equal(other[:6], steep.tangent.lateral_nats)


def test_releases_are_told_in_their_period():
    """The shipped scene in 21.6 m releases its first loop between 53 and 54 s, in the eleventh period."""
    found = run_of({"water.depth_m": 21.6}, LARGE, periods=12).tangent
    assert found.released[10] == 1.0 and not found.released[:10].any()
    assert np.all(np.isfinite(found.lateral_nats))


@pytest.mark.parametrize("vectors", [0, 3])
@pytest.mark.parametrize("periods", [6.5, 0.5])
def test_saved_and_loaded(periods, vectors, tmp_path):
    run = run_of(STEEP, periods=periods, vectors=vectors)
    run.save(tmp_path / "run.nc")
    again = Trajectory.load(tmp_path / "run.nc")
    assert again.scene == run.scene and again.tangent.period_s == run.tangent.period_s
    for name in ("growth_nats", "released", "lateral_nats"):
        np.testing.assert_array_equal(getattr(again.tangent, name), getattr(run.tangent, name))
    again.save(tmp_path / "again.nc")
    assert (tmp_path / "again.nc").read_bytes() == (tmp_path / "run.nc").read_bytes()


@pytest.mark.parametrize(
    "overrides, words",
    [
        ({"tether.bending_stiffness_Nm2": 0.0}, "bending"),
        ({"solver.integrator": "midpoint"}, "'midpoint'"),
        ({"solver.integrator": "generalized-alpha"}, "'generalized-alpha'"),
        ({"output.lateral_growth": 1}, "1"),
        ({"output.lateral_growth": "yes"}, "'yes'"),
    ],
)
def test_what_has_no_growth_is_refused(overrides, words):
    with pytest.raises(SceneError) as caught:
        load_scene("tethered_buoy", {"output.lateral_growth": True} | overrides)
    (fault,) = caught.value.faults
    assert fault.startswith("output.lateral_growth") and words in fault
