"""Is the paper's statement on figure 20 borne out? In words computed from the table of the out-of-plane campaign."""

from __future__ import annotations

from ..parts.wording import count, number, percent
from .runs import BODIES, Run, Study
from .words import metres, speed

COMPARABLE = 1.0 / 3.0  # share of the in-plane motion from which a lateral motion is called comparable with it


def verdict_words(study: Study) -> str:
    """The paper's statement on figure 20, which shows the buoy: borne out or not for each wave, in a sentence."""
    small, large = study.steepnesses[0], study.base["steepness"]
    parts = []
    calm = calm_runs(study)
    if calm:
        word = "is not borne out" if any(_grows(run) for run in calm) else "is borne out"
        parts.append(f"at kA = {number(small)} “does not grow” {word}")
    runs = [run for run in large_runs(study) if not run["profiles"] and run.known("buoy_share_of_inplane")]
    if runs:
        grows = any(run["buoy_motion"] == "growth" for run in runs)
        reaches = max(run["buoy_share_of_inplane"] for run in runs) >= COMPARABLE
        word = ("is not borne out", "is borne out in part", "is borne out")[grows + reaches]
        claim = "“grows exponentially and becomes comparable with the motion in the plane”"
        parts.append(f"at kA = {number(large)} {claim} {word}")
    return f"The paper's statement on figure 20, of the buoy: {'; '.join(parts)}." if parts else ""


def claim_words(study: Study) -> list[str]:
    """Whether the paper's statement on the large wave is borne out: growth, then size, for buoy and rope apart."""
    runs = [run for run in large_runs(study) if not run["profiles"]]
    if not runs:
        return []
    growing = [run for run in runs if _grows(run)]
    verdict = "is not borne out" if not growing else "is borne out" + ("" if len(growing) == len(runs) else " in part")
    found = "in none of" if not growing else f"in {len(growing)} of"
    lines = [*_calm_words(study)]
    lines += [
        f"The paper's “grows exponentially” {verdict} at kA = {number(study.base['steepness'])}: exponential growth is "
        f"found {found} {count(len(runs), 'run')} with a push out of the plane."
    ]
    for body in BODIES:
        shares = [run for run in runs if run.known(f"{body}_share_of_inplane")]
        if not shares:
            continue
        most = max(shares, key=lambda run: run[f"{body}_share_of_inplane"])
        share = most[f"{body}_share_of_inplane"]
        word = "is borne out" if share >= COMPARABLE else "is not borne out"
        lines.append(
            f"“Comparable with the in-plane motion” (a third of it, or more) {word} for the {body}: its largest "
            f"lateral distance in any of these runs is {metres(most[f'{body}_lateral_max_m'])}, {percent(share)} of "
            f"the in-plane half range of the buoy ({number(most['inplane_m'], 3)} m; {_where(most)})."
        )
    shape = study.one(profiles=1, nodes=None)
    if shape is not None and shape.known("bow_inplane_m"):
        share = shape["bow_lateral_m"] / shape["bow_inplane_m"]
        lines.append(
            f"By the rope's own measure, in its first {number(shape['periods'])} periods it bows out of the straight "
            f"line between its ends by up to {metres(shape['bow_inplane_m'])} in the plane and "
            f"{metres(shape['bow_lateral_m'])} across it ({percent(share)})."
        )
    return lines


def _calm_words(study: Study) -> list[str]:
    small, runs = study.steepnesses[0], calm_runs(study)
    if not runs:
        return []
    growing = sum(map(_grows, runs))
    decaying = sum(run["buoy_motion"] == run["rope_motion"] == "decay" for run in runs)
    word = "is borne out" if not growing else "is not borne out"
    return [
        f"The paper's “does not grow” {word} at kA = {number(small)}: of {count(len(runs), 'run')} {growing} grow, and "
        f"{decaying} decay exponentially."
    ]


def large_runs(study: Study) -> list[Run]:
    """Every run of the large wave in three dimensions that was pushed out of the plane and ended as asked."""
    large = study.base["steepness"]
    return [
        run
        for run in study.runs
        if run.ok and run["steepness"] == large and run["dimensions"] == 3 and run["seed_direction"] != "along"
    ]


def calm_runs(study: Study) -> list[Run]:
    """Every run of the small wave in three dimensions that ended as asked."""
    small = study.steepnesses[0]
    if small == study.base["steepness"]:
        return []
    return [run for run in study.runs if run.ok and run["steepness"] == small and run["dimensions"] == 3]


def _grows(run: Run) -> bool:
    return any(run[f"{body}_motion"] == "growth" for body in BODIES)


def _where(run: Run) -> str:
    return (
        f"H = {number(run['depth_m'])} m, EI = {number(run['bending_stiffness_Nm2'])} N m², "
        f"{number(run['nodes'])} nodes, push {speed(run['seed_mps'])} {run['seed_direction']}"
    )
