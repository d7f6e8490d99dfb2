"""`campaigns.sweep`: any number of any scene, one key or two (what cannot be varied: mistakes.toml); and a column and a
campaign of one's own, as docs/developing.md#a-campaign has them (tests/test_pages.py runs that page with the engine).
"""

import json
import math
import re
import sys
import time
import types
from collections import Counter
from copy import deepcopy
from dataclasses import replace
from functools import reduce
from itertools import product
from operator import getitem

import numpy as np
import pytest

from campaigns import orbits, regime_map, sea
from campaigns import sweep as sweep_command
from campaigns.explore import rows as of_a_buoy
from campaigns.explore.grid import varied
from campaigns.machinery import Summary
from campaigns.sweep.seas import statistics
from engine import Trajectory, load_scene, simulate
from engine.natural_frequencies import natural_frequencies
from engine.physics.waves import wave_number
from engine.scene import scene_from_toml
from reports import build
from reports.figures.quantities import measured
from reports.parts.content import Figure, Table, plain
from reports.sweep.report import report
from tables import Column
from tests.campaigns.conftest import built_twice, order_of, ran, rows_of
from tests.campaigns.fake_engine import FakeEngine, sines
from tests.pages import ROOT
from tests.reports.conftest import folder_at, of_kind

PAGE = "developing"
SHORT = ["--periods", "6", "--transient", "2"]
HELD = ["--scene", "hanging_line", "--duration", "2"]


def run(out, *words, **fake):
    return ran(sweep_command, out, *words, simulate=FakeEngine(**fake))


def cases_of(*words):
    return order_of(sweep_command, *words, "--out", "new").cases


def test_two_keys_are_every_pair_of_their_values(tmp_path):
    rows = run(tmp_path, "--vary", "water.depth_m", 21, 23, 3, "--vary", "waves.steepness", 0.02, 0.1, 2, *SHORT)
    varied = [(row["water.depth_m"], row["waves.steepness"]) for row in rows]
    assert varied == [(depth, kA) for depth in ("21.0", "22.0", "23.0") for kA in ("0.02", "0.1")]
    column_of_table = json.loads((tmp_path / "provenance.json").read_text())
    assert column_of_table["campaign"] == "sweep"
    assert column_of_table["vary"] == {"water.depth_m": [21.0, 22.0, 23.0], "waves.steepness": [0.02, 0.1]}
    columns = dictionary_of(tmp_path)
    assert list(columns) == list(rows[0])
    assert (columns["water.depth_m"]["unit"], columns["water.depth_m"]["symbol"]) == ("m", "H")
    assert (columns["waves.steepness"]["digits"], columns["status"]["digits"]) == ("2", "")


@pytest.mark.parametrize(("words", "left_out"), [((), 2.0), (("--transient", 3), 3.0)])
def test_of_an_irregular_sea_the_ramp_is_left_out_or_what_is_asked_for(words, left_out, tmp_path):
    sea = ("--set", "waves.jonswap.significant_height_m=1", "waves.ramp_s=10", "--periods", 120)
    rows = run(tmp_path, "--vary", "water.depth_m", 22, 23, 2, *sea, *words)
    assert [float(row["transient_periods"]) for row in rows] == [left_out] * 2
    assert all(row["tension_top_max_N"] for row in rows)


