"""The first page: the answer, one figure with everything that it stands on, the time; then the contents. And an
unchanged folder is not drawn again.
"""

import re
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.colors import same_color, to_hex

from campaigns.explore.rows import COLUMNS
from engine import load_scene
from reports import build, content_of
from reports.buoy_sweep.figures import evidence_table, orbit_figure
from reports.buoy_sweep.runs import read_sweep
from reports.figures.orbit_diagram import NARROW_IN, OrbitDiagram, Strobes
from reports.parts.content import Bullets, Explorer, Figure, Heading, Text, plain
from reports.parts.first_page import how_long
from reports.parts.folder import Folder
from reports.parts.html import render_html
from reports.parts.provenance import report_page
from reports.parts.style import REGIME_COLOURS, WIDTH_IN
from reports.parts.unchanged import _SOURCES
from tables import printed, read_table
from tests.campaigns.conftest import rows_of
from tests.reports.conftest import Page, of_kind, panel_of, points_of, write
from tests.test_layers import BELOW

LABELS = "kA", "r (m)"
VALUES = np.linspace(0.02, 0.16, 29)
WORDS = ["period-1"] * 20 + ["quasi-periodic"] * 4 + ["chaotic"] * 5

CURRENT = {"current": {"law": "uniform", "velocity_mps": [0.3, 0.0, 0.4]}}
SEA = {"waves": {"period_s": 5.0, "jonswap": {"significant_height_m": 1.0}}}


def columns_of(wide_m=(0.1, 8.0)):
    """Twenty columns of points within the first width, nine within the second, as far as they are named."""
    spans = [np.linspace(-0.5, 0.5, 7) * wide_m[k >= 20] for k in range(29)]
    return [Strobes(at, 20.0 + span, word) for at, span, word in zip(VALUES, spans, WORDS, strict=True)]


def bar_of(axes):
    """[(colour, low, high)] of the spans of a bar."""
    spans = (
        (to_hex(patch.get_facecolor()), patch.get_x(), patch.get_x() + patch.get_width()) for patch in axes.patches
    )
    return [(colour, round(low, 6), round(high, 6)) for colour, low, high in spans]


def test_every_column_is_drawn_in_the_colour_of_its_word_and_the_bar_says_where_it_holds(drawn):
    between = [Strobes(at, np.array([20.0]), "") for at in 0.5 * (VALUES[1:] + VALUES[:-1])]
    columns = sorted(columns_of() + between, key=lambda one: one.at)
    loops = {"loops released": [column.at > 0.12 for column in columns]}
    OrbitDiagram(columns, LABELS, [], loops, [(0.13, "paper")]).drawn()
    top, bar, released = drawn[0].axes
    points = points_of(top)
    assert sum(map(len, points.values())) == len(columns)
    for word in set(WORDS):
        colour = REGIME_COLOURS["period-" if word.startswith("period-") else word]
        assert np.allclose(points[colour], VALUES[[column == word for column in WORDS]])
    assert [colour for colour, *_ in bar_of(bar)] == [REGIME_COLOURS[word] for word in ("period-", *WORDS[20::5])]
    edges = [edge for _, *pair in bar_of(bar) for edge in pair]
    assert edges[1:-1] == pytest.approx([0.1175, 0.1175, 0.1375, 0.1375]), "half-way between neighbours"
    ((_, low, high),) = bar_of(released)
    assert 0.12 - 0.0025 <= low <= 0.12 + 0.0025 and high == pytest.approx(0.16 + 0.00125)
    assert [text.get_text() for text in released.texts] == ["loops released"]
    assert [text.get_text() for text in bar.texts] == ["1"]


def test_small_motions_are_drawn_again_larger_and_nothing_of_them_lies_on_the_others(drawn):
    OrbitDiagram(columns_of(), LABELS, []).drawn()
    top = drawn[0].axes[0]
    (inner,) = top.child_axes
    drawn[0].draw_without_rendering()
    heights = np.concatenate([line.get_ydata() for line in inner.lines])
    assert np.ptp(heights) == pytest.approx(0.1) and len(heights) == 20 * 7
    per_m = [axes.get_window_extent().height / np.ptp(axes.get_ylim()) for axes in (top, inner)]
    assert per_m[1] > 10.0 * per_m[0]
    assert inner.get_title("left") == f"the same, {per_m[1] / per_m[0]:.0f} times as high"
    place = inner.get_window_extent().transformed(top.transData.inverted())
    inside = [column for column in columns_of() if place.x0 <= column.at <= place.x1]
    assert all(((column.points < place.y0) | (column.points > place.y1)).all() for column in inside)
    OrbitDiagram(columns_of((8.0, 8.0)), LABELS, []).drawn()
    assert not drawn[1].axes[0].child_axes, "nothing small, nothing larger"
    OrbitDiagram(columns_of((2.0, 8.0)), LABELS, []).drawn()
    assert not drawn[2].axes[0].child_axes, "no room to draw it twice as high"


