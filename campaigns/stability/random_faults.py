"""Random valid and invalid scenes for `campaigns.stability`, the same while seed, count and sources stay the same.

A valid scene is a plain one (`campaigns.stability.random_scenes`) that the engine accepts; in every other one up to
three numbers are then replaced by extreme ones that the engine still accepts. An invalid scene has up to three faults:
values of a wrong kind or size, entries taken away, unknown keys, rules between values broken.
"""

import copy
import json
import math
from collections.abc import Callable

from hypothesis import HealthCheck, Phase, given, reject, seed, settings
from hypothesis import strategies as st

from campaigns.stability.random_scenes import one_of, plain_scene, size

VALID, INVALID = "valid", "invalid"
TRIES = 10  # to put an extreme or a fault into a scene
EXTREMES = (5e-324, 1e-310, 1e-200, 1e-30, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, 1e30, 1e150, 1e200, 1.7e308, 0.0, -0.0)
JUNK = (None, True, False, "", "text", "1.0", "\x00", "ü" * 300, [], [1.0], [[]], {}, {"a": 1}, -1, -1e-300, 0, 1.5)
JUNK += (math.nan, math.inf, -math.inf, 10**400, -(10**400), [math.nan] * 3, [1.0] * 7, {"law": "linear"}, {"law": 3})
UNKNOWN = ("lenght_m", "x", "", "a.b", "law", "nodes", "\n")
BROKEN_RULES = (
    ("tether", "nodes", 2),
    ("tether", "tension", {"law": "tabulated", "strain": [0.0, 0.0], "tension_N": [0.0, 1.0]}),
    ("tether", "tension", {"law": "tanh", "p": [1.0, -2.0, 0.0, 0.0, 1.0]}),
    ("waves", "steepness", -0.1),
    ("waves", "direction_rad", 1.0),
    ("current", "law", "table"),
    ("end", "kind", "free"),
    ("end", "kind", "held"),
    ("end", "twist_rad", 3.0),
    ("motion", "dimensions", 2),
    ("start", "buoy_velocity_mps", [0.0, 1.0, 0.0]),
    ("solver", "min_step_s", 1.0),
    ("solver", "courant", 1.0),
    ("output", "profiles_step_s", 0.1),
    ("output", "tangent_vectors", 10**9),
)


def faults_of(raw: dict) -> tuple[str, ...]:
    """The lines in which the engine refuses a scene given as nested dicts; empty for one that it accepts."""
    from engine.scene import SceneError, build_scene

    try:
        build_scene(raw)
    except SceneError as error:
        return error.faults
    return ()


def accepted() -> st.SearchStrategy[dict]:
    """Plain scenes that the engine accepts."""
    return plain_scene().filter(lambda raw: not faults_of(raw))


@st.composite
def valid_scene(draw) -> dict:
    """A valid scene, some with up to three extreme numbers."""
    raw = draw(accepted())
    return _changed(draw, raw, _extreme, draw(one_of(0, 0, 0, 1, 2, 3)), lambda trial: not faults_of(trial))


@st.composite
def invalid_scene(draw) -> dict:
    """A scene with up to three faults, each of which the engine refuses by itself."""
    raw = _changed(draw, draw(accepted()), _fault, draw(one_of(1, 2, 3)), faults_of)
    return raw if faults_of(raw) else reject()


def _changed(draw, raw: dict, change: Callable, count: int, wanted: Callable) -> dict:
    """The scene after that many changes; a change after which the scene is not as wanted is drawn again."""
    for _ in range(count):
        for _ in range(TRIES):
            trial = copy.deepcopy(raw)
            change(draw, trial)
            if wanted(trial):
                raw = trial
                break
    return raw


def _places(table: dict | list) -> list[tuple]:
    """Every (container, key) of nested dicts and lists."""
    found = []
    for key, entry in list(table.items() if isinstance(table, dict) else enumerate(table)):
        found.append((table, key))
        found += _places(entry) if isinstance(entry, (dict, list)) else []
    return found


def _one(draw, places: list) -> tuple:
    return places[draw(st.integers(0, len(places) - 1))]


def _extreme(draw, raw: dict) -> None:
    """Another size, or sign, for one number."""
    table, key = _one(draw, [(table, key) for table, key in _places(raw) if isinstance(table[key], float)])
    table[key] = draw(one_of(*EXTREMES) | size(1e-12, 1e12)) * draw(one_of(1.0, 1.0, 1.0, -1.0))


def _fault(draw, raw: dict) -> None:
    """An entry of a wrong kind or size, one that is missing, one that nobody knows, or a rule between values broken."""
    kind = draw(one_of("junk", "junk", "junk", "missing", "unknown", "rule"))
    places = _places(raw)
    if kind == "junk":
        table, key = _one(draw, places)
        table[key] = copy.deepcopy(draw(one_of(*JUNK)))
    elif kind == "missing":
        table, key = _one(draw, places)
        del table[key]
    elif kind == "unknown":
        tables = [raw, *(table[key] for table, key in places if isinstance(table[key], dict))]
        _one(draw, tables)[draw(one_of(*UNKNOWN))] = copy.deepcopy(draw(one_of(*JUNK)))
    else:
        section, key, value = draw(one_of(*BROKEN_RULES))
        if isinstance(raw.setdefault(section, {}), dict):
            raw[section][key] = copy.deepcopy(value)


SCENES = {VALID: valid_scene(), INVALID: invalid_scene()}


def drawn(kind: str, number: int, count: int) -> list[dict]:
    """So many scenes of a kind, from the seed `number`."""
    found = []
    _each(kind, number, count, found.append, Phase.generate)
    return [json.loads(json.dumps(raw)) for raw in found[:count]]


def smallest(kind: str, number: int, count: int, unsound: Callable[[dict], bool]) -> dict | None:
    """The smallest scene that Hypothesis finds unsound when it shrinks the first such one among those `drawn`."""
    last = []

    def judged(raw: dict) -> None:
        if unsound(raw):
            last.append(raw)
            raise AssertionError("unsound")

    try:
        _each(kind, number, count, judged, Phase.generate, Phase.shrink)
    except AssertionError:
        return last[-1]
    return None


def _each(kind: str, number: int, count: int, call: Callable[[dict], object], *phases: Phase) -> None:
    how = settings(
        max_examples=count, deadline=None, database=None, phases=phases, suppress_health_check=list(HealthCheck)
    )
    seed(number)(how(given(SCENES[kind])(lambda raw: call(raw))))()
