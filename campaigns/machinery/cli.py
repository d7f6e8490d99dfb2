"""Command lines of the campaigns: options as fields of records, whose faults are collected instead of ending at one.

argparse splits the words, and stops at the first bad value. Here an option says what its words may be (`Kind`), and
whatever is wrong is appended to one list of faults, to be shown together with the faults of the scene. Nothing heavy is
imported, because `--help` has to appear at once (libraries weighed: docs/developing.md).

    @dataclass
    class Options(cli.Options):
        effort: float = cli.option("SHARE", "share of the usual work", SHARE, usual=1.0)      --effort SHARE
        quick: bool = cli.flag("fewer cases")                                                 --quick
"""

import argparse
import inspect
import json
import math
import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import Field, dataclass, field, fields
from pathlib import Path
from typing import Any

import engine
import engine.scene
from engine.atomic import can_be_written, is_netcdf
from engine.streams import Parser

BACKENDS = ("loky", "threading", "dask")
EXIT_OK, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130

EXITS = "exit codes: 0 done, 1 stopped (disk full, folder in use, no report), 2 bad input, 130 Ctrl-C"

MOST_JOBS, MOST_PERIODS, MOST_RUNS = 1024, 10**9, 10_000
A_FOLDER = "allowed: a folder, new or of this campaign"


@dataclass(frozen=True)
class Kind:
    """What a word may be: convert(text) raises ValueError for what is not allowed; allowed: the same in words."""

    convert: Callable[[str], object]
    allowed: str


def number(allowed: str, is_sound: Callable) -> Kind:
    """Numbers for which `is_sound` holds."""
    return Kind(lambda text: _checked(is_sound, float(text)), allowed)


def whole(least: int, most: float = math.inf) -> Kind:
    """Whole numbers from `least` to `most`."""
    allowed = f"a whole number, {least} or above"
    if most < math.inf:
        allowed += f" and at most {most}"
    return Kind(lambda text: _checked(lambda count: least <= count <= most, int(text)), allowed)


def one_of(words: tuple[str, ...]) -> Kind:
    """Some words only."""
    return Kind(lambda text: _checked(lambda word: word in words, text), "one of " + ", ".join(words))


def _checked(is_sound: Callable, value):
    if not is_sound(value):
        raise ValueError(value)
    return value


def _scheduler(text: str) -> str:
    parts = re.fullmatch(r"((tcp|tls|ws|wss)://)?([^\s:/]+|\[[0-9A-Fa-f:]+\]):(\d{1,5})/?", text)
    if not parts or not 0 < int(parts[4]) < 65536:
        raise ValueError(text)
    return text


FRACTION = number("a finite number, 0 or above", lambda value: 0.0 <= value < math.inf)
POSITIVE = number("a finite number above 0", lambda value: 0.0 < value < math.inf)
SECONDS = number("seconds, a finite number above 0", lambda value: 0.0 < value < math.inf)
SCHEDULER = Kind(_scheduler, "the address of a scheduler, as tcp://HOST:PORT")
# an empty name, as of a shell variable that is not set, would be the current folder
FOLDER = Kind(lambda text: Path(_checked(str.strip, text)), "a folder")
RUN_FILE = Kind(lambda text: _checked(is_netcdf, text), "the file of a run, of trajectories/ or of Trajectory.save")


