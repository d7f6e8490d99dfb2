"""`python -m analysis FILE.csv --column NAME`: is it periodic, quasi-periodic or chaotic, and how sure is that?

Any evenly sampled column will do. With --period, that of the forcing, the motion is judged once per period; a file
whose rows are a section already takes --period equal to --step. Without it the motion is judged at its maxima, or,
where less than six samples lie in a mean period, sample by sample. Noise is not called chaos: that word needs a
positive exponent and what noise does not have (docs/howto_time_series.md).
"""

import argparse
import difflib
import math
import os
import sys
from pathlib import Path

OK, FAILED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130
PROG = "python -m analysis"
# What `files` and `python -m reports` write, told here because importing either takes a second.
WRITTEN = (
    *("answer.txt", "answer.json", "series.csv", "spectrum.csv", "section.csv", "divergence.csv", "dimension.csv"),
    *("report.html", "report.pdf"),
)
SECONDS = "a finite number above 0 [s; samples where neither --time nor --step is given]"


class _Unparsable(Exception):
    """argparse could not split the line; its message is the fault."""


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise _Unparsable(message)


def parser():
    """The options; their words are taken as they come and judged together."""
    epilog = "exit codes: 0 done, 1 the folder could not be written, 2 bad input, 130 Ctrl-C"
    made = _Parser(
        prog=PROG,
        description=__doc__,
        epilog=epilog,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    made.add_argument("file", metavar="FILE.csv", nargs="?", help="columns of numbers, their names in the first line")
    made.add_argument("--column", metavar="NAME", help="the column to judge; may be left out where there is only one")
    made.add_argument("--time", metavar="COLUMN", help="the column of times in seconds, evenly spaced")
    made.add_argument("--step", metavar="SECONDS", help="sampling step, in place of a column of times")
    made.add_argument("--period", metavar="SECONDS", help="period of the forcing (default: none is known)")
    repeats = "a motion repeats within this share of its range (default 0.001; with noise, eight times its share)"
    made.add_argument("--tolerance", metavar="SHARE", help=repeats)
    made.add_argument("--out", metavar="DIR", help="folder for the answer and every curve behind it (default: none)")
    return made


def main(argv=None):
    """The command: prints the answer, writes --out, returns the exit code."""
    try:
        return _answer(sys.argv[1:] if argv is None else argv)
    except KeyboardInterrupt:
        print("\ninterrupted; the folder holds what was written whole", file=sys.stderr)
        return INTERRUPTED


def _answer(argv):
    faults = []
    options = _split(argv, faults)
    step = _positive(options.step, "--step", "a finite number above 0 [s]", faults)
    period = _positive(options.period, "--period", SECONDS, faults)
    tolerance = _positive(options.tolerance, "--tolerance", "a number above 0 and below 1", faults, below=1.0)
    out = _folder(options.out, options.file, faults)
    if options.step is not None and options.time is not None:
        faults.append("--time and --step: given both; allowed: one of them")
    record = None
    if options.file is None:
        faults.append("FILE.csv: missing; allowed: the name of a file of columns")
    else:
        from analysis.any_series.columns import read_record

        record = read_record(options.file, options.column, options.time, step, faults)
    if record is not None and period is not None:
        _fits(period, record, faults)
    if faults:
        return _refused(faults)
    from analysis.any_series.files import write_files
    from analysis.any_series.study import study
    from analysis.any_series.words import page

    try:
        found = study(record, period, tolerance)
        print(page(found))
        if out is not None:
            write_files(found, out, {"period": period, "step": record.step, "tolerance": found.tolerance})
            print(f"\n{out}: the answer, and its curves as CSV; with figures: python -m reports {out}")
    except BrokenPipeError:
        # The reader (head, less) has what it wanted.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except OSError as error:
        why = "the disk is full" if error.errno == 28 else error.strerror
        print(f"{PROG}: {out} could not be written: {why}; the answer above stands", file=sys.stderr)
        return FAILED
    return OK


def _split(argv, faults):
    made = parser()
    try:
        options, unknown = made.parse_known_args(argv)
    except _Unparsable as error:
        faults.append(f"{error}; see {PROG} --help")
        return made.parse_args([])
    known = [name for action in made._actions for name in action.option_strings]
    for word in unknown:
        if word.startswith("-"):
            close = difflib.get_close_matches(word.partition("=")[0], known, n=1)
            faults.append(f"{word}: no such option" + (f"; did you mean {close[0]}?" if close else ""))
        elif not unknown[0].startswith("-"):
            faults.append(f"{word}: given beside {options.file}; allowed: one file")
    return options


def _positive(text, option, allowed, faults, below=math.inf):
    if text is None:
        return None
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not (math.isfinite(number) and 0.0 < number < below):
        faults.append(f"{option}: given {text!r}; allowed: {allowed}")
        return None
    return number


def _folder(text, given, faults):
    """--out as a path; a fault where it cannot be a folder of this command. given: the file that is read."""
    if text is None:
        return None
    if not text.strip():
        faults.append(f"--out: given {text!r}; allowed: the name of a folder")
        return None
    out = Path(text)
    parent = next((path for path in (out, *out.absolute().parents) if path.exists()), out)
    if not parent.is_dir():
        faults.append(f"--out: given {text!r}, but {parent} is a file; allowed: a folder")
    elif not os.access(parent, os.W_OK):
        faults.append(f"--out: given {text!r}, but {parent} cannot be written to; allowed: a folder that can")
    elif held := _held(out):
        faults.append(f"--out: given {text!r}, which holds {held}; allowed: another folder")
    elif given is not None and Path(given).resolve() in [(out / name).resolve() for name in WRITTEN]:
        faults.append(f"--out: given {text!r}, where {given} would be written over; allowed: another folder")
    return out


def _held(out):
    """What is in a folder that this command must not write over; "" where there is nothing of the kind."""
    import json

    try:
        campaign = json.loads((out / "provenance.json").read_text(encoding="utf-8"))["campaign"]
    except FileNotFoundError:
        foreign = next((name for name in WRITTEN if (out / name).exists()), None)
        return "" if foreign is None else f"a {foreign} that is not known to be of this command"
    except (OSError, ValueError, KeyError, TypeError):
        return "a provenance.json of something else"
    return "" if campaign == "time_series" else "a campaign"


def _fits(period, record, faults):
    length = (len(record.values) - 1) * record.step
    unit = "s" if record.unit == "s" else "samples"
    strobed = abs(period - record.step) <= 1e-6 * record.step
    if not strobed and period < 2.0 * record.step:
        allowed = f"the step itself (the file is a section), or {2 * record.step:.6g} {unit} and more"
        faults.append(f"--period: given {period:.6g} {unit}, samples are {record.step:.6g} apart; allowed: {allowed}")
    elif not strobed and period > length / 4.0:
        faults.append(
            f"--period: given {period:.6g} {unit} of a record of {length:.6g} {unit}; allowed: a quarter of it at most "
            "(a verdict needs 40 periods, chaos 200)"
        )


def _refused(faults):
    lines = list(dict.fromkeys(faults))
    if len(lines) == 1:
        text = f"{PROG}: {lines[0]}"
    else:
        text = "\n".join([f"{PROG}: {len(lines)} faults", *(f"  {line}" for line in lines)])
    print(f"{text}\nnothing was computed or written", file=sys.stderr)
    return BAD_INPUT
