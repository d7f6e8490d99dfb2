"""The short answer of the out-of-plane campaign: the paper's statement on figure 20, and the numbers that decide it."""

from __future__ import annotations

from ..parts.content import Bullets, Column, Item, Table
from ..parts.wording import number, percent
from .comparison import Pair
from .runs import BODIES, Run, Study
from .words import metres

COMPARABLE = 1.0 / 3.0  # share of the in-plane motion from which a lateral motion is called comparable with it
_BORNE_OUT = ("is not borne out", "is borne out in part", "is borne out")
_MOTION = ("motion", ("rate_bits_per_period", "rate_error"), "bursts", "burst_median_m", "lateral_max_m")


def answer_items(study: Study, pairs: list[Pair]) -> list[Item]:
    """The verdicts; the counts behind them; buoy and rope in the two runs of figure 20."""
    names = [f"{body}_{name}" if isinstance(name, str) else tuple(f"{body}_{one}" for one in name)
             for body in BODIES for name in _MOTION]  # fmt: skip
    shown = [run for steepness in study.steepnesses if (run := study.one(steepness=steepness)) is not None]
    table = study.table(["steepness", "depth_m", "seed_mps", *names], shown, "The two runs of figure 20.")
    return [Bullets((verdict(study), *_planar(pairs))), _counts(study), table]


def large_runs(study: Study) -> list[Run]:
    """Every run of the large wave that was pushed out of the plane and ended as asked, but those kept with profiles."""
    return [
        run for run in study.runs if run.pushed and run["steepness"] == study.base["steepness"] and not run["profiles"]
    ]


def calm_runs(study: Study) -> list[Run]:
    """Every run of the small wave in three dimensions that ended as asked."""
    small = study.steepnesses[0]
    if small == study.base["steepness"]:
        return []
    return [run for run in study.runs if run.ok and run["steepness"] == small and run["dimensions"] == 3]


def verdict(study: Study) -> str:
    """Whether the paper's statement on the buoy in both waves is borne out, as far as there are runs of them."""
    parts, large = [], large_runs(study)
    if calm := calm_runs(study):
        word = _BORNE_OUT[0 if any(run.grows() for run in calm) else 2]
        parts.append(f"at kA = {number(study.steepnesses[0])} “does not grow” {word}")
    if shares := [run["buoy_share_of_inplane"] for run in large if run.known("buoy_share_of_inplane")]:
        grows = any(run["buoy_motion"] == "growth" for run in large)
        claim = "“grows exponentially and becomes comparable with the motion in the plane” (a third of it, or more)"
        word = _BORNE_OUT[grows + (max(shares) >= COMPARABLE)]
        parts.append(f"at kA = {number(study.base['steepness'])} {claim} {word}")
    return f"The paper's statement on figure 20, of the buoy: {'; '.join(parts) or 'no run tells'}."


def _counts(study: Study) -> Table:
    """Of each wave: how many runs grow and decay, and the largest lateral motion of buoy and rope."""
    rows = []
    for steepness, runs in ((study.steepnesses[0], calm_runs(study)), (study.base["steepness"], large_runs(study))):
        for body in BODIES if runs else ():
            kinds = [run[f"{body}_motion"] for run in runs]
            most = max(runs, key=lambda run: run[f"{body}_lateral_max_m"])
            found = metres(most[f"{body}_lateral_max_m"]), percent(most[f"{body}_share_of_inplane"])
            at = f"{number(most['depth_m'])} m, {number(most['bending_stiffness_Nm2'])} N m², {number(most['nodes'])}"
            counts = (str(len(runs)), str(kinds.count("growth")), str(kinds.count("decay")))
            rows.append((number(steepness), body, *counts, *found, at))
    heads = ("kA", "body", "runs", "grow", "decay", "largest |y|", "of the in-plane motion", "at H, EI, nodes")
    caption = "All runs that were pushed out of the plane: how many grow or decay exponentially, and the largest."
    return Table(tuple(map(Column, heads)), tuple(rows), caption, small=True)


def _planar(pairs: list[Pair]) -> tuple[str, ...]:
    """In how many pairs the planar run is good enough."""
    if not pairs:
        return ()
    good, told = (sum(not getattr(pair, name) for pair in pairs) for name in ("lacking", "untold"))
    return (
        f"Planar runs with loop release agree with the runs in three dimensions on the buoy in {good} of {len(pairs)} "
        f"pairs, as far as the records tell ({told} tell all): range of r, section, exponent and regime. The planar "
        "run is no substitute for the rope's shape in the loops, nor for the buoy's path once the runs have parted.",
    )
