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
from campaigns.machinery.session import command

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
    return command(MODULE, argv, read_order, study)


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is studied")
    cli.add(what, "--set", "KEY=VALUE ...", "change damping, frequency, force, lift or phase (default: the paper's)")
    usual = "(default: {} {} {})".format
    cli.add(what, "--force-range", "LO HI COUNT", f"orbit diagram over F {usual(*FORCES)}")
    cli.add(what, "--frequency-range", "LO HI COUNT", f"orbit diagram over omega {usual(*FREQUENCIES)}")
    share = cli.number("a number from 0.001 to 100", lambda found: 0.001 <= found <= 100.0)
    cli.add(what, "--effort", "SHARE", "share of the usual starts, points and values (default: 1)", share, 1.0)
    cli.add_running(parser.add_argument_group("where"), CAMPAIGN, jobs=False, backends=False)
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    changes = _changes(options.set, faults)
    forces = _range(options.force_range, "--force-range", FORCES, faults)
    frequencies = _range(options.frequency_range, "--frequency-range", FREQUENCIES, faults)

    how = cli.running(options, CAMPAIGN, faults)
    return Order(changes, forces, frequencies, options.effort, how)


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
    if words is None:
        return usual
    try:
        low, high, count = cli.fraction(words[0]), cli.fraction(words[1]), cli.whole(2)(words[2])
        if len(words) != 3 or not 0.0 < low < high:
            raise ValueError(words)
    except (ValueError, IndexError):
        allowed = "LO HI COUNT: two finite numbers, 0 < LO < HI, and a whole number, 2 or above"
        faults.append(f"{option}: given {' '.join(words) or 'nothing'}; allowed: {allowed}")
        return usual
    return low, high, count


def study(order: Order, argv: list[str]) -> int:
    """Run it: parts, table, provenance, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.machinery import session
    from campaigns.oscillator import keep

    work = partial(keep.done, order)
    return session.conduct(CAMPAIGN, MODULE, argv, order.how, keep.parameters(order), work)
