"""The report of `campaigns.regime_map`: what is said, in which order. Everything comes from the campaign's folder."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from tables import COMPUTED, FAILED, SCREENED, listed, number, percent

from ..figures.orbit_diagram import NARROW_IN
from ..figures.regime_map import Map, regime_maps
from ..parts import (
    PARTS,
    Figure,
    Folder,
    FolderError,
    Heading,
    Notice,
    Report,
    Table,
    at,
    having,
    heads,
    limits,
    plain,
    read_files,
    read_folder,
    report_page,
    section_items,
)
from .maps import LIMITS, PULL, Atlas, legend, numbers, read_atlas, regimes, without_border
from .sheets import cell_sheets


def report(directory: Path) -> Report:
    """The content of the report on a folder of maps. Raises FolderError for a folder that is not one."""
    files = read_files(directory, {name: PARTS[name] for name in ("scene.toml", "provenance.json")})
    folder = Folder(directory, files["provenance.json"], (), files["scene.toml"], {})
    atlas = read_atlas(folder)
    if atlas is None:
        raise FolderError(folder.directory, "cells/table.csv cannot be read: it has no cells over two keys")
    computed = atlas.of_source(COMPUTED) > 0.0
    if computed:
        folder = read_folder(directory, ("status", "motion", "run_key", "periods", "end_time_s", "message"))
    over = " and ".join(plain(key.head) for key in atlas.keys[-2:])
    first_maps = [regimes(page) for page in atlas.pages]
    items = [_figure(atlas, first_maps, legend(atlas), f"Maps of regimes over {over}", _REGIMES)]
    items.append(cell_sheets(folder, atlas))
    other_figures = [_figure(atlas, maps, (), f"Maps over {over}", _OTHERS) for maps in numbers(atlas)]
    if len(other_figures) == 1:
        items += other_figures
    items.append(section_items("regime_map"))
    if computed:
        items += [Heading("Regimes"), _regimes(atlas)]
    if len(other_figures) > 1:
        for page, figure in zip(atlas.pages, other_figures, strict=True):
            items += [Heading(page.place), figure]
    items += [Heading("Warnings"), _warnings(folder, atlas)]
    return report_page(folder, f"Regimes over {over}", items)


_REGIMES = (
    "Regime of the motion from rest; numbers: periods of the waves after which it repeats. Lines: borders between "
    "regimes. Percentages: shares of the map. A dot in place of a full cell: only screened with the massless tether, "
    "the cable is not computed there. Star: the largest tension of all motions, over the static tension. From "
    "`cells/table.csv`."
)
_OTHERS = (
    "The same map: number of motions; largest tension of all of them; share of the kicks "
    "that end in the motion of that tension, 0 where only rest or states of neighbours lead to it; largest exponent of "
    "all of them, white where none is known. A quantity that no cell has is left out. Lines: borders between regimes "
    "of the motion from rest, as above."
)


def _figure(atlas: Atlas, maps: Sequence[Map], entries, alt: str, caption: str) -> Figure:
    """The maps, two a row where there are several, and one below the other for telephones.

    entries: of the legend.
    """
    across = min(2, len(maps))
    picture, places = regime_maps(maps, atlas.labels, entries, atlas.marks, across)
    narrow, narrow_places = regime_maps(maps, atlas.labels, entries, atlas.marks, 1, NARROW_IN)
    titles = "; ".join(regime_map.title.replace("\n", ", ") for regime_map in maps)
    return Figure(picture, caption, f"{alt}: {titles}.", narrow=narrow, places=(places, narrow_places))


def _regimes(atlas: Atlas) -> Table:
    """A row a word: how much of the map it takes, where the line pulls hardest in it, what limits that."""
    cells_of_words = {}
    for page in atlas.pages:
        for cell in np.flatnonzero(page.on_top(COMPUTED)):
            word = str(page.kinds[cell])
            area = page.area[cell] / len(atlas.pages)
            cells_of_words.setdefault(word, []).append((page.rows[cell], area))
    body = []
    for word, cells in sorted(cells_of_words.items(), key=lambda item: -_area(item[1])):
        share = _area(cells)
        worst, _ = max(cells, key=_pull)
        cell_texts = [word, str(len(cells)), percent(share), number(worst[PULL], 3), at(atlas.keys, worst)]
        for name in LIMITS:
            limited = [cell for cell in cells if cell[0].get(name) == 1]
            cell_texts.append(percent(_area(limited) / share))
        body.append(cell_texts)
    limit_heads = [(reason, "") for reason in LIMITS.values()]
    columns = heads(
        "motion from rest", ("cells", ""), ("share of the map", ""), ("largest T over static", ""), "at", *limit_heads
    )
    caption = "Computed cells by the regime of the motion from rest; the last two columns: shares of their area."
    return Table(columns, body, caption)


def _area(cells: Sequence[tuple]) -> float:
    """The area of cells (row, area)."""
    return sum(area for _, area in cells)


def _pull(cell: tuple) -> float:
    """The largest tension of a cell (row, area), below all others where it has none."""
    row, _ = cell
    return np.nan_to_num(row[PULL], nan=-1.0)


_LIMIT_SENTENCES = {
    "loops": "loops are released, in a plane: a real line leaves it, so regime and exponent may differ there",
    "leaves_water": "the sphere comes out of the water: `buoy.submergence` says how it is treated",
}


def _warnings(folder: Folder, atlas: Atlas) -> Notice:
    lines = []
    screened = atlas.of_source(SCREENED)
    if screened:
        lines.append(
            f"{percent(screened)} of the map is only screened, with the massless tether: its dots are no result."
        )
    failed = atlas.of_source(FAILED)
    if failed:
        lines.append(f"{percent(failed)} of the map failed: {_reasons(atlas)}.")
    for name, reason in LIMITS.items():
        share = atlas.limited.get(reason, 0.0)
        if share:
            lines.append(f"On {percent(share)} of the map {_LIMIT_SENTENCES[name]}.")
    crossed, alone = without_border(atlas.pages[0])
    if alone:
        lines.append(
            f"{alone} of {crossed} computed cells that a curve of orbits crosses differ from no neighbour in regime or "
            "number of motions: the orbits of the curve are unstable there, or the map misses a motion."
        )
    verdicts = [row["verdict"] for row in having(folder.table, status="ok") if row.get("verdict")]
    cheap = verdicts.count("cheap")
    if cheap:
        lines.append(
            f"{cheap} of {len(verdicts)} verdicts are cheap: the motion repeats at one look. Sheets say which."
        )
    return limits("What the maps do not tell", lines, "Every cell was computed and has a full verdict.")


def _reasons(atlas: Atlas) -> str:
    """The three reasons for which most cells failed, in words."""
    reasons = Counter()
    for page in atlas.pages:
        for row in page.rows:
            if row["source"] == FAILED:
                reasons[row.get("message") or row.get("status") or "no reason told"] += 1
    return listed(f"{reason} ({times})" for reason, times in reasons.most_common(3))
