"""The orbit diagram: strobed points over a parameter, what they are called above, curves over the same axis below."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import attrgetter

import numpy as np

from ..parts.content import Picture
from ..parts.style import INK, REGIME_COLOURS, SHADES, SOFT, VERMILION, WIDTH_IN, picture_of, sheet
from .curves import Curve, Panel, draw

NARROW_IN = 3.7  # of the form for telephones
_LEFT_IN, _LABEL_IN, _RIGHT_IN, _BOTTOM_IN = 0.7, 0.29, 0.08, 0.42
_BAR_IN, _MAIN_IN, _LOWER_IN, _GAP_IN = 0.16, 1.85, 0.68, 0.07
_BAR_OF_MOTION_IN, _MAIN_OF_MOTIONS_IN, _MAIN_OF_ORBITS_IN = 0.12, 1.6, 2.3
_LEGEND_IN, _NAMED = 0.14, 1.6  # a row of the legend, and the width of a motion in it
_EDGE_IN, _NUMBERS_IN = 0.1, 0.27  # beside the first and the last run; left of it, where numbers stand there
_NEUTRAL = "#8b95a0"
_LETTER_IN = 0.062  # mean width of a letter of 7 points
_SMALL = 1 / 3  # of the range of all points: what of it motions may take that are drawn again, larger
_LEAST_WIDE = 0.15  # of the axis, for those
_PERIOD = "period-"
_BETWEEN = "not judged"
_HATCHES = {"quasi-periodic": "////", "chaotic": "xxxxxx", "transient": "....", "undecided": "---"}  # of words

Motions = Mapping[str, tuple[str, str]]  # letter -> its colour, what the legend says of it


@dataclass(frozen=True, eq=False)
class Column:
    """The points (n,) of one run over its parameter, and the word for its motion, "" for one that nobody judged.

    motion: its letter, where one value may have several motions.
    """

    at: float
    points: np.ndarray
    word: str = ""
    motion: str = ""


@dataclass(frozen=True)
class Range:
    """What holds in a part of the runs: in words, and for each of the columns whether it does."""

    text: str
    holds: Sequence[bool]


def orbit_diagram(
    columns: Sequence[Column],
    labels: tuple[str, str],
    below: Sequence[Panel],
    ranges: Sequence[Range] = (),
    marks: Sequence[tuple[float, str]] = (),
    missing: Sequence[float] = (),
    width_in: float = WIDTH_IN,
    motions: Motions | None = None,
    orbits: Sequence[Curve] = (),
) -> Picture:
    """Bars with words and ranges, strobed points in the colours of the words, and panels below, on one axis.

    columns: by their parameter, one of them at least with points where there are no orbits. labels: of parameter and
    points, with units. ranges: each a bar above the points, and a shade over all panels. marks: (value, text) of
    vertical lines. missing: runs without points (crosses). motions: where there are several, by letter; each has the
    points in its colour, and a bar that tells its words by hatches. Motions whose points lie close together, from the
    left on, are drawn again in what is left blank beside them, on a finer scale. orbits: lines and marks over the
    points, in place of that; their names have a row of the legend.
    """
    judged = [column for column in columns if column.word]
    at = np.array([column.at for column in columns])
    words = {letter: _words(judged, letter) for letter in motions or [""] if judged}
    bars = [*words.values(), *(_spans(at, column.holds, column.text) for column in ranges)]
    bar_in, main_in = (_BAR_OF_MOTION_IN, _MAIN_OF_MOTIONS_IN) if motions else (_BAR_IN, _MAIN_IN)
    main_in = _MAIN_OF_ORBITS_IN if orbits else main_in
    heights = [*([bar_in] * len(bars)), main_in, *(_LOWER_IN * column.height for column in below)]
    legend = _legend(judged, len(judged) < len(columns), motions, int(width_in / _NAMED))
    legend += [[]] if orbits else []
    top_in = 0.3 + _LEGEND_IN * (len(legend) - 1) if legend else 0.08
    height_in = top_in + sum(heights) + _GAP_IN * (len(heights) - 1) + _BOTTOM_IN
    with sheet(height_in, width_in) as figure:
        grid = figure.add_gridspec(
            len(heights), 1, height_ratios=heights, hspace=_GAP_IN * len(heights) / sum(heights),
            left=_LEFT_IN / width_in, right=1 - _RIGHT_IN / width_in, bottom=_BOTTOM_IN / height_in,
            top=1 - top_in / height_in,
        )  # fmt: skip
        top = figure.add_subplot(grid[len(bars)])
        lower = [figure.add_subplot(grid[place], sharex=top) for place in range(len(bars) + 1, len(heights))]
        lowest = (top, *lower)[-1]
        places = np.concatenate([[column.at for column in columns], missing, *(column.x for column in orbits)])
        places = places[np.isfinite(places)]
        span, small = float(np.ptp(places)), None if orbits else _small(columns, bool(motions))
        left_in = _NUMBERS_IN if small else _EDGE_IN
        inch = (width_in - _LEFT_IN - _RIGHT_IN - left_in - _EDGE_IN) / (span or 0.04 * abs(float(at[0])) or 0.04)
        top.set_xlim(places.min() - left_in / inch, places.max() + _EDGE_IN / inch)  # inch: of the parameter
        above = [figure.add_subplot(grid[place], sharex=top) for place in range(len(bars))]
        for axes, (letter, spans) in zip(above, words.items(), strict=False):
            _told(axes, spans, inch, letter, motions[letter][0] if motions else "")
        for place, spans in enumerate(bars[len(words) :]):
            _range(above[len(words) + place], spans, inch)
            for axes in (top, *lower):
                for _, low, high in spans if place < len(SHADES) else ():
                    axes.axvspan(low, high, color=SHADES[place], linewidth=0)
        _points(top, columns, inch, motions)
        if orbits:
            draw(top, Panel(orbits))
            legend[-1] = top.get_legend_handles_labels()[0]
        if small:
            _enlarged(top, *small, inch, motions)
        top.plot(missing, np.full(len(missing), 0.03), "x", color=VERMILION, transform=top.get_xaxis_transform())
        top.set_ylabel(labels[1])
        for axes, panel in zip(lower, below, strict=True):
            draw(axes, panel)
            if axes.get_legend_handles_labels()[1]:
                axes.legend(loc="best", fontsize=6.5, borderpad=0.1, labelspacing=0.15)
        for axes in (top, *lower):
            axes.tick_params(labelbottom=axes is lowest)
            for value, _ in marks:
                axes.axvline(value, color=SOFT, linewidth=0.7, linestyle=(0, (3, 2)))
        for value, text in marks:
            lowest.annotate(text, (value, 0.05), (2, 0), ("data", "axes fraction"), "offset points", fontsize=7)
        lowest.set_xlabel(labels[0])
        tight = {"handlelength": 0.7, "handletextpad": 0.3, "columnspacing": 0.7, "borderaxespad": 0.1, "fontsize": 6.5}
        for row, handles in enumerate(legend):
            place = {"loc": "upper left", "bbox_to_anchor": (0.0, 1.0 - _LEGEND_IN * row / height_in)}
            longer = {"handlelength": 1.9} if orbits and handles is legend[-1] else {}  # a dash is no dashed line
            figure.legend(handles=handles, ncols=len(handles), **(tight | place | longer))
        for axes in (top, *lower):  # one below the other, left of the widest numbers
            axes.yaxis.set_label_coords((_LABEL_IN - _LEFT_IN) / (width_in - _LEFT_IN - _RIGHT_IN), 0.5)
        return picture_of(figure)


def cell_edges(at: np.ndarray) -> np.ndarray:
    """Edges (p + 1,) of the cells of sorted values (p,), half-way to their neighbours."""
    if len(at) < 2:
        return np.array([at[0] - 0.01 * (abs(at[0]) or 1.0), at[0] + 0.01 * (abs(at[0]) or 1.0)])
    middles = 0.5 * (at[1:] + at[:-1])
    return np.concatenate([[at[0] - (middles[0] - at[0])], middles, [at[-1] + (at[-1] - middles[-1])]])


def _spans(at: np.ndarray, words: Sequence, text: str = "") -> list[tuple[str, float, float]]:
    """(word, low, high) of every run of equal neighbours; a word that is no text stands for `text`, or for nothing."""
    edges, spans, first = cell_edges(at), [], 0
    for word, group in groupby(words):
        end = first + len(list(group))
        if word:
            spans.append((text or word, float(edges[first]), float(edges[end])))
        first = end
    return spans


def _words(judged: Sequence[Column], motion: str) -> list[tuple[str, float, float]]:
    """The spans of the words of a motion; none where a value has it not."""
    at, words_at = (
        np.unique([column.at for column in judged]),
        {column.at: column.word for column in judged if column.motion == motion},
    )
    return _spans(at, [words_at.get(value, "") for value in at])


def _kind(word: str) -> str:
    """The word, one for all periods."""
    return _PERIOD if word.startswith(_PERIOD) else word


def _legend(judged: Sequence[Column], outside: bool, motions: Motions | None, wide: int) -> list[list]:
    """Rows of what colours mean, and hatches where there are motions, `wide` a row; outside: some are not judged."""
    from matplotlib.patches import Patch

    if not judged:
        return []
    named = {kind: kind.replace(_PERIOD, "periodic") for kind in dict.fromkeys(_kind(column.word) for column in judged)}
    if motions:
        patches = [Patch(color=colour, label=f"{letter}: {title}") for letter, (colour, title) in motions.items()]
        rows = [patches[first : first + wide] for first in range(0, len(patches), wide)]
        return [*rows, [Patch(**_hatched(kind, SOFT), label=name) for kind, name in named.items()]]
    row = [Patch(color=REGIME_COLOURS[kind], label=name) for kind, name in named.items()]
    return [[*row, *([Patch(color=_NEUTRAL, label=_BETWEEN)] if outside else [])]]


def _hatched(kind: str, colour: str) -> dict[str, object]:
    """How a kind of motion looks in a colour: filled, or hatched on white."""
    hatch = _HATCHES.get(kind, "")
    return {"facecolor": "white" if hatch else colour, "edgecolor": colour, "hatch": hatch, "linewidth": 0.5}


def _told(axes, spans, inch: float, letter: str, colour: str) -> None:
    """Words as a bar with numbers of periods: in their colours, or hatched in that of a motion, its letter beside."""
    axes.axis("off")
    axes.set_ylim(0.0, 1.0)
    look = {"va": "center", "fontsize": 7.0}
    for word, low, high in spans:
        kind, number_text = _kind(word), word.removeprefix(_PERIOD)
        plain = {"facecolor": colour or REGIME_COLOURS[kind], "edgecolor": "white", "linewidth": 0.7}
        axes.axvspan(low, high, **(_hatched(kind, colour) if colour and kind in _HATCHES else plain))
        if kind == _PERIOD and (high - low) * inch > _LETTER_IN * len(number_text):
            axes.text(0.5 * (low + high), 0.45, number_text, color="white", ha="center", **look)
    if letter:
        axes.text(-0.008, 0.45, letter, transform=axes.transAxes, color=colour, ha="right", weight="bold", **look)


def _range(axes, spans, inch: float) -> None:
    """Spans as a bar of one shade, with its text once."""
    axes.axis("off")
    axes.set_ylim(0.0, 1.0)
    look = {"va": "center", "fontsize": 7.0}
    for _, low, high in spans:
        axes.axvspan(low, high, facecolor=SHADES[-1], linewidth=0.0)
    if not spans:
        return
    text, low, high = max(spans, key=lambda span: span[2] - span[1])
    left, right = axes.get_xlim()
    wide = _LETTER_IN * len(text) / inch
    place, side = (0.5 * (low + high), "center") if high - low > wide else (low, "right")
    if side == "right" and low - left < wide:
        place, side = (high, "left") if right - high > wide else (left, "left")
    axes.text(place, 0.45, text, ha=side, **look)


def _points(axes, columns: Sequence[Column], inch: float, motions: Motions | None) -> None:
    """The points as dashes as wide as a column has room, those of judged runs over the others."""
    at = np.unique([column.at for column in columns])
    room = 72.0 * inch * float(np.diff(at).min()) if len(at) > 1 else 6.0
    for word, motion in sorted({(column.word, column.motion) for column in columns}):
        members = [column for column in columns if (column.word, column.motion) == (word, motion)]
        x, y = (
            np.repeat([column.at for column in members], [len(column.points) for column in members]),
            [column.points for column in members],
        )
        wide, thick, alpha = (1.6, 1.1 if word.startswith(_PERIOD) else 0.45, 0.8) if word else (0.9, 0.7, 0.8)
        if motions:
            colour, _ = motions.get(motion, (_NEUTRAL, ""))
        elif len(members) == len(columns) and not word:
            colour, thick, alpha = INK, 0.45, 0.5
        else:
            colour = REGIME_COLOURS[_kind(word)] if word else _NEUTRAL
        look = {"markersize": min(max(wide * room, 1.2), 6.0), "markeredgewidth": thick, "rasterized": True}
        axes.plot(x, np.concatenate(y), "_", color=colour, alpha=alpha, **look)


def _small(columns: Sequence[Column], several: bool) -> tuple[list[Column], tuple[float, float], float] | None:
    """The columns from the left on whose points together take a small part of the range, the ends of their points,
    and where in the panel there is more room for them, 0 below and 1 above; None where there are not many.
    """
    filled = [column for column in columns if len(column.points)]
    points = {
        at: np.concatenate([column.points for column in members])
        for at, members in groupby(filled, key=attrgetter("at"))
    }
    at, least, largest = [*points], [*map(np.min, points.values())], [*map(np.max, points.values())]
    low, high = np.minimum.accumulate(least), np.maximum.accumulate(largest)
    number = int(np.sum(high - low < _SMALL * (max(largest) - min(least)))) - several  # so that no dash is half hidden
    if number < 2 or number == len(at) or at[number - 1] - at[0] < _LEAST_WIDE * (at[-1] - at[0]):
        return None
    ends, last = (float(low[number - 1]), float(high[number - 1])), at[number - 1]
    return (
        [column for column in filled if column.at <= last],
        ends,
        float(max(largest) - ends[1] > ends[0] - min(least)),
    )


def _enlarged(axes, columns: list[Column], ends: tuple[float, float], above: float, inch: float, motions) -> None:
    """The columns again, over the same parameter, in what is blank below or above them."""
    (bottom, top), (left, right) = axes.get_ylim(), axes.get_xlim()
    edges, room = cell_edges(np.unique([column.at for column in columns])), 0.12 * (top - bottom)
    low, high = (ends[1] + room, top - 0.3 * room) if above else (bottom + 0.3 * room, ends[0] - room)
    place = (0.0, (low - bottom) / (top - bottom), (edges[-1] - left) / (right - left), (high - low) / (top - bottom))
    inner = axes.inset_axes(place)
    _points(inner, columns, inch, motions)
    inner.set_xlim(left, edges[-1])
    inner.tick_params(labelbottom=False, bottom=False, direction="in", length=2, pad=-4, labelsize=6.0)
    for label in inner.get_yticklabels():
        label.set_horizontalalignment("left")
    inner.spines[["top", "right"]].set_visible(True)
    inner.set_title(f"the same, {(high - low) / (ends[1] - ends[0]):.0f} times as high", fontsize=6.5, pad=2)
