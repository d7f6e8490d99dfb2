"""Rules between the values of a scene: what one value allows another to be. (Of the two ends: `end_rules`.)"""

import math
from collections.abc import Iterator

from engine.physics.tension import LAWS, NAMES
from engine.scene.end_rules import clamp_faults, end_faults, motion_faults
from engine.scene.faults import fault, shown
from engine.scene.lookup import FAULTY, Sound, not_increasing

_HEIGHTS = ("steepness", "amplitude_m", "components", "jonswap")


def cross_faults(raw: dict[str, object], bad: set[tuple[str | int, ...]]) -> list[str]:
    """Every fault between values, one line each.

    raw: the scene as nested dicts (TOML or model_dump). bad: locations of values that are faulty in themselves; a rule
    that needs one of them is not applied.
    """
    if not isinstance(raw, dict):
        return []
    sound = Sound(raw, bad)
    rules = (_tension, end_faults, motion_faults, clamp_faults, _waves, _current, _plane, _solver, _output)
    return [line for rule in rules for line in rule(sound)]


def _tension(sound: Sound) -> Iterator[str]:
    law = sound.value("tether.tension.law")
    if law in NAMES:
        yield from LAWS[NAMES.index(law)].faults(sound)


def _waves(sound: Sound) -> Iterator[str]:
    if not sound.has("waves"):
        return
    if not sound.has("water"):
        yield "water: missing; allowed: a table, because waves are given"
    gravity = sound.values("gravity_mps2")
    if gravity and gravity[0] == 0:
        yield fault("gravity_mps2", gravity[0], "above 0, because waves are given")
    if not isinstance(sound.raw["waves"], dict):
        return
    given = {name: value for name in _HEIGHTS if (value := sound.raw["waves"].get(name)) is not None}
    if not given:
        yield "waves.steepness: missing; allowed: exactly one of " + ", ".join(f"waves.{name}" for name in _HEIGHTS)
    if len(given) > 1:
        several = " and ".join(f"waves.{name} = {shown(value)}" for name, value in given.items())
        yield f"waves: given {several}; allowed: exactly one of them"
    for key in ("waves.amplitude_m", "waves.jonswap.significant_height_m"):
        found = sound.values(key, "water.depth_m")
        if found and found[0] >= found[1]:
            yield fault(key, found[0], f"less than water.depth_m, {shown(found[1])}")
    if "components" in given or "jonswap" in given:
        yield from _sea(sound, "components" in given)


def _sea(sound: Sound, listed: bool) -> Iterator[str]:
    """What an irregular sea takes the place of."""
    phase, angle = sound.value("waves.phase_rad"), sound.value("waves.direction_rad")
    if phase not in (None, FAULTY, 0):
        where = "each component has its own" if listed else "waves.jonswap draws those of its components"
        yield fault("waves.phase_rad", phase, f"0: {where}")
    if listed and angle not in (None, FAULTY, 0):
        yield fault("waves.direction_rad", angle, "0: each component has its own")
    if sound.value("buoy.submergence") not in (None, FAULTY, "full"):
        allowed = "'full' in irregular waves"
        yield fault("buoy.submergence", sound.value("buoy.submergence"), allowed)
    if not listed or not (found := sound.values("waves.components", "water.depth_m")):
        return
    if (total := sum(one["amplitude_m"] for one in found[0])) >= found[1]:
        allowed = f"less than water.depth_m, {shown(found[1])}"
        yield f"waves.components: given amplitudes of {total:.6g} m in all; allowed: {allowed}"
    if sound.value("motion.dimensions") in (None, 2):
        for index, one in enumerate(found[0]):
            heading = one.get("direction_rad", 0.0)
            if min(abs(heading), abs(abs(heading) - math.pi)) > 1e-9:
                key = f"waves.components[{index}].direction_rad"
                yield fault(key, heading, "0 or pi in a plane (motion.dimensions = 2)")


