"""Command-line pieces shared by the campaigns: options that collect their faults instead of stopping at the first.

argparse stops at the first bad value. Here an option says what its words may be (`Kind`), `split` turns them into
values, and whatever is wrong is appended to one list of faults, to be shown together with the faults of the scene.
Nothing heavy is imported: `--help` has to appear at once.
"""

import argparse
import difflib
import json
import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import engine.scene

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


def number(allowed: str, sound: Callable[[float], bool]) -> Kind:
    """Numbers for which `sound` holds."""
    return Kind(lambda text: _if(sound, float(text)), allowed)


def whole(least: int, most: float = math.inf) -> Kind:
    """Whole numbers from `least` to `most`."""
    above = f"{least} or above" + (f" and at most {most}" if most < math.inf else "")
    return Kind(lambda text: _if(lambda found: least <= found <= most, int(text)), f"a whole number, {above}")


def one_of(words: tuple[str, ...]) -> Kind:
    """Some words only."""
    return Kind(lambda text: _if(lambda found: found in words, text), "one of " + ", ".join(words))


def _if(sound: Callable, found):
    if not sound(found):
        raise ValueError(found)
    return found


def _scheduler(text: str) -> str:
    found = re.fullmatch(r"((tcp|tls|ws|wss)://)?([^\s:/]+|\[[0-9A-Fa-f:]+\]):(\d{1,5})/?", text)
    if not found or not 0 < int(found[4]) < 65536:
        raise ValueError(text)
    return text


fraction = number("a finite number, 0 or above", lambda found: 0.0 <= found < math.inf)
scheduler = Kind(_scheduler, "the address of a scheduler, as tcp://HOST:PORT")
# an empty name, as of a shell variable that is not set, would be the current folder
folder_name = Kind(lambda text: Path(_if(str.strip, text)), "a folder")


@dataclass(frozen=True)
class Running:
    """How and where a campaign runs; dask_address None: no scheduler, or a local one."""

    out: Path
    jobs: int = 1
    backend: str = "loky"
    dask_address: str | None = None
    report: bool = True


@dataclass(frozen=True)
class Lengths:
    """The usual length of a run and of its transient, in wave periods.

    share: the transient is at most periods/share where none is given. budget: of a study whose runs take as long as
    their regime needs where no length is given: the most that they may take; 0: `periods` is the length then.
    """

    periods: int
    transient: int
    share: int = 3
    budget: int = 0


class _Formatter(argparse.RawDescriptionHelpFormatter):
    # Every option accepts any number of words (see `value`); the help shows the words it wants, as the metavar says.
    def _format_args(self, action, default_metavar):
        return action.metavar or ""


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        # argparse could not even split the line into options: its message is the fault
        raise ValueError(message)


def parser(module: str, description: str, epilog: str = EXITS) -> argparse.ArgumentParser:
    """An empty parser for `python -m module`; add options with `add`, read the line with `split`."""
    words = {"description": description, "epilog": epilog, "formatter_class": _Formatter}
    return _Parser(prog=f"python -m {module}", allow_abbrev=False, **words)


def add(group, option: str, metavar: str, help: str, kind: Kind | None = None, usual=None, many: bool = False) -> None:
    """Add an option that takes words; given twice, the words add up (so `--set A --set B` is `--set A B`).

    kind: of its one value, or of each of its `many`; None: its words stay as they are. usual: where it is not given.
    """
    told = help if usual is None or many else f"{help} (default: {usual})"
    action = group.add_argument(option, metavar=metavar, nargs="*", action="extend", help=told)
    action.read = None if kind is None else lambda words, faults: value(words, option, usual, kind, faults, many)


def add_running(group, campaign: str, jobs: bool = True, backends: bool = True) -> None:
    """Add the options that say how and where a campaign runs. jobs, backends: whether there is a choice of these."""
    if jobs:
        at_once = "runs at the same time, but on a cluster of your own"
        add(group, "--jobs", "N", at_once, whole(1, MOST_JOBS), min(2, os.cpu_count() or 1))
    if backends:
        where = "processes (loky), threads or a dask cluster"
        add(group, "--backend", "|".join(BACKENDS), where, one_of(BACKENDS), BACKENDS[0])
        address = "scheduler of a dask cluster, tcp://HOST:PORT (default: a local one)"
        add(group, "--dask-address", "ADDRESS", address, scheduler)
    found = "folder of the results; what is found there is not done again"
    add(group, "--out", "DIR", found, folder_name, Path("results", campaign))
    group.add_argument("--no-report", action="store_true", help="leave out report.html and report.pdf")


def add_evidence(group) -> None:
    """Add --evidence."""
    more = "dynamics, or full: Wolf's exponent and the tests for records of unknown origin as well, seconds a run"
    add(group, "--evidence", "dynamics|full", more, one_of(("dynamics", "full")), "dynamics")


