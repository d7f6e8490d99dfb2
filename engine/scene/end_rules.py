"""Rules between the values of the two ends of the line: what holds, moves, releases and clamps them."""

from collections.abc import Iterator

from engine.scene.faults import fault, shown
from engine.scene.lookup import FAULTY, Sound, not_increasing

_VECTOR = "a list of 3 finite numbers [x, y, z]"


def _kind(sound: Sound) -> object:
    return sound.value("end.kind") or "buoy"


def end_faults(sound: Sound) -> Iterator[str]:
    """What each kind of upper end needs, and what only one of them may have."""
    kind = _kind(sound)
    if kind is FAULTY:
        return
    if kind == "buoy" and not sound.has("buoy"):
        yield "buoy: missing; allowed: a table, because end.kind is 'buoy'"
    if kind != "buoy" and sound.has("buoy"):
        yield f"buoy: given, but end.kind is {kind!r}; allowed: no buoy, or end.kind = 'buoy'"
    for key, owner in (("position_m", "held"), ("force_N", "free")):
        if kind == owner and sound.value(f"end.{key}") is None:
            yield f"end.{key}: missing; allowed: {_VECTOR}, because end.kind is {owner!r}"
    for key, owner in (
        ("position_m", "held"),
        ("motion", "held"),
        ("release_s", "held"),
        ("force_N", "free"),
        ("force_decay_s", "free"),
    ):
        value = sound.value(f"end.{key}")
        if kind == owner or value is None or value is FAULTY:
            continue
        if (key, kind) != ("force_N", "held"):
            yield f"end.{key}: given {shown(value)}, but end.kind is {kind!r}; allowed: only with end.kind = {owner!r}"
        elif sound.value("end.release_s") is None:
            given = f"given {shown(value)}, but end.kind is 'held' and end.release_s is missing"
            yield f"end.force_N: {given}; allowed: on a free end, or on a held one that is released"
    yield from _slack_and_unbent(sound, kind)
    velocity = sound.values("start.buoy_velocity_mps")
    if kind != "buoy" and velocity and any(velocity[0]):
        yield fault("start.buoy_velocity_mps", list(velocity[0]), f"zero, because end.kind is {kind!r}")


def _slack_and_unbent(sound: Sound, kind: str) -> Iterator[str]:
    force, stiffness = sound.value("end.force_N"), sound.values("tether.bending_stiffness_Nm2")
    let_go = kind == "held" and sound.values("end.release_s") is not None
    if force is FAULTY or not (let_go or (kind == "free" and force is not None)):
        return
    if not any(force or ()) and stiffness and stiffness[0] == 0:
        rule = "above 0, because nothing else gives a direction to a free end without a force"
        yield fault("tether.bending_stiffness_Nm2", stiffness[0], rule)


def motion_faults(sound: Sound) -> Iterator[str]:
    """A tabulated motion of a held end: increasing times, a displacement for each, from its place."""
    if sound.value("end.motion.law") != "table":
        return
    times, displacements = sound.values("end.motion.time_s"), sound.values("end.motion.displacement_m")
    if times:
        yield from not_increasing("end.motion.time_s", times[0])
        if times[0][0] < 0:
            yield fault("end.motion.time_s[0]", times[0][0], "0 or above: the run starts at 0")
    if displacements and any(displacements[0][0]):
        allowed = "[0, 0, 0], because the motion starts from end.position_m"
        yield fault("end.motion.displacement_m[0]", list(displacements[0][0]), allowed)
    if times and displacements and len(times[0]) != len(displacements[0]):
        given = f"given {len(displacements[0])} vectors"
        yield f"end.motion.displacement_m: {given}; allowed: one for each time, {len(times[0])}"


def clamp_faults(sound: Sound) -> Iterator[str]:
    """Clamps and twist: three dimensions only, and only where something resists them."""
    dimensions = sound.value("motion.dimensions")
    clamped = [section for section in ("anchor", "end") if sound.value(f"{section}.rotation") == "clamped"]
    turned = [key for key in ("end.twist_rad", "end.twist_ramp_s") if sound.value(key) not in (None, FAULTY, 0)]
    if dimensions in (None, 2):
        plane = "in a plane (motion.dimensions = 2)"
        for section in clamped:
            yield fault(f"{section}.rotation", "clamped", f"'pinned' {plane}")
        for key in turned:
            yield fault(key, sound.value(key), f"0 {plane}")
    kind = _kind(sound)
    if "end" in clamped and kind not in ("held", FAULTY):
        yield fault("end.rotation", "clamped", f"'pinned', because end.kind is {kind!r}")
    for section in ("anchor", "end"):
        direction = sound.values(f"{section}.direction")
        if direction and sound.value(f"{section}.rotation") in (None, "pinned"):
            given = f"given {shown(list(direction[0]))}, but {section}.rotation is 'pinned'"
            yield f"{section}.direction: {given}; allowed: only with {section}.rotation = 'clamped'"
        elif direction and not any(direction[0]):
            yield fault(f"{section}.direction", list(direction[0]), "a vector that is not zero")
    for section in clamped[:1]:
        found = sound.values("tether.bending_stiffness_Nm2")
        if found and found[0] == 0:
            yield fault("tether.bending_stiffness_Nm2", found[0], f"above 0, because {section}.rotation is 'clamped'")
    if len(clamped) == 2 and sound.value("tether.torsion_stiffness_Nm2") in (None, 0):
        given = sound.value("tether.torsion_stiffness_Nm2") or 0.0
        yield fault("tether.torsion_stiffness_Nm2", given, "above 0, because both ends are clamped")
    both = [sound.value(f"{section}.rotation") for section in ("anchor", "end")]
    if turned[:1] == ["end.twist_rad"] and FAULTY not in both and len(clamped) < 2:
        allowed = "0, or anchor.rotation and end.rotation = 'clamped'"
        yield fault("end.twist_rad", sound.value("end.twist_rad"), allowed)
    if turned == ["end.twist_ramp_s"] and sound.value("end.twist_rad") is not FAULTY:
        yield fault("end.twist_ramp_s", sound.value("end.twist_ramp_s"), "0, because end.twist_rad is 0")
    if clamped and sound.value("solver.scheme") == "paper-box":
        section = clamped[0]
        yield fault(f"{section}.rotation", "clamped", "'pinned', because solver.scheme is 'paper-box'")
