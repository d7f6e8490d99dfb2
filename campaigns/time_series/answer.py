"""The answer about a column: as a page of plain text, and as the folder of `--out`.

answer.txt, answer.json    the page; every number of it with its error, the evidence, and how it was asked
series.csv                 time, value: the record as read
spectrum.csv               angular frequency, amplitude of eq. (31)
section.csv                time and the coordinates of every point of the section
divergence.csv             k step, and the mean logarithm of the distance of nearest neighbours (Rosenstein)
dimension.csv              number of delays, radius, share of pairs, local slope
columns.csv                what the columns of these files are
provenance.json            the name under which `python -m reports` knows this folder, file, hash, settings, versions
"""

import hashlib
import json
import platform
import textwrap
from collections.abc import Iterator
from dataclasses import asdict, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pandas

from analysis.poincare import PHASES
from campaigns.time_series.study import (
    MAXIMA,
    MOST_TOLERANCE,
    OF_NOISE,
    SAMPLES,
    STROBED,
    Study,
    motion_range,
    noise_tolerance,
)
from engine.atomic import write_atomic
from tables import Column, dictionary, names

WIDTH, NAMES = 100, 24
MARK = {True: "met", False: "not met", None: "--"}
SEEN = {
    STROBED: "once per forcing period, at four phases of it",
    SAMPLES: "sample by sample, as a map; a sample is what is called a period below",
    MAXIMA: "at its maxima, each with the minimum before it, as no --period was given; from one to the next is what is "
    "called a period below",
}
MEANING = {
    "quasi-periodic": "two or more rhythms that never meet; no sensitivity to the start",
    "chaotic": "deterministic, and neighbouring states part exponentially",
    "transient": "the motion has not settled: cut its beginning, or record longer",
    "undecided": "neither regular nor shown to be chaotic: noise, too short a record, or both at once",
}


# UNIT: that of the record's time, "s" or "samples".
COLUMNS = (
    Column("time_UNIT", "UNIT", "t", "time from the first sample", 3),
    Column("value", "", "x", "the column as read", 6),
    Column("angular_frequency_rad_per_UNIT", "rad/UNIT", "ω", "angular frequency of the bin", 4),
    Column("amplitude", "", "|X|", "amplitude of eq. (31)", 6),
    *(Column(f"value_{j}", "", f"x_{j}", f"coordinate {j} of a point of the section", 6) for j in range(PHASES)),
    Column("rosenstein_nats", "nats", "", "mean ln of the distance of nearest neighbours", 3),
    Column("delays", "", "m", "embedding dimension", 0),
    Column("radius", "", "r", "radius in standard deviations of the coordinates", 4),
    Column("share_of_pairs", "", "C", "share of the pairs of points that are nearer", 6),
    Column("slope", "", "", "local slope d ln C/d ln r", 3),
)
DIMENSION = names(COLUMNS)[-4:]


def page(study: Study) -> str:
    """The text, without a last newline."""
    answers = answer(study)
    head = _rows([("record", answers["record"]), ("seen", answers["section"]["how"])])
    measures = [(name, f"{value} {unit}".strip() + f"; {origin}") for name, value, unit, origin in answers["measures"]]
    verdict = [("VERDICT", f"{answers['regime']}: {answers['meaning']}"), ("because", answers["reason"])]
    evidence = ["tests (met or not, what was found, the value and what it was compared with)"]
    for item in study.verdict.evidence:
        test = f"  {MARK[item.passed]:<9}{item.name}: {item.sentence}"
        if np.isfinite(item.threshold):
            test += f" [{number(item.value)} against {number(item.threshold)}]"
        evidence += _wrapped(test, 11)
    notes = []
    for note in answers["notes"]:
        notes += _wrapped(f"note: {note}", 6)
    title = f"{study.record.path}, column {study.record.column}"
    parts = [[title, *head], _rows(measures), _rows(verdict), evidence, notes]
    return "\n\n".join("\n".join(part) for part in parts if part)


def number(value: float | None, error: float | None = None) -> str:
    """A value with the digits that its error leaves, or four; "none" where there is no value."""
    if value is None or not np.isfinite(value):
        return "none"
    if error is None or not np.isfinite(error) or error <= 0.0:
        return f"{value:.4g}"
    digits = int(np.clip(1 - np.floor(np.log10(error)), 0, 12))
    return f"{value:.{digits}f} +- {error:.{digits}f}"


