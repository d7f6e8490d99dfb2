"""The tables of `campaigns.orbits`: orbits along branches, events, branches, and chosen orbits with their histories."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from campaigns.explore.along import MOTION
from campaigns.explore.multipliers import COUNT, MULTIPLIERS
from campaigns.explore.rows import STROBED
from campaigns.orbits.tree import Tree
from engine.atomic import write_atomic
from tables import MESSAGE, STATUS, Column, csv_of, write_table

BRANCH = Column("branch", symbol="branch", meaning="the period of its orbits, and a letter where there are several")
PLACE = Column("place", "", "place", "number of the orbit, from 0 on", 0)
PERIOD = replace(STROBED, name="period", meaning="wave periods after which the orbit repeats")
UNSTABLE = Column("unstable", "", "unstable", "multipliers outside the unit circle; 0: the orbit is stable", 0)
PARTS = tuple(
    Column(
        f"multiplier_{i}_{part}", "", f"{symbol} μ{i}", f"{part} part of multiplier {i}, the largest first", 3
    )
    for i in range(1, COUNT + 1)
    for part, symbol in (("real", "Re"), ("imag", "Im"))
)  # fmt: skip
ERRORS = tuple(
    Column(f"multiplier_{i}_error", "", f"± μ{i}", "largest change over three sequences of steps", 4)
    for i in range(1, COUNT + 1)
)
MODULUS = MULTIPLIERS[0]
MOTION_OF = (
    Column("radius_min_m", "m", "r_min", "smallest distance of the buoy from the anchor on the orbit", 3),
    Column("radius_max_m", "m", "r_max", "largest distance of the buoy from the anchor on the orbit", 3),
    Column("tension_top_min_N", "N", "T_min", "smallest tension at the top of the line on the orbit", 0),
    Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line on the orbit", 0),
)
GAP = Column("gap", "", "gap", "what is left of the equation of the orbit, the largest coordinate of its state", 12)
KIND = Column("kind", symbol="event", meaning="fold, flip (period doubling) or torus (Neimark-Sacker) point")
ANGLE = Column("angle_rad", "rad", "angle", "angle of the multiplier that crosses the unit circle", 3)
LEADS = Column("leads_to", symbol="begins", meaning="branch of the orbits of twice the period that begin there")
STROBE = Column("strobe", "", "strobe", "number of the strobe, from 0 on", 0)
RADIUS = Column("radius_m", "m", "r", "distance of the buoy from the anchor at the strobe", 4)
ORBITS = Column("orbits", "", "orbits", "orbits of the branch", 0)
CLOSED = Column("closed", "", "island", "1: an island, whose branch comes back to its beginning; else 0", 0)
BEGINS = Column("begins", symbol="begins", meaning="why the branch begins where it does")
ENDS = Column("ends", symbol="ends", meaning="why the branch ends where it does")


def tables(tree: Tree, key: Column) -> list[dict]:
    """Write all tables; returns the rows of table.csv. Raises OSError."""
    out = tree.plan.how.out
    for name in ("events", "orbits"):
        (out / name).mkdir(exist_ok=True)
    rows = [
        {"branch": branch.name, "place": place, key.name: one["value"], **_told(one)}
        for branch in tree.branches
        for place, one in enumerate(branch.orbits)
    ]
    write_table(out / "table.csv", (BRANCH, PLACE, key, *_shape(), GAP, STATUS, MESSAGE), rows)
    strobes = [
        {"branch": branch.name, "place": place, key.name: one["value"], "strobe": number, "radius_m": radius}
        for branch in tree.branches
        for place, one in enumerate(branch.orbits)
        for number, radius in enumerate(one["strobes"])
    ]
    write_table(out / "strobes.csv", (BRANCH, PLACE, key, STROBE, RADIUS), strobes)
    meaning = "largest change over three sequences of steps, and on the finer grid where one is told"
    error = Column("error", key.unit, f"± {key.symbol}", meaning, 5)
    finer = Column("finer", key.unit, f"{key.symbol} finer", "where it is on a grid of 2n - 1 nodes", 5)
    shape = BRANCH, KIND, replace(key, digits=5), error, finer, PERIOD, ANGLE, MOTION_OF[3], RADIUS, LEADS
    write_table(out / "events" / "table.csv", (*shape, STATUS, MESSAGE), [*_events(tree, key)])
    shape = BRANCH, PERIOD, MOTION, ORBITS, CLOSED, BEGINS, ENDS
    write_table(out / "branches" / "table.csv", (*shape, STATUS, MESSAGE), [*_branches(tree)])
    chosen = [*_chosen(tree, key)]
    write_table(out / "orbits" / "table.csv", (BRANCH, PLACE, key, MOTION, *_shape(), GAP, STATUS, MESSAGE), chosen)
    return rows


def _shape() -> tuple[Column, ...]:
    return PERIOD, UNSTABLE, *PARTS, *ERRORS, MODULUS, *MOTION_OF


def _told(one: dict) -> dict[str, object]:
    """The columns of an orbit."""
    values = [complex(*pair) for pair in one["multipliers"]]
    parts = (part for pair in one["multipliers"] for part in pair)
    sure = {"status": "ok"} if one["settled"] else {"status": "unsure", "message": "its multipliers have not settled"}
    for value, error in zip(values, one["errors"], strict=True):
        if error is None:
            sure.setdefault("message", "with other steps it is not found: its multipliers have no errors")
        elif abs(abs(value) - 1.0) <= error:
            sure.setdefault("message", "stable or not within the error of a multiplier")
    found = {"period": one["period"], "unstable": sum(abs(value) > 1.0 for value in values), "gap": one["gap"]}
    motion = *one["radius_m"], *one["tension_N"]
    for columns, numbers in ((PARTS, parts), (ERRORS, one["errors"]), (MOTION_OF, motion)):
        found |= {column.name: number for column, number in zip(columns, numbers, strict=False)}
    return found | {MODULUS.name: abs(values[0]), **sure}


def _events(tree: Tree, key: Column) -> Iterator[dict[str, object]]:
    for branch in tree.branches:
        for event in branch.result["events"]:
            sure = event["error"] is not None
            doubt = event.get("doubt") or ("" if sure else "not found with other steps")
            yield {
                "branch": branch.name,
                "kind": event["kind"],
                key.name: event["value"],
                "error": event["error"],
                "finer": event.get("finer"),
                "period": event["period"],
                "angle_rad": event["angle_rad"],
                "tension_top_max_N": event["tension_N"][1],
                "radius_m": event["strobes"][0],
                "leads_to": event.get("leads_to"),
                "status": "ok" if sure else "unsure",
                "message": doubt,
            }


def _branches(tree: Tree) -> Iterator[dict[str, object]]:
    for one in tree.branches:
        told = {name: one.result[name] for name in ("begins", "ends")} | {"closed": int(one.result["closed"])}
        counts = {"period": one.orbits[0]["period"], "orbits": len(one.orbits)}
        yield {"branch": one.name, "motion": " ".join(one.motions), **counts, **told, "status": "ok"}
    for one in tree.failed:
        yield {"motion": one["motion"], "period": one["period"], "status": "no-orbit", "message": one["reason"]}


def _chosen(tree: Tree, key: Column) -> Iterator[dict[str, object]]:
    """Rows of the orbits with errors; writes the history of each."""
    counts: Counter = Counter()
    for one in sorted(tree.chosen, key=lambda one: (one["branch"], one["value"])):
        branch, place = one["branch"], counts[one["branch"]]
        counts[branch] += 1
        path = tree.plan.how.out / "orbits" / f"{branch}_{place}.csv"
        write_atomic(path, csv_of([*one["history"]], zip(*one["history"].values(), strict=True)))
        yield {
            "branch": branch,
            "place": place,
            key.name: one["value"],
            "motion": one["motion"],
            **_told(one),
        }
