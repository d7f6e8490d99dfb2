"""The report on any column of a file: the verdict first, the curves behind it, every test. From the folder alone."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..figures.series_panels import SHOWN, growth_and_dimension, record_and_spectrum, return_map
from ..parts.content import Column, Figure, Heading, Item, Listing, Report, Table, Text
from ..parts.folder import FolderError, no_folder
from ..parts.wording import printed

if TYPE_CHECKING:
    import pandas

CURVES = ("series", "spectrum", "section", "divergence", "dimension")
SEEN = {
    "strobed": "once per forcing period, at four phases of it; drawn is the first",
    "samples": "sample by sample, as a map",
    "maxima": "at its successive maxima",
}
PASSED = {True: "yes", False: "no", None: "not asked"}


@dataclass(frozen=True, eq=False)
class Judged:
    """What the command left: `answer` and `provenance` as written, `page` its text, `curves` by file, NaN where a cell
    is empty."""

    answer: dict
    provenance: dict
    page: str
    curves: dict[str, pandas.DataFrame]


def read_judged(directory: str | Path) -> Judged:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    import pandas

    directory = Path(directory)
    if not directory.is_dir():
        raise FolderError(directory, [no_folder(directory)])
    found, faults = {}, []
    readers = dict.fromkeys(("answer.json", "provenance.json"), lambda path: json.loads(path.read_text("utf-8")))
    readers["answer.txt"] = lambda path: path.read_text("utf-8")
    readers |= {f"{name}.csv": lambda path: pandas.read_csv(path, dtype=float) for name in CURVES}
    for name, reader in readers.items():
        try:
            found[name] = reader(directory / name)
        except FileNotFoundError:
            faults.append(f"{name} is missing (python -m analysis writes it)")
        except (OSError, ValueError) as error:
            faults.append(f"{name} cannot be read: {error}")
    if faults:
        raise FolderError(directory, faults)
    curves = {name: found[f"{name}.csv"] for name in CURVES}
    return Judged(found["answer.json"], found["provenance.json"], found["answer.txt"], curves)


def report(directory: str | Path) -> Report:
    """The content of the report on a folder of `python -m analysis`. Raises FolderError for any other."""
    judged = read_judged(directory)
    source = judged.provenance
    items = [*_verdict(judged.answer), *_figures(judged), *_evidence(judged.answer), *_origin(judged)]
    title, under = f"Regular or chaotic: {source['column']}", f"column {source['column']} of {source['file']}"
    return Report(title, under, tuple(items))


def _verdict(answer: dict) -> list[Item]:
    unit, section, delays = answer["unit_of_time"], answer["section"], answer["embedding"]
    rows = []
    for name, one in answer["exponents"].items():
        value = _digits(one["nats_per_time"], one["error"])
        rows.append((f"exponent, {name.capitalize()}", value, f"nats/{unit}", one["reason"]))
    # A record that is too short for delays is too short for neighbours.
    short = answer["exponents"]["wolf"]["reason"]
    how = short if delays is None else f"a delay of {delays['delay_samples']} samples"
    rows += [
        ("K of the 0-1 test", _digits(answer["zero_one"]["K"]), "1", answer["zero_one"]["reason"]),
        ("correlation dimension", _digits(**answer["dimension"]), "1", how),
        ("white noise, at most", _digits(answer["noise"]), "as the column", "`analysis/embedding.py`"),
    ]
    step = f"{answer['samples']} samples, one every {answer['step']:.6g} {unit}"
    return [
        Heading("Answer"),
        Text(f"The motion is {answer['regime']}: {answer['reason']}."),
        Text(f"{step}, seen {SEEN[section['kind']]}: {section['points']} points."),
        Table(
            _heads("measure", "value", "unit", "from"),
            tuple(rows),
            "Measures with one standard error; none: no value, for the reason beside it.",
        ),
    ]


def _figures(judged: Judged) -> list[Item]:
    unit = judged.answer["unit_of_time"]
    curves = {name: table.to_numpy().T for name, table in judged.curves.items()}
    time, values = curves["series"]
    steps, rosenstein, kantz = curves["divergence"]
    table = judged.curves["dimension"]
    slopes = [(int(m), own["radius"].to_numpy(), own["slope"].to_numpy()) for m, own in table.groupby("delays")]
    return [
        Heading("What was seen"),
        Figure(
            record_and_spectrum(time, values, *curves["spectrum"], (unit, judged.provenance["column"])),
            f"The record and its amplitude spectrum. Above: the last {min(SHOWN, len(time))} samples (`series.csv`). "
            "Below: amplitude of eq. (31) over the later half (`spectrum.csv`): lines alone for a regular motion, a "
            "continuous floor for chaos and for noise.",
            "Two panels: the record over time, and its amplitude spectrum on a logarithmic scale.",
        ),
        Figure(
            return_map(curves["section"][1]),
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


def _evidence(answer: dict) -> list[Item]:
    rows = []
    for one in answer["evidence"]:
        numbers = _digits(one["value"]), _digits(one["threshold"])
        rows.append((one["name"], PASSED[one["passed"]], *numbers, printed(one["sentence"])))
    heads = _heads("test", "passed", "value", "compared with", "meaning")
    caption = "Every test behind the word, in the order in which it was made (`analysis/verdicts.py`)."
    return [Heading("Evidence"), Table(heads, tuple(rows), caption, small=True)]


def _origin(judged: Judged) -> list[Item]:
    source = judged.provenance
    lines = [f"{key}: {value}" for key, value in source.items() if key not in ("campaign", "versions")]
    lines += [f"{name} {version}" for name, version in source["versions"].items()]
    said = [Heading("The answer as printed"), Listing(judged.page)]
    return [Heading("Where it comes from"), Listing("\n".join(lines)), *said]


def _heads(*titles: str) -> tuple[Column, ...]:
    numbers = ("value", "compared with")
    return tuple(Column(title, align="right" if title in numbers else "left") for title in titles)


def _digits(value: float | None, error: float | None = None) -> str:
    """A value with the digits that its error leaves, or four; "none" where there is no value."""
    if value is None:
        return "none"
    if not error:
        return f"{value:.4g}"
    places = min(max(1 - math.floor(math.log10(error)), 0), 12)
    return f"{value:.{places}f} ± {error:.{places}f}"
