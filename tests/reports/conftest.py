"""Campaign folders and their pages, made once for the tests that only look at them, and a browser to open them with.

The browser is the Chromium of the machine, driven by Playwright. Where there is none, the tests that open a page are
skipped, and `pytest` says so with the reason at its end (`-rs` in pyproject.toml).
"""

import re
import shutil
from collections.abc import Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from html.parser import HTMLParser
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.figure import Figure as Drawing

from campaigns import buoy_sweep
from campaigns.explore.rows import COLUMNS, STEEPNESS
from campaigns.machinery.folder import write_json
from engine.scene import load_scene
from reports import build, content_of
from reports.parts.content import (
    Bullets,
    CellSheets,
    Explorer,
    ExplorerColumn,
    Figure,
    Head,
    Heading,
    Item,
    Links,
    Listing,
    MapPlace,
    Notice,
    Picture,
    Report,
    Sheet,
    Table,
    Text,
)
from reports.parts.html import render_html
from reports.parts.sections import equation
from tables import write_table
from tests.campaigns.fake_engine import FakeEngine, sines

WORD = COLUMNS[2]
MESSAGE = "Newton's method did not converge <at> t = 12 s, #step $x$ 1e-9"
ODD_TITLE = '<b>#odd$ *title* _x_ @ref `code` \\ "q" & [z] //c é\u2028 </title>'
WHOLE = MapPlace((0.0, 0.0, 1.0, 1.0), (0.0, 1.0, 0.0, 1.0))
DOT = b'<svg xmlns="http://www.w3.org/2000/svg" width="490" height="200"><circle r="40"/></svg>'

LONG = " `a_rather_long_name_of_a_column_of_the_table_N` --out /a/path/that/has/no/blank/in/it/and/goes/on/and/on"


@dataclass(frozen=True)
class Motions(FakeEngine):
    """Period 1 below kA = 0.06, period 2 to 0.1, two incommensurate frequencies above.

    failing: steepness -> (status, periods reached).
    """

    failing: Mapping[float, tuple[str, float]] = field(default_factory=dict)

    def __call__(self, scene, periods=None, duration_s=None):
        kA = scene.waves.steepness
        status, reached = self.failing.get(kA, ("ok", periods or duration_s / scene.waves.period_s))
        message, releases = "" if status == "ok" else MESSAGE, 7 if kA > 0.12 else 0
        run = sines(scene, reached, status, message, tension=(2000.0, 5e4 * kA), releases=releases)
        step_s = scene.sample_step_s()  # one more on both sides, for rates at the ends
        phase = 2.0 * np.pi / scene.waves.period_s * step_s * np.arange(-1, len(run.columns["time_s"]) + 1)
        modulation = 0.8 * np.sin(0.5 * phase + 0.3) if 0.06 <= kA < 0.1 else 0.0
        modulation = 0.7 * np.sin(phase / np.pi) * np.cos(phase / np.e) if kA >= 0.1 else modulation
        r = 20.8 + 12.0 * kA * (np.sin(phase) + modulation)
        changed = {"radius_m": r[1:-1], "radius_rate_mps": np.gradient(r, step_s)[1:-1]}
        changed["z_m"] = changed["radius_m"] * np.cos(run.columns["angle_rad"])
        return replace(run, columns=run.columns | changed)


def campaign(directory: Path, steepness, periods=80, transient=20, failing=None, overrides=None) -> Path:
    """The folder of a sweep of `Motions`. overrides: of the scene `tethered_buoy`."""
    scene = Path(directory).with_suffix(".toml")
    scene.parent.mkdir(parents=True, exist_ok=True)
    scene.write_text(load_scene("tethered_buoy", overrides or {}).to_toml(), encoding="utf-8")
    length = ["--periods", str(periods), "--transient", str(transient), "--scene", str(scene)]
    options = ["--jobs", "1", "--backend", "threading", "--no-report", "--no-accuracy", "--out", str(directory)]
    swept = ["--steepness", *map(str, steepness), "--set", "output.tangent_vectors=0"]
    assert buoy_sweep.main([*swept, *length, *options], simulate=Motions(failing=failing or {})) in (0, 1)
    return Path(directory)


class Page(HTMLParser):
    """The start tags of a page as (tag, attributes), and the text outside of style elements."""

    def __init__(self, source: str):
        super().__init__()
        self.tags, self.text = [], ""
        self.feed(re.sub(r"<style>.*?</style>", "", source, flags=re.DOTALL))

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_data(self, data):
        self.text += data

    def all(self, wanted: str) -> list[dict]:
        """The attributes of every such tag."""
        return [attributes for tag, attributes in self.tags if tag == wanted]


