"""Law: of a slack line whose end is moved, a run says that its largest tension comes after folds that its elements do
not resolve where refinement changes that tension, by as much at most; elsewhere it says nothing.
"""

import math
import re

import numpy as np
import pytest

from engine.time.folds import FOLD, words_of_folds
from tests.engine.lines import STILL, by_table, harmonic, held, line, ran

FINE = {"tether.nodes": 161, "solver.rtol": 0.005}
WRONG, RIGHT = 0.05, 0.02  # of the largest tension: beyond the first it is off, below the second it is not


def moved(share, tilt, length, period_s, along_m, across_m, stiffness_Nm2, **keys):
    """A line in still water, its ends a share of its length apart; the upper one shaken along the chord and across."""
    x, z = math.cos(tilt), math.sin(tilt)
    amplitude = [along_m * x - across_m * z, 0.0, along_m * z + across_m * x]
    motion = harmonic(amplitude, period_s, ramp_s=period_s)
    rope = {"tether.length_m": length, "tether.bending_stiffness_Nm2": stiffness_Nm2, "water.depth_m": 3 * length}
    return STILL | held(share * length * x, share * length * z, motion=motion) | rope | keys


def run_of(scene, **keys):
    return ran(line(scene, keys), duration_s=3 * scene["end"]["motion"]["period_s"])


def test_the_chord_of_a_fold_is_five_per_cent_too_short():
    """The box takes the mean of the tangents at both ends of an element, the arc that over its length."""
    assert math.cos(FOLD / 2) / (math.sin(FOLD / 2) / (FOLD / 2)) == pytest.approx(0.95, abs=1e-3)


@pytest.mark.parametrize(("wrong", "dimensions", "scene"), [
    (True, 3, moved(0.64, 0.5, 20.0, 2.0, 0.6, -0.3, 0.01)),
    (True, 2, moved(0.75, 0.2, 50.0, 4.0, 1.0, 4.0, 0.4)),
    (False, 2, moved(0.80, 0.0, 20.0, 6.0, 0.3, 0.5, 0.4)),
    (False, 3, moved(0.93, 1.2, 10.0, 3.0, 0.2, 0.3, 4.0)),
])  # fmt: skip
def test_a_run_tells_of_folds_where_they_move_its_largest_tension(wrong, dimensions, scene):
    run, fine = (run_of(scene, **{"motion.dimensions": dimensions}, **more) for more in ({}, FINE))
    largest, right = (float(each_run.columns["tension_top_high_N"].max()) for each_run in (run, fine))
    off = abs(largest / right - 1.0)
    assert off > WRONG if wrong else off < RIGHT
    stated = re.search(r"folds .* by up to (\d+)%", run.message)
    assert off < float(stated.group(1)) / 100.0 if wrong else stated is None


def test_folds_after_the_largest_tension_and_those_of_a_buoys_line_are_not_told():
    """A taut line is let hang: what folds later cannot have changed its largest tension."""
    slackens = by_table([0.0, 8.0], [[0.0, 0.0, 0.0], [-8.0, 0.0, -8.0]])
    scene = STILL | held(14.2, 14.2, motion=slackens) | {"tether.bending_stiffness_Nm2": 0.01}
    for keys in (scene, {}):
        run = ran(line(keys), duration_s=15.0)
        assert run.statistics["max_turn_rad"] > FOLD and "folds" not in run.message


@pytest.mark.parametrize(("share", "stated"), [(1.04, False), (1.2, True)])
def test_folds_are_told_before_a_tension_that_is_more_than_that_at_rest(share, stated):
    places = dict.fromkeys(("x_m", "y_m", "z_m"), np.full(3, 5.0))
    columns = {"time_s": np.arange(3.0), "tension_top_high_N": np.array([10.0, 10.0, 10.0 * share]), **places}
    state = {"folded": 0.5, "max_turn": 1.0}
    assert bool(words_of_folds(line(STILL | held(5.0, 5.0)), state, columns)) == stated


def test_a_line_that_hangs_still_is_not_warned_of_its_bend():
    """Ends that almost meet: the lowest element turns by more than FOLD, and statics has its tension right."""
    scene = STILL | held(0.02, 0.0) | {"tether.bending_stiffness_Nm2": 0.01}
    run = ran(line(scene), duration_s=2.0)
    assert run.statistics["max_turn_rad"] > FOLD and "folds" not in run.message
