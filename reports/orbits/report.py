"""The report of `campaigns.orbits`: its sections in their order. All content comes from the campaign's folder."""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np

from engine.views import strobed_radius
from tables import EMPTY, WHOLE_BRANCH, Column, any_rows, count, decimals, listed, number, number_of

from ..buoy_sweep.motions import MARKS
from ..figures.curves import Curve, Panel, curves, dots
from ..figures.orbit_diagram import OrbitDiagram, Strobes
from ..figures.quantities import colours_of
from ..parts import (
    Figure,
    Folder,
    FolderError,
    Heading,
    Items,
    Notice,
    Report,
    Table,
    batched,
    entries,
    filled_table,
    having,
    heads,
    in_order,
    limits,
    plain,
    read_folder,
    report_page,
    section_items,
    series,
)
from ..parts.style import INK, SOFT
from .branches import DASHED, EVENTS, MODULUS, PEAK, Branch, Row, read_branches
from .curves import curve_items

_NEEDED = ("branch", "place", "period", "unstable", MODULUS, PEAK, "status", "message")
_ACCURATE = 2e-4  # largest error of an event that needs no mark; a share of the value of the key where that is above 1
_SHOWN = range(1, 5)  # numbers of the multipliers that are shown
_FAR = 3.0  # largest modulus in the figure over the key
_OUT = 2.0  # largest modulus in the complex plane
_NOWHERE = np.full(1, np.nan)

_EVENTS = f"Events along the branches. ‡: error above {number(_ACCURATE)}. †: not found on a finer grid."
_COMPLETE = "Every branch was followed to its end, every event is accurate."


