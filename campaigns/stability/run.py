"""One case of `campaigns.stability` from scene to row, in a process of its own with a time limit.

A verdict is one of
    ok           ended as asked, and the check is below its bar
    refused      not started, with a reason: a scene that is not accepted, or one without static equilibrium
    known limit  what the case says to expect: an early end with a status it names, or a check above its bar
    unexplained  anything else; the campaign then ends with exit code 1
"""

import math
from pathlib import Path

from campaigns.columns import Column
from campaigns.machinery.folder import CampaignStopped
from campaigns.machinery.runner import write_failure
from campaigns.stability.cases import ABOVE_BAR, Case
from campaigns.stability.limited import DIED, DONE, LATE, RAISED, limited

LIMIT_S = 300.0
OK, REFUSED, LIMIT, UNEXPLAINED = "ok", "refused", "known limit", "unexplained"
_NOT_SAVED = "not saved"
NEEDS_PROFILES = ("energy", "buckling", "straight")
COLUMNS = tuple(map(Column, (
    "part", "group", "case", "dimensions", "verdict", "run_status", "measured", "bar", "how", "limit", "length_s",
    "end_time_s", "steps", "rejected_steps", "newton_iterations", "newton_failures", "loop_releases", "max_turn_rad",
    "min_strain", "wall_s", "case_wall_s", "status", "run_key", "message",
)))  # fmt: skip
STATISTICS = (
    "end_time_s", "steps", "rejected_steps", "newton_iterations", "newton_failures", "loop_releases", "max_turn_rad",
    "min_strain", "wall_s",
)  # fmt: skip


def case_row(case: Case, path: Path | None = None) -> dict[str, object]:
    """The row of a case; its run is saved under `path` where one is given.

    Raises CampaignStopped where that cannot be written: it says nothing of the case.
    """
    row = {"part": "case", "group": case.group, "case": case.name, "length_s": case.length_s, "bar": case.bar}
    row["dimensions"] = case.changes.get("motion.dimensions", 2)
    limit_s = case.options.get("limit_s", LIMIT_S)
    kind, answer, wall_s = limited(lambda: _judged(case, path), limit_s)
    if kind == DONE and (fault := answer.pop(_NOT_SAVED, "")):
        raise CampaignStopped(fault)
    if kind == DONE:
        row |= answer
    else:
        said = {
            LATE: ("hang", f"no answer within {limit_s:g} s of computing"),
            DIED: ("crash", f"its process ended with exit code {answer}"),
            RAISED: ("traceback", answer[2] if kind == RAISED else ""),
        }
        row["run_status"], row["message"] = said[kind]
        row["verdict"] = UNEXPLAINED
    explained = row["verdict"] != UNEXPLAINED
    return row | {"case_wall_s": wall_s, "status": "ok" if explained else UNEXPLAINED}


def _judged(case: Case, path: Path | None) -> dict[str, object]:
    import numpy as np

    from campaigns.stability import checks
    from campaigns.stability.fuzz import outcome_of
    from engine import SceneError, load_scene, simulate

    changes = dict(case.changes)
    if case.check in NEEDS_PROFILES or (case.check == "stays" and changes.get("buoy", 1) is None):
        changes["output.profiles"] = True
    try:
        scene = load_scene(case.scene, changes)
        with np.errstate(all="ignore"):
            run = simulate(scene, duration_s=case.length_s)
    except (SceneError, ValueError) as error:
        verdict = REFUSED if REFUSED in case.ends else UNEXPLAINED
        return {"verdict": verdict, "run_status": REFUSED, "message": str(error), "how": "refused in words"}
    if path is not None:
        try:
            run.save(path, {"run_key": path.stem})
        except OSError as error:
            return {_NOT_SAVED: write_failure(path.parents[1], error)}
    row = {name: run.statistics[name] for name in STATISTICS} | {"run_status": run.status, "message": run.message}
    outcome, _, _ = outcome_of(run, case.length_s)
    if outcome not in ("ok", "ended"):
        return row | {"verdict": UNEXPLAINED, "run_status": outcome}
    if run.status != "ok":
        known = run.status in case.ends
        verdict = UNEXPLAINED if not known else REFUSED if run.status == "statics-failed" else LIMIT
        return row | {"verdict": verdict, "how": "ended with its reason", "limit": case.limit}
    measured, how = getattr(checks, case.check)(run, case)
    verdict = OK if measured <= case.bar else LIMIT if ABOVE_BAR in case.ends else UNEXPLAINED
    row |= {"verdict": verdict, "measured": measured if math.isfinite(measured) else None, "how": how}
    return row | ({"limit": case.limit} if verdict == LIMIT else {})
