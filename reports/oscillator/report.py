"""The report of `campaigns.oscillator`: what is said, in which order. Everything comes from the campaign's folder."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..figures.oscillator_diagram import oscillator_diagram
from ..figures.oscillator_errors import oscillator_errors
from ..figures.oscillator_history import oscillator_history
from ..figures.oscillator_section import oscillator_section, oscillator_zooms
from ..parts.content import Bullets, Figure, Heading, Item, Notice, Report, Text
from ..parts.provenance import provenance_items
from ..parts.wording import count, decimals, number, percent
from .attractors import basin_items, grazing_items, orbit_items
from .folder import Study, read_study
from .tables import LAMBDA_1, equation_items, exponent_table, part_table


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
        part_table(study),
        *provenance_items(study),
    ]
    numbers = ", ".join(
        f"{name} = {number(study.oscillator[key])}"
        for name, key in (("F", "force"), ("B − W", "lift"), ("μ", "damping"), ("ω", "frequency"))
    )
    return Report("The snap oscillator, equation (33)", numbers, tuple(items))


def _question(study: Study) -> list[Item]:
    lines = []
    value, error = study.number("exponents", "lambda_1_nats_per_time"), study.number("exponents", "lambda_1_error")
    if math.isfinite(value):
        verdict = (
            "positive by more than two standard errors: nearby motions part exponentially, the motion is chaotic"
            if _chaotic(study)
            else "negative: the motion is regular"
            if value < -2 * error
            else "zero within two standard errors"
        )
        lines.append(
            f"The largest exponent is {LAMBDA_1} = {_with_error(value, error)} nats per unit of time, "
            f"{_with_error(study.number('exponents', 'lambda_1_bits_per_period'), _bits_error(study))} bits per "
            "forcing "
            f"period; it is {verdict}."
        )
        rest = abs(study.number("exponents", "sum_plus_damping"))
        lines.append(f"Both exponents and the damping add up to zero, as they must, within {rest:.0e}.")
        dimension = study.number("exponents", "section_dimension")
        if dimension > 0.0:
            within = _with_error(dimension, study.number("exponents", "section_dimension_error"))
            lines.append(
                f"The section has the Kaplan-Yorke dimension {within}: layers of layers, no curve and no area."
            )
    shares = study.arrays.get("basins", {}).get("shares")
    if shares is not None:
        settled = count(len(shares) - 1, "periodic attractor")
        lines.append(
            f"{settled} found: {percent(float(shares[:-1].sum()))} of the starts end there, "
            f"{percent(float(shares[-1]))} do not settle."
        )
    force = study.number("grazing", "grazing_force")
    if math.isfinite(force):
        lines.append(f"The taut motion first goes slack at F = {force:.14g}.")
    items: list[Item] = [
        Heading("Question"),
        Text(
            "To see the fractal structure of the strange attractor, the paper (Tjavaras, Zhu, Liu, Triantafyllou and "
            "Yue 1998, section 4.2) reduces the tethered buoy to its radial motion on a tether that pulls but does "
            "not "
            "push: equation (33), with its section in figure 19(b). Is that motion chaotic, by how much, with what "
            "certainty, and what else can the oscillator do?"
        ),
        Heading("Short answer"),
        Bullets(tuple(lines) or ("No part of this study gave a number; see the faults below.",)),
    ]
    if study.faults:
        missing = tuple(f"`{part}`: {reason}." for part, reason in study.faults.items())
        items.append(Notice("warning", "Parts without results", missing))
    return items


def _section(study: Study) -> list[Item]:
    items: list[Item] = [Heading("The section: figure 19(b)")]
    arrays = study.arrays.get("section")
    if arrays is None:
        return [*items, Text(f"There is no section: {study.faults['section']}.")]
    states, boxes = arrays["section"], arrays["boxes"]
    extent = _extent(states)
    caption = (
        f"Poincaré section at the forcing phase {number(study.oscillator['phase'])} rad, in the layout of the "
        "paper's "
        f"figure 19(b): {len(states)} points, one a forcing period, after {study.rows['section']['transient']} "
        "periods. "
        f"Seen: points within {extent}. From the part `section`."
    )
    orbit = study.arrays.get("basins", {}).get("orbit_1")
    alt = f"Scatter of {len(states)} strobed points of displacement and velocity, within {extent}."
    items.append(Figure(oscillator_section(states, boxes, orbit), caption, alt))
    zooms = [arrays[name] for name in ("zoom_1", "zoom_2") if name in arrays]
    if zooms and _chaotic(study):  # a zoom into a periodic orbit shows a point
        counts = " and ".join(str(len(zoom)) for zoom in zooms)
        seen = (
            f"Zooms by 10 and by 100 round the place visited most, {counts} points out of "
            f"{study.rows['section']['periods']} periods of the same orbit"
        )
        caption = (
            f"{seen}. What looks like a line resolves into several, and each of these again: the layers repeat at "
            "every scale, because each period stretches the attractor along its lines and folds it at the snap. "
            "Lines "
            "are smooth along themselves. From the part `section`."
        )
        items.append(
            Figure(oscillator_zooms(zooms, boxes), caption, f"{seen}, showing bundles of nearly parallel lines.")
        )
    motion = study.arrays.get("history")
    if motion is not None:
        share, switches = study.number("history", "slack_fraction"), len(motion.get("switches", ()))
        period = 2.0 * math.pi / study.oscillator["frequency"]
        seen = (
            f"{count(switches, 'switch', 'switches')} in {study.rows['history']['periods']} periods, "
            f"{percent(share)} of the time slack"
        )
        items.append(
            Figure(
                oscillator_history(motion["time"] / period, motion["displacement"], motion["velocity"]),
                f"The first periods from γ = 0.68 at rest; shaded: slack. Seen: {seen}. From the part `history`.",
                f"Histories of displacement and velocity: {seen}.",
            )
        )
    return items


def _exponents(study: Study) -> list[Item]:
    arrays = study.arrays.get("exponents")
    if arrays is None:
        return [Heading("Exponents"), Text(f"There are no exponents: {study.faults['exponents']}.")]
    row = study.rows["exponents"]
    of_start = arrays["of_start"][:, 0]
    error, block_error = study.number("exponents", "lambda_1_error"), float(arrays["block_error"][0])
    text = (
        "Both exponents come from the exact tangent map, re-orthonormalised every period. They are averages over "
        f"{row['starts']} "
        f"independent random starts of {row['periods']} periods each after {row['transient']}, and the error is "
        "the standard "
        f"deviation over the starts by the root of their number; {count(int(row['elsewhere']), 'further start')} "
        "settled on "
        f"a periodic attractor and {'is' if row['elsewhere'] == '1' else 'are'} not counted. The same error from "
        "blocks of "
        f"time alone is {block_error:.2g}, against {error:.2g}: the starts' averages scatter as independent ones do."
    )
    seen = f"the mean ends at {_with_error(study.number('exponents', 'lambda_1_nats_per_time'), error)}"
    caption = (
        f"Errors of the largest exponent. Left: {LAMBDA_1} as the averages grow longer; {seen}. Right: scatter of the "
        "mean of k starts against k (bars: two standard errors of the scatter); an honest error falls as the line "
        "does. From the part `exponents`."
    )
    figure = Figure(
        oscillator_errors(arrays["convergence"], of_start),
        caption,
        f"Convergence of the largest exponent with time, where {seen}, and fall of its scatter with the number of "
        "starts.",
    )
    return [Heading("Exponents and their errors"), Text(text), exponent_table(study), figure]


def _diagrams(study: Study) -> list[Item]:
    items: list[Item] = [Heading("Orbit diagrams")]
    for part, symbol, label, key in (
        ("diagram-force", "F", r"forcing $F$ (–)", "force"),
        ("diagram-frequency", "ω", r"forcing frequency $\omega$ (–)", "frequency"),
    ):
        arrays = study.arrays.get(part)
        if arrays is None or not np.isfinite(arrays["section"]).any():
            items.append(
                Text(f"There is no orbit diagram over {symbol}: {study.faults.get(part, 'no finite points')}.")
            )
            continue
        values, exponents, errors = arrays["values"], arrays["exponents"], arrays["errors"]
        chaotic = (exponents[..., 0] - 2 * errors > 0).any(axis=1)
        marks = [(study.oscillator[key], "as run")]
        if key == "force" and math.isfinite(study.number("grazing", "grazing_force")):
            marks.append((study.number("grazing", "grazing_force"), "grazing"))
        picture = oscillator_diagram(
            values, arrays["section"], exponents, errors, arrays["slack_fraction"], label, marks
        )
        seen = (
            f"{LAMBDA_1} is above zero by two errors, for one start at least, at {int(chaotic.sum())} of "
            f"{len(values)} "
            f"values; its largest value is {number(float(np.nanmax(exponents[..., 0])), 3)} at {symbol} = "
            f"{number(float(values[int(np.nanargmax(exponents[..., 0].max(axis=1)))]))}"
        )
        caption = (
            f"Strobed displacement over {symbol}, both exponents and the share of slack time, the same four random "
            "starts "
            f"at every value, {study.rows[part]['periods']} periods after {study.rows[part]['transient']}. Where "
            "the four "
            f"differ, attractors coexist or a transient is long. Seen: {seen}. From the part `{part}`."
        )
        items.append(Figure(picture, caption, f"Orbit diagram over {symbol} with exponents below: {seen}."))
    return items


def _chaotic(study: Study) -> bool:
    value, error = study.number("exponents", "lambda_1_nats_per_time"), study.number("exponents", "lambda_1_error")
    return value - 2 * error > 0.0


def _extent(states: np.ndarray) -> str:
    low, high = states.min(axis=0), states.max(axis=0)
    return (
        f"γ from {decimals(low[0], 2)} to {decimals(high[0], 2)} and velocity from {decimals(low[1], 2)} to "
        f"{decimals(high[1], 2)}"
    )


def _with_error(value: float, error: float) -> str:
    """The value with as many decimals as its error has to two digits."""
    if not math.isfinite(error) or error <= 0.0:
        return number(value, 6)
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{decimals(value, min(places, 15))} ± {decimals(error, min(places, 15))}"


def _bits_error(study: Study) -> float:
    return study.number("exponents", "lambda_1_bits_error")
