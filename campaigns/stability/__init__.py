"""Stiff and extreme scenes, each run to a verdict: a table and a report.

    python -m campaigns.stability                     every case, in about seven minutes on two cores
    python -m campaigns.stability --quick             the cases that matter most: half a minute
    python -m campaigns.stability --drift-periods 0   leave out the long run

Protocol: every case is run to a verdict (ok, refused with a reason, a known limit, unexplained) in a process of its own
with a time limit, and says how its verdict is known: energy, refinement, closed form. A verdict "unexplained" ends the
campaign with exit code 1.
"""

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass

from campaigns.machinery import Summary, cli
from campaigns.study import Order, Study
from tables import Rows, number_of

DRIFT_PERIODS = 100_000


@dataclass
class Options(cli.Options):
    """The options of this campaign."""

    quick: bool = cli.flag("fewer cases, no long run")
    drift_periods: int = cli.option(
        "N",
        f"wave periods of the long regular run, 0 for none (default: {DRIFT_PERIODS}; 0 with --quick)",
        cli.whole(0),
    )

    def read(self, faults: list[str]) -> None:
        """What is usual depends on --quick."""
        if self.drift_periods is None:
            self.drift_periods = 0 if self.quick else DRIFT_PERIODS
        if 0 < self.drift_periods < 1000:
            faults.append(f"--drift-periods: given {self.drift_periods}; allowed: 0, or 1000 and above")


def perform(order: Order) -> Summary:
    """Tasks and table."""
    from campaigns.stability import tasks

    return tasks.judge_cases(order)


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """How the cases ended; what nobody can explain by name."""
    counts = Counter(str(row["verdict"]) for row in rows)
    verdicts = [f"{count} {word}" for word, count in counts.most_common()]
    yield f"{len(rows)} cases: {', '.join(verdicts)}."
    silent, warned = [], 0
    for row in rows:
        error = number_of(row, "measured_tension")
        if row["verdict"] == "ok" and math.isfinite(error):
            if row.get("warning"):
                warned += 1
            else:
                silent.append(error)
    if silent:
        worst = f"{100.0 * max(silent):.2g} %"
        sentence = f"In the {len(silent)} runs without a warning the largest tension is right to {worst}"
        if warned:
            sentence += f"; {warned} more warn, and say how far theirs hold"
        yield f"{sentence}."
    strange = [str(row["case"]) for row in rows if row["verdict"] == "unexplained"]
    if strange:
        yield f"Unexplained: {'; '.join(strange)[:200]}."


STUDY = Study(
    name="stability",
    protocol=__doc__,
    options=Options,
    parameters=lambda order: asdict(order.options),
    perform=perform,
    answer=answer,
    places=("jobs",),
    strict=True,
)
main, read_order = STUDY.main, STUDY.read_order
