"""Sweep of any number in a scene: one run a value, or one a pair of values of two keys; a table, a report.

    python -m campaigns.sweep --vary buoy.drag 0.1 0.8 8
    python -m campaigns.sweep --vary water.depth_m 21 23 5 --vary waves.steepness 0.02 0.14 7 --periods 80
    python -m campaigns.sweep --scene hanging_line --duration 20 --vary tether.nodes 21 81 4

Protocol: the same scene, start and length for every value of the keys; the transient is left out of all that is
measured. A buoy in regular waves gets the rows of `campaigns.buoy_sweep`, with regime and exponents where the run is
long enough, and over one key how far each largest tension holds; any other line gets extremes, tension and the solver's
counts. In an irregular sea rows have statistics: significant elevation, mean and standard deviation of the tension,
snaps an hour. Of a sea only the ramp is left out, and of a run without waves nothing. Nothing is random.
"""

from __future__ import annotations

import contextlib
import io
import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field, replace
from functools import partial
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING

from campaigns.explore import sweep as motions
from campaigns.explore.grid import Grid, grid_of, varied
from campaigns.judge import judged_job, judged_scene
from campaigns.machinery import Job, cli, write_new
from campaigns.study import Lengths, Measures, Order, Study
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, in_regular_waves
from tables import (
    ANSWER,
    MESSAGE,
    PEAK,
    RUN_KEY,
    STATISTICS,
    STATUS,
    Row,
    Rows,
    counted,
    names,
    read_columns,
    read_table,
)

if TYPE_CHECKING:
    import pandas

    from engine.run.simulation import SceneOrName


@dataclass
class Options(motions.SweepOptions):
    """The options of this campaign. grid: the keys with their values, read from --vary."""

    vary: list = cli.option("KEY LO HI COUNT", "a key of the scene and its values, both ends included; once or twice")
    duration: float | None = cli.option("S", "length of every run in seconds, for a scene without waves", cli.SECONDS)
    grid: Grid = field(default_factory=Grid)

    def read(self, faults: list[str]) -> None:
        """The keys with their values in the words of --vary."""
        self.grid = grid_of(self.vary or [], faults, least=1, example=", for instance buoy.drag 0.1 0.8 8")


def cases(order: Order) -> Iterator[Job]:
    """A run for every value, or pair of values."""
    grid = order.options.grid
    grid.refuse_set(order)
    base = grid.base(order, tell=True)
    if base is None or not grid.keys:
        return
    duration_s, periods = order.options.duration, order.periods
    if base.waves is not None and duration_s is not None:
        order.tell("--duration: given for a scene with waves; allowed: --periods")
    if base.waves is None:
        periods = None
        if duration_s is None:
            absent = f"--duration: given nothing for {order.name!r}, a scene without waves"
            order.tell(f"{absent}; allowed: seconds, above 0")
    for place in grid.places():
        changes, faults = grid.changes(place, base)
        if faults:
            order.tell(*faults)
            continue
        scene = order.scene(changes, duration_s)
        if scene is not None and in_regular_waves(scene):
            scene = judged_scene(order, changes)
        if scene is None:
            continue
        labels, start = place | {"dimensions": scene.motion.dimensions}, motions.start_of(order, scene)
        if in_regular_waves(scene):
            yield judged_job(order, labels, scene, start)
        else:
            yield Job(labels, scene, periods, duration_s)


def measures(order: Order) -> Measures:
    """The row of a buoy in waves, or that of any line, after the values of the keys."""
    from campaigns.explore import rows
    from campaigns.sweep import seas

    keys = order.options.grid.columns
    if any(map(in_regular_waves, order.scenes)):
        columns = motions.columns_of(keys)
    else:
        loads = (*rows.EXTREMES, rows.UTILISATION, *rows.SNAPS, *rows.ALONG_LINE)
        if in_sea(order.cases[0].scene):
            loads = (*seas.COLUMNS, *loads)
            order = replace(order, transient=order.given_transient)
        measured = (rows.DIMENSIONS, STATUS, rows.TRANSIENT, *loads, *rows.OUT_OF_WATER, *STATISTICS, RUN_KEY, MESSAGE)
        columns = (*keys, *(column for column in measured if column.name not in names(keys)))
    row = partial(sweep_row, transient_periods=order.transient)
    return motions.measures_of(order, columns, row, "campaigns/sweep")


def in_sea(scene) -> bool:
    """Whether a scene has irregular waves."""
    return scene.waves is not None and scene.waves.irregular


def sweep_row(trajectory, judgement, transient_periods: int | None) -> Row:
    """The columns of `measures` that a trajectory fills; those left out are unknown.

    The upper end of a line without a buoy has a radius and an angle as the buoy has; without waves nothing is left out,
    of an irregular sea its ramp at least.
    """
    from campaigns.explore.rows import (
        UTILISATION,
        buoy_row,
        out_of_water,
        settled,
        snap_columns,
        sound_part,
        utilisation,
    )
    from campaigns.sweep import seas

    scene = trajectory.scene
    if judgement is not None:
        return buoy_row(trajectory, judgement)
    row, columns = counted(trajectory), sound_part(trajectory.columns)
    row |= out_of_water(scene, columns)
    transient_s = 0.0
    if scene.waves is not None:
        transient_s = max(scene.waves.ramp_s, (transient_periods or 0) * scene.waves.period_s)
        row["transient_periods"] = transient_s / scene.waves.period_s
    if len(columns["time_s"]) > 1 and columns["time_s"][-1] > transient_s:
        row |= settled(scene, columns, transient_s) | snap_columns(scene, columns, transient_s)
        if in_sea(scene):
            row |= seas.statistics(scene, columns, transient_s)
        row[UTILISATION.name] = utilisation(scene, row)
    return row


