"""What the explorer's script draws, as one line of JSON that may stand inside a page."""

from __future__ import annotations

import base64
import json
import math

import numpy as np

from .content import Explorer

_STEPS = 65535  # of the value axis: a point is 2 bytes, 400 columns of 200 points 160 kB


def explorer_json(explorer: Explorer) -> str:
    """Columns with their parameter, name, anchor and number of points; the points as little-endian 16-bit numbers.

    A point v is round(65535 (v - low)/(high - low)), low and high the ends of all points; not a number becomes null.
    """
    points = [np.asarray(column.points, dtype=float) for column in explorer.columns]
    points = [values[np.isfinite(values)] for values in points]
    everything = np.concatenate([*points, np.empty(0)])
    low, high = (float(everything.min()), float(everything.max())) if everything.size else (0.0, 1.0)
    high = high if high > low else low + 1.0
    steps = np.rint((everything - low) / (high - low) * _STEPS).astype("<u2")
    content = {
        "x_label": explorer.x_label,
        "y_label": explorer.y_label,
        "low": low,
        "high": high,
        "columns": [
            {"at": column.at, "name": column.name, "anchor": column.anchor, "points": len(values)}
            for column, values in zip(explorer.columns, points, strict=True)
        ],
        "lower": [
            {"label": label, "values": _numbers(values), "errors": _numbers(errors)}
            for label, values, errors in explorer.lower
        ],
        "points": base64.b64encode(steps.tobytes()).decode(),
    }
    # "<" would let a name end the script element that the line stands in
    return json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _numbers(values) -> list[float | None]:
    return [float(f"{value:.6g}") if math.isfinite(value) else None for value in values]
