"""What a run says about its perturbations: only where it is asked, without a trace on the motion, kept on disk."""

import numpy as np
import pytest

from engine import SceneError, Trajectory, load_scene, simulate, simulate_batch
from engine.run import Run

STEEP = {"water.depth_m": 21.6, "tether.nodes": 21}


def steep(vectors, **more):
    return load_scene("tethered_buoy", STEEP | {"output.tangent_vectors": vectors} | more)


def same_motion(one, other):
    for name, column in one.columns.items():
        np.testing.assert_array_equal(column, other.columns[name])
    counts = [{k: v for k, v in run.statistics.items() if k != "wall_s"} for run in (one, other)]
    assert counts[0] == counts[1]


@pytest.fixture(scope="module")
def run():
    return simulate(steep(2), periods=6.5)


def test_the_motion_is_bitwise_the_same(run):
    plain = simulate(steep(0), periods=6.5)
    assert plain.tangent is None
    same_motion(plain, run)


def test_one_row_for_each_complete_period(run):
    assert run.tangent.period_s == 5.0
    assert run.tangent.growth_nats.shape == (6, 2)
    assert run.tangent.released.shape == (6,)
    assert np.all(np.isfinite(run.tangent.growth_nats))


def test_longer_runs_begin_alike(run):
    longer = simulate(steep(2), periods=9).tangent.growth_nats
    np.testing.assert_array_equal(longer[:6], run.tangent.growth_nats)


def test_batches_and_chunks_leave_no_trace(run):
    other = steep(1, **{"tether.nodes": 11, "waves.period_s": 6.0})
    pair = simulate_batch([other, steep(2)], duration_s=32.5)
    np.testing.assert_array_equal(pair[1].tangent.growth_nats, run.tangent.growth_nats)
    same_motion(pair[1], run)
    assert pair[0].tangent.growth_nats.shape == (5, 1) and pair[0].tangent.period_s == 6.0
    chunked = Run(steep(2), 32.5)
    while not chunked.done():
        chunked.advance(7)
    np.testing.assert_array_equal(chunked.trajectory().tangent.growth_nats, run.tangent.growth_nats)


def test_releases_are_told_in_their_period():
    """The shipped scene in 21.6 m releases its first loop between 53 and 54 s, in the eleventh period."""
    scene = load_scene("tethered_buoy", {"water.depth_m": 21.6, "output.tangent_vectors": 1})
    found = simulate(scene, periods=12)
    assert found.statistics["loop_releases"] >= 1
    assert found.tangent.released[10] == 1.0
    assert not found.tangent.released[:10].any(), "the small steps of the sudden start are no release"


def test_a_run_that_ends_early_keeps_its_complete_periods():
    scene = load_scene(
        "tethered_buoy", {"water.depth_m": 21.6, "solver.loop_release": False, "output.tangent_vectors": 1}
    )
    found = simulate(scene, periods=12)
    assert found.status == "turn-unresolved"
    assert len(found.tangent.growth_nats) == int(found.statistics["end_time_s"] // 5.0) == 10


@pytest.mark.parametrize("periods", [6.5, 0.5])
def test_saved_and_loaded(periods, tmp_path):
    run = simulate(steep(3), periods=periods)
    run.save(tmp_path / "run.nc")
    loaded = Trajectory.load(tmp_path / "run.nc")
    assert loaded.scene == run.scene
    assert loaded.tangent is not None, "a run that was asked for its growth says so, be it without a complete period"
    assert loaded.tangent.period_s == run.tangent.period_s
    np.testing.assert_array_equal(loaded.tangent.growth_nats, run.tangent.growth_nats)
    np.testing.assert_array_equal(loaded.tangent.released, run.tangent.released)


def test_odd_periods_survive_the_file(tmp_path):
    period_s = 5.0 + 1e-13 * np.pi
    run = simulate(steep(1, **{"waves.period_s": period_s}), periods=1)
    run.save(tmp_path / "run.nc")
    assert Trajectory.load(tmp_path / "run.nc").tangent.period_s == period_s


def test_xarray_opens_the_growth(run, tmp_path):
    import xarray

    run.save(tmp_path / "run.nc")
    with xarray.open_dataset(tmp_path / "run.nc", engine="scipy") as data:
        assert data["growth_nats"].dims == ("period", "vector")
        np.testing.assert_array_equal(data["growth_nats"].values, run.tangent.growth_nats)
        assert data["growth_nats"].attrs["long_name"]


@pytest.mark.parametrize(
    "overrides, words",
    [
        ({"tether.bending_stiffness_Nm2": 0.0}, "bending"),
        ({"solver.integrator": "midpoint"}, "'midpoint'"),
        ({"solver.integrator": "generalized-alpha"}, "'generalized-alpha'"),
        ({"output.tangent_vectors": 85}, "84"),
        ({"output.tangent_vectors": -1}, "-1"),
        ({"output.tangent_vectors": 1.5}, "1.5"),
        ({"output.tangent_vectors": True}, "true"),
    ],
)
def test_what_has_no_growth_is_refused(overrides, words):
    with pytest.raises(SceneError) as caught:
        steep(2, **overrides)
    (fault,) = caught.value.faults
    assert fault.startswith("output.tangent_vectors") and words in fault
