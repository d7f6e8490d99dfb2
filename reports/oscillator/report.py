"""The report of `campaigns.oscillator`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..figures.oscillator_diagram import oscillator_diagram
from ..figures.oscillator_errors import oscillator_errors
from ..figures.oscillator_history import oscillator_history
from ..figures.oscillator_section import oscillator_section, oscillator_zooms
from ..parts.columns import table_of
from ..parts.content import Bullets, Column, Figure, Heading, Item, Notice, Report, Table, Text, sub
from ..parts.provenance import provenance_items
from ..parts.wording import count, decimals, number, percent
from .attractors import basin_items, grazing_items, orbit_items
from .equation import equation_items, subtitle
from .folder import Study, read_study

LAMBDA_1, LAMBDA_2 = "λ" + sub("1"), "λ" + sub("2")
DIAGRAMS = {  # part: symbol, label of the axis, number of eq. (33)
    "diagram-force": ("F", r"forcing $F$ (–)", "force"),
    "diagram-frequency": ("ω", r"forcing frequency $\omega$ (–)", "frequency"),
}


def report(directory: str | Path) -> Report:
    """The content of the report on an oscillator study's folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = [
        *_question(study),
        *_section(study),
        *_exponents(study),
        *_diagrams(study),
        *basin_items(study),
        *orbit_items(study),
        *grazing_items(study),
        *equation_items(study),
        Heading("Parts and times"),
        table_of(
            study.columns,
            ("part", "status", "starts", "periods", "transient", "wall_s"),
            study.rows.values(),
            "The parts of the study, from `table.csv`.",
        ),
        *provenance_items(study),
    ]
    return Report("The snap oscillator, equation (33)", subtitle(study), tuple(items))


def _question(study: Study) -> list[Item]:
    lines = []
    value, error = _exponent(study)
    if math.isfinite(value):
        verdict = (
            "positive by more than two standard errors: nearby motions part exponentially, the motion is chaotic"
            if _chaotic(study)
            else "negative: the motion is regular"
            if value < -2 * error
            else "zero within two standard errors"
        )
        bits = (study.number("exponents", f"lambda_1_bits_{name}") for name in ("per_period", "error"))
        lines.append(
            f"The largest exponent is {LAMBDA_1} = {_with_error(value, error)} nats per unit of time, "
            f"{_with_error(*bits)} bits per forcing period. It is {verdict}."
        )
        rest = abs(study.number("exponents", "sum_plus_damping"))
        lines.append(f"Both exponents and the damping add up to zero, as they must, within {rest:.0e}.")
        dimension = study.number("exponents", "section_dimension")
        if dimension > 0.0:
            within = _with_error(dimension, study.number("exponents", "section_dimension_error"))
            lines.append(
                f"The section has the Kaplan-Yorke dimension {within}, between that of a curve and of an area."
            )
    shares = study.arrays.get("basins", {}).get("shares")
    if shares is not None:
        settled = count(len(shares) - 1, "periodic attractor")
        ends, rest = percent(float(shares[:-1].sum())), percent(float(shares[-1]))
        lines.append(f"{settled} found: {ends} of the starts end there, {rest} do not settle.")
    force = study.number("grazing", "grazing_force")
    if math.isfinite(force):
        lines.append(f"The taut motion first goes slack at F = {force:.14g}.")
    question = (
        "To see the fractal structure of the strange attractor, the paper (Tjavaras, Zhu, Liu, Triantafyllou and Yue "
        "1998, section 4.2) reduces the tethered buoy to its radial motion on a tether that pulls but does not push: "
        "equation (33), with its section in figure 19(b). Is that motion chaotic, by how much, with what certainty, "
        "and what else can the oscillator do?"
    )
    answer = Bullets(tuple(lines) or ("No part of this study gave a number; see the faults below.",))
    items: list[Item] = [Heading("Question"), Text(question), Heading("Short answer"), answer]
    if study.faults:
        missing = tuple(f"`{part}`: {reason}." for part, reason in study.faults.items())
        items.append(Notice("warning", "Parts without results", missing))
    return items


