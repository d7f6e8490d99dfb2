"""Rules between the values of a scene: what one value allows another to be.

The rules of water, waves and what comes out of the water are in `water_rules`.
"""

import math
from collections.abc import Iterator

from pydantic import BaseModel

from engine.physics import drag, tension
from engine.scene.faults import Location, fault
from engine.scene.sound import FAULTY, Facts, Sound
from engine.scene.water_rules import PLANE, cap, current, heights, held_under, sea, water

_PUSHED = ("start.buoy_velocity_mps", "start.buoy_displacement_m")
_VECTORS = (
    *_PUSHED,
    "anchor.position_m",
    "end.position_m",
    "end.force_N",
    "current.velocity_mps",
    "end.motion.amplitude_m",
    "end.motion.displacement_m",
)
_OWNERS = {"position_m": "held", "motion": "held", "release_s": "held", "force_N": "free", "force_decay_s": "free"}
_BENDING = "tether.bending_stiffness_Nm2"


def cross_faults(raw: dict[str, object], bad: set[Location], model: type[BaseModel]) -> list[str]:
    """Every fault between values, a line each; arguments as of `Sound`. A rule that needs a bad value is left out."""
    if not isinstance(raw, dict):
        return []
    sound = Sound(raw, bad, model)
    rules = (water, sea, _ends, _clamps, _solver, cap, _output)
    lines = [sound.fault(key, allowed) for rule in rules for broken, key, allowed in rule(sound) if broken]
    for rule in (_laws, heights, held_under, current, _moved_end, _plane):
        lines += rule(sound)
    return lines


def _laws(sound: Sound) -> Iterator[str]:
    for family, key in ((tension, "tether.tension.law"), (drag, "tether.drag.law")):
        if sound[key] in family.NAMES:
            yield from family.LAWS[family.NAMES.index(sound[key])].faults(sound)


def _ends(sound: Sound) -> Facts:
    """What each kind of upper end needs, and what only one of them may have."""
    kind = sound["end.kind"]
    if kind is FAULTY:
        return
    because = f"because end.kind is {kind!r}"
    yield kind == "buoy" and sound["buoy"] is None, "buoy", f"a table, {because}"
    yield kind != "buoy" and sound["buoy"] is not None, "buoy", f"none, {because} and not 'buoy'"
    for key, owner in _OWNERS.items():
        value, needed = sound[f"end.{key}"], key in ("position_m", "force_N")
        yield needed and kind == owner and value is None, f"end.{key}", f"a vector [x, y, z], {because}"
        only = f"only with end.kind = {owner!r}, and it is {kind!r}"
        yield value and kind != owner and (key, kind) != ("force_N", "held"), f"end.{key}", only
    force, let_go = sound["end.force_N"], kind == "held" and sound["end.release_s"] is not None
    allowed = "on a free end, or on a held one that is released, and end.release_s is missing"
    yield force and kind == "held" and not let_go, "end.force_N", allowed
    loose = let_go or (kind == "free" and force is not None)
    pulled = force is FAULTY or any(force or ())
    allowed = "above 0, because nothing else gives a direction to a free end without a force"
    yield loose and not pulled and sound[_BENDING] == 0, _BENDING, allowed
    for key in _PUSHED:
        yield kind != "buoy" and any(sound[key] or ()), key, f"zero, {because}"


def _moved_end(sound: Sound) -> Iterator[str]:
    """A tabulated motion of a held end: increasing times, a displacement for each, from its place."""
    if sound["end.motion.law"] != "table":
        return
    times, displacements = "end.motion.time_s", "end.motion.displacement_m"
    yield from sound.increasing(times)
    yield from sound.paired(displacements, times)
    first, start = sound[times] or (0,), sound[displacements] or ((0, 0, 0),)
    if first[0] < 0:
        yield fault(f"{times}[0]", first[0], "0 or above: the run starts at 0")
    if any(start[0]):
        yield fault(f"{displacements}[0]", start[0], "[0, 0, 0], because the motion starts from end.position_m")


def _clamps(sound: Sound) -> Facts:
    """Clamps and twist: three dimensions only, and only where something resists them."""
    plane, kind, box = sound["motion.dimensions"] == 2, sound["end.kind"], sound["solver.scheme"] == "paper-box"
    twist, ramp = sound["end.twist_rad"], sound["end.twist_ramp_s"]
    rotations = {section: sound[f"{section}.rotation"] for section in ("anchor", "end")}
    for section, rotation in rotations.items():
        key, clamped, direction = f"{section}.rotation", rotation == "clamped", sound[f"{section}.direction"]
        yield clamped and plane, key, f"'pinned' {PLANE}"
        yield clamped and box, key, "'pinned', because solver.scheme is 'paper-box'"
        yield clamped and sound[_BENDING] == 0, _BENDING, f"above 0, because {key} is 'clamped'"
        allowed = f"only with {key} = 'clamped', and it is 'pinned'"
        yield direction and rotation == "pinned", f"{section}.direction", allowed
        yield direction and clamped and not any(direction), f"{section}.direction", "a vector that is not zero"
    clamped = rotations["end"] == "clamped"
    yield clamped and kind in ("buoy", "free"), "end.rotation", f"'pinned', because end.kind is {kind!r}"
    twistable, torsion = clamped and rotations["anchor"] == "clamped", "tether.torsion_stiffness_Nm2"
    yield twistable and sound[torsion] == 0, torsion, "above 0, because both ends are clamped"
    yield plane and twist, "end.twist_rad", f"0 {PLANE}"
    yield plane and ramp, "end.twist_ramp_s", f"0 {PLANE}"
    allowed = "0, or anchor.rotation and end.rotation = 'clamped'"
    yield twist and "pinned" in rotations.values(), "end.twist_rad", allowed
    yield ramp and twist in (None, 0), "end.twist_ramp_s", "0, because end.twist_rad is 0"


