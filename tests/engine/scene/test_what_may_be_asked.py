"""What no run could do is refused before it starts, with the key to change; a missing equilibrium has its reason."""

import pytest

from engine import SceneError, load_scene, simulate
from engine.parameters import NOT_STRETCHED, grid
from engine.scene import build_scene
from engine.scene.size_limits import MOST_PROFILE_VALUES, MOST_SAMPLES, MOST_STEPS
from engine.scene.values import LARGEST, SMALLEST

STILL = {"waves": None}
DRY = {"water": None, "waves": None}


@pytest.mark.parametrize(
    ("changes", "duration_s", "key"),
    [
        ({"output.step_s": 1e-12}, 1.0, "output.step_s"),
        ({"output.step_s": 0.01}, 0.0101 * MOST_SAMPLES, "output.step_s"),
        ({"waves.period_s": 1e-20}, 1.0, "output.step_s"),
        ({"output.profiles": True, "output.profiles_step_s": 1e-7}, 1.0, "output.profiles_step_s"),
        ({"output.profiles": True, "tether.nodes": 20000}, MOST_PROFILE_VALUES / 1e5, "output.profiles_step_s"),
        ({"solver.max_step_s": 1e-10, "solver.min_step_s": 1e-12}, 1.0, "solver.max_step_s"),
        ({"solver.step_s": 0.01, "output.step_s": 1e3}, 0.011 * MOST_STEPS, "solver.step_s"),
        ({"solver.integrator": "midpoint", "waves.period_s": 1e-9, "output.step_s": 0.01}, 1.0, "solver.step_s"),
        ({"solver.scheme": "paper-box", "waves.period_s": 1e-9, "output.step_s": 0.01}, 1.0, "solver.step_s"),
    ],
)
def test_more_than_any_run_could_do_is_refused(changes, duration_s, key):
    with pytest.raises(ValueError, match=rf"^{key}: .*allowed: at most"):
        simulate(load_scene("tethered_buoy", changes), duration_s=duration_s)


@pytest.mark.parametrize("value", [5e-324, 1e-310, 0.5 * SMALLEST, 2 * LARGEST, 1e308])
@pytest.mark.parametrize(
    "key", ["tether.length_m", "tether.bending_stiffness_Nm2", "buoy.mass_kg", "waves.period_s", "solver.min_step_s"]
)
def test_numbers_beyond_what_anything_measures_are_refused(key, value):
    with pytest.raises(SceneError, match=rf"{key}: .*allowed: .*1e-30"):
        load_scene("tethered_buoy", {key: value})


def test_zero_is_not_too_small_where_it_is_allowed_and_components_may_be_tiny():
    load_scene("tethered_buoy", {"tether.bending_stiffness_Nm2": 0.0, "tether.drag_normal": -0.0, "waves.ramp_s": 0})
    space = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.0, 1e-150, 0.0]}  # seeds of any size
    assert load_scene("tethered_buoy", space).start.buoy_velocity_mps[1] == 1e-150
    with pytest.raises(SceneError, match="at most 1e"):
        load_scene("tethered_buoy", {"start.buoy_velocity_mps": [0.0, 0.0, 2 * LARGEST]})


@pytest.mark.parametrize("name", ["", "\n", "a.b", "x y"])
def test_a_name_that_is_no_bare_key_is_shown_in_quotes(name):
    raw = load_scene("tethered_buoy").as_dict()
    for trial in ({**raw, name: 1}, {**raw, "tether": {**raw["tether"], name: 1}}):
        with pytest.raises(SceneError) as caught:
            build_scene(trial)
        (line,) = caught.value.faults
        assert repr(name) in line.partition(": ")[0] and "\n" not in line


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({**STILL, "tether.tension": {"law": "tanh", "p": [500.0, 10.0, 0.0, 0.0, 0.0]}}, "carry 2000 N|500 N"),
        ({**DRY, "gravity_mps2": 0.0, "tether.bending_stiffness_Nm2": 0.0}, "nothing pulls on the line"),
        (
            {**STILL, "tether.tension": {"law": "tabulated", "strain": [-0.9, 1.0], "tension_N": [5e3, 9e3]}},
            "still pulls with",
        ),
    ],
)
@pytest.mark.parametrize("scheme", ["conservation", "paper-box"])
def test_a_missing_equilibrium_has_its_reason(changes, words, scheme):
    if scheme == "paper-box" and changes.get("tether.bending_stiffness_Nm2") == 0.0:
        return
    scene = load_scene("tethered_buoy", {**changes, "solver.scheme": scheme, "tether.nodes": 11})
    run = simulate(scene, duration_s=1.0)
    assert run.status == "statics-failed" and all(word in run.message for word in words.split("|"))


@pytest.mark.parametrize("refined", ["both", "lower", "upper"])
def test_a_grid_has_no_coincident_nodes_and_stretching_sets_in_without_a_jump(refined):
    for stretching in (0.0, 5e-324, 1e-310, 1e-20, 1e-7, 1.01 * NOT_STRETCHED):
        assert grid(20.0, 61, stretching, refined) == pytest.approx(20.0 / 60, rel=1e-9)
    h = grid(20.0, 20000, 5.0, refined)
    assert h.min() > 0 and h.sum() == pytest.approx(20.0, rel=1e-12)
