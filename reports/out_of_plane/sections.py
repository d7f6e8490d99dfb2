"""Sections of the out-of-plane report on time: figure 20, growth or bursts, size of the push."""

from __future__ import annotations

import numpy as np

from ..figures.offplane_history import History, lateral_histories, seed_histories
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.symbols import T_I
from ..parts.wording import EMPTY, count, number, percent
from .answer import infinitesimal
from .runs import BODIES, DISPLACEMENT, Run, Study, envelope
from .words import metres, share, speed, spread, with_error

_SCALED_PERIODS = 20  # of the push figure: past the first loop at every depth
_DEPARTURE_PERIODS = 4  # after the least value within which the first burst is looked at
_PLAIN_SPAN = 8  # periods: two bursts or so, so that eight curves of bursts can be told apart


def history_items(study: Study) -> list[Item]:
    """Figure 20: lateral motion of buoy and rope for both waves."""
    runs = [run for steepness in study.steepnesses if (run := study.one(steepness=steepness)) is not None]
    loaded = [(run, trajectory) for run in runs if (trajectory := study.trajectory(run)) is not None]
    heading = Heading("Lateral motion against time (fig. 20)")
    if not loaded:
        return [heading, Text("Neither of the two runs of figure 20 ended as asked, so it cannot be drawn.")]
    panels = []
    for body, label in (("buoy", "buoy, $|y|$ (m)"), ("rope", "rope, largest $|y|$ (m)")):
        panels.append((label, [_history(run, trajectory, body) for run, trajectory in loaded]))
    seen = "; ".join(
        f"at kA = {number(run['steepness'])} the buoy stays within {metres(run['buoy_lateral_max_m'])} and the rope "
        f"within {metres(run['rope_lateral_max_m'])} of the plane, against {number(run['inplane_m'], 3)} m in it"
        for run, _ in loaded
    )
    first = loaded[0][0]
    caption = (
        f"Lateral motion of the buoy (fig. 20 of the paper) and of the rope after a push of "
        f"{speed(first['seed_mps'])} across the waves, H = {number(first['depth_m'])} m. Thick: the largest value in "
        f"each wave period; thin: every sample; dotted: half the range of the buoy in the plane. Seen: {seen}. From "
        "`y_m` and `offplane_m`."
    )
    return [
        heading,
        Text(
            "At t = 0 the buoy gets a small velocity across the waves; everything else is as in a planar run. The "
            "paper shows the buoy alone."
        ),
        Figure(lateral_histories(panels), caption, f"Lateral motion on a logarithmic axis for both waves: {seen}."),
        *(Text(words) for run, trajectory in loaded if (words := _departure(run, trajectory))),
    ]


def _departure(run: Run, trajectory) -> str:
    """How the lateral motion gets from the push to its first burst in the rope, "" where there is none."""
    if not run.known("rope_first_burst_period"):
        return ""
    parts, spans = [], []
    for body in BODIES:
        periods, size = envelope(trajectory, body)
        least = int(np.argmin(np.where(periods < run["rope_first_burst_period"], size, np.inf)))
        most = least + int(np.argmax(size[least : least + _DEPARTURE_PERIODS + 1]))
        spans.append(periods[most] - periods[least])
        nats = number(float(np.log(size[most] / size[least])), 2)
        parts.append(
            f"the {body} is at its least, {metres(float(size[least]))}, at t = {number(float(periods[least]), 3)} "
            f"periods, and at {metres(float(size[most]))} at {number(float(periods[most]), 3)} ({nats} nats)"
        )
    return (
        f"How it leaves the plane at kA = {number(run['steepness'])}: before the first burst of the rope, by the "
        f"largest value in each wave period, {' and '.join(parts)}. The rise takes "
        f"{number(float(max(spans)), 2)} wave periods at most."
    )


def _history(run: Run, trajectory, body: str) -> History:
    periods = trajectory.columns["time_s"] / trajectory.scene.waves.period_s
    label = f"kA = {number(run['steepness'])}"
    size = np.abs(trajectory.columns[DISPLACEMENT[body]])
    return History(label, periods, size, *envelope(trajectory, body), run["inplane_m"])


def growth_items(study: Study) -> list[Item]:
    """Growth or bursts of both waves at every depth."""
    runs = [run for s in study.steepnesses for run in study.select(steepness=s, depth_m=None)]
    heads = (
        Column("kA"),
        Column("H", "m"),
        Column("body", align="left"),
        Column("motion", align="left"),
        Column("rate", f"bits/{T_I}"),
        Column("rate", f"nats/{T_I}"),
        Column("infinitesimal", f"bits/{T_I}"),
        Column("window", T_I),
        Column("span", "nats"),
        Column("bursts"),
        Column("median", "m"),
        Column("largest", "m"),
        Column("first at", T_I),
        Column("max |y|", "m"),
        Column("of in-plane"),
    )
    rows = tuple(_growth_row(study, run, body) for run in runs if run.ok for body in BODIES)
    caption = (
        f"Lateral motion at EI = {number(study.base['bending_stiffness_Nm2'])} N m², {number(study.base['nodes'])} "
        f"nodes, push {speed(study.base['seed_mps'])}. window, span: what the fitted line covers; median, largest, "
        "first at: of the bursts; infinitesimal: exponent across the plane of the planar run at the same wave and "
        "depth, which has none where it released loops; of in-plane: max |y| by the half range of the buoy in the "
        "plane. A dash: there is none. From `table.csv` (`{buoy,rope}_motion` and the columns after it)."
    )
    return [
        Heading("Growth, decay or bursts"),
        Text(
            "A rate is given only where the logarithm of the envelope (largest |y| in four wave periods, longer than "
            "half a lateral swing; where those are too few, in one) has a straight part of at least three nats and "
            "nine points that separates what comes before from what comes after; its error is the scatter of the "
            "slopes of its quarters. Otherwise maxima of single periods that stand three nats above the dips on both "
            "sides are bursts; no rate is given for the rise of a burst."
        ),
        Table(heads, rows, caption, small=True),
        *([Text(words)] if (words := _agreement(study, runs)) else []),
    ]