def parameters(order: Order) -> dict:
    parameters = {
        "vary": {key.key: list(key.values) for key in order.options.grid.keys},
        "strobe_tolerance": STROBE_TOLERANCE,
        "longest_period": LONGEST_PERIOD,
    }
    if order.options.duration is not None:
        parameters |= {"duration_s": order.options.duration, "periods": None, "transient": 0}
    return parameters | motions.parameters(order)


def beside(order: Order) -> Iterator[Callable]:
    """What follows the runs over one key: the errors of their largest tensions (`campaigns.explore.errors`)."""
    if order.options.no_accuracy or len(order.options.grid.keys) > 1:
        return
    if any(map(in_regular_waves, order.scenes)):
        from campaigns.explore.errors import errors

        yield errors


def answer(order: Order, rows: Rows) -> list[str]:
    """Over one key as `campaigns.explore.answer`; over two how often each regime is found, and the largest load.

    In a sea the statistics of its runs (`seas.sentences`).
    """
    from campaigns.answers import known_rows, line
    from campaigns.explore.load import load
    from campaigns.sweep import seas

    keys, scene = names(order.options.grid.columns), motions.scene_of_peak(order, rows)
    symbols = dict(zip(keys, keys, strict=True))
    if in_sea(scene):
        return seas.sentences(rows, symbols, scene)
    if len(keys) == 1:
        return motions.answer(order, rows, keys[0])
    counts = Counter(str(row.get("regime") or row["status"]) for row in rows)
    regimes = ", ".join(f"{word} {count}" for word, count in counts.most_common())
    lines = [line("MOTIONS", f"{len(rows)} runs: {regimes}.")]
    good = known_rows(rows, PEAK)
    if not good:
        return lines
    return [line("LOAD", load(good, symbols, scene)), *lines]


def sweep(
    scene: SceneOrName,
    key: str,
    values: Iterable[float],
    *,
    periods: int | None = None,
    transient: int | None = None,
    duration: float | None = None,
    starts: str | int | None = None,
    seed: int | None = None,
    jobs: int | None = None,
    out: str | Path = Path("results", "sweep"),
    report: bool = True,
) -> pandas.DataFrame:
    """The campaign as a function: a row for each motion at each value of a key, and its folder.

    scene     a Scene, the name of a shipped one, or the path of a scene file
    key       of the scene, as "waves.steepness" or "buoy.mass_kg"
    values    numbers
    out       folder of the results, with table.csv, trajectories and the report; what is there is not done again
    report    whether report.html and report.pdf are made
    others    as the options of `python -m campaigns.sweep`; None: as without the option
    Returns the table; its attrs have `units` (column -> unit), `meanings`, `folder` and the lines of the `answer`.
    Raises ValueError with every fault; then nothing is run or written. A run that ends early is a row with its status.
    """
    import pandas

    from engine import Scene

    values, faults, words = list(values) if isinstance(values, Iterable) else [values], [], ["--out", str(out)]
    given = {"periods": periods, "transient": transient, "duration": duration, "starts": starts, "seed": seed}
    given["jobs"] = jobs
    for name, value in given.items():
        if value is not None:
            words += [f"--{name}", str(value)]
    if not report:
        words.append("--no-report")
    numbers = [float(value) for value in values if isinstance(value, Real) and math.isfinite(value)]
    if not values or len(numbers) < len(values):
        faults.append(f"values: given {values}; allowed: finite numbers, one or more")
    if not isinstance(out, (str, Path)):
        faults.append(f"out: given {out!r}; allowed: a folder")
    options = cli.split(STUDY.parser(), words, faults)
    how = cli.running(options, STUDY.places, STUDY.name, faults)
    varied_key = varied([str(key)], faults, "key", numbers=numbers or [0.0])
    if faults:
        raise ValueError("; ".join(faults))
    name, earlier = str(scene), None  # earlier: content of the file in a folder that holds results
    if isinstance(scene, Scene):
        path = how.out / "given.toml"
        if path.exists():
            earlier = path.read_bytes()
        how.out.mkdir(parents=True, exist_ok=True)
        name = str(path)
        write_new(path, scene.to_toml().encode())
    order = STUDY.order(how, name, {}, **vars(options) | {"grid": Grid((varied_key,))})
    if order.faults:
        if earlier is not None:
            write_new(Path(name), earlier)
        elif isinstance(scene, Scene):
            Path(name).unlink()
            with contextlib.suppress(OSError):  # a folder that holds more stays
                how.out.rmdir()
        raise ValueError("; ".join(order.faults))
    called = ["--scene", name, *words, "--vary", key, *map(str, numbers)]
    with contextlib.redirect_stdout(io.StringIO()):
        STUDY.conduct(order, called)
    columns = read_columns(how.out / "columns.csv")
    table = pandas.DataFrame(read_table(how.out / "table.csv"))
    table.attrs["units"] = {name: columns[name].unit for name in table}
    table.attrs["meanings"] = {name: columns[name].meaning for name in table}
    table.attrs |= {"folder": str(how.out), "answer": (how.out / ANSWER).read_text(encoding="utf-8").splitlines()}
    return table


STUDY = Study(
    name="sweep",
    protocol=__doc__,
    scene="tethered_buoy",
    lengths=Lengths(periods=120, transient=40, budget=700),
    options=Options,
    cases=partial(motions.with_kicks, cases),
    measures=measures,
    parameters=parameters,
    runs=motions.runs,
    beside=beside,
    answer=answer,
)
main, read_order = STUDY.main, STUDY.read_order
