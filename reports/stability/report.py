"""The report of `campaigns.stability`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from ..parts.columns import value
from ..parts.content import Bullets, Heading, Item, Report, Text
from ..parts.provenance import provenance_items, timing_table
from ..parts.wording import count, listed, number
from . import sections

VERDICTS = ("ok", "refused", "known limit", "unexplained")


def report(directory: str | Path) -> Report:
    """The content of the report on a stability folder. Raises FolderError for a folder that is not one."""
    study = sections.read_study(directory)
    times = timing_table(study)
    items: list[Item] = [
        Heading("Question"),
        Text(
            "Does the engine answer for every scene that it accepts, and does it say why where it cannot? Stiff and "
            "extreme scenes are run to a verdict each. Random scenes, valid and invalid, are given to it. The "
            "eigenvalues of its time step are compared with the closed form. Scenes are timed with and without each "
            "of their parts."
        ),
        Heading("Short answer"),
        Bullets(tuple(_answers(study))),
        *sections.unexplained_items(study),
        *sections.case_items(study),
        *sections.limit_items(study),
        *sections.random_items(study),
        *sections.map_items(study),
        *sections.share_items(study),
        *([Heading("Times"), times] if times else []),
        *provenance_items(study),
    ]
    kind = "quick selection" if study.provenance.get("quick") else "all cases"
    return Report("Stiff and extreme scenes", f"{count(len(study.cases), 'case')} ({kind})", tuple(items))


def _answers(study: sections.Study) -> Iterator[str]:
    counts = Counter(row["verdict"] for row in study.cases)
    said = listed(f"{counts[word]} {word}" for word in VERDICTS if counts[word])
    yield f"{count(len(study.cases), 'case')}: {said}."
    if study.random:
        yield sections.sound(study)
    for row in study.cases:
        if row["group"] == "drift" and math.isfinite(value(row, "measured")):
            yield (
                f"Over {row['case']} ({number(value(row, 'wall_s'), 3)} s of computing) the strobed distance of the "
                f"buoy moves by {number(value(row, 'measured'), 2)} of its range."
            )
    maps = [entry for line in study.maps.values() for entry in line["methods"].values()]
    if apart := [entry["distance"] for entry in maps if "distance" in entry]:
        yield (
            "The engine's one-step map has every eigenvalue that the closed form gives for straight lines, within "
            f"{max(apart):.0e}, for every method."
        )
    times = [scene["us_per_newton"] for scene in study.shares["scenes"].values()]
    yield (
        f"A Newton iteration takes {number(min(times), 3)} to {number(max(times), 3)} µs, depending on what the scene "
        "has: parts that are absent are not computed."
    )
