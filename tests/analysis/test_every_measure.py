"""One bad sample or a step without meaning stops every measure, by name.

The package is light until used, and its names mean the same in whatever order one imports.
"""

from pathlib import Path

import numpy as np
import pytest

import analysis
from analysis.stationarity import record_drift
from tests.processes import python

STEPPED = {
    "spectrum": lambda x, step: analysis.spectrum(x, step, 5.0, 0, 1),
    "poincare_section": lambda x, step: analysis.poincare_section(x, step, 5.0),
    "poincare_section by name": lambda x, step: analysis.poincare_section({"radius_m": x}, step, 5.0),
    "slack_fraction": lambda x, step: analysis.slack_fraction(x, step),
    "extremes": lambda x, step: analysis.extremes(x, step),
    "detect_snaps": lambda x, step: analysis.detect_snaps(x, step, 1.0),
}
CALLS = {name: lambda x, call=call: call(x, 0.1) for name, call in STEPPED.items()} | {
    "orbit_diagram": lambda x: analysis.orbit_diagram([1.0], [x]),
    "detect_period": analysis.detect_period,
    "zero_one_test": analysis.zero_one_test,
    "growth_or_bursts": lambda x: analysis.growth_or_bursts(x, 0.1, 5.0),
    "wolf_lyapunov": lambda x: analysis.wolf_lyapunov(x, 0.1),
    "rosenstein_lyapunov": lambda x: analysis.rosenstein_lyapunov(x, 0.1),
    "tangent_lyapunov": analysis.tangent_lyapunov,
    "record_drift": record_drift,
    "neighbour_growth": analysis.neighbour_growth,
    "prediction_gain": analysis.prediction_gain,
    "correlation_dimension": analysis.correlation_dimension,
    "spectral_lines": analysis.spectral_lines,
    "regime": lambda x: analysis.regime(strobed=x),
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_values_that_are_not_finite_are_refused_with_their_place_and_arrays_given_are_left_alone(call, bad):
    x = np.zeros(101)
    call(x)
    assert not x.any() and x.flags.writeable
    x[[17, 40]] = bad
    with pytest.raises(ValueError, match=r"2 value\(s\) not finite, the first at index 17"):
        call(x)


@pytest.mark.parametrize("call", STEPPED.values(), ids=STEPPED)
@pytest.mark.parametrize("step", [0.0, -0.1, np.nan, np.inf])
def test_a_step_that_is_no_positive_number_is_refused(call, step):
    with pytest.raises(ValueError, match="step_s"):
        call(np.zeros(101), step)


def test_a_record_does_not_change_through_its_arrays_and_has_numbers_of_python():
    x = np.arange(101.0)
    spectrum = analysis.spectrum(x, 0.1, 5.0, 0, 1)
    with pytest.raises(ValueError, match="read-only"):
        spectrum.amplitude[0] = 1.0
    assert type(analysis.extremes(x, 0.1).maximum) is float and analysis.extremes(x, 0.1) == analysis.extremes(x, 0.1)


MODULES = {path.stem for path in Path(analysis.__file__).parent.glob("*.py")} - {"__init__", "__main__"}


def test_importing_the_package_imports_no_array_library_and_no_module_hides_a_function():
    code = "import analysis, sys; print([m for m in ('numpy', 'scipy') if m in sys.modules])"
    answer = python("-c", code)
    assert answer.stdout == "[]\n", answer.stderr
    assert not MODULES & set(analysis.__all__)
    with pytest.raises(AttributeError, match="wolf"):
        _ = analysis.wolf
