"""Regime maps: shares are areas of what is on top, nothing screened counts as computed, every cell has its sheet."""

import base64
import json
import re
import tomllib
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from scipy.spatial.distance import pdist

from engine import load_scene
from reports import build, content_of
from reports.figures.regime_map import HATCHES, Map, Page, regime_maps, widest
from reports.parts.content import CellSheets, Figure, Table
from reports.parts.folder import FolderError, read_folder
from reports.parts.html import packed
from reports.parts.style import MAP_PERIODS, REGIME_COLOURS
from reports.regime_map import draw
from reports.regime_map.maps import _EXPONENT, COMPUTED, LIMITS, SCREENED, legend, numbers, read_atlas, regimes
from reports.regime_map.report import _regimes, _warnings
from reports.regime_map.sheets import cell_sheets
from tables import read_table
from tests.campaigns.fake_engine import sines
from tests.reports.conftest import columns_of, folder_at, of_kind, write
from tests.reports.test_browser import violations
from tests.reports.test_words_apart import crowded

X, Y, PAGE = "waves.steepness", "water.depth_m", "buoy.submergence"
WORDS = {PAGE, "source", "regime_rest", "run_key_rest", "motion", "found_by", "verdict", "status", "regime", "run_key",
         "message", "regime_reason", "evidence"}  # fmt: skip
SYMBOLS = {X: "kA", Y: "H", PAGE: "submergence"}
NX, NY, WIDE, HIGH = 8, 6, 0.02, 0.7
PERIOD_S = 5.0  # of the scene's waves
BORDER = 0.116  # of chaos, in steepness: the cells on it are bisected
EYES = tomllib.loads(Path(__file__).with_name("eyes.toml").read_text(encoding="utf-8"))


def cell(x, y, level, page=""):
    """A cell with a motion from rest, chaotic above the border, and above it a second one that pulls harder."""
    failed, two = (x, y) == (0.02, 21.0), x > BORDER
    row = {PAGE: page} if page else {}
    row |= {X: x, Y: y, f"width_{X}": WIDE / 2**level, f"width_{Y}": HIGH / 2**level, "level": level}
    nothing = ("motions", "tension_over_static", "share_of_largest", _EXPONENT, "loops", "leaves_water", "message")
    row |= dict.fromkeys(nothing, "")
    if failed:
        return row | {"source": "failed", "regime_rest": "", "message": "no <convergence>"}
    if y > 24.0 and x < 0.06:
        return row | {"source": SCREENED, "regime_rest": "irregular"}
    return row | {
        "source": COMPUTED, "regime_rest": "chaotic" if two else "period-1" if y < 23.0 else "period-5",
        "motions": 1 + two, "tension_over_static": round(3.0 + 90.0 * x + y / 9.0, 6),
        "share_of_largest": 0.25 if two else 1.0, _EXPONENT: 0.3 if two else -0.4,
        "loops": int(x > 0.13), "leaves_water": int(y < 21.5),
    }  # fmt: skip


def motions_of(row):
    """The rows of `table.csv` of a cell."""
    usual = {name: row[name] for name in (PAGE, X, Y, "level") if name in row} | {
        "share": 0.5, "found_by": "rest", "status": "ok", "message": "", "run_key": "0", "radius_min_m": 20.0,
        "periods": 8.0, "end_time_s": 8.0 * PERIOD_S, "regime_reason": "it repeats",
        "evidence": "contraction: 0.53/1/yes", "verdict": "full", "tension_top_max_N": "",
    }  # fmt: skip
    if row["source"] == "failed":
        yield usual | {"status": "newton-failed", "message": "no <convergence>", "motion": "", "regime": ""}
    if row["motions"]:
        pull_N = 2000.0 * row["tension_over_static"]
        calm = {"motion": "A", "regime": row["regime_rest"], "verdict": "cheap"}
        yield usual | calm | {"tension_top_max_N": pull_N - 900.0 * (row["motions"] - 1)}
        if row["motions"] == 2:
            yield usual | {"motion": "B", "regime": "period-2", "tension_top_max_N": pull_N}


