"""What the report on eq. (33) reads, and what it says of periodic orbits and of the equation itself."""

import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analysis.oscillator import SnapOscillator
from tables import Column, decimals, number, number_of

from ..parts import PARTS as FILES
from ..parts import FolderError, Items, Table, Text, heads, read_files, section_items

FIGURE_19 = "Tjavaras et al. 1998, figure 19"
NUMBERS = {  # symbol, what it is, source of the usual value
    "damping": ("μ", "damping by radiated waves", FIGURE_19),
    "frequency": ("ω", "forcing frequency, by the radial natural frequency", FIGURE_19),
    "force": ("F", "forcing amplitude", FIGURE_19),
    "lift": ("B − W", "buoyancy less weight", FIGURE_19),
    "phase": ("φ", "phase of the forcing at the strobe, rad", "not stated in the paper; choice of this work"),
}


PARTS = ("section", "history", "exponents", "orbits", "diagram-force", "diagram-frequency")


class Study(NamedTuple):
    """What the campaign left: `rows` of table.csv by part (text), `arrays` by part and name, `oscillator` the five
    numbers of eq. (33), `faults` by part where its arrays are not to be had."""

    provenance: dict
    columns: dict[str, Column]
    rows: dict[str, dict[str, str]]
    arrays: dict[str, dict[str, np.ndarray]]
    oscillator: dict[str, float]
    faults: dict[str, str]

    @property
    def period(self) -> float:
        """Forcing period, in units of time."""
        return 2.0 * math.pi / self.oscillator["frequency"]

    @property
    def chaotic(self) -> bool:
        """Whether the largest exponent is positive by more than two standard errors."""
        value = self.number("exponents", "lambda_1_nats_per_time")
        error = self.number("exponents", "lambda_1_error")
        return value - 2 * error > 0.0

    def number(self, part: str, column: str) -> float:
        """A cell of table.csv as a number; NaN where it is empty."""
        return number_of(self.rows.get(part, {}), column)


def read_study(directory: Path) -> Study:
    """Read the folder. Raises FolderError naming every file that is missing or cannot be read."""
    # scene.toml is no scene of the engine here; its numbers are in the provenance as well.
    wanted = {name: meaning for name, meaning in FILES.items() if name != "scene.toml"}
    files = read_files(directory, wanted)
    try:
        oscillator = {key: float(entry) for key, entry in files["provenance.json"]["oscillator"].items()}
        rows = {row["part"]: row for row in files["table.csv"]}
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        fault = f"provenance.json or table.csv is not of this campaign: {error!r}"
        raise FolderError(directory, fault) from error
    if not rows:
        raise FolderError(directory, "table.csv cannot be read: it has no rows")
    arrays, faults = {}, {}
    for part in PARTS:
        try:
            name = f"{rows[part]['run_key']}.nc"
            read = read_files(directory / "trajectories", {name: "its arrays"})[name]
            arrays[part] = {str(entry): variable.values for entry, variable in read.data_vars.items()}
        except KeyError:
            faults[part] = "it has no row in table.csv"
        except FolderError as error:
            faults[part] = rows[part]["message"] or error.faults[0]
    return Study(files["provenance.json"], files["columns.csv"], rows, arrays, oscillator, faults)


def attracting_orbit(study: Study) -> np.ndarray | None:
    """Strobed points (p, 2) of the first stable orbit of the part `orbits`; None where it has none."""
    arrays = study.arrays.get("orbits", {})
    for period, real1, imag1, real2, imag2, _, first in arrays.get("table", ()):
        if max(math.hypot(real1, imag1), math.hypot(real2, imag2)) < 1.0:
            return arrays["points"][int(first) : int(first) + int(period)]
    return None


def orbit_items(study: Study, arrays: dict) -> Items:
    """The periodic orbits with their multipliers."""
    if "table" not in arrays:
        return [Text("Newton's method met no periodic orbit from any of its starts.")]
    text = (
        "Newton's method on the strobed map with the exact tangent map, from points of the section, a grid and the "
        "attractors found. A chaotic attractor holds infinitely many unstable orbits; the table has those that were "
        "met. The product of the two multipliers must be e to the −μpT."
    )
    damping, frequency = study.oscillator["damping"], study.oscillator["frequency"]
    rows = []
    for period, real1, imag1, real2, imag2, residual, first in arrays["table"]:
        m1, m2 = complex(real1, imag1), complex(real2, imag2)
        wanted = math.exp(-damping * period * 2.0 * math.pi / frequency)
        point = arrays["points"][int(first)]
        stability = "unstable"
        if max(abs(m1), abs(m2)) < 1:
            stability = "stable"
        rows.append((
            str(int(period)), stability,
            f"{decimals(point[0], 6)}, {decimals(point[1], 6)}", _complex(m1), _complex(m2),
            f"{abs((m1 * m2).real / wanted - 1.0):.0e}", f"{residual:.0e}",
        ))  # fmt: skip
    numbers = ("leftmost strobed point (γ, velocity)", "multiplier 1", "multiplier 2")
    off = ("product off by", "relative"), ("residual", "")
    columns = heads(("period", ""), "stability", *((name, "") for name in numbers), *off)
    caption = f"Periodic orbits met by Newton's method ({len(rows)}), by period. From the part `orbits`."
    return [Text(text), Table(columns, rows, caption)]


def _complex(value: complex) -> str:
    if value.imag == 0.0:
        return number(value.real, 6)
    sign = "−"
    if value.imag > 0.0:
        sign = "+"
    return f"{number(value.real, 6)} {sign} {number(abs(value.imag), 6)}i"


def method_items(study: Study) -> Items:
    """The equation, how it is integrated, and what the exponents are."""
    rows = []
    for key, (symbol, meaning, source) in NUMBERS.items():
        chosen, usual = study.oscillator[key], getattr(SnapOscillator, key)
        if chosen != usual:
            source = f"given; the default is {number(usual)}"
        rows.append((symbol, meaning, number(chosen, 10), source))
    columns = heads("symbol", "what it is", ("value", ""), "source")
    table = Table(columns, rows, "The oscillator as run, from `scene.toml`.", small=False)
    first = section_items("oscillator_solved", "Equation and method")
    return [*first, table, *section_items("oscillator_method", "")]
