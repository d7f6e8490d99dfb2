"""Measures of any evenly sampled time series: plain arrays and a sampling step in, frozen records out.

Nothing here knows the cable, so the same functions serve the tethered buoy, eq. (33) and measured data. Time 0 is the
first sample of a record. Names are imported on first use: `import analysis` costs nothing.
"""

import sys

if sys.version_info < (3, 11):  # noqa: UP036
    running = ".".join(map(str, sys.version_info[:3]))
    raise ImportError(
        f"the tether workbench needs Python 3.11 or newer, and this is {running} ({sys.executable}); "
        "make its environment with a newer one, for instance python3.12 -m venv .venv"
    )

from analysis.on_first_use import on_first_use  # not above: an older Python does not get through it

_HOME = {
    "Spectrum": "spectra",
    "SpectralPeak": "spectra",
    "spectrum": "spectra",
    "spectral_peaks": "spectra",
    "peaks_near": "spectra",
    "PoincareSection": "poincare",
    "poincare_section": "poincare",
    "OrbitDiagram": "orbit_diagrams",
    "DensityImage": "orbit_diagrams",
    "orbit_diagram": "orbit_diagrams",
    "density_image": "orbit_diagrams",
    "scale_density": "orbit_diagrams",
    "PeriodEstimate": "periods",
    "detect_period": "periods",
    "SlackFraction": "levels",
    "Extremes": "levels",
    "slack_fraction": "levels",
    "extremes": "levels",
    "ZeroOneTest": "zero_one",
    "zero_one_test": "zero_one",
    "CorrelationDimension": "correlation_sums",
    "correlation_dimension": "correlation_sums",
    "LineSpectrum": "line_spectra",
    "spectral_lines": "line_spectra",
    "NullRank": "surrogates",
    "iaaft_surrogates": "surrogates",
    "noisy_periodic_surrogates": "surrogates",
    "normal_scores": "surrogates",
    "rank_among": "surrogates",
    "PredictionGain": "predictability",
    "prediction_gain": "predictability",
    "NeighbourGrowth": "neighbour_distances",
    "neighbour_growth": "neighbour_distances",
    "Drift": "drifts",
    "record_drift": "drifts",
    "Exponent": "exponents",
    "wolf_lyapunov": "wolf_plateau",
    "tangent_lyapunov": "tangent_growth",
    "transverse_lyapunov": "tangent_growth",
    "wolf_run": "wolf_pairs",
    "rosenstein_lyapunov": "divergence",
    "kantz_lyapunov": "divergence",
    "choose_delay": "embedding_delay",
    "delay_vectors": "embedding_delay",
    "mutual_information": "embedding_delay",
    "choose_embedding": "embedding_dimension",
    "Evidence": "evidence",
    "evidence_text": "evidence",
    "read_evidence": "evidence",
    "Growth": "growth",
    "growth_or_bursts": "growth",
    "envelope_of": "growth",
    "SectionDistance": "section_distances",
    "section_distance": "section_distances",
    "Verdict": "verdicts",
    "regime": "verdicts",
}

__all__ = [*_HOME]
__getattr__, __dir__ = on_first_use(__name__, _HOME)