def split(parser: argparse.ArgumentParser, argv: list[str], faults: list[str]) -> argparse.Namespace:
    """The values of the options, or their words where an option has no kind; what is not allowed becomes faults."""
    try:
        options, unknown = parser.parse_known_args(argv)
    except ValueError as error:
        found = re.fullmatch(r"argument (\S+): ignored explicit argument (.*)", str(error))
        faults.append(f"{found[1]}: given {found[2]}; allowed: the option alone" if found else str(error))
        options, unknown = parser.parse_args([]), []
    known = [name for action in parser._actions for name in action.option_strings]
    for word in unknown:
        if not word.startswith("-") and unknown[0].startswith("-"):
            continue  # the value of an unknown option, which has been named
        name = word.partition("=")[0]
        close = difflib.get_close_matches(name, known, n=1, cutoff=0.75)
        faults.append(f"{name}: no such option" + (f"; did you mean {close[0]}?" if close else ""))
    for action in parser._actions:
        if read := getattr(action, "read", None):
            setattr(options, action.dest, read(getattr(options, action.dest), faults))
    return options


def value(words: list[str] | None, option: str, usual, kind: Kind, faults: list[str], many: bool = False):
    """The value of an option, a list of `many`, each once; `usual` where it was not given (None) or is at fault."""
    if words is None:
        return usual
    if not words or (len(words) > 1 and not many):
        count = "one value or more, each" if many else "one value,"
        faults.append(f"{option}: given {' '.join(words) or 'nothing'}; allowed: {count} {kind.allowed}")
        return usual
    found = []
    for word in words:
        try:
            found.append(kind.convert(word))
        except ValueError:
            faults.append(f"{option}: given {word!r}; allowed: {kind.allowed}{_parted(word, kind)}")
    if len(found) < len(words):
        return usual
    return list(dict.fromkeys(found)) if many else found[0]


def _parted(word: str, kind: Kind) -> str:
    """A hint for values that a comma holds together: "0.016,0.13", and "0,13" of a decimal comma."""
    parts = word.split(",")
    try:
        values = [kind.convert(part) for part in parts]
    except ValueError:
        return ""
    if len(values) < 2:
        return ""
    decimal = len(parts) == 2 and all(map(str.isdigit, parts))
    return f"; with a dot: {'.'.join(parts)}" if decimal else f"; separated by spaces: {' '.join(parts)}"


def running(options: argparse.Namespace, campaign: str, faults: list[str]) -> Running:
    """What the options of `add_running` say."""
    given = {name: entry for name, entry in vars(options).items() if name in Running.__dataclass_fields__}
    how = Running(**given, report=not options.no_report)
    if how.dask_address is not None and how.backend != "dask":
        faults.append(f"--dask-address: given with --backend {how.backend}; allowed: with --backend dask only")
    if how.backend == "dask":
        from importlib.util import find_spec

        if find_spec("distributed") is None:
            faults.append("--backend: given 'dask', which is not installed; allowed: loky, threading")
    if fault := fault_of(how.out, campaign):
        faults.append(fault)
    return how


def evenly(words: list[str], option: str, faults: list[str], least: float = -math.inf) -> list[float]:
    """The values of LO HI COUNT, both ends included; none where the words are at fault. least: LO is not below."""
    try:
        low, high, count = float(words[0]), float(words[1]), whole(2, MOST_RUNS).convert(words[2])
        if len(words) != 3 or not least <= low < high < math.inf or low == -math.inf:
            raise ValueError(words)
    except (ValueError, IndexError):
        floor = "" if least == -math.inf else f"{least:g} <= "
        allowed = f"two finite numbers, {floor}LO < HI, and {whole(2, MOST_RUNS).allowed}"
        faults.append(f"{option}: given {' '.join(words) or 'nothing'}; allowed: LO HI COUNT: {allowed}")
        return []
    # Twelve digits: 0.13 of a range is the 0.13 that a list of values reads, and so the same run.
    return [float(f"{low + (high - low) * step / (count - 1):.12g}") for step in range(count)]


def assignments(words: list[str] | None, taken: Mapping[str, str], faults: list[str]) -> dict[str, object]:
    """The scene overrides of `--set KEY=VALUE ...`.

    taken: keys that the campaign itself sets -> what to use instead.
    """
    found = {}
    for word in words or []:
        try:
            key, given = engine.scene.parse_assignment(word)
        except engine.SceneError as error:
            faults.extend(error.faults)
            continue
        if key in taken:
            faults.append(f"--set {key}: this campaign sets it; {taken[key]}")
        else:
            found[key] = given
    if words == []:
        faults.append("--set: given nothing; allowed: KEY=VALUE, one or more")
    return found


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
    if not os.access(parent, os.W_OK):
        return f"{given}, but {parent} cannot be written to; allowed: a folder that can"
    held = _held(out)
    return f"{given}, which holds {held}; {A_FOLDER}" if held not in ("", campaign) else None


def _held(out: Path) -> str:
    """The campaign whose folder it is, or what else is there that would be written over; "" where nothing is."""
    try:
        return str(json.loads((out / "provenance.json").read_text(encoding="utf-8"))["campaign"])
    except FileNotFoundError:
        # A campaign that ended before it could write its provenance has left its lock.
        mine = ("scene.toml", "report.html", "report.pdf", "trajectories") if not (out / ".lock").exists() else ()
        foreign = next((name for name in ("table.csv", *mine) if (out / name).exists()), None)
        return "" if foreign is None else f"a {foreign} that no campaign wrote"
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return "a provenance.json that no campaign wrote"
