"""The orbit diagram: strobed points over a parameter, what they are called above, curves over the same axis below."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from tables import PERIODIC

from ..parts import content
from ..parts.style import INK, REGIME_COLOURS, SHADES, SOFT, VERMILION, WIDTH_IN, kind_of, picture_of, sheet
from .curves import Curve, Panel, draw

NARROW_IN = 3.7  # of the form for telephones
_LEFT_IN, _LABEL_IN, _RIGHT_IN, _BOTTOM_IN = 0.7, 0.29, 0.08, 0.42
_BAR_IN, _MAIN_IN, _LOWER_IN, _GAP_IN = 0.16, 1.85, 0.68, 0.07
_BAR_OF_MOTION_IN, _MAIN_OF_MOTIONS_IN, _MAIN_OF_ORBITS_IN = 0.12, 1.6, 2.3
_LEGEND_IN, _NAMED = 0.14, 1.6  # a row of the legend, and the width of a motion in it
_EDGE_IN, _NUMBERS_IN = 0.1, 0.27  # beside the first and the last run; left of it, where numbers stand there
_NEUTRAL = "#8b95a0"
_WORD = {"va": "center", "fontsize": 7.0}  # of a bar
_LETTER_IN = 0.062  # mean width of a letter of 7 points
_SMALL = 1 / 3  # of the range of all points: what of it motions may take that are drawn again, larger
_LEAST_WIDE = 0.15  # of the axis, for those
_LEAST_LARGER = 2.0  # times, for which it is drawn again
_HATCHES = {"quasi-periodic": "////", "chaotic": "xxxxxx", "transient": "....", "undecided": "---"}  # of words

Motions = Mapping[str, tuple[str, str]]  # letter -> its colour, what the legend says of it
Span = tuple[str, float, float]  # a word, and where on the axis it begins and ends


class Strobes(NamedTuple):
    """The points (n,) of one run over its parameter, and the word for its motion, "" for one that nobody judged.

    motion: its letter, where one value may have several motions.
    """

    at: float
    points: np.ndarray
    word: str = ""
    motion: str = ""


class OrbitDiagram(NamedTuple):
    """Bars with words and ranges, strobed points in the colours of the words, and panels below, on one axis.

    columns   by their parameter, one of them at least with points where there are no orbits
    labels    of parameter and points, with units
    below     panels under the points
    ranges    in words, and for each of the columns whether it holds: a bar above the points, a shade over all panels
    marks     (value, text) of vertical lines
    missing   runs without points (crosses)
    motions   where there are several, by letter; each has the points in its colour, and a bar that tells its words by
              hatches. Motions whose points lie close together, from the left on, are drawn again in what is left blank
              beside them, on a finer scale
    orbits    lines and marks over the points, in place of that; their names have a row of the legend
    """

    columns: Sequence[Strobes]
    labels: tuple[str, str]
    below: Sequence[Panel]
    ranges: Mapping[str, Sequence[bool]] = {}
    marks: Sequence[tuple[float, str]] = ()
    missing: Sequence[float] = ()
    motions: Mapping[str, tuple[str, str]] = {}
    orbits: Sequence[Curve] = ()

    def figure(self, caption: str, alt: str) -> content.Figure:
        """The figure of a report, with its form for telephones."""
        return content.Figure(self.drawn(), caption, alt, narrow=self.drawn(NARROW_IN))

    def drawn(self, width_in: float = WIDTH_IN) -> content.Picture:
        """The diagram in this width."""
        at = np.array([column.at for column in self.columns])
        words = self._words()
        ranges = [_spans(at, holds, text) for text, holds in self.ranges.items()]
        bars = len(words) + len(ranges)
        bar_in, main_in = _BAR_IN, _MAIN_IN
        if self.motions:
            bar_in, main_in = _BAR_OF_MOTION_IN, _MAIN_OF_MOTIONS_IN
        if self.orbits:
            main_in = _MAIN_OF_ORBITS_IN
        heights = [bar_in] * bars + [main_in]
        for panel in self.below:
            heights.append(_LOWER_IN * panel.height)
        legend = self._legend(int(width_in / _NAMED))
        top_in = 0.08
        if legend:
            top_in = 0.3 + _LEGEND_IN * (len(legend) - 1)
        height_in = top_in + sum(heights) + _GAP_IN * (len(heights) - 1) + _BOTTOM_IN
        with sheet(height_in, width_in, None) as figure:
            grid = figure.add_gridspec(
                len(heights), 1, height_ratios=heights, hspace=_GAP_IN * len(heights) / sum(heights),
                left=_LEFT_IN / width_in, right=1 - _RIGHT_IN / width_in, bottom=_BOTTOM_IN / height_in,
                top=1 - top_in / height_in,
            )  # fmt: skip
            top = figure.add_subplot(grid[bars])
            panels = [top]
            for place in range(bars + 1, len(heights)):
                panels.append(figure.add_subplot(grid[place], sharex=top))
            enlarged, edge_in = None, _EDGE_IN
            if not self.orbits:
                enlarged = _small(self.columns, bool(self.motions))
            if enlarged:
                edge_in = _NUMBERS_IN
            inch = self._set_span(top, width_in, edge_in)
            above = [figure.add_subplot(grid[place], sharex=top, ylim=(0.0, 1.0)) for place in range(bars)]
            for axes in above:
                axes.axis("off")
            for axes, (letter, spans) in zip(above, words.items(), strict=False):
                colour = self.motions[letter][0] if self.motions else ""
                _word_bar(axes, spans, inch, letter, colour)
            for axes, spans in zip(above[len(words) :], ranges, strict=True):
                _range_bar(axes, spans, inch)
            for shade, spans in zip(SHADES, ranges, strict=False):
                for axes in panels:
                    for _, low, high in spans:
                        axes.axvspan(low, high, color=shade, linewidth=0)
            _points(top, self.columns, inch, self.motions)
            if self.orbits:
                draw(top, Panel(self.orbits))
                legend[-1] = top.get_legend_handles_labels()[0]
            if enlarged:
                _enlarged(top, *enlarged, inch, self.motions)
            low_places = np.full(len(self.missing), 0.03)
            top.plot(self.missing, low_places, "x", color=VERMILION, transform=top.get_xaxis_transform())
            self._finish(panels)
            _lay_legend(figure, legend, height_in, bool(self.orbits))
            for axes in panels:  # one below the other, left of the widest numbers
                axes.yaxis.set_label_coords((_LABEL_IN - _LEFT_IN) / (width_in - _LEFT_IN - _RIGHT_IN), 0.5)
            return picture_of(figure)

    def _words(self) -> dict[str, list[Span]]:
        """The bar of words of each motion, with nothing where a value has it not; "" in a sweep of one motion."""
        judged, spans = [column for column in self.columns if column.word], {}
        at = sorted({column.at for column in judged})
        if not judged:
            return spans
        for letter in self.motions or [""]:
            words = dict.fromkeys(at, "")
            for column in judged:
                if column.motion == letter:
                    words[column.at] = column.word
            spans[letter] = _spans(np.array(at), list(words.values()))
        return spans

    def _legend(self, wide: int) -> list[list]:
        """Rows of what colours mean, and hatches where there are motions, `wide` of them a row; that of the orbits, the
        last one, is still empty."""
        from matplotlib.patches import Patch

        rows, names = [], {}
        for column in self.columns:
            if column.word:
                kind = kind_of(column.word)
                names[kind] = kind.replace(PERIODIC, "periodic")
        if names and self.motions:
            patches = []
            for letter, (colour, title) in self.motions.items():
                patches.append(Patch(color=colour, label=f"{letter}: {title}"))
            for first in range(0, len(patches), wide):
                rows.append(patches[first : first + wide])
            rows.append([Patch(**_hatched(kind, SOFT), label=name) for kind, name in names.items()])
        elif names:
            rows.append([Patch(color=REGIME_COLOURS[kind], label=name) for kind, name in names.items()])
            if not all(column.word for column in self.columns):
                rows[0].append(Patch(color=_NEUTRAL, label="not judged"))
        if self.orbits:
            rows.append([])
        return rows

    def _set_span(self, axes, width_in: float, left_in: float) -> float:
        """Set the span of the parameter; the inches that it takes for a change by 1. left_in: left of the first run."""
        at = [column.at for column in self.columns]
        places = np.concatenate([at, self.missing, *(orbit.x for orbit in self.orbits)])
        places = places[np.isfinite(places)]
        span = float(np.ptp(places)) or 0.04 * abs(float(at[0])) or 0.04
        inch = (width_in - _LEFT_IN - _RIGHT_IN - left_in - _EDGE_IN) / span
        axes.set_xlim(places.min() - left_in / inch, places.max() + _EDGE_IN / inch)
        return inch

    def _finish(self, panels: Sequence) -> None:
        """Draw the panels below the first one, the marks of all, and the labels."""
        top, *lower = panels
        top.set_ylabel(self.labels[1])
        for axes, panel in zip(lower, self.below, strict=True):
            draw(axes, panel)
            if axes.get_legend_handles_labels()[1]:
                axes.legend(loc="best", fontsize=6.5, borderpad=0.1, labelspacing=0.15)
        lowest = panels[-1]
        for axes in panels:
            axes.tick_params(labelbottom=axes is lowest)
            for value, _ in self.marks:
                axes.axvline(value, color=SOFT, linewidth=0.7, linestyle=(0, (3, 2)))
        middle = np.mean(lowest.get_xlim())
        for value, text in self.marks:
            away, side = (2, "left") if value < middle else (-2, "right")
            at = (value, 0.05), (away, 0), ("data", "axes fraction"), "offset points"
            lowest.annotate(text, *at, ha=side, fontsize=7)
        lowest.set_xlabel(self.labels[0])


def _lay_legend(figure, legend: Sequence[list], height_in: float, with_orbits: bool) -> None:
    tight = {"handlelength": 0.7, "handletextpad": 0.3, "columnspacing": 0.7, "borderaxespad": 0.1, "fontsize": 6.5}
    for row, handles in enumerate(legend):
        look = tight | {"loc": "upper left", "bbox_to_anchor": (0.0, 1.0 - _LEGEND_IN * row / height_in)}
        if with_orbits and row == len(legend) - 1:
            look["handlelength"] = 1.9  # a dash is no dashed line
        figure.legend(handles=handles, ncols=len(handles), **look)


def cell_edges(at: np.ndarray) -> np.ndarray:
    """Edges (p + 1,) of the cells of sorted values (p,), half-way to their neighbours."""
    if len(at) < 2:
        half = 0.01 * (abs(at[0]) or 1.0)
        return np.array([at[0] - half, at[0] + half])
    middles = 0.5 * (at[1:] + at[:-1])
    return np.concatenate([[at[0] - (middles[0] - at[0])], middles, [at[-1] + (at[-1] - middles[-1])]])


def _spans(at: np.ndarray, words: Sequence, text: str = "") -> list[Span]:
    """(word, low, high) of every run of equal neighbours; a word that is no text stands for `text`, or for nothing."""
    edges, spans, first = cell_edges(at), [], 0
    for word, group in groupby(words):
        end = first + len(list(group))
        if word:
            spans.append((text or word, float(edges[first]), float(edges[end])))
        first = end
    return spans


def _hatched(kind: str, colour: str) -> dict[str, object]:
    """How a kind of motion looks in a colour: filled, or hatched on white."""
    hatch = _HATCHES.get(kind, "")
    face = "white" if hatch else colour
    return {"facecolor": face, "edgecolor": colour, "hatch": hatch, "linewidth": 0.5}


def _word_bar(axes, spans: Sequence[Span], inch: float, letter: str, colour: str) -> None:
    """Words as a bar with numbers of periods: in their colours, or hatched in that of a motion, its letter beside."""
    for word, low, high in spans:
        kind, number_text = kind_of(word), word.removeprefix(PERIODIC)
        filling = {"facecolor": colour or REGIME_COLOURS[kind], "edgecolor": "white", "linewidth": 0.7}
        if colour and kind in _HATCHES:
            filling = _hatched(kind, colour)
        axes.axvspan(low, high, **filling)
        if kind == PERIODIC and (high - low) * inch > _LETTER_IN * len(number_text):
            axes.text(0.5 * (low + high), 0.45, number_text, color="white", ha="center", **_WORD)
    if letter:
        axes.text(-0.008, 0.45, letter, transform=axes.transAxes, color=colour, ha="right", weight="bold", **_WORD)


def _range_bar(axes, spans: Sequence[Span], inch: float) -> None:
    """Spans as a bar of one shade, with its text once."""
    for _, low, high in spans:
        axes.axvspan(low, high, facecolor=SHADES[-1], linewidth=0.0)
    if not spans:
        return
    text, low, high = max(spans, key=lambda span: span[2] - span[1])
    x_min, x_max = axes.get_xlim()
    low, high = max(low, x_min), min(high, x_max)
    wide = _LETTER_IN * len(text) / inch
    place, side = x_min, "left"
    if high - low > wide:
        place, side = 0.5 * (low + high), "center"
    elif low - x_min >= wide:
        place, side = low, "right"
    elif x_max - high > wide:
        place = high
    axes.text(place, 0.45, text, ha=side, **_WORD)


def _points(axes, columns: Sequence[Strobes], inch: float, motions: Motions) -> None:
    """The points as dashes as wide as a column has room, those of judged runs over the others."""
    at = np.unique([column.at for column in columns])
    room = 72.0 * inch * float(np.diff(at).min()) if len(at) > 1 else 6.0
    groups = {}
    for column in columns:
        groups.setdefault((column.word, column.motion), []).append(column)
    for (word, motion), members in sorted(groups.items()):
        points = [column.points for column in members]
        x = np.repeat([column.at for column in members], list(map(len, points)))
        wide, thick, alpha = 1.6, 0.45, 0.8
        if word.startswith(PERIODIC):
            thick = 1.1
        elif not word:
            wide, thick = 0.9, 0.7
        if motions:
            colour, _ = motions.get(motion, (_NEUTRAL, ""))
        elif word:
            colour = REGIME_COLOURS[kind_of(word)]
        elif len(members) == len(columns):
            colour, thick, alpha = INK, 0.45, 0.5
        else:
            colour = _NEUTRAL
        look = {"markersize": min(max(wide * room, 1.2), 6.0), "markeredgewidth": thick, "rasterized": True}
        axes.plot(x, np.concatenate(points), "_", color=colour, alpha=alpha, **look)


def _small(columns: Sequence[Strobes], several: bool) -> tuple[list[Strobes], tuple[float, float], float] | None:
    """The columns from the left on whose points together take a small part of the range, the ends of their points,
    and where in the panel there is more room for them, 0 below and 1 above; None where there are not many.
    """
    filled = [column for column in columns if len(column.points)]
    at, least, largest = [], [], []
    for value, members in groupby(filled, key=attrgetter("at")):
        points = np.concatenate([column.points for column in members])
        at.append(value)
        least.append(np.min(points))
        largest.append(np.max(points))
    low, high = np.minimum.accumulate(least), np.maximum.accumulate(largest)
    number = int(np.sum(high - low < _SMALL * (max(largest) - min(least)))) - several  # so that no dash is half hidden
    if number < 2 or number == len(at) or at[number - 1] - at[0] < _LEAST_WIDE * (at[-1] - at[0]):
        return None
    ends, last = (float(low[number - 1]), float(high[number - 1])), at[number - 1]
    members = [column for column in filled if column.at <= last]
    above = float(max(largest) - ends[1] > ends[0] - min(least))
    return members, ends, above


def _enlarged(axes, columns: list[Strobes], ends: tuple[float, float], above: float, inch: float, motions) -> None:
    """The columns again, over the same parameter, in what is blank below or above them, if there is room for it."""
    (bottom, top), (x_min, x_max) = axes.get_ylim(), axes.get_xlim()
    edges, room = cell_edges(np.unique([column.at for column in columns])), 0.12 * (top - bottom)
    low, high = bottom + 0.3 * room, ends[0] - room
    if above:
        low, high = ends[1] + room, top - 0.3 * room
    if high - low < _LEAST_LARGER * (ends[1] - ends[0]):
        return
    width = (edges[-1] - x_min) / (x_max - x_min)
    inner = axes.inset_axes((0.0, (low - bottom) / (top - bottom), width, (high - low) / (top - bottom)))
    _points(inner, columns, inch, motions)
    inner.set_xlim(x_min, edges[-1])
    inner.tick_params(labelbottom=False, bottom=False, direction="in", length=2, pad=-4, labelsize=6.0)
    for label in inner.get_yticklabels():
        label.set_horizontalalignment("left")
    inner.spines[["top", "right"]].set_visible(True)
    inner.set_title(f"the same, {(high - low) / np.ptp(inner.get_ylim()):.0f} times as high", fontsize=6.5, pad=2)
