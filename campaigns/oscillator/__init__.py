"""Eq. (33), the snap oscillator: section, exponents, orbit diagrams, periodic orbits, and a report.

    python -m campaigns.oscillator                            the paper's figure 19(b), in about a minute
    python -m campaigns.oscillator --effort 0.02              the same with a fiftieth of the work
    python -m campaigns.oscillator --set force=1.2 phase=0.5  other parameters of the equation

Protocol: the motion is integrated exactly (closed form within each piece), so there is no step and no tolerance to
choose. Every part is one row of table.csv, and its arrays are one file; parts found there are not done again. Random
starts come from a fixed seed.
"""

from argparse import Namespace

from campaigns.machinery import cli
from campaigns.study import Order, Study

PARAMETERS = ("damping", "frequency", "force", "lift", "phase")
FORCES, FREQUENCIES = (0.1, 2.0, 800), (0.5, 2.0, 800)


def options(group) -> None:
    """Add the options of this campaign."""
    setting = cli.Kind(_change, f"KEY=VALUE with a key of {', '.join(PARAMETERS)} and a number")
    changed = "change damping, frequency, force, lift or phase (default: the paper's)"
    cli.add(group, "--set", "KEY=VALUE ...", changed, setting, [], many=True)
    usual = "(default: {} {} {})".format
    cli.add(group, "--force-range", "LO HI COUNT", f"orbit diagram over F {usual(*FORCES)}")
    cli.add(group, "--frequency-range", "LO HI COUNT", f"orbit diagram over omega {usual(*FREQUENCIES)}")
    share = cli.number("a number from 0.001 to 100", lambda found: 0.001 <= found <= 100.0)
    cli.add(group, "--effort", "SHARE", "share of the usual starts, points and values", share, 1.0)


def read(options: Namespace, faults: list[str]) -> None:
    """The parameters that are changed, and the ranges of the diagrams."""
    options.changes = dict(options.set)
    if options.changes:
        from analysis.oscillator import SnapOscillator
    for key, number in options.changes.items():
        try:
            SnapOscillator(**{key: number})
        except ValueError as error:
            faults.append(f"--set: {error}")
    options.forces = _range(options.force_range, "--force-range", FORCES, faults)
    options.frequencies = _range(options.frequency_range, "--frequency-range", FREQUENCIES, faults)


def _change(word: str) -> tuple[str, float]:
    key, _, text = word.partition("=")
    if key not in PARAMETERS:
        raise ValueError(key)
    return key, float(text)


def _range(words: list[str] | None, option: str, usual: tuple, faults: list[str]) -> tuple[float, float, int]:
    values = [] if words is None else cli.evenly(words, option, faults, least=1e-9)
    return (values[0], values[-1], len(values)) if values else usual


def _work():
    """What takes a second to import, which --help does not need."""
    from campaigns.oscillator import study

    return study


def answer(order: Order, rows: list[dict]) -> list[str]:
    """The exponent in words, where that part has a result; the force up to which the line stays taut."""
    from analysis.oscillator import SnapOscillator, grazing_force
    from tables import number_of

    sentences = []
    exponents = next((row for row in rows if row["part"] == "exponents" and row["status"] == "ok"), None)
    if exponents is not None:
        value, error = number_of(exponents, "lambda_1_bits_per_period"), number_of(exponents, "lambda_1_bits_error")
        word = "neither shown chaotic nor regular"
        if value > 2 * error:
            word = "chaotic"
        elif value < -2 * error:
            word = "regular"
        sentences.append(f"The motion is {word}: largest exponent {value:.4f} +- {error:.4f} bits per forcing period.")
    force = grazing_force(SnapOscillator(**order.own.changes)).force
    if force > 0.0:
        sentences.append(f"The line stays taut up to a force of F = {force:.4f}.")
    return sentences


STUDY = Study(
    name="oscillator",
    protocol=__doc__,
    options=options,
    read=read,
    parameters=lambda order: _work().parameters(order.own),
    done=lambda order: _work().done(order.own),
    answer=answer,
    jobs=False,
    backends=False,
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
