"""The report of `campaigns.orbits`: what is said, in which order. Everything comes from the campaign's folder."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np

from engine.views import strobed_radius
from tables import EMPTY, Column, any_rows, count, decimals, listed, number, number_of

from ..buoy_sweep.motions import MARKS
from ..figures.curves import Curve, Panel, curves
from ..figures.orbit_diagram import NARROW_IN, orbit_diagram
from ..parts.columns import table_of
from ..parts.content import Figure, Heading, Item, Notice, Report, Table, heads, plain
from ..parts.folder import Folder, FolderError, part_of, read_folder
from ..parts.provenance import appendix, provenance_items, scene_items, timing_items
from ..parts.sections import section_items
from ..parts.style import INK, SOFT, WIDTH_IN
from ..sweep.quantities import colours_of, in_order, series
from .branches import DASHED, EVENTS, MODULUS, PEAK, Branch, Row, read_branches, rows_of

_NEEDED = ("branch", "place", "period", "unstable", MODULUS, PEAK, "status", "message")
_ACCURATE = 2e-4  # of an event, and of its value where that is above 1
_WHOLE = "reaches", "comes back", "meets"  # how a branch ends that was followed to its end
_SHOWN = range(1, 5)  # multipliers
_FAR, _OUT = 3.0, 2.0  # modulus, over the key and in the plane, at which a drawing ends
_NOWHERE = np.full(1, np.nan)
_EVENT = ("branch", "kind", "finer", "angle_rad", PEAK, "leads_to", "message")
_BRANCH = ("branch", "period", "motion", "orbits", "closed", "begins", "ends", "message")
_EVENTS = f"Events along the branches. ‡: error above {number(_ACCURATE)}. †: not found on a finer grid."


def report(directory: str | Path) -> Report:
    """The content of the report on a folder of orbits. Raises FolderError for a folder that is not one."""
    folder = read_folder(directory, _NEEDED)
    named = [str(word) for word in folder.provenance.get("vary") or ()][:1]
    key = next((folder.columns[one] for word in named for one in (word, word.rpartition(".")[2])
                if one in folder.columns), None)  # fmt: skip
    if key is None:
        raise FolderError(folder.directory, ["provenance.json cannot be read: it does not name what was varied"])
    motions = [row for row in rows_of(folder, "motions") if row["status"] == "ok"]
    branches = read_branches(folder, key.name, motions)
    located = partial(_located, key=key.name)
    items = [
        *(_diagram(folder, key, branches, motions) if branches else ()),
        *_told(folder, "events", (*_EVENT[:2], key.name, *_EVENT[2:]), _EVENTS, **{key.name: located}),
        *section_items("orbits", "Question"),
        Heading("Warnings"),
        _warnings(folder, key, branches),
        *_chosen(folder, key, branches),
        *(_multipliers(key, branches) if branches else ()),
        Heading("Branches"),
        *_told(folder, "branches", _BRANCH, "The branches, and why each ends both ways."),
        *appendix(
            *timing_items(folder),
            *scene_items(folder.scene, str(folder.provenance.get("scene") or folder.scene.name), {}),
            *provenance_items(folder),
        ),
    ]
    title = f"Periodic orbits over {plain(key.head)}, stable and unstable"
    return Report(title, folder.scene.title or folder.scene.name, tuple(items))


def _diagram(folder: Folder, key: Column, branches: Sequence[Branch], motions: Sequence[Row]) -> Iterator[Item]:
    """Branches over the strobed points of the motions, with tension and multiplier below."""
    colours, part, columns, simulated, named = colours_of(motions), part_of(folder, "motions"), [], [], {}
    for row in in_order(motions, [key.name]):
        run, _ = part.trajectory(row)
        points = strobed_radius(run, int(row.get("transient_periods") or 0))[:, 0] if run is not None else np.empty(0)
        columns.append(Column(row[key.name], points, row.get("regime") or "", row["motion"] if colours else ""))
    for (letter, colour), mark in zip((colours or {"": INK}).items(), MARKS, strict=False):
        own = [row for row in motions if not colours or row["motion"] == letter]
        x, y = series(own, key.name), 1e-3 * series(own, PEAK)
        simulated.append(Curve(x, y, "", "", mark, colour, size=2.8))
        if letter:
            named[letter] = (colour, f"up to {number(np.nanmax(y), 3)} kN")
    met = Counter(str(kind) for one in branches for kind in one.kinds if kind)
    looks = (("stable orbit", "-", ""), ("unstable orbit", DASHED, ""), *((one, "", EVENTS[one]) for one in met))
    legend = [Curve(_NOWHERE, _NOWHERE, name, line, mark, INK, size=3.4) for name, line, mark in looks]
    lines = {what: [line for one in branches for line in one.lines(what)] for what in branches[0].seen}
    for what, drawn in lines.items():  # marks stand over all lines
        drawn += [mark for one in branches for mark in one.marks(what)]
    lines["modulus"] += [_scatter(one, key) for one in branches]
    top, far = (float(max(np.nanmax(one.seen[what]) for one in branches)) for what in ("peak", "modulus"))
    top = max(top, *(float(np.nanmax(curve.y, initial=0.0)) for curve in simulated))
    texts = [*_texts(branches, 0.14 * top)]
    axis = {"ylim": (0.0, 1.25 * top)}
    below = [
        Panel([*simulated, *lines["peak"]], y_label="largest T\n(kN)", settings=axis, texts=texts, height=1.5),
        Panel(lines["modulus"], y_label=r"$|\mu|$ (–)", level=1.0, settings={"ylim": (0.0, min(1.05 * far, _FAR))}),
    ]
    told, over = (columns, (key.label, "strobed r (m)"), below), [*lines["strobes"], *legend]
    pictures = [
        orbit_diagram(*told, width_in=wide, motions=named or None, orbits=over) for wide in (WIDTH_IN, NARROW_IN)
    ]
    caption = (
        "Lines: r of each orbit once a wave period, solid where it is stable, dashed where no run stays on it. Dashes "
        "and small dots: the motions that runs have found, in the same colours (`motions/table.csv`). Below: largest "
        f"tension; modulus of the largest multiplier, with its error{f', up to {number(_FAR)}' if far > _FAR else ''}."
    )
    events = listed(count(many, kind, "torus points" if kind == "torus" else "") for kind, many in met.items())
    alt = f"Orbit diagram with {count(len(branches), 'branch', 'branches')} of orbits and {events}; see text."
    yield Figure(pictures[0], caption, alt, narrow=pictures[1])


def _scatter(branch: Branch, key: Column) -> Curve:
    """The errors of the modulus along a branch, as bars."""
    at, modulus, error = (series(branch.orbits, name) for name in (key.name, MODULUS, "multiplier_1_error"))
    return Curve(at, modulus, line="", colour=branch.colour, error=error)


def _texts(branches: Sequence[Branch], aside: float) -> Iterator[tuple[float, float, str, str]]:
    """Beside the tension: the names of the branches, and the values at which one becomes stable or unstable."""
    changes = []
    for one in branches:
        at, peak = one.at, one.seen["peak"][:, 0]
        middle = int(np.argmin(np.abs(at - 0.5 * (at.min() + at.max())) - 0.01 * peak))
        yield at[middle], peak[middle] + aside, one.name, one.colour
        changes += [(at[k], peak[k]) for k in one.changes if one.kinds[k]]
    for place, (value_there, pull) in enumerate(sorted(changes)):
        yield value_there, pull + (-aside if place % 2 else aside), decimals(value_there, 4).lstrip("0"), INK


def _told(folder: Folder, part: str, wanted: Sequence[str], caption: str, **own: Callable[[Row], str]) -> list[Item]:
    """The table of a part of the folder, with those of the columns that say something; nothing without a row."""
    rows = rows_of(folder, part)
    names = [one for one in wanted if any(row.get(one, "") not in ("", 0.0) and row[one] == row[one] for row in rows)]
    return [table_of(part_of(folder, part).columns, names, rows, caption, own)] if rows else []


def _located(row: Row, key: str) -> str:
    """ "0.12371 ± 0.00003", with the marks of its caveats."""
    flags = "‡" * _coarse(row, key) + "†" * (not np.isfinite(number_of(row, "finer")))
    return f"{decimals(number_of(row, key), 5)}\u00a0±\u00a0{number(number_of(row, 'error'), 1)}{flags}"


def _coarse(row: Row, key: str) -> bool:
    return not number_of(row, "error") <= _ACCURATE * max(1.0, abs(number_of(row, key)))


def _chosen(folder: Folder, key: Column, branches: Sequence[Branch]) -> Iterator[Item]:
    """The orbits themselves at the value that has most of them, and the multipliers of all that were chosen."""
    rows, plane, pull = rows_of(folder, "orbits"), [], []
    if not rows:
        return
    at = Counter(row[key.name] for row in rows).most_common(1)[0][0]
    colours = colours_of(rows_of(folder, "motions")) | {one.name: one.colour for one in branches}
    for row in (row for row in rows if row[key.name] == at):
        history = any_rows(folder.directory / "orbits" / f"{row['branch']}_{row['place']}.csv")
        which = row["branch"] or row["motion"]  # an orbit whose branch could not be followed
        name = f"{'branch' if row['branch'] else 'motion'} {which}, {'un' if row['unstable'] else ''}stable"
        look = {"line": DASHED if row["unstable"] else "-", "colour": colours.get(which, INK), "width": 1.2}
        closed = (series([*history, *history[:1]], one) for one in ("radius_m", "radius_rate_mps"))
        plane.append(Curve(*closed, name, **look))
        time = series(history, "time_s")
        pull.append(Curve(row["period"] * time / time[-1], 1e-3 * series(history, "tension_top_N"), name, **look))
    yield Heading("Orbits")
    panels = Panel(plane, "r (m)", "dr/dt (m/s)"), Panel(pull, "time (wave periods)", "T at the top (kN)", level=0.0)
    caption = f"Orbits at {key.head} = {number(at)}: radial speed over r, and tension over one round (`orbits/`)."
    yield Figure(curves([panels], 3.0, "below", widths=(1.0, 1.3)), caption, f"{listed(one.name for one in plane)}.")
    columns = heads("branch", (key.head, key.unit), *((f"μ{k}", "") for k in _SHOWN), ("gap", ""), "motion")
    body = (
        (row["branch"] or EMPTY, number(row[key.name]), *(_multiplier(row, k) for k in _SHOWN),
         number(row["gap"], 1), row["motion"] or EMPTY) for row in rows
    )  # fmt: skip
    caption = "Multipliers, the largest first; in brackets their errors: what other steps change. Gap: what is left of "
    yield Table(columns, tuple(body), f"{caption}the equation of the orbit.", small=True)


def _multiplier(row: Row, k: int) -> str:
    """ "−0.732 (0.007)", "0.155 + 0.446i (0.02)"."""
    real, imag, error = (number_of(row, f"multiplier_{k}_{name}") for name in ("real", "imag", "error"))
    beside = f" {'−' if imag < 0.0 else '+'} {decimals(abs(imag), 3)}i" if imag else ""
    return f"{decimals(real, 3)}{beside} ({number(error, 1)})" if np.isfinite(real) else EMPTY


def _multipliers(key: Column, branches: Sequence[Branch]) -> Iterator[Item]:
    low, high = (float(end(np.concatenate([one.at for one in branches]))) for end in (np.min, np.max))
    out = min(_OUT, max(1.2, *(float(np.nanmax(one.seen["modulus"])) for one in branches)))
    turn, panels = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 200)), []
    for one in branches:
        dots = [Curve(turn.real, turn.imag, colour=SOFT)]
        for row in one.orbits:
            mu = np.array(
                [number_of(row, f"multiplier_{k}_real") + 1j * number_of(row, f"multiplier_{k}_imag") for k in _SHOWN]
            )
            mu = mu[np.isfinite(mu)] / np.maximum(np.abs(mu[np.isfinite(mu)]) / out, 1.0)
            share = (row[key.name] - low) / (high - low or 1.0)
            look = {"colour": matplotlib.colormaps["viridis"](share), "size": 1.5 + 2.0 * share}
            dots.append(Curve(mu.real, mu.imag, line="", mark="o", **look))
        for row in one.events:
            turned = np.exp(1j * number_of(row, "angle_rad") * np.array([1.0, -1.0]))
            dots.append(Curve(turned.real, turned.imag, "", "", EVENTS[row["kind"]], INK, size=5.5, filled=False))
        settings = {"aspect": "equal", "xlim": (-1.05 * out, 1.05 * out), "ylim": (-1.05 * out, 1.05 * out)}
        title = f"branch {one.name}, {plain(key.head)} {number(one.at.min())} to {number(one.at.max())}"
        panels.append(Panel(dots, r"Re $\mu$ (–)", r"Im $\mu$ (–)", title, settings=settings))
    rows = [panels[first : first + 3] for first in range(0, len(panels), 3)]
    caption = (
        f"The largest multipliers of each orbit and the unit circle; {key.head} from {number(low)} (small, violet) to "
        f"{number(high)} (large, yellow). Open marks: events. Moduli above {number(out, 2)} are drawn as that."
    )
    yield Heading("Multipliers")
    yield Figure(
        curves(rows, 2.6 * len(rows), share="xy"), caption, f"Complex plane: {listed(p.title for p in panels)}."
    )


def _warnings(folder: Folder, key: Column, branches: Sequence[Branch]) -> Notice:
    ended, events, lines = rows_of(folder, "branches"), rows_of(folder, "events"), []
    for one in branches:
        if missed := [number(one.at[k]) for k in one.changes if not one.kinds[k]]:
            lines.append(f"Branch {one.name} changes its stability at {listed(missed)}: no event was located there.")
    for row in ended:
        ends = (row[end] for end in ("begins", "ends") if row[end] and not row[end].startswith(_WHOLE))
        lines += [f"Branch {row['branch']} was not followed to its end: {end}." for end in ends]
    if coarse := [row for row in events if _coarse(row, key.name)]:
        at = listed(
            f"{row['kind']} of branch {row['branch']} at {decimals(number_of(row, key.name), 4)}" for row in coarse
        )
        lines.append(f"Known to no better than {number(_ACCURATE)}: {at}.")
    orbits = *folder.table, *rows_of(folder, "orbits")
    if unsure := dict.fromkeys(f"{row['branch']} at {number(row[key.name])}" for row in orbits if _unsure(row)):
        lines.append(f"Stable or not within the error of a multiplier: branch {listed(unsure)}.")
    failed = (row for row in (*folder.table, *events, *ended) if row["status"] != "ok")
    for row in failed:
        known = (f"{name.capitalize()} {row[name]}" for name in ("branch", "motion", "period") if row.get(name, ""))
        which = next(known, "An orbit")
        lines.append(f"{which}: {row['status']}; {row['message']}.")
    if not lines:
        return Notice("note", "Nothing to warn of", ("Every branch was followed to its end, every event is accurate.",))
    return Notice("warning", "What limits these orbits", tuple(dict.fromkeys(lines)))


def _unsure(row: Row) -> bool:
    """Whether a multiplier is no farther from the unit circle than its error."""
    values = [[number_of(row, f"multiplier_{k}_{name}") for name in ("real", "imag", "error")] for k in _SHOWN]
    return any(abs(np.hypot(real, imag) - 1.0) <= error for real, imag, error in values)
