"""A column of any file: is it periodic, quasi-periodic or chaotic, and how sure is that?

    python -m analysis FILE.csv --column NAME [--time COLUMN | --step SECONDS] [--period SECONDS] [--out DIR]
    python -m analysis FILE.csv --column TENSION --time COLUMN --snaps [--static N] [--ringing SECONDS]

Any evenly sampled column will do. With --period, that of the forcing, the motion is judged once per period; a file
whose rows are a section already takes --period equal to --step. Without it the motion is judged at its maxima, or,
where less than six samples lie in a mean period, sample by sample. Noise is not called chaos: that word needs a
positive exponent and what noise does not have (docs/time_series.md).

With --snaps the column is the tension of a line: its snaps are counted, and listed with their peaks.
"""

import argparse
import os
import sys
from collections import namedtuple
from pathlib import Path

from campaigns.machinery import cli, stage
from campaigns.machinery.cli import FOLDER, FRACTION, POSITIVE, Kind, fault_of, number
from campaigns.machinery.session import command

CAMPAIGN, MODULE = "time_series", "analysis"
# What `answer` and the report write, the first one first, told here because importing either takes a second.
WRITTEN = (
    *("answer.txt", "answer.json", "series.csv", "spectrum.csv", "section.csv", "divergence.csv", "dimension.csv"),
    *("columns.csv", "report.html", "report.pdf"),
)
OF_SNAPS_ALONE = ("snaps.csv", "snaps_columns.csv")  # what --snaps writes beside answer.txt
EXITS = "exit codes: 0 done, 1 the folder could not be written, 2 bad input, 130 Ctrl-C"
OPTIONS = {  # option: its word and its use in the help
    "--column": ("NAME", "the column to judge; may be left out where there is only one beside the times"),
    "--time": (
        "COLUMN",
        "the column of times in seconds, evenly spaced (default: time_s, where it is there and --step is not given)",
    ),
    "--step": ("SECONDS", "sampling step, in place of a column of times"),
    "--period": ("SECONDS", "period of the forcing (default: none is known)"),
    "--tolerance": (
        "SHARE",
        "a motion repeats within this share of its range in the later half (default: 0.001, and then eight times the "
        "noise)",
    ),
}
OF_SNAPS = {  # option: argument of `analysis.detect_snaps`, its kind; its word and its use in the help
    "--static": (
        "static_N", POSITIVE, "N",
        "static tension, in the unit of the column, by which slack and snaps are told (default: the mean)",
    ),
    "--ringing": (
        "ringing_s", FRACTION, "SECONDS",
        "longest period of axial ringing, 2 l/c; it does not count as snaps (default: 0, none)",
    ),
    "--slack": (
        "slack_share", FRACTION, "SHARE",
        "the line is slack at this share of the static tension or less (default: 0.05)",
    ),
    "--least": (
        "snap_share", POSITIVE, "SHARE",
        "a snap reaches this share of the static tension, more than --slack (default: 1)",
    ),
}  # fmt: skip
SECONDS = "a finite number above 0 [s; samples where neither --time nor --step is given]"


# What the command line asks for, checked. record: a Record; period [unit of time of the record], tolerance: None: not
# given; how: a Running, whose `out` is the folder, or None; snaps: options of `detect_snaps`; None: not asked for
Order = namedtuple("Order", "record period tolerance how snaps")


def main(argv: list[str] | None = None) -> int:
    """The command: prints the answer, writes --out. Returns the exit code (0, 1, 2 or 130)."""
    return command(MODULE, argv, read_order, judge)


