"""The report of `campaigns.oscillator`: what is said, in which order. Everything comes from the campaign's folder.

What the campaign left; the report; its sections, one for each part of the study.
"""

import math
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np

from analysis.oscillator import SnapOscillator, grazing_force
from tables import Column, count, decimals, number, number_of, percent, sub

from ..figures.curves import Curve, Panel, curves, dots
from ..figures.orbit_diagram import OrbitDiagram, Strobes
from ..parts import PARTS as FILES
from ..parts import (
    Figure,
    FolderError,
    Heading,
    Items,
    Notice,
    Report,
    Table,
    Text,
    heads,
    picture_first,
    read_files,
    report_page,
    section_items,
    table_of,
)
from ..parts.style import BLUE, GREEN, INK, SOFT, VERMILION

LAMBDA_1 = "λ" + sub("1")
STATE = (r"displacement $\gamma$ (–)", r"velocity $\dot\gamma$ (–)")
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
    """What the campaign left: `rows` of table.csv by part (text), `arrays` by part and name, `oscillator` with the
    five numbers of eq. (33), `faults` by part where its arrays are not to be had."""

    provenance: dict
    columns: dict[str, Column]
    rows: dict[str, dict[str, str]]
    arrays: dict[str, dict[str, np.ndarray]]
    oscillator: SnapOscillator
    faults: dict[str, str]

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
        numbers = {key: float(entry) for key, entry in files["provenance.json"]["oscillator"].items()}
        oscillator = SnapOscillator(**numbers)
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


def report(directory: Path) -> Report:
    """The content of the report on an oscillator study's folder. Raises FolderError for a folder that is not one."""
    study = read_study(directory)
    items = []
    if study.faults:  # before the first heading: on the first page, after the answer
        missing = [f"`{part}`: {reason}." for part, reason in study.faults.items()]
        items.append(Notice("warning", "Parts without results", missing))
    items += section_items("oscillator")
    for part, (title, section) in SECTIONS.items():
        arrays = study.arrays.get(part)
        items.append(Heading(title))
        if arrays is None:
            items.append(Text(f"The part `{part}` has no results: {study.faults.get(part)}."))
        else:
            items.append(section(study, arrays))
    shown = ("part", "status", "starts", "periods", "transient", "wall_s")
    parts = table_of(study.columns, shown, study.rows.values(), "The parts of the study, from `table.csv`.")
    made = [method_items(study), Heading("Parts and times"), parts]
    numbers = (f"{symbol} = {number(getattr(study.oscillator, key))}" for key, (symbol, *_) in NUMBERS.items())
    return report_page(study, "The snap oscillator, equation (33)", picture_first(items), made, ", ".join(numbers))


def _section(study: Study, arrays: dict) -> Items:
    states, boxes, row = arrays["section"], arrays["boxes"], study.rows["section"]
    alpha = 1.0
    if len(states) > 20000:
        alpha = 0.6
    lines = [dots(*states.T, ",", INK, alpha=alpha), *_frames(boxes, 1)]
    orbit = attracting_orbit(study)
    if orbit is not None:
        lines.append(dots(*orbit.T, "o", VERMILION, name=f"attracting period-{len(orbit)} orbit"))
    caption = (
        f"Poincaré section at the forcing phase {number(study.oscillator.phase)} rad, in the layout of the paper's "
        f"figure 19(b): {len(states)} points, one a forcing period, after {row['transient']} periods. From the part "
        "`section`."
    )
    alt = f"Scatter of {len(states)} strobed points of displacement and velocity."
    yield Figure(curves([[Panel(lines, *STATE)]], 4.9, "upper left", kind="png"), caption, alt)
    zooms = [arrays[name] for name in ("zoom_1", "zoom_2") if name in arrays]
    if not zooms or not study.chaotic:  # a zoom into a periodic orbit shows a point
        return
    panels = []
    for place, (points, box) in enumerate(zip(zooms, boxes, strict=True), 1):
        lines, y_label = [dots(*points.T, ",", INK, alpha=0.7), *_frames(boxes[place:], place + 1)], ""
        if place == 1:
            y_label = STATE[1]
        panels.append(Panel(lines, STATE[0], y_label, f"zoom {place}", ticks=5, xlim=box[:2], ylim=box[2:]))
    counts = " and ".join(str(len(zoom)) for zoom in zooms)
    caption = (
        "Layers within layers: zooms by 10 and by 100 round the place visited most. They have "
        f"{counts} points out of {row['periods']} periods of the same orbit. A line resolves into several lines, "
        "and each of these again, because each period stretches the attractor along its lines and folds it at the "
        "snap. From the part `section`."
    )
    picture = curves([panels], 3.5, "upper left", kind="png")
    yield Figure(picture, caption, "Two zooms: bundles of nearly parallel lines.")


