"""The short answer of the out-of-plane campaign, in words computed from its table."""

from __future__ import annotations

import math

from .offplane_comparison import Pair, comparison_words
from .offplane_runs import BODIES, Run, Study
from .wording import EMPTY, count, decimals, listed, number, percent

COMPARABLE = 1.0 / 3.0  # share of the in-plane motion from which a lateral motion is called comparable with it


def short_answer(study: Study, pairs: list[Pair]) -> tuple[str, ...]:
    """One statement a line: both waves, the paper's claim, depth and stiffness, push, grid, planar runs."""
    lines = [_wave(study, steepness) for steepness in study.steepnesses]
    lines += [*claim_words(study), _depths(study), _pushes(study), _grid(study), comparison_words(pairs)]
    return tuple(line for line in lines if line)


def large_runs(study: Study) -> list[Run]:
    """Every run of the large wave in three dimensions that was pushed out of the plane and ended as asked."""
    large = study.base["steepness"]
    return [
        run
        for run in study.runs
        if run.ok and run["steepness"] == large and run["dimensions"] == 3 and run["seed_direction"] != "along"
    ]


def with_error(run: Run, body: str) -> str:
    """ "−0.0398 ± 0.0008" bits per period, or a dash."""
    if not run.known(f"{body}_rate_bits_per_period"):
        return EMPTY
    error = run[f"{body}_rate_error"]
    places = max(2, min(6, 1 - math.floor(math.log10(error)))) if error > 0 else 4
    return f"{decimals(run[f'{body}_rate_bits_per_period'], places)} ± {decimals(error, places)}"


def infinitesimal(study: Study, run: Run) -> str:
    """The exponent across the plane of the planar run at the same wave and depth, a dash where there is none."""
    planar = [one for one in study.planar(steepness=run["steepness"], depth_m=run["depth_m"]) if one.ok]
    column = "offplane_growth_bits_per_period"
    if not planar or not planar[0].known(column):
        return EMPTY
    return f"{decimals(planar[0][column], 4)} ± {decimals(planar[0]['offplane_growth_error'], 4)}"


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


def metres(size: float) -> str:
    """A lateral distance with a unit that needs no exponent: nm, µm, mm, m."""
    for unit, scale in (("m", 1.0), ("mm", 1e3), ("µm", 1e6), ("nm", 1e9)):
        if size * scale >= (0.1 if unit == "m" else 1.0):
            return f"{number(size * scale, 2)}\u00a0{unit}"
    return f"{number(size, 2)}\u00a0m"


def _wave(study: Study, steepness: float) -> str:
    run = study.one(steepness=steepness)
    if run is None:
        return ""
    where = f"kA = {number(steepness)}, H = {number(run['depth_m'])} m, push {speed(run['seed_mps'])}"
    same = all(run[f"buoy_{key}"] == run[f"rope_{key}"] for key in ("motion", "lateral_max_m"))
    if same:
        return f"{where}: buoy and rope swing together; the motion {body_words(run, 'buoy')}."
    return f"{where}: the buoy {body_words(run, 'buoy')}; the rope {body_words(run, 'rope')}."


def claim_words(study: Study) -> list[str]:
    """Whether the paper's statement on the large wave is borne out: growth, then size, for buoy and rope apart."""
    runs = [run for run in large_runs(study) if not run["profiles"]]
    if not runs:
        return []
    growing = [run for run in runs if any(run[f"{body}_motion"] == "growth" for body in BODIES)]
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
    small = study.steepnesses[0]
    runs = [run for run in study.runs if run.ok and run["steepness"] == small and run["dimensions"] == 3]
    if small == study.base["steepness"] or not runs:
        return []
    growing = sum(any(run[f"{body}_motion"] == "growth" for body in BODIES) for run in runs)
    decaying = sum(run["buoy_motion"] == run["rope_motion"] == "decay" for run in runs)
    word = "is borne out" if not growing else "is not borne out"
    return [
        f"The paper's “does not grow” {word} at kA = {number(small)}: of {count(len(runs), 'run')} {growing} grow, and "
        f"{decaying} decay exponentially."
    ]


def _where(run: Run) -> str:
    return (
        f"H = {number(run['depth_m'])} m, EI = {number(run['bending_stiffness_Nm2'])} N m², "
        f"{number(run['nodes'])} nodes, push {speed(run['seed_mps'])} {run['seed_direction']}"
    )


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
    mixed = sum(len(found) for found in groups.values()) > len(depths)
    same = "" if mixed else ", whatever the stiffness"
    return (
        f"Depth decides and bending stiffness (EI = {listed(number(one) for one in stiffnesses)} N m²) "
        f"{'matters at some' if mixed else 'does not'}: at kA = {number(study.base['steepness'])} the rope shows "
        f"{', '.join(parts)}{same}."
    )


def spread(values: list[float]) -> float:
    """(largest - smallest)/mean."""
    return (max(values) - min(values)) / (sum(values) / len(values))


def _pushes(study: Study) -> str:
    parts = []
    for steepness in study.steepnesses:
        runs = [run for run in study.pushes(steepness) if run.ok]
        if len(runs) < 2:
            continue
        off = max(spread([run[f"{body}_early_gain_s"] for run in runs]) for body in BODIES)
        late = [run["rope_lateral_late_m"] for run in runs]
        text = f"at kA = {number(steepness)} the first response per push is the same to {_share(off)}"
        if all(run["rope_motion"] == "decay" for run in runs):
            ratios = [run["rope_lateral_late_m"] / run["seed_mps"] for run in runs]
            text += f", and so is what is left in the second half (to {_share(spread(ratios))})"
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


def speed(push: float) -> str:
    """A push with its unit, powers of ten without leading zeros: 1e-5 m/s."""
    return f"{number(push).replace('e-0', 'e-')}\u00a0m/s"


def _share(value: float) -> str:
    return f"{value:.0e}".replace("e-0", "e−").replace("e-", "e−") if value < 1e-3 else percent(value)


def _grid(study: Study) -> str:
    parts = []
    depths = sorted({run["depth_m"] for run in study.select(depth_m=None, nodes=None)})
    for depth in depths:
        runs = [run for run in study.select(depth_m=depth, nodes=None) if run.known("rope_first_burst_m")]
        if len(runs) > 1:
            sizes = [run["rope_first_burst_m"] for run in runs]
            finest = runs[-1]["rope_first_burst_m"]
            off = max(abs(size / finest - 1.0) for size in sizes)
            parts.append(
                f"{listed(number(size, 3) for size in sizes)} m at H = {number(depth)} m (within {percent(off)})"
            )
    if not parts:
        return ""
    nodes = sorted({int(run["nodes"]) for run in study.select(nodes=None)})
    return (
        f"On {listed(map(str, nodes))} nodes the rope's first burst is {'; '.join(parts)} of that on the finest grid: "
        "its size has a limit in the mesh."
        if all("within" in part for part in parts)
        else ""
    )
