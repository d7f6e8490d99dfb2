"""The cases of `campaigns.stability`, read from cases.toml, each run to a verdict in a process with a time limit.

A verdict is one of
    ok           ended as asked, and the check is below its bar
    refused      not started, with a reason: a scene that is not accepted, or one without static equilibrium
    known limit  what the case says to expect: an early end with a status it names, or a check above its bar
    unexplained  anything else; the campaign then ends with exit code 1
"""

import copy
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from campaigns.machinery import CampaignStopped, write_failure
from campaigns.stability import checks
from campaigns.stability.limits import DONE, limited, outcome_of
from engine import SceneError, load_scene, simulate
from tables import MESSAGE, RUN_KEY, STATISTICS, STATUS, Column, Row, finite, names, of_words

REFUSED, ABOVE_BAR = "refused", "above bar"
LIMIT_S, DRIFT_LIMIT_S = 300.0, 1800.0
DRIFT_BAR = 0.01
OK, LIMIT, UNEXPLAINED = "ok", "known limit", "unexplained"
_NOT_SAVED = "not saved"
NEEDS_PROFILES = ("energy", "buckling", "straight")
FILE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
COLUMNS = (
    of_words("part", "case: one run that is judged"),
    of_words("group", "what is extreme in the case"),
    of_words("about", "the group in words"),
    of_words("case", "the case within its group"),
    Column("dimensions", "", "D", "dimensions of the motion", 0),
    of_words("verdict", "ok, refused, known limit or unexplained"),
    of_words("run_status", "how the run ended", "ended"),
    Column("measured", "", "measured", "the number that the check measured", 4),
    Column("bar", "", "bar", "what the number has to stay below", 4),
    Column("stiffness_N", "N", "EA", "stiffness of a linear tension law", 0),
    Column(
        "measured_tension", "", "tension", "how far the largest tension at the top is off, over that of the check", 4
    ),
    Column("bar_tension", "", "its bar", "what that has to stay below where the run does not say that it is off", 4),
    of_words("how", "the check", "how we know"),
    of_words("warning", "what the run says of its own accuracy"),
    of_words("limit", "why another ending is expected", "why"),
    Column("length_s", "s", "run", "length of the run that was asked for", 2),
    *STATISTICS,
    Column("case_wall_s", "s", "wall", "wall-clock time of all runs of the case", 2),
    STATUS,
    RUN_KEY,
    MESSAGE,
)


@dataclass(frozen=True)
class Case:
    """One row of the table.

    changes: keys of the scene; check: a function of `campaigns.stability.checks`; bar: what the number that it measures
    must stay below, bar_tension: likewise of the largest tension at the top, where the run does not say that it does
    not resolve it; quick: whether the case is also part of `--quick`. statuses: what is expected besides "ok" with the
    check below its bar: early ends, REFUSED for a scene that the engine does not accept, ABOVE_BAR for a check that may
    fail; why: the reason.
    """

    group: str
    name: str
    changes: dict
    length_s: float = 10.0
    check: str = "refined"
    bar: float = 0.02
    bar_tension: float = 0.03
    statuses: tuple[str, ...] = ()
    why: str = ""
    quick: bool = False
    options: dict = field(default_factory=dict)


def drift_case(periods: int) -> Case:
    """The long regular run, strobed at the wave period."""
    scene, options = {**FILE["sets"]["regular"], "output.step_s": 5.0}, {"limit_s": DRIFT_LIMIT_S}
    return Case("drift", f"{periods} regular waves", scene, 5.0 * periods, "drift", DRIFT_BAR, options=options)


def all_cases() -> list[Case]:
    """Every case, in the order of the report."""
    cases = []
    for group, rows in FILE["cases"].items():
        for row in rows:
            cases += _cases(group, row)
    return cases