@dataclass(frozen=True)
class Option:
    """What an option of a command takes.

    metavar: its words in the help.
    kind: of its one value, or of each of its `many`; None: its words stay as they are.
    usual: its value where it is not given; of words a text.
    """

    metavar: str
    help: str
    kind: Kind | None = None
    usual: object = None
    many: bool = False

    def add_to(self, group, name: str) -> None:
        """Add it to a group of a parser.

        Given twice, many words add up (`--set A --set B` is `--set A B`), and of one value the last one counts.
        """
        text = self.help
        if self.usual is not None and not self.many:
            text += f" (default: {self.usual})"
        repeated = "extend"
        if self.kind is not None and not self.many:
            repeated = "store"
        action = group.add_argument(name, metavar=self.metavar, nargs="*", action=repeated, help=text)
        action.option = self

    def value(self, name: str, words: list[str] | None, faults: list[str]) -> object:
        """Its value in these words, of `many` a list, each once; `usual` where it was not given or is at fault.

        words None: it was not given.
        """
        kind = self.kind
        if kind is None:
            if words is None and self.usual is not None:
                return self.usual.split()
            return words
        if words is None:
            return self.usual
        if not words or (len(words) > 1 and not self.many):
            count = "one value,"
            if self.many:
                count = "one value or more, each"
            faults.append(f"{name}: given {' '.join(words) or 'nothing'}; allowed: {count} {kind.allowed}")
            return self.usual
        values = []
        for word in words:
            try:
                values.append(kind.convert(word))
            except ValueError:
                faults.append(f"{name}: given {word!r}; allowed: {kind.allowed}{_parted(word, kind)}")
        if len(values) < len(words):
            return self.usual
        if self.many:
            return list(dict.fromkeys(values))
        return values[0]


def option(*declared: object, **more: object) -> Any:
    """A field of a record of options that takes words, declared as an `Option`."""
    return field(default=None, metadata={"option": Option(*declared, **more)})


def flag(help: str) -> Any:
    """A field of a record of options that is given alone, or not."""
    return field(default=False, metadata={"flag": help})


def seed(use: str) -> Any:
    """--seed. use: of which random numbers."""
    return option("N", use, whole(0, 2**32 - 1), 1)


@dataclass
class Options:
    """The options of one command, beside those that all share; `read` fills fields that are no `option` or `flag`."""

    def read(self, faults: list[str]) -> None:
        """Judge and amend the values."""

    @classmethod
    def offered(cls) -> Iterator[Field]:
        """Its fields in the order of the help: its own ones before those that it inherits."""
        known = {entry.name: entry for entry in fields(cls)}
        for base in cls.__mro__:
            for name in inspect.get_annotations(base):
                if name in known:
                    yield known.pop(name)


@dataclass(frozen=True)
class Running:
    """How and where a campaign runs; dask_address None: no scheduler, or a local one."""

    out: Path
    jobs: int = 1
    backend: str = "loky"
    dask_address: str | None = None
    report: bool = True

    @property
    def sends(self) -> bool:
        """Whether workers send what they computed, because they need not see the folder."""
        return self.backend == "dask"

    def seen(self, folder: Path) -> Path | None:
        """The folder as workers see it, which may stand in another one than this process; None: they need not."""
        return None if self.sends else folder.absolute()


PLACES = {  # options that say where runs are done
    "jobs": Option(
        "N", "runs at the same time (ignored with --dask-address)", whole(1, MOST_JOBS), min(2, os.cpu_count() or 1)
    ),
    "backend": Option("|".join(BACKENDS), "processes (loky), threads or a dask cluster", one_of(BACKENDS), BACKENDS[0]),
    "dask_address": Option("ADDRESS", "scheduler of a dask cluster, tcp://HOST:PORT (default: a local one)", SCHEDULER),
}


class _Formatter(argparse.RawDescriptionHelpFormatter):
    # Every option accepts any number of words; the help shows the words it wants, as the metavar says.
    def _format_args(self, action, default_metavar):
        return action.metavar or ""


def parser(module: str, description: str, epilog: str = EXITS) -> Parser:
    """An empty parser for `python -m module`; read the line with `split`."""
    words = {"description": description, "epilog": epilog, "formatter_class": _Formatter}
    return Parser(prog=f"python -m {module}", allow_abbrev=False, **words)


def add_options(group, record: type[Options]) -> None:
    """Add the options of a record."""
    for entry in record.offered():
        name = option_name(entry.name)
        if "option" in entry.metadata:
            entry.metadata["option"].add_to(group, name)
        elif "flag" in entry.metadata:
            group.add_argument(name, action="store_true", help=entry.metadata["flag"])


