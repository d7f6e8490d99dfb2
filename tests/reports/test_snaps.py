"""The figures of snaps: how often a peak is exceeded, as counted; histories of coexisting motions on one scale."""

import numpy as np

from reports.buoy_sweep.snaps import SnappingMotion, exceedance, larger_a_wave, tension_histories
from tests.reports.test_words_apart import crowded


def test_the_stair_is_at_every_tension_the_count_of_larger_peaks():
    peaks = np.random.default_rng(3).gamma(4.0, size=50)
    tension, often = larger_a_wave(peaks, 25.0)
    for at in (0.01, 1.3, 3.7, 5.0):
        stair = often[np.searchsorted(-tension, -at) - 1] if at < peaks.max() else 0.0
        assert stair == (peaks > at).sum() / 25.0


def test_words_of_the_figures_are_apart(drawn):
    times = np.linspace(-12.0, 0.0, 1201)
    motions = [
        SnappingMotion(letter, f"motion {letter}, period-{number}, 0.5 snaps a wave", colour, times, 0.0 * times,
                       number * np.abs(np.sin(times)), np.full(6, 1.0 * number), 12.0)
        for letter, number, colour in (("A", 2, "C0"), ("B", 1, "C1"), ("C", 8, "C2"))
    ]  # fmt: skip
    exceedance(motions)
    tension_histories(motions, 2.0)
    assert len(drawn) == 2 and not any(map(crowded, drawn))
