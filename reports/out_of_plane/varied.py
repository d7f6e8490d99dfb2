"""Sections of the out-of-plane report on what was varied: depth, stiffness, direction, grid; and the rope's shape."""

from __future__ import annotations

import numpy as np

from ..figures.offplane_dependence import dependence
from ..figures.rope_shape import rope_shapes
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.symbols import T_I
from ..parts.wording import EMPTY, decimals, listed, number, percent
from .runs import BODIES, Run, Study
from .words import metres, with_error

_SHAPE_OFFSETS_S = (-0.3, -0.2, -0.1, 0.0, 0.1, 0.2)


def dependence_items(study: Study) -> list[Item]:
    """Depth and bending stiffness: figure and table."""
    runs = [run for run in study.select(depth_m=None, bending_stiffness_Nm2=None) if run.ok]
    stiffnesses = sorted({run["bending_stiffness_Nm2"] for run in runs})
    if not runs:
        return []
    panels = []
    for body in BODIES:
        curves = []
        for stiffness in stiffnesses:
            chosen = [run for run in runs if run["bending_stiffness_Nm2"] == stiffness]
            size = np.array([run[f"{body}_lateral_late_m"] for run in chosen])
            decays = np.array([run[f"{body}_motion"] == "decay" for run in chosen])
            curves.append(
                (f"EI = {number(stiffness)} N m²", np.array([run["depth_m"] for run in chosen]), size, decays)
            )
        panels.append((body, curves))
    parts = [
        f"the {body} reaches {metres(min(found))} to {metres(max(found))} where it does not decay exponentially"
        for body in BODIES
        if (found := [run[f"{body}_lateral_late_m"] for run in runs if run[f"{body}_motion"] != "decay"])
    ]
    decaying = sorted({run["depth_m"] for run in runs if run["rope_motion"] == "decay"})
    parts += [f"the rope decays at H = {listed(number(depth) for depth in decaying)} m"] if decaying else []
    seen = "; ".join(parts)
    caption = (
        f"Largest lateral distance in the second half of each run at kA = {number(study.base['steepness'])} over the "
        f"depth. Filled: bursts, or neither; open: exponential decay, and what is left of it. Seen: {seen}. From "
        "`buoy_lateral_late_m` and `rope_lateral_late_m`."
    )
    heads = (
        Column("H", "m"),
        Column("EI", "N\u00a0m²"),
        Column("buoy", align="left"),
        Column("rate", f"bits/{T_I}"),
        Column("max |y|", "m"),
        Column("rope", align="left"),
        Column("rate", f"bits/{T_I}"),
        Column("bursts"),
        Column("median", "m"),
        Column("max |y|", "m"),
        Column("of in-plane"),
        Column("loops"),
        Column("turn", "rad"),
    )
    rows = tuple(
        (
            number(run["depth_m"]),
            number(run["bending_stiffness_Nm2"]),
            run["buoy_motion"],
            with_error(run, "buoy"),
            number(run["buoy_lateral_max_m"], 2),
            run["rope_motion"],
            with_error(run, "rope"),
            number(run["rope_bursts"]),
            number(run["rope_burst_median_m"], 2),
            number(run["rope_lateral_max_m"], 2),
            percent(run["rope_share_of_inplane"]) if run.known("rope_share_of_inplane") else EMPTY,
            number(run["loop_releases"]),
            decimals(run["max_turn_rad"], 2),
        )
        for run in runs
    )
    small = [run for run in study.select(steepness=study.steepnesses[0], bending_stiffness_Nm2=None) if run.ok]
    words = _stiffness_of_small(small)
    return [
        Heading("Depth and bending stiffness"),
        Figure(dependence(panels, "max $|y|$, second half (m)"), caption, f"Lateral motion over the depth: {seen}."),
        Table(
            heads, rows, "Every depth and stiffness. loops: loop releases in three dimensions. From `table.csv`.", True
        ),
        *([Text(words)] if words else []),
    ]


def _stiffness_of_small(runs: list[Run]) -> str:
    rates = [run["buoy_rate_bits_per_period"] for run in runs if run.known("buoy_rate_bits_per_period")]
    if len(rates) < 2:
        return ""
    off = max(rates) - min(rates)
    stiffnesses = listed(number(run["bending_stiffness_Nm2"]) for run in runs)
    same = "to the last digit" if off == 0 else f"to {number(off, 2)} bits per wave period"
    slack = max(run["slack_fraction"] for run in runs)
    taut = "the tether stays taut, and " if slack == 0 else ""
    return (
        f"At kA = {number(runs[0]['steepness'])} {taut}the rate of the buoy is the same {same} for EI = {stiffnesses} "
        "N m²."
    )


