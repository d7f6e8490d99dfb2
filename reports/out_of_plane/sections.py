"""Sections of the out-of-plane report: tables of the folder, figures of its runs, and the same sentences each time."""

from collections.abc import Iterator

import numpy as np

from ..buoy_sweep.runs import strobed
from ..figures.motion import section_pairs
from ..figures.offplane_history import History, dependence, lateral_histories, rope_shapes, seed_histories
from ..parts.columns import table_of, value
from ..parts.content import Bullets, Figure, Heading, Item, Text
from ..parts.folder import read_columns, read_rows
from ..parts.judged import counted, read_statements, statements_table
from ..parts.wording import number
from .runs import BODIES, DISPLACEMENT, Study, envelope, of_bodies

_SCALED_PERIODS = 20  # of the push figure: past the first loop at every depth
_PLAIN_SPAN = 8  # periods: two bursts or so, so that eight curves of bursts can be told apart
_SHAPE_OFFSETS_S = (-0.3, -0.2, -0.1, 0.0, 0.1, 0.2)
_DIRECTIONS = ("lateral", "mirrored", "oblique", "along")
_RATE = ("rate_bits_per_period", "rate_error")


def answer_items(study: Study) -> Iterator[Item]:
    """The verdicts on the paper's statements and on planar runs; buoy and rope in the two runs of figure 20."""
    judged, pairs = read_statements(study.folder.directory), read_rows(study.folder.directory / "pairs.csv")
    good = sum("0" not in [text for name, text in row.items() if name.startswith("same_")] for row in pairs)
    agree = f"Planar runs with loop release agree with the runs in three dimensions in {good} of {len(pairs)} pairs: "
    agree += "range of r, section, exponent and regime of the buoy, as far as the records tell. The planar run is no "
    agree += "substitute for the rope's shape in the loops, nor for the buoy's path once the runs have parted."
    sentence = f"The paper's statements on figure 20: {counted(judged)}."
    yield Bullets((sentence, *([agree] if pairs else [])))
    yield statements_table(judged, "The paper's statements on figure 20. From `statements.csv`.")
    names = of_bodies("motion", _RATE, "bursts", "burst_median_m", "rise_nats", "rise_periods", "lateral_max_m")
    yield study.table(["steepness", "depth_m", "seed_mps", *names], study.over(), "The two runs of figure 20.")


def history_items(study: Study) -> Iterator[Item]:
    """Figure 20: lateral motion of buoy and rope for both waves."""
    yield Heading("Lateral motion against time (fig. 20)")
    loaded = study.loaded(study.over())
    if not loaded:
        yield Text("Neither of the two runs of figure 20 ended as asked, so it cannot be drawn.")
        return
    yield Text(
        "At t = 0 the buoy gets a small velocity across the waves; everything else is as in a planar run. The paper "
        "shows the buoy alone."
    )
    labels = {"buoy": "buoy, $|y|$ (m)", "rope": "rope, largest $|y|$ (m)"}
    panels = [(labels[body], [_history(run, trajectory, body) for run, trajectory in loaded]) for body in BODIES]
    first = loaded[0][0]
    caption = (
        f"Lateral motion of the buoy (fig. 20 of the paper) and of the rope after a push of "
        f"{number(first['seed_mps'])} m/s across the waves, H = {number(first['depth_m'])} m. Thick: the largest value "
        "in each wave period; thin: every sample; dotted: half the range of the buoy in the plane."
    )
    yield Figure(lateral_histories(panels), caption, "Lateral motion on a logarithmic axis for both waves.")


def _history(run, trajectory, body: str) -> History:
    periods = trajectory.columns["time_s"] / trajectory.scene.waves.period_s
    size = np.abs(trajectory.columns[DISPLACEMENT[body]])
    return History(f"kA = {number(run['steepness'])}", periods, size, *envelope(trajectory, body), run["inplane_m"])


def growth_items(study: Study) -> Iterator[Item]:
    """Growth or bursts of both waves at every depth, and the exponent across the plane of the planar runs there."""
    yield Heading("Growth, decay or bursts")
    yield Text(
        "A rate is given only where the logarithm of the envelope (largest |y| in four wave periods, longer than half "
        "a lateral swing; where those are too few, in one) has a straight part of at least three nats and nine points "
        "that separates what comes before from what comes after; its error is the scatter of the slopes of its "
        "quarters. Otherwise maxima of single periods that stand three nats above the dips on both sides are bursts; "
        "no rate is given for the rise of a burst."
    )
    sentences = (
        "motion", _RATE, "rate_nats_per_period", "fit_from_period", "fit_to_period", "fit_span_nats", "bursts",
        "burst_median_m", "burst_max_m", "first_burst_period", "lateral_max_m", "share_of_inplane",
    )  # fmt: skip
    for body in BODIES:
        names = ["steepness", "depth_m", *of_bodies(*sentences, bodies=[body])]
        caption = f"Lateral motion of the {body}, with the stiffness, grid and push of figure 20."
        yield study.table(names, study.over(depth_m=None), caption)
    planar = study.over(depth_m=None, dimensions=2, seed_mps=0.0, seed_direction="")
    across = ("offplane_growth_bits_per_period", "offplane_growth_error")
    caption = "Infinitesimal perturbation across the plane of planar runs, beside the fitted rate of the buoy above."
    if planar:
        yield study.table(["steepness", "depth_m", across, "loop_releases"], planar, caption)


