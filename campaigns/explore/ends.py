"""Where the range of a motion ends, by bisection; whether a motion stays at a tighter tolerance and on a finer grid."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

from analysis import distance
from campaigns.explore.motions import CARRIED, DOWN, MOTION, UP, Motion, Motions, write_part
from campaigns.explore.starts import Ending, Request, Start
from engine.scene.finer import finer
from tables import MESSAGE, RUN_KEY, SHEET, STATUS, Column, Columns, Row, of_words, typed

SHARPNESS = 128.0  # a range is known to this part of the whole sweep
MOST = 320  # wave periods of a bisection: near its end a motion settles slowly
LEADS_TO = of_words("leads_to", "letter of the motion that it becomes there; empty where none settled", "leads to")
_EXACT = "where the motion ends, by its orbit, which stops being stable there; empty where no orbit tells it"
SHIFTED = 0.01  # of a value: by what the tolerance of a sweep may move an end
FOLDER = "ends"
KIND = of_words("kind", "what ends it: fold, flip or torus point of its orbit; empty: not known", "by")
NO_ORBIT = Column("no_orbit", "", "no orbit", "why no orbit tells where the motion ends", None, SHEET)
BEYOND = 2.0  # widths of the bisected range, beyond it, in which an orbit is followed
END = of_words("end", "lower or upper end of the range of the motion")
TIGHTER, FINER = "a tenth of the tolerance", "{} nodes"


@dataclass(eq=False)
class _End:
    """An end of the range of a motion, being bisected.

    motion, step: the motion at the end, and UP or DOWN.
    inside, state: the last value with the motion, and its state there.
    outside, successor: the first value without it, and the motion that it becomes there; None: none that settled.
    row: columns on the last run of the bisection.
    """

    motion: Motion
    step: int
    inside: float
    outside: float
    state: object
    successor: Motion | None
    row: dict

    def middle(self) -> float:
        return float(f"{0.5 * (self.inside + self.outside):.12g}")

    def columns(self, key: Column) -> Row:
        """Those that do not come from an orbit."""
        return {
            "motion": self.motion.branch.letter,
            "end": {UP: "upper", DOWN: "lower"}[self.step],
            f"{key.name}_with": self.inside,
            f"{key.name}_without": self.outside,
            "leads_to": self.successor and self.successor.branch.letter,
            **self.row,
        }


def columns(key: Column) -> Columns:
    """Of the table of ends of a sweep over this key."""
    digits = key.digits and 5
    with_name, without_name = f"{key.name}_with", f"{key.name}_without"
    error = (
        "of the end: its largest change over three sequences of steps and those of its neighbours; where the end "
        "lies outside the two values between which runs found it, at least the distance to them; without tolerance and "
        "grid, which `campaigns.orbits` has"
    )
    return (
        MOTION,
        END,
        Column(with_name, key.unit, f"{key.symbol} with", "last value at which the motion was found", digits),
        Column(without_name, key.unit, f"{key.symbol} without", "first value at which it was not", digits),
        replace(key, name=f"{key.name}_end", symbol=f"{key.symbol} end", digits=digits, meaning=_EXACT),
        Column("error", key.unit, f"± {key.symbol}", error, 5),
        KIND,
        NO_ORBIT,
        LEADS_TO,
        RUN_KEY,
        STATUS,
        MESSAGE,
    )


def find_ends(motions: Motions, scene_at: Callable, exact: bool = True) -> list[Row]:
    """The ends of all branches of a sweep, each bisected with the state of its motion; rows of `columns`.

    scene_at: the scene of a value; None where there is none, as between two whole numbers.
    exact: whether orbits are followed to the ends, which they tell better than the bisection.
    Writes ends/table.csv. Raises as `runner.run`.
    """
    (key,) = motions.keys
    values = [job.labels[key.name] for job in motions.jobs]
    ends = [*_ends_of(motions, values)]
    width = (max(values) - min(values)) / SHARPNESS
    while True:
        wide = [end for end in ends if _is_wide(end, width, scene_at)]
        if not wide:
            break
        requests = []
        for end in wide:
            start = motions.fine(end.motion.place, Start(CARRIED[end.step], state=end.state.at_zero()))
            requests.append(Request({key.name: end.middle()}, scene_at(end.middle()), start, most=MOST))
        for end, ending in zip(wide, motions.starts.run("ends of ranges", requests), strict=True):
            _narrow(motions, end, ending)
    of_orbits = by_orbits(motions, values, ends, scene_at) if exact else {}
    rows = [{**end.columns(key), **of_orbits.get(end, {})} for end in ends]
    write_part(motions.plan, FOLDER, columns(key), rows)
    return rows


def _ends_of(motions: Motions, values: Sequence[float]) -> Iterator[_End]:
    for branch in motions.branches():
        for motion, step in ((branch[0], DOWN), (branch[-1], UP)):
            neighbour = motion.place + step
            if motion.state is None or not 0 <= neighbour < len(values):
                continue
            successor, row = motion.becomes.get(neighbour), {"status": "ok"}
            if successor is None:
                row = {"status": "unsettled", "message": "carried on it did not settle"}
            yield _End(motion, step, values[motion.place], values[neighbour], motion.state, successor, row)


def _is_wide(end: _End, width: float, scene_at: Callable) -> bool:
    """Whether an end is to be bisected further, and can be."""
    wide = abs(end.outside - end.inside) > width and end.row["status"] == "ok"
    return wide and scene_at(end.middle()) is not None


def _narrow(motions: Motions, end: _End, ending: Ending) -> None:
    """Move a side of an end to the middle: to which side the motion there belongs, the nearest of both values says."""
    end.row = {name: ending.row.get(name) for name in ("run_key", "status", "message")}
    if ending.settled is None:
        if ending.row["status"] == "ok":
            end.row |= {"status": "unsettled", "message": f"not settled at {end.middle():g} after {MOST} periods"}
        return
    place = end.motion.place
    ending.motion = nearest(ending.settled, [*motions.at[place], *motions.at[place + end.step]])
    if ending.motion.branch is end.motion.branch:
        end.inside, end.state = end.middle(), ending.state
    else:
        end.outside, end.successor = end.middle(), ending.motion


def nearest(settled, motions: Sequence[Motion]) -> Motion:
    """The motion that is nearest to what a start has settled to."""
    return min(motions, key=lambda motion: distance(settled, motion.settled))


def by_orbits(motions: Motions, values: Sequence[float], ends: Sequence[_End], scene_at: Callable) -> dict[_End, Row]:
    """The columns of the ends at which an orbit stops being stable, as the bisection says; of the others, why not.

    The orbit is followed from the last value of the sweep with the motion. Raises CampaignStopped.
    """
    from campaigns.explore.tracing import Line, line_task, lost, work

    (key,), span, tasks = motions.keys, max(values) - min(values), {}
    for end in ends:
        period = end.motion.settled.period
        if period and end.row["status"] == "ok":
            value, state = values[end.motion.place], end.motion.state
            low, high = sorted((value, end.outside + BEYOND * (end.outside - end.inside)))
            line = Line(scene_at, low, high, span, state, value)
            tasks[end] = line_task(lost, line, (period, float(end.step), value, state, end.inside, end.state))
    title, folder = "ends of ranges by their orbits", motions.plan.out / FOLDER
    results, _ = work(motions.plan, folder, title, list(tasks.values()))
    exact = {}
    for end, (result, _) in zip(tasks, results, strict=True):
        if result["reason"]:
            exact[end] = {NO_ORBIT.name: result["reason"]}
            continue
        width, value = abs(end.outside - end.inside), result["value"]
        from_middle = abs(value - 0.5 * (end.inside + end.outside))
        if from_middle > max(BEYOND * width, SHIFTED * abs(end.inside)):
            # an orbit may double its period before its motion ends
            exact[end] = {NO_ORBIT.name: f"its orbit has the next {result['kind']} at {value:.5g}"}
            continue
        error = result["error"]
        if error is not None:
            error = max(error, from_middle - 0.5 * width)
        exact[end] = {f"{key.name}_end": value, "error": error, "kind": result["kind"]}
    return exact


def confirm(motions: Motions) -> None:
    """Let every branch go on, from its state of the largest tension, at a tenth of the tolerance and on a finer grid.

    The words of `Motion.confirmed` of the branch say what it becomes. Raises as `runner.run`.
    """
    requests, chosen = [], []
    for branch in motions.branches():
        motion = max(branch, key=lambda motion: motion.tension_N)
        if motion.state is None:
            continue
        scene = motions.jobs[motion.place].scene
        changed = {TIGHTER: finer(scene, steps=10), FINER.format(2 * scene.tether.nodes - 1): finer(scene, elements=2)}
        for change, changed_scene in changed.items():
            start = motions.fine(motion.place, Start(change, state=motion.state.at_zero()))
            requests.append(motions.request(motion.place, start, changed_scene))
            chosen.append((motion, change))
    words = {}  # by motion
    for (motion, change), ending in zip(chosen, motions.starts.run("motions confirmed", requests), strict=True):
        if ending.joins is not None:
            ending.motion = motions.at[motion.place][ending.joins]
        elif ending.settled is not None:
            ending.motion = nearest(ending.settled, motions.at[motion.place])
        words.setdefault(motion, []).append(_confirmation(motion, change, ending.motion))
    for motion, sentences in words.items():
        (value,) = motions.name_of(motion.place).values()
        motion.branch.confirmed = f"{' and '.join(sentences)}, checked at {typed(value)}"


def _confirmation(motion: Motion, change: str, result: Motion | None) -> str:
    """What a motion becomes with a change of the numerical method, in words."""
    if result is motion and change == TIGHTER:
        return f"at {change}"
    if result is motion:
        return f"on {change}"
    if result is not None:
        return f"NOT with {change}, where it becomes {result.branch.letter}"
    return f"not settled with {change}"
