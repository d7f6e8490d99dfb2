"""Where the runs execute changes nothing in what they are."""

import pytest

from campaigns import buoy_sweep
from campaigns.machinery.folder import CampaignStopped
from tests.campaigns.conftest import USUAL, finished
from tests.campaigns.fake_engine import FakeEngine

VALUES = ("0.02", "0.05", "0.08", "0.13")


def test_threads_equal_processes(sweep):
    code, rows, _ = sweep("--steepness", *VALUES, backend="threading", raises=(0.08,))
    content = {name: (sweep.out / "trajectories" / name).read_bytes() for name in finished(sweep.out)}
    for path in (sweep.out / "trajectories").iterdir():
        path.unlink()
    assert sweep("--steepness", *VALUES, backend="loky", raises=(0.08,))[:2] == (code, rows)
    assert {name: (sweep.out / "trajectories" / name).read_bytes() for name in finished(sweep.out)} == content


def test_workers_kept_from_a_campaign_elsewhere_write_into_the_folder_of_this_one(tmp_path, monkeypatch):
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        monkeypatch.chdir(tmp_path / name)
        words = ["--steepness", *VALUES, *USUAL, "--out", "out"]
        assert buoy_sweep.main(words, simulate=FakeEngine()) == 0
    assert finished(tmp_path / "one" / "out").keys() == finished(tmp_path / "other" / "out").keys()


def test_rows_come_in_the_order_asked_for(sweep):
    backwards = VALUES[::-1]
    assert [row["steepness"] for row in sweep("--steepness", *backwards)[1]] == list(backwards)


@pytest.mark.slow
def test_local_dask_cluster_equals_threads(sweep):
    pytest.importorskip("distributed")
    rows = sweep("--steepness", *VALUES)[1]
    for path in (sweep.out / "trajectories").iterdir():
        path.unlink()
    assert sweep("--steepness", *VALUES, backend="dask")[:2] == (0, rows)


@pytest.mark.slow
def test_dask_worker_that_dies_is_a_row(sweep):
    pytest.importorskip("distributed")
    code, rows, begun = sweep("--steepness", *VALUES, backend="dask", dies=(0.05,))
    assert code == 0
    assert [row["status"] for row in rows] == ["ok", "worker-died", "ok", "ok"]
    assert begun.count(0.05) == 2


def test_dask_scheduler_that_is_not_there_is_one_line(sweep, capfd, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("campaigns.machinery.pools.JOIN_S", 1)
    code, rows, _ = sweep("--steepness", "0.02", "--dask-address", "tcp://127.0.0.1:1", backend="dask")
    error = capfd.readouterr().err
    assert (code, rows) == (1, [])
    assert "no dask cluster at tcp://127.0.0.1:1" in error
    assert "Traceback" not in error


def test_dask_scheduler_that_wants_certificates_is_one_line_without_them():
    pytest.importorskip("distributed")
    from campaigns.machinery.pools import dask_client as client

    address = "tls://127.0.0.1:1"
    with pytest.raises(CampaignStopped, match=f"no dask cluster at {address}: TLS expects"), client(1, address):
        pass
