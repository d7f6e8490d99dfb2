"""Sections of the out-of-plane report on what was varied: depth, stiffness, direction, grid; and the rope's shape."""

from __future__ import annotations

import numpy as np

from ..figures.offplane_dependence import dependence
from ..figures.rope_shape import rope_shapes
from ..parts.content import Figure, Heading, Item, Text
from ..parts.symbols import T_I
from ..parts.wording import number, percent
from .runs import BODIES, Run, Study
from .words import metres

_SHAPE_OFFSETS_S = (-0.3, -0.2, -0.1, 0.0, 0.1, 0.2)
_DIRECTIONS = ("lateral", "mirrored", "oblique", "along")


def dependence_items(study: Study) -> list[Item]:
    """Depth and bending stiffness: figure and tables."""
    runs = [run for run in study.select(depth_m=None, bending_stiffness_Nm2=None) if run.ok]
    if not runs:
        return []
    stiffnesses = sorted({run["bending_stiffness_Nm2"] for run in runs})
    panels = [(body, [_curve(runs, body, stiffness) for stiffness in stiffnesses]) for body in BODIES]
    caption = (
        f"Largest lateral distance in the second half of each run at kA = {number(study.base['steepness'])} over the "
        "depth. Filled: bursts, or neither; open: exponential decay, and what is left of it."
    )
    told = (
        "buoy_motion", ("buoy_rate_bits_per_period", "buoy_rate_error"), "buoy_lateral_max_m", "rope_motion",
        ("rope_rate_bits_per_period", "rope_rate_error"), "rope_bursts", "rope_burst_median_m", "rope_lateral_max_m",
        "rope_share_of_inplane", "slack_fraction", "loop_releases", "max_turn_rad",
    )  # fmt: skip
    small = study.select(steepness=study.steepnesses[0], bending_stiffness_Nm2=None)
    shown = [*runs, *(run for run in small if run.ok and run not in runs)]
    names = ["steepness", "depth_m", "bending_stiffness_Nm2", *told]
    picture = dependence(panels, "max $|y|$, second half (m)")
    return [
        Heading("Depth and bending stiffness"),
        Figure(picture, caption, "Lateral motion of buoy and rope over the depth."),
        study.table(names, shown, "Every depth and stiffness of the large wave, every stiffness of the small one."),
    ]


def _curve(runs: list[Run], body: str, stiffness: float) -> tuple:
    chosen = [run for run in runs if run["bending_stiffness_Nm2"] == stiffness]
    columns = ([run["depth_m"] for run in chosen], [run[f"{body}_lateral_late_m"] for run in chosen])
    decays = np.array([run[f"{body}_motion"] == "decay" for run in chosen])
    return (f"EI = {number(stiffness)} N m²", *map(np.array, columns), decays)


def direction_items(study: Study) -> list[Item]:
    """Direction of the push."""
    runs, words = [], []
    for steepness in study.steepnesses:
        found = [run for run in study.select(steepness=steepness, seed_direction=None) if run.ok]
        runs += sorted(found, key=lambda run: (*_DIRECTIONS, run["seed_direction"]).index(run["seed_direction"]))
        words.append(_mirror_words(study, steepness))
    if (along := study.one(seed_direction="along")) is not None:
        words.append(
            f"A push along the waves leaves y at exactly {number(along['buoy_lateral_max_m'])}: the motion stays "
            f"planar, and the run in three dimensions then needs {number(along['loop_releases'])} loop releases of its "
            "own."
        )
    names = [
        "steepness", "seed_direction", "buoy_motion", ("buoy_rate_bits_per_period", "buoy_rate_error"),
        "buoy_early_gain_s", "buoy_lateral_max_m", "rope_motion", "rope_bursts", "rope_first_burst_m",
        "rope_lateral_max_m", "loop_releases",
    ]  # fmt: skip
    caption = "Direction of the push: lateral (+y), mirrored (−y), oblique (45° between x and y), along the waves (x)."
    said = [Text(" ".join(filter(None, words)))] if any(words) else []
    return [Heading("Direction of the push"), *said, study.table(names, runs, caption)]