def option_name(field_name: str) -> str:
    """--dask-address of dask_address."""
    return "--" + field_name.replace("_", "-")


def add_running(group, campaign: str, places: tuple[str, ...]) -> None:
    """Add the options that say how and where a campaign runs; places: which of PLACES."""
    for name in places:
        PLACES[name].add_to(group, option_name(name))
    held = "folder of the results; what is found there is not done again"
    Option("DIR", held, FOLDER, Path("results", campaign)).add_to(group, "--out")
    group.add_argument("--no-report", action="store_true", help="leave out report.html and report.pdf")


def options_of(record: type[Options], values: argparse.Namespace) -> Options:
    """The record of the values that `split` found, and of those that a program has put beside them."""
    names = {entry.name for entry in fields(record)}
    return record(**{name: value for name, value in vars(values).items() if name in names})


def running(values: argparse.Namespace, places: tuple[str, ...], campaign: str, faults: list[str]) -> Running:
    """What the options of `add_running` say."""
    where = {name: getattr(values, name) for name in places}
    how = Running(values.out, **where, report=not values.no_report)
    if how.dask_address is not None and how.backend != "dask":
        faults.append(f"--dask-address: given with --backend {how.backend}; allowed: with --backend dask only")
    if how.sends:
        from importlib.util import find_spec

        if find_spec("distributed") is None:
            faults.append("--backend: given 'dask', which is not installed; allowed: loky, threading")
    fault = fault_of(how.out, campaign)
    if fault is not None:
        faults.append(fault)
    return how


def split(parser: Parser, argv: list[str], faults: list[str]) -> argparse.Namespace:
    """The values of the options, or their words where an option has no kind; what is not allowed becomes faults.

    `mistyped` of the values: whether a word of the line is no option of the parser and belongs to none.
    """
    values = None
    while values is None:
        try:
            values, unknown = parser.parse_known_args(argv)
        except ValueError as error:
            option, fault = _option_of(str(error))
            faults.append(fault)
            # without the option, to find the faults of the others
            others = [word for word in argv if word.partition("=")[0] not in (option or "").split("/")]
            argv = others if len(others) < len(argv) else []
    values.mistyped = bool(unknown)
    for word in unknown:
        if not word.startswith("-") and unknown[0].startswith("-"):
            continue  # the value of an unknown option, which has been named
        meant = _with_option(word, parser)
        if meant:
            faults.append(f"{word}: given without its option; did you mean {meant}?")
        else:
            faults.append(f"{word.partition('=')[0]}: no such option{parser.close_to(word)}")
    for action in parser._actions:
        if hasattr(action, "option"):
            words = getattr(values, action.dest)
            setattr(values, action.dest, action.option.value(action.option_strings[0], words, faults))
    return values


def _option_of(error: str) -> tuple[str | None, str]:
    """The option that argparse stops at, None where it names none, and the fault in our words."""
    alone = re.fullmatch(r"argument (\S+): ignored explicit argument (.*)", error)
    if alone:
        return alone[1], f"{alone[1]}: given {alone[2]}; allowed: the option alone"
    empty = re.fullmatch(r"argument (-\S+): expected (.*)", error)
    if empty:
        return empty[1], f"{empty[1]}: given without a value; allowed: {empty[2].replace('argument', 'value')}"
    return None, error


def _with_option(word: str, parser: argparse.ArgumentParser) -> str:
    """A word with the option that it may belong to: "--steepness 0.05" of 0.05; "" where there is none.

    Of the options that take many values of a kind, the first that allows the word.
    """
    named = [action for action in parser._actions if action.option_strings]
    options = {action.option_strings[0]: getattr(action, "option", None) for action in named}
    key, equals, value = word.partition("=")
    if equals and f"--{key}" in options:
        return f"--{key} {value}"
    if re.fullmatch(r"[\w.\[\]]+=.+", word) and "--set" in options:
        return f"--set {word}"
    shipped = Path(engine.__file__).parent / "scenes" / f"{word}.toml"
    if "--scene" in options and (word.endswith(".toml") or shipped.exists()):
        return f"--scene {word}"
    for name, declared in options.items():
        if declared is None or declared.kind is None or not declared.many:
            continue
        try:
            declared.kind.convert(word)
        except ValueError:
            continue
        return f"{name} {word}"
    return ""


