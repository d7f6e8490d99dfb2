"""What a map says, in a few lines: where it pulls hardest, where it is chaotic, where the start decides."""

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from itertools import filterfalse
from operator import itemgetter

from campaigns.answers import CHAOS_OF_ONE_GRID, greatest, in_newtons, line, numbers_of
from campaigns.explore.grid import place_in
from campaigns.explore.load import reasons, use_of
from campaigns.regime_map.tables import RATIO
from tables import (
    CHAOTIC,
    EMPTY,
    FAILED,
    OPEN,
    PEAK,
    PERIODIC,
    QUASI,
    SCREENED,
    Columns,
    Row,
    Rows,
    listed,
    number_of,
    of_kicks,
    typed,
)


def sentences(cells: Rows, motions: Rows, keys: Columns, scene: Callable) -> Iterator[str]:
    """At most eight, of the rows of cells/table.csv and table.csv.

    keys: of the map, that of its pages first. scene: that of a row, as far as its buoy goes.
    """
    coarse = list(filter(_is_coarse, cells))
    computed = [cell for cell in coarse if cell["source"] != SCREENED]
    if not computed:
        yield from _of_the_screen(coarse, keys)
        return
    peak = greatest(cells, PEAK)
    if peak is not None:
        loads = [_peak(peak, motions, keys)]
        loads += _use([row for row in motions if number_of(row, PEAK) > 0.0], keys, scene)
        yield line("LOAD", " ".join(loads))
    yield line("MOTIONS", " ".join(_regimes(computed, motions, keys)))
    several = [count for count in numbers_of(computed, "motions") if count > 1]
    if several:
        share = _share(len(several), computed)
        yield line("STARTS", f"on {share} of the map the start decides: up to {max(several):.0f} motions.")
    cheap = sum(row.get("verdict") == "cheap" for row in motions)
    if cheap:
        yield line("CHECK", f"{cheap} of {len(motions)} motions were classified by one test instead of two.")
    if any(row.get("regime") == CHAOTIC for row in motions):
        yield line("CHECK", CHAOS_OF_ONE_GRID)
    screened = len(coarse) - len(computed)
    if screened:
        yield line("OPEN", f"{screened} of {len(coarse)} cells were only screened with a massless tether.")
    failed = list(map(itemgetter("source"), cells)).count(FAILED)
    if failed:
        yield line("OPEN", f"{failed} cells have no result; the column message of cells/table.csv says why.")


def _is_coarse(row: Row) -> bool:
    return number_of(row, "level") == 0.0


def _of_the_screen(cells: Rows, keys: Columns) -> Iterator[str]:
    yield f"Preview only: a massless tether was run in {len(cells)} cells; the cable itself was not."
    peak = greatest(cells, RATIO.name)
    if peak is not None:
        yield f"Largest tension there: {peak[RATIO.name]:.3g} times that at rest, at {_at(peak, keys)}."


def _regimes(computed: Rows, motions: Rows, keys: Columns) -> Iterator[str]:
    """The shares of the map on which the motion from rest, or some motion, is chaotic, quasi-periodic or periodic."""
    counts, periodic, undecided = Counter(), 0, 0
    for cell in computed:
        word = str(cell["regime_rest"] or "")
        counts[word] += 1
        periodic += word.startswith(PERIODIC)
        undecided += word in OPEN
    parts = {CHAOTIC: counts[CHAOTIC], QUASI: counts[QUASI], "periodic": periodic}
    shares = listed(f"{word} on {_share(count, computed)}" for word, count in parts.items())
    yield f"rest leads to a motion that is {shares} of the map; {_share(undecided, computed)} is not decided."
    chaotic = {place_in(row, keys) for row in filter(_is_coarse, motions) if row.get("regime") == CHAOTIC}
    if len(chaotic) > counts[CHAOTIC]:
        yield f"Some motion is chaotic on {_share(len(chaotic), computed)} of the map."


def _peak(peak: Row, motions: Rows, keys: Columns) -> str:
    """The largest tension of the map, and how many kicks of its cell lead to it."""
    pull = f"{in_newtons(peak[PEAK])}, {peak[RATIO.name]:.3g} times that at rest"
    sentence = f"largest tension {pull}, at {_at(peak, keys)}"
    motions_of_cell = [row for row in motions if place_in(row, keys) == place_in(peak, keys)]
    kicks = of_kicks(greatest(motions_of_cell, PEAK) or {})
    if kicks != EMPTY:
        sentence += f"; {kicks} kicks there end in it"
    return f"{sentence}."


def _use(motions: Rows, keys: Columns, scene: Callable) -> Iterator[str]:
    """Whether the largest tension may be used, and the largest that may."""
    if not motions:
        return
    by_tension = sorted(motions, key=itemgetter(PEAK), reverse=True)
    peak = by_tension[0]
    usable = next(filterfalse(lambda row: [*reasons(row, scene(row))], by_tension), None)
    sentence = use_of(peak, scene(peak), searched=math.isfinite(number_of(peak, "share")))
    if usable is not None and usable is not peak:
        pull = in_newtons(usable[PEAK])
        sentence += f" Largest without these faults: {pull}, at {_at(usable, keys)}."
    yield sentence


def _share(count: int, cells: Sequence) -> str:
    return f"{100.0 * count / len(cells):.3g} %"


def _at(row: Row, keys: Columns) -> str:
    words = []
    for key, value in zip(keys, place_in(row, keys), strict=True):
        text = value
        if not isinstance(value, str):
            text = typed(value)
        words.append(f"{key.symbol} = {text} {key.unit}".rstrip())
    return ", ".join(words)
