"""`campaigns.regime_map`: cells and their borders on a system of known folds; a command whose runs may fail; cuts."""

import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns import buoy_sweep, regime_map
from campaigns.explore.grid import varied
from campaigns.regime_map import main, maps
from campaigns.regime_map.answer import sentences
from campaigns.regime_map.cells import CellGrid, Quadtree
from campaigns.regime_map.tables import _cell
from engine import load_scene
from reports.parts.content import Notice
from reports.regime_map.report import report
from tables import STATUS, Column, write_table
from tests.campaigns.conftest import finished, order_of, ran, rows_of, untimed
from tests.campaigns.explore.toy import Job, Scene, ToyMotions, explored
from tests.campaigns.fake_engine import FakeEngine
from tests.reports.conftest import of_kind

SIDE = 10  # so that no cell lies on the line of symmetry, where an unstable state is reached
VARY = "--vary", "waves.steepness", 0.02, 0.1, 3, "--vary", "water.depth_m", 21, 23, 2


def grid(*words):
    return CellGrid(tuple(varied(cell_of_table.split(), []) for cell_of_table in words))


def square(count=SIDE):
    return grid(f"waves.steepness -0.4 0.4 {count}", f"water.depth_m -0.4 0.8 {count}")


def area_of(shape, cell):
    return np.prod([*shape.widths(cell).values()])


def test_cells_beside_each_other_are_so_both_ways_and_parts_fill_their_cell():
    shape, tree = square(4), Quadtree()
    tree.add(shape.coarse())
    for cell in (tree.cells[5], tree.cells[10]):
        tree.add(cell.parts())
    tree.add(tree.cells[5].parts()[3].parts())
    for at in range(len(tree.cells)):
        assert all(at in tree.neighbours(neighbour) for neighbour in tree.neighbours(at))
    area = sum(area_of(shape, cell) for cell in tree.leaves())
    assert area == pytest.approx(16 * area_of(shape, tree.cells[0]))
    for cell in tree.leaves():
        (x, y), (wide, high) = shape.labels(cell).values(), shape.widths(cell).values()
        for neighbour in tree.touching(cell):
            (u, v), (w, h) = shape.labels(neighbour).values(), shape.widths(neighbour).values()
            gaps = abs(x - u) - 0.5 * (wide + w), abs(y - v) - 0.5 * (high + h)
            assert max(gaps) == pytest.approx(0.0, abs=1e-9)  # a side in common
            assert min(gaps) < -1e-9  # and not a corner only


def test_every_state_about_a_cusp_is_found_by_carrying_and_letters_are_one_a_cell(monkeypatch, tmp_path):
    shape, tree = square(), Quadtree()
    tree.add(shape.coarse())
    motions = ToyMotions(tmp_path, shape.columns, tree.neighbours, match_distance=0.1)
    jobs = [Job(shape.labels(cell), Scene(*shape.labels(cell).values())) for cell in tree.cells]
    for job, motions_here in zip(jobs, explored(monkeypatch, motions, jobs, kicks=0).at, strict=True):
        p, q = job.labels.values()
        assert len(motions_here) == (2 if q > 0 and p**2 < 4.0 * q**3 / 27.0 else 1)
        assert len({motion.branch.letter for motion in motions_here}) == len(motions_here)
    assert {motion.branch.letter for motion in motions.all_motions()} <= {"A", "B"}
    assert motions.starts.count < 4 * SIDE**2  # where a neighbour has a like motion, nothing is run


@pytest.fixture
def unscreened(monkeypatch):
    monkeypatch.setattr("campaigns.regime_map.maps.screened", lambda plan, scenes, *options: [[] for _ in scenes])


def test_runs_that_fail_are_cells_with_their_reason(tmp_path, unscreened):
    rows = ran(regime_map, tmp_path, *VARY, simulate=FakeEngine(raises=(0.06,)))
    cells = rows_of(tmp_path, "cells/table.csv")
    assert [(cell_of_table["waves.steepness"], cell_of_table["water.depth_m"]) for cell_of_table in cells] == [
        (kA, depth) for kA in ("0.02", "0.06", "0.1") for depth in ("21.0", "23.0")
    ]
    for cell_of_table in cells:
        failed = cell_of_table["waves.steepness"] == "0.06"
        assert (cell_of_table["source"], "a fault of the code" in cell_of_table["message"]) == (
            ("failed", True) if failed else ("computed", False)
        )
        assert cell_of_table["width_waves.steepness"] == "0.04"
    assert {row["status"] for row in rows} == {"ok", "error"} and len(rows) == 6
    assert {(row["regime"], row["verdict"]) for row in rows} == {("period-1", "cheap"), ("", "")}


