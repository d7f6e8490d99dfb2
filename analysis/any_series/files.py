"""What `--out` holds: the answer as text and as JSON, and the curves behind it as CSV.

answer.txt, answer.json    the page; every number of it with its error, the evidence, and how it was asked
series.csv                 time, value: the record as read
spectrum.csv               angular frequency, amplitude of eq. (31)
section.csv                time and the coordinates of every point of the section
divergence.csv             k step, and the mean logarithm of the distance of neighbours by Rosenstein and by Kantz
dimension.csv              radius, share of pairs, local slope, for each number of delays
provenance.json            the name under which `python -m reports` knows this folder, file, hash, settings, versions
"""

import csv
import hashlib
import io
import json
import os
import platform
from importlib.metadata import version

import numpy as np

from analysis.any_series.words import page

NAME = "time_series"


def write_files(study, directory, asked):
    """Write the folder; asked: the settings of the command, for provenance.json. Raises OSError.

    provenance.json is written last: a folder with it is whole.
    """
    directory.mkdir(parents=True, exist_ok=True)
    record, view = study.record, study.seen
    time = record.step * np.arange(len(record.values))
    unit = "s" if record.unit == "s" else "samples"
    files = {
        "answer.txt": page(study) + "\n",
        "answer.json": json.dumps(answer(study), indent=2, allow_nan=False) + "\n",
        "series.csv": _table([f"time_{unit}", "value"], time, record.values),
        "spectrum.csv": _table(
            [f"angular_frequency_rad_per_{unit}", "amplitude"],
            study.spectrum.angular_frequency_radps,
            study.spectrum.amplitude,
        ),
        "section.csv": _table(
            [f"time_{unit}", *(f"value_{j}" for j in range(view.points.shape[1]))], view.time, *view.points.T
        ),
        "divergence.csv": _divergence(study, unit),
        "dimension.csv": _dimension(study),
        "provenance.json": json.dumps(_provenance(record, asked), indent=2, allow_nan=False) + "\n",
    }
    for name, text in files.items():
        _write(directory / name, text)


def answer(study):
    """The numbers of the page as plain data; what was not found is None."""
    record, view, verdict = study.record, study.seen, study.verdict
    exponents = {}
    for name in ("wolf", "rosenstein", "kantz"):
        one = getattr(study, name)
        bits = one.in_bits_per_period(view.period)
        exponents[name] = {
            "nats_per_time": _plain(one.value),
            "error": _plain(one.error),
            "bits_per_cycle": _plain(bits.value),
            "bits_per_cycle_error": _plain(bits.error),
            "reason": one.reason,
        }
    return {
        "unit_of_time": record.unit,
        "samples": len(record.values),
        "step": record.step,
        "section": {"kind": view.kind, "points": len(view.points), "cycle": _plain(view.period)},
        "noise": _plain(view.noise),
        "tolerance": study.tolerance,
        "lines": [{"angular_frequency": p.angular_frequency_radps, "amplitude": p.amplitude} for p in study.lines],
        "exponents": exponents,
        "zero_one": {"K": _plain(study.zero_one.value), "reason": study.zero_one.reason},
        "dimension": {"value": _plain(study.dimension[0]), "error": _plain(study.dimension[1])},
        "embedding": _embedding(study.embedding),
        "regime": verdict.regime,
        "period": verdict.period,
        "reason": verdict.reason,
        "evidence": [
            {
                "name": item.name,
                "value": _plain(item.value),
                "error": _plain(item.error),
                "threshold": _plain(item.threshold),
                "passed": item.passed,
                "sentence": item.sentence,
            }
            for item in verdict.evidence
        ],
    }


def _embedding(chosen):
    return None if chosen is None else {"delay_samples": chosen.lag, "dimension": chosen.dimension}


def _plain(value):
    return float(value) if np.isfinite(value) else None


def _table(names, *columns):
    text = io.StringIO()
    rows = csv.writer(text, lineterminator="\n")
    rows.writerow(names)
    rows.writerows(["" if np.isnan(cell) else repr(float(cell)) for cell in row] for row in zip(*columns, strict=True))
    return text.getvalue()


def _divergence(study, unit):
    curves = [one.details.get("curve", np.zeros(0)) for one in (study.rosenstein, study.kantz)]
    length = max(len(curve) for curve in curves)
    padded = [np.append(curve, np.full(length - len(curve), np.nan)) for curve in curves]
    return _table([f"time_{unit}", "rosenstein_nats", "kantz_nats"], study.record.step * np.arange(length), *padded)


def _dimension(study):
    names, columns = ["delays", "radius", "share_of_pairs", "slope"], [[], [], [], []]
    for j, one in enumerate(study.dimensions):
        kept = one.correlation_sum > 0.0
        delays = np.full(int(kept.sum()), study.embedding.dimension + j, dtype=float)
        parts = (delays, one.radius[kept], one.correlation_sum[kept], one.slope[kept])
        for column, part in zip(columns, parts, strict=True):
            column.extend(part)
    return _table(names, *columns)


def _provenance(record, asked):
    return {
        "campaign": NAME,
        "file": record.path.name,
        "sha256": hashlib.sha256(record.path.read_bytes()).hexdigest(),
        "column": record.column,
        **asked,
        "python": platform.python_version(),
        "versions": {name: version(name) for name in ("numpy", "scipy", "numba")},
    }


def _write(path, text):
    """Whole or not at all: written beside and renamed."""
    beside = path.with_name(f".{path.name}.{os.getpid()}.tmp")
    try:
        beside.write_text(text, encoding="utf-8")
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise
