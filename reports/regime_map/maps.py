"""The maps of a folder of `campaigns.regime_map`: what is on each of its pages, and the five maps of a page."""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from tables import CHAOTIC, COMPUTED, FAILED, PAPER_STEEPNESS, PERIODIC, SCREENED, Column, listed, number

from ..figures.regime_map import HATCHES, LINES, Map, Page
from ..orbits.curves import drawn_curves
from ..parts import Folder, at, entries, series
from ..parts.style import BLUE, GRID, INK, MAP_PERIODS, ORANGE, REGIME_COLOURS, VERMILION

PULL, _EXPONENT = "tension_over_static", "exponent_max_per_period"
LIMITS = {"loops": "loops released, in a plane", "leaves_water": "sphere out of the water"}
_FINE = 100  # places on a curve from one point to the next, at which its cell is looked for
_WHOLE = 0.995  # share of a map that is called all of it


class Atlas(NamedTuple):
    """All pages over two keys; before them, where there are several pages, theirs. columns: of the cells.

    limited: reason -> share of all maps that it limits; one that limits all of them is not hatched.
    """

    keys: Sequence[Column]
    pages: Sequence[Page]
    columns: Mapping[str, Column]
    limited: Mapping[str, float]

    @property
    def labels(self) -> tuple[str, str]:
        x, y = self.keys[-2:]
        return x.label, y.label

    @property
    def marks(self) -> tuple[Sequence[float], Sequence[float]]:
        """The paper's steepnesses where an axis has them."""
        x, y = self.keys[-2:]
        return _paper_marks(x), _paper_marks(y)

    def share(self, chosen: Callable[[Page], np.ndarray]) -> float:
        """Of all maps, that of the cells (n,) chosen of each page."""
        return float(np.mean([page.share(chosen(page)) for page in self.pages]))

    def of_source(self, source: str) -> float:
        """Share of all maps whose cells come from there."""
        return self.share(lambda page: page.on_top(source))


def _paper_marks(key: Column) -> Sequence[float]:
    _, _, name = key.name.rpartition(".")
    if name != "steepness":
        return ()
    return PAPER_STEEPNESS


def read_atlas(folder: Folder) -> Atlas | None:
    """The maps of a folder; None where it has no cell that can be read."""
    part = folder.part("cells")
    axes = [name.removeprefix("width_") for name in part.columns if name.startswith("width_")]
    if not part.table or len(axes) != 2 or not {*axes, "level", "source", "regime_rest"} <= set(part.columns):
        return None
    keys = [part.columns[name] for name in axes]
    first = next(iter(part.columns))
    if first not in axes:
        keys.insert(0, part.columns[first])
    rows_of_pages = {}
    for row in part.table:
        value = row[first] if len(keys) > 2 else ""
        rows_of_pages.setdefault(value, []).append(row)
    lines, pages = [*drawn_curves(folder.part("curves"), keys[-2:])], []
    for number_of_page, page_rows in enumerate(rows_of_pages.values()):
        page_rows.sort(key=lambda row: row["level"])
        edges = []
        for axis in axes:
            middle, width = series(page_rows, axis), series(page_rows, f"width_{axis}")
            edges += [middle - 0.5 * width, middle + 0.5 * width]
        source, kinds = (np.array(entries(page_rows, name)) for name in ("source", "regime_rest"))
        kinds = np.where(kinds == "", source, kinds)
        hatched = {}
        for name, reason in LIMITS.items():
            if name in part.columns:
                hatched[reason] = series(page_rows, name) > 0.0
        place = at(keys[:-2], page_rows[0])
        pages.append(Page(np.column_stack(edges), kinds, source, hatched, lines, page_rows, number_of_page, place))
    limited = {}
    for reason in [*pages[0].hatched]:
        limited[reason] = float(np.mean([page.share(page.hatched[reason]) for page in pages]))
        if limited[reason] > _WHOLE:
            for page in pages:
                del page.hatched[reason]
    return Atlas(keys, pages, part.columns, limited)


def without_border(page: Page) -> tuple[int, int]:
    """How many computed cells a curve crosses, and round how many of them the map has no border.

    A border: between regimes from rest or numbers of motions, in the cells that touch the crossed one.
    """
    computed, boxes = page.on_top(COMPUTED), page.boxes
    left, right, low, high = boxes.T
    crossed = np.zeros(len(boxes), bool)
    for curve in page.curves:
        if curve.line:
            point = np.linspace(0.0, len(curve.x) - 1.0, _FINE * len(curve.x))
            x, y = (np.interp(point, np.arange(len(curve.x)), along) for along in (curve.x, curve.y))
            within = (left[:, None] <= x) & (x < right[:, None]) & (low[:, None] <= y) & (y < high[:, None])
            crossed |= computed & within.any(axis=1)
    alone, motions = 0, page.column("motions")
    for cell in np.flatnonzero(crossed):
        x, y = 0.01 * (right - left)[cell], 0.01 * (high - low)[cell]
        near = (left < right[cell] + x) & (right > left[cell] - x) & (low < high[cell] + y) & (high > low[cell] - y)
        alike = (page.kinds == page.kinds[cell]) & (motions == motions[cell])
        alone += bool(alike[near & computed].all())
    return int(crossed.sum()), alone


def colour_of(word: str) -> str:
    """Of a regime on a map; that of ink for a word of the screen alone, "" for a cell without a regime."""
    if word.startswith(PERIODIC):
        return MAP_PERIODS[min(int(word.removeprefix(PERIODIC)), len(MAP_PERIODS)) - 1]
    if word in (FAILED, COMPUTED, SCREENED):
        return ""
    return REGIME_COLOURS.get(word, INK)


def regimes(page: Page) -> Map:
    """The regime of the motion from rest, with its periods as numbers, and a star where the line pulls hardest."""
    kinds = page.kinds
    colours = np.array(list(map(colour_of, kinds)))
    texts = np.full(len(kinds), "", dtype=object)
    for cell, word in enumerate(kinds):
        if word.startswith(PERIODIC):
            texts[cell] = word.removeprefix(PERIODIC)
    title = "\n".join(_lines_of_title(page))
    return Map(page, title, colours, texts=texts.astype(str), star=_star(page))


def _lines_of_title(page: Page) -> list[str]:
    """The value of the page, how much of its map is chaotic and how much computed, and the largest tension."""
    lines = []
    if page.place:
        lines.append(page.place)
    computed = page.share(page.on_top(COMPUTED))
    if computed:
        chaotic = page.share(_computed_as(page, [CHAOTIC]))
        lines.append(f"motion from rest: chaotic on {_percent(chaotic)} of the map")
    else:
        lines.append("motion from rest: only screened")
    if 0.0 < computed < _WHOLE:
        lines.append(f"{_percent(computed)} of the map is computed")
    star = _star(page)
    if star is not None:
        lines.append(f"largest tension {number(page.rows[star][PULL], 3)} × static (star)")
    return lines


def _star(page: Page) -> int | None:
    """The cell in which the line pulls hardest; None where none is computed."""
    pull = np.where(page.on_top(COMPUTED), page.column(PULL), np.nan)
    if not np.isfinite(pull).any():
        return None
    return int(np.nanargmax(pull))


def legend(atlas: Atlas) -> list[tuple[str, str]]:
    """What colours and marks of the maps of regimes mean, each with its share of the map."""
    words, words_of_colours, entries = set(), {}, []
    for page in atlas.pages:
        words.update(page.kinds[page.area > 0.0])
    for word in sorted(words, key=_order):
        words_of_colours.setdefault(colour_of(word), []).append(word)
    words_of_colours.pop("", None)
    for colour, words in words_of_colours.items():
        share = atlas.share(partial(_computed_as, words=words))
        meaning = _words_listed(words)
        if share:
            meaning += f": {_percent(share)}"
        entries.append((colour, meaning))
    for mark, source, meaning in (("dot", SCREENED, "only screened"), ("cross", FAILED, "failed")):
        share = atlas.of_source(source)
        if share:
            entries.append((mark, f"{meaning}: {_percent(share)}"))
    for kind, line in LINES.items():
        if any(curve.line == line for curve in atlas.pages[0].curves):
            events = "torus points" if kind == "torus" else f"{kind}s"
            entries.append((line, f"{events} of orbits"))
    for hatch, reason in zip(HATCHES, atlas.pages[0].hatched, strict=False):
        share = atlas.limited[reason]
        if share:
            entries.append((hatch, f"{reason}: {_percent(share)}"))
    if any(_star(page) is not None for page in atlas.pages):
        entries.append(("star", "largest tension"))
    if any(atlas.marks):
        entries.append(("mark", "the paper's steepnesses"))
    return entries