def _section(study: Study) -> list[Item]:
    items: list[Item] = [Heading("The section: figure 19(b)")]
    arrays = study.arrays.get("section")
    if arrays is None:
        return [*items, Text(f"There is no section: {study.faults['section']}.")]
    states, boxes, row = arrays["section"], arrays["boxes"], study.rows["section"]
    (left, low), (right, high) = ((decimals(one, 2) for one in edge(axis=0)) for edge in (states.min, states.max))
    extent = f"γ from {left} to {right} and velocity from {low} to {high}"
    caption = (
        f"Poincaré section at the forcing phase {number(study.oscillator['phase'])} rad, in the layout of the paper's "
        f"figure 19(b): {len(states)} points, one a forcing period, after {row['transient']} periods. Seen: points "
        f"within {extent}. From the part `section`."
    )
    orbit = study.arrays.get("basins", {}).get("orbit_1")
    alt = f"Scatter of {len(states)} strobed points of displacement and velocity, within {extent}."
    items.append(Figure(oscillator_section(states, boxes, orbit), caption, alt))
    zooms = [arrays[name] for name in ("zoom_1", "zoom_2") if name in arrays]
    if zooms and _chaotic(study):  # a zoom into a periodic orbit shows a point
        counts = " and ".join(str(len(zoom)) for zoom in zooms)
        seen = f"zooms by 10 and by 100 round the place visited most, {counts} points out of {row['periods']} periods"
        caption = (
            f"Layers within layers; {seen} of the same orbit. A line resolves into several lines, and each of these "
            "again, because each period stretches the attractor along its lines and folds it at the snap. From the "
            "part `section`."
        )
        items.append(Figure(oscillator_zooms(zooms, boxes), caption, f"Bundles of nearly parallel lines: {seen}."))
    motion = study.arrays.get("history")
    if motion is not None:
        period = 2.0 * math.pi / study.oscillator["frequency"]
        switches = count(len(motion.get("switches", ())), "switch", "switches")
        share = percent(study.number("history", "slack_fraction"))
        seen = f"{switches} in {study.rows['history']['periods']} periods, {share} of the time slack"
        picture = oscillator_history(motion["time"] / period, motion["displacement"], motion["velocity"])
        caption = f"The first periods from γ = 0.68 at rest; shaded: slack. Seen: {seen}. From the part `history`."
        items.append(Figure(picture, caption, f"Histories of displacement and velocity: {seen}."))
    return items


def _exponents(study: Study) -> list[Item]:
    arrays = study.arrays.get("exponents")
    if arrays is None:
        return [Heading("Exponents"), Text(f"There are no exponents: {study.faults['exponents']}.")]
    row, (value, error) = study.rows["exponents"], _exponent(study)
    text = (
        "Both exponents come from the exact tangent map, re-orthonormalised every period. They are averages over "
        f"{row['starts']} random starts of {row['periods']} periods each, after {row['transient']}. The error is the "
        "standard deviation over the starts by the root of their number. Starts that settled on a periodic attractor "
        f"are not counted ({row['elsewhere']}). The same error from blocks of time alone is "
        f"{float(arrays['block_error'][0]):.2g}, against {error:.2g}."
    )
    seen = f"the mean ends at {_with_error(value, error)}"
    caption = (
        f"Errors of the largest exponent. Left: {LAMBDA_1} against the length of the averages; {seen}. Right: scatter "
        "of the mean of k starts against k (bars: two standard errors of the scatter) beside the line of independent "
        "starts. From the part `exponents`."
    )
    alt = f"Convergence of the largest exponent with time, where {seen}, and its scatter against the number of starts."
    figure = Figure(oscillator_errors(arrays["convergence"], arrays["of_start"][:, 0]), caption, alt)
    return [Heading("Exponents and their errors"), Text(text), _exponent_table(study), figure]