def report(directory: Path) -> Report:
    """The content of the report on a folder of orbits. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, _NEEDED)
    key = _varied(folder)
    motions = folder.part("motions").completed
    branches = read_branches(folder, key.name, motions)
    located = {key.name: partial(_located, key=key.name)}
    of_events = ("branch", "kind", key.name, "finer", "angle_rad", PEAK, "leads_to", "message")
    of_branches = ("branch", "period", "motion", "orbits", "closed", "begins", "ends", "message")
    items = [
        _diagram(folder, key, branches, motions),
        filled_table(folder.part("events"), _EVENTS, of_events, located),
        curve_items(folder),
        section_items("orbits"),
        Heading("Warnings"),
        _warnings(folder, key, branches),
        _chosen(folder, key, branches),
        _multipliers(key, branches),
        Heading("Branches"),
        filled_table(folder.part("branches"), "The branches, and why each ends both ways.", of_branches),
    ]
    return report_page(folder, f"Periodic orbits over {plain(key.head)}, stable and unstable", items)


def _varied(folder: Folder) -> Column:
    """The column of the key along which the orbits were followed. It is called as the key, or as its last part."""
    name = str(next(iter(folder.provenance.get("vary") or ()), ""))
    for column in (name, name.rpartition(".")[2]):
        if column in folder.columns:
            return folder.columns[column]
    raise FolderError(folder.directory, "provenance.json cannot be read: it does not name what was varied")


def _diagram(folder: Folder, key: Column, branches: Sequence[Branch], motions: Sequence[Row]) -> Figure | None:
    """Branches over the strobed points of the motions, with tension and multiplier below; None without branches."""
    if not branches:
        return None
    colours = colours_of(motions)
    simulated, legend = _simulated(key, motions, colours)
    kinds = Counter(np.concatenate([branch.kinds for branch in branches]).tolist())  # of events
    del kinds[""]  # of orbits
    drawn = {}
    for quantity in branches[0].seen:
        drawn[quantity] = []
        for curves_of in (Branch.lines, Branch.marks):  # marks after all lines, so that they lie above
            for branch in branches:
                drawn[quantity] += curves_of(branch, quantity)
    for branch in branches:
        at, modulus = series(branch.orbits, key.name), series(branch.orbits, MODULUS)
        bars = series(branch.orbits, "multiplier_1_error")
        drawn["modulus"].append(dots(at, modulus, "", branch.colour, error=bars))
    peak, far = _largest(branches, "peak"), _largest(branches, "modulus")
    for curve in simulated:
        peak = max(peak, float(np.nanmax(curve.y, initial=0.0)))
    tension = Panel(
        [*simulated, *drawn["peak"]],
        y_label="largest T\n(kN)",
        ylim=(0.0, 1.25 * peak),
        texts=[*_texts(branches, 0.14 * peak)],
        height=1.5,
    )
    modulus = Panel(drawn["modulus"], y_label=r"$|\mu|$ (–)", level=1.0, ylim=(0.0, min(1.05 * far, _FAR)))
    points, labels = _points_of_motions(folder, key, motions, colours), (key.label, "strobed r (m)")
    orbits = [*drawn["strobes"], *_legend(kinds)]
    diagram = OrbitDiagram(points, labels, [tension, modulus], motions=legend, orbits=orbits)
    caption = (
        "Lines: r of each orbit once a wave period, solid where it is stable, dashed where no run stays on it. Dashes "
        "and small dots: the motions that runs have found, in the same colours (`motions/table.csv`). Below: largest "
        "tension; modulus of the largest multiplier, with its error"
    )
    if far > _FAR:
        caption += f", up to {number(_FAR)}"
    events = []
    for kind, number_of_kind in kinds.items():
        events.append(count(number_of_kind, "torus point" if kind == "torus" else kind))
    alt = f"Orbit diagram with {count(len(branches), 'branch', 'branches')} of orbits and {listed(events)}; see text."
    return diagram.figure(f"{caption}.", alt)


def _largest(branches: Sequence[Branch], quantity: str) -> float:
    """The largest value of a quantity on all branches."""
    return float(max(np.nanmax(branch.seen[quantity]) for branch in branches))


def _points_of_motions(folder: Folder, key: Column, motions: Sequence[Row], colours: dict[str, str]) -> list[Strobes]:
    """The strobed points of the motions that runs have found."""
    part, strobes = folder.part("motions"), []
    for row in in_order(motions, [key.name]):
        run, _ = part.trajectory(row)
        points = np.empty(0)
        if run is not None:
            points = strobed_radius(run, int(row.get("transient_periods") or 0))[:, 0]
        letter = row["motion"] if colours else ""
        strobes.append(Strobes(row[key.name], points, row.get("regime") or "", letter))
    return strobes


def _simulated(key: Column, motions: Sequence[Row], colours: dict[str, str]) -> tuple[list[Curve], dict]:
    """The largest tension of each motion over the key, and the legend of the motions: letter -> (colour, text)."""
    drawn, legend = [], {}
    for (letter, colour), mark in zip((colours or {"": INK}).items(), MARKS, strict=False):
        rows = having(motions, motion=letter) if colours else motions
        tension_kN = 1e-3 * series(rows, PEAK)
        drawn.append(dots(series(rows, key.name), tension_kN, mark, colour, 2.8))
        if letter:
            legend[letter] = (colour, f"up to {number(np.nanmax(tension_kN), 3)} kN")
    return drawn, legend


def _legend(kinds: Iterable[str]) -> list[Curve]:
    """Curves without points, which put the kinds of lines and of events into the legend."""
    looks = [("stable orbit", "-", ""), ("unstable orbit", DASHED, "")]
    looks += [(kind, "", EVENTS[kind]) for kind in kinds]
    return [Curve(_NOWHERE, _NOWHERE, *look, INK, size=3.4) for look in looks]


def _texts(branches: Sequence[Branch], offset: float) -> Iterator[tuple[float, float, str, str]]:
    """Texts in the panel of the tension: names of branches, and values at which a branch becomes stable or unstable."""
    changes = []
    for branch in branches:
        at, peak = branch.at, branch.seen["peak"][:, 0]
        middle = int(np.argmin(np.abs(at - 0.5 * (at.min() + at.max())) - 0.01 * peak))
        yield at[middle], peak[middle] + offset, branch.name, branch.colour
        for place in branch.changes:
            if branch.kinds[place]:
                changes.append((at[place], peak[place]))
    for at, peak in sorted(changes):
        yield at, peak + offset, decimals(at, 4).lstrip("0"), INK
        offset = -offset


def _located(row: Row, key: str) -> str:
    """The value of the key at an event, "0.12371 ± 0.00003", with the marks that _EVENTS explains."""
    text = f"{decimals(number_of(row, key), 5)}\u00a0±\u00a0{number(number_of(row, 'error'), 1)}"
    if _coarse(row, key):
        text += "‡"
    if not np.isfinite(number_of(row, "finer")):
        text += "†"
    return text


def _coarse(row: Row, key: str) -> bool:
    """Whether the error of an event is above _ACCURATE, or unknown."""
    return not number_of(row, "error") <= _ACCURATE * max(1.0, abs(number_of(row, key)))


def _chosen(folder: Folder, key: Column, branches: Sequence[Branch]) -> Items:
    """The chosen orbits: their curves at the value of the key that has most of them, and all their multipliers."""
    rows, plane, tension = folder.part("orbits").table, [], []
    if not rows:
        return
    at = Counter(entries(rows, key.name)).most_common(1)[0][0]
    colours = colours_of(folder.part("motions").table)
    for branch in branches:
        colours[branch.name] = branch.colour
    for row in having(rows, **{key.name: at}):
        history = any_rows(folder.directory / "orbits" / f"{row['branch']}_{row['place']}.csv")
        name = f"motion {row['motion']}"  # no branch could be followed
        if row["branch"]:
            name = f"branch {row['branch']}"
        line, stability = "-", "stable"
        if row["unstable"]:
            line, stability = DASHED, "unstable"
        look = f"{name}, {stability}", line, "", colours.get(row["branch"] or row["motion"], INK)
        closed = [*history, *history[:1]]
        plane.append(Curve(series(closed, "radius_m"), series(closed, "radius_rate_mps"), *look, width=1.2))
        time, tension_kN = series(history, "time_s"), 1e-3 * series(history, "tension_top_N")
        tension.append(Curve(row["period"] * time / time[-1], tension_kN, *look, width=1.2))
    yield Heading("Orbits")
    panels = Panel(plane, "r (m)", "dr/dt (m/s)"), Panel(tension, "time (wave periods)", "T at the top (kN)", level=0.0)
    caption = f"Orbits at {key.head} = {number(at)}: radial speed over r, and tension over one round (`orbits/`)."
    picture = curves([panels], 3.0, "below", widths=(1.0, 1.3))
    yield Figure(picture, caption, f"{listed(curve.name for curve in plane)}.")
    columns = heads("branch", (key.head, key.unit), *((f"μ{k}", "") for k in _SHOWN), ("gap", ""), "motion")
    body = []
    for row in rows:
        multipliers = [_multiplier(row, k) for k in _SHOWN]
        branch, motion = row["branch"] or EMPTY, row["motion"] or EMPTY
        body.append((branch, number(row[key.name]), *multipliers, number(row["gap"], 1), motion))
    caption = (
        "Multipliers, the largest first; in brackets their errors: how far other time steps change them. Gap: the "
        "remainder of the equation of the orbit."
    )
    yield Table(columns, body, caption)


def _multiplier(row: Row, k: int) -> str:
    """A multiplier with its error in print: "−0.732 (0.007)", "0.155 + 0.446i (0.02)"."""
    mu, error = _complex(row, k), number_of(row, f"multiplier_{k}_error")
    if not np.isfinite(mu.real):
        return EMPTY
    text = decimals(mu.real, 3)
    if mu.imag < 0.0:
        text += f" − {decimals(-mu.imag, 3)}i"
    elif mu.imag:
        text += f" + {decimals(mu.imag, 3)}i"
    return f"{text} ({number(error, 1)})"


def _complex(row: Row, k: int) -> complex:
    """The multiplier number k of a row; its real part is nan where the row has none."""
    return complex(number_of(row, f"multiplier_{k}_real"), number_of(row, f"multiplier_{k}_imag"))


def _multipliers(key: Column, branches: Sequence[Branch]) -> Items:
    """The multipliers of all orbits in the complex plane, a panel for each branch; nothing without branches."""
    if not branches:
        return
    values = np.concatenate([branch.at for branch in branches])
    low, high = float(values.min()), float(values.max())
    out = min(_OUT, max(1.2, _largest(branches, "modulus")))
    circle, panels = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 200)), []
    limit = -1.05 * out, 1.05 * out
    square = {"xlim": limit, "ylim": limit, "settings": {"aspect": "equal"}}
    for branch in branches:
        drawn = [Curve(circle.real, circle.imag, colour=SOFT)]
        for row in branch.orbits:
            multipliers = np.array([_complex(row, k) for k in _SHOWN])
            multipliers = multipliers[np.isfinite(multipliers)]
            multipliers /= np.maximum(np.abs(multipliers) / out, 1.0)
            share = (row[key.name] - low) / (high - low or 1.0)
            colour = matplotlib.colormaps["viridis"](share)
            drawn.append(dots(multipliers.real, multipliers.imag, "o", colour, 1.5 + 2.0 * share))
        for row in branch.events:
            pair = np.exp(1j * number_of(row, "angle_rad") * np.array([1.0, -1.0]))
            drawn.append(dots(pair.real, pair.imag, EVENTS[row["kind"]], INK, 5.5, filled=False))
        span = f"{number(branch.at.min())} to {number(branch.at.max())}"
        title = f"branch {branch.name}, {plain(key.head)} {span}"
        panels.append(Panel(drawn, r"Re $\mu$ (–)", r"Im $\mu$ (–)", title, **square))
    rows = batched(panels, 3)
    caption = (
        f"The largest multipliers of each orbit and the unit circle; {key.head} from {number(low)} (small, violet) to "
        f"{number(high)} (large, yellow). Open marks: events. Moduli above {number(out, 2)} are drawn at this value."
    )
    alt = f"Complex plane: {listed(panel.title for panel in panels)}."
    yield Heading("Multipliers")
    yield Figure(curves(rows, 2.6 * len(rows), share="xy"), caption, alt)


def _warnings(folder: Folder, key: Column, branches: Sequence[Branch]) -> Notice:
    """What is incomplete or inaccurate: changes of stability, ends of branches, events, multipliers, failed rows."""
    followed, events = folder.part("branches").table, folder.part("events").table
    lines = []
    for branch in branches:
        places = [number(branch.at[place]) for place in branch.changes if not branch.kinds[place]]
        if places:
            lines.append(f"Branch {branch.name} changes its stability at {listed(places)}: no event was located there.")
    for row in followed:
        for end in (row["begins"], row["ends"]):
            if end and not end.startswith(WHOLE_BRANCH):
                lines.append(f"Branch {row['branch']} was not followed to its end: {end}.")
    coarse = []
    for row in events:
        if _coarse(row, key.name):
            coarse.append(f"{row['kind']} of branch {row['branch']} at {decimals(number_of(row, key.name), 4)}")
    if coarse:
        lines.append(f"Known to no better than {number(_ACCURATE)}: {listed(coarse)}.")
    unsure = []
    for row in (*folder.table, *folder.part("orbits").table):
        if _unsure(row):
            unsure.append(f"{row['branch']} at {number(row[key.name])}")
    if unsure:
        lines.append(f"Stable or not within the error of a multiplier: branch {listed(dict.fromkeys(unsure))}.")
    for row in (*folder.table, *events, *followed):
        if row["status"] != "ok":
            lines.append(f"{_named(row)}: {row['status']}; {row['message']}.")
    return limits("What limits these orbits", dict.fromkeys(lines), _COMPLETE)


def _named(row: Row) -> str:
    """The branch, motion or period of a row that failed."""
    for name in ("branch", "motion", "period"):
        if row.get(name, ""):
            return f"{name.capitalize()} {row[name]}"
    return "An orbit"


def _unsure(row: Row) -> bool:
    """Whether a multiplier of a row is no farther from the unit circle than its error."""
    return any(abs(abs(_complex(row, k)) - 1.0) <= number_of(row, f"multiplier_{k}_error") for k in _SHOWN)