def direction_items(study: Study) -> list[Item]:
    """Direction of the push."""
    rows, words = [], []
    for steepness in study.steepnesses:
        runs = [run for run in study.select(steepness=steepness, seed_direction=None) if run.ok]
        order = {"lateral": 0, "mirrored": 1, "oblique": 2, "along": 3}
        runs.sort(key=lambda run: order.get(run["seed_direction"], 9))
        rows += [
            (
                number(steepness),
                run["seed_direction"],
                run["buoy_motion"],
                with_error(run, "buoy"),
                number(run["buoy_early_gain_s"], 6),
                number(run["buoy_lateral_max_m"], 3),
                run["rope_motion"],
                number(run["rope_bursts"]),
                number(run["rope_first_burst_m"], 3),
                number(run["rope_lateral_max_m"], 3),
                number(run["loop_releases"]),
            )
            for run in runs
        ]
        words.append(_mirror_words(study, steepness))
    along = study.one(seed_direction="along")
    if along is not None:
        words.append(
            f"A push along the waves leaves y at exactly {number(along['buoy_lateral_max_m'])}: the motion stays "
            f"planar, and the run in three dimensions then needs {number(along['loop_releases'])} loop releases of its "
            "own."
        )
    heads = (
        Column("kA"),
        Column("push", align="left"),
        Column("buoy", align="left"),
        Column("rate", f"bits/{T_I}"),
        Column("early |y|/push", "s"),
        Column("max |y|", "m"),
        Column("rope", align="left"),
        Column("bursts"),
        Column("first", "m"),
        Column("max |y|", "m"),
        Column("loops"),
    )
    caption = (
        "Direction of the push: lateral (+y), mirrored (−y), oblique (45° between x and y), along the waves (x). early "
        "|y|/push counts the lateral part of the push. From `table.csv`."
    )
    return [
        Heading("Direction of the push"),
        *([Text(" ".join(word for word in words if word))] if any(words) else []),
        Table(heads, tuple(rows), caption, small=True),
    ]


def _mirror_words(study: Study, steepness: float) -> str:
    one, other = (study.one(steepness=steepness, seed_direction=word) for word in ("lateral", "mirrored"))
    if one is None or other is None:
        return ""
    first, second = study.trajectory(one), study.trajectory(other)
    if first is None or second is None:
        return ""
    y, mirrored = first.columns["y_m"], second.columns["y_m"]
    n = min(len(y), len(mirrored))
    off = float(np.max(np.abs(y[:n] + mirrored[:n])))
    how = "to the last digit" if off == 0 else f"to {number(off, 2)} m"
    return f"At kA = {number(steepness)} the mirrored push gives the mirrored motion {how}."


def grid_items(study: Study) -> list[Item]:
    """Nodes: the first burst, the turn in an element, the rate."""
    runs = [run for run in study.select(depth_m=None, nodes=None) if run.ok]
    several = {run["depth_m"] for run in runs if run["nodes"] != study.base["nodes"]}
    small = [run for run in study.select(steepness=study.steepnesses[0], nodes=None) if run.ok]
    chosen = [*small, *(run for run in runs if run["depth_m"] in several)]
    if study.steepnesses[0] == study.base["steepness"]:
        chosen = [run for run in runs if run["depth_m"] in several]
    heads = (
        Column("kA"),
        Column("H", "m"),
        Column("nodes"),
        Column("buoy rate", f"bits/{T_I}"),
        Column("early |y|/push", "s"),
        Column("first burst at", T_I),
        Column("first burst", "m"),
        Column("bursts"),
        Column("median", "m"),
        Column("rope max |y|", "m"),
        Column("buoy max |y|", "m"),
        Column("turn", "rad"),
        Column("loops"),
        Column("wall", f"ms/{T_I}"),
    )
    rows = tuple(
        (
            number(run["steepness"]),
            number(run["depth_m"]),
            number(run["nodes"]),
            with_error(run, "buoy"),
            number(run["rope_early_gain_s"], 4),
            number(run["rope_first_burst_period"], 4),
            number(run["rope_first_burst_m"], 3),
            number(run["rope_bursts"]),
            number(run["rope_burst_median_m"], 3),
            number(run["rope_lateral_max_m"], 3),
            number(run["buoy_lateral_max_m"], 2),
            decimals(run["max_turn_rad"], 2),
            number(run["loop_releases"]),
            number(1e3 * run["wall_s"] / run["periods"], 2),
        )
        for run in chosen
    )
    caption = (
        "The grid. early |y|/push: of the rope, in the first eight wave periods; first burst: of the rope; turn: "
        "largest turn within one element, which has to stay below π/2 to be called resolved; wall: time per wave "
        "period on the machine that ran it. From `table.csv`."
    )
    return [Heading("Grid"), Table(heads, rows, caption, small=True)]


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
    index = [most + round(offset / step_s) for offset in _SHAPE_OFFSETS_S]
    index = [i for i in dict.fromkeys(index) if 0 <= i < len(lines.time_s)]
    moments = [(f"{lines.time_s[i]:.1f} s", lines.x_m[i], lines.y_m[i], lines.z_m[i]) for i in index]
    node = int(np.argmax(np.abs(lines.y_m[most])))
    seen = (
        f"at t = {number(float(lines.time_s[most]), 4)} s the rope is {metres(float(size[most]))} off the plane, "
        f"{number(float(lines.s_m[node]), 3)} m of unstretched rope from the anchor, while the buoy is "
        f"{metres(float(abs(lines.y_m[most, -1])))} off it; {T_I} is {number(trajectory.scene.waves.period_s)} s"
    )
    caption = (
        f"The rope in a loop at kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m: nodes as dots, the "
        f"buoy as a large dot; y has an axis of its own. Seen: {seen}. From the profiles of "
        f"`trajectories/{run['run_key'][:12]}….nc`."
    )
    return [
        Heading("The rope in a loop"),
        Figure(rope_shapes(moments), caption, f"Shape of the rope from three sides: {seen}."),
    ]
