"""Snaps against a body that bounces on a spring (closed form), and records made by hand with known counts."""

import numpy as np
import pytest

from analysis import detect_snaps, running_mean

STATIC_N, STIFFNESS_NPM, MASS_KG, SPEED_MPS = 2000.0, 2500.0, 2500.0, 3.0
RADPS = np.sqrt(STIFFNESS_NPM / MASS_KG)
IMPACT_NSPM = np.sqrt(STIFFNESS_NPM * MASS_KG)
RISE_S = (np.pi - np.arctan2(SPEED_MPS * IMPACT_NSPM, STATIC_N)) / RADPS
FLIGHT_S = 2.0 * SPEED_MPS * MASS_KG / STATIC_N
ROUND_S = FLIGHT_S + 2.0 * RISE_S
PEAK_N = STATIC_N + np.hypot(STATIC_N, SPEED_MPS * IMPACT_NSPM)


def bouncing(time_s):
    """Tension and speed of a body that a force T_s drives against a one-sided spring: m x'' = T_s - max(k x, 0).

    Taut at t = 0 with the given speed; the spring stops it and throws it back with the same speed, for ever.
    """
    turn_s = np.mod(time_s, ROUND_S)
    sine, cosine = np.sin(RADPS * turn_s), np.cos(RADPS * turn_s)
    pulling = turn_s < 2.0 * RISE_S
    tension_N = STATIC_N * (1.0 - cosine) + SPEED_MPS * IMPACT_NSPM * sine
    taut_mps = STATIC_N / IMPACT_NSPM * sine + SPEED_MPS * cosine
    loose_mps = -SPEED_MPS + STATIC_N / MASS_KG * (turn_s - 2.0 * RISE_S)
    return np.where(pulling, tension_N, 0.0), np.where(pulling, taut_mps, loose_mps)


@pytest.mark.parametrize("step_s", [0.05, 0.01, 0.002])
def test_a_bouncing_body_has_the_times_speeds_and_peaks_of_the_closed_form(step_s):
    time_s = step_s * np.arange(round(20.3 * ROUND_S / step_s))
    tension_N, rate_mps = bouncing(time_s + 1.0)
    detected = detect_snaps(tension_N, step_s, STATIC_N, rate_mps=rate_mps, impact_Nspm=IMPACT_NSPM)
    count = 20
    assert len(detected) == count
    # 5 % of the static tension is passed a little after the spring is met: x = 0.05 T_s/k at nearly the same speed
    late_s = 0.05 * STATIC_N / STIFFNESS_NPM / SPEED_MPS
    begins_s = ROUND_S * np.arange(1, count + 1) - 1.0
    np.testing.assert_allclose(detected.taut_s, begins_s + late_s, atol=0.6 * step_s + 1e-4)
    np.testing.assert_allclose(detected.onset_s, begins_s - FLIGHT_S - late_s, atol=0.6 * step_s + 1e-4)
    np.testing.assert_allclose(detected.duration_s, FLIGHT_S + 2.0 * late_s, atol=1.2 * step_s + 2e-4)
    np.testing.assert_allclose(detected.taut_speed_mps, SPEED_MPS, rtol=0.01)
    np.testing.assert_allclose(detected.peak_N, PEAK_N, rtol=0.125 * (RADPS * step_s) ** 2 + 1e-9)
    np.testing.assert_allclose(detected.peak_s, begins_s + RISE_S, atol=0.51 * step_s)
    np.testing.assert_allclose(detected.rise_s, detected.peak_s - detected.taut_s)
    np.testing.assert_allclose(detected.peak_over_static, PEAK_N / STATIC_N, rtol=1e-3)
    np.testing.assert_allclose(detected.peak_over_impact, PEAK_N / (SPEED_MPS * IMPACT_NSPM), rtol=0.01)


STEP_S, LENGTH_S, RINGING_S = 0.001, 30.0, 0.054


def pulls(*pulses, base=0.0, ramp=0.0):
    """A record of half sines (begin, length, height over the static tension) on a base, which may rise or fall."""
    time_s = STEP_S * np.arange(round(LENGTH_S / STEP_S) + 1)
    tension = base + ramp * time_s
    for begin_s, length_s, height in pulses:
        inside = (time_s >= begin_s) & (time_s <= begin_s + length_s)
        tension += np.where(inside, height * np.sin(np.pi * (time_s - begin_s) / length_s), 0.0)
    return STATIC_N * tension


