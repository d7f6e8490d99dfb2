"""Law: axial ringing of a stiff line stays while it is alive, costs nothing where there is none, and what the steps do
not resolve of it is said in newtons.

Free heave of the buoy above its anchor, without drag: omega^2 = EA/(L (M + M_a + m L/3)), for ever.
"""

import numpy as np
import pytest

from tests.engine.lines import STILL, harmonic, held, line, linear, ran

FRICTIONLESS = STILL | {"buoy.drag": 0.0, "tether.drag_normal": 0.0, "tether.drag_tangential": 0.0}
SMALL_WAVES = {"waves.steepness": 0.016, "water.depth_m": 22.5}
RINGING_N, CYCLES, SAMPLES = 500.0, 100, 20


def heave(stiffness_N, *parts):
    """(run of 100 cycles of free heave of 500 N, its period (s) in closed form)."""
    scene = line(FRICTIONLESS)
    tether, buoy = scene.tether, scene.buoy
    moved = buoy.mass_kg + buoy.added_mass_kg + tether.density_kgpm3 * tether.area_m2 * tether.length_m / 3
    period_s = 2 * np.pi * np.sqrt(tether.length_m * moved / stiffness_N)
    displacement_m = [0.0, 0.0, -RINGING_N * tether.length_m / stiffness_N]
    changes = {"start.buoy_displacement_m": displacement_m, "output.step_s": period_s / SAMPLES}
    return ran(line(FRICTIONLESS, changes, *parts, tension=linear(stiffness_N)), duration_s=CYCLES * period_s), period_s


def extremes(run, cycles=slice(None)):
    samples = slice(*(None if at is None else at * SAMPLES for at in (cycles.start, cycles.stop)))
    return run.columns["tension_top_low_N"][samples].min(), run.columns["tension_top_high_N"][samples].max()


@pytest.mark.parametrize("stiffness_N, dimensions", [(3e6, 2), (1e8, 2), (1e9, 2), (1e8, 3)])
def test_free_heave_stays_for_a_hundred_cycles(stiffness_N, dimensions):
    run, period_s = heave(stiffness_N, {"motion.dimensions": dimensions})
    low, high = extremes(run, slice(CYCLES - 5, None))
    assert 0.95 * RINGING_N < (high - low) / 2 < 1.01 * RINGING_N
    time_s, off = run.columns["time_s"], run.columns["tension_top_N"] - run.columns["tension_top_N"].mean()
    up = np.flatnonzero((off[:-1] < 0) & (off[1:] >= 0))
    crossings = time_s[up] - off[up] * np.diff(time_s)[up] / np.diff(off)[up]
    assert np.diff(crossings).mean() == pytest.approx(period_s, rel=0.005)
    assert run.statistics["unresolved_ringing_N"] == 0 and run.message == ""


@pytest.mark.parametrize("changes", [{"solver.shortest_period_s": 1.0}, {"solver.step_s": 0.08}])
def test_what_is_damped_is_said(changes):
    run, period_s = heave(1e8, changes)
    low, high = extremes(run, slice(CYCLES - 5, None))
    assert (high - low) / 2 < 0.5 * RINGING_N
    assert run.statistics["unresolved_ringing_N"] == pytest.approx(RINGING_N, rel=0.1)
    assert f"period {period_s:.2g} s" in run.message


def test_the_largest_tension_of_a_stiff_line_in_waves_is_that_of_short_steps():
    stiff = SMALL_WAVES | {"tether.tension.stiffness_N": 1e8}
    default, refined = (ran(line(stiff, changes), 4) for changes in ({}, {"solver.max_step_s": 0.0025}))
    assert extremes(default) == pytest.approx(extremes(refined), rel=0.005)
    assert default.statistics["steps"] < 0.2 * refined.statistics["steps"]


@pytest.mark.parametrize("stiffness_N", [1e8, 5e8])
def test_steps_are_long_where_nothing_rings(stiffness_N):
    """Waves that begin slowly do not excite it: the steps are those of max_step_s."""
    run = ran(line(SMALL_WAVES, {"waves.ramp_s": 20.0, "tether.tension.stiffness_N": stiffness_N}), 6)
    assert run.statistics["steps"] < 1.1 * 30.0 / run.scene.solver.max_step_s


def test_the_control_does_not_touch_a_line_whose_ringing_is_slow():
    """The line of Table 1 heaves in 6.3 s: the same steps, bit for bit, as without the control."""
    steep = {"waves.steepness": 0.13, "water.depth_m": 21.6}
    runs = [ran(line(steep, changes), 6) for changes in ({}, {"solver.shortest_period_s": 1e9})]
    for name, column in runs[0].columns.items():
        np.testing.assert_array_equal(column, runs[1].columns[name], name)


SHAKEN = {"end.motion": harmonic([0, 0, 1e-4], 0.5)}


@pytest.mark.parametrize(
    "driven, steps", [(SMALL_WAVES | {"waves.period_s": 0.5}, 8), (held(0.0, 20.5) | STILL | SHAKEN, 40)]
)
def test_what_drives_is_followed_however_small(driven, steps):
    run = ran(line(driven), duration_s=5.0)
    assert run.statistics["steps"] >= steps * 5.0 / 0.5
