"""Sections of the out-of-plane report on time: figure 20, growth or bursts, size of the push."""

from __future__ import annotations

import numpy as np

from ..figures.offplane_history import History, lateral_histories, seed_histories
from ..parts.content import Figure, Heading, Item, Text
from ..parts.wording import number
from .runs import BODIES, DISPLACEMENT, Run, Study, envelope
from .words import metres, share, speed, spread

_SCALED_PERIODS = 20  # of the push figure: past the first loop at every depth
_DEPARTURE_PERIODS = 4  # after the least value within which the first burst is looked at
_PLAIN_SPAN = 8  # periods: two bursts or so, so that eight curves of bursts can be told apart
_ACROSS = ("offplane_growth_bits_per_period", "offplane_growth_error")


def history_items(study: Study) -> list[Item]:
    """Figure 20: lateral motion of buoy and rope for both waves."""
    runs = [run for steepness in study.steepnesses if (run := study.one(steepness=steepness)) is not None]
    loaded = [(run, trajectory) for run in runs if (trajectory := study.trajectory(run)) is not None]
    heading = Heading("Lateral motion against time (fig. 20)")
    if not loaded:
        return [heading, Text("Neither of the two runs of figure 20 ended as asked, so it cannot be drawn.")]
    labels = {"buoy": "buoy, $|y|$ (m)", "rope": "rope, largest $|y|$ (m)"}
    panels = [(labels[body], [_history(run, trajectory, body) for run, trajectory in loaded]) for body in BODIES]
    first = loaded[0][0]
    caption = (
        f"Lateral motion of the buoy (fig. 20 of the paper) and of the rope after a push of "
        f"{speed(first['seed_mps'])} across the waves, H = {number(first['depth_m'])} m. Thick: the largest value in "
        f"each wave period; thin: every sample; dotted: half the range of the buoy in the plane."
    )
    return [
        heading,
        Text(
            "At t = 0 the buoy gets a small velocity across the waves; everything else is as in a planar run. The "
            "paper shows the buoy alone."
        ),
        Figure(lateral_histories(panels), caption, "Lateral motion on a logarithmic axis for both waves."),
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
        spans.append(float(periods[most] - periods[least]))
        ends = [f"{metres(float(size[k]))} at t = {number(float(periods[k]), 3)} periods" for k in (least, most)]
        nats = number(float(np.log(size[most] / size[least])), 2)
        parts.append(f"the {body} goes from its least, {' to '.join(ends)} ({nats} nats)")
    return (
        f"How it leaves the plane at kA = {number(run['steepness'])}: before the first burst of the rope, by the "
        f"largest value in each wave period, {' and '.join(parts)}. The rise takes {number(max(spans), 2)} wave "
        "periods at most."
    )


def _history(run: Run, trajectory, body: str) -> History:
    periods = trajectory.columns["time_s"] / trajectory.scene.waves.period_s
    size = np.abs(trajectory.columns[DISPLACEMENT[body]])
    return History(f"kA = {number(run['steepness'])}", periods, size, *envelope(trajectory, body), run["inplane_m"])


def growth_items(study: Study) -> list[Item]:
    """Growth or bursts of both waves at every depth, and the exponent across the plane of the planar runs there."""
    runs = [run for kA in study.steepnesses for run in study.select(steepness=kA, depth_m=None) if run.ok]
    base = (
        f"at EI = {number(study.base['bending_stiffness_Nm2'])} N m², {number(study.base['nodes'])} nodes, push "
        f"{speed(study.base['seed_mps'])}. A dash: there is none."
    )
    items: list[Item] = [
        Heading("Growth, decay or bursts"),
        Text(
            "A rate is given only where the logarithm of the envelope (largest |y| in four wave periods, longer than "
            "half a lateral swing; where those are too few, in one) has a straight part of at least three nats and "
            "nine points that separates what comes before from what comes after; its error is the scatter of the "
            "slopes of its quarters. Otherwise maxima of single periods that stand three nats above the dips on both "
            "sides are bursts; no rate is given for the rise of a burst."
        ),
    ]
    told = (
        "motion", ("rate_bits_per_period", "rate_error"), "rate_nats_per_period", "fit_from_period", "fit_to_period",
        "fit_span_nats", "bursts", "burst_median_m", "burst_max_m", "first_burst_period", "lateral_max_m",
        "share_of_inplane",
    )  # fmt: skip
    for body in BODIES:
        names = [f"{body}_{name}" if isinstance(name, str) else tuple(f"{body}_{one}" for one in name) for name in told]
        items.append(study.table(["steepness", "depth_m", *names], runs, f"Lateral motion of the {body}, {base}"))
    planar = [run for kA in study.steepnesses for run in study.planar(steepness=kA, depth_m=None) if run.ok]
    caption = f"Infinitesimal perturbation across the plane of the planar runs.{_agreement(study, runs)}"
    table = study.table(["steepness", "depth_m", _ACROSS, "loop_releases"], planar, caption)
    return [*items, *([table] if planar else [])]


def _agreement(study: Study, runs: list[Run]) -> str:
    """How far the fitted rate of the buoy is from the exponent of the planar run, in errors; "" without a pair."""
    off = []
    for run in runs:
        planar = [one for one in study.planar(steepness=run["steepness"], depth_m=run["depth_m"]) if one.ok]
        if planar and run.known("buoy_rate_bits_per_period") and planar[0].known(_ACROSS[0]):
            error = np.hypot(run["buoy_rate_error"], planar[0][_ACROSS[1]])
            off.append(abs(run["buoy_rate_bits_per_period"] - planar[0][_ACROSS[0]]) / error)
    if not off:
        return ""
    return f" It differs from the fitted rate of the buoy by at most {number(max(off), 2)} of their common error."


def push_items(study: Study) -> list[Item]:
    """Size of the push: curves scaled by it, curves as they are, and the numbers."""
    items: list[Item] = [Heading("Size of the push")]
    pushed = study.pushes(study.base["steepness"])
    loaded = [(run, trajectory) for run in pushed if (trajectory := study.trajectory(run)) is not None]
    if loaded:
        items.append(_push_figure(study, loaded))
    told = [f"{body}_{name}" for body in BODIES for name in ("early_gain_s", "first_burst_m", "lateral_late_m")]
    runs = [run for steepness in study.steepnesses for run in study.pushes(steepness)]
    caption = (
        "The push and what becomes of it: for each body the first response by the push, which is the same for every "
        "push as long as the response is linear, the first burst, and what is reached in the second half."
    )
    return [*items, study.table(["steepness", "nodes", "seed_mps", *told, "rope_motion"], runs, caption)]


def _push_figure(study: Study, loaded) -> Figure:
    panels = []
    for body in BODIES:
        scaled, plain = [], []
        for run, trajectory in loaded:
            periods, size = envelope(trajectory, body)
            early = periods <= _SCALED_PERIODS
            push = abs(trajectory.scene.start.buoy_velocity_mps[1])
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