def square(*taut):
    """A record that is twice the static tension within the given times, and else 0."""
    time_s = STEP_S * np.arange(round(LENGTH_S / STEP_S) + 1)
    inside = np.any([(time_s >= begin) & (time_s <= end) for begin, end in taut], axis=0)
    return np.where(inside, 2.0 * STATIC_N, 0.0)


BY_HAND = {  # name: record, number of its snaps
    "never slack": (pulls((3.0, 1.0, 4.0), (9.0, 1.0, 4.0), base=1.0), 0),
    "never taut": (pulls(), 0),
    "one snap": (pulls((5.0, 1.5, 4.0)), 1),
    "five, all alike": (pulls(*((2.0 + 5.0 * k, 1.5, 4.0) for k in range(5))), 5),
    "a weak pull does not count": (pulls((2.0, 1.5, 4.0), (8.0, 2.0, 0.7), (15.0, 1.5, 3.0)), 2),
    "a twitch before the snap does not split its slack": (pulls((8.0, 0.2, 0.5), (9.0, 1.5, 4.0)), 1),
    "two pulls without slack between are one": (pulls((4.0, 6.0, 2.0), (5.0, 1.0, 1.5), (8.0, 1.0, 1.5)), 1),
    "taut at the start, slack at the end": (square((0.0, 2.0), (6.0, 7.0), (11.0, 12.5)), 2),
    "slack at the start, taut at the end": (square((4.0, 9.0), (21.0, 30.0)), 2),
    "short and hard, twice in a second": (pulls((9.0, 0.15, 9.0), (9.6, 0.15, 9.0), (20.0, 0.15, 9.0)), 3),
}


@pytest.mark.parametrize(("tension_N", "count"), BY_HAND.values(), ids=BY_HAND)
def test_records_made_by_hand_have_their_count(tension_N, count):
    assert len(detect_snaps(tension_N, STEP_S, STATIC_N)) == count
    assert len(detect_snaps(tension_N, STEP_S, STATIC_N, RINGING_S)) == count


def ringing(tension_N, share, hertz, decay_s):
    """What a blow at each sudden rise and fall of a record leaves on the line: a decaying oscillation."""
    begins = np.flatnonzero((tension_N[1:] > 0.0) != (tension_N[:-1] > 0.0))
    added, time_s = np.zeros(len(tension_N)), STEP_S * np.arange(len(tension_N))
    for begin in begins:
        since_s = time_s[begin:] - time_s[begin]
        added[begin:] += share * STATIC_N * np.sin(2.0 * np.pi * hertz * since_s) * np.exp(-since_s / decay_s)
    return tension_N + added


@pytest.mark.parametrize(("hertz", "share"), [(1.0 / RINGING_S, 1.5), (2.0 / RINGING_S, 1.5), (40.0, 1.5), (25.0, 0.9)])
@pytest.mark.parametrize(("tension_N", "count"), BY_HAND.values(), ids=BY_HAND)
def test_ringing_does_not_count_twice(tension_N, count, hertz, share):
    """Its tension falls below zero and rises above the static one again and again: without a filter it counts."""
    alone = detect_snaps(tension_N, STEP_S, STATIC_N, RINGING_S)
    rung = detect_snaps(ringing(tension_N, share, hertz, 0.3), STEP_S, STATIC_N, RINGING_S)
    assert len(rung) == count
    np.testing.assert_allclose(rung.taut_s, alone.taut_s, atol=2.0 * RINGING_S)


def test_noise_about_the_static_tension_does_not_end_a_pull_before_its_peak():
    """White noise of a twentieth of the static tension; each pull passes it in some ten samples."""
    tension_N, count = BY_HAND["five, all alike"]
    noise_N = 0.05 * STATIC_N * np.random.default_rng(0).normal(size=len(tension_N))
    detected = detect_snaps(tension_N + noise_N, STEP_S, STATIC_N)
    np.testing.assert_allclose(detected.peak_N, np.full(count, tension_N.max()), atol=0.2 * STATIC_N)


def test_ringing_counts_without_the_filter():
    tension_N, count = BY_HAND["taut at the start, slack at the end"]
    assert len(detect_snaps(ringing(tension_N, 1.5, 40.0, 0.3), STEP_S, STATIC_N)) > 2 * count


