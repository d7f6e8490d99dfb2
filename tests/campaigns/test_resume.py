"""What is finished is never computed again; what is not, or is damaged, is. Where runs execute changes nothing.

Provenance says what made the results, and stays as it is while they do.
"""

import itertools
import json
import platform
import socket
import subprocess
from contextlib import nullcontext
from functools import partial

import numpy as np
import pytest

from campaigns import buoy_sweep
from campaigns.explore.rows import COLUMNS
from campaigns.machinery import session
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import CampaignStopped, keep_json, kept_json, made_by
from campaigns.machinery.plan import Job, Outcome, Plan
from campaigns.machinery.pools import dask_client
from campaigns.machinery.store import Store, key_of
from campaigns.machinery.tasks import Task, results
from campaigns.machinery.worker import keep_row, kept_row
from engine import Trajectory, load_scene, source_hash
from tables import names
from tests.campaigns.conftest import USUAL, finished, forget
from tests.campaigns.fake_engine import FakeEngine
from tests.pages import ROOT

THREE = "--steepness 0.02 0.05 0.13"
FOUR = ("0.02", "0.05", "0.08", "0.13")
ROW = {"status": "ok", "radius_max_m": 21.5, "strobed_period": None, "regime": "period-1"}
KEY, RUN = "a" * 64, b"the content of its file"
WITH_REPORT = ["--periods", "6", "--no-accuracy"]


@pytest.mark.parametrize(
    ("first", "second", "values", "begun"),
    [
        (THREE, "--steepness 0.02 0.03 0.13", ["0.02", "0.03", "0.13"], [0.03]),
        (THREE, "--steepness 0.13 0.05 0.02", ["0.13", "0.05", "0.02"], []),
        ("--steepness 0.11 0.12 0.13", "--steepness-range 0.11 0.13 3", ["0.11", "0.12", "0.13"], []),
        ("--steepness 0.02", "--steepness 0.05 0.05", ["0.05"], [0.05]),
    ],
)
def test_only_new_values_are_computed_and_rows_come_in_the_order_asked_for(sweep, first, second, values, begun):
    sweep(*first.split())
    code, rows, computed = sweep(*second.split())
    assert (code, computed) == (0, begun)
    assert [row["steepness"] for row in rows] == values


def test_another_transient_measures_anew_without_computing(sweep):
    sweep("--steepness", "0.05", usual=["--periods", "7", *USUAL[2:]])
    code, rows, begun = sweep("--steepness", "0.05", "--transient", "5", usual=["--periods", "7", *USUAL[4:]])
    assert (code, begun) == (0, [])
    assert rows[0]["radius_max_m"] != ""


@pytest.mark.parametrize("damage", [0, 100, -1, None])
def test_a_damaged_file_is_computed_again_and_a_lost_table_made_again(sweep, damage):
    _, rows, _ = sweep(*THREE.split())
    path = sweep.out / "trajectories" / f"{rows[1]['run_key']}.nc"
    content = path.read_bytes()
    middle = len(content) // 2
    path.write_bytes(content[:damage] if damage is not None else content[:middle] + b"\x01\x02" + content[middle + 2 :])
    (sweep.out / "table.csv").unlink()
    assert sweep(*THREE.split()) == (0, rows, [0.05])
    assert path.read_bytes() == content


def test_files_under_each_others_names_are_computed_again_and_that_is_said(sweep, capfd):
    _, rows, _ = sweep(*THREE.split())
    paths = [sweep.out / "trajectories" / f"{row['run_key']}.nc" for row in rows]
    contents = [path.read_bytes() for path in paths]
    paths[0].write_bytes(contents[1])
    paths[1].write_bytes(contents[0])
    Trajectory.from_bytes(contents[1]).save(paths[2], {"run_key": rows[2]["run_key"]})
    capfd.readouterr()
    assert sweep(*THREE.split()) == (0, rows, [0.02, 0.05, 0.13])
    lines = [line for line in capfd.readouterr().err.splitlines() if "computed again" in line]
    assert len(lines) == 3
    assert all(key["run_key"] in line for key, line in zip([rows[1], rows[0]], lines, strict=False))
    assert "its scene is not the one" in lines[2]
    assert [path.read_bytes() for path in paths] == contents


