"""What the orbits over a key showed: where each is stable, what ends the motions, and what stands between them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby

from campaigns.answers import kilonewton
from tables import Column, Row, listed, number_of

NONE = "No periodic motion has an orbit that could be found: {}."
ACCURATE = 2e-4  # of an event, and of its value where that is above 1, as in the report
MOST = 8


def sentences(rows: Sequence[Row], key: Column, parts: Mapping[str, Sequence[Row]]) -> Iterator[str]:
    """At most eight, of the rows of table.csv and of those in the folders branches, events and orbits (parts)."""
    branches = [one for one in parts["branches"] if one["status"] == "ok"]
    if not branches:
        yield NONE.format(listed({str(one["message"]) for one in parts["branches"]}) or "no run is periodic")
        return
    many = sum(number_of(row, "unstable") == 0 for row in rows)
    yield f"{len(rows)} orbits on {len(branches)} branches, {many} of them stable, {len(rows) - many} not."
    for branch in branches[: MOST - 4]:
        yield _branch(branch, [row for row in rows if row["branch"] == branch["branch"]], key, parts["events"])
    yield from _between(parts["orbits"], key)
    if unsure := [
        one for one in parts["events"] if not number_of(one, "error") <= ACCURATE * max(1.0, number_of(one, key.name))
    ]:
        yield f"Known to no better than {ACCURATE}: {listed(_event(one, key) for one in unsure[:4])}."
    if failed := [one for one in parts["branches"] if one["status"] != "ok"]:
        name = (
            f"motion {one['motion']}" if one["motion"] else f"period {number_of(one, 'period'):.0f}" for one in failed
        )
        told = (f"{one} ({row['message']})" for one, row in zip(name, failed, strict=True))
        yield f"Without a branch: {listed(told)}."


def _branch(branch: Row, rows: Sequence[Row], key: Column, events: Sequence[Row]) -> str:
    at, stable = [number_of(row, key.name) for row in rows], [number_of(row, "unstable") == 0 for row in rows]
    turns = [number_of(one, key.name) for one in events if one["branch"] == branch["branch"]]
    spans: list[list[float]] = []
    for number, (value, good) in enumerate(zip(at, stable, strict=True)):
        if good:
            if not number or not stable[number - 1]:
                spans.append([value, value])
            for other in (number - 1, number + 1):  # where it changes, the event beside it is the end
                changes = 0 <= other < len(at) and not stable[other]
                nearest = min(turns, key=lambda turn, here=value: abs(turn - here)) if changes and turns else value
                spans[-1] = [min(*spans[-1], value, nearest), max(*spans[-1], value, nearest)]
    if number_of(branch, "closed") and len(spans) > 1 and stable[0] and stable[-1]:
        first, last = spans[0], spans.pop()  # an island begins and ends at one orbit
        spans[0] = [min(first[0], last[0]), max(first[1], last[1])]
    told = listed(f"{low:.4g} to {high:.4g}" for low, high in sorted(spans))
    own = [_event(one, key) for one in events if one["branch"] == branch["branch"]]
    under = f" (motion {branch['motion']})" if branch["motion"] else ""
    shape = ", an island" if number_of(branch, "closed") else ""
    where = f"stable at {key.symbol} = {told}" if spans else "never stable"
    return f"Period {branch['branch']}{under}{shape}: {where}{'; ' + listed(own) if own else ''}."


def _event(one: Row, key: Column) -> str:
    error = number_of(one, "error")
    alone = "" if math.isfinite(number_of(one, "finer")) else " on this grid alone"
    sure = f" ± {error:.1g}{alone}" if math.isfinite(error) else ", unsure"
    return f"{one['kind']} at {number_of(one, key.name):.5g}{sure}"


def _between(orbits: Sequence[Row], key: Column) -> Iterator[str]:
    """What stands between the motions of the value at which there are most orbits."""
    at = partial(number_of, name=key.name)
    for value, group in groupby(sorted(orbits, key=at), key=at):
        unstable, stable = [], []
        for one in group:
            name = one["branch"] or f"{number_of(one, 'period'):.0f}"
            sides = unstable if number_of(one, "unstable") > 0 else stable
            sides.append(f"period {name} ({kilonewton(number_of(one, 'tension_top_max_N'))}, {multiplier(one)})")
        if unstable and stable:
            yield f"At {key.symbol} = {value:.4g} stable: {listed(stable)}; unstable, and between: {listed(unstable)}."
            return


def multiplier(one: Row) -> str:
    """The leading multiplier of an orbit, with its error."""
    first = complex(number_of(one, "multiplier_1_real"), number_of(one, "multiplier_1_imag"))
    value = f"{first.real:.3g}" if first.imag == 0.0 else f"|μ| = {abs(first):.3g}"
    return f"μ = {value}".replace("μ = |μ|", "|μ|") + f" ± {number_of(one, 'multiplier_1_error'):.1g}"
