"""Beside measurements, other codes and exact solutions: every case with its source, a bar and a verdict, and a report.

    python -m campaigns.validation                              all cases, in about five minutes on two cores
    python -m campaigns.validation --quick                      those that take no long run, in half a minute
    python -m campaigns.validation --only lindahl-1.25 jumper-4

Protocol: cases, their sources, assumptions and bars are in cases.toml and were set before the runs. Coefficients are
those of the sources; grids and steps come from refinement, told there. A time shift between two records, which no
source gives, is fitted, told in the row, and not judged. A code that is not installed is a row that says so.
"""

from argparse import Namespace
from collections.abc import Iterator
from dataclasses import replace

import engine
from campaigns.machinery import cli
from campaigns.study import Order, Study
from campaigns.validation.cases import CASES, HOLDS, JUDGED, MISSES, NOT_RUN, QUICK, missing


def options(group) -> None:
    cli.add(group, "--only", "NAME ...", "some cases", cli.one_of(tuple(CASES)), many=True)
    group.add_argument("--quick", action="store_true", help=f"the cases without long runs: {' '.join(QUICK)}")


def read(options: Namespace, faults: list[str]) -> None:
    """The cases that they ask for."""
    chosen = options.only or (QUICK if options.quick else CASES)
    options.cases = tuple(CASES[name] for name in CASES if name in chosen)
    reasons = [missing(case) for case in options.cases]
    if reasons and all(reasons):
        faults.append(f"--only: given {' '.join(chosen)}: {reasons[0]}; allowed: a case that can be run here")


def done(order: Order):
    """All runs, side by side; then each case beside its source. Returns times and summary."""
    from campaigns.machinery.folder import trajectory_path, write_table
    from campaigns.machinery.plan import Plan
    from campaigns.machinery.runner import run, write_scene
    from campaigns.validation import cases, judging
    from engine.atomic import write_atomic

    out = order.how.out
    plan = Plan(order.how, order.simulate or engine.simulate, cases.run_row, cases.COLUMNS)
    jobs = cases.jobs(order.own.cases)
    write_scene(out, STUDY.name, jobs)
    finished = sum(trajectory_path(out, job.key).exists() for job in jobs)
    timing, summary = run(plan, jobs)
    rows, points = judging.judged(out, order.own.cases)
    write_table(out / "cases.csv", JUDGED, rows)
    write_table(out / "curves.csv", judging.POINTS, points)
    write_atomic(out / "cases.md", judging.page(rows).encode())
    return timing, replace(summary, computed=len(summary.rows) - finished, found=finished)


def parameters(order: Order) -> dict[str, object]:
    from campaigns.accuracy.jobs import version
    from campaigns.accuracy.plan import PEERS
    from campaigns.machinery.session import machine

    asked = {case.options.get("peer") for case in order.own.cases}
    peers = {peer.name: version(peer) or "(not installed)" for peer in PEERS if peer.name in asked}
    return {"cases": [case.name for case in order.own.cases], "peers": peers, "machine": machine()}


def answer(order: Order, rows: list[dict]) -> Iterator[str]:
    """How many cases hold, which miss and by how much, the one nearest to its bar, what was not run."""
    from campaigns.machinery.folder import read_rows

    judged = read_rows(order.how.out / "cases.csv")
    names = {word: list(dict.fromkeys(row["case"] for row in judged if row["verdict"] == word)) for word in
             (HOLDS, MISSES, NOT_RUN)}  # fmt: skip
    held = [name for name in names[HOLDS] if name not in names[MISSES]]
    yield f"{len(held)} of {len({row['case'] for row in judged})} cases hold."
    for row in (row for row in judged if row["verdict"] == MISSES):
        yield f"Misses: {row['case']}, {row['quantity']}: {said(row)}."
    close = max(
        (row for row in judged if row["verdict"] == HOLDS), key=lambda row: row["error"] / row["bar"], default=None
    )
    if close:
        yield f"Nearest to its bar of those that hold: {close['case']}, {close['quantity']}: {said(close)}."
    if names[NOT_RUN]:
        yield f"Not run: {', '.join(names[NOT_RUN])}."


def said(row: dict) -> str:
    """The error of a row with its bar."""
    if row["error"] != row["error"]:
        return row["note"]
    return f"{row['error']:.4g} {row['unit']}, bar {row['bar']:g}"


STUDY = Study(
    name="validation", protocol=__doc__, options=options, read=read, parameters=parameters, done=done, answer=answer
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
