"""A sea from a measured elevation: the file of `waves.record` becomes `waves.components`, which the scene then keeps.

The record eta(t) at the gauge x_g is periodic in its own length T. Its discrete Fourier transform gives
eta = sum A_n cos(omega_n t + a_n), omega_n = 2 pi n/T. Linear waves along +x that are this at the gauge have the phase

    k_n (x - x_g) - omega_n t + phase_n,   phase_n = -a_n

(the sign of a_n turns, because the waves go with -omega t). Kept are frequencies from BAND[0] to BAND[1] times that of
waves.period_s: what is slower is tide and drift of the gauge, what is faster is noise, which the laws of linear waves
would make large above still water. The sea repeats the record after its end.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from engine.scene.faults import SceneError, fault, shown
from engine.scene.values import MOST_COMPONENTS

if TYPE_CHECKING:
    import numpy as np

COLUMNS = "time_s", "elevation_m"
BAND = 0.25, 4.0  # frequencies that are kept, over the one of waves.period_s
SHORTEST, COARSEST = 20, 8  # periods in a record, at least; samples in a period, at least
EVEN = 1e-3  # unevenness of the steps, over the step
TREND, OUTSIDE = 0.1, 0.1  # share of the standard deviation between the ends, share of the variance outside the band
HIGHEST = 100.0  # m, beyond which an elevation is not in metres
KEY = "waves.record"


def with_measured_sea(raw: dict[str, object], folder: Path) -> tuple[dict[str, object], list[str]]:
    """The raw scene with waves.components from waves.record, if it has one, and faults of the record.

    A scene that has both was loaded before; its components are kept. The path of the record begins in the folder.
    """
    waves = raw.get("waves")
    if not isinstance(waves, dict) or not isinstance(waves.get("record"), str) or waves.get("components"):
        return raw, []
    period_s = waves.get("period_s")
    if not isinstance(period_s, (int, float)) or not 0 < period_s < math.inf:
        return raw, []  # this fault is told by itself
    path = str(folder / waves["record"])
    try:
        values = _read(path)
    except SceneError as error:
        return raw, list(error.faults)
    if faults := list(_unfit(path, *values, period_s)):
        return raw, faults
    return raw | {"waves": waves | {"components": _components(*values, period_s)}}, []


def _read(path: str) -> list[np.ndarray]:
    """Times (s) and elevations (m). Raises SceneError."""
    import numpy as np  # 0.1 s, which a scene without a record does not need

    allowed = "a CSV file with the columns time_s and elevation_m"
    try:
        with Path(path).open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file)
            rows, heads = list(reader), reader.fieldnames or ()
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or "not readable as text"
        raise SceneError(fault(KEY, path, f"{allowed} ({reason})")) from None
    if any(name not in heads for name in COLUMNS):
        raise SceneError(fault(KEY, path, f"{allowed}: the first line is {shown(','.join(heads))}"))
    if not rows:
        raise SceneError(fault(KEY, path, f"{allowed}, and at least one row of numbers"))
    columns = []
    for name in COLUMNS:
        numbers = []
        for line, row in enumerate(rows, start=2):
            try:
                number = float(row[name])
            except (TypeError, ValueError):
                number = math.nan
            if not math.isfinite(number):
                raise SceneError(fault(KEY, path, f"finite numbers: {name} in line {line} is {row[name]!r}"))
            numbers.append(number)
        columns.append(np.array(numbers))
    return columns


def _unfit(path: str, time_s: np.ndarray, elevation_m: np.ndarray, period_s: float) -> Iterator[str]:
    """Why this record cannot be made a sea."""
    import numpy as np

    steps = np.diff(time_s)
    if len(time_s) < 4 or steps.min() <= 0:
        yield fault(KEY, path, "at least four rows, time_s increasing")
        return
    step = float(np.median(steps))
    if np.abs(steps - step).max() > EVEN * step:
        gap = int(np.argmax(np.abs(steps - step)))
        between = f"from {time_s[gap]:.6g} to {time_s[gap + 1]:.6g} s is a gap or an uneven step (interpolate it)"
        yield fault(KEY, path, f"even steps of {step:.6g} s: {between}")
        return
    length_s = step * len(time_s)
    short, coarse = length_s < SHORTEST * period_s, step > period_s / COARSEST
    if short:
        rule = f"at least {SHORTEST} periods of waves.period_s = {period_s:g} s: it has {length_s:.4g} s"
        yield fault(KEY, path, rule)
    if coarse:
        longest_s = period_s / COARSEST
        yield fault(KEY, path, f"steps of at most {longest_s:.4g} s, an eighth of waves.period_s (ms, not s?)")
    spread = float(elevation_m.std())
    if spread == 0.0:
        yield fault(KEY, path, "an elevation that is not constant")
        return
    if np.abs(elevation_m - elevation_m.mean()).max() > HIGHEST:
        yield fault(KEY, path, f"elevations in metres, within {HIGHEST:g} m of their mean (mm or cm?)")
    slope = np.polyfit(time_s - time_s.mean(), elevation_m, 1)[0]
    if abs(slope) * length_s > max(TREND, 10.0 / math.sqrt(length_s / period_s)) * spread:
        yield fault(KEY, path, f"no trend: it changes by {slope * length_s:.3g} m from end to end (tide? remove it)")
        return
    if short or coarse:
        return
    frequencies, amplitudes, _ = _lines(time_s, elevation_m)
    kept = _kept(frequencies, period_s)
    outside = 1.0 - np.sum(amplitudes[kept] ** 2) / np.sum(amplitudes**2)
    if outside > OUTSIDE:
        share = f"{100 * outside:.0f} % of its energy lies outside {BAND[0]:g} to {BAND[1]:g} times this frequency"
        yield fault("waves.period_s", period_s, f"the peak period of waves.record: {share}")
    if kept.sum() > MOST_COMPONENTS:
        longest_s = length_s * MOST_COMPONENTS / kept.sum()
        yield fault(KEY, path, f"at most {longest_s:.4g} s, of which {MOST_COMPONENTS} waves can be made")


def _lines(time_s, elevation_m):
    """Frequencies (1/s), amplitudes (m) and angles (rad) of the record less its mean, for t in its own clock."""
    import numpy as np

    count, step = len(time_s), (time_s[-1] - time_s[0]) / (len(time_s) - 1)
    lines = np.fft.rfft(elevation_m - elevation_m.mean()) * 2.0 / count
    frequencies = np.arange(len(lines)) / (count * step)
    return frequencies, np.abs(lines), np.angle(lines) - 2.0 * np.pi * frequencies * time_s[0]


def _kept(frequencies, period_s):
    return (frequencies * period_s >= BAND[0]) & (frequencies * period_s <= BAND[1])


def _components(time_s, elevation_m, period_s):
    frequencies, amplitudes, angles = _lines(time_s, elevation_m)
    kept = _kept(frequencies, period_s)
    components = []
    for frequency, amplitude, angle in zip(frequencies[kept], amplitudes[kept], angles[kept], strict=True):
        phase = math.remainder(-angle, 2.0 * math.pi)
        components.append({"period_s": 1.0 / frequency, "amplitude_m": float(amplitude), "phase_rad": phase})
    return components
