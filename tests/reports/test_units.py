"""Axes, marks and captions say what the numbers are: their unit, their scale, whose they are, and how sure."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure

from engine import load_scene
from engine.natural_frequencies import natural_frequencies
from reports.basins.report import _map
from reports.breaking_line.figures import energy_figure
from reports.breaking_line.runs import SERIES, Line, series_table
from reports.buoy_sweep import runs
from reports.buoy_sweep.report import warnings
from reports.buoy_sweep.runs import Run, Sweep
from reports.buoy_sweep.snaps import _motion_of
from reports.figures.curves import Curve, Panel, curves
from reports.figures.maps import Map, maps
from reports.figures.offplane_history import History, lateral_histories
from reports.figures.quantities import over_key
from reports.oscillator.report import _errors, attracting_orbit
from reports.out_of_plane.report import _agreement
from reports.paper.dependence import _gaps
from reports.paper.figures.buoy import spectrum_panels
from reports.paper.figures.chaos import running_exponents
from reports.parts.content import Listing
from reports.parts.folder import Folder
from reports.parts.provenance import provenance_items
from reports.sea.figures import _waves_panel
from reports.sweep.report import _warnings as sweep_warnings
from reports.time_series.report import _return_map
from reports.validation.report import Study, figure, overview
from tables import Column
from tests.campaigns.fake_engine import sines

SCENE = load_scene("tethered_buoy")
MODES, DIAMETER_M = natural_frequencies(SCENE), SCENE.buoy.diameter_m
HEIGHT = "max_buoy_height_above_water_m"
SOUND = {
    "status": "ok", "dimensions": 3, "loop_releases": 0, "max_turn_rad": 0.0, "message": "", "steepness": 0.1,
    "tension_top_max_N": 1000.0, "tension_top_max_error_N": 0.0, HEIGHT: 0.0, "periods_done": 60.0, "depth_m": 25.0,
}  # fmt: skip


def test_a_second_axis_shows_the_same_heights_in_its_own_unit(drawn):
    """Two kN to the static tension and five seconds to the period."""
    line = Curve(np.array([0.0, 4.0]), np.array([1.0, 3.0]))
    curves([[Panel([line], beside={"right": (2.0, "T (kN)"), "top": (5.0, "t (s)")})]], 2.0)
    (axes,) = drawn[0].axes
    right, top = axes.child_axes
    assert right.get_ylim() == pytest.approx(2.0 * np.array(axes.get_ylim()))
    assert top.get_xlim() == pytest.approx(5.0 * np.array(axes.get_xlim()))


def test_a_spectrum_is_linear_with_its_peak_in_sight_and_logarithmic_over_four_decades(drawn):
    spectrum = Curve(np.arange(4.0), np.array([1e-9, 2.0, 1e-2, 5.0]))
    curves([spectrum_panels([spectrum], 2.5, ("x", "y"), [(1.0, "waves")])], 2.0)
    linear, right = drawn[0].axes
    assert linear.get_yscale() == "linear" and 2.0 < linear.get_ylim()[1] < 5.0, "no wider than what is shown"
    assert right.get_yscale() == "log" and right.get_ylim()[0] == pytest.approx(2e-4)


def test_a_sheet_has_tensions_in_kN_and_exponents_in_bits(monkeypatch):
    """A perturbation that doubles each wave period grows by one bit."""
    shown = {}
    monkeypatch.setattr(
        runs, "run_sheet", lambda *given: shown.update(pull=given[3][0], spectrum=given[6], exponent=given[8])
    )
    tangent = SimpleNamespace(growth_nats=np.full((60, 1), math.log(2.0)))
    runs.drawing(Run(SOUND, transient=40, periods_done=60.0), replace(sines(SCENE, 60), tangent=tangent), 80, None)
    at, bits = shown["exponent"]
    assert np.allclose(bits, 1.0) and (at[0], at[-1]) == (41, 60)
    name, low, high = shown["pull"]
    assert name == "T (kN)" and (low.min(), high.max()) == pytest.approx((1.49, 2.51), abs=1e-3)
    omega, amplitude = shown["spectrum"]
    assert omega[np.argmax(amplitude)] == pytest.approx(2.0 * math.pi / SCENE.waves.period_s)


SINKING_M = 20.0 * (1.0 + MODES.static_strain) + 0.5 * DIAMETER_M  # depth at which the buoy at rest is just covered


@pytest.mark.parametrize(
    ("below", "above", "phrase"),
    [
        ({"tension_top_max_error_N": 49.9}, {"tension_top_max_error_N": 50.1}, "no better than 5 %"),
        ({}, {"tension_top_max_error_N": math.nan}, "the error of the largest tension is not known"),
        ({}, {"loop_releases": 1}, "loops were released"),
        ({"max_turn_rad": 1.57}, {"max_turn_rad": 1.58}, "turns by more than π/2"),
        ({}, {"message": "becomes another motion"}, "the run ends in another motion"),
        ({}, {"message": "ringing is not resolved"}, "ringing of the line is not resolved"),
        ({HEIGHT: DIAMETER_M - 0.01}, {HEIGHT: DIAMETER_M + 0.12}, "its lowest point by up to 0.12 m"),
        ({}, {"status": "newton-failed", "message": "no end"}, "newton-failed; the first after 60 periods: no end"),
        ({"periods_done": 60.0}, {"periods_done": 59.9}, "shorter than the 60 wave periods"),
        ({"depth_m": SINKING_M + 0.1}, {"depth_m": SINKING_M - 0.25}, "is 0.25 m above still water"),
    ],
)
def test_a_caveat_is_told_from_its_threshold_on(below, above, phrase):
    for changes, wanted in ((below, False), (above, True)):
        row = SOUND | changes
        folder = Folder(None, {}, (), load_scene("tethered_buoy", {"water.depth_m": row["depth_m"]}), {})
        sweep = Sweep(folder, (Run(row, periods_done=row["periods_done"]),), (), 0.01, 16, MODES)
        assert any(phrase in line and line.endswith("kA = 0.1.") for line in warnings(sweep).lines) is wanted


def test_the_top_of_the_buoy_at_rest_is_told_with_the_stretch_of_its_tether(tmp_path):
    for depth_m, words in ((SINKING_M - 0.25, "0.25 m above"), (SINKING_M + 0.25, "0.25 m below")):
        depth, *_ = _gaps(tmp_path, load_scene("tethered_buoy", {"water.depth_m": depth_m})).rows
        assert words in depth[2]


def patches_of(legend):
    """{name: patch} of a legend."""
    return {text.get_text(): patch for text, patch in zip(legend.texts, legend.legend_handles, strict=True)}


def test_starts_stand_at_their_share_of_a_period_in_the_colour_of_their_motion(drawn):
    rows = [
        {"kick_x_mps": v, "phase_rad": 0.5 * math.pi * k, "motion": "AB"[v > 0.0], "status": "ok"}
        for k in range(4)
        for v in (-1.0, 0.0, 1.0)
    ]
    rows[-1] |= {"motion": "", "outcome": "unsettled"}
    chaos = {"motion": "A", "regime": "chaotic", "tension_top_max_N": 9e3}
    motions = [chaos, chaos | {"motion": "B", "tension_top_max_N": 7e3}]
    list(_map(Folder(None, {}, tuple(rows), SCENE, {}), ["vx", "phase"], motions, Folder(None, {}, (), SCENE, {})))
    (axes,) = drawn[0].axes
    assert axes.get_xlim() == (-1.5, 1.5) and axes.get_ylim() == (-0.125, 0.875)
    cells = axes.collections[0]
    colours = cells.to_rgba(cells.get_array())
    (legend,) = drawn[0].legends
    patches = patches_of(legend)
    for name, column in (("A: chaotic, 9 kN", 0), ("B: chaotic, 7 kN", 2)):
        assert np.allclose(colours[0, column], patches[name].get_facecolor())
    (cross,) = (line for line in axes.lines if line.get_marker() == "x")
    assert np.ravel(cross.get_data()).tolist() == [1.0, 0.75]


def test_curves_of_a_validation_are_called_whose_they_are(drawn):
    case = dict.fromkeys(("title", "verdict", "quantity", "x_label", "y_label", "ours", "theirs"), "told")
    figure(Study(None, {"a": [case]}, {"a": {"b": [[0.0, 3.0, 5.0], [1.0, 3.0, 5.0]]}}), "a")
    seen = {line.get_label(): line.get_ydata()[0] for line in drawn[0].axes[0].lines}
    assert seen == {"ours": 3.0, "theirs": 5.0}


def test_points_of_a_validation_that_agree_lie_on_the_line(drawn):
    overview(
        Study(
            None,
            {"a": [{"quantity": "b", "error": "1", "bar": "2", "verdict": "passes"}]},
            {"a": {"b": [[0.0, 3.0, 3.0], [1.0, -5.0, -5.0]], "c": [[0.0, -2.0, -2.0]]}},
        )
    )
    line, points, *_ = drawn[0].axes[0].lines
    assert points.get_xydata() == pytest.approx(np.array([[0.6, 0.6], [-1.0, -1.0], [-1.0, -1.0]]))
    assert line.get_xydata() == pytest.approx(np.array([[-1.0, -1.0], [1.0, 1.0]]))


def test_histories_of_a_snapping_motion_are_in_kN():
    run = sines(SCENE, 40, tension=(2000.0, 2500.0))
    folder = SimpleNamespace(trajectory=lambda row: (run, None), table=[])
    motion, _ = _motion_of(folder, {"transient_periods": 20, "regime": "period-1", "snaps_per_wave": 1.0})
    assert (motion.low_kN.max(), motion.high_kN.max()) == pytest.approx((4.49, 4.51))
    assert motion.peaks_kN == pytest.approx(4.51, rel=1e-3) and motion.times[-1] == 0.0


def test_an_orbit_attracts_where_both_multipliers_lie_inside_the_circle():
    points = np.arange(6.0).reshape(3, 2)
    saddle, focus = [1, 0.5, 0.0, -2.0, 0.0, 0.0, 0], [2, 0.6, 0.6, 0.6, -0.6, 0.0, 1]
    study = SimpleNamespace(arrays={"orbits": {"table": [saddle, focus], "points": points}})
    assert np.array_equal(attracting_orbit(study), points[1:])


def test_exponents_of_the_paper_stand_with_their_errors_at_the_curve_of_their_wave(drawn):
    data = {"transient_periods": 40.0, "linear_periods": 200.0}
    for wave, bits in (("large", 0.25), ("small", -0.5)):
        for method in ("wolf", "tangent"):
            data |= {f"{wave}_{method}_value": bits, f"{wave}_{method}_error": abs(bits) / 5.0}
            data |= {f"{wave}_{method}_periods": ("n", [1.0, 9.0]), f"{wave}_{method}_bits": ("n", [bits] * 2)}
    sources = [{"label": f"kA = {kA}", "settings": ""} for kA in (0.13, 0.016)]
    shown = running_exponents(xarray.Dataset(data, attrs={"sources": json.dumps(sources), "run_seconds": 1.0}), "svg")
    assert "kA = 0.13: 0.250 ± 0.05 (Wolf) and 0.250 ± 0.05 (tangent)" in shown.caption
    assert "kA = 0.016: −0.500 ± 0.1 (Wolf)" in shown.caption
    lines = {line.get_label(): line.get_ydata()[0] for line in drawn[0].axes[0].lines}
    assert (lines["kA = 0.13, Wolf"], lines["kA = 0.016, tangent"]) == (0.25, -0.5)


KEY, DEPTH, PULL = Column("kA", digits=2), Column("H", digits=1), Column("T", "N", digits=0)


def test_bars_over_a_key_are_one_standard_error_and_none_is_drawn_for_a_run_that_failed(drawn):
    rows = [{"kA": k, "T": 9.0, "T_error": 0.5 + k, "status": ("ok", "ok", "failed")[k]} for k in range(3)]
    over_key(rows, KEY, [((PULL, Column("T_error")),)], {})
    (bars,) = drawn[0].axes[0].containers
    assert [np.ptp(bar[:, 1]) for bar in bars.lines[2][0].get_segments()] == [1.0, 3.0]


def test_a_cell_of_a_map_of_words_has_the_colour_of_the_legend(drawn):
    words = ["chaotic", "period-1", "undecided", "period-2"]
    maps([KEY, DEPTH], [{"kA": k, "H": 1.0} for k in range(4)], [Map("", "regime", words)])
    (axes,) = drawn[0].axes
    (image,), patches = axes.images, patches_of(axes.get_legend())
    for word, colour in zip(words, image.to_rgba(image.get_array())[0], strict=True):
        assert np.allclose(colour, patches[word].get_facecolor())


def test_a_return_map_is_each_point_over_the_one_before_it(drawn):
    _return_map(np.array([1.0, 2.0, 4.0]))
    assert drawn[0].axes[0].lines[0].get_xydata().tolist() == [[1.0, 2.0], [2.0, 4.0]]


def test_the_motion_in_the_plane_is_within_the_axis_of_a_much_smaller_one_across(drawn):
    periods = np.arange(1.0, 9.0)
    size = 1e-6 * periods
    lateral_histories([("y", [History("kA", periods, size, periods, size, 2.0)])])
    low, high = drawn[0].axes[0].get_ylim()
    assert low < 1e-6 and high > 2.0


def test_bars_of_the_scatter_of_independent_starts_are_two_standard_errors(drawn):
    """The standard deviation s of n normal numbers has the standard error s/sqrt(2 (n - 1))."""
    starts = np.random.default_rng(0).normal(size=64)
    _errors(np.array([[1.0, 0.5, 0.1], [2.0, 0.4, 0.05]]), starts)
    left, right = drawn[0].axes
    band = left.collections[0].get_paths()[0].vertices
    assert (band[:, 1].min(), band[:, 1].max()) == pytest.approx((0.3, 0.7)), "two errors too"
    (bars,) = right.containers
    first = bars.lines[2][0].get_segments()[0][:, 1]
    assert first == pytest.approx(np.std(starts, ddof=1) * (1.0 + np.array([-2.0, 2.0]) / np.sqrt(2.0 * 63)))


def test_pairs_that_differ_in_several_respects_are_one_pair_that_does_not_agree():
    pairs = [{"same_range": "0", "same_regime": "0"}, {"same_range": "1", "same_regime": ""}, {"same_range": "1"}]
    assert " in 2 of 3 pairs" in _agreement(pairs)


def test_runs_whose_tensions_hold_less_are_warned_of_beside_those_that_failed():
    failed = {"kA": 0.1, "status": "newton-failed", "message": "no end"}
    less = {"kA": 0.2, "status": "ok", "message": "the largest tension holds to 8 %"}
    lines = sweep_warnings([KEY], [failed, less, less | {"message": ""}]).lines
    assert [line.partition(":")[0] for line in lines] == ["kA = 0.1", "kA = 0.2"]


def test_a_series_has_the_order_of_its_errors_whatever_the_ratio_of_its_grids():
    rows = []
    for elements in (10, 30, 40):
        row = dict.fromkeys(SERIES, elements**-1.5) | {"case": "4", "nodes": elements + 1.0}
        rows.append(Line(row | {"kind": "series", "status": "ok"}))
    columns = {name: Column(name, digits=None if name == "case" else 2) for name in SERIES}
    assert [cells[2] for cells in series_table(rows, columns).rows] == ["–", "1.50", "1.50"]


def test_the_shares_of_an_energy_that_is_all_accounted_for_fill_the_panel(drawn):
    joules = {"strain_J": 40.0, "kinetic_J": 20.0, "end_work_J": -10.0, "viscous_J": 8.0}
    joules |= {"scheme_space_J": 7.0, "scheme_time_J": 5.0, "bending_J": 10.0}
    arrays = {name: np.full(2, energy) for name, energy in joules.items()}
    energy = SimpleNamespace(time_s=np.array([0.0, 0.1]), stored_J=100.0, **arrays)
    row = {"kind": "case", "case": "4", "status": "ok"}
    energy_figure([Line(row, SimpleNamespace(profiles=True, energy=energy))])
    tops = [area.get_paths()[0].vertices[:, 1].max() for area in drawn[0].axes[0].collections]
    assert tops == pytest.approx([40.0, 60.0, 70.0, 90.0, 100.0])


def test_the_large_motion_begins_at_the_higher_of_two_folds():
    axes = Figure().subplots()
    scene = load_scene("tethered_buoy", {"waves": {"period_s": 5.0, "jonswap": {"significant_height_m": 1.0}}})
    _waves_panel(axes, np.linspace(0.0, 2.0, 9), scene, 5.0, {"fold_up_m": 0.9, "fold_down_m": 0.5})
    heights = {line.get_label(): line.get_ydata()[0] for line in axes.lines}
    assert [height for name, height in heights.items() if "begins" in name] == [0.9]
    assert [height for name, height in heights.items() if "ends" in name] == [0.5]


def test_all_of_the_provenance_is_printed_zeros_too():
    provenance = {
        "command": ["a", "b c"],
        "seed": 0,
        "quick": False,
        "versions": {"numpy": "2"},
        "left": None,
        "tol": 1e-9,
    }
    *_, command, table = provenance_items(Folder(None, provenance | {"timing": {"run_s": 1.0}}, (), SCENE, {}))
    assert command == Listing("a 'b c'")
    shown = {"`seed`": "0", "`quick`": "no", "`versions.numpy`": "2", "`left`": "–", "`tol`": "1e-9"}
    assert dict(table.rows) == shown
