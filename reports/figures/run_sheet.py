"""One run at a glance, as a small <svg> element: histories, section, spectrum, exponent in nine panels.

A sweep may have hundreds of runs, each with such a drawing inside one page: files of matplotlib would be too large for
that, and written here a sheet takes 10 to 14 kB. Coordinates are whole numbers, fifths of a pixel apart; colours come
from the page's style sheet, so that the drawing follows its light and dark form.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from html import escape

import numpy as np

from ..parts.content import spans, sub
from ..parts.symbols import T_I

_FINE = 5  # units of a path to a pixel
_DROP = 3  # pixels from a letter to its subscript
_ROWS, _HEIGHT, _PITCH, _TOP = 3, 84, 128, 20
_COLUMNS = ((46, 320), (392, 200), (672, 276))  # left edge and width of the whole record, its end, the rest
_WIDE, _TALL = 960, _TOP + _ROWS * _PITCH - 6


@dataclass(frozen=True, eq=False)
class Glance:
    """What the drawing shows; histories over `periods` (n,) t/T_i as (label with unit, low (n,), high (n,)).

    `end_from`: where the last periods begin that are drawn larger; `section`: (m, 2) in m and m/s; `spectrum`: omega
    (k,) in rad/s and amplitude (k,) in m, `marks` the expected modes in rad/s with their names; `exponent`: t/T_i (j,)
    and bits per period (j,) found so far.  Empty arrays where there is nothing.
    """

    periods: np.ndarray
    histories: tuple[tuple[str, np.ndarray, np.ndarray], ...]
    end_from: float
    section: np.ndarray
    spectrum: tuple[np.ndarray, np.ndarray]
    marks: tuple[tuple[float, str], ...]
    exponent: tuple[np.ndarray, np.ndarray]


def run_sheet(glance: Glance, label: str, bins: int) -> str:
    """The drawing, `label` its text alternative; bins: columns of the whole record, fewer make it smaller."""
    parts = []
    for row, (name, low, high) in enumerate(glance.histories):
        limits = _limits(low, high)
        last = row == len(glance.histories) - 1
        for column, first in enumerate((glance.periods[0], glance.end_from)):
            part = glance.periods >= first
            t = glance.periods[part]
            frame = _Frame(column, row, (float(t[0]), float(t[-1])), limits)
            parts.append(frame.axes(name if column == 0 else "", f"t/{T_I}" if last else "", y_numbers=column == 0))
            parts.append(frame.band(t, low[part], high[part], bins if column == 0 else bins // 2))
    parts += [_section(glance.section), _spectrum(*glance.spectrum, glance.marks), _exponent(*glance.exponent)]
    head = f'<svg class="glance" viewBox="0 0 {_WIDE} {_TALL}" role="img" aria-label="{escape(label)}">'
    return "".join([head, *parts, "</svg>"])


def _section(points: np.ndarray) -> str:
    if not len(points):
        return _nothing(0, "no section: no time after the transient")
    r, rate = points.T
    # no narrower than 0.1 m and 0.1 m/s: a settled orbit looks like the points it is
    frame = _Frame(2, 0, _limits(r, r, 0.1), _limits(rate, rate, 0.1))
    return frame.axes("section: dr/dt (m/s) over r (m)", "") + frame.dots(r, rate)


def _spectrum(omega: np.ndarray, amplitude: np.ndarray, marks) -> str:
    shown = amplitude > 0.0
    if not shown.any():
        return _nothing(1, "no spectrum: the record is too short")
    omega, decades = omega[shown], np.log10(amplitude[shown])
    top = math.ceil(float(decades.max()))
    frame = _Frame(2, 1, (0.0, float(omega[-1])), (top - 4, top))
    lines = "".join(frame.mark(at, name) for at, name in marks if at < omega[-1])
    return (
        frame.axes(f"spectrum: log{sub('10')} of |Δr̃| (m) over ω (rad/s)", "")
        + lines
        + frame.line(omega, np.maximum(decades, top - 4))
    )


def _exponent(periods: np.ndarray, bits: np.ndarray) -> str:
    if len(bits) < 2:  # a run may end with its transient, or one period after it
        return _nothing(2, "no exponent after the transient")
    settled = bits[len(bits) // 10 :]
    low, high = _limits(np.minimum(settled, 0.0), np.maximum(settled, 0.0), 0.02)
    frame = _Frame(2, 2, (float(periods[0]), float(periods[-1])), (low, high))
    zero = frame.line(periods[[0, -1]], np.zeros(2), "zero")
    text = frame.axes(f"exponent so far: σ (bits per {T_I}) over t/{T_I}", "")
    return text + zero + frame.line(periods, np.clip(bits, low, high))


def _nothing(row: int, words: str) -> str:
    left, _ = _COLUMNS[2]
    return _text(left, _TOP + row * _PITCH + 40, words)


def _text(x: int, y: int, words: str, anchor: str = "") -> str:
    """Words with the subscripts of `sub`: letters of Unicode's own are too small to read here."""
    kind = f' class="{anchor}"' if anchor else ""
    down = f'<tspan dy="{_DROP}" class="s">%s</tspan>'
    parts, lowered = [], False
    for style, piece in spans(words):
        said = escape(piece)
        if style == "sub":
            parts.append(down % said)
        elif lowered:
            parts.append(f'<tspan dy="-{_DROP}">{said}</tspan>')
        else:
            parts.append(said)
        lowered = style == "sub"
    return f'<text{kind} x="{x}" y="{y}">{"".join(parts)}</text>'