def _plane(sound: Sound) -> Iterator[str]:
    """Vectors [x, y, z], alone or in a list, and currents have no y in a plane."""
    if sound["motion.dimensions"] != 2:
        return
    for key in _VECTORS:
        value = sound[key] or ()
        listed = bool(value) and isinstance(value[0], (list, tuple))
        places = [(f"{key}[{index}]", vector) for index, vector in enumerate(value)] if listed else [(key, value)]
        for place, vector in places:
            if any(vector[1:2]):
                yield fault(place, list(vector), f"y = 0 {PLANE}")
    for key in ("current.y_m", "current.velocity_y_mps"):
        if sound[key]:
            yield sound.fault(key, "only with motion.dimensions = 3, and it is 2")


def _solver(sound: Sound) -> Facts:
    courant, step, integrator = (sound[f"solver.{key}"] for key in ("courant", "step_s", "integrator"))
    yield courant and step, "solver.courant", "only without solver.step_s, which fixes the step as well"
    rule = f"only with a method of fixed steps, and solver.integrator is {integrator!r}"
    yield courant and integrator in ("esdirk43", "trbdf2"), "solver.courant", rule
    refined = sound["tether.grid_refined"] in ("lower", "upper")
    even = "'both', because tether.grid_stretching is 0: nothing is refined"
    yield refined and not sound["tether.grid_stretching"], "tether.grid_refined", even
    longest = sound["solver.max_step_s"] or math.inf
    yield (sound["solver.min_step_s"] or 0) > longest, "solver.min_step_s", f"at most solver.max_step_s, {longest}"
    box, because = sound["solver.scheme"] == "paper-box", "because solver.scheme is 'paper-box'"
    yield box and sound[_BENDING] == 0, _BENDING, f"above 0, {because} and eq. (40) divides by EI"
    for key in (_PUSHED[1], "anchor.position_m"):
        yield box and any(sound[key] or ()), key, f"zero, {because}"
    line = sound["tether.submergence"] == "free-surface"
    yield box and line, "tether.submergence", f"'full', {because}"
    yield box and sound["tether.froude_krylov"] == "whole", "tether.froude_krylov", f"'normal', {because}"
    yield box and sound["floor"] is not None, "floor", f"none, {because}"
    law = sound["tether.drag.law"]
    yield box and law in drag.NAMES and law != "quadratic", "tether.drag.law", f"'quadratic', {because}"
    share, damping = "tether.damping_critical", "tether.damping_Ns"
    yield sound[share] and sound[damping], share, f"only without {damping}, which says the same"
    for key in (share, damping):
        yield box and sound[key], key, f"0, {because}"


def _output(sound: Sound) -> Facts:
    box, integrator = sound["solver.scheme"] == "paper-box", sound["solver.integrator"]
    profiled = "only with output.profiles = true, and it is false"
    yield sound["output.profiles_step_s"] and sound["output.profiles"] is False, "output.profiles_step_s", profiled
    because, scheme = f"because solver.integrator is {integrator!r}", "because solver.scheme is 'paper-box'"
    energy = sound["output.energy"]
    yield energy and sound["water"] is not None, "output.energy", "false, because the budget knows of no water"
    staged = energy and integrator in ("esdirk43", "trbdf2")
    yield staged, "output.energy", f"false, {because}: use one of one stage"
    yield energy and box, "output.energy", f"false, {scheme}: use 'conservation'"
    for key, none in (("output.tangent_vectors", "0"), ("output.lateral_growth", "false")):
        carried = sound[key]
        viscous = sound["solver.shock_viscosity"] is not None
        yield carried and viscous, key, f"{none}, because solver.shock_viscosity is given"
        slack = f"{none}, because a slack tether without bending has no tangent map"
        yield carried and sound[_BENDING] == 0, key, slack
        plane = f"{none}, because motion.dimensions is 3: perturbations are carried along planar motions only"
        yield carried and sound["motion.dimensions"] == 3, key, plane
        yield carried and box, key, f"{none}, {scheme}: use 'conservation'"
        method = f"{none}, {because}: use esdirk43, trbdf2 or backward-euler"
        yield carried and integrator in ("midpoint", "generalized-alpha"), key, method
    limit = 4 * (sound["tether.nodes"] or math.inf)
    too_many = (sound["output.tangent_vectors"] or 0) > limit
    yield too_many, "output.tangent_vectors", f"at most four a node, {limit}"