@pytest.mark.parametrize("second", [(), ("--vary", "waves.jonswap.seed", 1, 2, 2)], ids=["one key", "two keys"])
def test_in_a_sea_rows_have_statistics_in_place_of_regimes(second, tmp_path):
    """Against the plain moments of the trajectory and of the waves."""
    sea = ("--set", "waves.jonswap.significant_height_m=1.6", "buoy.submergence=spherical-cap", "tether.nodes=5")
    vary = ("--vary", "water.depth_m", 22.5, 23, 2, *second)
    rows = run(tmp_path, *vary, *sea, "--periods", 60, "--transient", 10)
    assert "regime" not in rows[0] and len(rows) == 2 ** (1 + bool(second))
    for row in rows:
        trajectory = Trajectory.load(tmp_path / "trajectories" / f"{row['run_key']}.nc")
        tension_N = trajectory["tension_top_N"][1000:]
        assert float(row["tension_mean_N"]) == pytest.approx(np.mean(tension_N))
        assert float(row["tension_std_N"]) == pytest.approx(np.std(tension_N))
        snaps = trajectory.snaps(transient_s=50.0)
        assert float(row["snaps_per_hour"]) == pytest.approx(len(snaps) / 250.0 * 3600.0, rel=1e-3)
        assert float(row["significant_elevation_m"]) == pytest.approx(1.6, rel=0.1)
    answer = (tmp_path / "answer.txt").read_text()
    words = [text.split()[0] for text in answer.splitlines() if text[:1].isupper()]
    assert words == ["SEA", "LOAD", "TENSION", "SNAPS", "OPEN"]
    build(tmp_path)


def test_the_waves_of_a_row_are_those_over_the_anchor():
    """Two waves of one period cancel half a wave length from where they add up."""
    waves = [{"period_s": 5.0, "amplitude_m": 0.5, "direction_rad": direction} for direction in (0.0, math.pi)]
    heights_m = []
    for length in (0.0, 0.25):
        sea = load_scene("tethered_buoy", {"waves": {"period_s": 5.0, "components": waves}})
        k = wave_number(5.0, sea.water.depth_m, sea.gravity_mps2)
        place = {"anchor.position_m": [length * 2.0 * math.pi / k, 0.0, 0.0]}
        scene = scene_from_toml(sea.to_toml(), place)
        columns = sines(scene, 60).columns
        heights_m.append(statistics(scene, columns, 0.0)["significant_elevation_m"])
    assert heights_m == pytest.approx([4.0 * math.sqrt(0.5), 0.0], abs=1e-3)


@pytest.mark.parametrize(
    ("key", "fixed"),
    [
        ("waves.relative_width", "waves.significant_steepness=0.1"),
        ("waves.significant_steepness", "waves.relative_width=0.1"),
    ],
)
def test_a_key_that_another_needs_can_be_varied(key, fixed):
    assert len(cases_of("--vary", key, 0.05, 0.1, 2, "--set", fixed, *SHORT)) == 2


@pytest.mark.parametrize("key", ["waves.relative_width", "start.buoy_velocity_mps[0]"])
def test_a_key_without_a_symbol_is_its_own_name_in_print(key):
    column = varied([key, "0", "0.1", "2"], []).column
    assert column.head == key.rpartition(".")[2].replace("_", " ") and "$" not in column.label


def test_a_sweep_of_steepness_has_the_rows_of_the_buoy_sweep(tmp_path, sweep):
    rows = run(tmp_path, "--vary", "waves.steepness", 0.02, 0.1, 3, *SHORT)
    _, buoy_rows, _ = sweep("--steepness-range", 0.02, 0.1, 3)
    assert [row["run_key"] for row in rows] == [row["run_key"] for row in buoy_rows]
    for row, one in zip(rows, buoy_rows, strict=True):
        assert row.pop("waves.steepness") == one["steepness"]
        assert row.items() <= one.items()


def test_a_long_sweep_of_a_buoy_carries_what_a_verdict_needs():
    (case, *_) = cases_of("--vary", "buoy.mass_kg", 1500, 1700, 2, "--periods", 210, "--transient", 70)
    assert case.scene.output.tangent_vectors == 1 and case.scene.output.lateral_growth
    (case, *_) = cases_of("--vary", "buoy.mass_kg", 1500, 1700, 2)  # from its first look without a period on
    assert case.scene.output.tangent_vectors == 0 and case.going is not None
    (case, *_) = cases_of("--vary", "buoy.mass_kg", 1500, 1700, 2, "--periods", 40, "--transient", 10)
    assert case.scene.output.tangent_vectors == 0


