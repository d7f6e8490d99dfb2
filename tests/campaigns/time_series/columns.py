"""Columns in files, as someone would measure them, and what `python -m analysis` says about them."""

import json

import numpy as np

from campaigns.time_series import main


def written(path, values, step=None):
    """A CSV of times and values, or of the values alone."""
    rows = ["x"] if step is None else ["t,x"]
    rows += [f"{v:.15g}" if step is None else f"{k * step:.9g},{v:.15g}" for k, v in enumerate(np.asarray(values))]
    path.write_text("\n".join(rows) + "\n")
    return path


def answered(tmp_path, values, step=None, *options):
    """answer.json of the command; it must end well."""
    path, out = written(tmp_path / "series.csv", values, step), tmp_path / "out"
    time = [] if step is None else ["--time", "t"]
    assert main([str(path), "--column", "x", *time, *options, "--out", str(out)]) == 0
    return json.loads((out / "answer.json").read_text())