def _frames(boxes: np.ndarray, first: int) -> Items:
    """The outlines of the boxes (b, 4) of zooms, with their numbers, as curves."""
    for place, (left, right, low, high) in enumerate(boxes, first):
        x, y = np.array([left, right, right, left, left]), np.array([low, low, high, high, low])
        yield Curve(x, y, f"zoom {place}", colour=(BLUE, GREEN)[place - 1])


def _history(study: Study, arrays: dict) -> Items:
    """Displacement and velocity over time, shaded where the tether is slack."""
    switches = count(len(arrays.get("switches", ())), "switch", "switches")
    share = percent(study.number("history", "slack_fraction"))
    seen = f"{switches} in {study.rows['history']['periods']} periods, {share} of the time slack"
    periods, slack = arrays["time"] / study.oscillator.period, arrays["displacement"] < 0.0
    rows = []
    for name, label in (("displacement", r"$\gamma$ (–)"), ("velocity", r"$\dot\gamma$ (–)")):
        values = arrays[name]
        band = periods, np.where(slack, values.min(), np.nan), np.where(slack, values.max(), np.nan)
        history = Curve(periods, values, colour=INK, band=band)
        x_label = r"$t/T$ (forcing periods)" if rows else ""
        rows.append([Panel([history], x_label, label, level=0.0, xlim=(periods[0], periods[-1]))])
    caption = f"The first periods from γ = 0.68 at rest; shaded: slack. Seen: {seen}. From the part `history`."
    return [Figure(curves(rows, 2.9, share="x"), caption, f"Histories of displacement and velocity: {seen}.")]


def _exponents(study: Study, arrays: dict) -> Items:
    row = study.rows["exponents"]
    text = (
        "Both exponents come from the exact tangent map, re-orthonormalised every period. They are averages over "
        f"{row['starts']} random starts of {row['periods']} periods each, after {row['transient']}. The error is the "
        "standard deviation over the starts by the root of their number. Starts that settled on a periodic attractor "
        f"are not counted ({row['elsewhere']}). Blocks of time alone give an error of "
        f"{float(arrays['block_error'][0]):.2g}. Both exponents and the damping must add up to zero. A Kaplan-Yorke "
        "dimension D between 1 and 2 is that of a fractal between a curve and an area."
    )
    shown = (
        "lambda_1_nats_per_time",
        "lambda_1_bits_per_period",
        "lambda_2_nats_per_time",
        "sum_plus_damping",
        "section_dimension",
    )
    table = table_of(study.columns, shown, [row], "The exponents, from `table.csv`.")
    return [Text(text), table, _errors(arrays["convergence"], arrays["of_start"][:, 0])]


