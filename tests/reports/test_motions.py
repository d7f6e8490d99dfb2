"""A sweep in which one value has several motions: colours, lines, shares and arrows are those of its tables."""

import shutil
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.colors import same_color

from campaigns.explore.rows import COLUMNS, STEEPNESS
from reports import build, content_of
from reports.buoy_sweep.figures import orbit_figure
from reports.buoy_sweep.runs import read_sweep
from reports.buoy_sweep.sheets import explorer as explorer_of
from reports.figures.quantities import colours_of, panels_over
from reports.parts.content import Explorer, Heading, Sheet, Table, Text, plain
from reports.parts.style import VERMILION
from reports.sweep.report import _maps_of_each, _panels
from tables import Column
from tests.campaigns.conftest import rows_of
from tests.reports.conftest import of_kind, panel_of, points_of, write
from tests.reports.test_words_apart import crowded

WORD, NUMBER = COLUMNS[2], STEEPNESS
MORE = (
    replace(WORD, name="motion"),
    replace(NUMBER, name="share"),
    replace(NUMBER, name="kicks"),
    replace(WORD, name="found_by"),
)
ENDS = tuple(replace(WORD, name=name) for name in ("motion", "end", "leads_to", "status")) + tuple(
    replace(NUMBER, name=f"steepness_{name}") for name in ("with", "without")
)
STARTS = (NUMBER, *(replace(WORD, name=name) for name in ("motion", "outcome")))
LARGE = {0.03: 0.25, 0.08: 0.5, 0.1: 0.25}  # where the motion of kA = 0.13 is too, and its share of the starts


@pytest.fixture
def several(folder, tmp_path):
    """The eight runs: A up to 0.1, B at 0.13, at 0.16 none; and B again at three smaller values, not at 0.05."""
    place = shutil.copytree(folder, tmp_path / "several", ignore=shutil.ignore_patterns("report.*", ".report*"))
    rows = rows_of(place)
    for row in rows:
        kA = float(row["steepness"])
        row |= {"motion": "" if row["status"] != "ok" else "B" if kA > 0.11 else "A", "found_by": "rest"}
        row["share"] = 0.5 if kA in LARGE else 1.0 if row["motion"] else ""
        row["kicks"] = 8 if row["motion"] else ""
    large = next(row for row in rows if row["motion"] == "B")
    rows += [{**large, "steepness": kA, "share": share, "found_by": "kick"} for kA, share in LARGE.items()]
    for peak_N, row in zip(range(1000, 9000, 10), sorted(rows, key=lambda row: row["motion"]), strict=False):
        row["tension_top_max_N"] = peak_N + (5000 if row["motion"] == "B" else 0)
        row["tension_top_max_error_N"] = 12.0
    write(place, rows, (*COLUMNS, *MORE))
    end = {"motion": "B", "end": "lower", "leads_to": "A", "status": "ok"}
    write(place / "ends", [{**end, "steepness_with": 0.021, "steepness_without": 0.019}], ENDS)
    start = {"steepness": 0.03, "outcome": "joined"}
    write(
        place / "starts",
        [{**start, "motion": motion} for motion in "AAB"] + [{**start, "outcome": "unsettled"}],
        STARTS,
    )
    return place


def test_each_motion_has_one_colour_and_a_line_joins_no_other(several, drawn):
    sweep = read_sweep(several)
    assert sweep.colours["B"] == VERMILION, "the largest tension"
    orbit_figure(sweep)
    assert not any(map(crowded, drawn))
    static_N, points = sweep.modes.static_tension_N, points_of(drawn[0].axes[0])
    for letter in "AB":
        tensions = {run.value: run["tension_top_max_N"] / static_N for run in sweep.motions[letter]}
        assert np.allclose(points[sweep.colours[letter]], sorted(tensions))
        mine = [
            curve
            for curve in panel_of(drawn[0], "largest T").lines
            if same_color(curve.get_color(), sweep.colours[letter])
        ]
        for line in mine:
            seen = {x: y for x, y in zip(*line.get_data(), strict=True) if np.isfinite(y)}
            assert seen == pytest.approx(tensions)
        gap = [x for x, y in zip(*mine[0].get_data(), strict=True) if np.isnan(y)]
        assert gap == [kA for kA in sweep.values if kA not in tensions], "broken where the motion is not"


def test_shares_fill_every_value_and_what_did_not_settle_is_hatched(several, drawn):
    orbit_figure(read_sweep(several))
    boxes = [
        (round(box.get_x(), 6), box.get_height(), bool(box.get_hatch())) for box in panel_of(drawn[0], "kicks").patches
    ]
    filled = Counter()
    for edge, height, _ in boxes:
        filled[edge] += height
    assert len(filled) == 6 and set(filled.values()) == {1.0}, "at 0.12 and 0.16 no run has a motion"
    assert sorted(height for _, height, hatched in boxes if hatched) == [0.25, 0.25]


def test_an_arrow_leads_from_the_motion_that_ends_to_the_one_that_follows(several, drawn):
    sweep = read_sweep(several)
    orbit_figure(sweep)
    panel = panel_of(drawn[0], "largest T")
    ((x, tail), (_, head)) = next((text.xyann, text.xy) for text in panel.texts if hasattr(text, "xyann"))
    first, near = sweep.motions["B"][0], sweep.motions["A"][0]
    assert x == 0.02 and near.value == 0.016 and first.value == 0.03
    assert np.array([tail, head]) * sweep.modes.static_tension_N == pytest.approx(
        [first["tension_top_max_N"], near["tension_top_max_N"]]
    )
    assert ".02" in [text.get_text() for text in panel.texts]


