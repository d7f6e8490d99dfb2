"""The short answer of the out-of-plane campaign, in words computed from its table."""

from __future__ import annotations

from ..parts.wording import EMPTY, count, listed, number, percent
from .comparison import Pair, comparison_words
from .runs import BODIES, Run, Study
from .verdict import claim_words, verdict_words
from .words import metres, plus_minus, share, speed, spread, with_error

MOST_APART = 0.2  # between grids, of the size on the finest: what is still called a limit in the mesh


def short_answer(study: Study, pairs: list[Pair]) -> tuple[str, ...]:
    """One statement a line: verdict, both waves, the paper's claim, depth and stiffness, push, grid, planar runs."""
    lines = [verdict_words(study), *(_wave(study, steepness) for steepness in study.steepnesses)]
    lines += [*claim_words(study), _depths(study), _pushes(study), _grid(study), comparison_words(pairs)]
    return tuple(line for line in lines if line)


def infinitesimal(study: Study, run: Run) -> str:
    """The exponent across the plane of the planar run at the same wave and depth, a dash where there is none."""
    planar = [one for one in study.planar(steepness=run["steepness"], depth_m=run["depth_m"]) if one.ok]
    column = "offplane_growth_bits_per_period"
    if not planar or not planar[0].known(column):
        return EMPTY
    return plus_minus(planar[0][column], planar[0]["offplane_growth_error"])


def body_words(run: Run, body: str) -> str:
    """What one body of one run does, as the end of a sentence that begins with the body."""
    kind, most = run[f"{body}_motion"], metres(run[f"{body}_lateral_max_m"])
    if kind in ("growth", "decay"):
        word = "grows" if kind == "growth" else "decays"
        span = f"{number(run[f'{body}_fit_from_period'], 3)} to {number(run[f'{body}_fit_to_period'], 3)}"
        return (
            f"{word} exponentially by {with_error(run, body)} bits per wave period (fitted over periods {span}, "
            f"{number(abs(run[f'{body}_fit_span_nats']), 2)} nats; largest {most})"
        )
    if kind == "bursts":
        return (
            f"has no exponential but {count(int(run[f'{body}_bursts']), 'burst')}, the median {_median(run, body)} and "
            f"the largest {most} from the plane"
        )
    return f"has neither an exponential nor bursts; it stays within {most} of the plane"


def _median(run: Run, body: str) -> str:
    return metres(run[f"{body}_burst_median_m"])


def _wave(study: Study, steepness: float) -> str:
    run = study.one(steepness=steepness)
    if run is None:
        return ""
    where = f"kA = {number(steepness)}, H = {number(run['depth_m'])} m, push {speed(run['seed_mps'])}"
    same = all(run[f"buoy_{key}"] == run[f"rope_{key}"] for key in ("motion", "lateral_max_m"))
    if same:
        return f"{where}: buoy and rope swing together; the motion {body_words(run, 'buoy')}."
    return f"{where}: the buoy {body_words(run, 'buoy')}; the rope {body_words(run, 'rope')}."


def _depths(study: Study) -> str:
    runs = [run for run in study.select(depth_m=None, bending_stiffness_Nm2=None) if run.ok]
    depths = sorted({run["depth_m"] for run in runs})
    if len(depths) < 2:
        return ""
    groups = {kind: [] for kind in ("bursts", "decay", "growth", "neither")}
    for depth in depths:
        for kind in {run["rope_motion"] for run in runs if run["depth_m"] == depth}:
            groups[kind].append(depth)
    stiffnesses = sorted({run["bending_stiffness_Nm2"] for run in runs})
    parts = [
        f"{words} at H = {listed(number(depth) for depth in groups[kind])} m"
        for kind, words in (("bursts", "bursts"), ("growth", "growth"), ("decay", "decay"), ("neither", "neither"))
        if groups[kind]
    ]
    mixed = [depth for depth in depths if sum(depth in found for found in groups.values()) > 1]
    matters = f"matters at H = {listed(number(depth) for depth in mixed)} m only" if mixed else "does not matter"
    return (
        f"At kA = {number(study.base['steepness'])} the rope shows {', '.join(parts)}. Between EI = "
        f"{number(stiffnesses[0])} and {number(stiffnesses[-1])} N m² the bending stiffness {matters}."
    )


def _pushes(study: Study) -> str:
    parts = []
    for steepness in study.steepnesses:
        runs = [run for run in study.pushes(steepness) if run.ok]
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
    pushes = [run["seed_mps"] for run in study.pushes(study.base["steepness"])]
    return f"Size of the push ({speed(pushes[0])} to {speed(pushes[-1])}): {'; '.join(parts)}."


def _grid(study: Study) -> str:
    parts, apart = [], []
    depths = sorted({run["depth_m"] for run in study.select(depth_m=None, nodes=None)})
    for depth in depths:
        runs = [run for run in study.select(depth_m=depth, nodes=None) if run.known("rope_first_burst_m")]
        if len(runs) > 1:
            sizes = [run["rope_first_burst_m"] for run in runs]
            apart.append(max(abs(size / sizes[-1] - 1.0) for size in sizes))
            parts.append(
                f"{listed(number(size, 3) for size in sizes)} m at H = {number(depth)} m (within {percent(apart[-1])})"
            )
    if not parts:
        return ""
    nodes = sorted({int(run["nodes"]) for run in study.select(nodes=None)})
    limit = "has a limit in the mesh" if max(apart) <= MOST_APART else "depends on the mesh"
    return (
        f"On {listed(map(str, nodes))} nodes the rope's first burst is {'; '.join(parts)} of that on the finest grid: "
        f"its size {limit} ({percent(MOST_APART)} allowed)."
    )