def parser() -> argparse.ArgumentParser:
    """The options; their words are taken as they come and judged together."""
    argument_parser = cli.parser(MODULE, __doc__, EXITS)
    argument_parser.add_argument(
        "file", metavar="FILE.csv", nargs="*", help="columns of numbers, their names in the first line"
    )
    for name, (metavar, use) in OPTIONS.items():
        argument_parser.add_argument(name, metavar=metavar, help=use)
    argument_parser.add_argument(
        "--snaps", action="store_true", help="count the snaps of a tension (N), and judge nothing"
    )
    for name, (_, _, metavar, use) in OF_SNAPS.items():
        argument_parser.add_argument(name, metavar=metavar, help=use)
    argument_parser.add_argument(
        "--out", metavar="DIR", help="folder for the answer and every curve behind it (default: none)"
    )
    return argument_parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line, its record read; every fault is appended to `faults`."""
    options = cli.split(parser(), argv, faults)

    def value(option, kind):
        words = getattr(options, option[2:])
        if isinstance(words, str):  # argparse makes an empty list of --step=--
            words = [words]
        return cli.Option("", "", kind).value(option, words, faults)

    step = value("--step", Kind(POSITIVE.convert, "a finite number above 0 [s]"))
    period = value("--period", Kind(POSITIVE.convert, SECONDS))
    tolerance = value("--tolerance", number("a number above 0 and below 1", lambda share: 0.0 < share < 1.0))
    out = value("--out", FOLDER)
    snaps = {name: value(option, kind) for option, (name, kind, *_) in OF_SNAPS.items()}
    unfit, where = OF_SNAPS, "with"
    if options.snaps:
        unfit, where = ("--period", "--tolerance"), "without"
    given = [option for option in unfit if getattr(options, option[2:]) is not None]
    faults.extend(f"{option}: allowed {where} --snaps only" for option in given)
    if options.step is not None and options.time is not None:
        faults.append("--time and --step: given both; allowed: one of them")
    file, *further_files = options.file or [None]
    faults.extend(f"{word}: given beside {file}; allowed: one file" for word in further_files)
    if out is not None:
        fault = fault_of(out, CAMPAIGN) or _written_over(out, file)
        if fault:
            faults.append(fault)
    record = None
    if file is None:
        faults.append("FILE.csv: missing; allowed: the name of a file of columns")
    else:
        from campaigns.time_series.record import read_record

        record = read_record(file, options.column, options.time, step, faults)
    if options.snaps and record is not None and record.unit != "s":
        faults.append("--snaps: given without times; allowed: with --time or --step")
    if record is not None and period is not None:
        fault = _no_fit(period, record)
        if fault:
            faults.append(fault)
    if options.snaps:
        from analysis.snaps import NEAR_ZERO

        slack_share, snap_share = snaps["slack_share"], snaps["snap_share"]
        if (NEAR_ZERO if slack_share is None else slack_share) >= (snap_share or 1.0):
            faults.append("--slack: not below --least; allowed: a smaller share")
    if record is not None and options.snaps and snaps["static_N"] is None and record.values.mean() <= 0.0:
        faults.append(f"--static: not given, and the mean is {record.values.mean():.4g}; allowed: a number above 0")
    snaps = {name: number for name, number in snaps.items() if number is not None} if options.snaps else None
    return Order(record, period, tolerance, cli.Running(out, 1, "threading", None, False), snaps)


def _written_over(out: Path, file: str | None) -> str:
    """What in a folder would be lost to this command, as a fault line; "" where nothing would."""
    # A folder with answer.txt alone is that of a command which a full disk stopped: provenance.json comes last.
    mine = (out / "provenance.json").exists() or (out / WRITTEN[0]).exists()
    lost = ""
    for name in (*WRITTEN, *OF_SNAPS_ALONE):
        path = out / name
        if not mine and path.exists():
            lost = f"which holds a {name} that is not known to be of this command"
            break
        if file is not None and Path(file).resolve() == path.resolve():
            lost = f"where {file} would be written over"
    if lost:
        return f"--out: given {str(out)!r}, {lost}; allowed: another folder"
    return ""


def _no_fit(period: float, record) -> str:
    """Why a record cannot be seen once per period, as a fault line; "" where it can."""
    length = (len(record.values) - 1) * record.step
    fault = f"--period: given {period:.6g} {record.unit}"
    if abs(period - record.step) <= 1e-6 * record.step:
        return ""
    if period < 2.0 * record.step:
        allowed = f"the step itself (the file is a section), or {2 * record.step:.6g} {record.unit} and more"
        return f"{fault}, samples are {record.step:.6g} apart; allowed: {allowed}"
    if period > length / 4.0:
        allowed = "a quarter of it at most (a verdict needs 40 periods, chaos 200)"
        return f"{fault} of a record of {length:.6g} {record.unit}; allowed: {allowed}"
    return ""


def judge(order: Order, argv: list[str]) -> int:
    """Study the record, or count its snaps, print the page, write the folder. Returns the exit code."""
    if order.snaps is not None:
        return _count_snaps(order)
    from campaigns.time_series.answer import page, write_files
    from campaigns.time_series.study import study

    record, out = order.record, order.how.out
    try:
        with stage("judging the record"):
            result = study(record, order.period, order.tolerance)
        print(page(result))
        if out is not None:
            settings = {"period": order.period, "step": record.step, "tolerance": result.tolerance}
            write_files(result, out, {"campaign": CAMPAIGN, **settings})
            print(f"\n{out}: the answer, and its curves as CSV; with figures: python -m reports {out}")
    except KeyboardInterrupt:
        print("\ninterrupted; the folder holds what was written whole", file=sys.stderr)
        return cli.EXIT_INTERRUPTED
    except BrokenPipeError:
        # The reader (head, less) has what it wanted.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return cli.EXIT_OK


def _count_snaps(order: Order) -> int:
    """Count the snaps of the record, print them, write them. Returns the exit code."""
    from campaigns.time_series.snaps import snap_page, snaps_in, write_snaps

    found = snaps_in(order.record, order.snaps)
    text = snap_page(order.record, found)
    print(text)
    if order.how.out is not None:
        write_snaps(order.how.out, text, found)
        print(f"\n{order.how.out}: the same, and every snap in snaps.csv")
    return cli.EXIT_OK
