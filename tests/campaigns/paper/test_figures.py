"""Figures of the paper: data from the parts' folders, drawn from their files alone, the same bytes each time; and what
is measured of a snapping run and of a slack rope, and what the scene alone says of eq. (33).
"""

import json
import math
import shutil
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.paper.figures import FIGURES, chaos, files_of, place_of, write_figure_data
from campaigns.paper.figures.motions import history_arrays
from campaigns.paper.measured import read_results
from campaigns.paper.measures import buckling_waves, scales, snaps
from engine import load_scene, simulate
from engine.natural_frequencies import natural_frequencies
from engine.trajectory import TangentGrowth
from reports.paper.figures import draw, figures_of, left_out, pictures
from reports.paper.figures.drawing import sources_of
from reports.parts.folder import read_arrays
from tests.campaigns.conftest import rows_of
from tests.campaigns.fake_engine import sines
from tests.reports.conftest import campaign

OF_BUOY = {9, 10, 11, 12, 13, 15, 16, 17, 18}


@pytest.fixture(scope="module")
def root(tmp_path_factory):
    """The campaign's folder with a part for the buoy alone, of synthetic motions, and the data of its figures."""
    folder = tmp_path_factory.mktemp("paper")
    campaign(folder / "buoy", [0.016, 0.13], periods=80)
    write_figure_data(folder)
    return folder


@pytest.fixture
def copy(root, tmp_path):
    return shutil.copytree(root, tmp_path / "copy")


def data_of(folder, number):
    return read_arrays(files_of(folder, number)[0].read_bytes())


def test_each_figure_is_there_or_has_a_reason(copy):
    reasons = write_figure_data(copy)
    assert set(reasons) == set(FIGURES) - OF_BUOY
    assert all(
        f"the part `{part}` is not there" in reasons[n] for n, part in ((2, "breaking_line"), (20, "out_of_plane"))
    )
    assert "carried no perturbation" in reasons[14] and "`oscillator` is not there" in reasons[19]
    assert json.loads((place_of(copy) / "left_out.json").read_text()) == {str(n): why for n, why in reasons.items()}
    assert {n for n in FIGURES if files_of(copy, n)[0].exists()} == OF_BUOY


def test_unchanged_sources_leave_the_files_alone_and_lost_ones_come_back_the_same(copy):
    write_figure_data(copy)
    earlier = {path: (path.stat().st_mtime_ns, path.read_bytes()) for path in place_of(copy).iterdir()}
    write_figure_data(copy)
    assert {path: path.stat().st_mtime_ns for path in earlier} == {path: time for path, (time, _) in earlier.items()}
    files_of(copy, 9)[0].unlink()
    files_of(copy, 10)[0].write_bytes(b"damaged")
    changed = files_of(copy, 11)[0]
    changed.write_bytes(changed.read_bytes()[:-1] + b"\x01")  # a number, in a sound file
    write_figure_data(copy)
    assert {path: path.read_bytes() for path in earlier} == {path: content for path, (_, content) in earlier.items()}


def test_statements_are_judged_by_the_runs_that_the_figures_show(root):
    numbers = read_results(root)
    assert numbers.number("unexplained") >= 0.0
    assert (
        1.0 <= numbers.number("excursion_m") / (12 * 0.016) <= 2.0
    )  # amplitudes of the synthetic motion off its start
    assert 0.0 < numbers.buoy[0.13]["radial_line"] <= 1.0


def test_a_run_that_is_lost_takes_its_figures_along(copy):
    _, svg, _ = files_of(copy, 13)
    svg.write_bytes(b"drawn before")
    (lost,) = (row["run_key"] for row in rows_of(copy / "buoy") if row["steepness"] == "0.13")
    path = copy / "buoy" / "trajectories" / f"{lost}.nc"
    path.write_bytes(path.read_bytes()[:5000])
    reasons = write_figure_data(copy)
    for number in (13, 15, 16, 17, 18):
        assert "the file of kA = 0.13" in reasons[number] and str(copy) not in reasons[number]
        assert not any(path.exists() for path in files_of(copy, number))
    assert files_of(copy, 9)[0].exists()


