"""Where the range of a motion ends, by bisection; whether a motion stays at a tighter tolerance and on a finer grid."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from campaigns.explore.along import CARRIED, DOWN, MOTION, UP, Along, Motion
from campaigns.explore.starts import Asked, Ended, Start
from campaigns.machinery.long_runs import tighter_scene
from engine.scene import scene_from_toml
from tables import JOINED, MESSAGE, RUN_KEY, STATUS, Column, write_table

SHARPNESS = 128.0  # a range is known to this part of the whole sweep
MOST = 320  # wave periods of a bisection: near its end a motion settles slowly
LEADS_TO = Column(
    "leads_to", symbol="leads to", meaning="letter of the motion that it becomes there; empty where none settled"
)
_EXACT = "where the motion ends, by its orbit, which stops being stable there; empty where no orbit tells it"
SHIFTED = 0.01  # of a value: by what the tolerance of a sweep may move an end
KIND = Column("kind", symbol="by", meaning="what ends it: fold, flip or torus point of its orbit; empty: not known")
BEYOND = 2.0  # widths of the bisected range, beyond it, in which an orbit is followed
END = Column("end", symbol="end", meaning="lower or upper end of the range of the motion")
TIGHTER, FINER = "a tenth of the tolerance", "{} nodes"


@dataclass(eq=False)
class _End:
    """An end being bisected: the last value with the motion and its state there, the first without it."""

    motion: Motion
    step: int
    inside: float
    outside: float
    state: object
    becomes: Motion | None
    row: dict

    def middle(self) -> float:
        return float(f"{0.5 * (self.inside + self.outside):.12g}")

    def wide(self, along: Along, width: float) -> bool:
        """Whether it is to be bisected further, and can be: between two whole numbers there is none."""
        return (
            abs(self.outside - self.inside) > width
            and self.row["status"] == "ok"
            and along.scene_at(self.middle()) is not None
        )


def columns(key: Column) -> tuple[Column, ...]:
    """Of the table of ends of a sweep over this key."""
    return (
        MOTION,
        END,
        Column(
            f"{key.name}_with",
            key.unit,
            f"{key.symbol} with",
            "last value at which the motion was found",
            key.digits and 5,
        ),
        Column(
            f"{key.name}_without",
            key.unit,
            f"{key.symbol} without",
            "first value at which it was not",
            key.digits and 5,
        ),
        replace(key, name=f"{key.name}_end", symbol=f"{key.symbol} end", digits=key.digits and 5, meaning=_EXACT),
        Column("error", key.unit, f"± {key.symbol}", "of the end: its largest change over three sequences of steps", 5),
        KIND,
        LEADS_TO,
        RUN_KEY,
        STATUS,
        MESSAGE,
    )


def bisect(along: Along) -> list[dict[str, object]]:
    """The ends of all branches within the sweep, each bisected with the state of its motion; rows of `columns`.

    Writes ends/table.csv. Raises as `runner.run`.
    """
    ends = [*_ends_of(along)]
    width = (max(along.values) - min(along.values)) / SHARPNESS
    while wide := [end for end in ends if end.wide(along, width)]:
        asked = [
            Asked(
                {along.key.name: end.middle()},
                along.scene_at(end.middle()),
                along.fine(end.motion.at, Start(CARRIED[end.step], state=end.state.at_zero())),
                most=MOST,
            )
            for end in wide
        ]
        for end, found in zip(wide, along.starts.run("ends of ranges", asked), strict=True):
            _narrow(along, end, found)
    rows, exact = [], by_orbits(along, ends)
    for end in ends:
        found = end.becomes.branch.letter if end.becomes is not None else None
        sides = {f"{along.key.name}_with": end.inside, f"{along.key.name}_without": end.outside}
        which = {"motion": end.motion.branch.letter, "end": "upper" if end.step == UP else "lower"}
        rows.append({**which, **sides, **exact.get(end, {}), "leads_to": found, **end.row})
    (along.plan.how.out / "ends").mkdir(exist_ok=True)
    write_table(along.plan.how.out / "ends" / "table.csv", columns(along.key), rows)
    return rows


def by_orbits(along: Along, ends: Sequence[_End]) -> dict[_End, dict[str, object]]:
    """The columns of the ends at which an orbit stops being stable, as the bisection says; the others have none.

    The orbit is followed from the last value of the sweep with the motion. Raises CampaignStopped.
    """
    from campaigns.explore.orbit_tasks import lost
    from campaigns.explore.tracing import Line, line_task, work

    span, tasks = max(along.values) - min(along.values), {}
    for end in ends:
        period = end.motion.settled.period
        if period and end.row["status"] == "ok":
            value, state = along.values[end.motion.at], end.motion.state
            low, high = sorted((value, end.outside + BEYOND * (end.outside - end.inside)))
            line = Line(along.scene_at, low, high, span, state, value)
            tasks[end] = line_task(lost, line, (period, float(end.step), value, state, end.inside, end.state))
    results, _ = work(along.plan, along.plan.how.out / "ends", "ends of ranges by their orbits", list(tasks.values()))
    found = {}
    for end, (result, _) in zip(tasks, results, strict=True):
        # an orbit may double its period before its motion ends
        near = max(BEYOND * abs(end.outside - end.inside), SHIFTED * abs(end.inside))
        if not result["reason"] and abs(result["value"] - 0.5 * (end.inside + end.outside)) <= near:
            found[end] = {f"{along.key.name}_end": result["value"], "error": result["error"], "kind": result["kind"]}
    return found


def _ends_of(along: Along) -> Iterator[_End]:
    for branch in along.branches():
        for motion, step in ((branch[0], DOWN), (branch[-1], UP)):
            there = motion.at + step
            if 0 <= there < len(along.values) and motion.state is not None:
                becomes = motion.led.get(there)
                row = (
                    {"status": "ok"} if becomes else {"status": "unsettled", "message": "carried on it did not settle"}
                )
                yield _End(motion, step, along.values[motion.at], along.values[there], motion.state, becomes, row)


def _narrow(along: Along, end: _End, found: Ended) -> None:
    """Move a side of an end to the middle: to which side the motion there belongs, the nearest of both values says."""
    end.row = {name: found.row.get(name) for name in ("run_key", "status", "message")}
    if found.settled is None:
        if found.row["status"] == "ok":
            end.row |= {"status": "unsettled", "message": f"not settled at {end.middle():g} after {MOST} periods"}
        return
    around = [*along.motions[end.motion.at], *along.motions[end.motion.at + end.step]]
    found.motion = nearest(found.settled, around)
    if found.motion.branch is end.motion.branch:
        end.inside, end.state = end.middle(), found.state
    else:
        end.outside, end.becomes = end.middle(), found.motion


def nearest(settled, motions: Sequence[Motion]) -> Motion:
    """The motion that is nearest to what a start has settled to."""
    from analysis import distance

    return min(motions, key=lambda one: distance(settled, one.settled))


def confirm(along: Along) -> None:
    """Let every branch go on, from its state of the largest tension, at a tenth of the tolerance and on a finer grid.

    What it becomes is said in `Motion.confirmed` of the branch. Raises as `runner.run`.
    """
    chosen = [max(branch, key=lambda one: one.tension_N) for branch in along.branches()]
    chosen = [motion for motion in chosen if motion.state is not None]
    asked, kinds = [], []
    for motion in chosen:
        scene, value = along.scenes[motion.at], along.values[motion.at]
        nodes = 2 * scene.tether.nodes - 1
        finer = scene_from_toml(scene.to_toml(), {"tether.nodes": nodes})
        for how, made in ((TIGHTER, tighter_scene(scene)), (FINER.format(nodes), finer)):
            known = tuple(one.settled for one in along.motions[motion.at])
            asked.append(
                Asked(
                    {along.key.name: value},
                    made,
                    along.fine(motion.at, Start(how, state=motion.state.at_zero())),
                    known,
                )
            )
            kinds.append((motion, how))
    said: dict[Motion, list[str]] = {}
    for (motion, how), found in zip(kinds, along.starts.run("motions confirmed", asked), strict=True):
        there = along.motions[motion.at]
        if found.row.get("outcome") == JOINED:
            found.motion = there[found.joins]
        elif found.settled is not None:
            found.motion = nearest(found.settled, there)
        if found.motion is motion:
            said.setdefault(motion, []).append(f"at {how}" if how == TIGHTER else f"on {how}")
        elif found.motion is not None:
            said.setdefault(motion, []).append(f"NOT with {how}, where it becomes {found.motion.branch.letter}")
        else:
            said.setdefault(motion, []).append(f"not settled with {how}")
    for motion, words in said.items():
        motion.branch.confirmed = f"{' and '.join(words)}, at {along.values[motion.at]:.4g}"
