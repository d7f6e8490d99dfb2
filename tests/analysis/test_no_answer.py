"""What makes no sense is refused with the reason, and a record that has no answer says why."""

import numpy as np
import pytest

from analysis import (
    block_maxima,
    correlation_dimension,
    density_image,
    detect_period,
    growth_or_bursts,
    motion_regime,
    orbit_diagram,
    poincare_section,
    rank_among,
    regime,
    rosenstein_lyapunov,
    scale_density,
    section_distance,
    section_lyapunov,
    settled,
    slack_fraction,
    spectral_peaks,
    spectrum,
    tangent_lyapunov,
    transverse_lyapunov,
    wolf_lyapunov,
    zero_one_test,
)
from analysis.embedding import delay_vectors, mutual_information
from analysis.exponents import Exponent
from analysis.orbits import OrbitMap, find_orbit, follow_branch
from analysis.oscillator import SnapOscillator, snap_diagram, snap_exponents, strobed_states
from tests.analysis.systems import henon, logistic_step, normal, record, two_tone

ZEROS, PAIRS, MAP, SNAP = np.zeros(101), np.zeros((50, 2)), OrbitMap(logistic_step), SnapOscillator()
NATS = Exponent(0.42, 0.01, "nats/time", "known")
TIME = np.arange(5000.0)
HALF_A_TURN = np.sin(np.pi * np.arange(700) / 700)


def section(series, step_s=0.1, period_s=5.0, **options):
    return poincare_section(series, step_s, period_s, **options)


REFUSED = [
    ("unit", lambda: Exponent(1.0, 0.1, "nats", "method")),
    ("error", lambda: Exponent(1.0, -0.1, "nats/time", "method")),
    ("reason", lambda: Exponent(np.nan, 0.1, "nats/time", "method")),
    ("either series or strobed", regime),
    ("step_s and period_s", lambda: regime(ZEROS)),
    ("surrogates", lambda: regime(strobed=ZEROS, surrogates=18)),
    ("period_s is needed", lambda: regime(strobed=henon(60), tangent_exponent=NATS)),
    ("growth_nats", lambda: motion_regime(ZEROS, ZEROS)),
    ("finite", lambda: motion_regime(np.full(200, np.nan))),
    ("measures: 49 rows", lambda: settled(PAIRS, PAIRS, scale=1.0)),
    ("scale", lambda: settled(PAIRS, PAIRS[1:], scale=(1.0, 0.0))),
    ("scale", lambda: detect_period(ZEROS, scale=0.0)),
    ("scale", lambda: detect_period(ZEROS, scale=[1.0, 2.0])),
    ("tolerance", lambda: detect_period(ZEROS, tolerance=0.0)),
    ("max_period", lambda: detect_period(ZEROS, max_period=0)),
    ("needs 3 periods.*given 2 ", lambda: section(ZEROS, transient_periods=3)),
    ("needs 0.5 periods", lambda: section(ZEROS[:20], phase=0.5)),
    ("0 <= phase < 1", lambda: section(ZEROS, phase=1.0)),
    ("period_s", lambda: section(ZEROS, period_s=0.0)),
    ("equal length.*a: 10, b: 11", lambda: section({"a": ZEROS[:10], "b": ZEROS[:11]})),
    ("at least 4 of them, given 3", lambda: section(ZEROS[:3], step_s=4.0, phase=0.5)),
    ("there are radius_m, angle_rad", lambda: section({"radius_m": ZEROS, "angle_rad": ZEROS}).column("r")),
    ("given 1 arrays for 2 values", lambda: orbit_diagram([0.1, 0.2], [[1.0]])),
    ("without a single point", lambda: density_image(orbit_diagram([1.0], [[]]))),
    ("low < high", lambda: density_image(orbit_diagram([1.0], [ZEROS]), value_range=(1.0, 1.0))),
    ("linear, log or rank", lambda: scale_density([1], "square")),
    ("coordinates", lambda: section_distance(PAIRS, np.zeros((50, 3)))),
    (
        r"needs 60 forcing periods.*300 s.*given 59\.99.*299\.95 s",
        lambda: spectrum(np.zeros(6000), 0.05, 5.0),
    ),
    ("needs 60 forcing periods.*given 0 ", lambda: spectrum([], 0.05, 5.0)),
    ("least_prominence", lambda: spectral_peaks(None, 0.0)),
    ("least_prominence", lambda: spectral_peaks(None, 1.5)),
    ("need 22 samples, given 20", lambda: delay_vectors(ZEROS[:20], 7, 4)),
    ("less than half", lambda: mutual_information(ZEROS, 51)),
    ("samples", lambda: block_maxima(ZEROS, 0)),
    ("transient", lambda: slack_fraction([1.0, 2.0], 0.1, transient_s=0.3)),
    ("transient", lambda: slack_fraction([], 0.1)),
    ("transient", lambda: slack_fraction(ZEROS[:11], 0.1, transient_s=1.0)),
    ("released", lambda: transverse_lyapunov(ZEROS, 0, ZEROS[1:])),
    ("19 at least", lambda: rank_among(1.0, np.arange(18.0))),
    ("two steps", lambda: growth_or_bursts(ZEROS, 0.1, 0.1)),
    ("start", lambda: find_orbit(MAP, [[0.5], [0.6]], 3.2, 3)),
    ("orbit", lambda: follow_branch(MAP, find_orbit(MAP, [0.6], 2.7), 3.0, 3.5)),
    ("damping", lambda: SnapOscillator(damping=-0.1)),
    ("damping", lambda: SnapOscillator(damping=2.0)),
    ("damping", lambda: SnapOscillator(damping=0.0, frequency=1.0)),
    ("frequency", lambda: SnapOscillator(frequency=0.0)),
    ("force", lambda: SnapOscillator(force=-1.0)),
    ("lift", lambda: SnapOscillator(lift=np.nan)),
    ("phase", lambda: SnapOscillator(phase=np.inf)),
    ("start", lambda: strobed_states(SNAP, (np.nan, 0.0), 5)),
    ("over", lambda: snap_diagram(SNAP, "mass", [1.0])),
    ("periods", lambda: snap_exponents(SNAP, periods=101, blocks=20)),
]