def _agreement(study: Study, runs: list[Run]) -> str:
    """How far the fitted rate of the buoy is from the exponent of the planar run, in errors; "" without a pair."""
    off = []
    for run in runs:
        planar = [one for one in study.planar(steepness=run["steepness"], depth_m=run["depth_m"]) if one.ok]
        fit, exact = "buoy_rate_bits_per_period", "offplane_growth_bits_per_period"
        if run.ok and run.known(fit) and planar and planar[0].known(exact):
            error = np.hypot(run["buoy_rate_error"], planar[0]["offplane_growth_error"])
            off.append(abs(run[fit] - planar[0][exact]) / error)
    if not off:
        return ""
    return (
        "The fitted rate of the buoy and the exponent of an infinitesimal perturbation, two runs that share nothing "
        f"but the scene, differ by at most {number(max(off), 2)} of their common error ({count(len(off), 'pair')})."
    )


def _growth_row(study: Study, run: Run, body: str) -> tuple[str, ...]:
    def cell(name: str, digits: int = 3) -> str:
        return number(run[f"{body}_{name}"], digits)

    ends = (cell("fit_from_period"), cell("fit_to_period"))
    window = "\u00a0to\u00a0".join(ends) if run.known(f"{body}_fit_from_period") else EMPTY
    return (
        number(run["steepness"]),
        number(run["depth_m"]),
        body,
        run[f"{body}_motion"],
        with_error(run, body),
        cell("rate_nats_per_period"),
        infinitesimal(study, run) if body == "buoy" else "",
        window,
        cell("fit_span_nats"),
        cell("bursts"),
        cell("burst_median_m"),
        cell("burst_max_m"),
        cell("first_burst_period"),
        cell("lateral_max_m", 2),
        percent(run[f"{body}_share_of_inplane"]) if run.known(f"{body}_share_of_inplane") else EMPTY,
    )


def push_items(study: Study) -> list[Item]:
    """Size of the push: curves scaled by it, curves as they are, and the numbers."""
    items: list[Item] = [Heading("Size of the push")]
    runs = [run for run in study.pushes(study.base["steepness"]) if run.ok]
    loaded = [(run, trajectory) for run in runs if (trajectory := study.trajectory(run)) is not None]
    if loaded:
        items.append(_push_figure(study, loaded))
    heads = (
        Column("kA"),
        Column("nodes"),
        Column("push", "m/s"),
        *(
            Column(f"{body}: {title}", unit)
            for body in BODIES
            for title, unit in (("early |y|/push", "s"), ("first burst", "m"), ("max |y|, 2nd half", "m"))
        ),
        Column("motion of the rope", align="left"),
    )
    rows = []
    for steepness in study.steepnesses:
        for run in study.pushes(steepness):
            if run.ok:
                cells = (
                    number(run[f"{body}_{name}"], digits)
                    for body in BODIES
                    for name, digits in (("early_gain_s", 6), ("first_burst_m", 3), ("lateral_late_m", 3))
                )
                rows.append(
                    (number(steepness), number(run["nodes"]), number(run["seed_mps"]), *cells, run["rope_motion"])
                )
    caption = (
        "The push and what becomes of it. early |y|/push: largest lateral distance in the first eight wave periods by "
        "the lateral speed of the push, the same for every push as long as the response is linear. From `table.csv`."
    )
    return [*items, Table(heads, tuple(rows), caption, small=True)]


def _push_figure(study: Study, loaded) -> Figure:
    panels = []
    for body in BODIES:
        scaled, plain = [], []
        for run, trajectory in loaded:
            push = abs(trajectory.scene.start.buoy_velocity_mps[1])
            periods, size = envelope(trajectory, body)
            early = periods <= _SCALED_PERIODS
            scaled.append((run["seed_mps"], periods[early], size[early] / push))
            plain.append((run["seed_mps"], *envelope(trajectory, body, _PLAIN_SPAN)))
        panels.append((f"{body}: per push", "$|y|$/push (s)", scaled))
        panels.append((f"{body}: as it is", "$|y|$ (m)", plain))
    late = [run["rope_lateral_late_m"] for run, _ in loaded]
    off = max(spread([run[f"{body}_early_gain_s"] for run, _ in loaded]) for body in BODIES)
    seen = (
        f"in the first eight wave periods the largest values per push differ by {share(off)}; in the second half the "
        f"rope reaches {metres(min(late))} to {metres(max(late))}"
    )
    caption = (
        f"Size of the push at kA = {number(study.base['steepness'])}, H = {number(study.base['depth_m'])} m. Left: "
        f"lateral distance by the push, first {_SCALED_PERIODS} wave periods, the largest value in each; right: the "
        f"distance itself, the largest value in each {_PLAIN_SPAN} wave periods. {number(loaded[0][0]['nodes'])} "
        f"nodes. Seen: {seen}. From `y_m` and `offplane_m`."
    )
    return Figure(seed_histories(panels), caption, f"Lateral motion for pushes of different size: {seen}.")