def test_both_forms_hold_the_same(drawn):
    figure = OrbitDiagram(columns_of(), LABELS, []).figure("caption", "alternative")
    assert figure.picture.data != figure.narrow.data
    wide, narrow = (points_of(figure.axes[0]) for figure in drawn)
    assert wide.keys() == narrow.keys() and all(np.array_equal(wide[key], narrow[key]) for key in wide)
    assert [sheet.get_figwidth() for sheet in drawn] == [WIDTH_IN, NARROW_IN]


def test_a_run_without_points_is_a_cross_within_the_axis_at_its_ends_too(drawn):
    OrbitDiagram(columns_of(), LABELS, [], missing=[0.0, 0.2]).drawn()
    axes = drawn[0].axes[0]
    (crosses,) = (line for line in axes.lines if line.get_marker() == "x")
    assert [*crosses.get_xdata()] == [0.0, 0.2] and axes.get_xlim()[0] < 0.0 and axes.get_xlim()[1] > 0.2


@pytest.fixture
def sweep(folder, tmp_path):
    """A copy of the folder, with regimes: the first two exponents by Wolf's method alone, at kA = 0.13 by both."""
    place = shutil.copytree(folder, tmp_path / "copy", ignore=shutil.ignore_patterns("report.*"))
    words = {0.016: "period-1", 0.1: "quasi-periodic", 0.13: "chaotic"}
    rows = read_table(place / "table.csv")
    for row in rows:
        row["regime"] = words.get(float(row["steepness"]), "")
        if row["regime"]:
            row |= {"evidence": "halves: -0.5/0.01/no", "regime_reason": "it drifts"}
            row |= {"lyapunov_wolf_bits_per_period": 0.2, "lyapunov_wolf_error": 0.05}
        if row["regime"] == "chaotic":
            row |= {"lyapunov_tangent_bits_per_period": 0.1, "lyapunov_tangent_error": 0.01}
    write(place, rows)
    return place


def test_wolf_s_exponent_is_drawn_where_no_other_is_known_and_never_where_the_motion_repeats(sweep, drawn):
    orbit_figure(read_sweep(sweep))
    panel = panel_of(drawn[0], "exponent")
    seen = {round(bars.lines[0].get_xdata()[0], 3): bars.lines[0].get_ydata()[0] for bars in panel.containers}
    assert seen == {0.1: 0.2, 0.13: 0.1}
    assert not any(same_color(bars.lines[0].get_color(), REGIME_COLOURS["period-"]) for bars in panel.containers)
    two = panel.containers[-1].lines[2][0].get_segments()[0][:, 1]
    assert np.ptp(two) == pytest.approx(4 * 0.01), "two errors on both sides"


def test_the_tests_behind_a_regime_are_told_with_its_reason(sweep):
    tables = [evidence_table(run) for run in read_sweep(sweep).judged]
    assert [table.rows for table in tables] == [[("halves", "−0.5", "0.01", "no")]] * 3
    assert tables[2].caption == "Evidence at kA = 0.13, in the order of the tests: it drifts."


def test_runs_between_and_those_with_the_wetted_cap_are_in_the_figure_and_it_is_made_without_them_too(sweep, drawn):
    orbit_figure(read_sweep(sweep))
    rows = {float(row["steepness"]): row for row in rows_of(sweep)}
    write(sweep / "between", [{**rows[0.05], "steepness": 0.06, "regime": "", "transient_periods": 30}])
    (sweep / "between" / "trajectories").symlink_to(sweep / "trajectories")
    capped = {"status": "ok", "role": "wetted cap", "steepness": 0.13, "tension_top_max_N": 3000.0}
    companions = [capped, capped | {"steepness": 0.1, "tension_top_max_N": 2000.0}, capped | {"role": "as run"}]
    write(sweep / "companions", companions, (replace(COLUMNS[-1], name="role"), *COLUMNS))
    read = read_sweep(sweep)
    orbit_figure(read)
    alone_count, full_count = (sum(map(len, points_of(drawn[place].axes[0]).values())) for place in (0, 2))
    assert full_count == alone_count + 1
    panel = panel_of(drawn[2], "largest T")
    lines = {line.get_label(): line for line in panel.lines}
    multiples = np.array([2e3, 3e3]) / read.modes.static_tension_N
    assert np.allclose(lines["wetted cap, on the same scale"].get_ydata(), multiples)
    (run,) = read.between
    assert run.transient == 30 and len(run.section) == 80 - 30 + 1