@pytest.mark.parametrize(("message", "call"), REFUSED)
def test_what_makes_no_sense_is_refused(message, call):
    with pytest.raises(ValueError, match=message):
        call()


WITHOUT = [
    ("series that moves", lambda: wolf_lyapunov(np.ones(5000), 1.0)),
    ("200 samples", lambda: wolf_lyapunov(normal(0, 150), 1.0)),
    ("mean periods", lambda: wolf_lyapunov(np.sin(0.01 * TIME), 1.0)),
    ("mean periods", lambda: wolf_lyapunov(HALF_A_TURN, 1.0)),
    ("too short", lambda: rosenstein_lyapunov(HALF_A_TURN, 1.0)),
    ("noise", lambda: wolf_lyapunov(normal(0, 5000), 1.0)),
    ("no neighbours", lambda: wolf_lyapunov(np.tile([0.0, 1.0, 3.0, 2.0], 500), 1.0)),
    ("straight", lambda: rosenstein_lyapunov(two_tone(5000), 0.1)),
    ("straight|only", lambda: rosenstein_lyapunov(np.sin(0.1 * TIME), 0.1)),
    ("straight", lambda: rosenstein_lyapunov(normal(0, 5000), 0.1)),
    ("series that moves", lambda: rosenstein_lyapunov(np.ones(5000), 0.1)),
    ("32 periods", lambda: tangent_lyapunov(ZEROS[:40], transient_periods=9)[0]),
    ("too short", lambda: section_lyapunov(henon(20))[0]),
    ("no motion", lambda: section_lyapunov(np.ones(300))[0]),
    ("no motion", lambda: zero_one_test(np.zeros(500))),
    ("too short", lambda: zero_one_test(TIME[:99])),
    ("oversampled", lambda: zero_one_test(record("two_tone", 4000)[0])),
    ("no motion", lambda: correlation_dimension(np.zeros((500, 2)))),
    ("too short", lambda: correlation_dimension(np.ones((299, 2)))),
    ("no scaling region|too few points", lambda: correlation_dimension(normal(0, 3000, 6))),
    ("no scaling region|too few points", lambda: correlation_dimension(normal(0, 3000, 10))),
    ("too short", lambda: section_distance(PAIRS[:39], PAIRS)),
]


@pytest.mark.parametrize(("why", "call"), WITHOUT)
def test_where_there_is_no_answer_it_is_nan_with_the_reason(why, call):
    answer = call()
    value, error = list(vars(answer).values())[:2]
    assert np.isnan(value) and (isinstance(error, str) or np.isnan(error))
    assert any(word in answer.reason for word in why.split("|"))
