"""The commands of docs/howto_cluster.md as they stand, with workers in a place of their own, one of them killed."""

import csv
import os
import re
import shlex
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest

import analysis.compiled
import engine.compiled
from campaigns.machinery.cluster import GONE_S, JOIN_S
from tests.campaigns.clusters import ROOT, Cluster, can_hide
from tests.campaigns.conftest import finished, rows_of, until

distributed = pytest.importorskip("distributed")
PAGE = (ROOT / "docs" / "howto_cluster.md").read_text()
TIMES = {"wall_s"}


def commands():
    """scheduler, worker, campaign: words of the page's three commands."""
    return [shlex.split(block) for block in re.findall(r"```sh\n(.*?)\n```", PAGE, re.DOTALL)]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return str(probe.getsockname()[1])


def _put(word, here):
    for name, place in here.items():
        word = word.replace(name, place)
    return word


def without_times(path):
    with open(path, newline="") as file:
        return [{name: entry for name, entry in row.items() if name not in TIMES} for row in csv.DictReader(file)]


def test_the_page_shows_three_commands_and_its_numbers_are_those_of_the_code():
    scheduler, worker, campaign = commands()
    assert [words[0] for words in (scheduler, worker, campaign)] == [".venv/bin/dask"] * 2 + [".venv/bin/python"]
    assert scheduler[1] == "scheduler" and worker[1:3] == ["worker", campaign[-1]] and "--dask-address" in campaign
    assert f"in {JOIN_S:g} s, or none is left for {GONE_S:g} s" in PAGE
    assert all(name in PAGE for name in ("buoy_sweep", "out_of_plane", "breaking_line", "accuracy"))


@pytest.mark.slow
def test_the_commands_of_the_page_with_a_worker_killed_give_the_table_of_one_machine(tmp_path):
    here = {"HEAD": "127.0.0.1", "8786": free_port(), ".venv/bin": str(Path(sys.executable).parent)}
    scheduler, worker, campaign = ([_put(word, here) for word in words] for words in commands())
    place = tmp_path / "client"
    place.mkdir()
    cluster = Cluster(tmp_path / "cluster", place, ROOT, scheduler)
    try:
        # the machine code of these tests, if they have any: a place of its own, but not a minute of compilation
        cluster.bring_machine_code(engine.compiled.cache_directory(), analysis.compiled.cache_directory())
        cluster.add_worker(words=worker)
        cluster.wait_for_workers(2)
        how = {"cwd": place, "env": os.environ | {"PYTHONPATH": str(ROOT)}, "text": True}
        sweep = subprocess.Popen(campaign, **how, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        out = place / "results" / "buoy_sweep"
        until(lambda: finished(out), sweep, seconds=240.0)
        with distributed.Client(cluster.address) as client:
            os.kill(next(iter(client.run(os.getpid).values())), signal.SIGKILL)
        output, error = sweep.communicate(timeout=240)
        assert sweep.returncode == 0 and "Traceback" not in error, output + error
        assert "runs     24: 24 computed" in output
        assert {row["status"] for row in rows_of(out)} == {"ok"} and (out / "report.html").exists()
        compiled = cluster.caches()
        assert compiled[0]
        others = ["--steepness-range", "0.017", "0.17", "4", "--periods", "20", "--out", "more", "--no-accuracy"]
        more = [*campaign[:3], *others, *campaign[campaign.index("--backend") :], "--no-report"]
        subprocess.run(more, **how, check=True, capture_output=True)
        assert cluster.caches() == compiled  # nothing is compiled twice
    finally:
        cluster.end()
    loky = [*campaign[: campaign.index("--backend")], "--out", "loky", "--no-report"]
    subprocess.run(loky, **how, check=True, capture_output=True)
    for table in ("table.csv", "accuracy/table.csv"):
        assert without_times(out / table) == without_times(place / "loky" / table)
    if can_hide():
        assert not any((tmp_path / "cluster").rglob("*.nc"))
