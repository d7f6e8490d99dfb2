"""Bad input: every fault in one message, exit code 2, nothing written."""

import json

import pytest

from campaigns import buoy_sweep


def complaint(words, capsys):
    assert buoy_sweep.main(words) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "Traceback" not in captured.err
    return captured.err


def test_faults_of_options_and_scene_come_together(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    words = """--steepness 0.1 -1 x --periods 0 --transient 2.5 --jobs none --backend dusk --dask-address tcp://a:1
        --set buoy.mass_kg=-1 water.dpth_m=3 nonsense waves.steepness=0.1 --colour red --out deep/er"""
    text = complaint(words.split(), capsys)
    for part in (
        "'-1'", "'x'", "--periods", "'2.5'", "--jobs", "'dusk'", "--dask-address", "buoy.mass_kg", "water.dpth_m",
        "'nonsense'", "use --steepness", "--colour: no such option",
    ):  # fmt: skip
        assert part in text
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("words", "part"),
    [
        ("--steepness", "given nothing"),
        ("--steepness nan", "'nan'"),
        ("--steepness inf", "'inf'"),
        ("--steepness 0.1 --steepness-range 0 1 3", "given both"),
        ("--steepness-range 0.1 0.2", "LO HI COUNT"),
        ("--steepness-range 0.1 0.2 3 4", "LO HI COUNT"),
        ("--steepness-range 0.2 0.1 3", "LO HI COUNT"),
        ("--steepness-range 0.1 0.2 1", "LO HI COUNT"),
        ("--periods 1e3", "'1e3'"),
        ("--periods 5 6", "one value"),
        ("--periods 10 --transient 10", "less than --periods"),
        ("--set", "KEY=VALUE"),
        ("--set waves.amplitude_m=1", "use --steepness"),
        ("--set waves=none", "waves"),
        ("--set buoy=none", "buoy"),
        ("--scene nowhere.toml", "nowhere.toml"),
        ("--period 5", "did you mean --periods"),
        ("stray", "stray"),
        ("--no-report=yes", "--no-report"),
        ("--backend threading --dask-address tcp://a:1", "with --backend dask only"),
        ("--backend dask --dask-address tcp://a", "'tcp://a'"),
        ("--backend dask --dask-address a:99999", "tcp://HOST:PORT"),
        ("--set end.kind=held end.position_m=[0,0,20] buoy=none", "end.kind"),
    ],
)
def test_single_faults(tmp_path, monkeypatch, capsys, words, part):
    monkeypatch.chdir(tmp_path)
    assert part in complaint(words.split(), capsys)
    assert list(tmp_path.iterdir()) == []


def test_folder_that_cannot_be_one(tmp_path, capsys):
    (tmp_path / "file").write_text("mine")
    assert "is a file" in complaint(["--out", str(tmp_path / "file")], capsys)
    assert "is a file" in complaint(["--out", str(tmp_path / "file" / "below")], capsys)


@pytest.mark.parametrize(
    ("name", "content", "part"),
    [
        ("provenance.json", json.dumps({"campaign": "breaking_line"}), "breaking_line"),
        ("provenance.json", "not json", "no campaign wrote"),
        ("table.csv", "my,own,table\n", "no campaign wrote"),
    ],
)
def test_folder_of_something_else_is_left_alone(tmp_path, capsys, name, content, part):
    (tmp_path / name).write_text(content)
    assert part in complaint(["--out", str(tmp_path)], capsys)
    assert [path.name for path in tmp_path.iterdir()] == [name]
    assert (tmp_path / name).read_text() == content


def test_fault_common_to_all_runs_is_told_once(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert complaint(["--set", "buoy.mass_kg=-1"], capsys).count("buoy.mass_kg") == 1
