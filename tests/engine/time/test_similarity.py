"""Law: a scene knows no units. With lengths, times and masses counted in other ones, every number of the motion changes
by the units of its column, and nothing else does.

Gravity, ramps, the bed, damping and both kinds of partial submergence are at work. Each new unit is a power of two of
the old one, so that rounding is nearly the same. The runs end before the line on the bed snaps (2.55 s), because this
magnifies rounding to a hundredth of the largest tension.
"""

import math

import numpy as np
import pytest

from engine import simulate
from engine.own_mooring.ropes import rope_of
from engine.own_mooring.scene import Mooring, scene_text
from engine.run.rest import rest_of
from engine.scene import build_scene, scene_from_toml
from engine.scene.reference import keys
from engine.time.status import OK
from tests.engine.lines import SPACE, STILL, harmonic, held, line
from tests.engine.physics.caps import CAP

OTHER = 4.0, 4.0, 32.0  # of length, time and mass: new numbers over old ones
MODEL = 2.0**-6, 2.0**-3, 2.0**-18  # those of a model by Froude's law: under the same gravity, in the same water
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


def factor(unit, scale):
    return math.prod(size**power for size, power in zip(scale, POWERS[unit], strict=True))


def in_other_units(section, scale, above=""):
    """A section of a scene, as a table, with its numbers counted in the new units."""
    units, changed = {key: declared.unit for key, declared in keys().items()}, {}
    for name, value in section.items():
        key = f"{above}{name}"
        if isinstance(value, dict):
            changed[name] = in_other_units(value, scale, f"{key}.")
        elif isinstance(value, str | bool | None) or key not in units or POWERS[units[key]] == (0, 0, 0):
            changed[name] = value
        else:
            changed[name] = (np.array(value) * factor(units[key], scale)).tolist()
    return changed


@pytest.mark.parametrize("space", [{}, SPACE], ids=["plane", "space"])
@pytest.mark.parametrize("name", CASES)
def test_the_motion_is_the_same_in_other_units(name, space):
    scene = line(CASES[name], space, {"solver.rtol": 1e-3, "output.step_s": 0.05}, nodes=9)
    other = build_scene(in_other_units(scene.as_dict(), OTHER))
    assert other.gravity_mps2 == scene.gravity_mps2 * factor("m/s2", OTHER)
    runs = simulate(scene, duration_s=2.5), simulate(other, duration_s=2.5 * factor("s", OTHER))
    assert [run.status for run in runs] == ["ok", "ok"], [run.message for run in runs]
    for column, values in runs[0].columns.items():
        unit = COLUMNS.get(column.rpartition("_")[2], "")
        expected = values * factor(unit, OTHER)
        assert np.abs(runs[1].columns[column] - expected).max() <= 1e-5 * np.abs(expected).max(), column


@pytest.mark.parametrize(
    "mooring",
    [
        Mooring(3.92, 113.0, rope_of("hmpe", 0.0197), 134.0, 7.06, 9.73),
        Mooring(1.19, 10.1, rope_of("wire", 0.00661), 15.4, 0.64, 3.92, current_mps=0.771),
    ],
    ids=["HMPE", "wire in a current"],
)
def test_a_model_rests_as_its_prototype(mooring):
    """Slack lines on a bed. The HMPE had no rest in the model, the wire one of 76 N in place of 64 N, in full scale."""
    scene = scene_from_toml(scene_text(mooring, "mine"))
    rest, of_model = (rest_of(s) for s in (scene, build_scene(in_other_units(scene.as_dict(), MODEL))))
    assert rest.status == of_model.status == OK
    assert of_model.top_N == pytest.approx(rest.top_N * factor("N", MODEL))
