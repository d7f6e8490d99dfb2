"""What the parts of the study of eq. (33) gave, kept: a netCDF-3 file and a row of table.csv for each.

The key of a file is a hash of the part, its parameters and the sources of `analysis`. The row is an attribute of the
file, so the table can be made again from the files.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import sys
import time
from argparse import Namespace
from dataclasses import asdict
from pathlib import Path

import xarray

from analysis.compiled import source_hash
from analysis.oscillator import SnapOscillator, snap_exponents
from campaigns.machinery.folder import Table, trajectory_path
from campaigns.machinery.plan import Summary
from campaigns.oscillator.parts import COLUMNS, PARTS, SEED
from engine.atomic import write_atomic


def parameters(order: Namespace) -> dict:
    """What the provenance says of this study besides who ran it, where and with what."""
    return {
        "oscillator": asdict(SnapOscillator(**order.changes)),
        "force_range": list(order.forces),
        "frequency_range": list(order.frequencies),
        "effort": order.effort,
        "seed": SEED,
        "analysis_source_hash": source_hash(),
    }


def done(order: Namespace) -> tuple[dict[str, float], Summary]:
    """Do every part that is not there yet; keep table.csv up to date. Returns times and the summary."""
    oscillator, out = SnapOscillator(**order.changes), order.how.out
    numbers = [f"{key} = {value!r}" for key, value in asdict(oscillator).items()]
    head = "# eq. (33), dimensionless, as run\n[oscillator]\n"
    write_atomic(out / "scene.toml", (head + "\n".join(numbers) + "\n").encode())
    keys = {part: _key(part, order) for part in PARTS}
    table = Table(out / "table.csv", COLUMNS, list(keys.values()))
    found = {key: _kept(trajectory_path(out, key)) for key in keys.values()}
    table.rows = {key: row | {"run_key": key} for key, row in found.items() if row is not None}
    missing = [part for part, key in keys.items() if found[key] is None]
    table.write()
    timing = {"compile_s": _compile(oscillator) if missing else 0.0}
    begun = time.perf_counter()
    try:
        for part in missing:
            print(f"{part} ...", file=sys.stderr)
            row = _done(part, oscillator, order, trajectory_path(out, keys[part]))
            table.add(keys[part], row | {"run_key": keys[part]})
    finally:
        with contextlib.suppress(OSError):
            table.write()
    timing |= {"run_s": time.perf_counter() - begun, "analysis_s": 0.0}
    return timing, Summary(table.in_order(), len(PARTS) - len(missing), len(missing), 0.0)


def _key(part: str, order: Namespace) -> str:
    own = {"diagram-force": "force_range", "diagram-frequency": "frequency_range"}.get(part)
    ranges = {"force_range", "frequency_range"} - {own}
    content = {name: entry for name, entry in parameters(order).items() if name not in ranges}
    return hashlib.sha256(json.dumps({"part": part, **content}, sort_keys=True).encode()).hexdigest()


def _compile(oscillator: SnapOscillator) -> float:
    print("compiling eq. (33), or loading it compiled ...", file=sys.stderr)
    begun = time.perf_counter()
    snap_exponents(oscillator, count=2, transient_periods=1, periods=2, blocks=2)
    return time.perf_counter() - begun


def _done(part: str, oscillator: SnapOscillator, order: Namespace, path: Path) -> dict:
    begun = time.perf_counter()
    try:
        arrays, row = PARTS[part](oscillator, order)
    except Exception as error:  # one part that fails must not take the others along
        return {"part": part, "status": "error", "message": f"{type(error).__name__}: {error}"}
    row = {"part": part, "status": "ok", **row, "wall_s": round(time.perf_counter() - begun, 3)}
    variables = {name: ([f"{name}_{axis}" for axis in range(values.ndim)], values) for name, values in arrays.items()}
    kept = xarray.Dataset(variables, attrs={"row": json.dumps(row, default=lambda number: number.item())})
    write_atomic(path, bytes(kept.to_netcdf(engine="scipy", format="NETCDF3_64BIT")))
    return row


def _kept(path: Path) -> dict | None:
    """The row of a part's file; None where there is no such file, or a damaged one."""
    try:
        with xarray.open_dataset(path, engine="scipy") as file:
            return json.loads(file.load().attrs["row"])
    except Exception:  # absent, truncated, from a foreign hand: the cure is the same, it is computed again
        return None
