"""Scenes along a key, and tasks on their orbits: the orbit under a run, its branch, where it ends, an event again.

A task takes the `Line` first and returns plain numbers, words and lists, `reason` among them, and arrays of points.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path

import numpy as np

import engine
from analysis.orbits import doubled_orbit, find_orbit, follow_branch, middle_of
from campaigns.explore.grid import Varied
from campaigns.explore.multipliers import COUNT, TOLERANCE, cable_map
from campaigns.explore.multipliers import SOURCES as OF_ORBITS
from campaigns.machinery import Plan, Store, Task, key_of, made_by, results
from engine.scene import SceneError, scene_from_toml
from tables import finite

Solved = tuple[dict, list[np.ndarray]]  # result of a task, and points
SOURCES = *OF_ORBITS, "campaigns/explore/tracing.py"
STEPS = {"step": 0.05, "least": 2e-3, "longest": 0.3}  # of a branch: of what is seen, and shares of the range
SHORT, MOST_SHORT = STEPS | {"longest": 0.1}, 12  # to an event that is near
LOCATED = {"count": COUNT, "accuracy": 1e-2}  # of a chord, to which an event is: another grid changes it by more
AROUND, NEAREST = 3.0, 0.02  # an event is looked for again within this many chords, and this share of the range
HISTORY = "time_s", "radius_m", "radius_rate_mps", "angle_rad", "tension_top_N", "tension_min_N"
AMPLITUDE = 0.02, 0.1  # of what is seen, tried in turn, from an orbit at its flip to the one of twice the period


@dataclass(frozen=True)
class Scenes:
    """The scenes along one key. base: any of them."""

    base: object
    key: Varied

    def __call__(self, value: float, changes: dict | None = None):
        """The scene at a value, with further changes; None where there is none, as between two whole numbers."""
        changes = dict(changes or {})
        if any(self.key.put(value, self.base, changes)):
            return None
        try:
            return scene_from_toml(self.base.to_toml(), changes)
        except SceneError:
            return None

    def at(self, value: float, changes: dict | None = None):
        """The same. Raises ArithmeticError where there is none."""
        scene = self(value, changes)
        if scene is None:
            raise ArithmeticError(f"no scene can have {self.key.key} = {value:.4g}")
        return scene


@dataclass(frozen=True, eq=False)
class Line:
    """Scenes with the coordinates of their orbits, taken from a state of a run at a value.

    low, high: range in which orbits are followed; size: the change of the key that counts as 1 of what is seen; nodes:
    of another grid, 0 for that of the scenes; rtol: tolerance of the orbits, at most.
    """

    scenes: Scenes
    low: float
    high: float
    size: float
    state: object
    value: float
    nodes: int = 0
    rtol: float = TOLERANCE

    def scene(self, value: float):
        """The scene at a value, as its orbits are computed. Raises ArithmeticError where there is none."""
        base = self.scenes.base
        changes = {"solver.rtol": min(self.rtol, base.solver.rtol), "tether.nodes": self.nodes or base.tether.nodes}
        return self.scenes.at(value, changes)

    @cached_property
    def maps(self):
        """PeriodMap and OrbitMap."""
        return cable_map(self.scene, self.state, self.value, self.size)

    def digest(self) -> str:
        """Of all that results depend on beside their own task."""
        numbers = self.low, self.high, self.size, self.value, self.nodes, self.rtol
        sources = made_by(*SOURCES), engine.source_hash()
        return key_of(self.scenes.base.to_toml(), self.scenes.key.key, self.state, *numbers, *sources)


def line_task(do: Callable, line: Line, arguments: tuple) -> Task:
    """The task do(line, *arguments) -> (result, points). arguments: numbers, words, arrays, states."""
    return Task(key_of(do.__name__, line, *arguments), partial(_computed, do, line, arguments))


def _computed(do: Callable, line: Line, arguments: tuple) -> dict:
    """The result of a task and its points; where the orbits of a line fail, the result is the reason."""
    try:
        result, points = do(line, *arguments)
    except (ArithmeticError, ValueError) as why:
        result, points = {"reason": str(why)}, []
    return {"result": result, "points": points}


def work(plan: Plan, folder: Path, title: str, tasks: Sequence[Task]) -> tuple[list, int]:
    """Results of tasks with their points, in their order, and how many of them were there before.

    Raises CampaignStopped as `campaigns.machinery.tasks.results`.
    """
    finished = results(plan.how, Store(folder), title, tasks, spare=plan.spare)
    pairs = []
    for result in finished.results:
        pairs.append((result["result"], [np.array(points) for points in result["points"]]))
    return pairs, finished.reused


def under(line: Line, value: float, period: int, state: object) -> Solved:
    """The orbit under a run, or at a state (period, 8 n): its row, errors and history."""
    cable, system = line.maps
    if not isinstance(state, np.ndarray):
        state = cable.at_strobe(state, value)
    orbit, errors = middle_of(system, _found(system, state, value, period))
    row, history = _row(cable, orbit, errors)
    row["history"] = {name: history[name] for name in HISTORY}
    return row, [orbit.points]


def followed(line: Line, value: float, points: np.ndarray, most: int) -> Solved:
    """The branch of the orbit with these points (N, 8 n), with its events and what begins at its flips."""
    cable, system = line.maps
    orbit = _found(system, points, value, len(points))
    branch = follow_branch(system, orbit, line.low, line.high, **STEPS, most=most, **LOCATED)
    rows, points_of, events = [], [], []
    for followed_orbit in branch.orbits:
        middle, errors = middle_of(system, followed_orbit)
        rows.append(_row(cable, middle, errors)[0])
        points_of.append(middle.points)
    for event in branch.events:
        row, _ = _row(cable, event.orbit, event.orbit.residuals)
        row |= _where(event) | {"angle_rad": event.angle_rad, "at": len(points_of)}
        points_of.append(event.orbit.points)
        doubled = event.kind == "flip" and _doubled(system, event)
        if doubled:
            row |= {"doubled": len(points_of), "doubled_value": doubled.parameter}
            row["doubled_seen"] = doubled.points @ cable.seen
            points_of.append(doubled.points)
        events.append(row)
    ends = {"closed": branch.closed, "begins": branch.ends[0], "ends": branch.ends[1]}
    return {"orbits": rows, "events": events, **ends}, points_of


def _doubled(system, event):
    """The orbit of twice the period that begins at a flip; None where none is found."""
    for amplitude in AMPLITUDE:
        orbit = doubled_orbit(system, event, amplitude=amplitude, count=COUNT)
        if orbit.found:
            return orbit
    return None


def lost(line: Line, period: int, ahead: float, *starts: object) -> Solved:
    """Where the orbit under a run stops being stable: the first event from there on.

    ahead: 1 up, -1 down; starts: value, state, value, state ... of runs of that motion, tried in turn.
    """
    cable, system = line.maps
    why = "the orbit under the run is not stable"
    for value, state in zip(starts[::2], starts[1::2], strict=True):
        try:
            orbit = find_orbit(system, cable.at_strobe(state, value), value, period, count=COUNT)
        except ArithmeticError as reason:
            why = str(reason)
            continue
        if orbit.stable and orbit.period == period:
            break
        why = orbit.reason or why
    else:
        raise ArithmeticError(why)
    limits = {"most": MOST_SHORT, "enough": lambda orbit, _: not orbit.stable}
    branch = follow_branch(system, orbit, line.low, line.high, **STEPS, **limits, **LOCATED)
    events = [event for event in branch.events if (event.parameter - value) * ahead > 0.0]
    return _nearest(events, value, "the orbit stays stable"), []


def sharper(line: Line, kind: str, at: float, *orbits: float | np.ndarray) -> Solved:
    """Where an event that was found at `at` is at the tolerance of the line.

    orbits: value, points, value, points ... of orbits on its branch, tried in turn.
    """
    return _first_found(_event_near, line, kind, at, orbits)


def finer(line: Line, kind: str, at: float, *orbits: float | np.ndarray) -> Solved:
    """The same on 2n - 1 nodes."""
    return _first_found(_finer_event_near, line, kind, at, orbits)


def _first_found(find: Callable, line: Line, kind: str, at: float, orbits: Sequence) -> Solved:
    """What the first of the orbits leads to. Raises ArithmeticError, with the reason of the last, where none does:
    beside a fold an orbit may be gone at another tolerance or on another grid."""
    why = None
    for value, points in zip(orbits[::2], orbits[1::2], strict=True):
        try:
            return find(line, kind, at, value, points)
        except ArithmeticError as reason:
            why = reason
    raise ArithmeticError(str(why))


def _event_near(line: Line, kind: str, at: float, value: float, points: np.ndarray) -> Solved:
    """The event on the branch of the orbit near these points, at `value`."""
    system = line.maps[1]
    orbit = _found(system, points, value, len(points))
    wide = max(AROUND * abs(at - value), NEAREST * line.size)
    low, high = max(at - wide, line.low), min(at + wide, line.high)

    def has_event(_, events) -> bool:
        return any(event.kind == kind for event in events)

    limits = SHORT | LOCATED | {"most": MOST_SHORT, "enough": has_event}
    events = []
    towards = 1 if at > value else -1
    for ahead in (towards, -towards):
        branch = follow_branch(system, orbit, min(low, value), max(high, value), ahead=ahead, **limits)
        events += [event for event in branch.events if event.kind == kind]
        if any(abs(event.parameter - at) < abs(value - at) for event in events):
            break  # else it may have moved to the other side of the orbit
    return _nearest(events, at, f"no {kind} from {low:.5g} to {high:.5g}"), []


def _finer_event_near(line: Line, kind: str, at: float, value: float, points: np.ndarray) -> Solved:
    """The same on 2n - 1 nodes."""
    cable, _ = line.maps
    fine_line = replace(line, nodes=2 * line.scenes.base.tether.nodes - 1)
    # rates between nodes are no rates of the finer line: a run makes them, and leads to the strobe after the next
    states = []
    for z in points:
        run = engine.simulate(fine_line.scene(value), periods=1, start=cable.state_of(z, value))
        if run.final_state is None:
            raise ArithmeticError(f"on {fine_line.nodes} nodes: {run.message or run.status}")
        states.append(run.final_state)
    fine_line = replace(fine_line, state=states[-1], value=value)
    fine, _ = fine_line.maps
    fine_points = [fine.at_strobe(state, value) for state in states]
    return _event_near(fine_line, kind, at, value, np.roll(fine_points, 2, axis=0))


def _found(system, start, value: float, period: int):
    """The orbit near a start. Raises ArithmeticError where none is found."""
    orbit = find_orbit(system, start, value, period, count=COUNT)
    if not orbit.found:
        raise ArithmeticError(orbit.reason)
    return orbit


def _nearest(events, value: float, none: str) -> dict:
    """Where the event nearest to a value is. Raises ArithmeticError, with the words `none`, where there is none."""
    if not events:
        raise ArithmeticError(none)
    return _where(min(events, key=lambda event: abs(event.parameter - value)))


def _where(event) -> dict:
    return {"reason": "", "kind": event.kind, "value": event.parameter, "error": finite(event.error)}


def _row(cable, orbit, errors) -> tuple[dict, dict]:
    """An orbit in numbers and lists, and its history. errors: of its multipliers."""
    history = cable.history(orbit.points, orbit.parameter)
    per_period = len(history["time_s"]) // orbit.period
    row = {
        "reason": "",
        "value": orbit.parameter,
        "period": orbit.period,
        "multipliers": orbit.multipliers,
        "errors": [*map(finite, errors)],
        "gap": orbit.gap,
        "settled": orbit.settled,
        "strobes": history["radius_m"][::per_period],
        "seen": orbit.points @ cable.seen,
        "radius_m": [history["radius_m"].min(), history["radius_m"].max()],
        "tension_N": [history["tension_top_low_N"].min(), history["tension_top_high_N"].max()],
    }
    return row, history
