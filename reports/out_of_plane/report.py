"""The report of `campaigns.out_of_plane`: what is said, in which order. Everything comes from the campaign's folder.

Tables of the folder, figures of its runs, and the same sentences each time.
"""

import math
from itertools import chain
from pathlib import Path

import numpy as np

from engine.views import strobed_radius
from tables import (
    BODIES,
    COST,
    PAIRS,
    PLANE,
    RUNS,
    any_rows,
    count,
    errors_of,
    listed,
    number,
    number_of,
    verdict_counts,
)

from ..figures.curves import COLOURS, Curve, Panel, curves, dots
from ..figures.offplane_history import History, lateral_histories
from ..parts import (
    LONGEST_CELL,
    Bullets,
    Figure,
    Heading,
    Items,
    Notice,
    Report,
    Row,
    Text,
    batched,
    entries,
    having,
    limits,
    picture_first,
    read_columns,
    read_statements,
    report_page,
    scene_items,
    section_items,
    series,
    shown_on,
    statements_table,
    table_of,
    timing_items,
)
from .runs import VARIED, Study, columns_of_bodies, envelope, read_study

_MOST = 18  # columns of one table
_RESOLVED_RAD = 0.5 * math.pi  # in one element
_PAIRS = "pairs.csv"


def report(directory: Path) -> Report:
    """The content of the report on an out-of-plane folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = [
        section_items("out_of_plane"),
        statement_items(study),
        growth_items(study),
        dependence_items(study),
        comparison_items(study),
        Heading("Warnings"),
        _warnings(study),
        Heading("Table of runs"),
        _runs_tables(study),
    ]
    title = "Tethered buoy: out of the plane of the waves"
    return report_page(study.folder, title, picture_first(items), _scene_and_times(study))


def statement_items(study: Study) -> Items:
    """The verdicts on the paper's statements and on planar runs; buoy and rope after the usual push."""
    judged, pairs = read_statements(study.folder.directory), any_rows(study.folder.directory / _PAIRS)
    if judged:
        yield Heading("The paper's statements on figure 20")
        yield Bullets([f"The paper's statements on figure 20: {verdict_counts(judged)}."])
        yield statements_table(judged, "The paper's statements on figure 20. From `statements.csv`.")
    if pairs:
        yield Bullets([_agreement(pairs)])
    names = columns_of_bodies(
        "motion", "rate_bits_per_period", "bursts", "burst_median_m", "rise_nats", "rise_periods", "lateral_max_m"
    )
    caption = "Both waves after the usual push, as in figure 20 of the paper."
    yield study.table(["steepness", "depth_m", "seed_mps", *names], study.over(), caption)


def _agreement(pairs: list[dict[str, str]]) -> str:
    """In how many pairs the planar run agrees with the run in three dimensions."""
    agreeing = len(pairs)
    for pair in pairs:
        for name, verdict in pair.items():
            if name.startswith("same_") and verdict == "0":
                agreeing -= 1
                break
    return (
        f"Planar runs with loop release agree with the runs in three dimensions in {agreeing} of {len(pairs)} pairs: "
        "range of r, section, exponent and regime of the buoy, as far as the records tell. The planar run is no "
        "substitute for the rope's shape in the loops, nor for the buoy's path once the runs have parted."
    )


def figure_20(study: Study) -> Items:
    """Figure 20: lateral motion of buoy and rope for both waves."""
    loaded = study.loaded(study.over())
    if not loaded:
        yield Text("In neither wave did the run with the usual push end as asked, so there is no figure of it.")
        return
    yield Text(
        "At t = 0 the buoy gets a small velocity across the waves; everything else is as in a planar run. The paper "
        "shows the buoy alone."
    )
    labels = {"buoy": "buoy, $|y|$ (m)", "rope": "rope, largest $|y|$ (m)"}
    panels = []
    for body in BODIES:
        histories = [_history(run, trajectory, body) for run, trajectory in loaded]
        panels.append((labels[body], histories))
    first_run = loaded[0][0]
    caption = (
        f"Lateral motion of the buoy (as fig. 20 of the paper) and of the rope after a push of "
        f"{number(first_run['seed_mps'])} m/s across the waves, H = {number(first_run['depth_m'])} m. Thick: the "
        "largest value in each wave period; thin: every sample; dotted: half the range of the buoy in the plane."
    )
    yield Figure(lateral_histories(panels), caption, "Lateral motion on a logarithmic axis for both waves.")


