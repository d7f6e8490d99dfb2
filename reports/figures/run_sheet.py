"""One run at a glance, as a small <svg> element: histories, section, spectrum, exponent in nine panels.

A sweep may have hundreds of runs, each with such a drawing inside one page: files of matplotlib would be too large for
that, and written here a sheet takes 10 to 14 kB. Coordinates are whole numbers, fifths of a pixel apart; colours come
from the page's style sheet, so that the drawing follows its light and dark form.
"""

import math
from collections.abc import Sequence
from html import escape

import numpy as np

from tables import number, sub

from ..parts import T_I, spans
from .curves import Curve, Panel, wide_limits

_FINE = 5  # units of a path to a pixel
_DROP = 3  # pixels from a letter to its subscript
_ROWS, _HEIGHT, _PITCH, _TOP = 3, 84, 128, 20
_COLUMNS = ((46, 320), (392, 200), (672, 276))  # left edge and width of the whole record, its end, the rest
_WIDE, _TALL = 960, _TOP + _ROWS * _PITCH - 6
_DECADES = 4  # of a spectrum, below its peak


NOTHING = (np.empty(0), np.empty(0))


def run_sheet(
    label: str,
    bins: int,
    periods: np.ndarray,
    histories: Sequence[tuple[str, np.ndarray, np.ndarray]],
    last: float,
    section: np.ndarray,
    spectrum: tuple[np.ndarray, np.ndarray],
    marks: Sequence[tuple[float, str]],
    exponent: tuple[np.ndarray, np.ndarray],
) -> str:
    """The drawing, `label` its text alternative; bins: columns of the whole record, fewer make it smaller.

    Three histories over `periods` (n,) t/T_i as (label with unit, low (n,), high (n,)); `last`: so many periods at the
    end are drawn larger; `section`: (m, 2) in m and m/s; `spectrum`: omega (k,) in rad/s and amplitude (k,) in m,
    `marks` the expected modes in rad/s with their names; `exponent`: t/T_i (j,) and bits per period (j,) found so far.
    """
    end = periods >= periods[-1] - last
    parts = [f'<svg class="glance" viewBox="0 0 {_WIDE} {_TALL}" role="img" aria-label="{escape(label)}">']
    side_panels = (_section(section), _spectrum(*spectrum, marks), _exponent(*exponent))
    for row, ((name, low, high), right) in enumerate(zip(histories, side_panels, strict=True)):
        limits = wide_limits(np.concatenate([low, high]))
        below = f"t/{T_I}" if right is side_panels[-1] else ""
        history = _banded(periods, low, high, bins)
        larger = _banded(periods[end], low[end], high[end], bins // 2)
        panels = Panel([history], below, name, name, ylim=limits), Panel([larger], below, ylim=limits), right
        for (left_edge, wide), panel in zip(_COLUMNS, panels, strict=True):
            parts.append(_drawn(panel, left_edge, wide, _TOP + row * _PITCH))
    return "".join([*parts, "</svg>"])


def _banded(x: np.ndarray, low: np.ndarray, high: np.ndarray, bins: int) -> Curve:
    """The area between the least and the greatest value of each of `bins` equal spans."""
    edges = np.unique(np.linspace(0, len(x), min(bins, len(x)) + 1).astype(int))[:-1]
    with np.errstate(invalid="ignore"):
        least, largest = np.fmin.reduceat(low, edges), np.fmax.reduceat(high, edges)
    sound = np.isfinite(least) & np.isfinite(largest)
    return Curve(x[[0, -1]], np.empty(0), band=(x[edges][sound], least[sound], largest[sound]))


def _section(points: np.ndarray) -> Panel:
    if not len(points):
        return Panel([], title="no section: no time after the transient")
    xlim, ylim = wide_limits(points[:, 0], 0.1), wide_limits(points[:, 1], 0.1)
    title = "section: dr/dt (m/s) over r (m)"
    return Panel([Curve(*points.T, mark="o")], "", title, title, xlim=xlim, ylim=ylim)


def _spectrum(omega: np.ndarray, amplitude: np.ndarray, marks) -> Panel:
    shown = amplitude > 0.0
    if not shown.any():
        return Panel([], title="no spectrum: the record is too short")
    omega, decades = omega[shown], np.log10(amplitude[shown])
    top = math.ceil(float(decades.max()))
    low = top - _DECADES
    title = f"spectrum: log{sub('10')} of |Δr̃| (m) over ω (rad/s)"
    inside = [(at, name) for at, name in marks if at < omega[-1]]
    curve = Curve(omega, np.maximum(decades, low))
    return Panel([curve], "", title, title, marks=inside, xlim=(0.0, float(omega[-1])), ylim=(low, top))


def _exponent(periods: np.ndarray, bits: np.ndarray) -> Panel:
    if len(bits) < 2:  # a run may end with its transient, or one period after it
        return Panel([], title="no exponent after the transient")
    limits = wide_limits(np.append(bits[len(bits) // 10 :], 0.0), 0.02)
    title = f"exponent so far: σ (bits per {T_I}) over t/{T_I}"
    return Panel([Curve(periods, np.clip(bits, *limits))], "", title, title, level=0.0, ylim=limits)


def _drawn(panel: Panel, left_edge: int, wide: int, top: int) -> str:
    """A panel in its place: its title alone where it has no curve; without y label no numbers stand beside it."""
    if not panel.curves:
        return _text(left_edge, top + 40, panel.title)
    curve, low = panel.curves[0], top + _HEIGHT
    (x0, x1), (y0, y1) = curve.x[[0, -1]], panel.ylim
    if panel.xlim is not None:
        x0, x1 = panel.xlim
    scale = np.array([wide / (x1 - x0), -_HEIGHT / (y1 - y0)])

    def fine(x, y) -> np.ndarray:
        return np.rint(_FINE * scale * (np.column_stack([x, y]) - (x0, y1))).astype(int)

    def path(kind: str, steps: str) -> str:
        return f'<path class="{kind}" transform="translate({left_edge} {top})scale({1 / _FINE:g})" d="{steps}"/>'

    def across(value: float) -> int:
        return left_edge + round((value - x0) * scale[0])

    parts = [f'<path class="axes" d="M{left_edge} {top}v{_HEIGHT}h{wide}"/>', _text(left_edge, top - 6, panel.title)]
    parts.append(_text(left_edge + wide // 2, low + 28, panel.x_label, "m"))
    for value, label in _ticks(x0, x1, 5):
        parts.append(_text(across(value), low + 14, label, "m"))
    if panel.y_label:
        for value, label in _ticks(y0, y1, 3):
            height = low + 4 + round((value - y0) * scale[1])
            parts.append(_text(left_edge - 4, height, label, "e"))
    for at, name in panel.marks:
        parts.append(f'<path class="mark" d="M{across(at)} {top}v{_HEIGHT}"/>' + _text(across(at) + 3, top + 10, name))
    if panel.level is not None:
        parts.append(path("zero", _steps(fine([x0, x1], [panel.level] * 2))))
    if curve.mark:  # round dots: strokes of no length
        places = dict.fromkeys(map(tuple, fine(curve.x, curve.y)))  # each once
        dots = "".join(f"M{i} {j}h0" for i, j in places)
        parts.append(path("dots", dots))
    elif curve.band is None:
        sound = np.isfinite(curve.y)
        parts.append(path("line", _steps(fine(curve.x[sound], curve.y[sound]))))
    elif len(curve.band[0]):
        at, least, largest = curve.band
        outline = fine(np.concatenate([at, at[::-1]]), np.concatenate([largest, least[::-1]]))
        parts.append(path("band", _steps(outline) + "z"))
    return "".join(parts)


def _text(x: int, y: int, words: str, anchor: str = "") -> str:
    """Words with the subscripts of `sub`: letters of Unicode's own are too small to read here; nothing for none."""
    parts, lowered = [], 0
    for style, piece in spans(words):
        if style == "sub":
            parts.append(f'<tspan dy="{_DROP - lowered}" class="s">{escape(piece)}</tspan>')
            lowered = _DROP
        elif lowered:
            parts.append(f'<tspan dy="{-lowered}">{escape(piece)}</tspan>')
            lowered = 0
        else:
            parts.append(escape(piece))
    if not parts:
        return ""
    kind = f' class="{anchor}"' if anchor else ""
    return f'<text{kind} x="{x}" y="{y}">{"".join(parts)}</text>'


def _steps(points: np.ndarray) -> str:
    """A path through whole-numbered points, written as steps, the shortest form there is; "" through none."""
    if not len(points):
        return ""
    steps = np.diff(points, axis=0)
    moved = steps[np.any(steps != 0, axis=1)]
    parts = [f"M{points[0, 0]} {points[0, 1]}"]
    for i, j in moved.tolist():
        between = "" if j < 0 else " "
        parts.append(f"l{i}{between}{j}")
    return "".join(parts)


def _ticks(low: float, high: float, count: int) -> list[tuple[float, str]]:
    """Round numbers within the limits, each with its text."""
    from matplotlib.ticker import MaxNLocator

    values = MaxNLocator(count, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [(value, number(float(value), 9)) for value in values if low <= value <= high]
