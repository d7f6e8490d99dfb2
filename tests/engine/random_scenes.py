"""Random valid and invalid scenes, as strategies of Hypothesis, which shrinks a scene that breaks a law.

A scene starts as a shipped one on a small grid. Then parts of it are replaced (random_scenes.toml) and numbers scaled,
extreme numbers last; a change that the engine refuses is drawn again. An invalid scene has up to three faults besides:
values of a wrong kind or size, entries taken away, unknown keys, rules between values broken.
"""

import copy
import math
import tomllib
from collections.abc import Callable
from pathlib import Path

from hypothesis import reject
from hypothesis import strategies as st

from engine.scene import SceneError, build_scene, load_scene

MOST_NODES = 61
EXTREMES = (5e-324, 1e-310, 1e-200, 1e-30, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, 1e30, 1e150, 1e200, 1.7e308, 0.0, -0.0)
JUNK = (None, True, False, "", "text", "1.0", "\x00", "ü" * 300, [], [1.0], [[]], {}, {"a": 1}, -1, -1e-300, 0, 1.5)
JUNK += (math.nan, math.inf, -math.inf, 10**400, -(10**400), [math.nan] * 3, [1.0] * 7, {"law": "linear"}, {"law": 3})
UNKNOWN = ("lenght_m", "x", "", "a.b", "law", "nodes", "\n")
DATA = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
CHOICES = [(name, value) for name, values in DATA["parts"].items() for value in values]
TRIES = 10  # to make a change that is wanted


def faults_of(raw: dict) -> tuple[str, ...]:
    """The lines in which the engine refuses a scene given as nested dicts; empty for one that it accepts."""
    try:
        build_scene(raw)
    except SceneError as error:
        return error.faults
    return ()


def one_of(draw, choices: list | tuple) -> object:
    """One of the choices, itself and not a copy."""
    return choices[draw(st.integers(0, len(choices) - 1))]


@st.composite
def valid_scene(draw) -> dict:
    """A scene that the engine accepts, in about every other one with up to three extreme numbers."""
    raw = tomllib.loads(load_scene(*one_of(draw, DATA["bases"])).to_toml())
    raw["tether"]["nodes"] = draw(st.integers(3, MOST_NODES))
    for change, most in ((_part, 12), (_scaled, 4)):
        raw = _changed(draw, raw, change, draw(st.integers(0, most)))
    return _changed(draw, raw, _extreme, one_of(draw, (0, 0, 0, 1, 2, 3)))


@st.composite
def invalid_scene(draw) -> dict:
    """A scene with up to three faults, each of which the engine refuses by itself."""
    raw = _changed(draw, draw(valid_scene()), _fault, draw(st.integers(1, 3)), faulty=True)
    return raw if faults_of(raw) else reject()


def _changed(draw, raw: dict, change: Callable, count: int, faulty: bool = False) -> dict:
    """The scene after that many changes; a change that leaves it otherwise than sound, or `faulty`, is drawn again."""
    for _ in range(count):
        for _ in range(TRIES):
            trial = copy.deepcopy(raw)
            change(draw, trial)
            if bool(faults_of(trial)) == faulty:
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


def _number(draw, raw: dict) -> tuple:
    """Where one of the scene's numbers stands."""
    return one_of(draw, [(table, key) for table, key in _places(raw) if isinstance(table[key], float)])


def _part(draw, raw: dict) -> None:
    """Another part in the place of one, or none."""
    name, value = one_of(draw, CHOICES)
    section, _, key = name.rpartition(".")
    table = raw.setdefault(section, {}) if section else raw
    table.pop(key, None)
    if value != "none":
        table[key] = copy.deepcopy(value)


def _scaled(draw, raw: dict) -> None:
    """One number larger or smaller, by up to a hundred times."""
    table, key = _number(draw, raw)
    table[key] *= math.exp(draw(st.floats(-4.6, 4.6)))


def _extreme(draw, raw: dict) -> None:
    """Another size, or sign, for one number."""
    table, key = _number(draw, raw)
    size = st.sampled_from(EXTREMES) | st.floats(-27.0, 27.0).map(math.exp)
    table[key] = draw(size) * one_of(draw, (1.0, 1.0, 1.0, -1.0))


def _fault(draw, raw: dict) -> None:
    """An entry of a wrong kind or size, one that is missing, one that nobody knows, or a rule between values broken."""
    kind, places = one_of(draw, ("junk", "junk", "junk", "missing", "unknown", "rule")), _places(raw)
    table, key = one_of(draw, places)
    if kind == "junk":
        table[key] = copy.deepcopy(one_of(draw, JUNK))
    elif kind == "missing":
        del table[key]
    elif kind == "unknown":
        tables = [raw, *(table[key] for table, key in places if isinstance(table[key], dict))]
        one_of(draw, tables)[one_of(draw, UNKNOWN)] = copy.deepcopy(one_of(draw, JUNK))
    else:
        section, key, value = one_of(draw, DATA["broken_rules"])
        if isinstance(raw.setdefault(section, {}), dict):
            raw[section][key] = copy.deepcopy(value)
