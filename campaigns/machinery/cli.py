"""Command-line pieces shared by the campaigns: options that collect their faults instead of stopping at the first.

argparse stops at the first bad value. Here every option takes its words unjudged, the functions below turn them into
values, and whatever is wrong is appended to one list of faults, to be shown together with the faults of the scene.
Nothing heavy is imported: `--help` has to appear at once.
"""

import argparse
import difflib
import math
import os
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from campaigns.machinery.out_folder import fault_of, folder_name

BACKENDS = ("loky", "threading", "dask")
EXIT_OK, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130

EXITS = "exit codes: 0 done, 1 stopped (disk full, folder in use, no report), 2 bad input, 130 Ctrl-C"

WHOLE = "a whole number, {} or above"
MOST_JOBS, MOST_PERIODS, MOST_RUNS = 1024, 10**9, 10_000
FRACTION = "a finite number, 0 or above"


@dataclass(frozen=True)
class Running:
    """How and where a campaign runs; dask_address None: no scheduler, or a local one."""

    out: Path
    jobs: int
    backend: str
    dask_address: str | None
    report: bool


@dataclass(frozen=True)
class Lengths:
    """The usual length of a run and of its transient, in wave periods.

    share: the transient is at most periods/share where none is given; left_out_of: of what it is left out, in words.
    """

    periods: int
    transient: int
    share: int = 3
    left_out_of: str = "analysis"


class _Unparsable(Exception):
    """argparse could not even split the line into options; its message is the fault."""


class _Formatter(argparse.RawDescriptionHelpFormatter):
    # Every option accepts any number of words (see `value`); the help shows the words it wants, as the metavar says.
    def _format_args(self, action, default_metavar):
        return action.metavar or ""


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise _Unparsable(message)


def parser(module: str, description: str, epilog: str = EXITS) -> argparse.ArgumentParser:
    """An empty parser for `python -m module`; add options with `add`, read the line with `split`."""
    return _Parser(
        prog=f"python -m {module}",
        description=description,
        epilog=epilog,
        formatter_class=_Formatter,
        allow_abbrev=False,
    )


def add(group, option: str, metavar: str, help: str) -> None:
    """Add an option that takes words; given twice, the words add up (so `--set A --set B` is `--set A B`)."""
    group.add_argument(option, metavar=metavar, nargs="*", action="extend", help=help)


def add_running(group, default_out: str) -> None:
    """Add the options that say how and where a campaign runs, the same for all campaigns."""
    add(group, "--jobs", "N", f"runs at the same time, but on a cluster of your own (default: {default_jobs()})")
    add(group, "--backend", "|".join(BACKENDS), "processes, threads or a dask cluster (default: loky, processes)")
    add(group, "--dask-address", "ADDRESS", "scheduler of a dask cluster, tcp://HOST:PORT (default: a local one)")
    add(group, "--out", "DIR", f"folder of the results; runs found there are not done again (default: {default_out})")
    group.add_argument("--no-report", action="store_true", help="leave out report.html and report.pdf")


def add_lengths(group, usual: Lengths) -> None:
    """Add --periods and --transient; usual: their defaults."""
    add(group, "--periods", "N", f"length of every run in wave periods (default: {usual.periods})")
    most = f"at most 1/{usual.share} of --periods"
    words = f"wave periods left out of the {usual.left_out_of} (default: {usual.transient}, {most})"
    add(group, "--transient", "N", words)


def add_scene(group, usual: str) -> None:
    """Add --scene, by default the usual one, and --set."""
    add(group, "--scene", "FILE_OR_NAME", f"scene to start from (default: {usual})")
    add(group, "--set", "KEY=VALUE ...", "change values of the scene, as water.depth_m=22.5 tether.nodes=81")


def add_accuracy(group) -> None:
    """Add --no-accuracy (`campaigns.buoy_sweep.repeats`)."""
    again = "do not repeat two runs at a tenth of the tolerance and at twice the elements"
    group.add_argument("--no-accuracy", action="store_true", help=again)


def default_jobs() -> int:
    """Two, or one where there is only one core."""
    return min(2, os.cpu_count() or 1)


def split(parser: argparse.ArgumentParser, argv: list[str], faults: list[str]) -> argparse.Namespace:
    """The words given to each option (None: option not given); unknown words become faults."""
    try:
        options, unknown = parser.parse_known_args(argv)
    except _Unparsable as error:
        found = re.fullmatch(r"argument (\S+): ignored explicit argument (.*)", str(error))
        faults.append(f"{found[1]}: given {found[2]}; allowed: the option alone" if found else str(error))
        return parser.parse_args([])
    known = [name for action in parser._actions for name in action.option_strings]
    for word in unknown:
        if not word.startswith("-") and unknown[0].startswith("-"):
            continue  # the value of an unknown option, which has been named
        name = word.partition("=")[0]
        close = difflib.get_close_matches(name, known, n=1, cutoff=0.75)
        faults.append(f"{name}: no such option" + (f"; did you mean {close[0]}?" if close else ""))
    return options


def value(words: list[str] | None, option: str, default, convert: Callable, allowed: str, faults: list[str]):
    """The one value of an option, or `default` where it was not given or is at fault.

    convert: from text, raising ValueError for what is not allowed; allowed: the same in words.
    """
    if words is None:
        return default
    if len(words) != 1:
        faults.append(f"{option}: given {' '.join(words) or 'nothing'}; allowed: one value, {allowed}")
        return default
    return values(words, option, [default], convert, allowed, faults)[0]


def values(words: list[str], option: str, default: list, convert: Callable, allowed: str, faults: list[str]) -> list:
    """The values of an option that takes several; `default` where one of them is at fault."""
    found, sound = [], True
    for word in words:
        try:
            found.append(convert(word))
        except ValueError:
            sound = False
            faults.append(f"{option}: given {word!r}; allowed: {allowed}")
    return found if sound else default


