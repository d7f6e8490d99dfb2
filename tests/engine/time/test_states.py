"""Laws: a state goes over to another scene, grid and clock without a jump; a start that is faulty says so."""

from dataclasses import replace

import numpy as np
import pytest

from engine import Trajectory, __main__, simulate
from engine.planar import columns as col
from engine.record import RELEASES
from engine.run.going_on import between
from engine.run.start import taken_over
from engine.spatial import lift
from engine.trajectory.final_state import NONE
from tests.engine.lines import held, kick, line

SMALL = {"tether.nodes": 9, "waves.steepness": 0.06, "water.depth_m": 22.5, "solver.rtol": 1e-3}
SLACK = {"tether.nodes": 21, "waves.steepness": 0.13, "water.depth_m": 21.0}  # folded after 12.6 periods
SEEN = ("time_s", "x_m", "z_m", "radius_m", "tension_top_N")


@pytest.fixture(scope="module")
def first():
    return simulate(line(SMALL), periods=4)


CHANGES = {
    "solver.rtol": (0.01, "solver.rtol 0.001 -> 0.01"),
    "waves.steepness": (0.12, "waves.steepness 0.06 -> 0.12"),
    "water.depth_m": (21.0, "water.depth_m 22.5 -> 21"),
    "tether.bending_stiffness_Nm2": (1.0, "tether.bending_stiffness_Nm2"),
    "tether.nodes": (17, "tether.nodes 9 -> 17, the state is interpolated"),
    "tether.grid_stretching": (1.0, "tether.grid_stretching 0 -> 1, the state is interpolated"),
    "motion.dimensions": (3, "motion.dimensions 2 -> 3"),
    "waves.period_s": (4.0, "waves.period_s 5 -> 4, the clock starts at 0"),
    "output.step_s": (0.01, "output.step_s 0.05 -> 0.01, the clock starts at 0"),
    "output.profiles": (True, ""),
    "start.buoy_velocity_mps": ([1.0, 0.0, 0.0], ""),
}


@pytest.mark.parametrize("key", CHANGES)
def test_another_scene_takes_the_state_over_and_says_so(key, first):
    value, statement = CHANGES[key]
    later_run = simulate(line({**SMALL, key: value}), periods=1, start=first.final_state)
    assert later_run.status == "ok" and statement in later_run.began
    assert bool(statement) == later_run.began.startswith("went on at t = 20 s")
    for name in SEEN if "clock" not in statement else ():
        assert later_run.columns[name][0] == first.columns[name][-1]
    seen = np.append(first.columns["radius_m"][-1], later_run.columns["radius_m"][:4])
    assert np.abs(np.diff(seen)).max() < 0.05  # m, between samples 0.1 s apart at most: no jump
    assert np.allclose(np.diff(later_run.columns["time_s"]), later_run.scene.sample_step_s())
    assert later_run.columns["time_s"][0] == (0.0 if "clock" in statement else 20.0)
    if not statement:
        assert np.array_equal(
            later_run.columns["radius_m"], simulate(first.scene, periods=1, start=first).columns["radius_m"]
        )
    if later_run.profiles is not None:
        late = later_run.columns["time_s"] > later_run.profiles.time_s[0] - 1e-9  # the last step of before kept none
        assert later_run.profiles.time_s == pytest.approx(later_run.columns["time_s"][late])
        assert later_run.profiles.z_m[:, -1] == pytest.approx(later_run.columns["z_m"][late])
        assert late.sum() >= len(late) - 3
    saved = Trajectory.from_bytes(later_run.to_bytes())
    assert saved.began == later_run.began and saved.final_state.digest() == later_run.final_state.digest()


def test_a_state_with_its_clock_at_zero_goes_the_same_way(first):
    """Where its time is a whole number of wave periods."""
    state = first.final_state.at_zero()
    continued, restarted = (simulate(first.scene, periods=3, start=start) for start in (first, state))
    assert state.time_s == 0.0 and state.digest() != first.final_state.digest()
    assert restarted.columns["time_s"] == pytest.approx(continued.columns["time_s"] - 20.0, abs=1e-12)
    assert restarted.columns["radius_m"] == pytest.approx(continued.columns["radius_m"], abs=2e-4)
    assert state.at_zero().digest() == state.digest()
    assert replace(state, scene=line({**SMALL, "tether.drag_normal": 2.0})).digest() != state.digest()


