"""Measures of any evenly sampled time series: plain arrays and a sampling step in, frozen records out.

Nothing here knows the cable, so the same functions serve the tethered buoy, eq. (33) and measured data. Time 0 is the
first sample of a record. Names are imported on first use: `import analysis` costs nothing.
"""

import machine_code  # noqa: F401, I001  first: an older Python does not get through lazy_loader
import lazy_loader

# No module may bear the name of a function: importing it would hide the function.
__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "approaches": ["approach_evidence", "approached_period"],
        "correlation_sums": ["CorrelationDimension", "correlation_dimension"],
        "divergence": ["rosenstein_lyapunov"],
        "embedding": ["choose_delay", "choose_embedding", "delay_vectors", "mutual_information"],
        "evidence": ["Evidence", "evidence_text", "read_evidence"],
        "exponents": ["Exponent"],
        "extreme_values": ["Extremes", "SlackFraction", "block_maxima", "extremes", "peaks", "slack_fraction"],
        "fatigue": ["damage_equivalent_load", "rainflow_cycles", "turning_points", "utilisation"],
        "growth": ["Growth", "envelope_of", "growth_or_bursts"],
        "line_spectra": ["LineSpectrum", "spectral_lines"],
        "looks": ["growth_contradicts", "motion_regime", "next_look"],
        "memory": ["long_memory"],
        "motions": ["Settled", "Share", "distance", "grouped", "joins", "matched", "remains", "settled", "share_of"],
        "neighbours": ["NeighbourGrowth", "neighbour_growth"],
        "orbit_diagrams": ["DensityImage", "OrbitDiagram", "density_image", "orbit_diagram", "scale_density"],
        "periods": ["PeriodEstimate", "detect_period"],
        "poincare": ["PoincareSection", "poincare_section", "section_at_phases"],
        "seas": [
            "Residence", "Responses", "growing_share", "residence", "responses", "sea_lyapunov",
            "slow_forecast", "spells_of",
        ],
        "section_distances": ["SectionDistance", "section_distance"],
        "section_maps": ["PredictionGain", "prediction_gain", "section_lyapunov"],
        "snaps": ["Snaps", "detect_snaps", "running_mean"],
        "spectra": ["SpectralPeak", "Spectrum", "peaks_near", "spectral_peaks", "spectrum"],
        "stationarity": ["Drift", "record_drift"],
        "storm_maxima": ["StormMaximum", "storm_maximum"],
        "surrogates": [
            "NullRank", "iaaft_surrogates", "noisy_periodic_surrogates", "normal_scores", "rank_among",
        ],
        "tangent_growth": ["tangent_lyapunov", "transverse_lyapunov"],
        "verdicts": ["Verdict", "regime"],
        "wolf_pairs": ["wolf_run"],
        "wolf_plateau": ["wolf_lyapunov"],
        "zero_one": ["ZeroOneTest", "zero_one_test"],
    },
)  # fmt: skip
