"""The report on orbits: solid where they are stable, dashed where not, and every caveat beside its number."""

import json
import shutil
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from campaigns.explore.rows import COLUMNS
from reports import content_of
from reports.orbits.branches import _nearest, read_branches
from reports.orbits.report import report
from reports.parts.content import Figure, Notice, Table
from reports.parts.folder import FolderError, read_folder
from tests.campaigns.conftest import rows_of
from tests.reports.conftest import columns_of, folder_at, of_kind, write
from tests.reports.test_words_apart import crowded

WORDS = ("branch", "kind", "motion", "begins", "ends", "leads_to", "found_by", "status", "message")
SYMBOLS = {"steepness": "kA"}
TABLES = tomllib.loads(Path(__file__).with_name("orbits.toml").read_text(encoding="utf-8"))
FOLD, FLIP = (event["steepness"] for event in TABLES["events"])  # at the fold orbits are 21 m, the multiplier is 1


@pytest.fixture
def orbits(folder, tmp_path):
    """A saddle comes up to the fold, the node leaves it, flips, and begins a branch of period 2 that ends early."""
    usual, rows = {"status": "ok", "message": "", "motion": "A"}, []
    strobes = ["branch,place,strobe,radius_m"]
    for name, period, places in (("1", 1, np.linspace(-0.3, 0.3, 14)), ("2", 2, np.linspace(0.02, 0.2, 8))):
        for number, s in enumerate(places):
            kA = (FOLD, FLIP)[period - 1] + s**2
            mu = 1.0 - 2.0 * s / np.sqrt(FLIP - FOLD) if period == 1 else 0.5
            rows.append(usual | {
                "branch": name, "place": number, "steepness": kA, "period": period, "unstable": int(abs(mu) > 1.0),
                "multiplier_1_real": mu, "multiplier_1_imag": 0.0, "multiplier_1_error": 0.01, "gap": 1e-12,
                "multiplier_modulus": abs(mu), "tension_top_max_N": 3000.0 + 5000.0 * s,
            })  # fmt: skip
            strobes += [f"{name},{number},{k},{21.0 + 0.1 * k + kA}" for k in range(period)]
    timing = json.loads((folder / "provenance.json").read_text())
    columns, vary = columns_of(rows, WORDS, SYMBOLS), {"steepness": [0, 1]}
    place = folder_at(tmp_path / "orbits", rows=rows, columns=columns, **timing | {"campaign": "orbits", "vary": vary})
    (place / "answer.txt").write_text("Two branches.")
    (place / "strobes.csv").write_text("\n".join(strobes))
    chosen = [rows[2], rows[11]]
    for part, table in (TABLES | {"orbits": chosen}).items():
        write(place / part, table, columns_of(table, WORDS, SYMBOLS))
    for row in chosen:
        history = "time_s,radius_m,radius_rate_mps,tension_top_N\n0,21,0,100\n1,22,1,200\n2,21,0,100\n"
        (place / "orbits" / f"1_{row['place']}.csv").write_text(history)
    runs = [row | {"motion": "AB"[float(row["steepness"]) > 0.09]} for row in rows_of(folder) if row["status"] == "ok"]
    write(place / "motions", runs, (*COLUMNS, replace(COLUMNS[2], name="motion")))
    (place / "motions" / "trajectories").symlink_to(folder / "trajectories")
    return place


def test_a_line_is_solid_between_the_events_where_it_is_stable(orbits):
    first, two = read_branches(read_folder(orbits), "steepness", [])
    assert first.colour == two.colour, "it begins at an event of the first"
    saddle, node, flipped = first.lines("strobes")
    assert [curve.line == "-" for curve in (saddle, node, flipped)] == [False, True, False]
    assert node.x[0] == saddle.x[-2] == FOLD and node.x[-2] == flipped.x[0] == FLIP
    known = np.isfinite(node.x)
    assert np.allclose(node.y[known][1:-1] - node.x[known][1:-1], 21.0)
    moduli = np.concatenate([curve.y for curve in first.lines("modulus")])
    assert (moduli == 1.0).sum() == 4, "both ends of the node, and the ends of its neighbours"
    (solid,) = two.lines("strobes")
    assert np.isnan(solid.x).sum() == 2 and solid.line == "-", "two strobes"


def test_the_answer_is_a_picture_and_caveats_stand_beside_their_numbers(orbits, drawn):
    first, table, *items = content_of(orbits)[0].items[2:]  # behind the answer, and how long it took
    assert isinstance(first, Figure) and first.narrow is not None and not any(map(crowded, drawn))
    cells = {row[1]: row[2] for row in table.rows}
    assert cells == {"fold": "0.06000\u00a0±\u00a00.0001", "flip": "0.11000\u00a0±\u00a00.0009‡†"}
    (notice,) = of_kind(items, Notice)
    caveats = " ".join(notice.lines)
    assert "Branch 2 was not followed to its end: at 0.15" in caveats and "flip of branch 1 at 0.1100" in caveats
    multipliers = next(table for table in of_kind(items, Table) if table.columns[2].title == "μ1")
    known = [float(row["multiplier_1_real"]) for row in rows_of(orbits / "orbits")]
    assert [row[2] for row in multipliers.rows] == [f"{mu:.3f} (0.01)".replace("-", "−") for mu in known]


def test_an_event_lies_between_the_same_orbits_in_every_unit():
    """On a straight line the nearest point is that of equal shares of both ranges, from N to MN."""
    points, event = np.array([[0.0, 0.0], [1.0, 1000.0], [2.0, 2000.0]]), np.array([0.4, 1300.0])
    for unit in (1.0, 1e-3, 1e-6):
        assert _nearest(points * [1.0, unit], event * [1.0, unit]) == (0, pytest.approx(0.5 * (0.4 + 1.3)))


def test_orbits_without_runs_or_events_are_drawn_too(orbits):
    for part in ("motions", "events", "orbits", "branches"):
        shutil.rmtree(orbits / part)
    items = report(orbits).items
    assert len(of_kind(items, Figure)) == 2
    (notice,) = of_kind(items, Notice)
    assert len(notice.lines) == 1 and notice.lines[0].startswith("Branch 1 changes its stability at")


def test_a_folder_that_does_not_tell_its_key_is_refused(orbits):
    (orbits / "provenance.json").write_text('{"campaign": "orbits"}')
    with pytest.raises(FolderError, match="what was varied"):
        report(orbits)
