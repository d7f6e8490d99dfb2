"""The maps of a folder of `campaigns.regime_map`: what is on each of its pages, and the five maps of a page."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ..figures.regime_map import HATCHES, Cells, Map
from ..parts.columns import Quantity
from ..parts.folder import Folder, part_of
from ..parts.style import BLUE, GRID, INK, MAP_PERIODS, ORANGE, REGIME_COLOURS, VERMILION
from ..parts.wording import listed, number
from ..sweep.quantities import at, series

COMPUTED, SCREENED, FAILED = "computed", "screened", "failed"  # `source` of a cell
PULL, _EXPONENT = "tension_over_static", "exponent_max_per_period"
LIMITS = {"loops": "loops released, in a plane", "leaves_water": "sphere above still water"}
CHAOS, _PERIOD = "chaotic", "period-"
_WHOLE = 0.995  # share of a map that is called all of it
_PAPER = 0.016, 0.13  # steepnesses, as in `campaigns.buoy_sweep`, which reports must not import


@dataclass(frozen=True, eq=False)
class Page:
    """The n cells of one page, the small ones behind those that they cover. said: its value, "" for the only one.

    area (n,): share of the map that each cell takes where it is on top.
    """

    number: int
    said: str
    rows: Sequence[Mapping[str, object]]
    cells: Cells
    area: np.ndarray

    def column(self, name: str) -> np.ndarray:
        """A number of each cell (n,), nan where it has none."""
        return series(self.rows, name)

    def on_top(self, source: str) -> np.ndarray:
        """(n,) which cells are of that source and not covered by others."""
        return (self.area > 0.0) & np.array([row["source"] == source for row in self.rows])

    def share(self, chosen: np.ndarray) -> float:
        """Of the map."""
        return float(self.area[chosen].sum())


@dataclass(frozen=True, eq=False)
class Atlas:
    """All pages over two keys; before them, where there are several pages, theirs. columns: of the cells."""

    keys: Sequence[Quantity]
    pages: Sequence[Page]
    columns: Mapping[str, Quantity]

    @property
    def labels(self) -> tuple[str, str]:
        return tuple(key.label for key in self.keys[-2:])

    @property
    def marks(self) -> tuple[Sequence[float], Sequence[float]]:
        """The paper's steepnesses where an axis has them."""
        return tuple(_PAPER if key.name.rpartition(".")[2] == "steepness" else () for key in self.keys[-2:])

    def share(self, chosen: Callable[[Page], np.ndarray]) -> float:
        """Of all maps, that of the cells (n,) chosen of each page."""
        return float(np.mean([page.share(chosen(page)) for page in self.pages]))

    def of_source(self, source: str) -> float:
        """Share of all maps whose cells come from there."""
        return self.share(lambda page: page.on_top(source))

    def limited(self, said: str) -> float:
        """Share of all maps that is hatched for that reason."""
        return self.share(lambda page: page.cells.hatched[said])


def read_atlas(folder: Folder) -> Atlas | None:
    """The maps of a folder; None where it has no cell that can be read."""
    part = part_of(folder, "cells")
    names = [name.removeprefix("width_") for name in (part.columns if part else ()) if name.startswith("width_")]
    if len(names) != 2 or not {*names, "level", "source", "regime_rest"} <= set(part.columns):
        return None
    first = next(iter(part.columns))
    keys = [part.columns[name] for name in ([] if first in names else [first]) + names]
    rows = sorted(part.table, key=lambda row: row["level"])
    values, pages = dict.fromkeys(row[first] if len(keys) > 2 else "" for row in part.table), []
    for value in values:
        own = [row for row in rows if len(keys) == 2 or row[first] == value]
        cells = _cells(own, *names)
        pages.append(Page(len(pages), at(keys[:-2], own[0]), own, cells, cells.areas()))
    return Atlas(keys, pages, part.columns)


def _cells(rows, x: str, y: str) -> Cells:
    middle, half = ([series(rows, of.format(name)) for name in (x, y)] for of in ("{}", "width_{}"))
    boxes = np.column_stack(
        [one + sign * 0.5 * wide for one, wide in zip(middle, half, strict=True) for sign in (-1, 1)]
    )
    source = np.array([row["source"] for row in rows])
    limits = {said: series(rows, name) > 0.0 for name, said in LIMITS.items() if name in rows[0]}
    kinds = np.array([row["regime_rest"] or row["source"] for row in rows])
    return Cells(boxes, kinds, source == SCREENED, source == FAILED, limits)


def colour_of(word: str) -> str:
    """Of a regime on a map; that of ink for a word of the screen alone, "" for a cell without a regime."""
    if word.startswith(_PERIOD):
        return MAP_PERIODS[min(int(word.removeprefix(_PERIOD)), len(MAP_PERIODS)) - 1]
    return REGIME_COLOURS.get(word, INK) if word not in (FAILED, COMPUTED, SCREENED) else ""