@pytest.fixture
def folder_of(tmp_path):
    """`folder_of(pages)`: a folder of maps over steepness and depth."""

    def made(pages=("",), counts=(NX, NY)):
        cells = []
        for page in pages:
            for j, i in np.ndindex(counts[::-1]):
                x, y = round(0.02 + WIDE * i, 9), round(21.0 + HIGH * j, 9)
                cells.append(cell(x, y, 0, page))
                if abs(x - BORDER) < 0.6 * WIDE:
                    quarter = [(x + a * WIDE / 4, y + b * HIGH / 4) for a in (-1, 1) for b in (-1, 1)]
                    cells += [cell(*at, 1, page) for at in quarter]
        rows = [motion for row in cells for motion in motions_of(row)]
        place, vary = tmp_path / f"maps{len(pages)}{counts[0]}", {X: [], Y: []}
        folder_at(place, "regime_map", rows, columns_of(rows, WORDS, SYMBOLS), vary=vary)
        write(place / "cells", cells, columns_of(cells, WORDS, SYMBOLS))
        sines(load_scene("tethered_buoy"), 8).save(place / "trajectories" / "0.nc", {"run_key": "0"})
        strobes = {"radius_m": np.linspace(19.0, 21.0, 64)[None], "tension_N": np.full((1, 64), 2400.0)}
        np.savez(place / "strobes.npz", run_key=np.array(["0"]), **strobes)
        return place

    return made


def atlas_of(place):
    return read_atlas(read_folder(place))


def test_shares_are_areas_of_the_cells_on_top(folder_of):
    """A bisected cell counts by its parts: a quarter of a cell each."""
    atlas = atlas_of(folder_of())
    (page,) = atlas.pages
    parts = np.array([4.0 ** -row["level"] for row in page.rows]) / (NX * NY)
    covered = page.area == 0.0
    assert np.allclose(page.area[~covered], parts[~covered]) and page.area.sum() == pytest.approx(1.0)
    assert {row["level"] for row, hidden in zip(page.rows, covered, strict=True) if hidden} == {0}
    assert atlas.share(lambda page: page.kinds == "chaotic") == pytest.approx(2.5 / NX), (
        "half of the bisected column, and two others"
    )


def test_nothing_screened_counts_as_computed(folder_of, drawn):
    place = folder_of()
    atlas = atlas_of(place)
    texts = [text for _, text in legend(atlas)]
    shares = {text.partition(":")[0]: float(text.split()[-2]) for text in texts if text.endswith("%")}
    kinds = ("period 1", "period 5", "chaotic", "only screened", "failed")
    assert sum(shares[kind] for kind in kinds) == pytest.approx(100.0, abs=1.5), "each rounded to two digits"
    assert "irregular, screened" in texts
    (page,) = atlas.pages
    shown = regimes(page)
    worst = page.rows[shown.star]
    assert worst["source"] == COMPUTED
    regime_maps([shown], atlas.labels, (), ((), ()), 1)
    (star,) = (line for line in drawn[0].axes[0].lines if line.get_marker() == "*")
    assert star.get_xydata() == pytest.approx(np.array([[worst[X], worst[Y]]]))
    assert "irregular" not in {row[0] for row in _regimes(atlas).rows}
    notice = _warnings(read_folder(place), atlas)
    assert "only screened" in notice.lines[0] and "no <convergence> (1)" in notice.lines[1]
    assert any("verdicts are cheap" in line for line in notice.lines)


def test_a_limit_of_the_whole_map_is_a_sentence_and_no_hatch(folder_of):
    place = folder_of()
    cells = [cell | {"leaves_water": 1} for cell in read_table(place / "cells" / "table.csv")]
    write(place / "cells", cells, columns_of(cells, WORDS, SYMBOLS))
    atlas = atlas_of(place)
    assert [text.partition(":")[0] for look, text in legend(atlas) if look in HATCHES] == [LIMITS["loops"]]
    assert list(atlas.pages[0].hatched) == [LIMITS["loops"]]
    assert any(line.startswith("On 100 % of the map the sphere") for line in _warnings(read_folder(place), atlas).lines)


