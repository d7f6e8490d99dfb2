"""Law: a sea that cannot be is one message with its key and exit code 2; no command runs or writes anything."""

import numpy as np
import pytest

import engine.__main__ as one_run
from campaigns import basins, buoy_sweep, orbits, out_of_plane, regime_map, sea, sweep

HEIGHT = "waves.jonswap.significant_height_m"
GAUSSIAN = ("waves.significant_steepness=0.1", "waves.relative_width=")
TIME_S = 0.25 * np.arange(600)
WAVE_M = 0.5 * np.cos(2.0 * np.pi * TIME_S / 5.0)
COMMANDS = {
    "engine": (one_run, ("tethered_buoy", "--periods", "1")),
    "sweep": (sweep, ("--vary", "buoy.mass_kg", "1500", "1600", "2", "--periods", "2")),
    "sea": (sea, ("--no-regular", "--hours", "0.01")),
}
BAD = {
    "high": ((f"{HEIGHT}=40",), HEIGHT, "water.depth_m"),
    "short and steep": ((f"{HEIGHT}=1", "waves.period_s=0.1"), "waves.period_s", "as long as the buoy is wide"),
    "short": ((f"{HEIGHT}=0.001", "waves.period_s=0.1"), "waves.period_s", "as long as the buoy is wide"),
    "not a number": ((f"{HEIGHT}=nan",), HEIGHT, "finite number"),
    "seed of text": (
        (*GAUSSIAN[:1], "waves.relative_width=0.1", "waves.seed=abc"),
        "waves.seed",
        "--seed|whole number",
    ),
    "width below zero": ((GAUSSIAN[0], f"{GAUSSIAN[1]}-0.1"), "waves.relative_width", "from 0"),
    "width missing": (GAUSSIAN[:1], "waves.relative_width", "missing"),
    "steep component": (
        ("waves.components=[{period_s=0.1,amplitude_m=1}]",),
        "waves.components[0].amplitude_m",
        "waves break",
    ),
    "no component": (("waves.components=[]",), "waves.components", "a list of 1"),
}
RECORDS = {
    "no file": (None, "No such file"),
    "nothing": ("", "the first line is ''"),
    "no row": ("time_s,elevation_m\n", "at least one row"),
    "one column": ("time_s\n0\n1\n", "the first line is 'time_s'"),
    "other words": ("t,eta\n0,1\n", "the first line is 't,eta'"),
    "not a number": (np.where(TIME_S == 5.0, np.nan, WAVE_M), "elevation_m in line 22 is 'nan'"),
}


def refused(command, words, tmp_path, capsys):
    """The message of a command that refuses these --set."""
    module, usual = COMMANDS[command]
    out = tmp_path / ("figure.png" if command == "engine" else "out")
    assert module.main([*usual, "--set", *words, "--out", str(out)]) == 2
    assert not out.exists()
    return capsys.readouterr().err


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", BAD)
def test_a_sea_that_cannot_be_is_refused_by_its_key(name, command, tmp_path, capsys):
    words, key, reason = BAD[name]
    message = refused(command, words, tmp_path, capsys)
    assert key in message and any(part in message for part in reason.split("|"))


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", RECORDS)
def test_a_record_that_is_none_is_refused_by_its_key(name, command, tmp_path, capsys):
    content, reason = RECORDS[name]
    path = tmp_path / "gauge.csv"
    if isinstance(content, np.ndarray):
        rows = zip(TIME_S.tolist(), content.tolist(), strict=True)
        content = "time_s,elevation_m\n" + "".join(f"{t},{eta}\n" for t, eta in rows)
    if content is not None:
        path.write_text(content)
    message = refused(command, [f"waves.record={path}"], tmp_path, capsys)
    assert message.count("waves.record") == 1 and reason in message


@pytest.mark.parametrize("campaign", [buoy_sweep, basins, orbits, out_of_plane, regime_map])
def test_a_campaign_of_motions_names_the_one_that_answers_for_a_sea(campaign, tmp_path, capsys):
    assert campaign.main(["--set", f"{HEIGHT}=1", "--out", str(tmp_path / "out")]) == 2
    message = capsys.readouterr().err
    assert "campaigns.sea" in message and "faults" not in message
