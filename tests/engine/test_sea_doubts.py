"""Law: a run in a sea says in a sentence where its laws end, and says nothing in a usual sea."""

import pytest

from engine import simulate
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
        (
            1.5,
            {"water.depth_m": 21.0, "waves.above_still_water": "extrapolate", "waves.period_s": 4.0} | KICKED,
            "times as fast",
        ),
    ],
)
def test_a_sea_beyond_its_laws_is_told(height_m, changes, sentence):
    assert sentence in message(height_m, **changes)


def test_a_usual_sea_is_not_doubted_but_in_a_long_run():
    assert message(1.0) == ""
    assert "nearly repeats its groups" in message(1.0, periods=180)