def _current(sound: Sound) -> Iterator[str]:
    if not sound.has("current"):
        return
    if not sound.has("water"):
        yield "water: missing; allowed: a table, because a current is given"
    law = sound.value("current.law")
    for axis in ("time_s", "height_m", "y_m", "x_m") if law in ("profile", "table") else ():
        if found := sound.values(f"current.{axis}"):
            yield from not_increasing(f"current.{axis}", found[0])
    if law == "profile" and (found := sound.values("current.height_m", "current.velocity_mps")):
        heights, velocities = found
        if len(heights) != len(velocities):
            yield f"current.velocity_mps: given {len(velocities)} vectors; allowed: one for each height, {len(heights)}"
    if law == "table":
        yield from _current_table(sound)


def _current_table(sound: Sound) -> Iterator[str]:
    axes = {"times": "time_s", "heights": "height_m", "places along y": "y_m", "places along x": "x_m"}
    if sound.value("current.y_m") is None:
        del axes["places along y"]
    found = sound.values(*(f"current.{axis}" for axis in axes.values()))
    if found is None:
        return
    sizes = {word: len(axis) for word, axis in zip(axes, found, strict=True)}
    allowed = "allowed: " + " x ".join(f"{size} {word}" for word, size in sizes.items())
    for component in "xyz":
        key = f"current.velocity_{component}_mps"
        if block := sound.values(key):
            wrong = _wrong_size(block[0], list(sizes.items()))
            if wrong is not None:
                yield f"{key}{wrong}; {allowed}"


def _wrong_size(block: object, sizes: list[tuple[str, int]]) -> str | None:
    """Where nested lists are not of the given sizes, and what is there; None where they are."""
    if not isinstance(block, (list, tuple)):
        return f": given {shown(block)} in place of {sizes[0][0]}" if sizes else None
    if not sizes:
        return f": given a list of {len(block)} in place of a number"
    word, size = sizes[0]
    if len(block) != size:
        return f": given {len(block)} {word}"
    for index, part in enumerate(block):
        wrong = _wrong_size(part, sizes[1:])
        if wrong is not None:
            return f"[{index}]{wrong}"
    return None


def _plane(sound: Sound) -> Iterator[str]:
    dimensions = sound.value("motion.dimensions")
    if dimensions not in (None, 2):
        return
    for key, vector in _vectors(sound):
        if vector[1] != 0:
            yield fault(key, list(vector), "y = 0 in a plane (motion.dimensions = 2)")
    for key in ("current.y_m", "current.velocity_y_mps") if sound.value("current.law") == "table" else ():
        value = sound.value(key)
        if value not in (None, FAULTY):
            given = f"given {shown(value)}, but motion.dimensions is 2"
            yield f"{key}: {given}; allowed: only with motion.dimensions = 3"
    if found := sound.values("waves.direction_rad"):
        if min(abs(found[0]), abs(abs(found[0]) - math.pi)) > 1e-9:
            yield fault("waves.direction_rad", found[0], "0 or pi in a plane (motion.dimensions = 2)")


def _vectors(sound: Sound) -> Iterator[tuple[str, tuple[float, float, float]]]:
    """Every vector [x, y, z] that has no y in a plane, with its key."""
    single, listed = ["start.buoy_velocity_mps", "end.position_m", "end.force_N"], []
    # keys that depend on a law are checked by themselves under that law only
    for table, law, key, keys in (
        ("current", "uniform", "velocity_mps", single),
        ("current", "profile", "velocity_mps", listed),
        ("end.motion", "harmonic", "amplitude_m", single),
        ("end.motion", "table", "displacement_m", listed),
    ):
        if sound.value(f"{table}.law") == law:
            keys.append(f"{table}.{key}")
    for key in single:
        if found := sound.values(key):
            yield key, found[0]
    for key in listed:
        if found := sound.values(key):
            yield from ((f"{key}[{index}]", vector) for index, vector in enumerate(found[0]))


