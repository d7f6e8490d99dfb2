"""Sweep of any number in a scene: one run a value, or one a pair of values of two keys; a table, a report.

    python -m campaigns.sweep --vary buoy.mass_kg 200 1600 8
    python -m campaigns.sweep --vary water.depth_m 21 23 5 --vary waves.steepness 0.02 0.14 7 --periods 80
    python -m campaigns.sweep --scene hanging_line --duration 20 --vary tether.nodes 21 81 4

Protocol: the same scene, start and length for every value of the keys; the transient is left out of all that is
measured. A buoy in regular waves gets the rows of `campaigns.buoy_sweep`, with regime and exponents where the run is
long enough, and over one key how far each largest tension holds; any other line gets extremes, tension and the solver's
counts. Of an irregular sea only the ramp is left out, and of a run without waves nothing. Nothing is random.
"""

import contextlib
import re
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial, reduce
from itertools import product
from pathlib import Path

from campaigns.columns import MESSAGE, RUN_KEY, STATISTICS, STATUS, Column, counted
from campaigns.explore import sweep as motions
from campaigns.explore.settings import ROW_SOURCES, settings_of
from campaigns.judge import judged_job, judged_scene
from campaigns.machinery import cli
from campaigns.machinery.folder import read_rows
from campaigns.machinery.plan import Job
from campaigns.machinery.runner import run
from campaigns.study import Lengths, Measures, Order, Study
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, in_regular_waves

MOST_KEYS = 2


@dataclass(frozen=True)
class Varied:
    """A key with its values, and the column of the table that holds them. index: of the list's element, None: a number.

    key: as on the command line, "water.depth_m", "start.buoy_velocity_mps[1]" or "waves.components[0].amplitude_m".
    part: the number in an element that is a table, "" for an element that is a number.
    """

    key: str
    name: str
    index: int | None
    values: tuple
    column: Column
    part: str = ""

    def put(self, value: float, base, changes: dict[str, object]) -> Iterator[str]:
        """Put a value into the changes of a scene; yields the fault of a list that has no such element.

        base: the scene whose list it is; two keys may change two elements of one list.
        """
        if self.index is None:
            changes[self.name] = value
            return
        whole = changes.get(self.name)
        if whole is None:
            whole = reduce(lambda part, name: (part or {}).get(name), self.name.split("."), base.as_dict())
        if not isinstance(whole, list | tuple) or self.index >= len(whole):
            yield f"--vary {self.key}: the scene has no such element; {self.name} is {whole}"
            return
        element = {**whole[self.index], self.part: value} if self.part else value
        changes[self.name] = [*whole[: self.index], element, *whole[self.index + 1 :]]

    def of(self, scene) -> float | None:
        """The value of the key in a scene; None where it has none."""
        found = reduce(lambda part, name: getattr(part, name, None), self.name.split("."), scene)
        if self.index is not None:
            found = found[self.index] if isinstance(found, list | tuple) and self.index < len(found) else None
        return found


def varied(words: list[str], faults: list[str], option: str = "--vary", of_words: bool = False) -> Varied | None:
    """The key and values of KEY LO HI COUNT; None where one is at fault. of_words: or of KEY WORD WORD ..."""
    from engine.scene.faults import suggestion
    from engine.scene.reference import keys

    key = words[0]
    element = re.fullmatch(r"(.+)\[(\d+)\](?:\.(\w+))?", key)
    name, index, part = (element[1], int(element[2]), element[3] or "") if element else (key, None, "")
    known, in_list = keys(), name
    name = f"{name}.{part}" if part else name
    told = of_words and name in known and known[name].kind == "text"
    values = list(dict.fromkeys(words[1:])) if told else cli.evenly(words[1:], f"{option} {key}", faults)
    if name not in known:
        faults.append(f"{option} {key}: no such key{suggestion(name, list(known))}")
        return None
    kind = known[name].kind
    if kind not in ("number", "whole number") and not (kind == "list" and element) and not told:
        a_list = f"one element of it, as {name}[0]" if kind == "list" else "a key that holds a number"
        faults.append(f"{option} {key}: holds a {kind}; allowed: {a_list}")
        return None
    if told and not values:
        faults.append(f"{option} {key}: given nothing; allowed: its words")
    if kind == "whole number":
        values = list(dict.fromkeys(round(value) for value in values))
    if not values:
        return None
    declared = known[name]
    unit = "" if declared.unit == "1" else declared.unit
    symbol = declared.symbol if declared.symbol not in ("", "-", "–") else key.rpartition(".")[2]
    digits = None if told else max(len(f"{value:.6f}".rstrip("0").partition(".")[2]) for value in values)
    meaning = declared.meaning[:1].lower() + declared.meaning[1:].rstrip(".")
    return Varied(key, in_list, index, tuple(values), Column(key, unit, symbol, meaning, digits), part)