def test_times_and_counts_know_no_unit_and_no_zero_of_time():
    tension_N = BY_HAND["five, all alike"][0]
    first, scaled = detect_snaps(tension_N, 0.001, STATIC_N), detect_snaps(7.0 * tension_N, 0.001, 7.0 * STATIC_N)
    np.testing.assert_allclose(scaled.taut_s, first.taut_s)
    np.testing.assert_allclose(scaled.peak_N, 7.0 * first.peak_N)
    slower = detect_snaps(tension_N, 0.004, STATIC_N)
    np.testing.assert_allclose(slower.duration_s, 4.0 * first.duration_s)
    later = detect_snaps(np.append(np.zeros(500), tension_N), 0.001, STATIC_N)
    np.testing.assert_allclose(later.taut_s, first.taut_s + 0.5)


def test_a_slack_interval_that_began_before_the_record_has_no_onset_and_one_that_does_not_end_is_none():
    detected = detect_snaps(square((4.0, 9.0), (21.0, 22.0)), STEP_S, STATIC_N)
    assert np.isnan(detected.onset_s).tolist() == [True, False] == np.isnan(detected.duration_s).tolist()


def test_a_pull_in_which_the_record_ends_counts_up_to_its_last_sample():
    assert list(detect_snaps([0.0, 0.0, 0.0, 3e3, 4e3], STEP_S, STATIC_N).peak_N) == [4e3]


def test_thresholds_are_options():
    tension_N, _ = BY_HAND["a weak pull does not count"]
    counts = [len(detect_snaps(tension_N, STEP_S, STATIC_N, snap_share=share)) for share in (0.06, 1.0, 3.5, 4.5)]
    assert counts == [3, 2, 1, 0]
    assert len(detect_snaps(tension_N + 0.2 * STATIC_N, STEP_S, STATIC_N)) == 0
    assert len(detect_snaps(tension_N + 0.2 * STATIC_N, STEP_S, STATIC_N, slack_share=0.3)) == 2


def test_a_transient_leaves_out_the_snaps_that_count_before_it():
    tension_N = BY_HAND["five, all alike"][0]
    whole = detect_snaps(tension_N, STEP_S, STATIC_N)
    later = detect_snaps(tension_N, STEP_S, STATIC_N, transient_s=whole.taut_s[2] - 1.0)
    np.testing.assert_array_equal(later.onset_s, whole.onset_s[2:])
    assert later.watched_s == pytest.approx(LENGTH_S - whole.taut_s[2] + 1.0)


def test_the_peak_between_samples_counts_where_it_is_known():
    tension_N = BY_HAND["one snap"][0]
    tension_N = tension_N[20:-30]
    coarse, high_N = tension_N[::50], np.append(tension_N[0], tension_N[1:].reshape(-1, 50).max(axis=1))
    detected = detect_snaps(coarse, 50 * STEP_S, STATIC_N, high_N=high_N)
    assert detected.peak_N[0] == tension_N.max() > coarse.max()


def test_the_table_has_a_row_a_snap_and_units():
    table = detect_snaps(BY_HAND["five, all alike"][0], STEP_S, STATIC_N).table()
    assert len(table) == 5 and set(table.attrs["units"]) == set(table.columns)
    assert table.attrs["slack_N"] == 0.05 * STATIC_N and table.attrs["snap_N"] == STATIC_N


def test_a_running_mean_over_a_period_or_several_removes_an_oscillation_and_keeps_a_line():
    time_s = 0.01 * np.arange(500)
    wave = np.sin(2.0 * np.pi * time_s / 0.4)
    mean = running_mean(3.0 + 2.0 * time_s + wave, 0.01, 0.4)[30:-30]
    np.testing.assert_allclose(mean, (3.0 + 2.0 * time_s)[30:-30], atol=1e-12)
    np.testing.assert_array_equal(running_mean(wave, 0.01, 0.0), wave)


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"static_N": 0.0}, "static_N"),
        ({"ringing_s": -1.0}, "ringing_s"),
        ({"slack_share": -0.1}, "slack_share"),
        ({"snap_share": 0.05}, "snap_share"),
        ({"snap_share": np.nan}, "snap_share"),
        ({"rate_mps": [1.0]}, "rate_mps"),
        ({"high_N": [1.0]}, "high_N"),
        ({"impact_Nspm": 0.0}, "impact_Nspm"),
    ],
)
def test_a_threshold_without_meaning_is_refused_by_its_name(options, named):
    with pytest.raises(ValueError, match=named):
        detect_snaps(np.zeros(10), 0.1, **{"static_N": 1.0, **options})
