"""What is finished is never computed again; what is not, or is damaged, is."""

import itertools

import pytest

from campaigns.machinery.plan import Job
from engine import load_scene
from tests.campaigns.conftest import finished

VALUES = ("0.02", "0.05", "0.13")


def test_second_run_computes_nothing_and_says_the_same(sweep):
    code, rows, begun = sweep("--steepness", *VALUES)
    assert (code, begun) == (0, [0.02, 0.05, 0.13])
    files = finished(sweep.out)
    again = sweep("--steepness", *VALUES)
    assert again == (0, rows, [])
    assert finished(sweep.out) == files


def test_only_new_values_are_computed(sweep):
    sweep("--steepness", *VALUES)
    _, rows, begun = sweep("--steepness", "0.02", "0.03", "0.13")
    assert begun == [0.03]
    assert [row["steepness"] for row in rows] == ["0.02", "0.03", "0.13"]


def test_range_meets_listed_values(sweep):
    sweep("--steepness", "0.11", "0.12", "0.13")
    assert sweep("--steepness-range", "0.11", "0.13", "3")[2] == []


def test_value_given_twice_is_one_run(sweep):
    _, rows, begun = sweep("--steepness", "0.05", "0.05")
    assert begun == [0.05]
    assert len(rows) == 1


@pytest.mark.parametrize("damage", [0, 100, -1, None])
def test_damaged_file_is_computed_again(sweep, damage):
    _, rows, _ = sweep("--steepness", *VALUES)
    path = sweep.out / "trajectories" / f"{rows[1]['run_key']}.nc"
    content = path.read_bytes()
    middle = len(content) // 2
    path.write_bytes(content[:damage] if damage is not None else content[:middle] + b"\x01\x02" + content[middle + 2 :])
    assert sweep("--steepness", *VALUES) == (0, rows, [0.05])
    assert path.read_bytes() == content


def test_lost_table_is_made_again_from_the_runs(sweep):
    _, rows, _ = sweep("--steepness", *VALUES)
    (sweep.out / "table.csv").unlink()
    assert sweep("--steepness", *VALUES) == (0, rows, [])


def test_other_transient_measures_anew_without_computing(sweep):
    sweep("--steepness", "0.05")
    _, rows, begun = sweep("--steepness", "0.05", "--transient", "5")
    assert begun == []
    assert rows[0]["radius_max_m"] != ""


def test_run_that_gave_no_record_is_tried_again(sweep):
    assert sweep("--steepness", *VALUES, raises=(0.05,))[1][1]["status"] == "error"
    _, rows, begun = sweep("--steepness", *VALUES)
    assert begun == [0.05]
    assert [row["status"] for row in rows] == ["ok"] * 3


def test_content_key_follows_everything_that_changes_a_result(monkeypatch):
    scenes = [load_scene("tethered_buoy", {"waves.steepness": value}) for value in (0.02, 0.13)]
    keys = [Job({}, scene, periods).key for scene, periods in itertools.product(scenes, (6, 7))]
    keys.append(Job({}, scenes[0], duration_s=6.0).key)
    monkeypatch.setattr("engine.source_hash", lambda: "another engine")
    keys.append(Job({}, scenes[0], 6).key)
    assert len(set(keys)) == len(keys)
    assert Job({"steepness": 1}, scenes[0], 6).key == keys[-1]  # a label changes nothing
