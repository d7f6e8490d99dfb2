"""Exponents and regimes of a buoy sweep, with the evidence for the runs nearest the paper's two; only if asked for."""

from __future__ import annotations

import math

from analysis import read_evidence

from ..figures.curves import Curve, Panel, curves
from ..figures.motion import settled
from ..parts.content import Figure, Heading, Item, Table, Text, heads
from ..parts.wording import decimals, printed
from .figures import EXPONENTS
from .runs import PAPER_STEEPNESS, Run, Sweep
from .tables import sweep_table

_DEFINED = (
    "A motion is called chaotic only if its largest exponent is positive by two errors, the 0-1 test exceeds 0.9, and "
    "a nonlinear forecast beats 95 % of surrogates, in the whole record and in both halves, and if the run at a tenth "
    "of the tolerance is chaotic too (`regime_tighter`). A chaotic transient longer than the record is not told from "
    "chaos. What fulfils no definition is undecided."
)


def regime_items(sweep: Sweep) -> list[Item]:
    """The section, or nothing where no run has a regime."""
    if not sweep.judged:
        return []
    caption = f"Regime and largest exponent with one standard error, after the first {sweep.transient} wave periods."
    names = ("steepness", "regime", *EXPONENTS)
    table = sweep_table(sweep, names, sweep.judged, caption)
    items: list[Item] = [Heading("Exponents and regimes"), Text(_DEFINED), table]
    nearest = [(min(sweep.judged, key=lambda run: abs(run.steepness - kA)), kA) for kA in PAPER_STEEPNESS]
    shown = list(dict.fromkeys(run for run, kA in nearest if abs(run.steepness - kA) <= 0.01))
    for run in shown:
        heading = Heading(f"Why {run.named} is called {run['regime']}", 2)
        items += [heading, found] if (found := evidence_table(run)) else []
    return items + _convergence(sweep, shown)


def evidence_table(run: Run) -> Table | None:
    """The tests behind the regime, as the row has them (`analysis.evidence_text`)."""
    tests = read_evidence(run["evidence"])
    if not tests:
        return None
    columns = heads("test", ("value", ""), ("threshold", ""), ("met", ""))
    reason = printed(run["regime_reason"].strip()) or "no reason told"
    caption = f"Evidence at {run.named}, in the order of the tests: {reason}."
    rows = tuple((name, *(cell.replace("-", "−") for cell in cells)) for name, *cells in tests)
    return Table(columns, rows, caption, small=True)


def _convergence(sweep: Sweep, shown: list[Run]) -> list[Item]:
    """Exponent found so far against the time used, by Wolf's method; nothing where it found none."""
    from analysis import wolf_lyapunov

    lines = []
    for run, dash in zip((run for run in shown if run.has_record), ("-", "--"), strict=False):
        trajectory = sweep.trajectory(run)
        step_s, period_s = trajectory.scene.sample_step_s(), trajectory.scene.waves.period_s
        after = round(sweep.transient * period_s / step_s)
        wolf = wolf_lyapunov(trajectory.columns["radius_m"][after:], step_s)
        if wolf.found and "run" in wolf.details:
            one = wolf.details["run"]
            bits = one.convergence * period_s / math.log(2.0)
            lines.append(Curve(one.time_s / period_s, bits, run.named, dash, width=1.2))
    if not lines:
        return []
    labels = (r"$t/T_i$ (wave periods)", r"$\sigma_m$ (bits per period)")
    limits = {"ylim": settled([line.y for line in lines])}
    picture = curves([[Panel(lines, *labels, level=0.0, settings=limits)]], 2.8, "best")
    ends = "; ".join(f"{decimals(float(line.y[-1]), 3)} at {line.name}" for line in lines)
    caption = (
        "Largest exponent of r(t) by the method of Wolf et al. against the length of the record used (fig. 14 of the "
        f"paper; one of the settings of the plateau). At the end: {ends} bits per wave period. From `radius_m`."
    )
    alt = f"Convergence of Wolf's exponent over the record: {ends} at the end."
    return [Heading("Convergence of Wolf's exponent", 2), Figure(picture, caption, alt)]
