"""The report of `campaigns.breaking_line`: what is said, in which order. Everything comes from its folder."""

from __future__ import annotations

import math
from pathlib import Path

from ..buoy_sweep.equations import LAWS
from ..parts.content import Bullets, Equation, Figure, Heading, Item, Notice, Report, Text
from ..parts.folder import Folder, read_folder
from ..parts.provenance import provenance_items, timing_table
from ..parts.scene_table import scene_table
from ..parts.wording import count, decimals, listed, number, percent
from . import figures, grids, tables
from .runs import COLUMNS, WORDS, Line, of_kind, pairs, read_lines
from .statements import statements_table

ANIMATED = "4"
MOST_TURN_RAD = 0.6
CLOSED = 1e-3  # of the stored energy
MOTION = Equation(
    "m (partial bold(V)) / (partial t) = (partial bold(N)) / (partial s) - m g bold(k), quad "
    "(partial bold(q)) / (partial t) = (partial bold(V)) / (partial s), quad bold(q) = (1 + epsilon) bold(t)",
    "Mass times acceleration is the slope of the internal force less the weight; the stretch vector changes with the "
    "slope of the velocity.",
)
FORCE = Equation(
    'bold(N)(L, t) = bold(F)_s cos^2 (pi t) / (2 t_(b r)), quad t < t_(b r); quad upright("zero after")',
    "The force at the broken end falls as the static force times the squared cosine of pi t over two t b r.",
)
VISCOSITY = Equation(
    "T = f(epsilon) + a m [c_q h^2 abs(epsilon_t) epsilon_t + c_l c h epsilon_t], quad c = sqrt(max(f', 0) \\/ m)",
    "Tension is the law plus a limited viscous part, quadratic and linear in the strain rate.",
)