def _history(run, trajectory, body: str) -> History:
    periods = trajectory.columns["time_s"] / trajectory.scene.waves.period_s
    size = np.abs(trajectory.columns[BODIES[body]])
    return History(f"kA = {number(run['steepness'])}", periods, size, *envelope(trajectory, body), run["inplane_m"])


def growth_items(study: Study) -> Items:
    """Figure 20; growth or bursts of both waves at every depth, and the exponent across the plane of planar runs."""
    yield Heading("Growth, decay or bursts")
    yield from figure_20(study)
    yield Text(
        "A rate is given only where the logarithm of the envelope (largest |y| in four wave periods, longer than half "
        "a lateral swing; where those are too few, in one) has a straight part of at least three nats and nine points "
        "that separates what comes before from what comes after; its error is the scatter of the slopes of its "
        "quarters. Otherwise maxima of single periods that stand three nats above the dips on both sides are bursts; "
        "no rate is given for the rise of a burst."
    )
    columns = study.folder.columns
    across, errors = [], set(errors_of(columns).values())
    for name, column in columns.items():
        if column.page == PLANE and name not in errors:
            across.append(name)
    for body in BODIES:
        names = ["steepness", "depth_m", *(name for name in across if name.startswith(body))]
        caption = f"Lateral motion of the {body}, with the usual stiffness, grid and push."
        yield study.table(names, study.over(depth_m=None), caption)
    planar = study.over(depth_m=None, dimensions=2, seed_mps=0.0, seed_direction="")
    caption = "Infinitesimal perturbation across the plane of planar runs, beside the fitted rate of the buoy above."
    if planar:
        names = ["steepness", "depth_m", "offplane_growth_bits_per_period", "loop_releases"]
        yield study.table(names, planar, caption)


def dependence_items(study: Study) -> Items:
    """Depth and bending stiffness: figure and tables."""
    large = study.select(depth_m=None, bending_stiffness_Nm2=None)
    if not large:
        return
    small = [run for run in study.over(bending_stiffness_Nm2=None) if run["steepness"] != study.base["steepness"]]
    stiffnesses = sorted(set(entries(large, "bending_stiffness_Nm2")))
    panels = []
    for body in BODIES:
        lines = []
        for stiffness, colour, mark in zip(stiffnesses, COLOURS, "os^D", strict=False):
            runs = having(large, bending_stiffness_Nm2=stiffness)
            depth, size = series(runs, "depth_m"), series(runs, f"{body}_lateral_late_m")
            decays = np.array(entries(runs, f"{body}_motion")) == "decay"
            name = f"EI = {number(stiffness)} N m²"
            lines.append(Curve(depth, size, colour=colour, width=0.6, alpha=0.6))
            lines.append(dots(depth[~decays], size[~decays], mark, colour, 4.5, name=name))
            lines.append(dots(depth[decays], size[decays], mark, colour, 4.5, filled=False))
        panels.append(Panel(lines, "depth $H$ (m)", "max $|y|$, second half (m)", body, log="y"))
    caption = (
        f"Largest lateral distance in the second half of each run at kA = {number(study.base['steepness'])} over the "
        "depth. Filled: bursts, or neither; open: exponential decay, and what is left of it."
    )
    yield Heading("Depth and bending stiffness")
    yield Figure(curves([panels], 2.9, "below"), caption, "Lateral motion of buoy and rope over the depth.")
    bodies = columns_of_bodies("motion", "rate_bits_per_period", "lateral_max_m")
    bursts = ("rope_bursts", "rope_burst_median_m", "rope_share_of_inplane")
    limits = ("slack_fraction", "loop_releases", "max_turn_rad")
    names = ["steepness", "depth_m", "bending_stiffness_Nm2", *bodies, *bursts, *limits]
    caption = "Every depth and stiffness of the large wave, every stiffness of the small one."
    yield study.table(names, [*large, *small], caption)


