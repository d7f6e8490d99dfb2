"""The section of a sweep's report on its own error against run time, from `accuracy/table.csv` in its folder."""

from __future__ import annotations

from pathlib import Path

from ..parts.columns import number_of, table_of
from ..parts.content import Heading, Item, Text
from ..parts.folder import read_columns, read_rows
from ..parts.wording import number

FOLDER = "accuracy"


def accuracy_items(directory: Path) -> list[Item]:
    """The section; a sentence where the check was left out."""
    heading = Heading("Error against run time")
    rows = read_rows(directory / FOLDER / "table.csv")
    if not rows:
        text = (
            "This sweep did not repeat any of its runs (`--no-accuracy`, or no run ended as asked), so that it says "
            "nothing about its own error. What tolerance and grid give in general: docs/how_far_to_trust_a_run.md."
        )
        return [heading, Text(text)]
    columns = read_columns(directory / FOLDER)
    names = [
        "role", "label", "run", "status", "nodes", "rtol", "periods", "error_early_m", "error_m", "verdict", "wall_s",
    ]  # fmt: skip
    caption = "Runs repeated: what changed against the run as it was made. From `accuracy/table.csv`."
    own = {
        "label": lambda row: number(float(row["label"])),
        "rtol": lambda row: number(number_of(row["rtol"] or row["step_s"])),
    }
    said = (
        "Two runs of this sweep were repeated at a tenth of the tolerance and at twice the elements: the one whose "
        "tension peaks lowest (regular) and the one whose tension peaks highest (violent). Past the limit of "
        "predictability r differs by the size of the motion, whatever the tolerance; verdicts and extremes are then "
        "what may be compared. A dash: the record is too short for a verdict."
    )
    return [heading, Text(said), table_of(columns, names, rows, caption, own)]
