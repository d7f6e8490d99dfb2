"""The report of `campaigns.stability`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path

from ..parts.content import Bullets, Heading, Item, Notice, Report, Text
from ..parts.provenance import provenance_items, timing_table
from ..parts.wording import count, listed, number
from .cases import case_items, limit_items
from .folder import VERDICTS, Study, read_study, value
from .random_scenes import SOUND, random_items
from .steps import map_items, share_items


def report(directory: str | Path) -> Report:
    """The content of the report on a stability folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    times = timing_table(study)
    items = [
        Heading("Question"),
        Text(
            "Does the engine answer for every scene that it accepts, and say why where it cannot? Stiff and extreme "
            "scenes are run to a verdict each, random scenes valid and invalid are thrown at it, the eigenvalues of "
            "its time step are held against the closed form, and what a scene does not need is counted."
        ),
        Heading("Short answer"),
        Bullets(tuple(_answers(study))),
        *_unexplained(study),
        *case_items(study),
        *limit_items(study),
        *random_items(study),
        *map_items(study),
        *share_items(study),
        *([Heading("Times"), times] if times else []),
        *provenance_items(study),
    ]
    kind = "quick selection" if study.provenance.get("quick") else "all cases"
    return Report("Stiff and extreme scenes", f"{count(len(study.cases), 'case')} ({kind})", tuple(items))


def _answers(study: Study):
    counts = Counter(row["verdict"] for row in study.cases)
    said = listed(f"{counts[word]} {word}" for word in VERDICTS if counts[word])
    yield f"{count(len(study.cases), 'case')}: {said}."
    if study.random:
        unsound = [row for row in study.random if row["outcome"] not in SOUND]
        valid = sum(row["kind"] == "valid" for row in study.random)
        slowest = max(float(row["wall_s"]) for row in study.random)
        faults = f"{count(len(unsound), 'fault')} of the program among them" if unsound else (
            "none hung, crashed, raised, or gave a number that is not finite, and every refusal has a reason"
        )  # fmt: skip
        yield (
            f"{valid} random valid and {len(study.random) - valid} random invalid scenes: {faults}; the slowest took "
            f"{number(slowest, 3)} s."
        )
    for row in study.group("drift"):
        if math.isfinite(value(row, "measured")):
            yield (
                f"Over {row['case']} ({number(value(row, 'wall_s'), 3)} s of computing) the strobed distance of the "
                f"buoy moves by {number(value(row, 'measured'), 2)} of its range."
            )
    apart = [
        entry["distance"]
        for line in study.maps.values()
        for entry in line.get("methods", {}).values()
        if "distance" in entry
    ]
    if apart:
        yield (
            f"Every eigenvalue that the closed form gives for straight lines is found in the engine's one-step map "
            f"within {max(apart):.0e}, for every method."
        )
    scenes = study.shares["scenes"]
    counts = [entry["newton"] for entry in scenes.values()]
    yield (
        f"A Newton iteration takes {number(min(counts))} to {number(max(counts))} floating-point operations, as the "
        "scene needs them: water, waves, currents, bending, profiles and the third dimension cost nothing where they "
        "are absent."
    )


def _unexplained(study: Study) -> list[Item]:
    rows = study.judged("unexplained")
    lines = [f"{row['group']}, {row['case']}: {row['run_status']} {row['message']}".strip() for row in rows]
    lines += [
        f"random {row['kind']} scene {row['number']}: {row['outcome']}, {row['message'][:300]}"
        for row in study.random
        if row["outcome"] not in SOUND
    ]
    if not lines:
        return [Notice("note", "Nothing unexplained", ("Every case ended as expected, or with a reason given below.",))]
    return [Notice("warning", "Unexplained", tuple(lines))]
