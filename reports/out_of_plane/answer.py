"""The short answer of the out-of-plane campaign, in words computed from its table: the paper's statement on figure 20,
which shows the buoy, then what both bodies do, and what depth, stiffness, push and grid change."""

from __future__ import annotations

from ..parts.wording import count, decimals, listed, number, percent
from .comparison import Pair, comparison_words
from .runs import BODIES, Run, Study
from .words import metres, share, speed, spread

COMPARABLE = 1.0 / 3.0  # share of the in-plane motion from which a lateral motion is called comparable with it
MOST_APART = 0.2  # between grids, of the size on the finest: what is still called a limit in the mesh
_BORNE_OUT = ("is not borne out", "is borne out in part", "is borne out")


def short_answer(study: Study, pairs: list[Pair]) -> tuple[str, ...]:
    """One statement a line: verdict, both waves, the paper's claim, depth and stiffness, push, grid, planar runs."""
    large, calm = large_runs(study), calm_runs(study)
    lines = [_verdict(study, calm, large), *(_wave(study, steepness) for steepness in study.steepnesses)]
    if large:
        lines += [_calm(study, calm), _growth(study, large), *(_size(large, body) for body in BODIES), _bow(study)]
    lines += [_depths(study), _pushes(study), _grid(study), comparison_words(pairs)]
    return tuple(line for line in lines if line)


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


def _verdict(study: Study, calm: list[Run], large: list[Run]) -> str:
    parts = []
    if calm:
        word = _BORNE_OUT[0 if any(run.grows() for run in calm) else 2]
        parts.append(f"at kA = {number(study.steepnesses[0])} “does not grow” {word}")
    if shares := [run["buoy_share_of_inplane"] for run in large if run.known("buoy_share_of_inplane")]:
        grows = any(run["buoy_motion"] == "growth" for run in large)
        claim = "“grows exponentially and becomes comparable with the motion in the plane”"
        word = _BORNE_OUT[grows + (max(shares) >= COMPARABLE)]
        parts.append(f"at kA = {number(study.base['steepness'])} {claim} {word}")
    return f"The paper's statement on figure 20, of the buoy: {'; '.join(parts)}." if parts else ""


def _calm(study: Study, calm: list[Run]) -> str:
    if not calm:
        return ""
    growing = sum(run.grows() for run in calm)
    decaying = sum(run["buoy_motion"] == run["rope_motion"] == "decay" for run in calm)
    return (
        f"The paper's “does not grow” {_BORNE_OUT[0 if growing else 2]} at kA = {number(study.steepnesses[0])}: of "
        f"{count(len(calm), 'run')} {growing} grow, and {decaying} decay exponentially."
    )


def _growth(study: Study, large: list[Run]) -> str:
    growing = sum(run.grows() for run in large)
    verdict = _BORNE_OUT[(growing > 0) + (growing == len(large))]
    found = f"in {growing} of" if growing else "in none of"
    return (
        f"The paper's “grows exponentially” {verdict} at kA = {number(study.base['steepness'])}: exponential growth is "
        f"found {found} {count(len(large), 'run')} with a push out of the plane."
    )


def _size(large: list[Run], body: str) -> str:
    known = [run for run in large if run.known(f"{body}_share_of_inplane")]
    if not known:
        return ""
    most = max(known, key=lambda run: run[f"{body}_share_of_inplane"])
    part = most[f"{body}_share_of_inplane"]
    where = (
        f"H = {number(most['depth_m'])} m, EI = {number(most['bending_stiffness_Nm2'])} N m², {number(most['nodes'])} "
        f"nodes, push {speed(most['seed_mps'])} {most['seed_direction']}"
    )
    return (
        f"“Comparable with the in-plane motion” (a third of it, or more) {_BORNE_OUT[2 if part >= COMPARABLE else 0]} "
        f"for the {body}: its largest lateral distance in any of these runs is "
        f"{metres(most[f'{body}_lateral_max_m'])}, {percent(part)} of the in-plane half range of the buoy "
        f"({number(most['inplane_m'], 3)} m; {where})."
    )


def _bow(study: Study) -> str:
    shape = study.one(profiles=1, nodes=None)
    if shape is None or not shape.known("bow_inplane_m"):
        return ""
    return (
        f"By the rope's own measure, in its first {number(shape['periods'])} periods it bows out of the straight line "
        f"between its ends by up to {metres(shape['bow_inplane_m'])} in the plane and {metres(shape['bow_lateral_m'])} "
        f"across it ({percent(shape['bow_lateral_m'] / shape['bow_inplane_m'])})."
    )


