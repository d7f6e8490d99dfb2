"""Exponents and regimes of a buoy sweep, with the evidence for the runs nearest the paper's two; only if asked for."""

from __future__ import annotations

import math

from analysis import read_evidence

from ..figures.exponents import convergence
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.wording import decimals, number, printed
from .figures import EXPONENTS
from .runs import PAPER_STEEPNESS, Run, Sweep
from .tables import sweep_table


def regime_items(sweep: Sweep) -> list[Item]:
    """The section, or nothing where no run has a regime."""
    if not sweep.judged:
        return []
    caption = f"Regime and largest exponent with one standard error, after the first {sweep.transient} wave periods."
    names = ("steepness", "regime", *((value, error) for value, error, _ in EXPONENTS))
    items: list[Item] = [
        Heading("Exponents and regimes"),
        Text(
            "A motion is called chaotic only if its largest exponent is positive by two errors, the 0-1 test on the "
            "section exceeds 0.9, and a nonlinear forecast beats 95 % of linear and of noisy-periodic surrogates, in "
            "the whole record and in both halves, and if the same run at a tenth of the tolerance is chaotic too "
            "(`regime_tighter`). What fulfils no definition is undecided. A chaotic transient longer than the record "
            "is not told from chaos, and weak chaos needs long records: 0.06 bits a period took 7000 periods."
        ),
        sweep_table(sweep, names, sweep.judged, caption),
    ]
    nearest = [min(sweep.judged, key=lambda run: abs(run.steepness - kA)) for kA in PAPER_STEEPNESS]
    close = (run for run, kA in zip(nearest, PAPER_STEEPNESS, strict=True) if abs(run.steepness - kA) <= 0.01)
    shown = list(dict.fromkeys(close))
    for run in shown:
        heading = Heading(f"Why kA = {number(run.steepness)} is called {run['regime']}", 2)
        items += [heading, table] if (table := evidence_table(run)) else []
    if figure := _convergence(sweep, shown):
        items += [Heading("Convergence of Wolf's exponent", 2), figure]
    return items


def evidence_table(run: Run) -> Table | None:
    """The tests behind the regime, as the row has them (`analysis.evidence_text`)."""
    tests = read_evidence(run["evidence"])
    if not tests:
        return None
    heads = (Column("test", align="left"), Column("value"), Column("threshold"), Column("met"))
    reason = printed(run["regime_reason"].strip())
    caption = f"Evidence at kA = {number(run.steepness)}, in the order of the tests" + (
        f": {reason}." if reason else "."
    )
    rows = tuple((name, *(cell.replace("-", "−") for cell in cells)) for name, *cells in tests)
    return Table(heads, rows, caption, small=True)


def _convergence(sweep: Sweep, shown: list[Run]) -> Figure | None:
    from analysis import wolf_lyapunov

    curves = []
    for run in (run for run in shown if run.has_record):
        trajectory = sweep.trajectory(run)
        step_s, period_s = trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
        after = round(sweep.transient * period_s / step_s)
        wolf = wolf_lyapunov(trajectory.columns["radius_m"][after:], step_s)
        if wolf.found and "run" in wolf.details:
            one = wolf.details["run"]
            bits = one.convergence * period_s / math.log(2.0)
            curves.append((f"kA = {number(run.steepness)}", one.time_s / period_s, bits))
    if not curves:
        return None
    ends = "; ".join(f"{decimals(float(bits[-1]), 3)} at {name}" for name, _, bits in curves)
    caption = (
        "Largest exponent of r(t) by the method of Wolf et al. against the length of the record used (fig. 14 of the "
        f"paper; one of the settings of the plateau). At the end: {ends} bits per wave period. From `radius_m`."
    )
    return Figure(convergence(curves), caption, f"Convergence of Wolf's exponent over the record: {ends} at the end.")
