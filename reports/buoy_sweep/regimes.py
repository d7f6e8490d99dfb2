"""Exponents and regimes of a buoy sweep, with the evidence for the runs nearest the paper's two; only if asked for."""

from __future__ import annotations

import math

import numpy as np

from ..figures.exponents import convergence
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.folder import Folder
from ..parts.symbols import T_I
from ..parts.wording import EMPTY, decimals, number, printed
from .motion import verdict_of
from .runs import PAPER_STEEPNESS, Run, linked, load, value

EXPONENTS = (
    ("tangent dynamics", "lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"),
    ("Wolf, of r", "lyapunov_wolf_bits_per_period", "lyapunov_wolf_error"),
)


def judged(runs: tuple[Run, ...]) -> list[Run]:
    """The runs with a regime."""
    return [run for run in runs if run.row["regime"]]


def exponent_curves(runs: list[Run]) -> list[tuple[str, np.ndarray, np.ndarray]]:
    """Label, values and errors (p,) of each exponent over the runs, bits per period; NaN where there is none."""
    curves = []
    for label, column, error in EXPONENTS:
        values = np.array([value(run, column) for run in runs])
        errors = np.array([value(run, error) for run in runs])
        if np.isfinite(values).any():
            curves.append((label, values, errors))
    return curves


def regime_items(folder: Folder, runs: tuple[Run, ...], transient: int) -> list[Item]:
    """The section, or nothing where no run has a regime."""
    found = judged(runs)
    if not found:
        return []
    items: list[Item] = [
        Heading("Exponents and regimes"),
        Text(
            "A motion is called chaotic only if its largest exponent is positive by two errors, the 0-1 test on the "
            "section exceeds 0.9, and a nonlinear forecast beats 95 % of linear and of noisy-periodic surrogates, in "
            "the whole record and in both halves, and if the same run at a tenth of the tolerance is chaotic too "
            "(`regime_tighter`). What fulfils no definition is undecided. A chaotic transient longer than the record "
            "is not told from chaos, and weak chaos needs long records: 0.06 bits a period took 7000 periods."
        ),
        _table(found, transient),
    ]
    curves = []
    for steepness in PAPER_STEEPNESS:
        run = min(found, key=lambda one: abs(one.steepness - steepness))
        if abs(run.steepness - steepness) > 0.01 or any(run.steepness == done for done, *_ in curves):
            continue
        trajectory = load(folder, run)
        if trajectory is None:
            continue
        verdict, _, wolf = verdict_of(trajectory, transient, run.row.get("regime_tighter") or None)
        items += _why(run, verdict)
        if wolf.found and "run" in wolf.details:
            one = wolf.details["run"]
            period_s = trajectory.scene.waves.period_s
            curves.append((run.steepness, one.time_s / period_s, one.convergence * period_s / math.log(2.0)))
    if curves:
        items += [Heading("Convergence of Wolf's exponent", 2), _convergence(curves)]
    return items


def _table(runs: list[Run], transient: int) -> Table:
    sigmas = (Column(f"σ, {label}", f"bits/{T_I}") for label, *_ in EXPONENTS)
    heads = (Column("kA"), Column("regime", align="left"), *sigmas)
    rows = tuple(
        (linked(run), run.row["regime"], *(_with_error(run, *names) for _, *names in EXPONENTS)) for run in runs
    )
    caption = (
        f"Regime and largest exponent with one standard error, of what follows the first {transient} wave periods. "
        "From `regime`, `lyapunov_tangent_bits_per_period` and `lyapunov_wolf_bits_per_period` of `table.csv`."
    )
    return Table(heads, rows, caption, small=True)


def _with_error(run: Run, column: str, error: str) -> str:
    found = value(run, column)
    return EMPTY if math.isnan(found) else f"{decimals(found, 3)} ± {decimals(value(run, error), 3)}"


def _why(run: Run, verdict) -> list[Item]:
    left = {"align": "left"}
    numbers = (Column("value"), Column("threshold"), Column("met"))
    heads = (Column("test", **left), *numbers, Column("what it says", **left))
    words = {True: "yes", False: "no", None: EMPTY}
    rows = tuple(
        (item.name, _short(item.value), _short(item.threshold), words[item.passed], printed(item.sentence))
        for item in verdict.evidence
    )
    caption = f"Evidence at kA = {number(run.steepness)}, in the order of the tests: {printed(verdict.reason)}."
    return [
        Heading(f"Why kA = {number(run.steepness)} is called {verdict.regime}", 2),
        Table(heads, rows, caption, small=True),
    ]


def _short(found: float) -> str:
    return number(float(f"{found:.3g}")) if math.isfinite(found) else EMPTY


def _convergence(curves: list) -> Figure:
    ends = "; ".join(f"{decimals(float(bits[-1]), 3)} at kA = {number(steepness)}" for steepness, _, bits in curves)
    labelled = [(f"kA = {number(steepness)}", periods, bits) for steepness, periods, bits in curves]
    caption = (
        "Largest exponent of r(t) by the method of Wolf et al. against the length of the record used (fig. 14 of the "
        f"paper; one of the settings of the plateau). At the end: {ends} bits per wave period. From `radius_m`."
    )
    return Figure(convergence(labelled), caption, f"Convergence of Wolf's exponent over the record: {ends} at the end.")