@dataclass
class Options(motions.Starts):
    """The options of this campaign."""

    vary: list = cli.option("KEY LO HI COUNT", "a key of the scene and its values, both ends included; once or twice")
    duration: float | None = cli.option("S", "length of every run in seconds, for a scene without waves", cli.SECONDS)

    def read(self, out: Path, faults: list[str]) -> None:
        """The keys with their values (`Varied`), in place of the words of --vary."""
        words = self.vary or []
        allowed = "once or twice KEY LO HI COUNT, for instance buoy.mass_kg 200 1600 8"
        if not words or len(words) % 4 or len(words) > 4 * MOST_KEYS:
            faults.append(f"--vary: given {' '.join(words) or 'nothing'}; allowed: {allowed}")
            words = []
        self.vary = []
        for start in range(0, len(words), 4):
            key = varied(words[start : start + 4], faults)
            if key is not None:
                self.vary.append(key)
        if len({key.key for key in self.vary}) < len(self.vary):
            faults.append(f"--vary {self.vary[0].key}: given twice; allowed: two different keys")


def cases(order: Order) -> Iterator[Job]:
    """A run for every value, or pair of values."""
    keys = order.options.vary
    order.tell(f"--set {one.key}: this campaign sets it; use --vary" for one in keys if one.key in order.changes)
    base = order.base(tell=True)
    if base is None or not keys:
        return
    duration_s, periods = order.options.duration, order.periods if base.waves is not None else None
    if base.waves is not None and duration_s is not None:
        order.tell(["--duration: given for a scene with waves; allowed: --periods"])
    if base.waves is None and duration_s is None:
        order.tell([f"--duration: given nothing for {order.name!r}, a scene without waves; allowed: seconds, above 0"])
    scenes = []
    for values in product(*(one.values for one in keys)):
        labels = {one.key: value for one, value in zip(keys, values, strict=True)}
        changes: dict[str, object] = {}
        for one in keys:
            order.tell(one.put(labels[one.key], base, changes))
        scene = order.scene(changes, duration_s)
        if scene is not None and in_regular_waves(scene):
            scene = judged_scene(order, changes)
        if scene is not None:
            scenes.append(scene)
            labels |= {"dimensions": scene.motion.dimensions}
            start = motions.start_of(order, scene)
            plain = Job(labels, scene, periods, duration_s)
            yield judged_job(order, labels, scene, start) if in_regular_waves(scene) else plain
    starts_of(order, scenes)


def starts_of(order: Order, scenes=None) -> int | None:
    """Kicks at each value; None: runs from rest only, as over two keys."""
    if len(order.options.vary) > 1:
        if order.options.starts not in (None, motions.REST):
            order.tell([f"--starts: given {order.options.starts} with two keys; allowed: {motions.REST}, or one key"])
        return None
    return motions.kicks_of(order, [case.scene for case in order.cases] if scenes is None else scenes)


def runs(order: Order):
    """What does the runs: those from rest, or every motion."""
    kicks = starts_of(order)
    if kicks is None:
        return run
    (one,) = order.options.vary
    return motions.every_motion(order, kicks, one.column, one.name, one.index)


