"""The smallest start that leads somewhere: the minimal fatal shock (Halekotte & Feudel, Sci. Rep. 10, 11783, 2020)."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

SHARP = 0.01  # of the size
RAYS = 16  # bisected side by side
NARROWER = 4.0  # the next rays lie within this part of the angle about the best one
LEAST_TURN = 0.02  # rad between rays below which no better one is looked for


class Shock(NamedTuple):
    """A start that leads there; along its ray the largest size found below it that does not."""

    turn: float
    size: float
    below: float


def smallest(leads: Callable[[Sequence[tuple[float, float]]], list[bool]], first: Shock, round_: float) -> Shock:
    """The smallest start that leads there, to SHARP of its size along its ray.

    leads(starts) -> whether each start (turn, size) leads there. first: one that does. round_: turns that there are.
    Sizes are bisected along RAYS of all turns, then along as many in a narrower part about the best ray, until that
    gains less than SHARP. A ray is left when a smaller start than any on it is known. Where what leads there is not
    one piece, smaller starts may hide between rays, and below a size on a ray that does not.
    """
    best, width = first, round_
    while True:
        previous_size = best.size
        turns = [best.turn + width * (k / RAYS - 0.5) for k in range(RAYS)]  # the best one among them
        rays = _rays(leads, best, [turn for turn in turns if turn != best.turn])
        while wide := [ray for ray in rays if ray.size - ray.below > SHARP * ray.size]:
            rays = [ray for ray in rays if ray not in wide] + _bisected(leads, wide)
            least = min(ray.size for ray in rays)
            rays = [ray for ray in rays if ray.below < least]
        best = min(rays, key=lambda ray: ray.size)
        near = width / RAYS <= LEAST_TURN
        if near or (width < round_ and best.size > (1.0 - SHARP) * previous_size):
            return best
        width /= NARROWER


def _rays(leads: Callable, best: Shock, turns: Sequence[float]) -> list[Shock]:
    """The best ray, and those of the turns on which a start of its size leads there too."""
    rays = [best]
    for turn, success in zip(turns, leads([(turn, best.size) for turn in turns]), strict=True):
        if success:
            rays.append(Shock(turn, best.size, 0.0))
    return rays


def _bisected(leads: Callable, rays: Sequence[Shock]) -> list[Shock]:
    """The rays with half the uncertainty of their sizes."""
    middles = [0.5 * (ray.size + ray.below) for ray in rays]
    successes = leads([(ray.turn, size) for ray, size in zip(rays, middles, strict=True)])
    bisected = []
    for ray, size, success in zip(rays, middles, successes, strict=True):
        bisected.append(ray._replace(size=size) if success else ray._replace(below=size))
    return bisected
