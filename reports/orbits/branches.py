"""The branches of a folder of orbits as its report sees them: values along each, events between, what is stable."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import cycle, groupby, pairwise

import numpy as np

from tables import PEAK, any_rows, number_of

from ..figures.curves import COLOURS, Curve
from ..parts.folder import Folder, part_of
from ..parts.style import INK
from ..sweep.quantities import colours_of, series

EVENTS = {"fold": "D", "flip": "s", "torus": "^"}  # kinds, with their marks
DASHED = (0, (3.5, 1.5))
MODULUS = "multiplier_modulus"
Row = Mapping[str, object]


@dataclass(frozen=True, eq=False)
class Branch:
    """One branch: m points along it are its orbits and, between them, its events.

    orbits, events: rows of the tables. at (m,): of the key. seen: "strobes" (m, N), r in m; "peak" (m, 1), largest
    tension in kN; "modulus" (m, 1), of the first multiplier. kinds (m,): of events, "" for an orbit. stable (m - 1,):
    whether it is from one point to the next.
    """

    name: str
    orbits: Sequence[Row]
    events: Sequence[Row]
    colour: str
    at: np.ndarray
    seen: Mapping[str, np.ndarray]
    kinds: np.ndarray
    stable: np.ndarray

    @property
    def changes(self) -> np.ndarray:
        """Points at which it becomes stable or unstable; at an event that was located, or at an orbit."""
        return np.flatnonzero(self.stable[1:] != self.stable[:-1]) + 1

    def lines(self, what: str) -> Iterator[Curve]:
        """What is seen over the key: solid where the orbits are stable, dashed where they are not."""
        first = 0
        for stable, group in groupby(self.stable):
            part = slice(first, first + len(list(group)) + 1)
            first = part.stop - 1
            x, y = (np.pad(one, ((0, 1), (0, 0)), constant_values=np.nan) for one in self._points(what, part))
            look = {"line": "-", "width": 1.3} if stable else {"line": DASHED, "width": 0.9}
            yield Curve(x.T.ravel(), y.T.ravel(), colour=self.colour, **look)

    def marks(self, what: str) -> Iterator[Curve]:
        """The same at the events."""
        for kind, mark in EVENTS.items():
            x, y = self._points(what, self.kinds == kind)
            yield Curve(x.ravel(), y.ravel(), line="", mark=mark, colour=INK, size=3.4)

    def _points(self, what: str, part) -> tuple[np.ndarray, np.ndarray]:
        y = self.seen[what][part]
        return np.broadcast_to(self.at[part][:, None], y.shape), y


def rows_of(folder: Folder, name: str) -> tuple[Row, ...]:
    """The table of a part of the folder, empty where it was left out."""
    part = part_of(folder, name)
    return part.table if part else ()


def read_branches(folder: Folder, key: str, motions: Sequence[Row]) -> list[Branch]:
    """The branches, each in the colour of the motion on it; one that begins at an event of another has its colour."""
    letters = {row["branch"]: row["motion"].partition(" ")[0] for row in rows_of(folder, "branches")}
    events = [row for row in rows_of(folder, "events") if np.isfinite(row[key])]
    parents, strobes = {row["leads_to"]: row["branch"] for row in events if row["leads_to"]}, {}
    for row in any_rows(folder.directory / "strobes.csv"):
        strobes.setdefault((row["branch"], int(row["place"])), []).append(float(row["radius_m"]))
    of_motions, left, colours, found = colours_of(motions), cycle(COLOURS), {}, []
    for name in dict.fromkeys(row["branch"] for row in folder.table):
        own = [row for row in folder.table if row["branch"] == name and (name, row["place"]) in strobes]
        own.sort(key=lambda row: row["place"])
        events_of = [row for row in events if row["branch"] == name]
        colour = of_motions.get(letters.get(name)) or colours.get(parents.get(name)) or next(left)
        colours[name] = colour
        if own:
            points = np.array([strobes[name, row["place"]] for row in own])
            found.append(Branch(name, own, events_of, colour, *_with_events(own, events_of, key, points)))
    return found


def _with_events(orbits: Sequence[Row], events: Sequence[Row], key: str, strobes: np.ndarray) -> tuple:
    """at, seen, kinds and stable of a `Branch`: an event stands between the two orbits whose chord is nearest."""
    steady = [row["unstable"] == 0 for row in orbits]
    table = np.column_stack([*(series(orbits, name) for name in (key, PEAK, MODULUS)), strobes])
    nodes = [(float(place), "", steady[place], row) for place, row in enumerate(table)]
    for event in events if len(table) > 1 else ():
        where = np.array([number_of(event, key), number_of(event, PEAK)])
        place, share = _nearest(table[:, :2], where)
        changes = [one != other for one, other in pairwise(steady)]
        for beside, at in ((place + 1, 0.0), (place - 1, 1.0)):  # what another accuracy moves to the chord beside
            if not changes[place] and 0 <= beside < len(changes) and changes[beside]:
                place, share = beside, at
                break
        sides, row = steady[place : place + 2], (1.0 - share) * table[place] + share * table[place + 1]
        row[:2] = np.where(np.isfinite(where), where, row[:2])
        row[2] = row[2] if all(sides) or not any(sides) else 1.0
        nodes.append((place + 0.001 + 0.998 * share, event["kind"], any(sides), row))
    _, kinds, stable, rows = map(np.array, zip(*sorted(nodes, key=lambda node: node[0]), strict=True))
    seen = {"strobes": rows[:, 3:], "peak": 1e-3 * rows[:, 1:2], "modulus": rows[:, 2:3]}
    return rows[:, 0], seen, kinds, stable[1:] & stable[:-1]


def _nearest(points: np.ndarray, where: np.ndarray) -> tuple[int, float]:
    """(i, share of the way from point i to the next) of the chord of points (m, 2) that is nearest to `where` (2,)."""
    scale = np.maximum(np.ptp(points, axis=0), 1e-12)
    starts, ways = points[:-1] / scale, np.diff(points / scale, axis=0)
    off = np.nan_to_num(where / scale - starts)
    share = np.clip((off * ways).sum(axis=1) / np.maximum((ways**2).sum(axis=1), 1e-24), 0.0, 1.0)
    place = int(np.argmin(((off - share[:, None] * ways) ** 2).sum(axis=1)))
    return place, float(share[place])
