"""A sphere with its whole buoyancy belongs under water, a line above the bed: what is refused, and what a run says."""

import math

import numpy as np
import pytest

from engine import SceneError, load_scene, simulate
from engine.physics.sea import elevation_m
from engine.run import Run
from engine.trajectory.excursions import message_of, own_words

TABLE = {"time_s": [0.0, 1.0], "height_m": [0.0, 60.0], "x_m": [0.0], "velocity_z_mps": [[[0.0], [0.0]]] * 2}
CURRENTS = {
    "none": None,
    "a millimetre a second": {"law": "uniform", "velocity_mps": [1e-3, 0.0, 0.0]},
    "fast": {"law": "uniform", "velocity_mps": [2.0, 0.0, 0.0]},
    "downwards": {"law": "uniform", "velocity_mps": [0.5, 0.0, -1.0]},
    "upwards": {"law": "uniform", "velocity_mps": [0.0, 0.0, 1.0]},
    "a profile": {"law": "profile", "height_m": [0.0, 20.0], "velocity_mps": [[-1.0, 0.0, 0.0], [0.5, 0.0, 0.0]]},
    "a table": {"law": "table", **TABLE, "velocity_x_mps": [[[0.1], [0.1]]] * 2},
}
FLOOR = {"floor": {"stiffness_Npm3": 1e5}}


def rest_of(changes, depth_m):
    """The run at its start; None where its scene is refused."""
    try:
        return Run(load_scene("tethered_buoy", {"tether.nodes": 11, **changes, "water.depth_m": depth_m}), 0.0)
    except SceneError as error:
        assert "spherical-cap" in str(error)
        return None


@pytest.mark.parametrize("more", [{}, FLOOR, {"anchor.position_m": [0.0, 0.0, 2.0]}], ids=["", "floor", "anchor"])
@pytest.mark.parametrize("current", CURRENTS.values(), ids=CURRENTS)
def test_the_least_depth_is_where_the_sphere_at_rest_touches_the_water(current, more):
    changes = {"current": current, **more}
    deep = rest_of(changes, 60.0)
    Y, s = deep.motion.Y, deep.s
    top_m = deep.scene.anchor.position_m[2] + np.trapezoid((1.0 + Y[:, 0]) * np.sin(Y[:, 4]), s)
    lowest_m = float(top_m) - 0.75
    assert rest_of(changes, lowest_m * 1.001).state["status"] == 0
    out = rest_of(changes, lowest_m * 0.999)
    assert out is None or (out.trajectory().status == "statics-failed" and "in the air" in out.trajectory().message)


def places(scene, x, z, lowest=0.0):
    time_s = np.linspace(0.0, 40.0, len(z))
    return {"time_s": time_s, "x_m": x, "y_m": 0.5 * x, "z_m": z, "line_lowest_m": np.full(len(z), lowest)}


SEA = {"waves.jonswap": {"significant_height_m": 1.0, "seed": 1}}
SEAS = [{}, {"waves.direction_rad": math.pi}, {"waves.ramp_s": 30.0}, SEA, {"motion.dimensions": 3, **SEA}]


@pytest.mark.parametrize("waves", SEAS, ids=["along", "against", "ramp", "sea", "space"])
@pytest.mark.parametrize("anchor_m", [0.0, 1.5])
def test_a_sphere_is_in_the_air_where_its_lowest_point_is_above_the_wave(waves, anchor_m):
    scene = load_scene("tethered_buoy", {**waves, "water.depth_m": 23.0, "anchor.position_m": [0.0, 0.0, anchor_m]})
    columns = places(scene, np.linspace(-5.0, 5.0, 401), np.zeros(401))
    touching = scene.water.depth_m + elevation_m(scene, *(columns[name] for name in ("time_s", "x_m", "y_m")))
    columns["z_m"] = touching + 0.75 - anchor_m - 1e-6
    assert message_of("", scene, columns, "ok") == ""
    columns["z_m"][100:200] += 0.5
    said = message_of("", scene, columns, "ok")
    assert "25 % of the time from t = 10 to 19.9 s" in said and "up to 0.5 m above" in said
    assert ("'spherical-cap'" in said) == (not scene.waves.irregular)  # only what is allowed is recommended
    floats = scene.model_copy(update={"buoy": scene.buoy.model_copy(update={"submergence": "spherical-cap"})})
    assert message_of("", floats, columns, "ok") == ""


def test_a_run_that_fails_in_the_air_has_this_for_its_reason_and_one_in_the_water_its_advice():
    scene, z = load_scene("tethered_buoy", {"waves": None}), np.full(101, 20.0)
    advice = "Newton's method did not converge at t = 40 s: lower solver.rtol"
    assert message_of(advice, scene, places(scene, 0.0 * z, z), "newton-failed") == advice
    z[90:95] = 25.0
    said = message_of(advice, scene, places(scene, 0.0 * z, z), "newton-failed")
    assert said.startswith(f"{advice}; the sphere was in the air")
    z[95:] = 25.0
    said = message_of(advice, scene, places(scene, 0.0 * z, z), "newton-failed")
    assert (
        said.startswith("Newton's method did not converge at t = 40 s: the sphere was in the air")
        and "rtol" not in said
    )


def test_a_line_below_the_bed_is_told_with_its_depth_where_there_is_no_floor():
    high = {"waves": None, "water.depth_m": 25.0, "anchor.position_m": [0.0, 0.0, 3.0]}
    z = np.full(101, 19.0)
    for changes, lowest, depth in ((high, -4.5, "1.5 m"), (high, -3.005, ""), ({**high, **FLOOR}, -4.5, "")):
        scene = load_scene("tethered_buoy", changes)
        said = message_of("", scene, places(scene, 0.0 * z, z, lowest), "ok")
        assert (f"up to {depth} below the bed" in said and "floor" in said) if depth else said == ""


def test_parts_of_a_run_say_together_what_the_whole_says_once():
    scene = load_scene("tethered_buoy", {"tether.nodes": 11})
    whole, first = simulate(scene, periods=8), simulate(scene, periods=4)
    both = first.followed_by(simulate(scene, periods=4, start=first))
    assert both.message == whole.message and whole.message.count("the sphere was in the air") == 1
    assert own_words(f"a doubt; {whole.message}") == "a doubt" and own_words(whole.message) == ""


@pytest.mark.parametrize("scheme", ["conservation", "paper-box"])
def test_the_lowest_place_of_a_line_is_that_of_its_nodes(scheme):
    """A line held slack between two points hangs below its anchor, which stands on the bed."""
    changes = {
        "output.profiles": True,
        "solver.scheme": scheme,
        "tether.nodes": 21,
        "tether.bending_stiffness_Nm2": 1.0,
    }
    held = {"end.kind": "held", "end.position_m": [8.0, 0.0, 0.0], "buoy": None, "waves": None, "water.depth_m": 25.0}
    run = simulate(load_scene("tethered_buoy", {**changes, **held, "tether.length_m": 10.0}), duration_s=0.5)
    assert run.status == "ok" and run.columns["line_lowest_m"].min() < -2.0
    np.testing.assert_allclose(run.columns["line_lowest_m"], run.profiles.z_m.min(axis=1), atol=1e-12)
    assert f"up to {-run.columns['line_lowest_m'].min():.2g} m below the bed" in run.message
