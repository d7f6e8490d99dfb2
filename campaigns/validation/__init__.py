"""Beside measurements, other codes and exact solutions: every case with its source, a bar and a verdict, and a report.

    python -m campaigns.validation                              all cases, in about five minutes on two cores
    python -m campaigns.validation --quick                      those that take no long run, in half a minute
    python -m campaigns.validation --only lindahl-1.25 jumper-4

Protocol: cases, their sources, assumptions and bars are in cases.toml and were set before the runs. Coefficients are
those of the sources; grids and steps come from refinement, told there. A time shift between two records, which no
source gives, is fitted, told in the row, and not judged. A code that is not installed is a row that says so.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import engine
from campaigns.machinery import Plan, cli, machine, run, write_scene
from campaigns.study import Order, Study
from campaigns.validation.cases import CASES, HOLDS, JUDGED, MISSES, NOT_RUN, QUICK, Case, missing
from tables import Rows, counted, read_table, write_table


@dataclass
class Options(cli.Options):
    """The options of this campaign. cases: what they ask for."""

    only: list[str] | None = cli.option("NAME ...", "some cases", cli.one_of(tuple(CASES)), many=True)
    quick: bool = cli.flag(f"the cases without long runs: {' '.join(QUICK)}")
    cases: tuple[Case, ...] = ()

    def read(self, faults: list[str]) -> None:
        """The cases."""
        chosen = self.only or (QUICK if self.quick else CASES)
        self.cases = tuple(CASES[name] for name in CASES if name in chosen)
        if self.only is None:
            return
        reasons = [missing(case) for case in self.cases]
        if all(reasons):
            faults.append(f"--only: given {' '.join(chosen)}: {reasons[0]}; allowed: a case that can be run here")


def perform(order: Order):
    """All runs, side by side; then each case beside its source."""
    from campaigns.validation import cases, judging
    from engine.atomic import write_atomic

    out = order.how.out
    plan = Plan(order.how, order.simulate or engine.simulate, counted, cases.COLUMNS)
    jobs = cases.jobs(order.options.cases)
    write_scene(out, STUDY.name, jobs)
    summary = run(plan, jobs)
    rows, points = judging.judged(out, order.options.cases)
    write_table(out / "cases.csv", JUDGED, rows)
    write_table(out / "curves.csv", judging.POINTS, points)
    write_atomic(out / "cases.md", judging.page(rows).encode())
    return summary


def parameters(order: Order) -> dict:
    from campaigns.accuracy.jobs import version
    from campaigns.accuracy.plan import PEERS

    asked = {case.options.get("peer") for case in order.options.cases}
    peers = {peer.name: version(peer) or "(not installed)" for peer in PEERS if peer.name in asked}
    return {"cases": [case.name for case in order.options.cases], "peers": peers, "machine": machine()}


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """How many cases hold, which miss and by how much, the one nearest to its bar, what was not run."""

    judged = read_table(order.how.out / "cases.csv")
    rows_of_verdicts = {HOLDS: [], MISSES: [], NOT_RUN: []}
    for row in judged:
        rows_of_verdicts.setdefault(row["verdict"], []).append(row)
    holding, missed = rows_of_verdicts[HOLDS], rows_of_verdicts[MISSES]
    held = _cases(holding).keys() - _cases(missed).keys()
    yield f"{len(held)} of {len(_cases(judged))} cases hold."
    for row in missed:
        yield f"Misses: {row['case']}, {row['quantity']}: {error_in_words(row)}."
    if holding:
        nearest = max(holding, key=lambda row: row["error"] / row["bar"])
        words = f"{nearest['case']}, {nearest['quantity']}: {error_in_words(nearest)}"
        yield f"Nearest to its bar of those that hold: {words}."
    if rows_of_verdicts[NOT_RUN]:
        yield f"Not run: {', '.join(_cases(rows_of_verdicts[NOT_RUN]))}."


def _cases(rows: Rows) -> dict[str, None]:
    """The cases of rows, each once, in their order."""
    return dict.fromkeys(row["case"] for row in rows)


def error_in_words(row: dict) -> str:
    """The error of a row with its bar."""
    if row["error"] != row["error"]:
        return row["note"]
    return f"{row['error']:.4g} {row['unit']}, bar {row['bar']:g}"


STUDY = Study(
    name="validation", protocol=__doc__, options=Options, parameters=parameters, perform=perform, answer=answer
)
main, read_order = STUDY.main, STUDY.read_order
