"""Eq. (33), the snap oscillator: section, exponents, orbit diagrams, basins, periodic orbits, grazing, and a report.

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
    """The exponent in words, attractors and grazing, as far as these parts have results."""
    from campaigns.answers import known

    of = {row["part"]: row for row in rows if row["status"] == "ok"}
    exponents, basins, grazing = (of.get(part, {}) for part in ("exponents", "basins", "grazing"))
    value, error = (known(exponents, f"lambda_1_bits_{name}") for name in ("per_period", "error"))
    word = "chaotic" if value > 2 * error else "regular" if value < -2 * error else "neither shown chaotic nor regular"
    sentences = []
    if exponents:
        sentences.append(f"The motion is {word}: largest exponent {value:.4f} +- {error:.4f} bits per forcing period.")
    if basins:
        share = 100.0 * known(basins, "aperiodic_share")
        sentences.append(
            f"Periodic attractors: {known(basins, 'attractors'):.0f}; {share:.1f} % of the starts end in none."
        )
    if known(grazing, "grazing_force") > 0.0:
        sentences.append(f"The line stays taut up to a force of F = {known(grazing, 'grazing_force'):.4f}.")
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