def report(directory: str | Path) -> Report:
    """The content of the report on a breaking-line folder. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, COLUMNS, WORDS)
    lines = read_lines(folder)
    items = [
        *_question(lines),
        Heading("The cases"),
        tables.cases_table(lines),
        *_warnings(lines),
        *_paper_figures(lines),
        *_fronts(lines),
        *_energy(lines),
        Heading("The paper's statements"),
        statements_table(lines),
        *_section("Bending stiffness", grids.stiffness_table(lines)),
        *_grids(lines),
        Heading("Run times"),
        *filter(None, (_eight(folder, lines), tables.cost_table(lines), timing_table(folder))),
        *_scene(folder),
        *_equations(folder),
        *provenance_items(folder),
    ]
    return Report("The breaking synthetic line", folder.scene.title or folder.scene.name, tuple(items))


def _question(lines: tuple[Line, ...]) -> list[Item]:
    return [
        Heading("Question"),
        Text(
            "A taut synthetic line breaks at one end. How does it recoil: how fast are the end and the fronts, where "
            "do shocks form, what happens at the fixed end, and where does the stored energy go? This is section 4.1 "
            "of Tjavaras, Zhu, Liu, Triantafyllou and Yue, “The mechanics of highly-extensible cables”, Journal of "
            "Sound and Vibration 213(4), 1998 (“the paper”): four static tensions, fracture in 5 ms (cases 1 to 4) "
            "and in 50 ms (1′ to 4′)."
        ),
        Heading("Short answer"),
        Bullets(tuple(line for line in (*_answer(lines),) if line)),
    ]


def _answer(lines: tuple[Line, ...]) -> list[str]:
    cases = [line for line in lines if line.kind == "case"]
    good = of_kind(lines, "case")
    said = [f"{len(good)} of {count(len(cases), 'case')} ended as asked."]
    speeds = [line for line in good if math.isfinite(line.value("end_speed_error"))]
    if speeds:
        off = max(line.value("end_speed_error") for line in speeds)
        words = listed(f"{decimals(line.value('end_speed_mps'), 1)} ({line.name})" for line in speeds)
        said.append(f"The broken end recoils at {words} m/s, within {percent(off)} of the exact motion.")
    fronts = [line.value("front_speed_mps") / line.value("front_speed_theory_mps") - 1.0 for line in good]
    fronts = [abs(off) for off in fronts if math.isfinite(off)]
    if fronts:
        seen = count(len(fronts), "front")
        said.append(f"The {seen} that can be followed run within {percent(max(fronts))} of √(T′/m).")
    said += [_shock_said(line) for line in good if math.isfinite(line.value("shock_birth_theory_m"))]
    left = [line for line in good if line.value("x_min_m") < -0.1]
    if left:
        words = listed(f"{decimals(-line.value('x_min_m'), 2)} m (case {line.name})" for line in left)
        said.append(f"The line passes the fixed end by {words}.")
    taken = pairs(lines)
    if taken and all(math.isfinite(line.share("end_work_J")) for pair in taken for line in pair):
        words = listed(f"{percent(-one.share('end_work_J'))} in {one.name}" for pair in taken for one in pair)
        said.append(
            f"The kinetic energy does depend on the fracture time: of what was stored the decaying end force takes out "
            f"{words}."
        )
    closed = [line for line in good if math.isfinite(line.value("remainder_largest_J"))]
    if closed:
        worst = max(line.value("remainder_largest_J") / line.value("stored_J") for line in closed)
        said.append(f"At no time is more than {percent(worst)} of the stored energy unaccounted for.")
    return said


def _shock_said(line: Line) -> str:
    place = decimals(line.value("shock_birth_theory_m"), 1)
    born = f"Case {line.name} forms a shock, by theory {place} m from the broken end"
    off = line.value("shock_offset_elements")
    if not math.isfinite(off):
        return f"{born}; the run shows too little of it to be followed."
    far = number(1e3 * line.value("shock_offset_largest_m"), 2)
    return f"{born}; the run's follows the exact one within {far} mm, {number(off, 2)} elements in the median."


def _warnings(lines: tuple[Line, ...]) -> list[Item]:
    told = [f"{_run(line)}: {line.row['status']}: {line.row['message']}" for line in lines if not line.ok]
    told += [f"Case {line.name}: {line.fault}; its figures are left out." for line in lines if line.fault]
    told += [
        f"{_run(line)} turns by {decimals(line.value('max_turn_rad'), 2)} rad within one element: its folds are not "
        "resolved, add nodes."
        for line in lines
        if line.ok and line.value("max_turn_rad") > MOST_TURN_RAD
    ]
    told += [
        f"The energy budget of case {line.name} does not close to {percent(CLOSED)}."
        for line in of_kind(lines, "case")
        if line.value("remainder_largest_J") > CLOSED * line.value("stored_J")
    ]
    return [Notice("warning", "What limits these runs", tuple(told))] if told else []


def _run(line: Line) -> str:
    """A run in words."""
    stiffness = f", EI = {number(line.value('bending_stiffness_Nm2'))} N m²" if line.kind == "stiffness" else ""
    return f"Case {line.name}{tables.KINDS.get(line.kind, '')}{stiffness}, {number(line.value('nodes'))} nodes"


def _paper_figures(lines: tuple[Line, ...]) -> list[Item]:
    items: list[Item] = []
    for heading, speed in (("Fast breaks", "fast"), ("Slow breaks", "slow")):
        drawn = figures.paper_figures(lines, speed)
        items += [Heading(heading), *drawn] if drawn else []
    moving = figures.animation_figure(lines, ANIMATED)
    folded = figures.folds_figure(lines)
    return [*items, *_section("At the fixed end", folded), *_section("In motion", moving)]


def _section(heading: str, item: Item | None) -> list[Item]:
    return [Heading(heading), item] if item is not None else []


def _fronts(lines: tuple[Line, ...]) -> list[Item]:
    if not any(math.isfinite(line.value("front_speed_theory_mps")) for line in of_kind(lines, "case")):
        return []
    theory = (
        "Without gravity and bending the line is a one-dimensional elastic wave. The unloading that leaves the broken "
        "end is a simple wave: every tension runs at its own speed √(T′/m). Where the law is concave, above its "
        "inflection, lower tensions are faster than higher ones: the front steepens, and a shock forms that obeys the "
        "conditions of Rankine and Hugoniot. The exact solution used here follows characteristics and fits the shock "
        "between them (`analysis/line_waves`)."
    )
    pictures: list[Figure | None] = [figures.plane_figure(lines), figures.speeds_figure(lines)]
    shown = (*pictures, tables.speeds_table(lines), tables.shocks_table(lines), grids.series_table(lines))
    return [Heading("Fronts and shocks"), Text(theory), *filter(None, shown)]


def _energy(lines: tuple[Line, ...]) -> list[Item]:
    table = tables.energy_table(lines)
    if table is None:
        return []
    text = (
        "Work and dissipation are added up step by step from the equations that each step solves: the force at the end "
        "on its way, the shock viscosity, the shear forces (bending has no potential in the paper's equations where "
        "the strain varies), and what the scheme itself dissipates, in space by taking products of means for means of "
        "products, in time by the damping of the integrator. What remains tells how well the equations were solved."
    )
    return [Heading("Energy"), Text(text), *filter(None, (figures.energy_figure(lines), table))]


def _grids(lines: tuple[Line, ...]) -> list[Item]:
    table = grids.doubled_table(lines)
    if table is None:
        return []
    text = (
        "What twice the elements change at most, over the cases: "
        f"{listed(grids.changes_said(lines))}. What is left in the folds is the spread of their details: a fold that "
        "is pushed together chooses its side by small numbers."
    )
    return [Heading("Doubled grids"), Text(text), table]


def _eight(folder: Folder, lines: tuple[Line, ...]) -> Text | None:
    walls = [line.value("wall_s") for line in lines if line.kind == "case" and math.isfinite(line.value("wall_s"))]
    if not walls:
        return None
    jobs = folder.provenance.get("jobs")
    at_once = f" at {jobs} at once" if isinstance(jobs, int) else ""
    return Text(
        f"The {count(len(walls), 'case')} take {decimals(sum(walls), 1)} s of computing after compilation, "
        f"{decimals(min(walls), 1)} to {decimals(max(walls), 1)} s each{at_once}; the rest are companions."
    )


def _scene(folder: Folder) -> list[Item]:
    drawn = folder.provenance.get("cases")
    words = listed(case.replace("p", "′") for case in drawn) if isinstance(drawn, list) and drawn else "as asked"
    swept = {"end.force_N": f"cases {words}", "end.force_decay_s": "0.005 (1 to 4), 0.05 (1′ to 4′)"}
    caption = "The scene as run, from `scene.toml`; defaults are those of the scene `breaking_line`."
    table = scene_table(folder.scene, "breaking_line", swept, caption)
    return [Heading("Scene"), table]


def _equations(folder: Folder) -> list[Item]:
    return [
        Heading("Equations"),
        Text("In fixed axes and conservation form, with the shear force from the bending moments:"),
        MOTION,
        Text("with the tension law"),
        LAWS[folder.scene.tether.tension.law],
        Text("and, at the end that breaks,"),
        FORCE,
        Text(
            "Shocks are captured by a viscosity that a limiter a confines to them (a = 0 where the strain rate varies "
            "smoothly):"
        ),
        VISCOSITY,
    ]