@pytest.mark.parametrize(
    "damage",
    [
        pytest.param(
            lambda text, neighbour: text.replace('"tension_top_max_N": ', '"tension_top_max_N": 9'), id="a digit"
        ),
        pytest.param(lambda text, neighbour: text[: len(text) // 2], id="torn"),
        pytest.param(lambda text, neighbour: neighbour, id="of another run"),
        pytest.param(lambda text, neighbour: "[" * 100_000, id="nested"),
    ],
)
def test_a_row_that_is_not_what_was_written_is_made_again_from_its_run(sweep, damage):
    _, rows, _ = sweep(*THREE.split())
    paths = [sweep.out / "trajectories" / f"{row['run_key']}.row.json" for row in rows]
    text = paths[0].read_text()
    paths[0].write_text(damage(text, paths[1].read_text()))
    assert paths[0].read_text() != text
    assert sweep(*THREE.split()) == (0, rows, [])
    assert paths[0].read_text() == text


def plan_of(folder, maker="maker"):
    return Plan(Running(folder), None, None, (), maker)


def test_a_sealed_file_is_read_as_it_was_written_under_its_own_name_or_not_at_all(tmp_path):
    path = tmp_path / "one.json"
    keep_json(path, {"kicks": [[0.1, 1e-300], [float("inf"), 3]]})
    assert kept_json(path) == {"kicks": [[0.1, 1e-300], [float("inf"), 3]]}
    content = path.read_bytes()
    for place in range(len(content)):
        path.write_bytes(content[:place] + bytes([content[place] ^ 1]) + content[place + 1 :])
        assert kept_json(path) == {}
    path.write_bytes(content)
    assert kept_json((tmp_path / "one.json").rename(tmp_path / "other.json")) == kept_json(path) == {}


def test_a_run_that_gave_no_record_is_tried_again(sweep):
    assert sweep(*THREE.split(), raises=(0.05,))[1][1]["status"] == "error"
    _, rows, begun = sweep(*THREE.split())
    assert begun == [0.05]
    assert [row["status"] for row in rows] == ["ok"] * 3


def test_the_content_key_follows_everything_that_changes_a_result(monkeypatch):
    scenes = [load_scene("tethered_buoy", {"waves.steepness": value}) for value in (0.02, 0.13)]
    keys = [Job({}, scene, periods).key for scene, periods in itertools.product(scenes, (6, 7))]
    keys += [Job({}, scenes[0], duration_s=6.0).key, Job({}, scenes[0], 6, made="otherwise").key]
    monkeypatch.setattr("engine.source_hash", lambda: "another engine")
    keys.append(Job({}, scenes[0], 6).key)
    assert len(set(keys)) == len(keys)
    assert Job({"steepness": 1}, scenes[0], 6).key == keys[-1]  # a label changes nothing


def test_the_key_of_a_result_tells_values_shapes_and_bounds_of_its_parts_apart():
    values = np.arange(6.0)
    parts = [(values,), (values.reshape(2, 3),), (values.reshape(3, 2),), (values + 1.0,), ("ab", "c"), ("a", "bc")]
    assert len({key_of(*of_a_result) for of_a_result in parts}) == len(parts)
    assert key_of(values.copy()) == key_of(values)


def test_results_come_in_the_order_of_their_tasks_whatever_was_finished_before(tmp_path):
    store = Store(tmp_path)
    store.put("b", {"value": 2})
    tasks = [Task(key, partial(dict, value=number)) for number, key in enumerate("abc", 1)]
    found = results(Running(tmp_path, 2, "threading"), store, "tasks", tasks)
    assert ([result["value"] for result in found.results], found.reused) == ([1, 2, 3], 1)


def test_results_that_workers_send_are_kept_for_the_next_command(tmp_path, monkeypatch):
    def at_once(call, tasks, **further):
        return [(task, call(task)) for task in tasks]

    monkeypatch.setattr("campaigns.machinery.tasks.opened", lambda *pool: nullcontext(at_once))
    store, how = Store(tmp_path), Running(tmp_path, 2, "dask")
    first = results(how, store, "tasks", [Task("a", partial(dict, value=1))])
    again = results(how, store, "tasks", [Task("a", None)])
    assert (first.reused, again.reused) == (0, 1) and again.results == first.results == [{"value": 1}]


def contents(out, files="trajectories/*.nc"):
    return {path.name: path.read_bytes() for path in out.glob(files)}


@pytest.mark.parametrize("backend", ["loky", pytest.param("dask", marks=pytest.mark.slow)])
def test_every_backend_gives_the_rows_and_files_of_threads(sweep, backend):
    if backend == "dask":
        pytest.importorskip("distributed")
    threads = sweep("--steepness", *FOUR, raises=(0.08,))
    content = contents(sweep.out)
    forget(sweep.out)
    assert sweep("--steepness", *FOUR, backend=backend, raises=(0.08,)) == threads
    assert contents(sweep.out) == content


def test_workers_kept_from_a_campaign_elsewhere_write_into_the_folder_of_this_one(tmp_path, monkeypatch):
    for name in ("one", "other"):
        (tmp_path / name).mkdir()
        monkeypatch.chdir(tmp_path / name)
        assert buoy_sweep.main(["--steepness", *FOUR, *USUAL, "--out", "out"], simulate=FakeEngine()) == 0
    assert finished(tmp_path / "one" / "out").keys() == finished(tmp_path / "other" / "out").keys()


def test_a_dask_scheduler_that_is_not_there_is_one_line(sweep, capfd, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr("campaigns.machinery.pools.JOIN_S", 0.2)
    code, rows, _ = sweep("--steepness", "0.02", "--dask-address", "tcp://127.0.0.1:1", backend="dask")
    error = capfd.readouterr().err
    assert (code, rows) == (1, [])
    assert "no dask cluster at tcp://127.0.0.1:1" in error and "Traceback" not in error
    address = "tls://127.0.0.1:1"
    with pytest.raises(CampaignStopped, match=f"no dask cluster at {address}: TLS expects"), dask_client(1, address):
        pass


def test_a_row_comes_back_to_its_maker_alone_and_while_its_run_is_as_it_was(tmp_path):
    plan = plan_of(tmp_path)
    (tmp_path / "trajectories").touch()
    keep_row(plan, Outcome(KEY, ROW), RUN)
    (tmp_path / "trajectories").unlink()
    assert kept_row(plan, KEY, RUN) is None, "a folder that cannot be written to costs only the row"
    keep_row(plan, Outcome(KEY, ROW), RUN)
    assert kept_row(plan, KEY, RUN) == ROW
    assert kept_row(plan, KEY, b"a run that has gone on since") is None
    assert kept_row(plan_of(tmp_path, "another maker"), KEY, RUN) is None
    assert kept_row(plan, "b" * 64, RUN) is None


def test_the_maker_changes_with_settings_and_sources():
    makers = [made_by("analysis", transient=100), made_by("analysis", transient=50)]
    makers.append(made_by("analysis", "campaigns/explore/rows.py", transient=100))
    assert len(set(makers)) == 3 and made_by("analysis", transient=100) == makers[0]
    for absent in ("campaigns/rows_that_moved.py", "reports/templates"):
        with pytest.raises(FileNotFoundError):
            made_by("engine", absent)


def record(out):
    return json.loads((out / "provenance.json").read_text())


def test_what_is_recorded(sweep):
    sweep("--steepness", "0.02", "0.13", "--set", "water.depth_m=22.5", raises=(0.13,))
    provenance = record(sweep.out)
    assert provenance["campaign"] == "buoy_sweep"
    assert provenance["command"][:4] == ["python", "-m", "campaigns.buoy_sweep", "--steepness"]
    assert provenance["versions"]["python"] == platform.python_version()
    assert provenance["git"] == session.git_state(ROOT / "campaigns")
    assert provenance["host"] == socket.gethostname()
    assert provenance["engine_source_hash"] == source_hash()
    assert (provenance["steepness"], provenance["periods"], provenance["transient"]) == ([0.02, 0.13], 6, 2)
    assert provenance["set"] == {"water.depth_m": 22.5}
    assert provenance["runs"] == {"total": 2, "found": 0, "computed": 2, "failed": 1}
    assert set(provenance["timing"]) >= {"compile_s", "run_s", "analysis_s"}
    assert provenance["started_utc"] <= provenance["finished_utc"]


def test_dirty_means_changes_that_are_not_committed_and_outside_a_checkout_there_is_no_commit(tmp_path):
    git = ["git", "-C", str(tmp_path), "-c", "user.name=a", "-c", "user.email=a@b.c", "-c", "core.hooksPath=/dev/null"]
    package = tmp_path / "campaigns"
    assert session.git_state(package) == {"commit": None, "dirty": None}
    package.mkdir()
    (package / "file").write_text("1")
    for words in (["init", "-q"], ["add", "-A"], ["commit", "-q", "-m", "one"]):
        subprocess.run([*git, *words], check=True)
    commit = subprocess.run([*git, "rev-parse", "HEAD"], capture_output=True, text=True).stdout.strip()
    assert session.git_state(package) == {"commit": commit, "dirty": False}
    (package / "file").write_text("2")
    assert session.git_state(package)["dirty"] is True


def test_a_run_that_computes_nothing_changes_nothing_and_other_parameters_make_a_new_record(sweep):
    sweep("--steepness", "0.02", "0.13")
    earlier, runs = contents(sweep.out, "[!.]*.*"), finished(sweep.out)
    code, _, begun = sweep("--steepness", "0.02", "0.13", backend="loky", jobs=1)
    assert (code, begun, contents(sweep.out, "[!.]*.*"), finished(sweep.out)) == (0, [], earlier, runs)
    sweep("--steepness", "0.02")
    assert record(sweep.out)["steepness"] == [0.02]
    assert record(sweep.out)["runs"]["found"] == 1


def test_the_scene_file_can_be_run_again(sweep):
    _, (row,), _ = sweep("--steepness", "0.05", "--set", "water.depth_m=22.5", "tether.nodes=21")
    scene = load_scene(sweep.out / "scene.toml")
    assert (scene.waves.steepness, scene.water.depth_m, scene.tether.nodes) == (0.05, 22.5, 21)
    code, (again,), computed = sweep("--scene", sweep.out / "scene.toml", "--steepness", "0.05")
    assert (code, again["run_key"], computed) == (0, row["run_key"], [])


def test_unknown_is_empty(sweep):
    _, rows, _ = sweep("--steepness", "0.02", "0.05", raises=(0.05,))
    assert list(rows[0]) == list(names(COLUMNS))
    for row in rows:
        assert row["regime"] == ""
        assert all(entry == "" for name, entry in row.items() if "lyapunov" in name or "offplane" in name)
    filled = {name for name, entry in rows[1].items() if entry != ""}
    assert filled == {"steepness", "dimensions", "status", "message", "run_key"}


@pytest.mark.parametrize("fault", [None, RuntimeError("no ink")])
def test_paths_of_the_report_are_told_and_one_that_fails_leaves_the_results(sweep, monkeypatch, capsys, fault):
    built = []

    def build(out):
        built.append(out)
        if fault:
            raise fault

    monkeypatch.setattr("reports.build", build, raising=False)
    code, rows, _ = sweep("--steepness", "0.02", usual=WITH_REPORT)
    printed = capsys.readouterr()
    assert (code, len(rows), built) == (1 if fault else 0, 1, [sweep.out])
    assert all(word in printed.out for word in ("table.csv", "compile", "analysis"))
    if fault:
        assert "no ink" in printed.err and f"python -m reports {sweep.out}" in printed.err
    else:
        assert "report.html" in printed.out and "report.pdf" in printed.out