def measures(order: Order) -> Measures:
    """The row of a buoy in waves, or that of any line, after the values of the keys."""
    from campaigns.explore import rows

    labels = tuple(one.column for one in order.options.vary)
    measured = (rows.DIMENSIONS, STATUS, rows.TRANSIENT, *rows.EXTREMES, rows.HEIGHT, *STATISTICS, RUN_KEY, MESSAGE)
    if any(in_regular_waves(case.scene) for case in order.cases):
        others = (column for column in rows.COLUMNS if not column.name.startswith("planar_"))
        measured = tuple(column for column in others if column is not rows.STEEPNESS)
    columns = (*labels, *(column for column in measured if column.name not in {one.name for one in labels}))
    sources, settings = (*ROW_SOURCES, "campaigns/sweep/__init__.py"), settings_of(order)
    settings["asked"] = order.given_transient
    return Measures(columns, partial(sweep_row, **settings), sources, settings)


def sweep_row(
    trajectory, transient_periods: int | None, checks=None, full: int | None = None, asked: int | None = None
) -> dict[str, object]:
    """The columns of `measures` that a trajectory fills; those left out are unknown. Arguments: `buoy_row`.

    The upper end of a line without a buoy has a radius and an angle as the buoy has; without waves nothing is left out,
    of an irregular sea its ramp, and what is `asked` for by --transient.
    """
    from campaigns.explore.rows import HEIGHT, buoy_row, height_m, settled, sound_part

    scene = trajectory.scene
    if in_regular_waves(scene):
        return buoy_row(trajectory, transient_periods, checks, full)
    row, columns = counted(trajectory), sound_part(trajectory.columns)
    row[HEIGHT.name] = height_m(scene, columns)
    transient_s = 0.0
    if scene.waves is not None:
        left_out = asked if scene.waves.irregular else transient_periods
        transient_s = max(scene.waves.ramp_s, (left_out or 0) * scene.waves.period_s)
        row["transient_periods"] = transient_s / scene.waves.period_s
    if len(columns["time_s"]) > 1 and columns["time_s"][-1] > transient_s:
        row |= settled(scene, columns, transient_s)
    return row


def parameters(order: Order) -> dict[str, object]:
    told: dict[str, object] = {
        "vary": {one.key: list(one.values) for one in order.options.vary},
        "strobe_tolerance": STROBE_TOLERANCE,
        "longest_period": LONGEST_PERIOD,
    }
    if order.options.duration is not None:
        told |= {"duration_s": order.options.duration, "periods": None, "transient": 0}
    return told | motions.parameters(order, starts_of(order))


def beside(order: Order) -> Iterator[Callable]:
    """What follows the runs over one key: the errors of their largest tensions (`campaigns.explore.errors`)."""
    if len(order.options.vary) == 1 and any(in_regular_waves(case.scene) for case in order.cases):
        from campaigns.explore.errors import errors

        yield errors


def answer(order: Order, rows: list[dict]) -> list[str]:
    """Over one key as `campaigns.explore.answer`; over two how often each regime is found, and the largest load."""
    from campaigns.answers import greatest, known
    from campaigns.explore.answer import PEAK, largest, sentences, use_of

    keys = [one.key for one in order.options.vary]
    if len(keys) == 1:
        ends: tuple[dict, ...] = ()
        if starts_of(order) is not None:
            with contextlib.suppress(OSError, ValueError):
                ends = read_rows(order.how.out / "ends" / "table.csv")
        return sentences(rows, keys[0], keys[0], order.cases[0].scene, ends=ends)
    counts = Counter(str(row.get("regime") or row["status"]) for row in rows)
    said = [f"{len(rows)} runs: {', '.join(f'{word} {count}' for word, count in counts.most_common())}."]
    if (peak := greatest(rows, PEAK)) is not None:
        where = " and ".join(f"{key} = {known(peak, key):.4g}" for key in keys)
        said.append(f"Largest tension {largest(peak)} at {where}.")
        said.append(use_of(peak, order.cases[0].scene, searched=False))
    return said


STUDY = Study(
    name="sweep",
    protocol=__doc__,
    scene="tethered_buoy",
    lengths=Lengths(periods=120, transient=40, budget=700),
    options=Options,
    cases=cases,
    measures=measures,
    parameters=parameters,
    runs=runs,
    beside=beside,
    answer=answer,
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
