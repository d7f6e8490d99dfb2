"""The report of `campaigns.oscillator`: what is said, in which order. Everything comes from the campaign's folder."""

import math
from functools import partial
from pathlib import Path

import numpy as np

from analysis.oscillator import SnapOscillator, grazing_force
from tables import count, number, percent, sub

from ..figures.oscillator import (
    oscillator_diagram,
    oscillator_errors,
    oscillator_history,
    oscillator_section,
    oscillator_zooms,
)
from ..parts import (
    Figure,
    Heading,
    Items,
    Notice,
    Report,
    Text,
    picture_first,
    report_page,
    section_items,
    table_of,
)
from .sections import NUMBERS, Study, attracting_orbit, method_items, orbit_items, read_study

LAMBDA_1 = "λ" + sub("1")


def report(directory: Path) -> Report:
    """The content of the report on an oscillator study's folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = []
    if study.faults:  # before the first heading: on the first page, after the answer
        missing = [f"`{part}`: {reason}." for part, reason in study.faults.items()]
        items.append(Notice("warning", "Parts without results", missing))
    items += section_items("oscillator")
    for part, (title, section) in SECTIONS.items():
        arrays = study.arrays.get(part)
        items.append(Heading(title))
        if arrays is None:
            items.append(Text(f"The part `{part}` has no results: {study.faults.get(part)}."))
        else:
            items += section(study, arrays)
    shown = ("part", "status", "starts", "periods", "transient", "wall_s")
    parts = table_of(study.columns, shown, study.rows.values(), "The parts of the study, from `table.csv`.")
    made = [method_items(study), Heading("Parts and times"), parts]
    numbers = (f"{symbol} = {number(study.oscillator[key])}" for key, (symbol, *_) in NUMBERS.items())
    return report_page(study, "The snap oscillator, equation (33)", picture_first(items), made, ", ".join(numbers))


def _section(study: Study, arrays: dict) -> Items:
    states, boxes, row = arrays["section"], arrays["boxes"], study.rows["section"]
    caption = (
        f"Poincaré section at the forcing phase {number(study.oscillator['phase'])} rad, in the layout of the paper's "
        f"figure 19(b): {len(states)} points, one a forcing period, after {row['transient']} periods. From the part "
        "`section`."
    )
    alt = f"Scatter of {len(states)} strobed points of displacement and velocity."
    items = [Figure(oscillator_section(states, boxes, attracting_orbit(study)), caption, alt)]
    zooms = [arrays[name] for name in ("zoom_1", "zoom_2") if name in arrays]
    if zooms and study.chaotic:  # a zoom into a periodic orbit shows a point
        counts = " and ".join(str(len(zoom)) for zoom in zooms)
        caption = (
            "Layers within layers: zooms by 10 and by 100 round the place visited most. They have "
            f"{counts} points out of {row['periods']} periods of the same orbit. A line resolves into several lines, "
            "and each of these again, because each period stretches the attractor along its lines and folds it at the "
            "snap. From the part `section`."
        )
        items.append(Figure(oscillator_zooms(zooms, boxes), caption, "Two zooms: bundles of nearly parallel lines."))
    return items


def _history(study: Study, arrays: dict) -> Items:
    switches = count(len(arrays.get("switches", ())), "switch", "switches")
    share = percent(study.number("history", "slack_fraction"))
    seen = f"{switches} in {study.rows['history']['periods']} periods, {share} of the time slack"
    picture = oscillator_history(arrays["time"] / study.period, arrays["displacement"], arrays["velocity"])
    caption = f"The first periods from γ = 0.68 at rest; shaded: slack. Seen: {seen}. From the part `history`."
    return [Figure(picture, caption, f"Histories of displacement and velocity: {seen}.")]


def _exponents(study: Study, arrays: dict) -> Items:
    row = study.rows["exponents"]
    text = (
        "Both exponents come from the exact tangent map, re-orthonormalised every period. They are averages over "
        f"{row['starts']} random starts of {row['periods']} periods each, after {row['transient']}. The error is the "
        "standard deviation over the starts by the root of their number. Starts that settled on a periodic attractor "
        f"are not counted ({row['elsewhere']}). Blocks of time alone give an error of "
        f"{float(arrays['block_error'][0]):.2g}. Both exponents and the damping must add up to zero. A Kaplan-Yorke "
        "dimension D between 1 and 2 is that of a fractal between a curve and an area."
    )
    caption = (
        f"Errors of the largest exponent. Left: {LAMBDA_1} against the length of the averages. Right: scatter "
        "of the mean of k starts against k (bars: two standard errors of the scatter) beside the line of independent "
        "starts. From the part `exponents`."
    )
    alt = "Convergence of the largest exponent with time, and its scatter against the number of starts."
    figure = Figure(oscillator_errors(arrays["convergence"], arrays["of_start"][:, 0]), caption, alt)
    shown = (
        "lambda_1_nats_per_time",
        "lambda_1_bits_per_period",
        "lambda_2_nats_per_time",
        "sum_plus_damping",
        "section_dimension",
    )
    return [Text(text), table_of(study.columns, shown, [row], "The exponents, from `table.csv`."), figure]


def _diagram(study: Study, arrays: dict, symbol: str, key: str, label: str) -> Items:
    if not np.isfinite(arrays["section"]).any():
        return [Text(f"There is no orbit diagram over {symbol}: no finite points.")]
    values, largest, errors = arrays["values"], arrays["exponents"][..., 0], arrays["errors"]
    marks = [(study.oscillator[key], "as run")]
    grazing = grazing_force(SnapOscillator(**study.oscillator))
    if key == "force" and math.isfinite(grazing):
        marks.append((grazing, "grazing"))
    curves = (arrays[name] for name in ("section", "exponents", "errors", "slack_fraction"))
    chaotic = int((largest - 2 * errors > 0).any(axis=1).sum())
    top = number(float(np.nanmax(largest)), 3), number(float(values[int(np.nanargmax(largest.max(axis=1)))]))
    seen = (
        f"{LAMBDA_1} is above zero by two errors, for one start at least, at {chaotic} of {len(values)} values; "
        f"its largest value is {top[0]} at {symbol} = {top[1]}"
    )
    row = study.rows[f"diagram-{key}"]
    caption = (
        f"Strobed displacement over {symbol}, both exponents and the share of slack time, the same four random "
        f"starts at every value, {row['periods']} periods after {row['transient']}. Where the four differ, "
        f"attractors coexist or a transient is long. Seen: {seen}. From the part `{row['part']}`."
    )
    picture = oscillator_diagram(values, *curves, label, marks)
    return [Figure(picture, caption, f"Orbit diagram over {symbol} with exponents below: {seen}.")]


SECTIONS = {  # part of the study: heading, what is said of its arrays
    "section": ("The section: figure 19(b)", _section),
    "history": ("The motion from rest", _history),
    "exponents": ("Exponents and their errors", _exponents),
    "diagram-force": (
        "Orbit diagram over the forcing",
        partial(_diagram, symbol="F", key="force", label=r"forcing $F$ (–)"),
    ),
    "diagram-frequency": (
        "Orbit diagram over the frequency",
        partial(_diagram, symbol="ω", key="frequency", label=r"forcing frequency $\omega$ (–)"),
    ),
    "orbits": ("Periodic orbits", orbit_items),
}
