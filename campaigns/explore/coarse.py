"""Starts on a coarse line, which costs a third: where they end is asked there first.

Every motion that is known at a place is carried to the coarse line, and has its coarse form there. A start that joins
the coarse form of a motion ends in that motion. All others run on the line itself: those that find something else, or
nothing; and all of a place one of whose motions has no coarse form. What a coarse line says is checked: of the starts
that joined a motion on it every CHECKED-th runs on the line itself, too. Where more than MISSED of them end otherwise,
all starts of the place run there. The border of two basins may lie a little elsewhere on a coarse line: starts beside
one that ends otherwise run on the line itself (`Motions.run_starts`).
"""

from collections import Counter
from collections.abc import Mapping, Sequence

from analysis import distance
from campaigns.explore.starts import Ending, Request, Start
from engine.scene import scene_from_toml

COARSER, LEAST_NODES = 4, 33  # times fewer elements; nodes of a line that has a coarse one
CHECKED, MISSED = 8, 0.15
ALIKE = 0.2  # distance of a motion from its coarse form; motions are 0.3 apart or more (docs/motions.md)
CARRIED = "carried to the coarse line"


def coarse(scene):
    """The scene with COARSER times fewer elements; None where its line has few."""
    nodes = scene.tether.nodes
    if nodes < LEAST_NODES:
        return None
    return scene_from_toml(scene.to_toml(), {"tether.nodes": (nodes - 1) // COARSER + 1})


def coarse_endings(motions, title: str, starts: Sequence[tuple]) -> dict[int, Ending]:
    """How those of the starts end for which a coarse line can say it, by their number. Raises as `runner.run`.

    motions: `campaigns.explore.motions.Motions`.
    """
    scenes = {}
    for place in sorted({place for place, _ in starts}):
        scene = coarse(motions.jobs[place].scene)
        if scene is not None:
            scenes[place] = scene
    forms = coarse_forms(motions, scenes)
    requests = {}
    for number, (place, start) in enumerate(starts):
        if place in forms:
            requests[number] = Request(motions.name_of(place), scenes[place], start, forms[place])
    found = motions.starts.run(f"{title}, on a coarse line", [*requests.values()], listed=False)
    joined = {}
    for number, ending in zip(requests, found, strict=True):
        if ending.joins is not None:
            place = starts[number][0]
            ending.motion = motions.at[place][ending.joins]
            ending.row["message"] = f"on {scenes[place].tether.nodes} nodes"
            joined[number] = ending
    wrong = wrong_places(motions, title, starts, joined)
    return {number: ending for number, ending in joined.items() if starts[number][0] not in wrong}


def coarse_forms(motions, scenes: Mapping[int, object]) -> dict[int, list]:
    """What the motions of places are on the coarse line, by place; without places where one of them is not there.

    scenes: with the coarse line, by place.
    """
    carried, requests = [], []
    for place, scene in scenes.items():
        for motion in motions.at[place]:
            if motion.state is not None:
                carried.append(motion)
                start = Start(CARRIED, state=motion.state.at_zero())
                requests.append(Request(motions.name_of(place), scene, start))
    endings = motions.starts.run("motions carried to a coarse line", requests, listed=False)
    form_of = {}
    for motion, ending in zip(carried, endings, strict=True):
        if ending.settled is not None and distance(motion.settled, ending.settled) < ALIKE:
            form_of[motion] = ending.settled
    forms = {}
    for place in scenes:
        motions_here = motions.at[place]
        if motions_here and all(motion in form_of for motion in motions_here):
            forms[place] = [form_of[motion] for motion in motions_here]
    return forms


def wrong_places(motions, title: str, starts: Sequence[tuple], joined: Mapping[int, Ending]) -> set[int]:
    """The places where more than MISSED of the starts that are checked end otherwise on the line itself."""
    checked = list(joined)[::CHECKED]
    requests = [motions.request(*starts[number]) for number in checked]
    endings = motions.starts.run(f"{title}, checked on the line itself", requests, listed=False)
    checks, misses = Counter(), Counter()
    for number, ending in zip(checked, endings, strict=True):
        place, _ = starts[number]
        checks[place] += 1
        misses[place] += motions.known(place, ending) is not joined[number].motion
    return {place for place in misses if misses[place] > MISSED * checks[place]}
