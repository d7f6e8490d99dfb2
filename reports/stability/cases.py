"""The cases and the random scenes of the stability report: verdicts, known limits, refusals, outcomes."""

from __future__ import annotations

from collections import Counter

from ..parts.columns import table_of, value
from ..parts.content import Bullets, Column, Heading, Item, Notice, Table, Text
from ..parts.wording import number
from .folder import SOUND, Study

TITLES = {
    "EI": "Bending stiffness, 0 to 1e4 N m²",
    "EA": "Axial stiffness, 1e-2 to 1e4 of Table 1",
    "f'": "Tension laws that lose their slope",
    "nodes": "Grids, 3 to 5000 nodes",
    "mass": "Density and added mass",
    "water": "Water and currents",
    "waves": "Steepness to 0.4, periods of 0.5 to 60 s",
    "surface": "Buoys partly out of the water, irregular seas",
    "start": "Kicks, slack, horizontal and upside-down starts",
    "snap": "Slack taken up at speed",
    "push": "A straight line pushed together",
    "steps": "Fixed steps and tolerances far from usual",
    "input": "Values that no scene should have",
    "drift": "A long regular run",
}
HOW = (
    "Checks. Closed form: the largest distance from it. Refinement, or a run on other nodes: rms difference of r "
    "from a run with twice the elements and a tenth of the tolerance (or the nodes named), over the range of r. "
    "Energy: largest change of the total over the largest kinetic energy, without water. Static equilibrium stays, "
    "symmetry, r stays: the largest movement over the length. Finite and complete: every sample is there and is a "
    "number; this is asked of every run. A case is ok where the measured number is below its bar."
)
SHOWN = ("case", "dimensions", "verdict", "run_status", "how", "measured", "bar", "length_s", "case_wall_s")
OUTCOMES = {
    "ok": "ran to its end; every sample is there and finite",
    "ended": "ended early with a status and a reason; finite up to there",
    "refused": "not started; every fault is named with its key and with what is allowed",
    "hang": "no answer within the time limit",
    "crash": "its process died",
    "traceback": "an exception that is no refusal",
    "not-finite": "a number that is not finite was handed out",
    "incomplete": "samples are missing",
    "silent": "ended early without a reason",
    "accepted": "an invalid scene was not refused",
    "unclear": "a message without a key or without what is allowed",
}


def case_items(study: Study) -> list[Item]:
    """One table of all cases, a row with its title before each group."""
    rows = []
    for group in dict.fromkeys(row["group"] for row in study.cases):
        rows.append({"case": f"— {TITLES.get(group, group)} —"})
        rows += [row for row in study.cases if row["group"] == group]

    def cell(name: str):
        return lambda row: study.columns[name].cell(row[name]) if "group" in row else row.get(name, "")

    caption = "Cases and verdicts, from `table.csv`."
    own = {name: cell(name) for name in SHOWN}
    return [Heading("Cases and verdicts"), Text(HOW), table_of(study.columns, SHOWN, rows, caption, own)]


def limit_items(study: Study) -> list[Item]:
    """What ended otherwise than "ok", and what the user is told."""
    limits, refused = study.judged("known limit"), study.judged("refused")
    lines = []
    for reason in dict.fromkeys(row["limit"] for row in limits):
        names = "; ".join(f"{row['case']} ({row['run_status']})" for row in limits if row["limit"] == reason)
        lines.append(f"{reason[:1].upper()}{reason[1:]}. Seen in: {names}.")
    items: list[Item] = [Heading("Known limits"), Bullets(tuple(lines)) if lines else Text("None was met.")]
    items.append(Heading("Refused, and what the user is told", 2))
    if not refused:
        return [*items, Text("Nothing was refused.")]
    own = {"message": lambda row: row["message"].removeprefix("faulty scene: ")}
    caption = "Scenes that were not started, from `table.csv`."
    return [*items, table_of(study.columns, ("case", "message"), refused, caption, own)]


def random_items(study: Study) -> list[Item]:
    """Counts of outcomes and statuses, and the times."""
    if not study.random:
        return [Heading("Random scenes"), Text("None were asked for (`--fuzz 0`).")]
    text = (
        "Valid scenes are drawn section by section, and drawn again where a rule between their values is broken; in "
        "about half of them up to three numbers are replaced by extreme ones that the engine still accepts. Invalid "
        "scenes are valid ones with up to three faults put in. Each scene runs in a process of its own, for up to 40 "
        "samples, with a limit of 60 s of computing. The same seed gives the same scenes."
    )
    groups: dict[tuple[str, str], list[dict[str, str]]] = {}
    for row in study.random:
        groups.setdefault((row["kind"], row["outcome"]), []).append(row)
    rows = []
    for (kind, outcome), found in sorted(groups.items(), key=lambda entry: (entry[0][0] != "valid", -len(entry[1]))):
        statuses = Counter(row["status"] for row in found if row["status"] not in ("", "ok")).most_common()
        meaning = ": ".join(
            [OUTCOMES[outcome], *([", ".join(f"{word} {many}" for word, many in statuses)] * bool(statuses))]
        )
        walls = sorted(value(row, "wall_s") for row in found)
        rows.append((kind, outcome, str(len(found)), meaning, number(walls[len(walls) // 2], 2), number(walls[-1], 3)))
    columns = (
        Column("scenes", align="left"), Column("outcome", align="left"), Column("count"),
        Column("meaning", align="left"), Column("median", "s"), Column("slowest", "s"),
    )  # fmt: skip
    table = Table(columns, tuple(rows), "Outcomes of random scenes. From `fuzz.csv`.", small=True)
    return [Heading("Random scenes"), Text(text), table]


def unexplained_items(study: Study) -> list[Item]:
    """A warning with all that nobody expected, or a note that there is nothing of the kind."""
    lines = [
        f"{row['group']}, {row['case']}: {row['run_status']} {row['message']}".strip()
        for row in study.judged("unexplained")
    ]
    lines += [
        f"random {row['kind']} scene {row['number']}: {row['outcome']}, {row['message'][:300]}"
        for row in study.unsound()
    ]
    if lines:
        return [Notice("warning", "Unexplained", tuple(lines))]
    return [Notice("note", "Nothing unexplained", ("Every case ended as expected, or with a reason given below.",))]


def sound(study: Study) -> str:
    """The random scenes in one sentence."""
    valid, unsound = sum(row["kind"] == "valid" for row in study.random), len(study.unsound())
    slowest = max(value(row, "wall_s") for row in study.random)
    return (
        f"Random scenes: {valid} valid and {len(study.random) - valid} invalid; {unsound} of them did anything else "
        f"than {', '.join(SOUND)}. The slowest took {number(slowest, 3)} s."
    )