def test_with_its_clock_at_zero_loops_are_counted_anew(first):
    loops = np.zeros_like(first.final_state.samples)
    loops[:, RELEASES] = 3.0
    looped = first.final_state.with_numbers(releases=4)
    begun = replace(looped, samples=looped.samples + loops).at_zero()
    assert begun.state()["releases"] == 1 and not begun.samples[:, RELEASES].any()


def test_with_its_clock_at_zero_every_time_of_a_state_is_as_much_earlier(first):
    state = first.final_state.with_numbers(window_end=21.0, corner=22.0)
    begun = state.at_zero().state()
    earlier_s = [state.state()[name] - begun[name] for name in ("t", "window_end", "corner")]
    assert earlier_s == pytest.approx([20.0, 20.0, 20.0])


def test_the_grid_may_change_in_slack():
    """The end stays in its place and the line without a blow; on a nested grid and back the state is nearly the old."""
    fine = line({**SLACK, "tether.nodes": 41})
    coarse = simulate(line(SLACK), periods=12.6)
    unchanged, refined = (simulate(scene, periods=1, start=coarse) for scene in (coarse.scene, fine))
    assert refined.columns["radius_m"] == pytest.approx(unchanged.columns["radius_m"], abs=0.02)
    assert (
        refined.columns["tension_top_high_N"][1:10].max() < 100.0 and coarse.columns["tension_top_high_N"].max() > 4e3
    )
    old = coarse.final_state
    back = taken_over(taken_over(old, fine)[0], coarse.scene)[0]
    assert np.linalg.norm(back.C[:, :2], axis=1) == pytest.approx(np.linalg.norm(old.C[:, :2], axis=1))
    assert back.C[:, 2:] == pytest.approx(old.C[:, 2:])
    assert np.trapezoid(back.C[:, :2], axis=0) == pytest.approx(np.trapezoid(old.C[:, :2], axis=0), abs=1e-9)
    assert np.abs(back.Y[:, col.PHI] - old.Y[:, col.PHI]).max() < 0.3  # rad; of turns of up to 3 rad an element
    assert not back.C[0, 2:].any()


def test_between_two_states(dimensions):
    scenes = [line({**SMALL, "motion.dimensions": dimensions, **kick(u)}) for u in (0, 2)]
    a, b = (simulate(scene, periods=2).final_state for scene in scenes)
    released = b.Y.copy()
    if dimensions == 2:
        released[4:, col.PHI] += 2 * np.pi
    else:
        released[4:, lift.BETA] *= -1.0
    for end in (b, replace(b, Y=released)):
        for share in (0.0, 0.25, 1.0):
            state = between(a, end, share)
            if share in (0.0, 1.0):
                exact = (a, b)[int(share)]
                assert state.C == pytest.approx(exact.C, abs=1e-9) and state.K == pytest.approx(exact.K, abs=1e-9)
            first, second, mixed = (np.linalg.norm(point.C[:, :dimensions], axis=1) for point in (a, b, state))
            assert mixed == pytest.approx((1 - share) * first + share * second)
            assert simulate(a.scene, periods=0.2, start=state).status == "ok"
    with pytest.raises(ValueError, match="of one time"):
        between(a, b.at_zero(), 0.5)
    with pytest.raises(ValueError, match="one grid"):
        between(a, simulate(line({**SMALL, "tether.nodes": 11}), periods=2).final_state, 0.5)


HELD = held(0.0, 20.5)
FAULTY = {
    "the paper's scheme": (lambda state: state, {"solver.scheme": "paper-box"}, "only start from rest"),
    "another end": (lambda state: state, HELD, "end.kind = 'buoy' for a scene with 'held'"),
    "an end elsewhere": (
        lambda state: simulate(line({**SMALL, **HELD}), duration_s=1),
        {**HELD, "end.position_m": [0.0, 0.0, 20.4]},
        "end.position_m",
    ),
    "nan": (lambda state: replace(state, C=state.C * np.nan), {}, "not a finite number, among its C"),
    "another engine": (lambda state: replace(state, numbers=state.numbers[1:]), {}, "another version of the engine"),
    "half a file": (lambda state: replace(state, K=NONE), {}, "K of shape"),
    "no state": (lambda state: 7, {}, "given 7; allowed: a Trajectory"),
    "space": (lambda state: simulate(line({**SMALL, "motion.dimensions": 3}), duration_s=1), {}, "in 3 dimensions"),
    "ended early": (
        lambda state: simulate(line({**SMALL, FAR[0]: [1e4, 0.0, 0.0]}), duration_s=1),
        {},
        "without a final state",
    ),
}
FAR = "start.buoy_velocity_mps", "start.buoy_displacement_m"


