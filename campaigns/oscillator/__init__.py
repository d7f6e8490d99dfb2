"""Eq. (33), the snap oscillator: section, exponents, orbit diagrams, basins, periodic orbits, grazing, and a report.

    python -m campaigns.oscillator                            the paper's figure 19(b), in about a minute
    python -m campaigns.oscillator --effort 0.02              the same with a fiftieth of the work
    python -m campaigns.oscillator --set force=1.2 phase=0.5  other parameters of the equation

Protocol: the motion is integrated exactly (closed form within each piece), so there is no step and no tolerance to
choose. Every part is one row of table.csv, and its arrays are one file; parts found there are not done again. Random
starts come from a fixed seed.
"""

from dataclasses import dataclass
from functools import partial

from campaigns.machinery import cli
from campaigns.machinery.command import command

CAMPAIGN = "oscillator"
MODULE = "campaigns.oscillator"
PARAMETERS = ("damping", "frequency", "force", "lift", "phase")
FORCES, FREQUENCIES = (0.1, 2.0, 800), (0.5, 2.0, 800)


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked."""

    changes: dict
    forces: tuple[float, float, int]
    frequencies: tuple[float, float, int]
    effort: float
    how: cli.Running


def main(argv: list[str] | None = None) -> int:
    """The command. Returns the exit code (0, 1, 2 or 130)."""
    return command(MODULE, argv, read_order, conduct)


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is studied")
    cli.add(what, "--set", "KEY=VALUE ...", "change damping, frequency, force, lift or phase (default: the paper's)")
    usual = "(default: {} {} {})".format
    cli.add(what, "--force-range", "LO HI COUNT", f"orbit diagram over F {usual(*FORCES)}")
    cli.add(what, "--frequency-range", "LO HI COUNT", f"orbit diagram over omega {usual(*FREQUENCIES)}")
    cli.add(what, "--effort", "SHARE", "share of the usual starts, points and values, 0.001 to 100 (default: 1)")
    where = parser.add_argument_group("where")
    found = "folder of the results; parts found there are not done again"
    cli.add(where, "--out", "DIR", f"{found} (default: results/{CAMPAIGN})")
    where.add_argument("--no-report", action="store_true", help="leave out report.html and report.pdf")
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    changes = _changes(options.set, faults)
    forces = _range(options.force_range, "--force-range", FORCES, faults)
    frequencies = _range(options.frequency_range, "--frequency-range", FREQUENCIES, faults)

    def share(text: str) -> float:
        number = float(text)
        if not 0.001 <= number <= 100.0:
            raise ValueError(text)
        return number

    effort = cli.value(options.effort, "--effort", 1.0, share, "a number from 0.001 to 100", faults)
    how = cli.Running(cli.folder(options, CAMPAIGN, faults), 1, "threading", None, not options.no_report)
    return Order(changes, forces, frequencies, effort, how)


def _changes(words: list[str] | None, faults: list[str]) -> dict[str, float]:
    changes = {}
    allowed = f"KEY=VALUE with a key of {', '.join(PARAMETERS)} and a number"
    if words is not None and not words:
        faults.append(f"--set: given nothing; allowed: {allowed}")
    for word in words or []:
        key, _, text = word.partition("=")
        try:
            if key not in PARAMETERS:
                raise ValueError(key)
            changes[key] = float(text)
        except ValueError:
            faults.append(f"--set: given {word!r}; allowed: {allowed}")
    if changes:
        from analysis.oscillator import SnapOscillator

        for key, number in changes.items():
            try:
                SnapOscillator(**{key: number})
            except ValueError as error:
                faults.append(f"--set: {error}")
    return changes


def _range(words: list[str] | None, option: str, usual: tuple, faults: list[str]) -> tuple[float, float, int]:
    values = [] if words is None else cli.evenly(words, option, faults, least=1e-9)
    return (values[0], values[-1], len(values)) if values else usual


def conduct(order: Order, argv: list[str]) -> int:
    """Run it: parts, table, provenance, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.machinery import session
    from campaigns.oscillator.study import done, parameters

    return session.conduct(CAMPAIGN, MODULE, argv, order.how, parameters(order), partial(done, order))
