"""Stiff and extreme scenes, each run to a verdict: a table and a report.

    python -m campaigns.stability                     every case, in about seven minutes on two cores
    python -m campaigns.stability --quick             the cases that matter most: half a minute
    python -m campaigns.stability --drift-periods 0   leave out the long run

Protocol: every case is run to a verdict (ok, refused with a reason, a known limit, unexplained) in a process of its own
with a time limit, and says how its verdict is known: energy, refinement, closed form. A verdict "unexplained" ends the
campaign with exit code 1.
"""

import math
from argparse import Namespace
from collections import Counter
from collections.abc import Iterator

from campaigns.answers import known
from campaigns.machinery import cli
from campaigns.machinery.plan import Summary
from campaigns.study import Order, Study

DRIFT_PERIODS = 100_000


def options(group) -> None:
    group.add_argument("--quick", action="store_true", help="fewer cases, no long run")
    periods = f"wave periods of the long regular run, 0 for none (default: {DRIFT_PERIODS}; 0 with --quick)"
    cli.add(group, "--drift-periods", "N", periods, cli.whole(0))


def read(options: Namespace, faults: list[str]) -> None:
    """What is usual depends on --quick."""
    if options.drift_periods is None:
        options.drift_periods = 0 if options.quick else DRIFT_PERIODS
    if 0 < options.drift_periods < 1000:
        faults.append(f"--drift-periods: given {options.drift_periods}; allowed: 0, or 1000 and above")


def done(order: Order) -> tuple[dict[str, float], Summary]:
    """Tasks and table."""
    from campaigns.stability import tasks

    return tasks.judge_cases(order.own)


def answer(order: Order, rows: list[dict]) -> Iterator[str]:
    """How the cases ended; what nobody can explain by name."""
    from engine.excursions import own_words

    counts = Counter(str(row["verdict"]) for row in rows)
    yield f"{len(rows)} cases: {', '.join(f'{count} {word}' for word, count in counts.most_common())}."
    judged = [row for row in rows if row["verdict"] == "ok" and math.isfinite(known(row, "measured_tension"))]
    silent = [known(row, "measured_tension") for row in judged if not own_words(row.get("message") or "")]
    if silent:
        said = f"Largest tensions are off by {100.0 * max(silent):.2g} % at most in {len(silent)} runs that say nothing"
        yield f"{said}; {len(judged) - len(silent)} more say how far theirs hold."
    strange = [str(row["case"]) for row in rows if row["verdict"] == "unexplained"]
    if strange:
        yield f"Unexplained: {'; '.join(strange)[:200]}."


STUDY = Study(
    name="stability",
    protocol=__doc__,
    options=options,
    read=read,
    parameters=lambda order: {name: getattr(order.own, name) for name in ("quick", "drift_periods")},
    done=done,
    answer=answer,
    backends=False,
    strict=True,
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