def regimes(page: Page) -> Map:
    """The regime of the motion from rest, with its periods as numbers, and a star where the line pulls hardest."""
    kinds = page.cells.kinds
    texts = np.array([word.removeprefix(_PERIOD) if word.startswith(_PERIOD) else "" for word in kinds])
    star, computed = _star(page), page.share(page.on_top(COMPUTED))
    chaos = f"chaotic on {_percent(page.share(_called(page, [CHAOS])))} of the map"
    said = [page.said, f"motion from rest: {chaos if computed else 'only screened'}"]
    said += [f"{_percent(computed)} of the map is computed"] if 0.0 < computed < _WHOLE else []
    said += [] if star is None else [f"largest tension {number(page.rows[star][PULL], 3)} × static (star)"]
    title = "\n".join(filter(None, said))
    return Map(page.cells, title, np.array([*map(colour_of, kinds)]), page.number, texts=texts, star=star)


def _star(page: Page) -> int | None:
    """The cell in which the line pulls hardest; None where none is computed."""
    pull = np.where(page.on_top(COMPUTED), page.column(PULL), np.nan)
    return int(np.nanargmax(pull)) if np.isfinite(pull).any() else None


def legend(atlas: Atlas) -> list[tuple[str, str]]:
    """What colours and marks of the maps of regimes mean, each with its share of the map."""
    words = {word for page in atlas.pages for word, area in zip(page.cells.kinds, page.area, strict=True) if area > 0.0}
    named: dict[str, list[str]] = {}
    for word in sorted(words, key=_order):
        named.setdefault(colour_of(word), []).append(word)
    named.pop("", None)
    told = [
        (colour, _with_share(_listed(own), atlas.share(partial(_called, words=own)))) for colour, own in named.items()
    ]
    for mark, source, said in (("dot", SCREENED, "only screened"), ("cross", FAILED, "failed")):
        told += [(mark, _with_share(said, share))] if (share := atlas.of_source(source)) else []
    for hatch, said in zip(HATCHES, atlas.pages[0].cells.hatched, strict=False):
        told += [(hatch, _with_share(said, share))] if (share := atlas.limited(said)) else []
    told += [("star", "largest tension")] if any(_star(page) is not None for page in atlas.pages) else []
    return told + ([("mark", "the paper's steepnesses")] if any(atlas.marks) else [])


def _order(word: str) -> tuple[int, str]:
    """Periods first, then the words of the analysis, then others."""
    period, known = word.removeprefix(_PERIOD), [*REGIME_COLOURS]
    return (int(period) - 1000 if period != word else known.index(word) if word in known else len(known)), word


def _called(page: Page, words: Sequence[str]) -> np.ndarray:
    """(n,) which cells are computed, with one of these words for the motion from rest."""
    return page.on_top(COMPUTED) & np.isin(page.cells.kinds, words)


def _listed(words: Sequence[str]) -> str:
    """ "chaotic", "period 2", "period 3 and more"."""
    if words[0] not in REGIME_COLOURS and not words[0].startswith(_PERIOD):
        return f"{listed(words)}, screened"
    return words[0].replace(_PERIOD, "period ") + (" and more" if len(words) > 1 else "")


def _with_share(said: str, share: float) -> str:
    return f"{said}: {_percent(share)}" if share else said


def _percent(share: float) -> str:
    return f"{number(100.0 * share, 2)} %"


def numbers(atlas: Atlas) -> list[list[Map]]:
    """The four other maps of each page, in scales that all pages share; none of a quantity without a value."""
    from matplotlib.colors import BoundaryNorm, CenteredNorm, LinearSegmentedColormap, Normalize

    def ends(name: str) -> tuple[float, float]:
        for source in (COMPUTED, SCREENED):
            known = np.concatenate([page.column(name)[page.on_top(source)] for page in atlas.pages])
            known = known[np.isfinite(known)]
            if len(known):
                return float(known.min()), float(known.max())
        return 0.0, 1.0

    most, (least, largest), growth = max(3, int(ends("motions")[1])), ends(PULL), max(map(abs, ends(_EXPONENT)))
    signed = LinearSegmentedColormap.from_list("signed", [BLUE, GRID, VERMILION])
    even = LinearSegmentedColormap.from_list("even", ["#fdf3dc", ORANGE, "#5c2a00"])  # light to dark, in grey as well
    unit = atlas.columns[_EXPONENT].unit if _EXPONENT in atlas.columns else ""
    told = (
        ("motions", "number of motions", even, BoundaryNorm(np.arange(most + 1) + 0.5, 256), range(1, most + 1)),
        (PULL, "largest tension over static", even, Normalize(least, largest), None),
        ("share_of_largest", "share of kicks that end in that motion", even, Normalize(0.0, 1.0), None),
        (_EXPONENT, f"largest exponent ({unit or '–'})", signed, CenteredNorm(0.0, growth or 1.0), None),
    )
    known = [one for one in told if any(np.isfinite(page.column(one[0])).any() for page in atlas.pages)]
    return [[_shaded(page, *one) for one in known] for page in atlas.pages]


def _shaded(page: Page, name: str, title: str, colours, norm, ticks) -> Map:
    from matplotlib.colors import to_hex

    values = page.column(name)
    known, shades = np.isfinite(values), colours(norm(np.nan_to_num(values)))
    found = np.where(known, [to_hex(shade) for shade in shades], "")
    star, limited = _star(page) if name == PULL else None, name in (PULL, _EXPONENT)
    return Map(page.cells, title, found, page.number, (colours, norm, ticks), star=star, limited=limited)
