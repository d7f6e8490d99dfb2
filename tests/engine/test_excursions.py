"""A sphere with its whole buoyancy belongs under water, a line above the bed: what is refused, and what a run says."""

import math
from dataclasses import replace

import numpy as np
import pytest

from engine import SceneError, Trajectory, simulate
from engine.physics.sea import elevation_m
from engine.run import Run
from engine.trajectory.excursions import emergence, excursions_of, with_excursions
from tests.engine.lines import STILL, held, line, ran

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
        return Run(line({"tether.nodes": 11, **changes, "water.depth_m": depth_m}), 0.0)
    except SceneError as error:
        assert "spherical-cap" in str(error)
        return None


@pytest.mark.parametrize("further", [{}, FLOOR, {"anchor.position_m": [0.0, 0.0, 2.0]}], ids=["", "floor", "anchor"])
@pytest.mark.parametrize("current", CURRENTS.values(), ids=CURRENTS)
def test_the_least_depth_is_where_the_sphere_at_rest_touches_the_water(current, further):
    changes = {"current": current, **further}
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


def excursions(scene, columns):
    return "; ".join(excursions_of(scene, columns))


SEA = {"waves.jonswap": {"significant_height_m": 1.0, "seed": 1}, "waves.above_still_water": "wheeler"}
SEAS = [
    {},
    {"waves.direction_rad": math.pi},
    {"waves.ramp_s": 30.0},
    SEA,
    {"motion.dimensions": 3, "waves.direction_rad": 1.0, **SEA},
]


@pytest.mark.parametrize("waves", SEAS, ids=["along", "against", "ramp", "sea", "space"])
@pytest.mark.parametrize("anchor_m", [0.0, 1.5])
def test_a_sphere_is_in_the_air_where_its_lowest_point_is_above_the_wave(waves, anchor_m):
    x, y = 4.0 * anchor_m, anchor_m if "motion.dimensions" in waves else 0.0  # of the anchor: the sea is told from 0
    scene = line({**waves, "water.depth_m": 23.0, "anchor.position_m": [x, y, anchor_m]})
    columns = places(scene, np.linspace(-5.0, 5.0, 401), np.zeros(401))
    touching = scene.water.depth_m + elevation_m(scene, columns["time_s"], x + columns["x_m"], y + columns["y_m"])
    for dry, words in ((0.05, ""), (0.06, "up to 6 % of its diameter"), (1.0, "up to 100 % of its diameter")):
        columns["z_m"] = touching + (dry - 0.5) * 1.5 - anchor_m - 1e-6
        assert emergence(scene, columns) == pytest.approx(dry, abs=1e-6)
        assert words in excursions(scene, columns) and bool(words) == bool(excursions(scene, columns))
    columns["z_m"][100:200] += 0.5
    words = excursions(scene, columns)
    assert "25 % of the time from t = 10 to 19.9 s" in words and "up to 0.5 m above" in words
    assert "'spherical-cap'" in words and emergence(scene, columns) == pytest.approx(1.0 + 0.5 / 1.5, abs=1e-6)
    floats = scene.model_copy(update={"buoy": scene.buoy.model_copy(update={"submergence": "spherical-cap"})})
    assert excursions(floats, columns) == "" and emergence(floats, columns) is None


def test_a_run_that_fails_in_the_air_has_this_for_its_reason_and_one_in_the_water_its_advice():
    scene, z = line({"waves": None}), np.full(101, 20.0)
    event, status = "Newton's method did not converge at t = 40 s", "newton-failed"
    advice = f"{event}: lower solver.rtol"
    for part, start in (
        (slice(0), advice),
        (slice(90, 95), f"{advice}; the sphere"),
        (slice(95, None), f"{event}: the"),
    ):
        z[part] = 25.0
        message, words = with_excursions(advice, scene, places(scene, 0.0 * z, z), status)
        assert message.startswith(start) and message.endswith(words) and bool(words) == (start != advice)
    assert "rtol" not in message


def test_a_line_below_the_bed_is_told_with_its_depth_where_there_is_no_floor():
    high = {"waves": None, "water.depth_m": 25.0, "anchor.position_m": [0.0, 0.0, 3.0]}
    z = np.full(101, 19.0)
    for changes, lowest, depth in ((high, -4.5, "1.5 m"), (high, -3.005, ""), ({**high, **FLOOR}, -4.5, "")):
        scene = line(changes)
        words = excursions(scene, places(scene, 0.0 * z, z, lowest))
        assert (f"up to {depth} below the bed" in words and "floor" in words) if depth else words == ""


@pytest.mark.parametrize(
    ("mass_kg", "anchor_m", "told"), [(1900.0, 0.0, True), (1900.0, 40.0, False), (1700.0, 0.0, False)]
)
def test_a_buoy_that_sinks_below_the_bed_is_told_and_no_floor_is_advised(mass_kg, anchor_m, told):
    """It displaces 1815 kg of water, and hangs 20 m below its anchor; a floor would leave it without a rest."""
    changes = {"waves": None, "buoy.mass_kg": mass_kg, "anchor.position_m": [0.0, 0.0, anchor_m]}
    message = ran(line(changes, {"water.depth_m": 65.0}), duration_s=0.2).message
    assert ("because it sinks" in message) == told and "floor" not in message


def test_parts_of_a_run_say_together_what_the_whole_says_once():
    """Read from files too: those of older versions have the excursions in the message alone."""
    scene = line({"tether.nodes": 11})
    whole, first = simulate(scene, periods=8), simulate(scene, periods=4)
    doubtful = replace(first, message=f"a doubt; {first.message}")
    older = Trajectory.from_bytes(replace(doubtful, excursions="").to_bytes())
    later = simulate(scene, periods=4, start=first)
    for run in (doubtful, Trajectory.from_bytes(doubtful.to_bytes()), older):
        assert run.own_message == "a doubt" and run.followed_by(later).message == f"a doubt; {whole.message}"
    assert whole.own_message == "" and whole.message.count("the sphere was in the air") == 1


@pytest.mark.parametrize("scheme", ["conservation", "paper-box"])
def test_the_lowest_place_of_a_line_is_that_of_its_nodes(scheme):
    """A line held slack between two points hangs below its anchor, which stands on the bed."""
    changes = {"output.profiles": True, "solver.scheme": scheme, "tether.bending_stiffness_Nm2": 1.0}
    scene = line(STILL, held(8.0, 0.0), changes, {"water.depth_m": 25.0}, length_m=10.0, nodes=21)
    run = ran(scene, duration_s=0.5)
    assert run.columns["line_lowest_m"].min() < -2.0
    np.testing.assert_allclose(run.columns["line_lowest_m"], run.profiles.z_m.min(axis=1), atol=1e-12)
    assert f"up to {-run.columns['line_lowest_m'].min():.2g} m below the bed" in run.message