def test_lines_lie_between_cells_that_differ_and_nowhere_else(drawn):
    """A chess board of 4 x 3 cells: every inner side is a border once; two cells of one kind have none."""
    i, j = (index.ravel() for index in np.meshgrid(np.arange(4.0), np.arange(3.0)))
    for kinds, length in (((i + j) % 2, 3 * 3 + 4 * 2), (i > 1.5, 3), (0 * i, 0)):
        page = Page(np.column_stack([i, i + 1, j, j + 1]), kinds.astype(str), np.full(12, COMPUTED))
        (picture, places) = regime_maps([Map(page, "", np.full(12, "#a0a0a0"))], ("x", "y"), (), ((), ()), 1)
        line = drawn[-1].axes[0].lines[0]
        steps = np.diff(np.column_stack(line.get_data()).reshape(-1, 3, 2)[:, :2], axis=1)
        assert np.abs(steps).sum() == pytest.approx(length)
    _, top, _, height = places[0].place
    assert picture.kind == "svg" and 0.0 < top < 1.0 - top - height, "numbers and a label stand below"


@pytest.mark.parametrize("eyes", EYES)
def test_regimes_are_told_apart_by_every_eye(eyes):
    """In CIELAB by 12 or more: five times what is just noticed."""
    colours = np.array([to_rgb(colour) for colour in {*MAP_PERIODS, *REGIME_COLOURS.values()}])
    linear = np.where(colours > 0.04045, ((colours + 0.055) / 1.055) ** 2.4, colours / 12.92)
    seen = np.clip(linear @ np.transpose(EYES[eyes]), 0.0, 1.0)
    xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]
    x, y, z = np.cbrt(seen @ np.transpose(xyz) / np.sum(xyz, axis=1)).T
    assert pdist(np.column_stack([116 * y, 500 * (x - y), 200 * (y - z)])).min() > 12.0


def test_of_places_of_one_width_a_word_stands_in_the_middle():
    assert widest(np.ones((3, 9), bool)) == (1, 4)


def test_every_cell_on_top_has_its_sheet_with_its_motions_and_their_series(folder_of):
    place = folder_of()
    sheets = cell_sheets(read_folder(place), atlas_of(place))
    cells = {cell["name"]: cell for cell in json.loads(zlib.decompress(base64.b64decode(packed(sheets))))}
    assert len(cells) == NX * NY + 3 * NY, "a bisected one is told by its parts"
    large = cells["kA = 0.16, H = 24.5"]
    assert [motion["motion"] for motion in large["motions"]] == ["A", "B"] and "released" in large["note"]
    assert "contraction 0.53 (threshold 1, met)" in large["motions"][0]["said"]
    (low, high), (_, pull) = large["scales"]
    radius, tension, strobes, _ = (np.array(steps) / 999 for steps in large["motions"][1]["series"])
    assert pull == 2510.0 and tension.max() == 1.0, "the largest between samples is kept"
    assert np.allclose(low + (high - low) * strobes, np.linspace(19.0, 21.0, 64), atol=2e-3)
    truth = 20.0 + np.sin(2.0 * np.pi * np.linspace(0.0, 4.0, 201)[:-1])
    assert np.allclose(low + (high - low) * radius, truth, atol=0.05)
    screened = cells["kA = 0.02, H = 24.5"]
    assert screened["motions"] == [] and "not computed" in screened["note"]


def test_pages_share_their_scales_and_a_quantity_that_no_cell_has_is_given_no_map(folder_of):
    atlas = atlas_of(folder_of(("full", "spherical-cap")))
    columns = {
        "number of motions": "motions",
        "largest tension over static": "tension_over_static",
        "largest exponent (–)": _EXPONENT,
    }
    for title, column in columns.items():
        seen = set()
        for page, maps in zip(atlas.pages, numbers(atlas), strict=True):
            (shown,) = (candidate for candidate in maps if candidate.title == title)
            seen.update(zip(page.column(column), shown.colours, strict=True))
        known = {(value, colour) for value, colour in seen if np.isfinite(value)}
        assert len(known) == len(dict(known)) > 1
        _, norm, _ = shown.scale
        assert norm.vmin <= min(known)[0] and max(known)[0] <= norm.vmax
    first = atlas.pages[0]
    bare = atlas._replace(pages=[replace(first, rows=[row | {_EXPONENT: None} for row in first.rows])])
    titles, rest = ([shown.title for shown in numbers(pages)[0]] for pages in (atlas, bare))
    assert rest == titles[:3]