@pytest.mark.parametrize("name", ["breaking_line", "falling_chain", "hanging_line", "shaken_line", "twisted_rope"])
def test_any_shipped_scene_can_be_swept(name):
    assert len(cases_of("--scene", name, "--duration", "0.01", "--vary", "gravity_mps2", 9.5, 9.81, 3)) == 3


@pytest.mark.slow
def test_a_line_without_waves_has_a_row_of_its_own(tmp_path):
    rows = ran(sweep_command, tmp_path, *HELD, "--vary", "tether.nodes", 11, 31, 3)
    assert [row["tether.nodes"] for row in rows] == ["11", "21", "31"] and "regime" not in rows[0]
    tension = [float(row["tension_top_max_N"]) for row in rows]
    assert tension == pytest.approx([9.67] * 3, rel=0.01) and tension[2] != tension[1] != tension[0]


def dictionary_of(out) -> dict[str, dict[str, str]]:
    return {row["name"]: row for row in rows_of(out, "columns.csv")}


def test_the_column_of_the_page_reaches_the_table_and_its_dictionary(sweep, monkeypatch):
    page = (ROOT / "docs" / f"{PAGE}.md").read_text()
    column, line = re.findall(r"^    ((?:Column|row\[).*)$", page, re.MULTILINE)[:2]
    source = (ROOT / "campaigns" / "explore" / "rows.py").read_text()
    measured = re.search(r"\n( +)row \|= .*measured.*\n", source)
    patched = source.replace("    STROBED,\n", f"    {column}\n    STROBED,\n")
    patched = patched.replace(measured[0], f"{measured[0]}{measured[1]}{line}\n")
    module = types.ModuleType(of_a_buoy.__name__)
    exec(compile(patched, "rows.py", "exec"), vars(module))
    monkeypatch.setitem(sys.modules, of_a_buoy.__name__, module)
    _, (row,), _ = sweep("--steepness", "0.05")
    assert float(row["speed_max_mps"]) == pytest.approx(2 * 3.14159 / 5.0, rel=1e-3)  # of r = 20 + sin(2 pi t/5)
    column_of_table = dictionary_of(sweep.out)["speed_max_mps"]
    assert (column_of_table["unit"], column_of_table["digits"]) == ("m/s", "2")


DEPTH, MASS = "water.depth_m", "buoy.mass_kg"
KEYS = {
    DEPTH: Column(DEPTH, "m", "H", "depth of the water", 1),
    MASS: Column(MASS, "kg", "M", "mass of the buoy", 0),
}
COLUMNS = (
    Column("status", meaning="ok, or why the run ended early"),
    Column("regime", meaning="kind of motion"),
    Column("pull_min_N", "N", "T_min", "least pull", 0),
    Column("pull_max_N", "N", "T_max", "greatest pull", 0),
    Column("growth_bits", "bits", "σ", "growth", 3),
    Column("growth_error", "bits", "± σ", "its standard error", 3),
    Column("steps", "", "steps", "time steps", 0),
    Column("run_key"),
    Column("message"),
)


def table_of(keys):
    """Three values of each key; pulls that grow with them, the same steps in all runs, and one run that failed."""
    rows = []
    for number, values in enumerate(product((1.0, 2.0, 3.0), repeat=len(keys))):
        place, pull_N = dict(zip(keys, values, strict=True)), 100 * sum(values)
        pulls = {"pull_min_N": pull_N, "pull_max_N": 2 * pull_N, "growth_bits": 0.1 * number, "growth_error": 0.01}
        rows.append({**place, **pulls, "status": "ok", "regime": "period-1", "steps": 7, "run_key": "k"})
    rows[-1] = {**place, "status": "newton-failed", "message": "at t = 3 s", "run_key": "x"}
    return rows