def _exponent_table(study: Study) -> Table:
    """Exponent and error against the time averaged."""
    convergence = study.arrays["exponents"]["convergence"]
    damping, period = study.oscillator["damping"], 2.0 * math.pi / study.oscillator["frequency"]
    bits = period / math.log(2.0)
    rows = []
    for time, mean, error in convergence[np.unique(np.geomspace(1, len(convergence), 7).round().astype(int)) - 1]:
        second = -damping - mean
        places = max(2, min(12, 1 - math.floor(math.log10(error)))) if error > 0 else 6
        nats = (decimals(number, places) for number in (mean, error, second))
        in_bits = (decimals(number * bits, max(1, places - 1)) for number in (mean, error))
        dimension = decimals(1.0 + mean / abs(second) if mean > 0 else 0.0, 4)
        rows.append((str(round(time / period)), decimals(time, 0), *nats, *in_bits, dimension))
    columns = (
        Column("average over", "periods"), Column("time"), Column(LAMBDA_1, "nats/time"), Column("error", "nats/time"),
        Column(LAMBDA_2, "nats/time"), Column(LAMBDA_1, "bits/period"), Column("error", "bits/period"),
        Column("D of the section"),
    )  # fmt: skip
    starts = study.rows["exponents"]["starts"]
    caption = f"Exponents against the time averaged for each of {starts} starts; one standard error. From `exponents`."
    return Table(columns, tuple(rows), caption)


def _diagrams(study: Study) -> list[Item]:
    items: list[Item] = [Heading("Orbit diagrams")]
    grazing = study.number("grazing", "grazing_force")
    for part, (symbol, label, key) in DIAGRAMS.items():
        arrays = study.arrays.get(part)
        if arrays is None or not np.isfinite(arrays["section"]).any():
            why = study.faults.get(part, "no finite points")
            items.append(Text(f"There is no orbit diagram over {symbol}: {why}."))
            continue
        values, largest, errors = arrays["values"], arrays["exponents"][..., 0], arrays["errors"]
        marks = [(study.oscillator[key], "as run")]
        marks += [(grazing, "grazing")] if key == "force" and math.isfinite(grazing) else []
        picture = oscillator_diagram(
            values, arrays["section"], arrays["exponents"], errors, arrays["slack_fraction"], label, marks
        )
        chaotic = int((largest - 2 * errors > 0).any(axis=1).sum())
        top = number(float(np.nanmax(largest)), 3), number(float(values[int(np.nanargmax(largest.max(axis=1)))]))
        seen = (
            f"{LAMBDA_1} is above zero by two errors, for one start at least, at {chaotic} of {len(values)} values; "
            f"its largest value is {top[0]} at {symbol} = {top[1]}"
        )
        row = study.rows[part]
        caption = (
            f"Strobed displacement over {symbol}, both exponents and the share of slack time, the same four random "
            f"starts at every value, {row['periods']} periods after {row['transient']}. Where the four differ, "
            f"attractors coexist or a transient is long. Seen: {seen}. From the part `{part}`."
        )
        items.append(Figure(picture, caption, f"Orbit diagram over {symbol} with exponents below: {seen}."))
    return items


def _exponent(study: Study) -> tuple[float, float]:
    return study.number("exponents", "lambda_1_nats_per_time"), study.number("exponents", "lambda_1_error")


def _chaotic(study: Study) -> bool:
    value, error = _exponent(study)
    return value - 2 * error > 0.0


def _with_error(value: float, error: float) -> str:
    """The value with as many decimals as its error has to two digits."""
    if not math.isfinite(error) or error <= 0.0:
        return number(value, 6)
    places = min(max(0, 1 - math.floor(math.log10(error))), 15)
    return f"{decimals(value, places)} ± {decimals(error, places)}"
