"""Eq. (33), the snap oscillator: section, exponents, orbit diagrams, periodic orbits, and a report.

    python -m campaigns.oscillator                            the paper's figure 19(b), in about a minute
    python -m campaigns.oscillator --effort 0.02              the same with a fiftieth of the work
    python -m campaigns.oscillator --set force=1.2 phase=0.5  other parameters of the equation

Protocol: the motion is integrated exactly (closed form within each piece), so there is no step and no tolerance to
choose. Every part is one row of table.csv, and its arrays are one file; parts found there are not done again. Random
starts come from a fixed seed.
"""

from dataclasses import dataclass, field
from pathlib import Path

from campaigns.machinery import cli
from campaigns.study import Order, Study

PARAMETERS = ("damping", "frequency", "force", "lift", "phase")
FORCES, FREQUENCIES = "0.1 2.0 800", "0.5 2.0 800"


def _change(word: str) -> tuple[str, float]:
    key, _, text = word.partition("=")
    if key not in PARAMETERS:
        raise ValueError(key)
    return key, float(text)


@dataclass
class Options(cli.Options):
    """The options of this campaign. changes, forces, frequencies: what the first three ask for."""

    set: list[tuple[str, float]] = cli.option(
        "KEY=VALUE ...",
        "change damping, frequency, force, lift or phase (default: the paper's)",
        cli.Kind(_change, f"KEY=VALUE with a key of {', '.join(PARAMETERS)} and a number"),
        (),
        many=True,
    )
    force_range: list[str] = cli.option("LO HI COUNT", "orbit diagram over F", usual=FORCES)
    frequency_range: list[str] = cli.option("LO HI COUNT", "orbit diagram over omega", usual=FREQUENCIES)
    effort: float = cli.option(
        "SHARE",
        "share of the usual starts, points and values",
        cli.number("a number from 0.001 to 100", lambda share: 0.001 <= share <= 100.0),
        1.0,
    )
    changes: dict[str, float] = field(default_factory=dict)
    forces: tuple = ()
    frequencies: tuple = ()

    def read(self, out: Path, faults: list[str]) -> None:
        """The parameters that are changed, and the ranges of the diagrams."""
        self.changes = dict(self.set)
        if self.changes:
            from analysis.oscillator import SnapOscillator
        for key, number in self.changes.items():
            try:
                SnapOscillator(**{key: number})
            except ValueError as error:
                faults.append(f"--set: {error}")
        self.forces = _range(self.force_range, "--force-range", faults)
        self.frequencies = _range(self.frequency_range, "--frequency-range", faults)


def _range(words: list[str], option: str, faults: list[str]) -> tuple:
    """Least and largest value, and how many; () where the words are at fault."""
    values = cli.evenly(words, option, faults, least=1e-9)
    return (values[0], values[-1], len(values)) if values else ()


def _work():
    """What takes a second to import, which --help does not need."""
    from campaigns.oscillator import study

    return study


def answer(order: Order, rows: list[dict]) -> list[str]:
    """The exponent in words, where that part has a result; the force up to which the line stays taut."""
    from analysis.oscillator import SnapOscillator, grazing_force
    from campaigns.answers import known

    sentences = []
    exponents = next((row for row in rows if row["part"] == "exponents" and row["status"] == "ok"), None)
    if exponents is not None:
        value, error = known(exponents, "lambda_1_bits_per_period"), known(exponents, "lambda_1_bits_error")
        word = "neither shown chaotic nor regular"
        if value > 2 * error:
            word = "chaotic"
        elif value < -2 * error:
            word = "regular"
        sentences.append(f"The motion is {word}: largest exponent {value:.4f} +- {error:.4f} bits per forcing period.")
    force = grazing_force(SnapOscillator(**order.options.changes)).force
    if force > 0.0:
        sentences.append(f"The line stays taut up to a force of F = {force:.4f}.")
    return sentences


STUDY = Study(
    name="oscillator",
    protocol=__doc__,
    options=Options,
    parameters=lambda order: _work().parameters(order.options),
    perform=lambda order: _work().perform(order),
    answer=answer,
    places=(),
)
main, parser, read_order = STUDY.main, STUDY.parser, STUDY.read_order