def test_a_transient_of_each_run_s_own_is_left_out_of_its_points_or_that_of_the_provenance(sweep):
    rows = [row | {"transient_periods": 10 + place} for place, row in enumerate(rows_of(sweep))]
    write(sweep, rows)
    good = read_sweep(sweep).good
    assert [len(run.section) for run in good] == [81 - run["transient_periods"] for run in good]
    write(sweep, rows, [column for column in COLUMNS if column.name != "transient_periods"])
    assert {len(run.section) for run in read_sweep(sweep).good} == {81 - 20}


def test_answer_figure_and_time_stand_before_the_contents_and_the_making_comes_last(folder):
    report, _ = content_of(folder)
    kinds = [type(item) for item in report.items]
    first = kinds.index(Heading)
    assert kinds[:first] == [Bullets, Text, Figure, Explorer]
    answer = (folder / "answer.txt").read_text(encoding="utf-8").splitlines()
    shown = " ".join(map(plain, report.items[0].lines))
    assert shown.split() == printed(" ".join(answer)).split()
    assert re.search(r"8 runs over [\d\u202f]+ periods", report.items[1].text)
    page = render_html(report).decode()
    order = [page.index(entry) for entry in ("<h1", '<ul class="bullets">', 'id="figure-1"', "<nav", 'id="section-1"')]
    assert order == sorted(order)
    assert not [entry for entry in Page(page).all("nav") if entry.get("class")] and "<summary>Figures" not in page
    headings = of_kind(report.items, Heading)
    assert [heading.text for heading in headings if heading.level == 1][-1].startswith("Appendix")
    below = {heading.text for heading in headings if heading.level == 2}
    assert {"Scene", "Equations", "Provenance", "Run times"} <= below


def test_how_long_it_took_is_told_with_runs_periods_and_cores():
    provenance = {
        "timing": {"compile_s": 1.0, "run_s": 68.0},
        "runs": {"total": 49, "found": 3},
        "jobs": 2,
        "cpu_count": 4,
    }
    rows = [{"periods": "100.0"}, {"periods": "1135"}, {"periods": ""}]
    sentence = how_long(provenance, rows)
    assert all(
        phrase in sentence for phrase in ("69 s", "49 runs", "1\u202f235 periods", "3 runs", "2 at a time", "4 cores")
    )
    assert how_long({"timing": {"run_s": 600.0}, "runs": {"total": 1}}, []) == "It took 10 minutes: 1 run."
    assert how_long({}, rows) == how_long({"timing": {}}, rows) == ""


def test_an_unchanged_folder_is_not_drawn_again(sweep, monkeypatch):
    times = []
    monkeypatch.setattr("reports.content_of", lambda directory: (times.append(1), {}))
    monkeypatch.setattr("reports.parts.html.render_html", lambda report: b"page")
    monkeypatch.setattr("reports.parts.pdf.render_pdf", lambda report: b"paper")

    def drawn() -> bool:
        drawings = len(times)
        html, pdf = build(sweep)
        assert (html.read_bytes(), pdf.read_bytes()) == (b"page", b"paper")
        return len(times) > drawings

    for spoil in (
        lambda: None,  # at first there is no report
        (sweep / "report.html").unlink,
        lambda: (sweep / "report.pdf").write_bytes(b"%PDF"),
        lambda: (sweep / "answer.txt").write_text("Another answer.\n"),
        lambda: write(sweep, rows_of(sweep)[:-1]),
        next((sweep / "trajectories").iterdir()).unlink,
        lambda: (sweep / ".report.json").write_text("[]"),
        lambda: monkeypatch.setattr("reports.parts.unchanged._LIBRARIES", ("numpy",)),
    ):
        spoil()
        assert [drawn(), drawn()] == [True, False]
    assert build(sweep, again=True) and len(times) == 9


def test_the_sources_that_a_drawing_depends_on_are_all_packages_below_the_reports():
    compiling = {"machine_code"}  # of kernels, which changes nothing that is drawn
    assert {"reports"} | BELOW["reports"] <= {*_SOURCES} | compiling


@pytest.mark.parametrize(
    ("changes", "varied", "words"),
    [
        ({}, (), ["waves of 5 s", "21 m of water"]),
        ({"water.depth_m": 22.5}, ("waves.period_s",), ["22.5 m of water"]),
        (CURRENT, ("water.depth_m",), ["waves of 5 s", "a current of 0.5 m/s"]),
        (CURRENT, ("current.velocity_mps[0]",), ["waves of 5 s", "21 m of water"]),
        (SEA, (), ["waves of 5 s at the peak of the spectrum", "21 m of water"]),
    ],
)
def test_the_water_that_a_campaign_did_not_vary_is_told_below_the_title(changes, varied, words):
    scene = load_scene("tethered_buoy", changes)
    folder = Folder(Path(), {}, (), scene, dict.fromkeys(("status", *varied)))
    report = report_page(folder, "A title", [], ())
    assert report.subtitle == "; ".join([scene.title, *words])
