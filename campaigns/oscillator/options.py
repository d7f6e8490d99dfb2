"""The options of `campaigns.oscillator`."""

from dataclasses import dataclass, field

from campaigns.machinery import cli

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

    def read(self, faults: list[str]) -> None:
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