@pytest.mark.parametrize("keys", [[DEPTH], pytest.param([DEPTH, MASS], marks=pytest.mark.slow)])
def test_the_report_of_a_sweep_of_any_key(tmp_path, keys):
    columns, vary = [*map(KEYS.get, keys), *COLUMNS], {key: [1.0, 2.0, 3.0] for key in keys}
    place = folder_at(tmp_path / "out", "sweep", table_of(keys), columns, scene="tethered_buoy", vary=vary)
    items = report(place).items
    tables = of_kind(items, Table)
    runs = next(table for table in tables[1:] if len(table.rows) == 3 ** len(keys))
    heads = [plain(column.title) for column in runs.columns]
    assert heads[: len(keys)] == ["H", "M"][: len(keys)] and {"Tmin", "Tmax", "σ", "status"} <= set(heads)
    extremes = {row[0]: row for row in tables[0].rows}
    assert set(extremes) == {"least pull", "greatest pull", "growth"}, "what is the same in all runs is no quantity"
    assert extremes["greatest pull"][1:3] == ["N", f"{200 * len(keys)}"]
    figures = of_kind(items, Figure)
    assert figures and all("σ" in figure.caption for figure in figures)
    page, _ = built_twice(place)
    assert b"newton-failed" in page


def test_errors_belong_to_their_quantity_and_ends_of_a_range_share_a_panel():
    panels = measured({column.name: column for column in COLUMNS}, table_of([DEPTH]), [DEPTH])
    names = [[(column.name, error and error.name) for column, error in panel] for panel in panels]
    assert names == [[("pull_min_N", None), ("pull_max_N", None)], [("growth_bits", "growth_error")]]


PUSH, SEA = (
    "start.buoy_velocity_mps",
    "waves.components=[{amplitude_m=0.3, period_s=6.0}, {amplitude_m=0.2, period_s=5.0}]",
)


@pytest.mark.parametrize(
    "keys",
    [
        (f"{PUSH}[0]",),
        (f"{PUSH}[0]", f"{PUSH}[2]"),
        ("buoy.mass_kg", f"{PUSH}[0]"),
        ("waves.components[1].amplitude_m", "waves.components[0].amplitude_m"),
    ],
)
def test_keys_take_their_values_in_lists_too_and_leave_the_rest(keys):
    ranges = {key: (1500, 1700) if key == "buoy.mass_kg" else (0.1, 0.4) for key in keys}
    words = [word for key, ends in ranges.items() for word in ("--vary", key, *ends, 2)]
    sea = [] if "waves" not in keys[0] else ["--set", SEA]
    cases = cases_of(*words, *SHORT, *sea)
    assert len(cases) == 2 ** len(keys)
    for case in cases:
        expected = deepcopy(cases[0].scene.as_dict())
        for key in keys:
            *parents, last = (int(part) if part.isdigit() else part for part in re.findall(r"\w+", key))
            reduce(getitem, parents, expected)[last] = case.labels[key]
        assert case.scene.as_dict() == expected


def test_from_python_a_sweep_is_the_table_of_its_folder_with_units(tmp_path):
    scene = load_scene("tethered_buoy", {"tether.nodes": 5, "waves.steepness": 0.02})
    table = sweep_command.sweep(
        scene, "waves.period_s", [4.0, 5.0, 7.0], periods=4, transient=1, jobs=1, out=tmp_path / "out", report=False
    )
    assert table["waves.period_s"].tolist() == [4.0, 5.0, 7.0] and set(table.status) == {"ok"}
    assert table.attrs["units"]["tension_top_max_N"] == "N" and table.attrs["answer"]
    assert [row["run_key"] for row in rows_of(tmp_path / "out")] == table.run_key.tolist()
    alone = simulate(scene.with_values("waves", period_s=5.0), periods=4)
    assert table.tension_top_max_N[1] == alone["tension_top_high_N"][100:].max()


