"""Rules between the values of a scene: what one value allows another to be.

Checked on plain data, leaving out the values that are faulty in themselves: a model validator would be skipped as soon
as one field fails, and the user would see the faults one after the other.
"""

import math
from collections.abc import Iterator

from engine.scene_faults import fault, shown

_FAULTY = object()


class _Sound:
    """Reads the values that are sound by themselves; an absent one is None."""

    def __init__(self, raw: dict[str, object], bad: set[tuple[str | int, ...]]) -> None:
        self.raw, self.bad = raw, bad

    def has(self, section: str) -> bool:
        """Is the section there, sound or not?"""
        return self.raw.get(section) is not None

    def value(self, key: str) -> object:
        path = tuple(key.split("."))
        if any(location[: len(path)] == path[: len(location)] for location in self.bad):
            return _FAULTY
        at: object = self.raw
        for part in path:
            at = at.get(part) if isinstance(at, dict) else None
        return at

    def values(self, *keys: str) -> tuple | None:
        """The values of the keys, or None unless all are there and sound."""
        found = tuple(self.value(key) for key in keys)
        return None if any(item is None or item is _FAULTY for item in found) else found


def cross_faults(raw: dict[str, object], bad: set[tuple[str | int, ...]]) -> list[str]:
    """Every fault between values, one line each.

    raw: the scene as nested dicts (TOML or model_dump). bad: locations of values that are faulty in themselves; a rule
    that needs one of them is not applied.
    """
    if not isinstance(raw, dict):
        return []
    sound = _Sound(raw, bad)
    rules = (_tension, _end, _waves, _current, _plane, _solver, _output)
    return [line for rule in rules for line in rule(sound)]


def _not_increasing(key: str, series: tuple) -> Iterator[str]:
    for index in range(1, len(series)):
        if not series[index] > series[index - 1]:
            given = f"given {shown(series[index])} after {shown(series[index - 1])}"
            yield f"{key}[{index}]: {given}; allowed: increasing values"
            return


def _tension(sound: _Sound) -> Iterator[str]:
    law = sound.value("tether.tension.law")
    if law == "tanh" and (found := sound.values("tether.tension.p")):
        p1, p2, _, _, p5 = found[0]
        if min(p5, p1 * p2 + p5) < 0:
            rule = "a tension that never falls with strain: p5 >= 0 and p1 p2 + p5 >= 0"
            yield fault("tether.tension.p", list(found[0]), rule)
    if law != "tabulated":
        return
    if found := sound.values("tether.tension.strain"):
        yield from _not_increasing("tether.tension.strain", found[0])
        if found[0][0] <= -1:
            yield fault("tether.tension.strain[0]", found[0][0], "strains above -1")
    if found := sound.values("tether.tension.tension_N"):
        tension = found[0]
        for index in range(1, len(tension)):
            if tension[index] < tension[index - 1]:
                given = f"given {shown(tension[index])} after {shown(tension[index - 1])}"
                yield f"tether.tension.tension_N[{index}]: {given}; allowed: a tension that never falls with strain"
                break
    if (found := sound.values("tether.tension.strain", "tether.tension.tension_N")) and len(found[0]) != len(found[1]):
        yield f"tether.tension.tension_N: given {len(found[1])} values; allowed: as many as strain has, {len(found[0])}"


def _end(sound: _Sound) -> Iterator[str]:
    kind = sound.value("end.kind") or "buoy"
    if kind is _FAULTY:
        return
    if kind == "buoy" and not sound.has("buoy"):
        yield "buoy: missing; allowed: a table, because end.kind is 'buoy'"
    if kind != "buoy" and sound.has("buoy"):
        yield f"buoy: given, but end.kind is {kind!r}; allowed: no buoy, or end.kind = 'buoy'"
    for key, owner in (("position_m", "held"), ("force_N", "free")):
        value = sound.value(f"end.{key}")
        if kind == owner and value is None:
            yield f"end.{key}: missing; allowed: a list of 3 finite numbers [x, y, z], because end.kind is {owner!r}"
        if kind != owner and value not in (None, _FAULTY):
            yield f"end.{key}: given {shown(value)}, but end.kind is {kind!r}; allowed: only with end.kind = {owner!r}"
    found = sound.values("end.force_N", "tether.bending_stiffness_Nm2")
    if kind == "free" and found and not any(found[0]) and found[1] == 0:
        rule = "above 0, because nothing else gives a direction to a free end without a force"
        yield fault("tether.bending_stiffness_Nm2", found[1], rule)
    velocity = sound.values("start.buoy_velocity_mps")
    if kind != "buoy" and velocity and any(velocity[0]):
        yield fault("start.buoy_velocity_mps", list(velocity[0]), f"zero, because end.kind is {kind!r}")


def _waves(sound: _Sound) -> Iterator[str]:
    if not sound.has("waves"):
        return
    if not sound.has("water"):
        yield "water: missing; allowed: a table, because waves are given"
    gravity = sound.values("gravity_mps2")
    if gravity and gravity[0] == 0:
        yield fault("gravity_mps2", gravity[0], "above 0, because waves are given")
    if not isinstance(sound.raw["waves"], dict):
        return
    steepness, amplitude = sound.raw["waves"].get("steepness"), sound.raw["waves"].get("amplitude_m")
    if steepness is None and amplitude is None:
        yield "waves.steepness: missing; allowed: exactly one of waves.steepness and waves.amplitude_m"
    if steepness is not None and amplitude is not None:
        both = f"waves.steepness = {shown(steepness)} and waves.amplitude_m = {shown(amplitude)}"
        yield f"waves: given {both}; allowed: exactly one of the two"
    found = sound.values("waves.amplitude_m", "water.depth_m")
    if found and found[0] >= found[1]:
        yield fault("waves.amplitude_m", found[0], f"less than water.depth_m, {shown(found[1])}")