def every_kind(text: str) -> Report:
    """A report of every kind of item, with the text in every place where text can be, in wide tables too."""
    words = text or "x"
    dot = Picture(DOT, "svg")
    drawing = Figure(
        dot, f"{words} caption", f"{words} of five words", Picture(b"GIF89a", "gif"), dot, ((WHOLE,), (WHOLE,))
    )
    heads = tuple(Head(words, words, "right" if k else "left") for k in range(14))
    narrow, wide = Table(heads[:1], ((text,),) * 40, text, small=True), Table(heads, ((text,) * 14,) * 4, text)
    cell = {"page": 0, "box": [0, 1, 0, 1], "name": text, "note": text, "scales": [[0, 1], [0, 1]]}
    motion = {"motion": text, "colour": "", "facts": [text], "said": text, "series": [[0, 999], [9], [5], [9]]}
    items = (
        Heading(text), Text(text + LONG), Heading(text, 2), Bullets((text, text)), equation("buoy"), drawing,
        narrow, wide, *(Notice(kind, text, (text, text)) for kind in ("note", "warning")), Listing(text + LONG),
        Links(((words, "part/report.html"),)),
        Explorer(text, text, (ExplorerColumn(0.1, (1.0,), text, "run-1"),)),
        CellSheets(((text, text),), (cell | {"motions": [motion]},)),
        Sheet("run-1", words, ((words, text),), (text,), "", narrow, chosen=True),
    )  # fmt: skip
    assert {type(item) for item in items} == set(get_args(Item)), "a new kind of item belongs here"
    return Report(words, text, items)


@pytest.fixture(scope="session")
def folder(tmp_path_factory) -> Path:
    """Eight runs: two failed (one without a record), periods 1 and 2 and none, an odd title."""
    failing = {0.12: ("newton-failed", 0), 0.16: ("turn-unresolved", 33.3)}
    steepness = [0.016, 0.03, 0.05, 0.08, 0.1, 0.12, 0.13, 0.16]
    place = tmp_path_factory.mktemp("reports") / "eight"
    return campaign(place, steepness, failing=failing, overrides={"title": ODD_TITLE, "water.depth_m": 22.5})


@pytest.fixture(scope="session")
def built(folder) -> tuple[Path, Path]:
    return build(folder)


@pytest.fixture(scope="session")
def source(folder) -> str:
    return render_html(content_of(folder)[0]).decode()


@pytest.fixture(scope="session")
def page(source) -> Page:
    return Page(source)


@pytest.fixture(scope="module")
def browse():
    """`with browse(path, width=400, ...) as page:` opens a file in a fresh window of Chromium.

    Options are those of Playwright's `new_context`; `page.asked` lists what the page asked of any network.
    """
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    chromium = next(filter(None, map(shutil.which, names)), None)
    if chromium is None:
        pytest.skip("no Chromium on this machine to open a report with")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox", "--disable-gpu"])

        @contextmanager
        def opened(path: Path, width: int = 1200, height: int = 900, **options):
            with browser.new_context(viewport={"width": width, "height": height}, **options) as context:
                page = context.new_page()
                page.asked = []
                page.on("request", lambda request: page.asked.append(request.url))
                page.goto(path.absolute().as_uri())
                yield page

        yield opened
        browser.close()


@pytest.fixture
def drawn(monkeypatch):
    """Every drawing that is saved from here on."""
    figures, save = [], Drawing.savefig

    def keep(figure, *place, **options):
        figures.append(figure)
        return save(figure, *place, **options)

    monkeypatch.setattr(Drawing, "savefig", keep)
    return figures


def folder_at(place, campaign, rows, columns, **provenance):
    """The folder of a campaign of the shipped buoy, without its runs."""
    (place / "trajectories").mkdir(parents=True)
    (place / "scene.toml").write_text(load_scene("tethered_buoy").to_toml(), encoding="utf-8")
    write_json(place / "provenance.json", {"campaign": campaign, **provenance})
    write_table(place / "table.csv", columns, rows)
    return place


def write(place, rows, columns=COLUMNS):
    """The table and its dictionary of a folder."""
    place.mkdir(exist_ok=True)
    write_table(place / "table.csv", columns, rows)


def columns_of(rows, words, symbols=None):
    """Columns for rows of a toy: those named are words, the others numbers."""
    columns = []
    for name in rows[0]:
        usual = WORD if name in words else STEEPNESS
        columns.append(replace(usual, name=name, symbol=(symbols or {}).get(name, "")))
    return tuple(columns)


def of_kind(items, kind):
    """The items of a report that are of this kind."""
    return [item for item in items if isinstance(item, kind)]


def warned(items):
    """The lines of all notices of a report."""
    return [line for notice in of_kind(items, Notice) for line in notice.lines]


def panel_of(figure, label):
    """The axes whose label of y begins so."""
    return next(axes for axes in figure.axes if axes.get_ylabel().startswith(label))


def points_of(axes):
    """{colour: x of every point of an orbit diagram drawn in it}."""
    return {to_hex(line.get_color()): np.unique(line.get_xdata()) for line in axes.lines if line.get_marker() == "_"}