def test_a_run_that_failed_is_never_drawn(tmp_path):
    campaign(tmp_path / "buoy", [0.016, 0.13], periods=80, failing={0.13: ("newton-failed", 70)})
    reasons = write_figure_data(tmp_path)
    assert all("ended early (newton-failed" in reasons[number] for number in (13, 15, 16, 17, 18))


def test_every_array_has_a_unit_and_every_file_says_what_it_is_from(root):
    for number in OF_BUOY:
        data = data_of(root, number)
        assert all(array.attrs["units"] and array.attrs["long_name"] for array in data.variables.values())
        (source,) = sources_of(data)
        assert (
            (root / source.file).exists() and source.key in source.file and 'name = "tethered_buoy"' in source.settings
        )
        assert data.attrs["run_seconds"] == source.run_s > 0.0


def test_a_figure_without_sound_data_is_not_drawn_and_said(tmp_path):
    place_of(tmp_path).mkdir()
    files_of(tmp_path, 9)[0].write_bytes(b"CDF\x02 damaged")
    assert set(left_out(tmp_path)) == set(FIGURES) and pictures(tmp_path) == figures_of(tmp_path) == {}


def test_a_buoy_at_rest_is_1_in_the_units_of_the_figures():
    scene = load_scene("tethered_buoy", {"waves.steepness": 1e-9})
    run = simulate(scene, periods=2)
    tension, radial, angular = (history_arrays(run, side) for side in ("tension", "radial", "angular"))
    np.testing.assert_allclose(tension["tension_over_static"][1], 1.0, atol=1e-4)
    np.testing.assert_allclose(radial["radius_over_static"][1], 1.0, atol=1e-6)
    np.testing.assert_allclose(angular["angle_rad"][1], 0.0, atol=1e-6)
    modes = natural_frequencies(scene)
    assert tension["static_tension_N"][1] == pytest.approx(modes.static_tension_N, rel=1e-3)
    assert radial["static_radius_m"][1] == pytest.approx(20.0 * (1.0 + modes.static_strain), rel=1e-4)


def test_the_spectrum_of_a_sine_is_half_its_amplitude_over_the_static_radius(root):
    data = data_of(root, 12)
    at_wave = int(np.argmin(np.abs(data["omega_radps"].values - float(data["wave_radps"]))))
    amplitude_m = 12 * 0.016  # of the synthetic motion
    assert data["radial_amplitude"][at_wave] == pytest.approx(
        0.5 * amplitude_m / float(data["static_radius_m"]), rel=1e-3
    )
    caption = draw(12, files_of(root, 12)[0].read_bytes(), "svg").caption
    assert "bins of 0.063 rad/s" in caption, "2π over 20 wave periods of 5 s"


PEAK, STATIC_N = 4.0, 2000.0  # of the static tension


def bounces(pull):
    """snaps of r - l0 = sin(pi t/T_i), taut and slack in turn, with pull(r - l0, r') while slack [of the static]."""
    scene = load_scene("tethered_buoy")
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    time_s = step_s * np.arange(round(80 * period_s / step_s) + 1)
    phase = np.pi * time_s / period_s
    stretch, rate = np.sin(phase), np.cos(phase)
    tension = STATIC_N * np.where(stretch > 0.0, PEAK * stretch, pull(stretch, rate))
    tension[0] = STATIC_N  # a run starts at rest
    columns = {"time_s": time_s, "tension_top_N": tension, "radius_rate_mps": rate}
    columns |= {"radius_m": 20.0 + stretch, "angle_rad": np.sin(2.0 * phase)}
    return snaps(SimpleNamespace(columns=columns, scene=scene), 10)


