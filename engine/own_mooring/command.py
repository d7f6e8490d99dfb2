"""`python -m engine --new FILE`: the questions that a first scene needs, by options or on a terminal."""

import argparse
import re
import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

from engine.atomic import can_be_written, write_atomic
from engine.own_mooring.ropes import materials, rope_of
from engine.own_mooring.scene import SUBMERGED, SURFACE, Mooring, scene_text
from engine.streams import Parser, refused

DESCRIPTION = """Write a commented scene of a sphere on one rope; what is not given is asked for on a terminal.

    python -m engine --new my.toml --buoy-diameter 3 --depth 60 --rope nylon --rope-mm 50 --length 70 \\
        --wave-height 6 --wave-period 9 --current 0.5

The programme chooses the rest and says why in the file: wetted cap or fully submerged, added mass, drag, the bed, a
ramp of the waves, and the properties of the rope (engine/own_mooring/ropes.toml names their sources).
"""


@dataclass(frozen=True)
class Question:
    """A question of questions.toml: its option, its words, the numbers that it allows, the answer to nothing typed."""

    option: str
    text: str
    least: float = 0.0
    most: float = 0.0
    usual: str = ""

    @property
    def allowed(self) -> str:
        """What it allows, in words."""
        if self.option == "rope":
            return f"one of {', '.join(materials())}"
        return f"a number from {self.least:g} to {self.most:g}"

    def value(self, word: str) -> float | str | None:
        """The answer in a word; None of "half". Raises ValueError for what is not allowed."""
        if self.option == "rope" and word in materials():
            return word
        if word == self.usual == "half":
            return None
        if not self.least <= float(word) <= self.most:
            raise ValueError(word)
        return float(word)


def questions() -> list[Question]:
    """In the order in which they are asked."""
    table = tomllib.loads(Path(__file__).with_name("questions.toml").read_text(encoding="utf-8"))
    return [Question(option, **row) for option, row in table.items()]


def parser() -> Parser:
    """The options of the command."""
    words = {"description": DESCRIPTION, "formatter_class": argparse.RawDescriptionHelpFormatter}
    options = Parser(prog="python -m engine --new", allow_abbrev=False, **words)
    options.add_argument("file", metavar="FILE", help="the scene file to write, NAME.toml")
    for question in questions():
        usual = f" (default: {question.usual})" if question.usual else ""
        options.add_argument(f"--{question.option}", metavar="X", help=f"{question.text}: {question.allowed}{usual}")
    kinds = f"{SURFACE} or {SUBMERGED}: refuse a rope with which the buoy is not of this kind"
    options.add_argument("--kind", metavar="X", help=kinds)
    return options


def main(argv: list[str]) -> int:
    """The command; argv: its words after --new. Returns the exit code: 0, 2 for bad input, 130 for Ctrl-C."""
    try:
        values, unknown = parser().parse_known_args(argv)
    except ValueError as error:
        return _refused([str(error)])
    options = vars(values)
    path, kind = Path(options["file"]), options["kind"]
    faults = _faults_of(path)
    for word in unknown:
        if word.startswith("-") or not unknown[0].startswith("-"):  # not the value of an unknown option
            faults.append(f"{word}: no such option{parser().close_to(word)}")
    if kind not in (None, SURFACE, SUBMERGED):
        faults.append(f"--kind: given {kind}; allowed: {SURFACE} or {SUBMERGED}")
    answers: dict[str, object] = {"wave_period": None}
    try:
        for question in questions():
            name = question.option.replace("-", "_")
            if name != "wave_period" or answers["wave_height"] != 0.0:
                answers[name] = _answer(question, options[name], faults)
    except (KeyboardInterrupt, EOFError):
        print("\ninterrupted; nothing was written", file=sys.stderr)
        return 130
    if faults:
        return _refused(faults)
    mooring = Mooring(
        buoy_diameter_m=answers["buoy_diameter"],
        depth_m=answers["depth"],
        rope=rope_of(answers["rope"], 1e-3 * answers["rope_mm"]),
        length_m=answers["length"],
        wave_height_m=answers["wave_height"],
        wave_period_s=answers["wave_period"],
        current_mps=answers["current"],
        mass_kg=answers["buoy_mass"],
    )
    return _written(mooring, kind, path)


def _written(mooring: Mooring, kind: str | None, path: Path) -> int:
    """Write the scene of a mooring, or refuse it; returns the exit code."""
    from engine.scene import SceneError, scene_from_toml  # half a second

    faults, text = mooring.faults(kind), scene_text(mooring, path.stem)
    try:
        scene_from_toml(text)
    except SceneError as error:
        faults += error.faults
    if faults:
        return _refused(faults)
    write_atomic(path, text.encode())
    print(f"scene     {path} ({mooring.kind}): read where each value comes from")
    print(f"next      python -m engine {path}")
    return 0


def _answer(question: Question, word: str | None, faults: list[str]) -> float | str | None:
    """The answer by an option, or else what is typed on a terminal; None where it is at fault."""
    typed = word is None and sys.stdin.isatty()
    while True:
        if typed:
            word = input(f"{question.text} [{question.usual or question.allowed}]: ").strip()
        try:
            return question.value(word or question.usual)
        except ValueError:
            fault = f"--{question.option}: given {word or 'nothing'}; allowed: {question.allowed}"
        if not typed:
            faults.append(fault)
            return None
        print(fault)


def _faults_of(path: Path) -> list[str]:
    allowed = ""
    if path.suffix != ".toml" or not re.fullmatch(r"[A-Za-z0-9_.-]+", path.stem):
        allowed = "NAME.toml, with letters, digits and _ . - in the name"
    elif path.exists():
        allowed = "a new file, and this one is there already"
    elif not can_be_written(path.parent):
        allowed = "a file in a folder that is there and can be written to"
    return [f"--new: given {str(path)!r}; allowed: {allowed}"] if allowed else []


def _refused(faults: list[str]) -> int:
    return refused("python -m engine --new", faults, "nothing was written")
