"""The report of `campaigns.regime_map`: what is said, in which order. Everything comes from the campaign's folder."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ..figures.orbit_diagram import NARROW_IN
from ..figures.regime_map import Map, regime_maps
from ..parts.content import Figure, Heading, Notice, Report, Table, heads, plain
from ..parts.folder import PARTS, Folder, FolderError, read_files, read_folder
from ..parts.provenance import appendix, provenance_items, scene_items, timing_items
from ..parts.sections import section_items
from ..parts.style import WIDTH_IN
from ..parts.wording import listed, number, percent
from ..sweep.quantities import at
from .maps import COMPUTED, FAILED, LIMITS, PULL, SCREENED, Atlas, legend, numbers, read_atlas, regimes
from .sheets import cell_sheets


def report(directory: str | Path) -> Report:
    """The content of the report on a folder of maps. Raises FolderError for a folder that is not one."""
    found = read_files(directory, {name: PARTS[name] for name in ("scene.toml", "provenance.json")})
    folder = Folder(Path(directory), found["provenance.json"], (), found["scene.toml"], {})
    atlas = read_atlas(folder)
    if atlas is None:
        raise FolderError(folder.directory, ["cells/table.csv cannot be read: it has no cells over two keys"])
    if computed := atlas.of_source(COMPUTED) > 0.0:
        folder = read_folder(directory, ("status", "motion", "run_key", "periods", "end_time_s", "message"))
    over = " and ".join(plain(key.head) for key in atlas.keys[-2:])
    first = _figure(
        atlas, [regimes(page) for page in atlas.pages], legend(atlas), f"Maps of regimes over {over}", _REGIMES
    )
    others = [_figure(atlas, four, (), f"Maps over {over}", _OTHERS) for four in numbers(atlas)]
    pages = zip(atlas.pages, others, strict=True) if len(others) > 1 else ()
    items = [
        first,
        cell_sheets(folder, atlas),
        *(others if len(others) == 1 else ()),
        *section_items("regime_map", "Question"),
        *((Heading("Regimes"), _regimes(atlas)) if computed else ()),
        *(item for page, four in pages for item in (Heading(page.said), four)),
        Heading("Warnings"),
        _warnings(folder, atlas),
        *appendix(
            *timing_items(folder),
            *scene_items(folder.scene, str(folder.provenance.get("scene") or folder.scene.name), {}),
            *provenance_items(folder),
        ),
    ]
    return Report(f"Regimes over {over}", folder.scene.title or folder.scene.name, tuple(items))


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


def _figure(atlas: Atlas, shown: Sequence[Map], told, alt: str, caption: str) -> Figure:
    """The maps, two a row where there are several, and one below the other for telephones."""
    (picture, *places), (narrow, *below) = (
        regime_maps(shown, atlas.labels, told, atlas.marks, width, wide)
        for width, wide in ((WIDTH_IN, min(2, len(shown))), (NARROW_IN, 1))
    )
    said = "; ".join(one.title.replace("\n", ", ") for one in shown)
    return Figure(picture, caption, f"{alt}: {said}.", narrow=narrow, places=(*places, *below))


def _regimes(atlas: Atlas) -> Table:
    """A row a word: how much of the map it takes, where the line pulls hardest in it, what limits that."""
    found: dict[str, list[tuple]] = {}
    for page in atlas.pages:
        for cell in np.flatnonzero(page.on_top(COMPUTED)):
            found.setdefault(str(page.cells.kinds[cell]), []).append(
                (page.rows[cell], page.area[cell] / len(atlas.pages))
            )
    body = []
    for word, own in sorted(found.items(), key=lambda one: -sum(area for _, area in one[1])):
        share = sum(area for _, area in own)
        worst = max((row for row, _ in own), key=lambda row: np.nan_to_num(row[PULL], nan=-1.0))
        limited = (sum(area for row, area in own if row.get(name) == 1) / share for name in LIMITS)
        body.append(
            (word, str(len(own)), percent(share), number(worst[PULL], 3), at(atlas.keys, worst), *map(percent, limited))
        )
    columns = heads(
        "motion from rest", ("cells", ""), ("share of the map", ""), ("largest T over static", ""), "at",
        *((said, "") for said in LIMITS.values()),
    )  # fmt: skip
    caption = "Computed cells by the regime of the motion from rest; the last two columns: shares of their area."
    return Table(columns, tuple(body), caption, small=True)


def _warnings(folder: Folder, atlas: Atlas) -> Notice:
    lines = []
    if share := atlas.of_source(SCREENED):
        lines.append(f"{percent(share)} of the map is only screened, with the massless tether: its dots are no result.")
    if share := atlas.of_source(FAILED):
        lost = (row for page in atlas.pages for row in page.rows if row["source"] == FAILED)
        reasons = Counter(row.get("message") or row.get("status") or "no reason told" for row in lost)
        why = listed(f"{reason} ({times})" for reason, times in reasons.most_common(3))
        lines.append(f"{percent(share)} of the map failed: {why}.")
    told = {
        "loops": "loops are released, in a plane: a real line leaves it, so regime and exponent may differ there",
        "leaves_water": "the top of the sphere comes above still water: `buoy.submergence` says how it is treated",
    }
    for name, said in LIMITS.items():
        if share := atlas.limited(said):
            lines.append(f"On {percent(share)} of the map {told[name]}.")
    verdicts = Counter(row["verdict"] for row in folder.table if row["status"] == "ok" and row.get("verdict"))
    if cheap := verdicts["cheap"]:
        lines.append(
            f"{cheap} of {verdicts.total()} verdicts are cheap: the motion repeats at one look. Sheets say which."
        )
    if not lines:
        return Notice("note", "Nothing to warn of", ("Every cell was computed and has a full verdict.",))
    return Notice("warning", "What the maps do not tell", tuple(lines))