def _cases(group: str, row: dict) -> Iterator[Case]:
    """The cases of a row of cases.toml: one, or one for each place in the lists of `vary`."""
    row = copy.deepcopy(row)
    fixed = {}
    for name in row.pop("sets", ()):
        fixed |= FILE["sets"][name]
    fixed |= row.pop("changes", {})
    if "ending" in row:
        row |= FILE["endings"][row.pop("ending")]
    varied = row.pop("vary", {})
    quick = row.pop("quick", False)
    length_s = row.pop("length_s", Case.length_s)
    name = row.pop("name")
    places = list(zip(*varied.values(), strict=True)) or [()]
    for place, values in enumerate(places):
        changes = fixed | dict(zip(varied, values, strict=True))
        for key, value in changes.items():
            if value == "none":
                changes[key] = None
        is_quick, seconds = quick, length_s
        if isinstance(quick, list):
            is_quick = place in quick
        if isinstance(length_s, list):
            seconds = length_s[place]
        yield Case(group, name.format(*values), changes, seconds, **row, quick=is_quick)


def case_row(case: Case, path: Path | None = None) -> Row:
    """The row of a case; its run is saved under `path` where one is given.

    Raises CampaignStopped where that cannot be written: it says nothing of the case.
    """
    way, answer, wall_s = limited(lambda: _judged(case, path), case.options.get("limit_s", LIMIT_S))
    if way != DONE:
        answer = {"verdict": UNEXPLAINED, "run_status": way, "message": answer}
    if _NOT_SAVED in answer:
        raise CampaignStopped(answer[_NOT_SAVED])
    row = {"part": "case", "group": case.group, "case": case.name, "length_s": case.length_s, "bar": case.bar}
    row |= {"about": FILE["about"].get(case.group, case.group)}
    row |= {"dimensions": case.changes.get("motion.dimensions", 2), "case_wall_s": wall_s, **answer}
    if row.get("measured_tension") is not None:
        row["bar_tension"] = case.bar_tension
    row["status"] = UNEXPLAINED if row["verdict"] == UNEXPLAINED else "ok"
    return row


def _judged(case: Case, path: Path | None) -> Row:
    changes = dict(case.changes)
    if case.check in NEEDS_PROFILES or (case.check == "stays" and changes.get("buoy", 1) is None):
        changes["output.profiles"] = True
    try:
        scene = load_scene("tethered_buoy", changes)
        with np.errstate(all="ignore"):
            run = simulate(scene, duration_s=case.length_s)
    except (SceneError, ValueError) as error:
        verdict = UNEXPLAINED
        if REFUSED in case.statuses:
            verdict = REFUSED
        return {"verdict": verdict, "run_status": REFUSED, "message": str(error), "how": "refused in words"}
    if path is not None:
        try:
            run.save(path, {"run_key": path.stem})
        except OSError as error:
            return {_NOT_SAVED: write_failure(path.parents[1], error)}
    row = {name: run.statistics.get(name) for name in names(STATISTICS)}
    row |= {"run_status": run.status, "message": run.message, "warning": run.own_message}
    outcome = outcome_of(run, case.length_s)
    if outcome not in ("ok", "ended"):
        return row | {"verdict": UNEXPLAINED, "run_status": outcome}
    if run.status != "ok":
        verdict = REFUSED if run.status == "statics-failed" else LIMIT
        if run.status not in case.statuses:
            verdict = UNEXPLAINED
        return row | {"verdict": verdict, "how": "ended with its reason", "limit": case.why}
    measured, way, tension = getattr(checks, case.check)(run, case)
    row |= {"verdict": OK, "how": way}
    holds = run.own_message or tension is None or tension <= case.bar_tension
    right = measured <= case.bar and holds  # neither where a number is nan
    if not right and ABOVE_BAR in case.statuses:
        row |= {"verdict": LIMIT, "limit": case.why}
    elif not right:
        row["verdict"] = UNEXPLAINED
    row |= {"measured": finite(measured), "measured_tension": finite(tension)}
    return row | {"stiffness_N": finite(getattr(scene.tether.tension, "stiffness_N", None))}