def _current(sound: _Sound) -> Iterator[str]:
    if not sound.has("current"):
        return
    if not sound.has("water"):
        yield "water: missing; allowed: a table, because a current is given"
    law = sound.value("current.law")
    for axis in ("time_s", "height_m", "x_m") if law in ("profile", "table") else ():
        if found := sound.values(f"current.{axis}"):
            yield from _not_increasing(f"current.{axis}", found[0])
    if law == "profile" and (found := sound.values("current.height_m", "current.velocity_mps")):
        heights, velocities = found
        if len(heights) != len(velocities):
            yield f"current.velocity_mps: given {len(velocities)} vectors; allowed: one for each height, {len(heights)}"
    if law == "table":
        for key in ("velocity_x_mps", "velocity_z_mps"):
            if found := sound.values("current.time_s", "current.height_m", "current.x_m", f"current.{key}"):
                *axes_found, block = found
                yield from _wrong_shape(f"current.{key}", block, tuple(len(axis) for axis in axes_found))


def _wrong_shape(key: str, block: tuple, shape: tuple[int, int, int]) -> Iterator[str]:
    allowed = f"allowed: {shape[0]} times x {shape[1]} heights x {shape[2]} positions"
    if len(block) != shape[0]:
        yield f"{key}: given {len(block)} times; {allowed}"
    for t, layer in enumerate(block):
        if len(layer) != shape[1]:
            yield f"{key}[{t}]: given {len(layer)} heights; {allowed}"
            return
        for z, row in enumerate(layer):
            if len(row) != shape[2]:
                yield f"{key}[{t}][{z}]: given {len(row)} positions; {allowed}"
                return


def _plane(sound: _Sound) -> Iterator[str]:
    dimensions = sound.value("motion.dimensions")
    if dimensions not in (None, 2):
        return
    for key in ("start.buoy_velocity_mps", "end.position_m", "end.force_N"):
        if (found := sound.values(key)) and found[0][1] != 0:
            yield fault(key, list(found[0]), "y = 0 in a plane (motion.dimensions = 2)")
    if found := sound.values("current.velocity_mps"):
        law, velocity = sound.value("current.law"), found[0]
        vectors = velocity if law == "profile" else (velocity,) if law == "uniform" else ()
        for index, vector in enumerate(vectors):
            if vector[1] != 0:
                key = f"current.velocity_mps[{index}]" if law == "profile" else "current.velocity_mps"
                yield fault(key, list(vector), "y = 0 in a plane (motion.dimensions = 2)")
    if found := sound.values("waves.direction_rad"):
        if min(abs(found[0]), abs(abs(found[0]) - math.pi)) > 1e-9:
            yield fault("waves.direction_rad", found[0], "0 or pi in a plane (motion.dimensions = 2)")


def _solver(sound: _Sound) -> Iterator[str]:
    if (found := sound.values("solver.min_step_s", "solver.max_step_s")) and found[0] > found[1]:
        yield fault("solver.min_step_s", found[0], f"at most solver.max_step_s, {shown(found[1])}")


def _output(sound: _Sound) -> Iterator[str]:
    profiles, step = sound.value("output.profiles"), sound.value("output.profiles_step_s")
    if profiles in (None, False) and step not in (None, _FAULTY):
        given = f"given {shown(step)}, but output.profiles is false"
        yield f"output.profiles_step_s: {given}; allowed: only with output.profiles = true"
    vectors, sideways = sound.value("output.tangent_vectors"), sound.value("output.lateral_growth")
    if vectors not in (None, _FAULTY, 0):
        yield from _perturbed(sound, "output.tangent_vectors", vectors, "0")
        nodes = sound.values("tether.nodes")
        if nodes and isinstance(vectors, int) and vectors > 4 * nodes[0]:
            yield fault("output.tangent_vectors", vectors, f"at most four a node, {4 * nodes[0]}")
    if sideways is True:
        yield from _perturbed(sound, "output.lateral_growth", sideways, "false")
        if sound.value("motion.dimensions") not in (None, _FAULTY, 2):
            yield fault("output.lateral_growth", sideways, "false, because a motion in space has no plane to leave")


def _perturbed(sound: _Sound, key: str, given: object, none: str) -> Iterator[str]:
    """What a scene needs to carry perturbations along; `none`: the value of `key` that asks for none."""
    found = sound.values("tether.bending_stiffness_Nm2")
    if found and found[0] == 0:
        yield fault(key, given, f"{none}, because a slack tether without bending has no tangent map")
    integrator = sound.value("solver.integrator")
    if integrator in ("midpoint", "generalized-alpha"):
        because = f"because solver.integrator is {integrator!r}: use esdirk43, trbdf2 or backward-euler"
        yield fault(key, given, f"{none}, {because}")
