"""Messages of runs have their numbers without an exponent where a reader needs none."""

import pytest

from engine import load_scene, simulate
from engine.digits import digits


@pytest.mark.parametrize(
    ("value", "count", "text"),
    [(12345.6, 4, "12350"), (873.4, 2, "870"), (-0.00123, 2, "-0.0012"), (0.0, 4, "0"), (2.0e15, 2, "2e+15")],
)
def test_a_number_has_its_digits_and_no_exponent(value, count, text):
    assert digits(value, count) == text


def test_a_large_tension_in_a_message_can_be_read():
    """A buoy begins to heave on a stiff line, in steps of backward Euler that are too long for it."""
    changes = {
        "waves": None,
        "tether.tension.stiffness_N": 3e6,
        "tether.nodes": 11,
        "solver.integrator": "backward-euler",
        "solver.step_s": 0.05,
        "start.buoy_velocity_mps": [0.0, 0.0, 1.0],
    }
    run = simulate(load_scene("tethered_buoy", changes), duration_s=2.0)
    assert "largest tension" in run.message and "e+0" not in run.message, run.message
