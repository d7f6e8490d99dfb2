"""The natural frequencies of a buoy on its tether are those of a mass on a spring and of a pendulum."""

import math

import pytest

from engine.natural_frequencies import natural_frequencies
from tests.engine.lines import line

TANH = {"tether.tension": {"law": "tanh", "p": [3e4, 5.0, 0.0, 0.0, 1e4]}}


def test_natural_frequencies_are_those_of_a_mass_on_the_tether():
    mass, length = 1611.0 + 907.0, 20.0
    for law, slope in (({}, lambda strain: 5e4), (TANH, lambda strain: 1.5e5 / math.cosh(5.0 * strain) ** 2 + 1e4)):
        modes = natural_frequencies(line(law))
        assert modes.radial_radps == pytest.approx(math.sqrt(slope(modes.static_strain) / (length * mass)), rel=1e-7)
        assert modes.pendulum_radps == pytest.approx(math.sqrt(modes.static_tension_N / (length * mass)), rel=1e-12)
    assert natural_frequencies(line()).static_strain == pytest.approx(0.04, rel=1e-3)
    assert natural_frequencies(line({"buoy.mass_kg": 1e4})) is None


def test_a_buoy_at_rest_under_water_has_the_modes_of_the_whole_sphere_and_at_the_surface_none():
    deep, out = ({"buoy.submergence": "spherical-cap", "water.depth_m": depth} for depth in (22.5, 21.0))
    assert natural_frequencies(line(deep)) == natural_frequencies(line({"water.depth_m": 22.5}))
    assert natural_frequencies(line(out)) is None
