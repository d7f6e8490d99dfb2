"""Random scenes in the stability report: what became of them."""

from __future__ import annotations

from collections import Counter

from ..parts.content import Column, Heading, Item, Table, Text
from ..parts.wording import number
from .folder import Study

SOUND = ("ok", "ended", "refused")
_MEANING = {
    "ok": "ran to its end; every sample there and finite",
    "ended": "ended early with a status and a reason; finite up to there",
    "refused": "not started; every fault named with its key and what is allowed",
    "hang": "no answer within the time limit",
    "crash": "its process died",
    "traceback": "an exception that is no refusal",
    "not-finite": "a number that is not finite was handed out",
    "incomplete": "samples are missing",
    "silent": "ended early without a reason",
    "accepted": "an invalid scene was not refused",
    "unclear": "a message without a key or without what is allowed",
}


def random_items(study: Study) -> list[Item]:
    """Counts of outcomes and statuses, and the times."""
    items: list[Item] = [Heading("Random scenes")]
    if not study.random:
        return [*items, Text("None were asked for (`--fuzz 0`).")]
    items.append(
        Text(
            "Valid scenes are drawn section by section so that every rule between values holds; in every other one, up "
            "to three numbers are then replaced by extreme ones that the models still allow. Invalid scenes are valid "
            "ones with up to three faults put in. Each runs in a process of its own, for up to 40 samples, with a "
            "limit of 60 s of computing. The seed is in the provenance; the same seed gives the same scenes."
        )
    )
    rows = []
    for kind in ("valid", "invalid"):
        found = [row for row in study.random if row["kind"] == kind]
        outcomes = Counter(row["outcome"] for row in found)
        for outcome, many in sorted(outcomes.items(), key=lambda pair: -pair[1]):
            those = [row for row in found if row["outcome"] == outcome]
            statuses = Counter(row["status"] for row in those if row["status"] not in ("", "ok"))
            said = ", ".join(f"{word} {times}" for word, times in statuses.most_common())
            walls = sorted(float(row["wall_s"]) for row in those)
            meaning = _MEANING.get(outcome, "") + (f": {said}" if said else "")
            rows.append((kind, outcome, str(many), meaning, number(walls[len(walls) // 2], 2), number(walls[-1], 3)))
    columns = (
        Column("scenes", align="left"), Column("outcome", align="left"), Column("count"),
        Column("meaning", align="left"), Column("median", "s"), Column("slowest", "s"),
    )  # fmt: skip
    return [*items, Table(columns, tuple(rows), "Outcomes of random scenes. From `fuzz.csv`.", small=True)]
