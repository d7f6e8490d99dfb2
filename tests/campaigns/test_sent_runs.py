"""What travels between a campaign and workers that do not see its folder, and what becomes of it on arrival."""

import pickle
from functools import partial

import cloudpickle
import pytest

from campaigns.buoy_sweep.repeats import accuracy_row
from campaigns.buoy_sweep.rows import COLUMNS, buoy_row, regime_of
from campaigns.machinery.batches import MOST_SENT, Group, groups_of, run_group
from campaigns.machinery.cluster import difference, facts
from campaigns.machinery.folder import trajectory_path
from campaigns.machinery.kept_run import KeptRun
from campaigns.machinery.plan import Plan, make_job
from campaigns.machinery.worker import received, reuse, run_one
from engine import Trajectory, load_scene
from engine.trajectory import TrajectoryError
from tests.campaigns.conftest import finished
from tests.campaigns.fake_engine import FakeEngine, sines


@pytest.fixture
def plan(tmp_path):
    """Of a campaign on a cluster, in a folder whose name is easily found."""
    (tmp_path / "of-the-campaign" / "trajectories").mkdir(parents=True)
    engine = FakeEngine()
    describe = partial(buoy_row, transient_periods=2)
    place = tmp_path / "of-the-campaign"
    return Plan(place, engine, describe, COLUMNS, "dask", row_maker="this one", simulate_each=engine.each)


def job(value, **more):
    scene = load_scene("tethered_buoy", {"waves.steepness": value})
    return make_job(scene, 6, labels={"steepness": value}, **more)


def test_a_worker_is_not_told_of_the_folder(plan):
    kept = trajectory_path(plan.directory, "base")
    sines(job(0.05).scene, 6).save(kept)
    verdict = partial(regime_of, transient_periods=2)
    two = job(0.05, describe=partial(accuracy_row, base=KeptRun(kept), length=6, verdict=verdict))
    for sent in (partial(run_one, plan.for_workers()), two, partial(run_group, plan.for_workers())):
        assert b"of-the-campaign" not in cloudpickle.dumps(sent)
    assert b"of-the-campaign" in cloudpickle.dumps(partial(run_one, plan))  # so it would be seen


@pytest.mark.parametrize("together", [False, True])
def test_what_is_sent_is_kept_as_a_worker_with_the_folder_keeps_it(plan, together):
    jobs = [job(value) for value in (0.05, 0.13)]
    near = Plan(plan.directory, plan.simulate, plan.describe, COLUMNS, row_maker="this one")
    rows = [run_one(near, one).row for one in jobs]
    folder = plan.directory / "trajectories"
    files = {path.name: path.read_bytes() for path in folder.iterdir()}
    for path in folder.iterdir():
        path.unlink()
    far = plan.for_workers()
    sent = run_group(far, Group(0, tuple(jobs)))[1] if together else [run_one(far, one) for one in jobs]
    assert list(folder.iterdir()) == []
    outcomes = [received(plan, one, outcome) for one, outcome in zip(jobs, sent, strict=True)]
    assert [outcome.row for outcome in outcomes] == rows
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == files and len(files) == 4
    assert all(outcome.computed and not outcome.content and not outcome.stop for outcome in outcomes)
    assert [reuse(plan, one).row for one in jobs] == rows


def test_a_run_that_does_not_fit_on_the_disk_stops_the_campaign(plan, monkeypatch):
    one = job(0.05)
    sent = run_one(plan.for_workers(), one)

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("campaigns.machinery.worker.write_atomic", full)
    assert "is full" in received(plan, one, sent).stop
    assert finished(plan.directory) == {}


def test_a_failed_run_has_nothing_to_send(plan):
    outcome = run_one(Plan(None, FakeEngine(raises=(0.05,)), plan.describe, COLUMNS, "dask"), job(0.05))
    assert outcome.row["status"] == "error" and outcome.content == b""
    assert received(plan, job(0.05), outcome) == outcome and finished(plan.directory) == {}


def test_a_worker_loses_no_more_than_the_lanes_hold(plan):
    jobs = [job(round(0.01 + 0.002 * number, 3)) for number in range(50)]
    groups = groups_of(plan, jobs)
    assert sum(len(group.jobs) for group in groups) == 50 and max(len(group.jobs) for group in groups) <= MOST_SENT


def test_lanes_are_as_many_as_runs_are_sent_together():
    from engine.simd.vector import COUNT

    assert MOST_SENT == COUNT


def test_a_kept_run_takes_its_content_along(tmp_path):
    run = sines(job(0.05).scene, 6)
    run.save(tmp_path / "run.nc")
    here = KeptRun(tmp_path / "run.nc")
    there = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(here))))
    assert there.path is None and there.stamp() is not None
    for kept in (here, there):
        assert (kept.load().columns["radius_m"] == run.columns["radius_m"]).all()
        assert kept.load().scene == run.scene
    (tmp_path / "run.nc").unlink()
    for gone in (here, pickle.loads(pickle.dumps(here))):
        assert gone.stamp() is None
        with pytest.raises(TrajectoryError):
            gone.load()


def test_bytes_are_what_save_writes(tmp_path):
    run = sines(job(0.05).scene, 6)
    run.save(tmp_path / "run.nc", {"run_key": "k"})
    assert run.to_bytes({"run_key": "k"}) == (tmp_path / "run.nc").read_bytes()
    with pytest.raises(TrajectoryError, match="what came: truncated"):
        Trajectory.from_bytes(run.to_bytes()[:1000], "what came")


def test_a_worker_is_told_apart_by_what_changes_numbers():
    here = facts()
    assert difference(here, dict(here)) == ""
    assert {"Python", "numba", "sources of engine", "sources of analysis"} <= set(here)
    assert difference(here, here | {"numba": "0.1"}) == f"numba 0.1 (here: {here['numba']})"
    without = {name: entry for name, entry in here.items() if name != "scipy"}
    assert difference(here, without).startswith("scipy none")
