"""What the orbits over a key showed: where each is stable, what ends the motions, and what stands between them."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby

from campaigns.answers import in_newtons, numbers_of
from tables import PEAK, WHOLE_BRANCH, Column, Row, count, listed, number_of, typed

NONE = "No periodic motion has an orbit that could be found: {}."
ACCURATE = 2e-4  # of an event, and of its value where that is above 1, as in the report
MOST = 8


def sentences(rows: Sequence[Row], key: Column, parts: Mapping[str, Sequence]) -> Iterator[str]:
    """At most eight, of the rows of table.csv and of those in the folders branches, events and orbits (parts)."""
    branches, failed = [], []
    for row in parts["branches"]:
        (branches if row["status"] == "ok" else failed).append(row)
    if not branches:
        yield NONE.format(listed({str(row["message"]) for row in failed}) or "no run is periodic")
        return
    stable = sum(map(_is_stable, rows))
    on = f"{count(len(rows), 'orbit')} on {count(len(branches), 'branch', 'branches')}"
    yield f"{on}, {stable} of them stable, {len(rows) - stable} not."
    for branch in branches[: MOST - 4]:
        yield _branch(branch, _on_branch(rows, branch), key, _on_branch(parts["events"], branch))
    yield from _between(parts["orbits"], key)
    unsure = []
    for event in parts["events"]:
        if not number_of(event, "error") <= ACCURATE * max(1.0, number_of(event, key.name)):
            unsure.append(_event(event, key))
    if unsure:
        yield f"Known to no better than {ACCURATE}: {listed(unsure[:4])}."
    if failed:
        words = Counter()
        for row in failed:
            name = f"period {number_of(row, 'period'):.0f}"
            if row["motion"]:
                name = f"motion {row['motion']}"
            words[f"{name} ({row['message']})"] += 1
        parts = []
        for text, times in words.items():
            if times > 1:
                text = f"{times} times {text}"
            parts.append(text)
        yield f"Without a branch: {listed(parts)}."


def _is_stable(orbit: Row) -> bool:
    return number_of(orbit, "unstable") == 0


def _on_branch(rows: Sequence[Row], branch: Row) -> list[Row]:
    return [row for row in rows if row["branch"] == branch["branch"]]


def _branch(branch: Row, orbits: Sequence[Row], key: Column, events: Sequence[Row]) -> str:
    sentence = f"Period {branch['branch']}"
    if branch["motion"]:
        sentence += f" (motion {branch['motion']})"
    spans = _stable_spans(orbits, key, events)
    if number_of(branch, "closed"):
        sentence += ", an island"
        if len(spans) > 1 and _is_stable(orbits[0]) and _is_stable(orbits[-1]):
            first, last = spans[0], spans.pop()  # an island begins and ends at one orbit
            spans[0] = (min(first[0], last[0]), max(first[1], last[1]))
    stability = "never stable"
    if spans:
        stability = (
            f"stable at {key.symbol} = {listed(f'{typed(low)} to {typed(high)}' for low, high in sorted(spans))}"
        )
    sentence += f": {stability}"
    if events:
        sentence += f"; {listed(_event(event, key) for event in events)}"
    ends = [end for end in (branch["begins"], branch["ends"]) if end]
    reasons = dict.fromkeys(end for end in ends if not end.startswith(WHOLE_BRANCH))
    if reasons:
        sentence += f"; not followed to its end ({listed(reasons)})"
    return f"{sentence}."


def _stable_spans(orbits: Sequence[Row], key: Column, events: Sequence[Row]) -> list[tuple]:
    """Ranges of the key in which the orbits of a branch are stable.

    Where stability changes, the end is the event on the shortest way from the last stable orbit to the next one, in
    the key and in the tension: at one value of the key a branch has several orbits.
    """
    values, stable = numbers_of(orbits, key.name), list(map(_is_stable, orbits))
    sizes = {}
    for name in (key.name, PEAK):
        numbers = numbers_of(orbits, name)
        sizes[name] = max(numbers) - min(numbers) or 1.0

    def way(event, *neighbours):
        length = 0.0
        for orbit in neighbours:
            for name, size in sizes.items():
                length += abs(number_of(event, name) - number_of(orbit, name)) / size
        return length

    spans = []
    for number, value in enumerate(values):
        if not stable[number]:
            continue
        ends = [value]
        for neighbour in (number - 1, number + 1):
            if events and 0 <= neighbour < len(values) and not stable[neighbour]:
                pair = orbits[number], orbits[neighbour]
                nearest = min(events, key=lambda event, pair=pair: way(event, *pair))
                ends.append(number_of(nearest, key.name))
        if number and stable[number - 1]:
            ends += spans.pop()
        spans.append((min(ends), max(ends)))
    return spans


def _event(event: Row, key: Column) -> str:
    error = number_of(event, "error")
    accuracy = ", unsure"
    if math.isfinite(error):
        accuracy = f" ± {error:.1g}"
        if math.isnan(number_of(event, "finer")):
            accuracy += " on this grid alone"
    return f"{event['kind']} at {number_of(event, key.name):.5g}{accuracy}"


def _between(orbits: Sequence[Row], key: Column) -> Iterator[str]:
    """The orbits, stable and unstable, of the value at which there are most."""
    value_of = partial(number_of, name=key.name)
    for value, group in groupby(sorted(orbits, key=value_of), key=value_of):
        unstable, stable = [], []
        for row in group:
            name = row["branch"] or f"{number_of(row, 'period'):.0f}"
            words = stable if _is_stable(row) else unstable
            words.append(f"period {name} ({in_newtons(number_of(row, PEAK))}, {multiplier(row)})")
        if unstable and stable:
            at = f"{key.symbol} = {typed(value)}"
            yield f"At {at} stable: {listed(stable)}; unstable, and between: {listed(unstable)}."
            return


def multiplier(row: Row) -> str:
    """The leading multiplier of an orbit, with its error."""
    leading = complex(number_of(row, "multiplier_1_real"), number_of(row, "multiplier_1_imag"))
    value = f"|μ| = {abs(leading):.3g}"
    if leading.imag == 0.0:
        value = f"μ = {leading.real:.3g}"
    return f"{value} ± {number_of(row, 'multiplier_1_error'):.1g}"
