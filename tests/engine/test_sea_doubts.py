"""Law: a run in a sea says in a sentence where its laws end, and says nothing in a usual sea."""

import numpy as np
import pytest

from engine import simulate
from engine.run import Idle, trust
from tests.engine.lines import kick, line

USUAL = {"tether.nodes": 5, "water.depth_m": 22.5, "waves.period_s": 6.0, "buoy.submergence": "spherical-cap"}


def message(significant_height_m, periods=2, **changes):
    jonswap = {"significant_height_m": significant_height_m, "components": 16}
    scene = line(USUAL, {"waves.jonswap": jonswap}, changes)
    return simulate(scene, periods=periods).message


KICKED = kick(w=4.0)


@pytest.mark.parametrize(
    ("height_m", "changes", "sentence"),
    [
        (4.5, {}, "steepest seas in nature"),
        (0.1, {"waves.period_s": 1.6}, "no diffraction"),
        (1.0, {"water.depth_m": 20.0, "waves.above_still_water": "zero"}, "'zero' stops the water"),
        (
            1.5,
            {"water.depth_m": 21.0, "waves.above_still_water": "extrapolate", "waves.period_s": 4.0} | KICKED,
            "times as fast",
        ),
    ],
)
def test_a_sea_beyond_its_laws_is_told(height_m, changes, sentence):
    assert sentence in message(height_m, **changes)


def test_extrapolated_waves_are_told_by_the_height_above_still_water_and_not_above_the_anchor():
    """1 m above the water: 21 m above an anchor of 2 m, in 22 m."""
    above = {"anchor.position_m": [0.0, 0.0, 2.0], "waves.above_still_water": "extrapolate", "waves.period_s": 4.0}
    scene = line({**USUAL, "water.depth_m": 22.0}, {"waves.jonswap": {"significant_height_m": 1.0}}, above)
    (words,) = trust._sea(Idle(scene, 1.0), {"z_m": np.array([20.0, 21.0])})
    assert words.startswith("1 m above still water")


def test_a_buoy_that_comes_above_still_water_is_no_doubt_where_the_water_moves_there():
    assert "still water" not in message(1.0, **{"water.depth_m": 20.0, "waves.above_still_water": "wheeler"})


def test_a_usual_sea_is_not_doubted_but_in_a_long_run():
    assert message(1.0) == ""
    assert "nearly repeats its groups" in message(1.0, periods=180)