def _wrapped(text: str, indent: int) -> list[str]:
    return textwrap.wrap(text, WIDTH, subsequent_indent=" " * indent, break_long_words=False)


def _rows(pairs: list[tuple]) -> list[str]:
    """Lines of names in front and texts beside them."""
    lines = []
    for name, text in pairs:
        lines += _wrapped(f"{name:<{NAMES}}{text}", NAMES)
    return lines


def _measures(study: Study) -> list[tuple]:
    """(measure, value with its standard error, unit, where it comes from or why there is none) of each."""
    unit, short = study.record.unit, study.exponents["wolf"].reason
    # nats a second, but nats a sample
    per, period = unit.removesuffix("s") or unit, f"a period is {study.seen.period:.6g} {unit}"
    rows = []
    for peak in study.lines[:3]:
        origin = f"eq. (31) over the later half, amplitude {number(peak.amplitude)}"
        rows.append(("line of the spectrum", number(peak.angular_frequency_radps), f"rad/{per}", origin))
    for name, estimate in study.exponents.items():
        bits = estimate.in_bits_per_period(study.seen.period)
        rows.append(
            (f"exponent, {name.capitalize()}", number(estimate.value, estimate.error), f"nats/{per}", estimate.reason)
        )
        rows.append(("the same", number(bits.value, bits.error), "bits/period", period))
    rows.append(("K of the 0-1 test", number(study.zero_one.value), "", study.zero_one.reason))
    value, error, origin = None, None, short
    if study.dimension is not None:
        value, error, delays = study.dimension.value, study.dimension.error, study.embedding.dimension
        origin = f"in {delays} delays, which white noise fills to {delays}: {study.dimension.reason}"
    rows.append(("correlation dimension", number(value, error), "", origin))
    rows.append(("white noise, at most", number(study.seen.noise), "as the column", "`analysis/embedding.py`"))
    return rows


def _notes(study: Study) -> list[str]:
    """What the reader could do for a better answer."""
    notes, view, record = [], study.seen, study.record
    undecided = study.verdict.regime == "undecided"
    if record.unit != "s":
        notes.append("time is counted in samples: --time COLUMN or --step SECONDS puts it in seconds")
    if undecided and len(view.points) < 200:
        needed = "chaos can be shown with 200 points or more on the section, any regime with 40"
        notes.append(f"{needed}; here are {len(view.points)}")
    if study.line_period is not None and study.verdict.period is None:
        line = f"the record has a line of the period {study.line_period:.8g} {record.unit}, from which --period parts"
        notes.append(f"{line} steadily: if the line is that of the forcing, give its period")
    notes.extend(_notes_on_noise(study))
    if view.kind == MAXIMA:
        notes.append("of a motion that is forced with a known period, --period sees more: the section once per period")
    if study.used < len(record.values):
        notes.append(f"exponents and dimension are those of the last {study.used} samples")
    return notes


def _notes_on_noise(study: Study) -> Iterator[str]:
    """What the noise of a record may hide, and the option that shows more."""
    share = study.seen.noise / motion_range(study.record.values)
    noise, tolerance = f"the noise is {share:.1g} of the range", OF_NOISE * share
    if study.tolerance == noise_tolerance(study.record.values, study.seen):
        yield f"{noise}: a torus thinner than {tolerance:.1g} of the range looks like a period"
    elif study.verdict.regime == "undecided" and study.seen.kind != SAMPLES and MOST_TOLERANCE < tolerance < 0.4:
        yield f"{noise}: --tolerance {tolerance:.1g} asks whether the motion repeats, but a torus as thin looks so too"