def comparison_items(study: Study) -> Items:
    """Planar runs with loop release and runs in three dimensions: what they are, and in what they agree."""
    yield Heading("Planar with loop release, or three dimensions?")
    pair_rows = any_rows(study.folder.directory / _PAIRS)
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
    runs_of_pairs = list(chain.from_iterable(pairs))
    compared = shown_on(study.folder.columns, runs_of_pairs, PAIRS)
    names = ["depth_m", "dimensions", "loop_releases", "max_turn_rad", *compared, "wall_s"]
    yield study.table(names, runs_of_pairs, "Planar runs (D = 2) and their counterparts (D = 3).")
    columns = read_columns(study.folder.directory / "pairs_columns.csv")
    shown = [name for name in columns if not name.endswith("_key")]
    yield table_of(columns, shown, pair_rows, "What the runs of a pair differ in. From `pairs.csv`.")
    panels = []
    for row, pair in zip(pair_rows, pairs, strict=True):
        points = [strobed_radius(trajectory, study.transient) for _, trajectory in study.loaded(pair)]
        if len(points) == 2:
            title, labels = f"H = {number(number_of(row, 'depth_m'))} m", (r"$r$ (m)", r"$\dot{r}$ (m/s)")
            planar = dots(*points[0].T, size=5.0, name="planar", width=0.7, filled=False)
            spatial = dots(*points[1].T, ".", size=3.0, name="three dimensions")
            panels.append(Panel([planar, spatial], *labels, title, ticks=4))
    if panels:
        caption = (
            f"Poincaré sections of planar runs with loop release and of runs in three dimensions, after "
            f"{study.transient} wave periods. From `radius_m` and `radius_rate_mps`."
        )
        picture = curves([panels], 2.9, "below")
        yield Figure(picture, caption, "Sections of planar and three-dimensional runs over each other.")


def _runs_tables(study: Study) -> Items:
    columns = study.folder.columns
    named = [*VARIED[:-1], "periods", "status", *columns_of_bodies("motion")]
    others = shown_on(columns, study.runs, RUNS, COST, longest=LONGEST_CELL)
    for names in batched(list(dict.fromkeys([*named, *others])), _MOST):
        yield study.table(names, study.runs, "Every run.")


def _warnings(study: Study) -> Items:
    pushed = []  # in three dimensions, out of the plane
    for run in having(study.runs, status="ok", dimensions=3):
        if run["seed_direction"] != "along":
            pushed.append(run)
    coarse = [run["nodes"] for run in pushed if run["max_turn_rad"] > _RESOLVED_RAD]
    failed, lost, looped, turned = [], [], [], []
    for run in study.runs:
        if run["status"] != "ok":
            reason = ": ".join(filter(None, (run["status"], run["message"])))
            failed.append(f"{_name(run)}: {reason}.")
        elif not study.folder.trajectory_path(run["run_key"]).exists():
            lost.append(f"{_name(run)}: its trajectory is missing; figures leave it out.")
    for run in pushed:
        if run["loop_releases"] > 0:
            looped.append(f"{_name(run)}: {count(int(run['loop_releases']), 'release')}.")
    unresolved = "an element turns by more than π/2: loops are not resolved, and the sizes of bursts depend on the grid"
    for nodes in sorted(set(coarse)):
        turned.append(f"{count(coarse.count(nodes), 'run')} on {number(nodes)} nodes: {unresolved}.")
    boxes = {
        "Runs that failed": failed,
        "Runs without a trajectory": lost,
        "Loops released in three dimensions": looped,
        "Turns within one element": turned,
    }
    notices = [Notice("warning", title, lines) for title, lines in boxes.items() if lines]
    return notices or [limits("", (), "No run failed, no loop was released, and every turn is resolved.")]


def _name(run: Row) -> str:
    pushed = f"push {number(run['seed_mps'])} m/s {run['seed_direction']}" if run["dimensions"] == 3 else "planar"
    return (
        f"kA = {number(run['steepness'])}, H = {number(run['depth_m'])} m, EI = {number(run['bending_stiffness_Nm2'])} "
        f"N m², {number(run['nodes'])} nodes, {pushed}"
    )


def _scene_and_times(study: Study) -> Items:
    yield timing_items(study.folder)
    keys = {
        "steepness": "waves.steepness",
        "depth_m": "water.depth_m",
        "bending_stiffness_Nm2": "tether.bending_stiffness_Nm2",
        "nodes": "tether.nodes",
        "dimensions": "motion.dimensions",
    }
    varied = {}
    for name, key in keys.items():
        varied[key] = listed(map(number, sorted(set(entries(study.runs, name)))))
    varied["start.buoy_velocity_mps"] = "see the table of runs"
    if np.isfinite(series(study.runs, "offplane_growth_bits_per_period")).any():
        varied |= {"output.tangent_vectors": "1 in planar runs", "output.lateral_growth": "yes in planar runs"}
    if any(entries(study.runs, "profiles")):
        varied["output.profiles"] = "yes in one run"
    yield scene_items(study.folder.scene, "tethered_buoy", varied)
