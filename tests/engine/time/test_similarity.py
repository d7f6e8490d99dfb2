"""Law: a scene knows no units. With lengths, times and masses counted in other ones, every number of the motion changes
by the units of its column, and nothing else does.

Gravity, ramps, the bed, damping and both kinds of partial submergence are at work. Each new unit is a power of two of
the old one, so that rounding is nearly the same; where a line on the bed snaps, the rest is magnified to 1e-4 of the
largest tension.
"""

import numpy as np
import pytest

from engine import simulate
from engine.scene import build_scene
from engine.scene.reference import keys
from tests.engine.lines import SPACE, STILL, harmonic, held, line
from tests.engine.physics.caps import CAP

LENGTH, TIME, MASS = 4.0, 4.0, 32.0  # new numbers over old ones
POWERS = {  # of length, time and mass
    "1": (0, 0, 0), "": (0, 0, 0), "rad": (0, 0, 0), "m": (1, 0, 0), "m2": (2, 0, 0), "s": (0, 1, 0), "kg": (0, 0, 1),
    "m/s": (1, -1, 0), "m/s2": (1, -2, 0), "kg/m3": (-3, 0, 1), "N": (1, -2, 1), "N m2": (3, -2, 1),
    "N/m3": (-2, -2, 1), "N s/m3": (-2, -1, 1), "N s": (1, -1, 1), "rad/s": (0, -1, 0),
}  # fmt: skip
COLUMNS = {"m": "m", "N": "N", "s": "s", "rad": "rad", "mps": "m/s", "radps": "rad/s"}
SHAKEN = harmonic([0.4, 0.0, 0.6], 2.0, ramp_s=1.0)
BED = {"stiffness_Npm3": 1e5, "damping_Nspm3": 3e3, "friction": 0.3, "friction_speed_mps": 0.2}
CASES = {
    "buoy through the surface": CAP | {"waves.steepness": 0.1, "water.depth_m": 20.8, "waves.ramp_s": 2.0,
                                       "buoy.impact_loss": 0.4},
    "damped line through the surface": held(9.0, 19.5, motion=SHAKEN) | {
        "tether.submergence": "free-surface", "tether.diameter_m": 0.05, "tether.damping_Ns": 4e3,
        "waves.steepness": 0.05},
    "line laid on the bed": STILL | held(18.4, 1.0, motion=SHAKEN) | {"floor": BED},
    "end let go": STILL | held(12.0, 15.0, release_s=0.5, force_N=[40.0, 0.0, 10.0]),
}  # fmt: skip


def factor(unit):
    length, time, mass = POWERS[unit]
    return LENGTH**length * TIME**time * MASS**mass


def in_other_units(section, units, above=""):
    """A section of a scene, as a table, with its numbers counted in the new units."""
    changed = {}
    for name, value in section.items():
        key = f"{above}{name}"
        if isinstance(value, dict):
            changed[name] = in_other_units(value, units, f"{key}.")
        elif isinstance(value, str | bool | None) or key not in units or POWERS[units[key]] == (0, 0, 0):
            changed[name] = value
        else:
            changed[name] = (np.array(value) * factor(units[key])).tolist()
    return changed


@pytest.mark.parametrize("space", [{}, SPACE], ids=["plane", "space"])
@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_the_same_in_other_units(name, space):
    scene = line(CASES[name], space, {"solver.rtol": 1e-3, "output.step_s": 0.05}, nodes=9)
    units = {key: declared.unit for key, declared in keys().items()}
    other = build_scene(in_other_units(scene.as_dict(), units))
    assert other.gravity_mps2 == scene.gravity_mps2 * LENGTH / TIME**2
    runs = simulate(scene, duration_s=3.0), simulate(other, duration_s=3.0 * TIME)
    assert [run.status for run in runs] == ["ok", "ok"], [run.message for run in runs]
    for column, values in runs[0].columns.items():
        unit = COLUMNS.get(column.rpartition("_")[2], "")
        expected = values * factor(unit)
        assert np.abs(runs[1].columns[column] - expected).max() <= 1e-3 * np.abs(expected).max(), column
