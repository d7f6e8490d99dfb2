"""The tables of `campaigns.orbits`: orbits along branches, events, branches, and chosen orbits with their histories."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain
from pathlib import Path

from campaigns.explore.motions import MOTION, subfolder, write_part
from campaigns.explore.multipliers import COUNT, MULTIPLIERS
from campaigns.explore.rows import STROBED
from campaigns.machinery import filled
from campaigns.orbits.tree import Tree
from engine.atomic import write_atomic
from tables import MESSAGE, STATUS, Column, Columns, Row, csv_of, names, of_words, write_table

BRANCH = of_words("branch", "the period of its orbits, and a letter where there are several")
PLACE = Column("place", "", "place", "number of the orbit, from 0 on", 0)
PERIOD = replace(STROBED, name="period", meaning="wave periods after which the orbit repeats")
UNSTABLE = Column("unstable", "", "unstable", "multipliers outside the unit circle; 0: the orbit is stable", 0)
PARTS: list[Column] = []
ERRORS: list[Column] = []
for _i in range(1, COUNT + 1):
    for _part, _symbol in (("real", "Re"), ("imag", "Im")):
        _meaning = f"{_part} part of multiplier {_i}, the largest first"
        PARTS.append(Column(f"multiplier_{_i}_{_part}", "", f"{_symbol} μ{_i}", _meaning, 3))
    ERRORS.append(Column(f"multiplier_{_i}_error", "", f"± μ{_i}", "largest change over three sequences of steps", 4))
MODULUS = MULTIPLIERS[0]
MOTION_OF = (
    Column("radius_min_m", "m", "r_min", "smallest distance of the buoy from the anchor on the orbit", 3),
    Column("radius_max_m", "m", "r_max", "largest distance of the buoy from the anchor on the orbit", 3),
    Column("tension_top_min_N", "N", "T_min", "smallest tension at the top of the line on the orbit", 0),
    Column("tension_top_max_N", "N", "T_max", "largest tension at the top of the line on the orbit", 0),
)
GAP = Column("gap", "", "gap", "what is left of the equation of the orbit, the largest coordinate of its state", 12)
KIND = of_words("kind", "fold, flip (period doubling) or torus (Neimark-Sacker) point", "event")
ANGLE = Column("angle_rad", "rad", "angle", "angle of the multiplier that crosses the unit circle", 3)
LEADS = of_words("leads_to", "branch of the orbits of twice the period that begin there", "begins")
STROBE = Column("strobe", "", "strobe", "number of the strobe, from 0 on", 0)
RADIUS = Column("radius_m", "m", "r", "distance of the buoy from the anchor at the strobe", 4)
OF_A_BRANCH = (
    BRANCH,
    PERIOD,
    MOTION,
    Column("orbits", "", "orbits", "orbits of the branch", 0),
    Column("closed", "", "island", "1: an island, whose branch comes back to its beginning; else 0", 0),
    of_words("begins", "why the branch begins where it does"),
    of_words("ends", "why the branch ends where it does"),
    STATUS,
    MESSAGE,
)


def tables(tree: Tree, key: Column) -> list[Row]:
    """Write all tables; returns the rows of table.csv. Raises OSError."""
    out, rows, strobes = tree.plan.out, [], []
    for branch in tree.branches:
        for place, orbit in enumerate(branch.orbits):
            label = {"branch": branch.name, "place": place, key.name: orbit["value"]}
            rows.append(label | _numbers(orbit))
            for number, radius_m in enumerate(orbit["strobes"]):
                strobes.append(label | {"strobe": number, "radius_m": radius_m})
    numbers = PERIOD, UNSTABLE, *PARTS, *ERRORS, MODULUS, *MOTION_OF, GAP, STATUS, MESSAGE
    write_table(out / "table.csv", (BRANCH, PLACE, key, *numbers), rows)
    write_table(out / "strobes.csv", (BRANCH, PLACE, key, STROBE, RADIUS), strobes)
    write_part(tree.plan, "events", _event_columns(key), _events(tree, key))
    write_part(tree.plan, "branches", OF_A_BRANCH, _branches(tree))
    folder = subfolder(tree.plan, "orbits")
    write_table(folder / "table.csv", (BRANCH, PLACE, key, MOTION, *numbers), [*_chosen(tree, key, folder)])
    return rows


def _event_columns(key: Column) -> Columns:
    meaning = (
        "largest change over three sequences of steps and those of its neighbours, "
        "and on the finer grid where one is told"
    )
    error = Column("error", key.unit, f"± {key.symbol}", meaning, 5)
    finer = Column("finer", key.unit, f"{key.symbol} finer", "where it is on a grid of 2n - 1 nodes", 5)
    shape = PERIOD, ANGLE, MOTION_OF[3], RADIUS, LEADS
    return BRANCH, KIND, replace(key, digits=5), error, finer, *shape, STATUS, MESSAGE


def _numbers(orbit: dict) -> Row:
    """The columns of an orbit."""
    moduli = [abs(complex(*pair)) for pair in orbit["multipliers"]]
    row = {
        "period": orbit["period"],
        "unstable": sum(modulus > 1.0 for modulus in moduli),
        "gap": orbit["gap"],
        MODULUS.name: moduli[0],
        "status": "ok",
    }
    row |= zip(names(PARTS), chain.from_iterable(orbit["multipliers"]), strict=False)
    row |= zip(names(ERRORS), orbit["errors"], strict=False)
    row |= filled(MOTION_OF, (*orbit["radius_m"], *orbit["tension_N"]))
    if not orbit["settled"]:
        return row | {"status": "unsure", "message": "its multipliers have not settled"}
    for modulus, error in zip(moduli, orbit["errors"], strict=True):
        if error is None:
            return row | {"message": "with other steps it is not found: its multipliers have no errors"}
        if abs(modulus - 1.0) <= error:
            return row | {"message": "stable or not within the error of a multiplier"}
    return row


def _events(tree: Tree, key: Column) -> Iterator[Row]:
    for branch in tree.branches:
        for event in branch.result["events"]:
            status, message = "ok", ""
            if event["error"] is None:
                status, message = "unsure", "not found with other steps"
            yield event | {
                "branch": branch.name,
                key.name: event["value"],
                "tension_top_max_N": event["tension_N"][1],
                "radius_m": event["strobes"][0],
                "status": status,
                "message": event.get("doubt") or message,
            }


def _branches(tree: Tree) -> Iterator[Row]:
    for branch in tree.branches:
        yield branch.result | {
            "branch": branch.name,
            "motion": " ".join(branch.motions),
            "period": branch.orbits[0]["period"],
            "orbits": len(branch.orbits),
            "closed": int(branch.result["closed"]),
            "status": "ok",
        }
    for seed, reason in tree.failed:
        yield {"motion": seed.motion, "period": seed.period, "status": "no-orbit", "message": reason}


def _chosen(tree: Tree, key: Column, folder: Path) -> Iterator[Row]:
    """Rows of the orbits with errors; writes the history of each into the folder."""
    counts = Counter()
    for orbit in sorted(tree.chosen, key=lambda orbit: (orbit["branch"], orbit["value"])):
        branch, place = orbit["branch"], counts[orbit["branch"]]
        counts[branch] += 1
        history = orbit["history"]
        write_atomic(folder / f"{branch}_{place}.csv", csv_of([*history], zip(*history.values(), strict=True)))
        label = {"branch": branch, "place": place, key.name: orbit["value"], "motion": orbit["motion"]}
        yield label | _numbers(orbit)
