"""The report on any column of a file: the verdict first, the curves behind it, every test. From the folder alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from analysis.any_series.words import number as with_digits

from ..figures.series_panels import SHOWN, growth_and_dimension, record_and_spectrum, return_map
from ..parts.content import Column, Figure, Heading, Item, Listing, Report, Table, Text
from ..parts.wording import printed
from .folder import Judged, read_judged

SEEN = {
    "strobed": "once per forcing period, at four phases of it; drawn is the first",
    "samples": "sample by sample, as a map",
    "maxima": "at its successive maxima",
}
PASSED = {True: "yes", False: "no", None: "not asked"}


def report(directory: str | Path) -> Report:
    """The content of the report on a folder of `python -m analysis`. Raises FolderError for any other."""
    judged = read_judged(directory)
    source = judged.provenance
    items = [*_verdict(judged), *_figures(judged), *_evidence(judged), *_origin(judged)]
    title, under = f"Regular or chaotic: {source['column']}", f"column {source['column']} of {source['file']}"
    return Report(title, under, tuple(items))


def _verdict(judged: Judged) -> list[Item]:
    answer = judged.answer
    section, unit = answer["section"], answer["unit_of_time"]
    rows = []
    for name, one in answer["exponents"].items():
        value = _with_error(one["nats_per_time"], one["error"])
        rows.append((f"exponent, {name.capitalize()}", value, f"nats/{unit}", one["reason"]))
    rows.append(("K of the 0-1 test", with_digits(answer["zero_one"]["K"]), "1", answer["zero_one"]["reason"]))
    dimension = answer["dimension"]
    delays = answer["embedding"]
    short = answer["exponents"]["wolf"]["reason"]  # what is too short for delays is so for neighbours
    how = short if delays is None else f"a delay of {delays['delay_samples']} samples"
    rows.append(("correlation dimension", _with_error(dimension["value"], dimension["error"]), "1", how))
    rows.append(("white noise, at most", with_digits(answer["noise"]), "as the column", "`analysis/neighbours.py`"))
    columns = (
        Column("measure", align="left"), Column("value"), Column("unit", align="left"), Column("from", align="left"),
    )  # fmt: skip
    return [
        Heading("Answer"),
        Text(f"The motion is {answer['regime']}: {answer['reason']}."),
        Text(
            f"{answer['samples']} samples, one every {answer['step']:.6g} {unit}, seen {SEEN[section['kind']]}: "
            f"{section['points']} points."
        ),
        Table(columns, tuple(rows), "Measures with one standard error; none: no value, for the reason beside it."),
    ]


def _figures(judged: Judged) -> list[Item]:
    answer, curves = judged.answer, judged.curves
    unit = "s" if answer["unit_of_time"] == "s" else "samples"
    time, values = curves["series"].values()
    frequency, amplitude = curves["spectrum"].values()
    _, first, *_ = curves["section"].values()
    steps, rosenstein, kantz = curves["divergence"].values()
    table = curves["dimension"]
    slopes = []
    for delays in np.unique(table["delays"]):
        own = table["delays"] == delays
        slopes.append((int(delays), table["radius"][own], table["slope"][own]))
    return [
        Heading("What was seen"),
        Figure(
            record_and_spectrum(time, values, frequency, amplitude, (unit, judged.provenance["column"])),
            f"The record and its amplitude spectrum. Above: the last {min(SHOWN, len(time))} samples (`series.csv`). "
            "Below: amplitude of eq. (31) over the later half (`spectrum.csv`): lines alone for a regular motion, a "
            "continuous floor for chaos and for noise.",
            "Two panels: the record over time, and its amplitude spectrum on a logarithmic scale.",
        ),
        Figure(
            return_map(first),
            "The section (`section.csv`). Left: each point against the one before it; N spots for period N, a closed "
            "curve for a torus, a folded curve for chaos, a cloud for noise. Right: in the order of time.",
            "Two panels: the return map of the section, and its points in order.",
        ),
        Figure(
            growth_and_dimension([("Rosenstein", steps, rosenstein), ("Kantz", steps, kantz)], slopes, unit),
            "Growth of small distances, and the dimension. Left: mean logarithm of the distance of neighbours "
            "(`divergence.csv`); its straight part is the exponent. Right: slope of the correlation sum "
            "(`dimension.csv`); where the curves run level together, it is the dimension.",
            "Two panels: growth of the distance between neighbours, and local slopes of the correlation sum.",
        ),
    ]


def _evidence(judged: Judged) -> list[Item]:
    columns = (
        Column("test", align="left"), Column("passed", align="left"), Column("value"), Column("compared with"),
        Column("what it says", align="left"),
    )  # fmt: skip
    rows = tuple(
        (
            one["name"],
            PASSED[one["passed"]],
            with_digits(one["value"]),
            with_digits(one["threshold"]),
            printed(one["sentence"]),
        )
        for one in judged.answer["evidence"]
    )
    caption = "Every test behind the word, in the order in which it was made (`analysis/verdicts.py`)."
    return [Heading("Evidence"), Table(columns, rows, caption, small=True)]


def _origin(judged: Judged) -> list[Item]:
    source = judged.provenance
    lines = [f"{key}: {value}" for key, value in source.items() if key not in ("campaign", "versions")]
    lines += [f"{name} {version}" for name, version in source["versions"].items()]
    said = [Heading("The answer as printed"), Listing(judged.page)]
    return [Heading("Where it comes from"), Listing("\n".join(lines)), *said]


def _with_error(value: float | None, error: float | None) -> str:
    return with_digits(value, error).replace("+-", "±")