def test_the_first_map_is_drawn_from_what_is_there(folder_of, tmp_path):
    place, path = folder_of(), tmp_path / "map.png"
    for part in ("table.csv", "columns.csv", "provenance.json", "scene.toml"):
        (place / part).unlink()
    draw(place, path)
    assert path.read_bytes().startswith(b"\x89PNG")
    path.unlink()
    table = place / "cells" / "table.csv"
    table.write_text(table.read_text().partition("\n")[0] + "\n")  # no cell yet
    draw(place, path)
    assert not path.exists()


def test_a_screen_alone_has_its_report_too(folder_of):
    place = folder_of(counts=(2, 6))
    for part in ("table.csv", "columns.csv"):
        (place / part).unlink()
    with pytest.raises(FolderError, match=r"table\.csv"):
        content_of(place)  # cells that were computed need it
    table = place / "cells" / "table.csv"
    table.write_text(table.read_text().replace(COMPUTED, SCREENED))
    items = content_of(place)[0].items
    (first, *_), (sheets,) = (of_kind(items, kind) for kind in (Figure, CellSheets))
    assert not any(cell["motions"] for cell in sheets.cells)
    assert "only screened" in first.alt and "chaotic" not in first.alt
    assert "motion from rest" not in {table.columns[0].title for table in of_kind(items, Table)}
    table.unlink()
    with pytest.raises(FolderError, match="cells"):
        content_of(place)


@pytest.mark.slow
def test_each_page_has_its_maps_and_no_word_lies_on_another(folder_of, drawn):
    figures = of_kind(content_of(folder_of(("full", "spherical-cap")))[0].items, Figure)
    assert [len(figure.places[0]) for figure in figures] == [2, 4, 4] and not any(map(crowded, drawn))
    assert [{place.page for place in figure.places[1]} for figure in figures] == [{0, 1}, {0}, {1}]


@pytest.mark.slow
@pytest.mark.parametrize("window", [{}, {"color_scheme": "dark"}, {"width": 400, "height": 800}])
def test_a_click_opens_the_sheet_and_arrows_walk_along_the_row(folder_of, browse, window):
    with browse(build(folder_of())[0], **window) as page:
        page.wait_for_selector("#cells-hint:not([hidden])")
        picture = page.locator("#figure-1 picture")
        places = json.loads(page.locator("#figure-1").get_attribute("data-places"))
        (edge, top, wide, high), (x0, x1, y0, y1), _ = places[window.get("width", 1200) < 700][0]
        box = picture.bounding_box()

        def steepness(*keys):
            for key in keys:
                page.keyboard.press(key)
            return float(re.search(r"kA = ([\d.]+), H", page.locator("#cell [role=status]").text_content())[1])

        x, y = edge + wide * (0.02 - x0) / (x1 - x0), top + high * (y1 - 23.8) / (y1 - y0)
        picture.click(position={"x": x * box["width"], "y": y * box["height"]})
        seen = [steepness(), *(steepness("ArrowRight") for _ in range(8))]
        assert seen == [0.02, 0.04, 0.06, 0.08, 0.1, 0.115, 0.125, 0.14, 0.16], "both halves of the bisected one"
        assert page.locator("#cell td:visible").count() >= 2 * 4 and page.locator(".chosen").count() == 5
        assert violations(page) == []
        assert steepness("ArrowUp", *["ArrowLeft"] * 8) == 0.02
        assert page.locator("#cell svg:visible, #cell tr:visible").count() == 0, "only screened"
        page.keyboard.press("Escape")
        assert not page.locator("#cell").is_visible() and page.locator(".chosen").count() == 0
        assert [url for url in page.asked if not url.startswith(("file:", "data:"))] == []
