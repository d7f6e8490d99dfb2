"""What a map says, in a few sentences: where it is chaotic, where it pulls hardest, where the start decides."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence

from campaigns.answers import OPEN_WORDS, greatest, kilonewton
from campaigns.explore.answer import reasons, use_of
from campaigns.regime_map.tables import RATIO, TENSION
from tables import CHAOTIC, EMPTY, FAILED, PERIODIC, QUASI, SCREENED, Column, Row, listed, number_of, of_kicks


def sentences(
    cells: Sequence[Row], motions: Sequence[Row], keys: Sequence[Column], scene: Callable[[Row], object]
) -> Iterator[str]:
    """At most eight, of the rows of cells/table.csv and table.csv.

    keys: of the map, that of its pages first. scene: that of a row, as far as its buoy goes.
    """
    coarse = [one for one in cells if number_of(one, "level") == 0.0]
    done = [one for one in coarse if one["source"] != SCREENED]
    if not done:
        yield f"Nothing is computed: {len(coarse)} cells are screened with a massless tether, which is no result."
        peak = greatest(coarse, RATIO.name)
        if peak is not None:
            yield f"Largest tension there: {number_of(peak, RATIO.name):.3g} times that at rest, at {_at(peak, keys)}."
        return
    said = f"{len(done)} cells of the coarse grid and {len(cells) - len(coarse)} finer ones are computed"
    left = len(coarse) - len(done)
    yield f"{said}; {f'{left} are only screened with a massless tether' if left else 'none is only screened'}."
    words = Counter(str(one["regime_rest"] or "") for one in done)
    calm = sum(count for word, count in words.items() if word.startswith(PERIODIC))
    open_ = sum(words[word] for word in OPEN_WORDS)
    parts = {CHAOTIC: words[CHAOTIC], QUASI: words[QUASI], "periodic": calm}
    led = listed(f"{word} on {_share(count, done)}" for word, count in parts.items())
    chaotic = {_place(one, keys) for one in motions if one.get("regime") == CHAOTIC and number_of(one, "level") == 0.0}
    yield f"Rest leads to a motion that is {led} of the map; {_share(open_, done)} is not decided."
    if len(chaotic) > words[CHAOTIC]:
        yield f"Some motion is chaotic on {_share(len(chaotic), done)} of the map."
    if (peak := greatest(cells, TENSION.name)) is not None:
        there = [one for one in motions if _place(one, keys) == _place(peak, keys)]
        counted = of_kicks(greatest(there, TENSION.name) or {})
        ends = f"; {counted} kicks there end in it" if counted != EMPTY else ""
        pulls = f"{kilonewton(number_of(peak, TENSION.name))}, {number_of(peak, RATIO.name):.3g} times that at rest"
        yield f"Largest tension {pulls}, at {_at(peak, keys)}{ends}."
        yield from _use([one for one in motions if number_of(one, TENSION.name) > 0.0], keys, scene)
    several = [one for one in done if number_of(one, "motions") > 1]
    most = max((number_of(one, "motions") for one in several), default=1)
    if several:
        yield f"On {_share(len(several), done)} of the map the start decides: up to {most:.0f} motions."
    cheap = sum(one.get("verdict") == "cheap" for one in motions)
    yield f"Of {len(motions)} motions {cheap} have a cheap verdict: they repeat at one look."
    if failed := sum(one["source"] == FAILED for one in cells):
        yield f"{failed} cells have no result; the column message of cells/table.csv says why."


def _use(motions: Sequence[Row], keys: Sequence[Column], scene: Callable[[Row], object]) -> Iterator[str]:
    """Whether the largest tension may be used, and the largest that may."""
    some = sorted(motions, key=lambda one: -number_of(one, TENSION.name))
    free = next((one for one in some if not [*reasons(one, scene(one))]), None)
    for row in some[:1]:
        searched = number_of(row, "share") == number_of(row, "share")
        best = f" Without that it is {kilonewton(number_of(free, TENSION.name))}, at {_at(free, keys)}." if free else ""
        yield use_of(row, scene(row), searched) + ("" if free is row else best)


def _share(count: int, of: Sequence) -> str:
    return f"{100.0 * count / len(of):.3g} %"


def _place(one: Row, keys: Sequence[Column]) -> tuple:
    return tuple(one[key.name] for key in keys)


def _at(one: Row, keys: Sequence[Column]) -> str:
    values = (one[key.name] if isinstance(one[key.name], str) else f"{one[key.name]:.4g}" for key in keys)
    said = (f"{key.symbol} = {value} {key.unit}".rstrip() for key, value in zip(keys, values, strict=True))
    return ", ".join(said)