@pytest.mark.parametrize(
    ("scene", "key", "values", "options", "fault"),
    [
        ("tethered_buoy", "waves.steepnes", [0.1], {}, "did you mean 'waves.steepness'"),
        ("tethered_buoy", "waves.steepness", [], {}, "values: given"),
        ("tethered_buoy", "waves.steepness", [0.1, "x"], {}, "values: given"),
        ("tethered_buoy", "waves.steepness", None, {}, "values: given"),
        ("tethered_buoy", "waves.steepness", [0.1], {"out": 5}, "out: given 5"),
        ("tethered_buoy", None, [0.1], {}, "key None: no such key"),
        ("tethered_buoy", "waves.steepness", [0.1], {"periods": "x"}, "--periods: given 'x'"),
        ("tethered_bouy", "waves.steepness", [0.1], {}, "did you mean 'tethered_buoy'"),
        (load_scene("tethered_buoy"), "waves.steepness", [-1.0], {}, "waves.steepness: given -1"),
    ],
)
def test_from_python_a_sweep_refuses_as_the_command_does(tmp_path, scene, key, values, options, fault):
    with pytest.raises(ValueError, match=fault):
        sweep_command.sweep(scene, key, values, **{"out": tmp_path / "out"} | options)
    assert not (tmp_path / "out").exists()


def test_a_tension_is_over_the_static_one_of_its_own_scene():
    """Which is proportional to gravity."""
    order = order_of(sweep_command, "--vary", "gravity_mps2", "2", "8", "2")
    static_N = natural_frequencies(order.cases[0].scene).static_tension_N
    rows = [{"status": "ok", "gravity_mps2": g, "tension_top_max_N": 3.0 * g / 2.0 * static_N} for g in (2.0, 8.0)]
    assert "3.0 times static, gravity_mps2 = 8" in sweep_command.STUDY.answer(order, rows)[0]


def test_the_time_of_a_study_is_that_of_all_its_work(tmp_path):
    """Compilation of 0.1 s, a step of 0.2 s that counts no time of its own, and another after it."""
    order = order_of(sweep_command, "--vary", "buoy.drag", "0.2", "0.4", "2", "--out", tmp_path)

    def runs(order, plan, jobs):
        time.sleep(0.3)
        return Summary([], 0, 0, Counter(compile_s=0.1))

    def later(plan, summary):
        time.sleep(0.2)
        return 0.0

    summary = replace(sweep_command.STUDY, runs=runs, beside=lambda order: [later]).work(order)
    assert 0.4 <= summary.times["run_s"] < 2.0


def test_a_key_with_a_line_end_is_no_key(tmp_path):
    faults = []
    sweep_command.read_order(["--vary", "\n", "1", "2", "3", "--out", str(tmp_path)], faults)
    assert faults == ["--vary \n: no such key"]


HEAVES = "buoy.mass_kg=100", "current.law=uniform", "current.velocity_mps=[0.1, 0.0, 0.0]"
IN_TWO_KEYS = "--vary", "water.depth_m", 26, 30, 2, "--vary", "current.velocity_mps[0]", 0.1, 0.3, 2


@pytest.mark.parametrize(
    ("campaign", "words", "count"),
    [
        (sweep_command, IN_TWO_KEYS, 4),
        (regime_map, IN_TWO_KEYS, 4),
        (sea, (*IN_TWO_KEYS, "--seeds", 1, "--starts", 1), 4),
        (orbits, ("--vary", "water.depth_m", 26, 30, "--values", 2), 2),
    ],
)
def test_the_own_value_of_a_key_that_is_varied_need_not_be_possible(campaign, words, count):
    """In 21 m, the depth of the shipped scene, this light buoy is out of the water; it is not in the range."""
    assert len(order_of(campaign, *words, "--set", "buoy.submergence=full", *HEAVES).cases) == count


def test_from_python_a_refusal_leaves_the_scene_of_earlier_results(tmp_path):
    (tmp_path / "given.toml").write_text("that of the results")
    with pytest.raises(ValueError, match="where a wave of 5 s breaks"):
        sweep_command.sweep(load_scene("tethered_buoy"), "waves.steepness", [9.0], out=tmp_path, starts="rest")
    assert (tmp_path / "given.toml").read_text() == "that of the results"