def push_items(study: Study) -> Iterator[Item]:
    """Size of the push: curves scaled by it, curves as they are, and the numbers."""
    yield Heading("Size of the push")
    if loaded := study.loaded(study.pushes(study.base["steepness"])):
        yield _push_figure(study, loaded)
    names = of_bodies("early_gain_s", "first_burst_m", "lateral_late_m")
    runs = [run for steepness in study.steepnesses for run in study.pushes(steepness)]
    caption = (
        "The push and what becomes of it: for each body the first response by the push, which is the same for every "
        "push as long as the response is linear, the first burst, and what is reached in the second half."
    )
    yield study.table(["steepness", "nodes", "seed_mps", *names, "rope_motion"], runs, caption)


def _push_figure(study: Study, loaded) -> Figure:
    panels = []
    for body in BODIES:
        scaled, plain = [], []
        for run, trajectory in loaded:
            periods, size = envelope(trajectory, body)
            early, push = periods <= _SCALED_PERIODS, abs(trajectory.scene.start.buoy_velocity_mps[1])
            scaled.append((run["seed_mps"], periods[early], size[early] / push))
            plain.append((run["seed_mps"], *envelope(trajectory, body, _PLAIN_SPAN)))
        panels.append((f"{body}: per push", "$|y|$/push (s)", scaled))
        panels.append((f"{body}: as it is", "$|y|$ (m)", plain))
    caption = (
        f"Size of the push at kA = {number(study.base['steepness'])}, H = {number(study.base['depth_m'])} m, "
        f"{number(loaded[0][0]['nodes'])} nodes. Left: lateral distance by the push, first {_SCALED_PERIODS} wave "
        f"periods, the largest value in each; right: the distance itself, the largest value in each {_PLAIN_SPAN} wave "
        "periods. From `y_m` and `offplane_m`."
    )
    return Figure(seed_histories(panels), caption, f"Lateral motion for {len(loaded)} sizes of the push.")


def dependence_items(study: Study) -> Iterator[Item]:
    """Depth and bending stiffness: figure and tables."""
    large = study.select(depth_m=None, bending_stiffness_Nm2=None)
    if not large:
        return
    small = [run for run in study.over(bending_stiffness_Nm2=None) if run not in large]
    varied = sorted({run["bending_stiffness_Nm2"] for run in large})
    panels = [(body, [_curve(large, body, EI) for EI in varied]) for body in BODIES]
    caption = (
        f"Largest lateral distance in the second half of each run at kA = {number(study.base['steepness'])} over the "
        "depth. Filled: bursts, or neither; open: exponential decay, and what is left of it."
    )
    picture = dependence(panels, "max $|y|$, second half (m)")
    yield Heading("Depth and bending stiffness")
    yield Figure(picture, caption, "Lateral motion of buoy and rope over the depth.")
    names = [
        "steepness", "depth_m", "bending_stiffness_Nm2", *of_bodies("motion", _RATE, "lateral_max_m"), "rope_bursts",
        "rope_burst_median_m", "rope_share_of_inplane", "slack_fraction", "loop_releases", "max_turn_rad",
    ]  # fmt: skip
    caption = "Every depth and stiffness of the large wave, every stiffness of the small one."
    yield study.table(names, [*large, *(run for run in small if run["steepness"] != study.base["steepness"])], caption)


def _curve(runs, body: str, stiffness: float) -> tuple:
    chosen = [run for run in runs if run["bending_stiffness_Nm2"] == stiffness]
    depth, late = (np.array([run[name] for run in chosen]) for name in ("depth_m", f"{body}_lateral_late_m"))
    decays = np.array([run[f"{body}_motion"] == "decay" for run in chosen])
    return f"EI = {number(stiffness)} N m²", depth, late, decays


def direction_items(study: Study) -> Iterator[Item]:
    """Direction of the push."""
    runs = [run for word in _DIRECTIONS for run in study.over(seed_direction=word)]
    names = [
        "steepness", "seed_direction", "buoy_motion", ("buoy_rate_bits_per_period", "buoy_rate_error"),
        "buoy_early_gain_s", "buoy_lateral_max_m", "rope_motion", "rope_bursts", "rope_first_burst_m",
        "rope_lateral_max_m", "loop_releases",
    ]  # fmt: skip
    caption = (
        "Direction of the push: lateral (+y), mirrored (−y), oblique (45° between x and y), along the waves (x). The "
        "equations are symmetric: a mirrored push mirrors the motion, and one along the waves leaves y at zero."
    )
    yield Heading("Direction of the push")
    yield study.table(names, sorted(runs, key=lambda run: run["steepness"]), caption)