def test_a_cell_has_the_largest_exponent_and_tension_of_its_motions():
    exponents, tensions_N = (0.02, None, 0.31, -0.4), (4.0, 9.0, 2.0, 7.0)
    motions = [SimpleNamespace(number=number, kicks=number) for number in range(4)]
    rows = [{"lyapunov_tangent_bits_per_period": exponent, "loop_releases": 0} for exponent in exponents]
    known = SimpleNamespace(row_of=lambda motion: rows[motion.number], kicks=6)
    known.tension_N = lambda motion: tensions_N[motion.number]
    cell = _cell(known, motions, {"status": "ok", "run_key": "a", "regime": "period-1"})
    assert (cell["exponent_max_per_period"], cell["tension_top_max_N"], cell["share_of_largest"]) == (0.31, 9.0, 1 / 6)


def test_the_answer_counts_cells_of_the_coarse_grid_and_names_the_largest_tension_with_its_kicks():
    tables = tomllib.loads(Path(__file__).with_name("answers.toml").read_text(encoding="utf-8"))["map"]
    keys = grid("waves.steepness 0 0.3 4").columns
    lines = sentences(tables["cells"], tables["motions"], keys, lambda row: load_scene("tethered_buoy"))
    answer = "\n".join(lines)
    assert all(words in answer for words in tables["words"]), answer


@pytest.mark.parametrize(
    ("evidence", "cheap"),
    [
        ("close: 0.001/0.002/yes", True),
        ("no growth: -1/0/yes", True),
        ("close: 0.004/0.002/no; no growth: 1/0/no", False),
    ],
)
def test_a_cheap_verdict_needs_a_close_return_or_perturbations_that_do_not_grow(evidence, cheap, monkeypatch):
    row = {"regime": "undecided", "strobed_period": 3, "evidence": evidence}
    monkeypatch.setattr(maps, "buoy_row", lambda run, judgement: dict(row))
    cell = maps.cell_row(SimpleNamespace(columns={"radius_rate_mps": [1.0], "angle_rate_radps": [1.0]}), None)
    assert (cell["regime"], cell["verdict"]) == (("period-3", "cheap") if cheap else ("undecided", "full"))


@pytest.mark.slow
def test_a_massless_screen_computes_no_cell(tmp_path):
    assert regime_map.main([*map(str, VARY), "--screen", "--out", str(tmp_path)], simulate=FakeEngine()) == 0
    cells = rows_of(tmp_path, "cells/table.csv")
    assert {cell_of_table["source"] for cell_of_table in cells} == {"screened"} and len(cells) == 6
    assert all(float(cell_of_table["tension_over_static"]) > 1.0 for cell_of_table in cells)
    assert not (tmp_path / "table.csv").exists()


def test_pages_are_values_or_words_of_a_third_key():
    order = order_of(regime_map, *VARY, "--pages", "buoy.submergence", "full", "spherical-cap")
    assert len(order.cases) == 12
    assert {case.scene.buoy.submergence for case in order.cases} == {"full", "spherical-cap"}
    assert [*order.cases[0].labels][:3] == ["buoy.submergence", "waves.steepness", "water.depth_m"]
    seconds = order_of(regime_map, *VARY, "--pages", "waves.period_s", "4", "6", "3")
    assert sorted({case.scene.waves.period_s for case in seconds.cases}) == [4.0, 5.0, 6.0]