def _errors(convergence: np.ndarray, of_start: np.ndarray) -> Figure:
    """How the exponent settles: its mean over (time, mean, standard error) (b, 3), and the standard deviation of the
    mean of k starts, from of_start (n,) cut into groups of k.
    """
    time, mean, error = convergence.T
    band = (time, mean - 2 * error, mean + 2 * error)
    running = Curve(time, mean, "mean over starts, ± 2 standard errors", colour=BLUE, band=band)
    labels = ("time of each start's average (–)", r"$\lambda_1$ (nats per time)")
    left = Panel([running], *labels, level=float(mean[-1]))
    sizes = 2 ** np.arange(20)
    sizes = sizes[(len(of_start) // sizes >= 8) | (sizes == 1)]
    groups, scatter = len(of_start) // sizes, np.empty(len(sizes))
    for place, (size, number_of_groups) in enumerate(zip(sizes, groups, strict=True)):
        means = of_start[: size * number_of_groups].reshape(number_of_groups, size).mean(axis=1)
        scatter[place] = means.std(ddof=1)
    observed = dots(sizes, scatter, "o", INK, 3.5, error=2 * scatter / np.sqrt(2.0 * (groups - 1)))
    ends = sizes[[0, -1]]
    law = Curve(ends, scatter[0] * ends**-0.5, r"$k^{-1/2}$ from $k = 1$", colour=VERMILION)
    log = "xy" if (scatter > 0).all() else "x"  # starts on one periodic orbit may agree to the last bit
    right = Panel([observed, law], r"starts averaged, $k$", "scatter of the mean (nats per time)", log=log)
    caption = (
        f"Errors of the largest exponent. Left: {LAMBDA_1} against the length of the averages. Right: scatter "
        "of the mean of k starts against k (bars: two standard errors of the scatter) beside the line of independent "
        "starts. From the part `exponents`."
    )
    alt = "Convergence of the largest exponent with time, and its scatter against the number of starts."
    return Figure(curves([[left, right]], 2.8, "upper right"), caption, alt)


def _diagram(study: Study, arrays: dict, symbol: str, key: str, label: str) -> Items:
    if not np.isfinite(arrays["section"]).any():
        return [Text(f"There is no orbit diagram over {symbol}: no finite points.")]
    values, largest = arrays["values"], arrays["exponents"][..., 0]
    marks = [(getattr(study.oscillator, key), "as run")]
    grazing = grazing_force(study.oscillator)
    if key == "force" and math.isfinite(grazing):
        marks.append((grazing, "grazing"))
    marks = [(at, text) for at, text in marks if values[0] <= at <= values[-1]]
    positive = largest - 2 * arrays["errors"] > 0
    across = np.broadcast_to(values[:, None], largest.shape)
    every_value = across.ravel()
    lines = [
        dots(every_value, arrays["exponents"][..., 1].ravel(), "o", SOFT, 1.0, name=r"$\lambda_2$"),
        dots(across[~positive], largest[~positive], "o", BLUE, 1.3, name=r"$\lambda_1$"),
        dots(across[positive], largest[positive], "o", VERMILION, 1.3, name=r"$\lambda_1$, above 0 by two errors"),
    ]
    slack = dots(every_value, arrays["slack_fraction"].ravel(), "o", BLUE, 1.0)
    below = [
        Panel(lines, y_label="exponents\n(nats per time)", level=0.0),
        Panel([slack], y_label="slack share\n(–)", ylim=(-0.03, 1.03)),
    ]
    columns = []
    for at, points in zip(values, arrays["section"], strict=True):
        columns.append(Strobes(at, points[np.isfinite(points)]))
    picture = OrbitDiagram(columns, (label, r"strobed $\gamma$ (–)"), below, marks=marks).drawn()
    top = number(float(np.nanmax(largest)), 3), number(float(values[int(np.nanargmax(largest.max(axis=1)))]))
    seen = (
        f"{LAMBDA_1} is above zero by two errors, for one start at least, at {int(positive.any(axis=1).sum())} of "
        f"{len(values)} values; its largest value is {top[0]} at {symbol} = {top[1]}"
    )
    row = study.rows[f"diagram-{key}"]
    caption = (
        f"Strobed displacement over {symbol}, both exponents and the share of slack time, the same four random "
        f"starts at every value, {row['periods']} periods after {row['transient']}. Where the four differ, "
        f"attractors coexist or a transient is long. Seen: {seen}. From the part `{row['part']}`."
    )
    return [Figure(picture, caption, f"Orbit diagram over {symbol} with exponents below: {seen}.")]


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
    damping, frequency = study.oscillator.damping, study.oscillator.frequency
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
        chosen, usual = getattr(study.oscillator, key), getattr(SnapOscillator, key)
        if chosen != usual:
            source = f"given; the default is {number(usual)}"
        rows.append((symbol, meaning, number(chosen, 10), source))
    columns = heads("symbol", "what it is", ("value", ""), "source")
    table = Table(columns, rows, "The oscillator as run, from `scene.toml`.", small=False)
    first = section_items("oscillator_solved", "Equation and method")
    return [*first, table, *section_items("oscillator_method", "")]


SECTIONS = {  # part of the study: heading, what is said of its arrays
    "section": ("The section: figure 19(b)", _section),
    "history": ("The motion from rest", _history),
    "exponents": ("Exponents and their errors", _exponents),
    "diagram-force": (
        "Orbit diagram over the forcing",
        partial(_diagram, symbol="F", key="force", label=r"forcing $F$ (–)"),
    ),
    "diagram-frequency": (
        "Orbit diagram over the frequency",
        partial(_diagram, symbol="ω", key="frequency", label=r"forcing frequency $\omega$ (–)"),
    ),
    "orbits": ("Periodic orbits", orbit_items),
}