def _parted(word: str, kind: Kind) -> str:
    """A hint for values that a comma holds together: "0.016,0.13", and "0,13" of a decimal comma."""
    parts = word.split(",")
    try:
        values = [kind.convert(part) for part in parts]
    except ValueError:
        return ""
    if len(values) < 2:
        return ""
    if len(parts) == 2 and all(map(str.isdigit, parts)):
        return f"; with a dot: {'.'.join(parts)}"
    return f"; separated by spaces: {' '.join(parts)}"


def evenly(
    words: list[str], option: str, faults: list[str], least: float = -math.inf, count: int | None = None
) -> list[float]:
    """The values of LO HI COUNT, both ends included; none where the words are at fault.

    least: LO is not below. count: of a program; the words are then LO HI.
    """
    floor = "" if least == -math.inf else f"{least:g} <= "
    form, allowed = "LO HI", f"two finite numbers, {floor}LO < HI"
    if count is None:
        form, allowed = f"{form} COUNT", f"{allowed}, and {whole(2, MOST_RUNS).allowed}"
    try:
        low, high = float(words[0]), float(words[1])
        if len(words) != len(form.split()) or not least <= low < high < math.inf or low == -math.inf:
            raise ValueError(words)
        if count is None:
            count = whole(2, MOST_RUNS).convert(words[2])
    except (ValueError, IndexError):
        faults.append(f"{option}: given {' '.join(words) or 'nothing'}; allowed: {form}: {allowed}")
        return []
    # Twelve digits: 0.13 of a range is the 0.13 that a list of values reads, and so the same run.
    return [float(f"{low + (high - low) * step / (count - 1):.12g}") for step in range(count)]


def assignments(words: list[str] | None, taken: Mapping[str, str], faults: list[str]) -> dict[str, object]:
    """The scene overrides of `--set KEY=VALUE ...`.

    taken: keys that the campaign itself sets -> what to use instead.
    """
    changes = {}
    for word in words or []:
        try:
            key, given = engine.scene.parse_assignment(word)
        except engine.SceneError as error:
            faults.extend(error.faults)
            continue
        if key in taken:
            faults.append(f"--set {key}: this campaign sets it; {taken[key]}")
        else:
            changes[key] = given
    if words == []:
        faults.append("--set: given nothing; allowed: KEY=VALUE, one or more")
    return changes


def fault_of(out: Path, campaign: str) -> str | None:
    """Why results of this campaign must not go to a folder, as a fault line; None where they may."""
    given = f"--out: given {str(out)!r}"
    try:
        above = out.absolute().parents
    except FileNotFoundError:
        return "the folder that this is run in has been removed; allowed: one that is there (cd)"
    # os.path: what may not be looked at is not there, where pathlib raises.
    parent = next((path for path in (out, *above) if os.path.exists(path)), out)
    if not os.path.isdir(parent):
        return f"{given}, but {parent} is a file; {A_FOLDER}"
    if not can_be_written(parent):
        return f"{given}, but {parent} cannot be written to; allowed: a folder that can"
    held = _held(out)
    if held in ("", campaign):
        return None
    return f"{given}, which holds {held}; {A_FOLDER}"


def _held(out: Path) -> str:
    """The campaign whose folder it is, or what else is there that would be written over; "" where nothing is."""
    try:
        return str(json.loads((out / "provenance.json").read_text(encoding="utf-8"))["campaign"])
    except FileNotFoundError:
        names = ["table.csv"]
        # A campaign that ended before it could write its provenance has left its lock.
        if not (out / ".lock").exists():
            names += ["scene.toml", "report.html", "report.pdf", "trajectories"]
        for name in names:
            if (out / name).exists():
                return f"a {name} that no campaign wrote"
        return ""
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return "a provenance.json that no campaign wrote"