@pytest.mark.slow
def test_a_cut_is_the_sweep_of_its_values_and_the_map_computes_nothing_again(tmp_path):
    """With the engine: rows, starts and ends of a cut are those of the sweep, but for their times."""
    small = ["--set", "tether.nodes=11", "--no-report", "--out"]
    of_map = ["--vary", "waves.steepness", 0.03, 0.05, 2, "--vary", "water.depth_m", 22, 22.5, 2, "--starts", 2]
    command = [*map(str, of_map), *small, str(tmp_path / "map")]
    assert main(command) == 0
    earlier, runs = rows_of(tmp_path / "map"), finished(tmp_path / "map")
    assert main(command) == 0 and rows_of(tmp_path / "map") == earlier and finished(tmp_path / "map") == runs
    assert main([*command, "--cut", "water.depth_m=22"]) == 0
    swept = [
        "--steepness",
        "0.03",
        "0.05",
        "--no-accuracy",
        *small,
        str(tmp_path / "sweep"),
        "--set",
        "water.depth_m=22",
    ]
    assert buoy_sweep.main(swept) == 0
    for table in ("table.csv", "starts/table.csv"):
        cut_rows, swept_rows = (
            rows_of(tmp_path / folder, table) for folder in ("map/cuts/water.depth_m=22.0", "sweep")
        )
        assert untimed(cut_rows) == untimed(swept_rows)
    rest = {row["run_key"] for row in earlier if row["found_by"] == "rest" and row["water.depth_m"] == "22.0"}
    assert len(rest) == 2 and rest <= {row["run_key"] for row in rows_of(tmp_path / "sweep")}


CURRENT = {"current": {"law": "uniform", "velocity_mps": [0.3, 0.0, 0.0]}}


def folder_of_curves(folder, keys=("waves.steepness", "water.depth_m"), changes=None):
    columns = [*COLUMNS, *(Column(key, "", key, "a key", 5) for key in keys), *ERRORS, STATUS]
    (folder / "curves").mkdir(parents=True)
    rows = [{"curve": 1, "place": place, "period": 1, "kind": "fold", keys[0]: value, keys[1]: 22.0, "status": "ok"}
            for place, value in enumerate((0.02, 0.1))]  # fmt: skip
    write_table(folder / "curves" / "table.csv", columns, rows)
    (folder / "scene.toml").write_text(load_scene("tethered_buoy", {"waves.ramp_s": 0.0, **(changes or {})}).to_toml())
    return str(folder)


COLUMNS = [Column(name, "", name, name) for name in ("curve", "place", "period", "kind", "special")]
ERRORS = [Column(name, "", name, name) for name in ("error_1", "error_2")]


def test_curves_of_orbits_are_drawn_and_cells_without_a_border_are_told(tmp_path, unscreened):
    folder = folder_of_curves(tmp_path / "orbits")
    ran(regime_map, tmp_path / "map", *VARY, "--curves", folder, simulate=FakeEngine())
    page = report(tmp_path / "map")
    assert "3 of 3 computed cells that a curve of orbits crosses" in str(of_kind(page.items, Notice)[-1])
    ran(regime_map, tmp_path / "map", *VARY, simulate=FakeEngine())
    assert not (tmp_path / "map" / "curves").exists()


@pytest.mark.parametrize(
    ("keys", "changes", "reason"),
    [
        (("waves.steepness", "waves.period_s"), {}, "has curves over waves.steepness and waves.period_s"),
        (("waves.steepness", "water.depth_m"), {"buoy.mass_kg": 1700.0}, "another buoy"),
        (("waves.steepness", "water.depth_m"), {"gravity_mps2": 9.7}, "another gravity_mps2"),
        (
            ("waves.steepness", "water.depth_m"),
            {"current": {"law": "uniform", "velocity_mps": [0.3, 0.0, 0.0]}},
            "another current",
        ),
        (("waves.steepness", "water.depth_m"), {"floor.stiffness_Npm3": 1e4}, "another floor"),
        (None, {}, "a folder of campaigns.orbits --curves"),
    ],
)
def test_curves_of_other_keys_or_scenes_are_refused(tmp_path, capsys, keys, changes, reason):
    folder = str(tmp_path)
    if keys is not None:
        folder = folder_of_curves(tmp_path / "orbits", keys, changes)
    assert main([*map(str, VARY), "--curves", folder, "--out", str(tmp_path / "map")]) == 2
    assert reason in capsys.readouterr().err and not (tmp_path / "map").exists()