def whole(least: int, most: float = math.inf) -> Callable[[str], int]:
    """A converter for whole numbers from `least` to `most`."""

    def convert(text: str) -> int:
        number = int(text)
        if not least <= number <= most:
            raise ValueError(text)
        return number

    return convert


def fraction(text: str) -> float:
    """Convert text to a finite number that is not negative."""
    number = float(text)
    if not math.isfinite(number) or number < 0.0:
        raise ValueError(text)
    return number


def one_of(words: tuple[str, ...]) -> Callable[[str], str]:
    """A converter that lets only some words through."""

    def convert(text: str) -> str:
        if text not in words:
            raise ValueError(text)
        return text

    return convert


def running(options: argparse.Namespace, campaign: str, faults: list[str]) -> Running:
    """The options that `add_running` adds."""
    jobs = jobs_of(options, faults)
    name, address = backend(options, faults)
    return Running(folder(options, campaign, faults), jobs, name, address, not options.no_report)


def jobs_of(options: argparse.Namespace, faults: list[str]) -> int:
    """--jobs: runs at the same time."""
    allowed = f"a whole number, 1 or above and at most {MOST_JOBS}"
    return value(options.jobs, "--jobs", default_jobs(), whole(1, MOST_JOBS), allowed, faults)


def lengths(options: argparse.Namespace, usual: Lengths, faults: list[str]) -> tuple[int, int]:
    """--periods and --transient in wave periods; usual: their defaults."""
    allowed = f"a whole number, 1 or above and at most {MOST_PERIODS}"
    periods = value(options.periods, "--periods", usual.periods, whole(1, MOST_PERIODS), allowed, faults)
    most = min(usual.transient, periods // usual.share)
    transient = value(options.transient, "--transient", most, whole(0), WHOLE.format(0), faults)
    if transient >= periods:
        faults.append(f"--transient: given {transient} of {periods} periods; allowed: less than --periods")
    return periods, transient


def evenly(words: list[str], option: str, faults: list[str], least: float = -math.inf) -> list[float]:
    """The values of LO HI COUNT, both ends included; none where the words are at fault. least: LO is not below."""
    try:
        low, high, count = float(words[0]), float(words[1]), whole(2, MOST_RUNS)(words[2])
        if len(words) != 3 or not least <= low < high < math.inf or low == -math.inf:
            raise ValueError(words)
    except (ValueError, IndexError):
        floor = "" if least == -math.inf else f"{least:g} <= "
        allowed = f"two finite numbers, {floor}LO < HI, and a whole number, 2 or above and at most {MOST_RUNS}"
        faults.append(f"{option}: given {' '.join(words) or 'nothing'}; allowed: LO HI COUNT: {allowed}")
        return []
    # Twelve digits: 0.13 of a range is the 0.13 that a list of values reads, and so the same run.
    return [float(f"{low + (high - low) * step / (count - 1):.12g}") for step in range(count)]


def scene_name(options: argparse.Namespace, usual: str, faults: list[str]) -> str:
    """--scene: a file or a name, not looked up yet."""
    return value(options.scene, "--scene", usual, str, "a scene file or the name of a scene", faults)


def backend(options: argparse.Namespace, faults: list[str]) -> tuple[str, str | None]:
    """The backend and the address of its scheduler (None: none, or a local cluster)."""
    name = value(options.backend, "--backend", "loky", one_of(BACKENDS), "one of " + ", ".join(BACKENDS), faults)
    allowed = "the address of a scheduler, as tcp://HOST:PORT"
    address = value(options.dask_address, "--dask-address", None, _scheduler, allowed, faults)
    if address is not None and name != "dask":
        faults.append(f"--dask-address: given with --backend {name}; allowed: with --backend dask only")
    if name == "dask":
        from importlib.util import find_spec

        if find_spec("distributed") is None:
            faults.append("--backend: given 'dask', which is not installed; allowed: loky, threading")
    return name, address


def _scheduler(text: str) -> str:
    found = re.fullmatch(r"((tcp|tls|ws|wss)://)?([^\s:/]+|\[[0-9A-Fa-f:]+\]):(\d{1,5})/?", text)
    if not found or not 0 < int(found[4]) < 65536:
        raise ValueError(text)
    return text


def folder(options: argparse.Namespace, campaign: str, faults: list[str]) -> Path:
    """The folder of the results; a fault where it cannot be one, or holds what is not of this campaign."""
    out = value(options.out, "--out", Path("results", campaign), folder_name, "a folder", faults)
    if fault := fault_of(out, campaign):
        faults.append(fault)
    return out


def assignments(words: list[str] | None, taken: dict[str, str], faults: list[str]) -> dict[str, object]:
    """The scene overrides of `--set KEY=VALUE ...`.

    taken: keys that the campaign itself sets -> what to use instead.
    """
    from engine.scene import SceneError, parse_assignment

    found = {}
    for word in words or []:
        try:
            key, given = parse_assignment(word)
        except SceneError as error:
            faults.extend(error.faults)
            continue
        if key in taken:
            faults.append(f"--set {key}: this campaign sets it; {taken[key]}")
        else:
            found[key] = given
    if words == []:
        faults.append("--set: given nothing; allowed: KEY=VALUE, one or more")
    return found


def complaint(prog: str, faults: list[str]) -> str:
    """One message with every fault, for exit code 2."""
    lines = list(dict.fromkeys(faults))
    if len(lines) == 1:
        return f"{prog}: {lines[0]}\nnothing was run or written"
    return "\n".join([f"{prog}: {len(lines)} faults", *(f"  {line}" for line in lines), "nothing was run or written"])
