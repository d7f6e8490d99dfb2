"""Law: a step multiplies every mode of a straight line by its method's stability function R(lambda dt).

Modes and rates are closed forms of the box equations (`campaigns.stability.step_maps`); the eigenvalues come from the
engine's own step, by central differences of 1e-6, and are good to 1e-5 or so. Taut, nothing may grow at any step.
Compressed, what grows has to grow.
"""

import numpy as np
import pytest

from campaigns.stability import step_maps

LINES = {
    **step_maps.LINES,
    "taut, short steps": ("", step_maps.TAUT, 1e-3, 2),
    "taut, long steps": ("", step_maps.TAUT, 3.0, 2),
}
ORDER = {"esdirk43": 4, "trbdf2": 2, "generalized-alpha": 2, "backward-euler": 1, "midpoint": 2}
AT_INFINITY = {"esdirk43": 0.0, "trbdf2": 0.0, "generalized-alpha": 0.5, "backward-euler": 0.0, "midpoint": 1.0}


@pytest.mark.parametrize("method", step_maps.METHODS)
def test_the_stability_function_is_that_of_its_order_and_damping(method):
    z = np.array([1e-2j, 5e-3j])
    error = np.abs(step_maps.factors(method, z)[None, :] - np.exp(z)[:, None]).min(axis=1)
    assert np.log2(error[0] / error[1]) == pytest.approx(ORDER[method] + 1, abs=0.15)
    at_infinity = np.abs(step_maps.factors(method, np.array([-1e9 + 0j]))).max()
    assert at_infinity == pytest.approx(AT_INFINITY[method], abs=1e-6)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if name == "taut in space" else name for name in LINES]
)
def test_modes_are_multiplied_as_the_method_says(name, monkeypatch):
    monkeypatch.setattr(step_maps, "LINES", LINES)
    pushed = name.startswith("pushed")
    for method, found in step_maps.of_line(name)["methods"].items():
        assert found.get("distance", 0.0) < (2e-5 if pushed else 1e-4), method
        assert pushed or found["largest"] < 1 + 1e-5, method
        assert name != "pushed" or found["growing"] == found["growing_found"] == 7, method


def test_two_e_folds_a_step_follow_the_growth_and_fifteen_do_not():
    """What solver.growth_per_step is for: R(2) of the default method is e^2 to 1 %, and R(15) has nothing of e^15."""
    two, fifteen = step_maps.factors("esdirk43", np.array([2.0, 15.0]) + 0j).real
    assert two == pytest.approx(np.exp(2.0), rel=0.01)
    assert abs(fifteen) < 1e-3 * np.exp(15.0)


def test_space_has_the_same_modes_twice():
    planar, space = (step_maps.eigenvalues("trbdf2", step_maps.TAUT, 0.05, dimensions) for dimensions in (2, 3))
    assert len(space) == 1.5 * len(planar)
    assert np.abs(space[None, :] - planar[:, None]).min(axis=1).max() < 1e-5