def grid_items(study: Study) -> Iterator[Item]:
    """Nodes: the first burst, the turn in an element, the rate."""
    runs = study.over(depth_m=None, nodes=None)
    several = {(run["steepness"], run["depth_m"]) for run in runs if run["nodes"] != study.base["nodes"]}
    names = [
        "steepness", "depth_m", "nodes", ("buoy_rate_bits_per_period", "buoy_rate_error"), "rope_early_gain_s",
        "rope_first_burst_period", "rope_first_burst_m", "rope_bursts", "rope_burst_median_m", "rope_lateral_max_m",
        "buoy_lateral_max_m", "max_turn_rad", "loop_releases", "wall_s",
    ]  # fmt: skip
    caption = "The grid. Loops are resolved where the largest turn within one element stays below π/2."
    yield Heading("Grid")
    yield study.table(names, [run for run in runs if (run["steepness"], run["depth_m"]) in several], caption)


def shape_items(study: Study) -> Iterator[Item]:
    """The rope at its largest lateral excursion."""
    loaded = study.loaded(study.select(profiles=1, nodes=None))
    if not loaded or loaded[0][1].profiles is None or not len(loaded[0][1].profiles.time_s):
        return
    run, trajectory = loaded[0]
    lines = trajectory.profiles
    widest = int(np.argmax(np.abs(lines.y_m).max(axis=1)))
    step_s = float(lines.time_s[1] - lines.time_s[0]) if len(lines.time_s) > 1 else 1.0
    near = dict.fromkeys(widest + round(offset / step_s) for offset in _SHAPE_OFFSETS_S)
    node = int(np.argmax(np.abs(lines.y_m[widest])))
    seen = (
        f"at t = {number(float(lines.time_s[widest]), 4)} s the rope is "
        f"{number(float(abs(lines.y_m[widest, node])), 2)} m off the plane, "
        f"{number(float(lines.s_m[node]), 3)} m of unstretched rope from the anchor, "
        f"while the buoy is {number(float(abs(lines.y_m[widest, -1])), 2)} m off it"
    )
    caption = (
        f"The rope in a loop at kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m: nodes as dots, the "
        f"buoy as a large dot; y has an axis of its own. Seen: {seen}."
    )
    inside = [i for i in near if 0 <= i < len(lines.time_s)]
    picture = rope_shapes([(f"{lines.time_s[i]:.1f} s", lines.x_m[i], lines.y_m[i], lines.z_m[i]) for i in inside])
    yield Heading("The rope in a loop")
    yield Figure(picture, caption, f"Shape of the rope from three sides: {seen}.")
    names = ["steepness", "depth_m", "nodes", "bow_inplane_m", "bow_lateral_m", "rope_lateral_max_m"]
    yield study.table(names, [run], "How far the rope bows out of the straight line between its ends.")


def comparison_items(study: Study) -> Iterator[Item]:
    """Planar runs with loop release and runs in three dimensions: what they are, and in what they agree."""
    yield Heading("Planar with loop release, or three dimensions?")
    pair_rows = read_rows(study.folder.directory / "pairs.csv")
    if not pair_rows:
        yield Text("No planar run released loops and ended as asked, as its counterpart did.")
        return
    yield Text(
        "In a plane a loop that is pulled tight cannot open, and the planar engine turns everything above it by 2π (a "
        "loop release); in three dimensions the loop leaves the plane by itself. The same scenes in both are judged "
        f"by the wave periods after the first {study.transient}, and both by their samples alone (`regime` without "
        "the tangent exponent, which runs in three dimensions do not have)."
    )
    by_key = {run["run_key"]: run for run in study.runs}
    pairs = [(by_key[row["planar_key"]], by_key[row["spatial_key"]]) for row in pair_rows]
    names = [
        "depth_m", "dimensions", "loop_releases", "max_turn_rad", "radius_min_m", "radius_max_m", "tension_top_max_N",
        "slack_fraction", ("lyapunov_wolf_bits_per_period", "lyapunov_wolf_error"),
        ("lyapunov_tangent_bits_per_period", "lyapunov_tangent_error"), "regime", "wall_s",
    ]  # fmt: skip
    runs_of_pairs = [run for pair in pairs for run in pair]
    yield study.table(names, runs_of_pairs, "Planar runs (D = 2) and their counterparts (D = 3).")
    columns = read_columns(study.folder.directory, "pairs.csv")
    shown = [name for name in columns if not name.endswith("_key")]
    yield table_of(columns, shown, pair_rows, "What the runs of a pair differ in. From `pairs.csv`.")
    sections = []
    for row, pair in zip(pair_rows, pairs, strict=True):
        runs = [strobed(trajectory, study.transient) for _, trajectory in study.loaded(pair)]
        sections += [(f"H = {number(value(row, 'depth_m'))} m", *runs)] if len(runs) == 2 else []
    if sections:
        caption = (
            f"Poincaré sections of planar runs with loop release and of runs in three dimensions, after "
            f"{study.transient} wave periods. From `radius_m` and `radius_rate_mps`."
        )
        picture = section_pairs(sections, ("planar", "three dimensions"))
        yield Figure(picture, caption, "Sections of planar and three-dimensional runs over each other.")
