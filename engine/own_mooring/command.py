"""`python -m engine --new FILE`: the questions that a first scene needs, by options or on a terminal."""

import argparse
import math
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from engine.atomic import can_be_written, write_atomic
from engine.own_mooring.ropes import materials, rope_of
from engine.own_mooring.scene import SUBMERGED, SURFACE, Mooring, scene_text

DESCRIPTION = """Write a commented scene of a sphere on one rope; what is not given is asked for on a terminal.

    python -m engine --new my.toml --buoy-diameter 3 --depth 60 --rope nylon --rope-mm 50 --length 70 \\
        --wave-height 6 --wave-period 9 --current 0.5

The programme chooses the rest and says why in the file: wetted cap or fully submerged, added mass, drag, the bed, a
ramp of the waves, and the properties of the rope (engine/own_mooring/ropes.toml names their sources).
"""


@dataclass(frozen=True)
class Question:
    """What is asked: the option, the question, what it allows, and the answer if nothing is typed ("": none)."""

    option: str
    text: str
    allowed: str
    convert: Callable[[str], object]
    usual: str = ""


def _number(least: float, inclusive: bool = False) -> Callable[[str], float]:
    def convert(text: str) -> float:
        value = float(text)
        if not (least < value < math.inf or (inclusive and value == least)):
            raise ValueError(text)
        return value

    return convert


def _material(text: str) -> str:
    if text not in materials():
        raise ValueError(text)
    return text


def _millimetres(text: str) -> float:
    value = float(text)
    if not 1.0 <= value <= 500.0:
        raise ValueError(text)
    return value


def _mass(text: str) -> float | None:
    return None if text == "half" else _number(0.0)(text)


def _speed(text: str) -> float:
    value = float(text)
    if not abs(value) < 10.0:
        raise ValueError(text)
    return value


_ABOVE = "a finite number above 0"
QUESTIONS = (
    Question("buoy-diameter", "diameter of the buoy, a sphere (m)", f"{_ABOVE}, in metres", _number(0.0)),
    Question("buoy-mass", "its mass (kg), or half of what it displaces", f"{_ABOVE}, or half", _mass, "half"),
    Question("depth", "depth of the water (m)", f"{_ABOVE}, in metres", _number(0.0)),
    Question("rope", f"material of the rope ({', '.join(materials())})", f"one of {', '.join(materials())}", _material),
    Question("rope-mm", "its diameter (mm)", "a number from 1 to 500, in millimetres", _millimetres),
    Question("length", "its length from anchor to buoy, unstretched (m)", f"{_ABOVE}, in metres", _number(0.0)),
    Question("wave-height", "height of the waves, crest to trough (m)", "0 or above, in metres", _number(0.0, True)),
    Question("wave-period", "period of the waves (s)", f"{_ABOVE}, in seconds", _number(0.0)),
    Question("current", "current along the waves (m/s)", "a number between -10 and 10, in m/s", _speed, "0"),
)


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise ValueError(message)


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    words = {"description": DESCRIPTION, "formatter_class": argparse.RawDescriptionHelpFormatter}
    options = _Parser(prog="python -m engine --new", allow_abbrev=False, **words)
    options.add_argument("file", metavar="FILE", help="the scene file to write, NAME.toml")
    for question in QUESTIONS:
        usual = f" (default: {question.usual})" if question.usual else ""
        options.add_argument(f"--{question.option}", metavar="X", help=question.text + usual)
    kinds = f"{SURFACE} or {SUBMERGED}: refuse a rope with which the buoy is not of this kind"
    options.add_argument("--kind", choices=(SURFACE, SUBMERGED), help=kinds)
    return options


