"""Extreme numbers and faults put into random scenes (`campaigns.stability.fuzz.scenes`).

An extreme scene is a valid one with one to three numbers replaced by extreme ones (tiny, huge, zero where allowed) that
the models accept. A faulty one is a valid one with one to three faults put in: values of a wrong kind or size, what is
needed taken away, what nobody knows added, rules between values broken.
"""

import copy
import math

from campaigns.stability.fuzz.scenes import maybe, pick

EXTREMES = (5e-324, 1e-310, 1e-200, 1e-30, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, 1e30, 1e150, 1e200, 1.7e308)
JUNK = (None, True, False, "", "text", "1.0", "\x00", "ü" * 300, [], [1.0], [[]], {}, {"a": 1}, -1, -1e-300, 0, 1.5)
JUNK += (math.nan, math.inf, -math.inf, 10**400, -(10**400), [math.nan] * 3, [1.0] * 7, {"law": "linear"}, {"law": 3})


def extreme_scene(rng, raw):
    """The same scene with one to three of its numbers extreme, still valid: what the models refuse is drawn again."""
    for _ in range(int(rng.integers(1, 4))):
        for _ in range(40):
            trial = copy.deepcopy(raw)
            table, key = pick(rng, *_numbers(trial))
            table[key] = _extreme(rng)
            if not faults_of(trial):
                raw = trial
                break
    return raw


def faulty_scene(rng, raw):
    """The same scene with one to three faults put in, each of which the models refuse by itself."""
    for _ in range(int(rng.integers(1, 4))):
        for _ in range(40):
            trial = copy.deepcopy(raw)
            pick(rng, _junk, _junk, _junk, _taken_away, _unknown, _rule_broken)(rng, trial)
            if faults_of(trial):
                raw = trial
                break
    return raw


def faults_of(raw):
    """The lines in which the engine refuses a scene; empty for one that it accepts."""
    from engine.scene import SceneError, build_scene

    try:
        build_scene(raw)
    except SceneError as error:
        return error.faults
    return ()


def _extreme(rng):
    if maybe(rng, 0.2):
        return pick(rng, 0.0, -0.0)
    size = pick(rng, *EXTREMES) if maybe(rng, 0.5) else 10.0 ** float(rng.uniform(-12, 12))
    return size if maybe(rng, 0.8) else -size


def _places(table):
    """Every (container, key) of nested dicts and lists."""
    pairs = table.items() if isinstance(table, dict) else enumerate(table)
    for key, entry in list(pairs):
        yield table, key
        if isinstance(entry, (dict, list)):
            yield from _places(entry)


def _numbers(raw):
    return [(table, key) for table, key in _places(raw) if isinstance(table[key], float)]


def _junk(rng, raw):
    table, key = pick(rng, *_places(raw))
    table[key] = copy.deepcopy(pick(rng, *JUNK))


def _taken_away(rng, raw):
    table, key = pick(rng, *_places(raw))
    del table[key]


def _unknown(rng, raw):
    tables = [raw, *(table[key] for table, key in _places(raw) if isinstance(table[key], dict))]
    pick(rng, *tables)[pick(rng, "lenght_m", "x", "", "a.b", "law", "nodes", "\n")] = copy.deepcopy(pick(rng, *JUNK))


def _rule_broken(rng, raw):
    section, key, value = pick(
        rng,
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
    raw.setdefault(section, {})
    if isinstance(raw[section], dict):
        raw[section][key] = value
