"""The examples of docs/held_lines.md run as they stand, end well, and find what the closed forms say."""

import re
import runpy
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from engine import load_scene, simulate
from engine.scene import known_scenes

FOLDER = Path(__file__).resolve().parents[1] / "docs" / "examples"
PAGE = FOLDER.parent / "held_lines.md"
EXAMPLES = sorted(path.stem for path in FOLDER.glob("*.py"))


def ran(name):
    return runpy.run_path(str(FOLDER / f"{name}.py"), run_name="__main__")


@pytest.mark.parametrize("name", EXAMPLES)
def test_each_example_prints_what_the_page_shows(name, capsys):
    """Words exactly, numbers to a unit of the last digit shown (another machine rounds otherwise)."""
    ran(name)
    printed = capsys.readouterr().out
    code = re.escape((FOLDER / f"{name}.py").read_text().strip())
    shown = re.search(rf"```python\n{code}\n```\n\n```text\n(.*?)\n```\n", PAGE.read_text(), re.DOTALL)
    assert shown, f"docs/held_lines.md does not show {name}.py as it is, followed by what it prints"
    number = r"-?\d+(?:\.\d+)?"
    assert re.sub(number, "#", printed).split() == re.sub(number, "#", shown[1]).split()
    for found, said in zip(re.findall(number, printed), re.findall(number, shown[1]), strict=True):
        assert float(found) == pytest.approx(float(said), abs=1.01 * 10.0 ** -len(said.partition(".")[2]))


@pytest.mark.parametrize("name", known_scenes())
def test_every_shipped_scene_runs_as_it_is(name):
    scene = load_scene(name)
    run = simulate(scene, duration_s=20 * scene.sample_step_s())
    table = run.table()
    assert (run.status, run.message) == ("ok", "") and run.statistics["steps"] > 0
    assert len(table) == 21 and np.isfinite(table.to_numpy()).all()
    assert (run.profiles is not None) == scene.output.profiles


def test_the_hanging_line_is_a_catenary():
    run = ran("hanging_line")
    calm, tether = run["calm"], run["calm"].scene.tether
    L, EA = tether.length_m, tether.tension.stiffness_N
    w = tether.density_kgpm3 * tether.area_m2 * calm.scene.gravity_mps2
    span = calm.scene.end.position_m[0]
    H = brentq(lambda H: 2 * H / w * np.arcsinh(w * L / (2 * H)) + H * L / EA - span, 0.1, 100.0)
    T = np.hypot(H, w * L / 2)
    assert run["hook_N"] == pytest.approx(T, rel=1e-4)
    assert run["sag_m"] == pytest.approx((T - H) / w + w * L**2 / (8 * EA), abs=3e-3)
    assert np.ptp(calm.profiles.z_m, axis=0).max() < 1e-9  # it is at rest


def test_the_wind_on_the_line_is_in_balance_about_the_axis_through_the_hooks():
    """int (y f_z - z f_y) ds = 0, f the weight (0, -w_0) and the drag on what faces the wind."""
    run = ran("hanging_line")["windy"]
    tether, p = run.scene.tether, run.profiles
    x = np.stack([p.x_m[-1], p.y_m[-1], p.z_m[-1]], 1)
    rho = run.scene.water.density_kgpm3
    t = np.diff(x, axis=0)
    stretched = np.linalg.norm(t, axis=1, keepdims=True)
    t /= stretched
    U = np.array(run.scene.current.velocity_mps)
    along = (t @ U)[:, None]
    across = U - along * t
    normal = tether.drag_normal * np.linalg.norm(across, axis=1, keepdims=True) * across
    drag = (
        0.5 * rho * tether.diameter_m * (normal + np.pi * tether.drag_tangential * abs(along) * along * t) * stretched
    )
    weight = (tether.density_kgpm3 - rho) * tether.area_m2 * run.scene.gravity_mps2 * np.diff(p.s_m)
    arm = 0.5 * (x[1:] + x[:-1])
    moments = np.array([np.sum(arm[:, 1] * (drag[:, 2] - weight)), -np.sum(arm[:, 2] * drag[:, 1])])
    assert moments[1] > 10.0  # N m
    assert abs(moments.sum()) < 1e-3 * moments[1]


def test_moved_ends_go_where_they_are_told():
    run = ran("moved_end")
    position = run["taken"].table()[["x_m", "y_m", "z_m"]].iloc[-1].to_numpy()
    assert position == pytest.approx([10.0, 5.0, 1.0], abs=1e-6)
    plane, space = (np.abs(run[name].profiles.z_m[-100:, 40]).max() for name in ("plane", "space"))
    assert space / plane == pytest.approx(0.8, abs=2e-3)  # it is shaken by 0.8 of the amplitude along z
    assert np.all(run["plane"].profiles.y_m == 0.0)


def test_the_lines_let_go_come_to_rest_alike():
    """A uniform profile from either side: the line leans by the same amount along the current."""
    run = ran("swinging_line")["run"]
    last = run.table().iloc[-1]
    assert abs(last.x_m) < 1e-3 and last.y_m > 1.0


def test_the_twisted_rope_rests_as_the_localised_buckle():
    run = ran("twisted_rope")
    assert run["pull_N"] == pytest.approx(run["buckle_N"], rel=0.015)
    assert run["off_axis_m"] == pytest.approx(run["slack_m"] / 2, rel=0.015)
    assert run["middle_N"] < 0


def test_the_chain_overtakes_a_free_fall_in_a_plane_and_in_space():
    plane, space = (run.table() for run in ran("falling_chain")["runs"])
    assert space.z_m.to_numpy() == pytest.approx(plane.z_m.to_numpy(), abs=1e-4)
    lowest = plane.z_m.idxmin()
    assert plane.time_s[lowest] - 0.1 < 0.9 * np.sqrt(2 * -plane.z_m[lowest] / 9.81)