def _solver(sound: Sound) -> Iterator[str]:
    courant, step = sound.values("solver.courant"), sound.values("solver.step_s")
    if courant and step:
        yield fault("solver.courant", courant[0], "only without solver.step_s, which fixes the step as well")
    integrator = sound.value("solver.integrator") or "esdirk43"
    if courant and integrator in ("esdirk43", "trbdf2"):
        rule = f"only with a method of fixed steps, and solver.integrator is {integrator!r}"
        yield fault("solver.courant", courant[0], rule)
    refined = sound.value("tether.grid_refined")
    if refined in ("lower", "upper") and not sound.value("tether.grid_stretching"):
        yield fault("tether.grid_refined", refined, "'both', because tether.grid_stretching is 0: nothing is refined")
    if (found := sound.values("solver.min_step_s", "solver.max_step_s")) and found[0] > found[1]:
        yield fault("solver.min_step_s", found[0], f"at most solver.max_step_s, {shown(found[1])}")
    stiffness = sound.values("tether.bending_stiffness_Nm2")
    if sound.value("solver.scheme") == "paper-box" and stiffness and stiffness[0] == 0:
        rule = "above 0, because solver.scheme is 'paper-box' and eq. (40) divides by EI"
        yield fault("tether.bending_stiffness_Nm2", stiffness[0], rule)
    if sound.value("buoy.submergence") == "spherical-cap":
        if sound.value("solver.scheme") == "paper-box":
            rule = "'full', because solver.scheme is 'paper-box': eq. (30) as printed has the whole sphere in the water"
            yield fault("buoy.submergence", "spherical-cap", rule)
        if not sound.has("water"):
            yield fault("buoy.submergence", "spherical-cap", "'full', because there is no water")
    elif sound.value("buoy.impact_loss") not in (None, FAULTY, 0):
        rule = "0, because buoy.submergence is not 'spherical-cap': the whole sphere is always in the water"
        yield fault("buoy.impact_loss", sound.value("buoy.impact_loss"), rule)


def _output(sound: Sound) -> Iterator[str]:
    profiles, step = sound.value("output.profiles"), sound.value("output.profiles_step_s")
    if profiles in (None, False) and step not in (None, FAULTY):
        given = f"given {shown(step)}, but output.profiles is false"
        yield f"output.profiles_step_s: {given}; allowed: only with output.profiles = true"
    if sound.value("output.energy") is True:
        yield from _budgeted(sound)
    vectors, sideways = sound.value("output.tangent_vectors"), sound.value("output.lateral_growth")
    if vectors not in (None, FAULTY, 0):
        yield from _perturbed(sound, "output.tangent_vectors", vectors, "0")
        nodes = sound.values("tether.nodes")
        if nodes and isinstance(vectors, int) and vectors > 4 * nodes[0]:
            yield fault("output.tangent_vectors", vectors, f"at most four a node, {4 * nodes[0]}")
    if sideways is True:
        yield from _perturbed(sound, "output.lateral_growth", sideways, "false")


def _budgeted(sound: Sound) -> Iterator[str]:
    """What a scene needs for its energy budget."""
    if sound.value("water") is not None:
        yield fault("output.energy", True, "false, because the budget knows of no water")
    integrator = sound.value("solver.integrator") or "esdirk43"
    if integrator in ("esdirk43", "trbdf2"):
        yield fault("output.energy", True, f"false, because solver.integrator is {integrator!r}: use one of one stage")
    if sound.value("solver.scheme") == "paper-box":
        yield fault("output.energy", True, "false, because solver.scheme is 'paper-box': use 'conservation'")


def _perturbed(sound: Sound, key: str, given: object, none: str) -> Iterator[str]:
    """What a scene needs to carry perturbations along; `none`: the value of `key` that asks for none."""
    if sound.value("solver.shock_viscosity") is not None:
        yield fault(key, given, f"{none}, because solver.shock_viscosity is given")
    found = sound.values("tether.bending_stiffness_Nm2")
    if found and found[0] == 0:
        yield fault(key, given, f"{none}, because a slack tether without bending has no tangent map")
    if sound.value("motion.dimensions") == 3:
        allowed = f"{none}, because motion.dimensions is 3: perturbations are carried along planar motions only"
        yield fault(key, given, allowed)
    if sound.value("solver.scheme") == "paper-box":
        yield fault(key, given, f"{none}, because solver.scheme is 'paper-box': use 'conservation'")
    integrator = sound.value("solver.integrator")
    if integrator in ("midpoint", "generalized-alpha"):
        because = f"because solver.integrator is {integrator!r}: use esdirk43, trbdf2 or backward-euler"
        yield fault(key, given, f"{none}, {because}")