def _order(word: str) -> tuple[int, str]:
    """Periods first, then the words of the analysis, then others."""
    known = list(REGIME_COLOURS)
    if word.startswith(PERIODIC):
        return int(word.removeprefix(PERIODIC)) - 1000, word
    if word in known:
        return known.index(word), word
    return len(known), word


def _computed_as(page: Page, words: Sequence[str]) -> np.ndarray:
    """(n,) which cells are computed, with one of these words for the motion from rest."""
    return page.on_top(COMPUTED) & np.isin(page.kinds, words)


def _words_listed(words: Sequence[str]) -> str:
    """ "chaotic", "period 2", "period 3 and more"."""
    first = words[0]
    if first not in REGIME_COLOURS and not first.startswith(PERIODIC):
        return f"{listed(words)}, screened"
    first = first.replace(PERIODIC, "period ")
    if len(words) > 1:
        return f"{first} and more"
    return first


def _percent(share: float) -> str:
    return f"{number(100.0 * share, 2)} %"


def numbers(atlas: Atlas) -> list[list[Map]]:
    """The four other maps of each page, in scales that all pages share; none of a quantity without a value."""
    from matplotlib.colors import BoundaryNorm, CenteredNorm, LinearSegmentedColormap, Normalize

    _, motions = _ends(atlas, "motions")
    most = max(3, int(motions))
    lowest, highest = _ends(atlas, _EXPONENT)
    growth = max(abs(lowest), abs(highest)) or 1.0
    signed = LinearSegmentedColormap.from_list("signed", [BLUE, GRID, VERMILION])
    even = LinearSegmentedColormap.from_list("even", ["#fdf3dc", ORANGE, "#5c2a00"])  # light to dark, in grey as well
    unit = "–"
    if _EXPONENT in atlas.columns:
        unit = atlas.columns[_EXPONENT].unit or unit
    quantities = (
        ("motions", "number of motions", even, BoundaryNorm(np.arange(most + 1) + 0.5, 256), range(1, most + 1)),
        (PULL, "largest tension over static", even, Normalize(*_ends(atlas, PULL)), None),
        ("share_of_largest", "share of kicks that end in that motion", even, Normalize(0.0, 1.0), None),
        (_EXPONENT, f"largest exponent ({unit})", signed, CenteredNorm(0.0, growth), None),
    )
    maps = []
    for page in atlas.pages:
        maps.append([_shaded(page, *quantity) for quantity in quantities if _has_values(atlas, quantity[0])])
    return maps


def _ends(atlas: Atlas, name: str) -> tuple[float, float]:
    """Least and greatest value of a column on all maps: of the computed cells, or of the screened where none is."""
    for source in (COMPUTED, SCREENED):
        values = np.concatenate([page.column(name)[page.on_top(source)] for page in atlas.pages])
        finite = values[np.isfinite(values)]
        if len(finite):
            return float(finite.min()), float(finite.max())
    return 0.0, 1.0


def _has_values(atlas: Atlas, name: str) -> bool:
    return any(np.isfinite(page.column(name)).any() for page in atlas.pages)


def _shaded(page: Page, name: str, title: str, colours, norm, ticks) -> Map:
    from matplotlib.colors import to_hex

    values = page.column(name)
    shades = [to_hex(shade) for shade in colours(norm(np.nan_to_num(values)))]
    filled = np.where(np.isfinite(values), shades, "")
    star = _star(page) if name == PULL else None
    limited = name in (PULL, _EXPONENT)
    return Map(page, title, filled, (colours, norm, ticks), star=star, limited=limited)