def _mirror_words(study: Study, steepness: float) -> str:
    pair = [study.one(steepness=steepness, seed_direction=word) for word in _DIRECTIONS[:2]]
    both = [study.trajectory(run) for run in pair if run is not None]
    if len(both) < 2 or None in both:
        return ""
    y, mirrored = (trajectory.columns["y_m"] for trajectory in both)
    n = min(len(y), len(mirrored))
    off = float(np.max(np.abs(y[:n] + mirrored[:n])))
    how = "to the last digit" if off == 0 else f"to {number(off, 2)} m"
    return f"At kA = {number(steepness)} the mirrored push gives the mirrored motion {how}."


def grid_items(study: Study) -> list[Item]:
    """Nodes: the first burst, the turn in an element, the rate."""
    runs = [run for run in study.select(depth_m=None, nodes=None) if run.ok]
    several = {run["depth_m"] for run in runs if run["nodes"] != study.base["nodes"]}
    small = study.steepnesses[0]
    chosen = [run for run in study.select(steepness=small, nodes=None) if run.ok and small != study.base["steepness"]]
    names = [
        "steepness", "depth_m", "nodes", ("buoy_rate_bits_per_period", "buoy_rate_error"), "rope_early_gain_s",
        "rope_first_burst_period", "rope_first_burst_m", "rope_bursts", "rope_burst_median_m", "rope_lateral_max_m",
        "buoy_lateral_max_m", "max_turn_rad", "loop_releases", "wall_s",
    ]  # fmt: skip
    caption = "The grid. Loops are resolved where the largest turn within one element stays below π/2."
    shown = [*chosen, *(run for run in runs if run["depth_m"] in several)]
    off = []
    for depth in several:
        sizes = [run["rope_first_burst_m"] for run in runs if run["depth_m"] == depth and run.known(names[6])]
        off += [abs(size / sizes[-1] - 1.0) for size in sizes]
    if off:
        caption += f" The rope's first burst differs from that on the finest grid by at most {percent(max(off))}."
    return [Heading("Grid"), study.table(names, shown, caption)]


def _bow(run: Run) -> str:
    """How far the rope bows out of the straight line between its ends, in the plane and across it."""
    if not run.known("bow_inplane_m"):
        return ""
    inplane, lateral = run["bow_inplane_m"], run["bow_lateral_m"]
    return (
        f" From the straight line between its ends it bows by up to {metres(inplane)} in the plane and "
        f"{metres(lateral)} across it ({percent(lateral / inplane)})."
    )


def shape_items(study: Study) -> list[Item]:
    """The rope at its largest lateral excursion."""
    run = study.one(profiles=1, nodes=None)
    trajectory = study.trajectory(run) if run is not None else None
    if trajectory is None or trajectory.profiles is None or not len(trajectory.profiles.time_s):
        return []
    lines = trajectory.profiles
    size = np.abs(lines.y_m).max(axis=1)
    most = int(np.argmax(size))
    step_s = float(lines.time_s[1] - lines.time_s[0]) if len(lines.time_s) > 1 else 1.0
    near = dict.fromkeys(most + round(offset / step_s) for offset in _SHAPE_OFFSETS_S)
    inside = [i for i in near if 0 <= i < len(lines.time_s)]
    node = int(np.argmax(np.abs(lines.y_m[most])))
    seen = (
        f"at t = {number(float(lines.time_s[most]), 4)} s the rope is {metres(float(size[most]))} off the plane, "
        f"{number(float(lines.s_m[node]), 3)} m of unstretched rope from the anchor, while the buoy is "
        f"{metres(float(abs(lines.y_m[most, -1])))} off it; {T_I} is {number(trajectory.scene.waves.period_s)} s"
    )
    caption = (
        f"The rope in a loop at kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m: nodes as dots, the "
        f"buoy as a large dot; y has an axis of its own. Seen: {seen}.{_bow(run)}"
    )
    picture = rope_shapes([(f"{lines.time_s[i]:.1f} s", lines.x_m[i], lines.y_m[i], lines.z_m[i]) for i in inside])
    return [Heading("The rope in a loop"), Figure(picture, caption, f"Shape of the rope from three sides: {seen}.")]