def main(argv: list[str]) -> int:
    """The command; argv: its words after --new. Returns the exit code: 0, 2 for bad input, 130 for Ctrl-C."""
    try:
        options = parser().parse_args(argv)
    except ValueError as error:
        return _refused([str(error)])
    path = Path(options.file)
    faults = _faults_of(path)
    given = vars(options)
    try:
        answers: dict[str, object] = {}
        for question in QUESTIONS:
            if question.option == "wave-period" and answers["wave-height"] == 0.0:
                answers[question.option] = None
                continue
            answers[question.option] = _answer(question, given[question.option.replace("-", "_")], faults)
    except (KeyboardInterrupt, EOFError):
        print("\ninterrupted; nothing was written", file=sys.stderr)
        return 130
    if faults:
        return _refused(faults)
    from engine.scene import SceneError, scene_from_toml  # half a second

    mooring = Mooring(
        buoy_diameter_m=answers["buoy-diameter"],
        depth_m=answers["depth"],
        rope=rope_of(answers["rope"], 1e-3 * answers["rope-mm"]),
        length_m=answers["length"],
        wave_height_m=answers["wave-height"],
        wave_period_s=answers["wave-period"],
        current_mps=answers["current"],
        mass_kg=answers["buoy-mass"],
    )
    faults = [*mooring.faults(), *filter(None, [mooring.kind_fault(options.kind)])]
    text = scene_text(mooring, path.stem)
    try:
        scene_from_toml(text)
    except SceneError as error:
        faults += error.faults
    if faults:
        return _refused(faults)
    write_atomic(path, text.encode())
    _tell(mooring, path)
    return 0


def _answer(question: Question, given: str | None, faults: list[str]) -> object:
    """The value of an option, or else what is typed on a terminal; None where it is at fault."""
    asked = given is None and sys.stdin.isatty()
    while True:
        word = given
        if asked:
            usual = f" [{question.usual}]" if question.usual else ""
            word = input(f"{question.text}{usual}: ").strip() or question.usual
        elif given is None:
            word = question.usual
        try:
            return question.convert(word)
        except ValueError:
            fault = f"given {word or 'nothing'}; allowed: {question.allowed}"
        if not asked:
            faults.append(f"--{question.option}: {fault}")
            return None
        print(f"  {fault}")


def _faults_of(path: Path) -> list[str]:
    given = f"given {str(path)!r}"
    if path.suffix != ".toml" or not re.fullmatch(r"[A-Za-z0-9_.-]+", path.stem):
        return [f"--new: {given}; allowed: NAME.toml, with letters, digits and _ . - in the name"]
    if path.exists():
        return [f"--new: {given}, which is there already; allowed: a new file"]
    if not can_be_written(path.parent):
        return [f"--new: {given}; allowed: a file in a folder that is there and can be written to"]
    return []


def _refused(faults: list[str]) -> int:
    several = f" {len(faults)} faults\n  " if len(faults) > 1 else " "
    print(f"python -m engine --new:{several}" + "\n  ".join(faults) + "\nnothing was written", file=sys.stderr)
    return 2


def _tell(mooring: Mooring, path: Path) -> None:
    """What was chosen, and the next commands."""
    rope = mooring.rope
    print(f"scene     {path}")
    print(f"rope      EA {1e-3 * rope.stiffness_N:.4g} kN, {rope.mass_kgpm:.3g} kg/m, "
          f"breaking load {1e-3 * rope.breaking_load_N:.3g} kN: {rope.source}")  # fmt: skip
    for alternative_N, source in rope.alternatives:
        print(
            f"          EA {1e-3 * alternative_N:.3g} kN by {source}: try it, --set tether.tension.stiffness_N={alternative_N:.3g}"
        )
    floats = "floats (its wetted cap is in the water)" if mooring.kind == SURFACE else "stays submerged"
    print(f"buoy      {floats}; with {1e-3 * mooring.lift_N:.3g} kN it pulls at most while it is not accelerated")
    print(f"next      python -m engine {path}")
    if mooring.wave_height_m > 0.0:
        low, high = 0.25 * mooring.wave_height_m, 0.5 * mooring.wave_height_m
        print(f"          python -m campaigns.sweep --scene {path} --vary waves.amplitude_m {low:g} {high:g} 5")
