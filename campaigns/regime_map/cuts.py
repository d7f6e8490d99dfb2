"""A row or a column of a map as a sweep of its own, in a folder of the map, with the judged runs of the map."""

import os
import shutil
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from campaigns.explore.grid import Grid, Varied
from campaigns.explore.sweep import table_of
from campaigns.machinery import CampaignStopped, claimed, trajectory_path
from campaigns.study import Order, Study


def read(words: list[str] | None, keys: Sequence[Varied], faults: list[str]) -> dict:
    """The values of --cut by key: the nearest ones of the map. keys: of the map."""
    chosen = {}
    if words is None:
        return chosen
    by_name = {key.key: key for key in keys}
    for word in words:
        name, _, text = word.partition("=")
        if name not in by_name:
            faults.append(f"--cut {word}: not a key of the map; allowed: KEY=VALUE of {', '.join(by_name)}")
            continue
        values = by_name[name].values
        try:
            if text not in values:
                text = min(values, key=lambda value: abs(value - float(text)))
            chosen[name] = text
        except (TypeError, ValueError):
            faults.append(f"--cut {word}: allowed: one of {', '.join(map(str, values))}")
    if not faults and len(chosen) != len(keys) - 1:
        names = ", ".join(by_name)
        faults.append(f"--cut {' '.join(words)}: allowed: a value of all keys of the map but one of {names}")
    return chosen


def cut(order: Order, argv: list[str], simulate: Callable | None = None) -> int:
    """Do the sweep of the key that is left; returns its exit code. argv, simulate: as of `Study.conduct`."""
    chosen = order.options.cut
    places = [f"{name}={value}" for name, value in chosen.items()]
    out = order.how.out / "cuts" / ",".join(places)
    _share_runs(order, out)
    changes = dict(order.changes)
    grid = order.options.grid
    for key in grid.keys:
        if key.key in chosen:
            order.tell(*key.put(chosen[key.key], grid.base(order), changes))
    study, options = _sweep_of(order)
    options |= {"seed": order.options.seed, "kick_speed": order.options.kick_speed}
    sweep = study.order(replace(order.how, out=out), order.name, changes, **options)
    faults = [*order.faults, *sweep.faults]
    if faults:
        raise CampaignStopped("; ".join(faults))
    print(f"cut      {' and '.join(places).replace('=', ' = ')}, in {out}")
    return study.conduct(sweep, argv, simulate)


def _sweep_of(order: Order) -> tuple[Study, dict]:
    """The sweep over the key of a map that is left, as done by the command of the map, and its options."""
    from campaigns import buoy_sweep, sweep

    (key,) = (key for key in order.options.grid.keys if key.key not in order.options.cut)
    if key.key == buoy_sweep.SWEPT:
        study, options = buoy_sweep.STUDY, {"grid": buoy_sweep.grid_of(key.values), "no_accuracy": True}
    else:
        study, options = sweep.STUDY, {"grid": Grid((key,)), "budget": order.periods}
    return replace(study, module="campaigns.regime_map"), options


def _share_runs(order: Order, out: Path) -> None:
    """Give the folder of a cut the judged runs of its cells."""
    chosen, folder = order.options.cut, order.how.out
    keys = {case.key for case in order.cases if chosen.items() <= case.labels.items()}
    keys |= {row["run_key"] for row in table_of(folder) if chosen.items() <= row.items()}
    with claimed(out):
        for key in sorted(keys):
            source, target = trajectory_path(folder, key), trajectory_path(out, key)
            if source.exists() and not target.exists():
                _link(source, target)


def _link(source: Path, target: Path) -> None:
    """Let two folders have one file; whoever goes on with its run writes another one in its place."""
    try:
        os.link(source, target)
    except OSError:  # another file system, or one without links
        shutil.copyfile(source, target)