def _limits(low: np.ndarray, high: np.ndarray, least: float = 1e-9) -> tuple[float, float]:
    """Range of the finite values, widened by a tenth on both sides and to `least` at the least."""
    bottom, top = (
        (float(np.nanmin(low)), float(np.nanmax(high)))
        if np.isfinite(low).any() and np.isfinite(high).any()
        else (0, 0)
    )
    middle, half = 0.5 * (top + bottom), max(0.6 * (top - bottom), 0.5 * least, 1e-9 * abs(top))
    return middle - half, middle + half


class _Frame:
    """One panel: where it stands on the sheet, and which numbers its edges are."""

    def __init__(self, column: int, row: int, x: tuple[float, float], y: tuple[float, float]):
        self.left, self.wide = _COLUMNS[column]
        self.top = _TOP + row * _PITCH
        self.x, self.y = x, y

    def axes(self, title: str, x_title: str, y_numbers: bool = True) -> str:
        """Edges, numbers at round places, and the title above."""
        low = self.top + _HEIGHT
        parts = [f'<path class="axes" d="M{self.left} {self.top}v{_HEIGHT}h{self.wide}"/>']
        if title:
            parts.append(_text(self.left, self.top - 6, title))
        if x_title:
            parts.append(_text(self.left + self.wide // 2, low + 28, x_title, "m"))
        for value, said in _ticks(*self.x, 5):
            at = self.left + round((value - self.x[0]) / (self.x[1] - self.x[0]) * self.wide)
            parts.append(_text(at, low + 14, said, "m"))
        for value, said in _ticks(*self.y, 3) if y_numbers else ():
            at = low - round((value - self.y[0]) / (self.y[1] - self.y[0]) * _HEIGHT)
            parts.append(_text(self.left - 4, at + 4, said, "e"))
        return "".join(parts)

    def line(self, x: np.ndarray, y: np.ndarray, kind: str = "line") -> str:
        """A polyline through the points that are finite."""
        sound = np.isfinite(y)
        return self._path(kind, _relative(self._fine(x[sound], y[sound]))) if sound.any() else ""

    def dots(self, x: np.ndarray, y: np.ndarray) -> str:
        """Round dots: strokes of no length."""
        places = dict.fromkeys(map(tuple, self._fine(x, y).tolist()))
        return self._path("dots", "".join(f"M{i} {j}h0" for i, j in places))

    def band(self, x: np.ndarray, low: np.ndarray, high: np.ndarray, bins: int) -> str:
        """The area between the least and the greatest value of each of `bins` equal spans."""
        edges = np.unique(np.linspace(0, len(x), min(bins, len(x)) + 1).astype(int))[:-1]
        with np.errstate(invalid="ignore"):
            least, most = np.fmin.reduceat(low, edges), np.fmax.reduceat(high, edges)
        sound = np.isfinite(least) & np.isfinite(most)
        at, least, most = x[edges][sound], least[sound], most[sound]
        if not len(at):
            return ""
        outline = self._fine(np.concatenate([at, at[::-1]]), np.concatenate([most, least[::-1]]))
        return self._path("band", _relative(outline) + "z")

    def mark(self, at: float, name: str) -> str:
        """A dashed upright with a name at its top."""
        place = self.left + round((at - self.x[0]) / (self.x[1] - self.x[0]) * self.wide)
        upright = f'<path class="mark" d="M{place} {self.top}v{_HEIGHT}"/>'
        return upright + _text(place + 3, self.top + 10, name)

    def _fine(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        across = (np.asarray(x) - self.x[0]) / (self.x[1] - self.x[0]) * self.wide
        down = (self.y[1] - np.asarray(y)) / (self.y[1] - self.y[0]) * _HEIGHT
        return np.rint(_FINE * np.column_stack([across, down])).astype(int)

    def _path(self, kind: str, path: str) -> str:
        place = f"translate({self.left} {self.top})scale({1 / _FINE:g})"
        return f'<path class="{kind}" transform="{place}" d="{path}"/>'


def _relative(points: np.ndarray) -> str:
    """A path through whole-numbered points, written as steps, the shortest form there is."""
    steps = np.diff(points, axis=0)
    moved = steps[np.any(steps != 0, axis=1)]
    return f"M{points[0, 0]} {points[0, 1]}" + "".join(f"l{i}{'' if j < 0 else ' '}{j}" for i, j in moved.tolist())


def _ticks(low: float, high: float, most: int) -> list[tuple[float, str]]:
    """Round numbers within the limits, each with its text."""
    from matplotlib.ticker import MaxNLocator

    values = [v for v in MaxNLocator(most, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high) if low <= v <= high]
    step = min(np.diff(values), default=1.0)
    places = max(
        0, -math.floor(math.log10(step) + 1e-9) + (round(step * 10 ** -math.floor(math.log10(step)), 6) == 2.5)
    )
    return [(v, f"{v + 0.0:.{places}f}".replace("-", "−")) for v in np.round(values, 12)]