def test_a_mass_that_bounces_on_a_spring_is_turned_by_peaks_of_two_thirds_of_their_length():
    numbers = bounces(lambda stretch, rate: 0.0 * stretch)
    assert numbers["near_zero"] == pytest.approx(0.5 + math.asin(0.05 / PEAK) / math.pi, abs=0.01)
    assert numbers["turned"] == numbers["begun_inwards"] == 1.0 and numbers["compressed"] == 0.0
    assert math.isnan(numbers["compressed_inwards"])
    assert numbers["peak_periods"] == pytest.approx(2.0 / 3.0, abs=0.02)
    assert numbers["apart_periods"] == pytest.approx(2.0, abs=0.1)
    assert (numbers["radial_at"], numbers["angular_at"]) == (0.5, 1.0)
    assert numbers["radial_line"] == pytest.approx(1.0) and numbers["angular_line"] == pytest.approx(1.0)


@pytest.mark.parametrize(("sign", "inwards"), [(-1.0, 1.0), (1.0, 0.0)])
def test_compression_is_told_with_the_way_of_the_buoy(sign, inwards):
    numbers = bounces(lambda stretch, rate: np.where(sign * rate > 0.0, -0.1, 0.0))
    assert numbers["compressed"] == pytest.approx(0.25, abs=0.01)
    assert numbers["compressed_inwards"] == pytest.approx(inwards, abs=0.01)


@pytest.mark.parametrize("waves", [1, 4])
def test_a_slack_sine_has_its_half_waves(waves):
    x = np.linspace(0.0, 1.0, 200)
    shape = {"x_m": x[None, :], "z_m": 0.1 * np.sin(waves * np.pi * x)[None, :]}
    assert buckling_waves(SimpleNamespace(**shape, tension_N=-np.ones((1, 200)))) == waves
    assert buckling_waves(SimpleNamespace(**shape, tension_N=np.ones((1, 200)))) is None


@pytest.mark.parametrize("gravity_mps2", [9.81, 3.7])
def test_the_normalised_lift_is_the_static_stretch_over_the_diameter(gravity_mps2):
    scene = load_scene("tethered_buoy", {"water.depth_m": 300.0, "gravity_mps2": gravity_mps2})
    modes = natural_frequencies(scene)
    numbers, twice = scales(scene, modes, 0.016, 0.13), scales(scene, modes, 0.016, 0.26)
    stretch_m = modes.static_strain * scene.tether.length_m
    assert numbers["lift"] == pytest.approx(stretch_m / scene.buoy.diameter_m, rel=1e-4)
    assert twice["force"] == pytest.approx(2.0 * numbers["force"])
    deep = scene.gravity_mps2 / modes.wave_radps**2  # 1/k of deep water
    assert numbers["small_amplitude_m"] == pytest.approx(0.016 * deep)
    assert numbers["diameter_over_wave"] == pytest.approx(scene.buoy.diameter_m / (2.0 * math.pi * deep))
    assert numbers["force"] < 1e-3  # waves do not reach down there


def test_growth_of_a_bit_a_wave_is_drawn_as_one_bit(monkeypatch):
    scene, growth_nats = load_scene("tethered_buoy"), np.full((80, 1), math.log(2.0))
    run = replace(sines(scene, 80), tangent=TangentGrowth(5.0, growth_nats, np.zeros(80)))
    period_s = scene.waves.period_s
    course = SimpleNamespace(time_s=period_s * np.arange(1.0, 9.0), convergence=np.full(8, math.log(2.0) / period_s))
    wolf = SimpleNamespace(found=True, value=1.0, error=0.1, details={"run": course})
    wolf.in_bits_per_period = lambda period_s: wolf
    monkeypatch.setattr("analysis.wolf_lyapunov", lambda *_: wolf)
    arrays = chaos._exponents({"large": (run, None)}, 10)
    for method in ("wolf", "tangent"):
        assert arrays[f"large_{method}_bits"][1] == pytest.approx(1.0)
        assert arrays[f"large_{method}_value"][1] == pytest.approx(1.0)
