"""What `--out` holds: the answer as text and as JSON, and the curves behind it as CSV.

answer.txt, answer.json    the page; every number of it with its error, the evidence, and how it was asked
series.csv                 time, value: the record as read
spectrum.csv               angular frequency, amplitude of eq. (31)
section.csv                time and the coordinates of every point of the section
divergence.csv             k step, and the mean logarithm of the distance of neighbours by Rosenstein and by Kantz
dimension.csv              radius, share of pairs, local slope, for each number of delays
columns.csv                what the columns of these files are
provenance.json            the name under which `python -m reports` knows this folder, file, hash, settings, versions
"""

import hashlib
import json
import platform
from dataclasses import asdict, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pandas

from analysis.poincare import PHASES
from campaigns.columns import Column, dictionary, names
from campaigns.time_series.page import page
from campaigns.time_series.record import Record
from campaigns.time_series.study import Study
from engine.atomic import write_atomic

# UNIT: that of the record's time, "s" or "samples".
COLUMNS = (
    Column("time_UNIT", "UNIT", "t", "time from the first sample", 3),
    Column("value", "", "x", "the column as read", 6),
    Column("angular_frequency_rad_per_UNIT", "rad/UNIT", "ω", "angular frequency of the bin", 4),
    Column("amplitude", "", "|X|", "amplitude of eq. (31)", 6),
    *(Column(f"value_{j}", "", f"x_{j}", f"coordinate {j} of a point of the section", 6) for j in range(PHASES)),
    Column("rosenstein_nats", "nats", "", "mean ln of the distance of nearest neighbours", 3),
    Column("kantz_nats", "nats", "", "mean ln of the mean distance within neighbourhoods", 3),
    Column("delays", "", "m", "embedding dimension", 0),
    Column("radius", "", "r", "radius in standard deviations of the coordinates", 4),
    Column("share_of_pairs", "", "C", "share of the pairs of points that are nearer", 6),
    Column("slope", "", "", "local slope d ln C/d ln r", 3),
)
DIMENSION = names(COLUMNS)[-4:]


def write_files(study: Study, directory: Path, asked: dict[str, object]) -> None:
    """Write the folder; asked: the campaign and the settings of the command, for provenance.json. Raises OSError.

    provenance.json is written last: a folder with it is whole.
    """
    directory.mkdir(parents=True, exist_ok=True)
    files = {"answer.txt": page(study) + "\n", "answer.json": _json(answer(study))}
    files |= {f"{name}.csv": curve.to_csv(index=False) for name, curve in curves(study).items()}
    for name, text in files.items():
        write_atomic(directory / name, text.encode())
    unit = study.record.unit
    told = [replace(one, name=one.name.replace("UNIT", unit), unit=one.unit.replace("UNIT", unit)) for one in COLUMNS]
    write_atomic(directory / "columns.csv", dictionary(told))
    write_atomic(directory / "provenance.json", _json(_provenance(study.record, asked)).encode())


def answer(study: Study) -> dict[str, object]:
    """The numbers of the page as plain data; what was not found is None."""
    record, view, verdict, chosen = study.record, study.seen, study.verdict, study.embedding
    exponents = {}
    for name in ("wolf", "rosenstein", "kantz"):
        one = getattr(study, name)
        bits = one.in_bits_per_period(view.period)
        found = {"nats_per_time": one.value, "error": one.error}
        found |= {"bits_per_cycle": bits.value, "bits_per_cycle_error": bits.error, "reason": one.reason}
        exponents[name] = found
    return _plain(
        {
            "unit_of_time": record.unit,
            "samples": len(record.values),
            "step": record.step,
            "section": {"kind": view.kind, "points": len(view.points), "cycle": view.period},
            "noise": view.noise,
            "tolerance": study.tolerance,
            "lines": [{"angular_frequency": p.angular_frequency_radps, "amplitude": p.amplitude} for p in study.lines],
            "exponents": exponents,
            "zero_one": {"K": study.zero_one.value, "reason": study.zero_one.reason},
            "dimension": {"value": study.dimension[0], "error": study.dimension[1]},
            "embedding": chosen and {"delay_samples": chosen.lag, "dimension": chosen.dimension},
            "regime": verdict.regime,
            "period": verdict.period,
            "reason": verdict.reason,
            "evidence": [asdict(item) for item in verdict.evidence],
        }
    )


def _plain(data: object) -> object:
    """Data for JSON: numbers of its own, None in place of what is not finite."""
    if isinstance(data, dict):
        return {key: _plain(entry) for key, entry in data.items()}
    if isinstance(data, list):
        return [_plain(entry) for entry in data]
    if isinstance(data, float):
        return float(data) if np.isfinite(data) else None
    return data


def _json(data: object) -> str:
    return json.dumps(data, indent=2, allow_nan=False) + "\n"


def curves(study: Study) -> dict[str, pandas.DataFrame]:
    """The curves behind an answer, by the name of their file."""
    record, view, spectrum = study.record, study.seen, study.spectrum
    time, frequency = f"time_{record.unit}", f"angular_frequency_rad_per_{record.unit}"
    section = {f"value_{j}": values for j, values in enumerate(view.points.T)}
    grown = {"rosenstein_nats": study.rosenstein, "kantz_nats": study.kantz}
    divergence = pandas.DataFrame({name: pandas.Series(one.details.get("curve", [])) for name, one in grown.items()})
    divergence.insert(0, time, record.step * np.arange(len(divergence)))
    dimension = [pandas.DataFrame(columns=DIMENSION)]
    for j, one in enumerate(study.dimensions):
        values = (float(study.embedding.dimension + j), one.radius, one.correlation_sum, one.slope)
        dimension.append(pandas.DataFrame(dict(zip(DIMENSION, values, strict=True)))[one.correlation_sum > 0.0])
    return {
        "series": pandas.DataFrame({time: record.step * np.arange(len(record.values)), "value": record.values}),
        "spectrum": pandas.DataFrame({frequency: spectrum.angular_frequency_radps, "amplitude": spectrum.amplitude}),
        "section": pandas.DataFrame({time: view.time, **section}),
        "divergence": divergence,
        "dimension": pandas.concat(dimension[1:] or dimension),
    }


def _provenance(record: Record, asked: dict[str, object]) -> dict[str, object]:
    return {
        **asked,
        "file": record.path.name,
        "sha256": hashlib.sha256(record.path.read_bytes()).hexdigest(),
        "column": record.column,
        "python": platform.python_version(),
        "versions": {name: version(name) for name in ("numpy", "scipy", "numba")},
    }
