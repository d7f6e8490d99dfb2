"""The runs of a breaking-line folder as its statements see them: rows of numbers, in the order of the table.

A row has the columns of table.csv as numbers (nan where the table is empty) and, of a case whose file can be read, the
numbers of `from_motion`, its static strain, and `steepening`: by how much a wave at 0.99 of that strain is faster than
at it, as a share.
"""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from campaigns.breaking_line.theory import theory_of
from campaigns.machinery import run_of
from tables import Row as Line
from tables import read_table

FAST, SLOW = ("1", "2", "3", "4"), ("1p", "2p", "3p", "4p")
CASES = (*FAST, *SLOW)
FRONT = 0.02  # of the static tension lost, of the end speed gained: where a front is taken to be
MOST_OF = 0.99  # of the settled speed at which it counts as reached
OVER_CASE_4 = {"force_over_4": "force_N", "front_over_4": "front_speed_theory_mps"}
PRINTED = {  # of the four tensions: strain, and share of the strength, which case 4 has
    "printed_strain": (0.099, 0.178, 0.228, 0.292),
    "printed_share": (0.10, 0.40, 0.70, 1.0),
}


def read_lines(folder: Path) -> tuple[Line, ...]:
    """Every run of the folder's table. Raises OSError, ValueError (`tables.read_rows`)."""
    lines = []
    for line in read_table(folder / "table.csv"):
        run = motion_of(folder, line)
        if run is not None:
            line |= _from_theory(run)
        if run is not None and run.profiles is not None:
            line |= from_motion(line, run.profiles)
        lines.append(line)
    return over_case_4(lines)


def _from_theory(run) -> Line:
    """Static strain and `steepening` of a run; nothing where its law has no theory."""
    theory = theory_of(run.scene, float(run.columns["time_s"][-1]))
    if theory is None:
        return {}
    strain = theory.speeds.strain0
    near, at_rest = theory.wave_speed(0.99 * strain), theory.wave_speed(strain)
    return {"static_strain": strain, "steepening": float(near / at_rest - 1.0)}


def motion_of(folder: Path, line: Line) -> object | None:
    """The trajectory of a case that ended as asked; None where there is none."""
    return run_of(folder, line) if line["kind"] == "case" else None


def from_motion(line: Line, profiles: object) -> Line:
    """What single profiles show.

    tension_behind   median |T| over the static one between slack front and broken end, when the wave is half way
    fronts_apart     distance, then, of the foremost nodes without FRONT of the tension and with FRONT of the end speed,
                     over the length of the line
    reached_s        when the broken end first has MOST_OF of its settled speed
    """
    measures = {}
    fast = profiles.speed_mps[:, -1] >= MOST_OF * line["end_speed_mps"]
    if fast.any():
        measures["reached_s"] = float(profiles.time_s[int(np.argmax(fast))])
    if math.isnan(line["arrival_theory_s"]):
        return measures
    row = int(np.argmin(np.abs(profiles.time_s - 0.5 * line["arrival_theory_s"])))
    tension, speed, s = profiles.tension_N[row], profiles.speed_mps[row], profiles.s_m
    front_m = s[-1] - line["slack_front_speed_theory_mps"] * (profiles.time_s[row] - line["breaking_time_s"])
    if (s > front_m).any():
        measures["tension_behind"] = float(np.median(np.abs(tension[s > front_m])) / line["force_N"])
    loose, moving = tension < (1.0 - FRONT) * line["force_N"], speed > FRONT * line["end_speed_mps"]
    if loose.any() and moving.any():
        measures["fronts_apart"] = float(abs(s[int(np.argmax(loose))] - s[int(np.argmax(moving))]) / s[-1])
    return measures


def over_case_4(lines: Sequence[Line]) -> tuple[Line, ...]:
    """The lines, with force and front speed over those of case 4, and with what the paper prints of their tension."""
    strongest = ended(lines).get("4")
    wider_lines = []
    for line in lines:
        further = {}
        for name, column in OVER_CASE_4.items():
            further[name] = line[column] / strongest[column] if strongest else math.nan
        for name, printed in PRINTED.items():
            further[name] = printed[int(line["case"][0]) - 1]
        wider_lines.append(line | further)
    return tuple(wider_lines)


def named(case: str) -> str:
    """A case of the command line as the paper writes it: 4, 4′."""
    return case.replace("p", "′")


def ended(lines: Sequence[Line], kind: str = "case") -> dict[str, Line]:
    """The runs of one kind that ended as asked, by case."""
    return {line["case"]: line for line in lines if line["kind"] == kind and line["status"] == "ok"}


def pairs(lines: Sequence[Line]) -> list[tuple]:
    """Fast and slow break of the same tension, where both ended as asked."""
    cases, matches = ended(lines), []
    for fast, slow in zip(FAST, SLOW, strict=True):
        if fast in cases and slow in cases:
            matches.append((cases[fast], cases[slow]))
    return matches
