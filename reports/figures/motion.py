"""What figures of a motion share: panels of spectra, long histories as envelopes."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from .curves import Curve, Panel

_BINS = 900  # columns of the whole-record view: about two a printed millimetre


def spectrum_panels(
    lines: Sequence[Curve], highest_radps: float, labels: tuple[str, str], marks: Sequence[tuple[float, str]]
) -> list[Panel]:
    """Amplitudes over omega up to highest_radps, linear with named marks, and logarithmic; labels: of x and y."""
    shown = lines[0].x <= highest_radps
    lines = [line._replace(x=line.x[shown], y=line.y[shown]) for line in lines]
    everything = np.concatenate([line.y for line in lines])
    limits = {"xlim": (0.0, highest_radps), "ylim": (0.0, 1.32 * max(float(everything.max()), 1e-12))}
    decades = limits | {"ylim": log_limits(everything)}
    nameless = [(at, "") for at, _ in marks]
    linear = Panel(lines, *labels, settings=limits, marks=marks)
    return [linear, Panel(lines, labels[0], log="y", settings=decades, marks=nameless)]


def log_limits(amplitude: np.ndarray) -> tuple[float | None, float | None]:
    """Four decades at most below the peak; a spectrum of zeros keeps matplotlib's own limits."""
    peak = float(amplitude.max())
    if peak <= 0:
        return None, None
    least = float(amplitude[amplitude > 0].min())
    return max(peak * 1e-4, least * 0.5), peak * 3


def settled(series: Sequence[np.ndarray]) -> tuple[float, float]:
    """Limits that show 0 and what the curves (m,) do after their first tenth, in which they jump about."""
    late = np.concatenate([bits[len(bits) // 10 :] for bits in series] + [np.zeros(1)])
    margin = 0.15 * max(float(np.ptp(late)), 0.02)
    return float(late.min()) - margin, float(late.max()) + margin


def envelope(x: np.ndarray, y: np.ndarray, bins: int = _BINS) -> tuple[np.ndarray, np.ndarray]:
    """A line through the least and greatest y of each of `bins` equal spans: looks like the full line at that width.

    Args: x (n,) increasing, y (n,). Returns x, y of at most 2*bins points; a shorter record comes back as it is.
    Every extreme of y is kept, which simple thinning would lose.
    """
    if len(y) <= 2 * bins:
        return x, y
    indices = set()
    for first, end in pairwise(np.linspace(0, len(y), bins + 1).astype(int)):
        part = y[first:end]
        if np.isfinite(part).any():
            indices.update((first + int(np.nanargmin(part)), first + int(np.nanargmax(part))))
    index = sorted(indices)
    return x[index], y[index]