@pytest.mark.parametrize("kind", FAULTY)
def test_a_run_that_cannot_go_on_says_why(kind, first):
    start_of, changes, words = FAULTY[kind]
    with pytest.raises(ValueError, match=words):
        simulate(line({**SMALL, **changes}), duration_s=1.0, start=start_of(first.final_state))


def test_on_the_command_line(first, tmp_path, capsys):
    file, cut = tmp_path / "run.nc", tmp_path / "cut.nc"
    first.save(file)
    cut.write_bytes(file.read_bytes()[:-1000])
    command = ["tethered_buoy", "--set", *(f"{key}={value}" for key, value in SMALL.items()), "tether.nodes=11"]
    out = ["--periods", "1", "--out", str(tmp_path / "run.png")]
    assert __main__.main([*command, *out, "--start-from", str(file)]) == 0
    assert "went on at t = 20 s; changed: tether.nodes 9 -> 11" in capsys.readouterr().out
    for name in (cut, tmp_path / "none.nc", __file__):
        assert __main__.main([*command, *out, "--start-from", str(name)]) == 2
        assert capsys.readouterr().err.count(str(name)) == 1


CALM = {"tether.nodes": 21, "waves.steepness": 0.0, "water.depth_m": 25.0, "solver.rtol": 1e-3, "output.step_s": 0.02}


@pytest.mark.parametrize("axis, displacement, within", [("radial", 0.01, 5e-4), ("pendulum", 0.1, 0.03)])
def test_a_displaced_buoy_swings_with_its_natural_frequency(axis, displacement, within):
    """Section 4.2.1 of the paper, which leaves out the rope's mass and the drag."""
    from engine.natural_frequencies import natural_frequencies

    place = [0.0, 0.0, displacement] if axis == "radial" else [displacement, 0.0, 0.0]
    scene = line({**CALM, FAR[1]: place})
    run = simulate(scene, duration_s=13.0 if axis == "radial" else 40.0)
    swing = run.columns["z_m"] - run.columns["z_m"][0] + displacement if axis == "radial" else run.columns["x_m"]
    assert swing[0] == pytest.approx(displacement, abs=1e-9) and abs(run.columns["radius_rate_mps"][0]) < 1e-9
    at = np.flatnonzero(swing[1:] * swing[:-1] < 0.0)
    passes = run.columns["time_s"][at] + 0.02 * swing[at] / (swing[at] - swing[at + 1])
    frequency_radps = np.pi * (len(passes) - 1) / (passes[-1] - passes[0])
    assert frequency_radps == pytest.approx(getattr(natural_frequencies(scene), f"{axis}_radps"), rel=within)


@pytest.mark.parametrize("place", [[3.0, 0.0, -4.0], [-2.0, 0.0, 1.0]], ids=["slack", "stretched"])
def test_a_displaced_line_begins_as_one_that_is_held_there(place):
    scene = line({**CALM, FAR[1]: place, "output.profiles": True})
    run = simulate(scene, duration_s=1.0)
    end = (run.columns[name][0] for name in ("x_m", "y_m", "z_m"))
    held_run = simulate(line({**CALM, **held(*end), "output.profiles": True}), duration_s=0.1)
    for name in ("x_m", "z_m", "tension_N"):
        assert getattr(run.profiles, name)[0] == pytest.approx(getattr(held_run.profiles, name)[0], abs=1e-6)
    space = simulate(line({**CALM, FAR[1]: place, "motion.dimensions": 3}), duration_s=1.0)
    assert space.columns["radius_m"] == pytest.approx(run.columns["radius_m"], abs=1e-6)
