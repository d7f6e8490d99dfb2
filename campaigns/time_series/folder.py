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

import csv
import hashlib
import io
import json
import platform
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path

import numpy as np

from campaigns.columns import Column, dictionary
from campaigns.time_series.page import page
from campaigns.time_series.record import Record
from campaigns.time_series.study import Study
from engine.atomic import write_atomic

Curve = list[tuple[Column, np.ndarray]]


def write_files(study: Study, directory: Path, asked: dict[str, object]) -> None:
    """Write the folder; asked: the campaign and the settings of the command, for provenance.json. Raises OSError.

    provenance.json is written last: a folder with it is whole.
    """
    directory.mkdir(parents=True, exist_ok=True)
    tables = curves(study)
    columns = {column.name: column for curve in tables.values() for column, _ in curve}
    files = {"answer.txt": page(study) + "\n", "answer.json": _json(answer(study))}
    files |= {f"{name}.csv": _table(curve) for name, curve in tables.items()}
    for name, text in files.items():
        write_atomic(directory / name, text.encode())
    write_atomic(directory / "columns.csv", dictionary(columns.values()))
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


def curves(study: Study) -> dict[str, Curve]:
    """The curves behind an answer, by the name of their file: each column with what it is, and its values (n,)."""
    record, view, spectrum = study.record, study.seen, study.spectrum
    unit = record.unit
    time = Column(f"time_{unit}", unit, "t", "time from the first sample", 3)
    frequency = Column(f"angular_frequency_rad_per_{unit}", f"rad/{unit}", "ω", "angular frequency of the bin", 4)
    grown = [one.details.get("curve", np.zeros(0)) for one in (study.rosenstein, study.kantz)]
    longest = max(len(curve) for curve in grown)
    padded = [np.append(curve, np.full(longest - len(curve), np.nan)) for curve in grown]
    return {
        "series": [
            (time, record.step * np.arange(len(record.values))),
            (Column("value", "", "x", "as read", 6), record.values),
        ],
        "spectrum": [
            (frequency, spectrum.angular_frequency_radps),
            (Column("amplitude", "", "|X|", "amplitude of eq. (31)", 6), spectrum.amplitude),
        ],
        "section": [
            (time, view.time),
            *(
                (Column(f"value_{j}", "", f"x_{j}", f"coordinate {j} of a point of the section", 6), values)
                for j, values in enumerate(view.points.T)
            ),
        ],
        "divergence": [
            (time, record.step * np.arange(longest)),
            (Column("rosenstein_nats", "nats", "", "mean ln of the distance of nearest neighbours", 3), padded[0]),
            (Column("kantz_nats", "nats", "", "mean ln of the mean distance within neighbourhoods", 3), padded[1]),
        ],
        "dimension": _dimension(study),
    }


def _dimension(study: Study) -> Curve:
    columns = (
        Column("delays", "", "m", "embedding dimension", 0),
        Column("radius", "", "r", "radius in standard deviations", 4),
        Column("share_of_pairs", "", "C", "share of the pairs of points that are nearer", 6),
        Column("slope", "", "", "local slope d ln C/d ln r", 3),
    )
    parts = [np.zeros((4, 0))]
    for j, one in enumerate(study.dimensions):
        kept = one.correlation_sum > 0.0
        delays = np.full(int(kept.sum()), study.embedding.dimension + j, dtype=float)
        parts.append(np.array([delays, one.radius[kept], one.correlation_sum[kept], one.slope[kept]]))
    return list(zip(columns, np.hstack(parts), strict=True))


def _table(curve: Curve) -> str:
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(column.name for column, _ in curve)
    cells = zip(*(values for _, values in curve), strict=True)
    rows.writerows(["" if np.isnan(cell) else repr(float(cell)) for cell in row] for row in cells)
    return text.getvalue()


def _provenance(record: Record, asked: dict[str, object]) -> dict[str, object]:
    return {
        **asked,
        "file": record.path.name,
        "sha256": hashlib.sha256(record.path.read_bytes()).hexdigest(),
        "column": record.column,
        "python": platform.python_version(),
        "versions": {name: version(name) for name in ("numpy", "scipy", "numba")},
    }