def test_every_row_has_its_sheet_and_leads_along_its_motion_and_across(several):
    items = content_of(several)[0].items
    sheets = {sheet.title: sheet for sheet in of_kind(items, Sheet)}
    assert len(sheets) == len({sheet.anchor for sheet in sheets.values()}) == 11
    (large,) = (sheet for title, sheet in sheets.items() if "kA = 0.08, motion B" in title)
    assert list(map(plain, large.lines)) == [
        "Next to it: kA = 0.03, motion B and kA = 0.1, motion B.",
        "At the same kA: kA = 0.08, motion A.",
    ]
    (explorer,) = of_kind(items, Explorer)
    assert {column.colour for column in explorer.columns} == set(read_sweep(several).colours.values())
    label, peaks_kN, errors_kN = explorer.lower[0]
    assert label == "peak tension (kN)" and set(errors_kN) == {0.012}
    assert peaks_kN == pytest.approx([1e-3 * run["tension_top_max_N"] for run in read_sweep(several).runs])
    length = Column("steepness", "m", "l_0")  # its label is drawn by the page, which knows no mathematics
    assert explorer_of(read_sweep(several, length)).x_label == "l0 (m)"
    motions, *_ = tables = of_kind(items, Table)
    assert [row[0] for row in motions.rows] == ["A", "B"]
    assert motions.rows[1][5:7] == ["2 of 8 to 8 of 8", "kick and rest"]
    (starts,) = (table for table in tables if "Starts at" in table.caption)
    assert starts.rows == [("0.03", "4", "0", "3", "1", "A 2, B 1")]


def test_a_run_between_takes_the_colour_of_the_motion_that_it_is_like(several):
    rows = {(row["motion"], float(row["steepness"])): row for row in rows_of(several)}
    unjudged = [{**rows[letter, 0.08], "steepness": 0.09, "regime": ""} for letter in "BA"]
    write(several / "between", unjudged)
    (several / "between" / "trajectories").symlink_to(several / "trajectories")
    assert [run.motion for run in read_sweep(several).between] == ["B", "A"]


def test_a_table_with_one_motion_gives_the_figure_of_one_without(folder, several):
    rows = [row | {"motion": "A" if row["status"] == "ok" else ""} for row in rows_of(folder)]
    write(several, rows, (*COLUMNS, MORE[0]))
    assert orbit_figure(read_sweep(several)) == orbit_figure(read_sweep(folder))


def test_a_sweep_of_any_key_keeps_motions_and_failed_runs_apart(drawn):
    key, depth, pull = Column("kA", digits=2), Column("H", digits=1), Column("tension_top_max_N", "N", digits=0)
    rows = [
        {"kA": kA, "H": 1.0, "motion": letter, "status": "ok", "tension_top_max_N": kA if letter == "A" else 9.0 + kA}
        for kA in (1.0, 2.0)
        for letter in "AB"
    ]
    rows.append(rows[0] | {"kA": 3.0, "status": "newton-failed", "tension_top_max_N": 3.0})
    motions, shown = colours_of(rows), [((pull, None),)]
    (panel,) = panels_over(rows, key, shown, motions)
    seen = {(curve.colour, curve.mark): curve.y.tolist() for curve in panel.curves if len(curve.y)}
    calm, worst = motions["A"], motions["B"]
    assert seen == {(calm, "o"): [1.0, 2.0], (calm, "x"): [3.0], (worst, "o"): [10.0, 11.0]} and worst == VERMILION
    maps = list(_maps_of_each([key, depth], rows, shown, motions))
    assert [heading.text[-8:] for heading in of_kind(maps, Heading)] == ["motion A", "motion B"]
    first = drawn[0].axes[0]
    assert (first.get_xlabel(), first.get_ylabel()) == ("kA (–)", "H (–)")
    assert first.images[0].get_array().tolist() == [[1.0, 2.0, 3.0]]
    for quantities in (shown, []):  # it says that there is nothing to draw only then
        assert bool(of_kind(_panels(key, rows, quantities, motions), Text)) == (not quantities)


@pytest.mark.slow
def test_a_click_chooses_the_motion_whose_point_is_nearest(several, browse):
    """At kA = 0.03, with the margins of the canvas: 48 and 10 pixels beside, 20 above, 44 and 92 a curve below."""
    (data,) = of_kind(content_of(several)[0].items, Explorer)
    everything = [point for column in data.columns for point in column.points]
    low, wide = min(everything), max(everything) - min(everything)
    with browse(build(several)[0]) as page:
        canvas = page.locator("#explorer canvas")
        canvas.evaluate("(one) => one.scrollIntoView({block: 'center'})")
        box = canvas.bounding_box()
        x = box["x"] + 48 + (box["width"] - 58) * (0.03 + (0.03 - 0.016) / 0.144) / 1.06
        for column in (candidate for candidate in data.columns if candidate.at == 0.03):
            share = 1.0 - (max(column.points, key=lambda point: abs(point - 20.8)) - low + 0.04 * wide) / (1.08 * wide)
            page.mouse.click(x, box["y"] + 20 + share * (box["height"] - 64 - 92 * len(data.lower)))
            assert page.evaluate("document.getElementById('explorer-sheet').dataset.run") == column.anchor