def _wave(study: Study, steepness: float) -> str:
    run = study.one(steepness=steepness)
    if run is None:
        return ""
    where = f"kA = {number(steepness)}, H = {number(run['depth_m'])} m, push {speed(run['seed_mps'])}"
    if all(run[f"buoy_{key}"] == run[f"rope_{key}"] for key in ("motion", "lateral_max_m")):
        return f"{where}: buoy and rope swing together; the motion {_motion(run, 'buoy')}."
    return f"{where}: the buoy {_motion(run, 'buoy')}; the rope {_motion(run, 'rope')}."


def _motion(run: Run, body: str) -> str:
    """What one body of one run does, as the end of a sentence that begins with the body."""
    kind, most = run[f"{body}_motion"], metres(run[f"{body}_lateral_max_m"])
    if kind in ("growth", "decay"):
        rate, error = (decimals(run[f"{body}_rate_{name}"], 4) for name in ("bits_per_period", "error"))
        begin, end = (number(run[f"{body}_fit_{name}_period"], 3) for name in ("from", "to"))
        return (
            f"{'grows' if kind == 'growth' else 'decays'} exponentially by {rate}\u00a0±\u00a0{error} bits per wave "
            f"period (fitted over periods {begin} to {end}, {number(abs(run[f'{body}_fit_span_nats']), 2)} nats; "
            f"largest {most})"
        )
    if kind == "bursts":
        return (
            f"has no exponential but {count(int(run[f'{body}_bursts']), 'burst')}, the median "
            f"{metres(run[f'{body}_burst_median_m'])} and the largest {most} from the plane"
        )
    return f"has neither an exponential nor bursts; it stays within {most} of the plane"


def _depths(study: Study) -> str:
    runs = [run for run in study.select(depth_m=None, bending_stiffness_Nm2=None) if run.ok]
    if len({run["depth_m"] for run in runs}) < 2:
        return ""
    groups = {kind: sorted({run["depth_m"] for run in runs if run["rope_motion"] == kind})
              for kind in ("bursts", "growth", "decay", "neither")}  # fmt: skip
    parts = [f"{kind} at H = {listed(map(number, depths))} m" for kind, depths in groups.items() if depths]
    together = [depth for depths in groups.values() for depth in depths]
    mixed = sorted({depth for depth in together if together.count(depth) > 1})
    matters = f"matters at H = {listed(map(number, mixed))} m only" if mixed else "does not matter"
    stiffnesses = sorted({run["bending_stiffness_Nm2"] for run in runs})
    return (
        f"At kA = {number(study.base['steepness'])} the rope shows {', '.join(parts)}. Between EI = "
        f"{number(stiffnesses[0])} and {number(stiffnesses[-1])} N m² the bending stiffness {matters}."
    )


def _pushes(study: Study) -> str:
    parts = []
    for steepness in study.steepnesses:
        runs = study.pushes(steepness)
        if len(runs) < 2:
            continue
        off = max(spread([run[f"{body}_early_gain_s"] for run in runs]) for body in BODIES)
        late = [run["rope_lateral_late_m"] for run in runs]
        text = f"at kA = {number(steepness)} the first response per push is the same to {share(off)}"
        if all(run["rope_motion"] == "decay" for run in runs):
            ratios = [run["rope_lateral_late_m"] / run["seed_mps"] for run in runs]
            text += f", and so is what is left in the second half (to {share(spread(ratios))})"
        else:
            text += (
                f"; in the second half of the run the rope reaches {metres(min(late))} to {metres(max(late))}, a "
                f"factor of {number(max(late) / min(late), 2)}, while the pushes differ by "
                f"{number(runs[-1]['seed_mps'] / runs[0]['seed_mps'], 2)}"
            )
        parts.append(text)
    if not parts:
        return ""
    pushes = [run["seed_mps"] for run in study.pushes(study.base["steepness"])] or [study.base["seed_mps"]]
    return f"Size of the push ({speed(pushes[0])} to {speed(pushes[-1])}): {'; '.join(parts)}."


def _grid(study: Study) -> str:
    parts, apart = [], []
    for depth in sorted({run["depth_m"] for run in study.select(depth_m=None, nodes=None)}):
        known = [run for run in study.select(depth_m=depth, nodes=None) if run.known("rope_first_burst_m")]
        sizes = [run["rope_first_burst_m"] for run in known]
        if len(sizes) > 1:
            apart.append(max(abs(size / sizes[-1] - 1.0) for size in sizes))
            bursts = listed(number(size, 3) for size in sizes)
            parts.append(f"{bursts} m at H = {number(depth)} m (within {percent(apart[-1])})")
    if not parts:
        return ""
    nodes = sorted({int(run["nodes"]) for run in study.select(nodes=None)})
    limit = "has a limit in the mesh" if max(apart) <= MOST_APART else "depends on the mesh"
    return (
        f"On {listed(map(str, nodes))} nodes the rope's first burst is {'; '.join(parts)} of that on the finest grid: "
        f"its size {limit} ({percent(MOST_APART)} allowed)."
    )
