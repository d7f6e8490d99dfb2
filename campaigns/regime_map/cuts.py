"""A row or a column of a map as a sweep of its own, in a folder of the map, with the judged runs of the map."""

import contextlib
import os
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

from campaigns.machinery.folder import claimed, read_rows, trajectory_path
from campaigns.study import Order


def read(words: list[str] | None, keys, faults: list[str]) -> dict[str, object]:
    """The values of --cut by key: the nearest ones of the map; keys: `Varied` of all its keys."""
    chosen: dict[str, object] = {}
    if words is None:
        return chosen
    known = {one.key: one for one in keys}
    for word in words:
        key, _, text = word.partition("=")
        if key not in known:
            faults.append(f"--cut {word}: not a key of the map; allowed: KEY=VALUE of {', '.join(known)}")
            continue
        values = known[key].values
        try:
            chosen[key] = text if text in values else min(values, key=lambda one: abs(one - float(text)))
        except (TypeError, ValueError):
            faults.append(f"--cut {word}: allowed: one of {', '.join(map(str, values))}")
    if not faults and len(chosen) != len(known) - 1:
        faults.append(f"--cut {' '.join(words)}: allowed: a value of all keys of the map but one of {', '.join(known)}")
    return chosen


def cut(order: Order, simulate: Callable | None = None) -> int:
    """Do the sweep of the key that is left; returns its exit code. simulate: as of `Study.main`."""
    from campaigns import buoy_sweep, sweep

    own, how, chosen = order.options, order.how, order.options.cut
    free = next(one for one in own.grid.every if one.key not in chosen)
    out = how.out / "cuts" / ",".join(f"{key}={value}" for key, value in chosen.items())
    keys = {case.key for case in order.cases if _of(case.labels, chosen)}
    with contextlib.suppress(OSError, ValueError):  # a map that has not come to its end
        keys |= {row["run_key"] for row in read_rows(how.out / "table.csv") if _of(row, chosen)}
    with claimed(out):
        for there, here in ((trajectory_path(how.out, key), trajectory_path(out, key)) for key in sorted(keys)):
            if there.exists() and not here.exists():
                _shared(there, here)
    words = ["--out", str(out), "--jobs", str(how.jobs), "--backend", how.backend, "--scene", order.name]
    words += ["--dask-address", how.dask_address] if how.dask_address else []
    words += ["--seed", str(own.seed), "--kick-speed", str(own.kick_speed), *([] if how.report else ["--no-report"])]
    changes: dict[str, object] = {}
    for one in own.grid.every:
        if one.key in chosen:
            order.tell(one.put(chosen[one.key], order.base(), changes))
    words += ["--set", *order.set_words, *(f"{name}={value}" for name, value in changes.items())]
    print(f"cut      {' and '.join(f'{key} = {value}' for key, value in chosen.items())}, in {out}")
    if free.key == buoy_sweep.SWEPT:
        return buoy_sweep.main([*words, "--no-accuracy", "--steepness", *map(str, free.values)], simulate)
    ends = map(str, (free.values[0], free.values[-1], len(free.values)))
    return sweep.main([*words, "--vary", free.key, *ends, "--budget", str(order.periods)], simulate)


def _of(labels: Mapping, chosen: dict[str, object]) -> bool:
    return all(labels[key] == value for key, value in chosen.items())


def _shared(there: Path, here: Path) -> None:
    """Let two folders have one file; whoever goes on with its run writes another one in its place."""
    try:
        os.link(there, here)
    except OSError:  # another file system, or one without links
        shutil.copyfile(there, here)