def write_files(study: Study, directory: Path, settings: dict[str, object]) -> None:
    """Write the folder; settings: the campaign and the settings of the command, for provenance.json. Raises OSError.

    provenance.json is written last: a folder with it is whole.
    """
    directory.mkdir(parents=True, exist_ok=True)
    record, source = study.record, study.record.path
    files = {"answer.txt": page(study) + "\n", "answer.json": _json(answer(study))}
    files |= {f"{name}.csv": curve.to_csv(index=False) for name, curve in curves(study).items()}
    for name, text in files.items():
        write_atomic(directory / name, text.encode())
    unit = record.unit
    columns = []
    for column in COLUMNS:
        name_with_unit, own_unit = column.name.replace("UNIT", unit), column.unit.replace("UNIT", unit)
        columns.append(replace(column, name=name_with_unit, unit=own_unit))
    write_atomic(directory / "columns.csv", dictionary(columns))
    provenance = {**settings, "file": source.name, "sha256": hashlib.sha256(source.read_bytes()).hexdigest()}
    provenance |= {"column": record.column, "python": platform.python_version()}
    provenance["versions"] = {name: version(name) for name in ("numpy", "scipy", "numba")}
    write_atomic(directory / "provenance.json", _json(provenance).encode())


def answer(study: Study) -> dict[str, object]:
    """What is said of a record as plain data, in numbers and in words; a number that was not found is NaN."""
    record, view, verdict, chosen = study.record, study.seen, study.verdict, study.embedding
    x, unit, count = record.values, record.unit, verdict.period
    dimension = {"value": np.nan, "error": np.nan}
    if study.dimension is not None:
        dimension = {"value": study.dimension.value, "error": study.dimension.error}
    exponents = {}
    for name, estimate in study.exponents.items():
        bits = estimate.in_bits_per_period(view.period)
        numbers = {"nats_per_time": estimate.value, "error": estimate.error}
        numbers |= {"bits_per_cycle": bits.value, "bits_per_cycle_error": bits.error, "reason": estimate.reason}
        exponents[name] = numbers
    section_text = f"{len(view.points)} points, one every {view.period:.6g} {unit}, {SEEN[view.kind]}"
    return {
        "record": f"{len(x)} samples, one every {record.step:.6g} {unit}, from {x.min():.6g} to {x.max():.6g}",
        "unit_of_time": unit,
        "samples": len(x),
        "step": record.step,
        "section": {"kind": view.kind, "points": len(view.points), "cycle": view.period, "how": section_text},
        "noise": view.noise,
        "tolerance": study.tolerance,
        "lines": [{"angular_frequency": p.angular_frequency_radps, "amplitude": p.amplitude} for p in study.lines],
        "exponents": exponents,
        "zero_one": {"K": study.zero_one.value, "reason": study.zero_one.reason},
        "dimension": dimension,
        "embedding": chosen and {"delay_samples": chosen.lag, "dimension": chosen.dimension},
        "measures": _measures(study),
        "regime": verdict.regime,
        "meaning": MEANING.get(verdict.regime, f"the motion repeats itself after this many periods: {count}"),
        "period": count,
        "reason": verdict.reason,
        "evidence": [asdict(item) for item in verdict.evidence],
        "notes": _notes(study),
    }


def _json(data: object) -> str:
    """Data as JSON: null in place of what is not finite."""
    plain = json.loads(json.dumps(data), parse_constant=lambda _: None)
    return json.dumps(plain, indent=2) + "\n"


def curves(study: Study) -> dict[str, pandas.DataFrame]:
    """The curves behind an answer, by the name of their file."""
    record, view, spectrum = study.record, study.seen, study.spectrum
    time, frequency = f"time_{record.unit}", f"angular_frequency_rad_per_{record.unit}"
    section = {f"value_{j}": values for j, values in enumerate(view.points.T)}
    grown = study.exponents["rosenstein"].details.get("curve", np.zeros(0))
    divergence = pandas.DataFrame({time: record.step * np.arange(len(grown)), "rosenstein_nats": grown})
    dimension = pandas.DataFrame(columns=DIMENSION)
    if study.dimension is not None:
        pairs = study.dimension.correlation_sum
        values = (float(study.embedding.dimension), study.dimension.radius, pairs, study.dimension.slope)
        dimension = pandas.DataFrame(dict(zip(DIMENSION, values, strict=True)))[pairs > 0.0]
    return {
        "series": pandas.DataFrame({time: record.step * np.arange(len(record.values)), "value": record.values}),
        "spectrum": pandas.DataFrame({frequency: spectrum.angular_frequency_radps, "amplitude": spectrum.amplitude}),
        "section": pandas.DataFrame({time: view.time, **section}),
        "divergence": divergence,
        "dimension": dimension,
    }
