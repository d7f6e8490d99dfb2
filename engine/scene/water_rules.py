"""Rules between the values of a scene (`engine.scene.rules`): water, waves, current, what comes out of the water."""

import math
from collections.abc import Iterator

from engine.physics.strains import strain_at
from engine.physics.tension import LAWS, NAMES
from engine.scene.faults import fault, shown
from engine.scene.sound import Facts, Sound

_DRAGS = "tether.drag_normal", "tether.drag_tangential", "buoy.drag"
# heights of the waves: a scene has one of these
HEIGHTS = ("steepness", "amplitude_m", "significant_steepness", "record", "components", "jonswap")
# and keys that only one of these has a use for
BESIDE = {"significant_steepness": ("relative_width", "component_count", "seed"), "record": ("record_x_m",)}
STEEPEST = 1.0  # k H_s/2 beyond which no sea can be meant
PLANE = "in a plane (motion.dimensions = 2)"
_ALONG = f"0 or pi {PLANE}"


def water(sound: Sound) -> Facts:
    dry, waves = sound["water"] is None, sound["waves"] is not None
    yield dry and waves, "water", "a table, because waves are given"
    yield dry and sound["current"] is not None, "water", "a table, because a current is given"
    yield waves and sound["gravity_mps2"] == 0, "gravity_mps2", "above 0, because waves are given"
    bed = "in water, and above a floor, a height above the bed, 0 or more"
    sunk = (sound["anchor.position_m"] or (0, 0, 0))[2] < 0
    yield sunk and (not dry or sound["floor"] is not None), "anchor.position_m", bed
    depth = sound["water.depth_m"] or math.inf
    for key in ("waves.amplitude_m", "waves.jonswap.significant_height_m"):
        yield (sound[key] or 0) >= depth, key, f"less than water.depth_m, {shown(depth)}"
    yield sound["motion.dimensions"] == 2 and _aslant(sound["waves.direction_rad"]), "waves.direction_rad", _ALONG


def _aslant(angle: float) -> bool:
    """Does a wave in this direction leave the plane?"""
    return bool(angle) and min(abs(angle), abs(abs(angle) - math.pi)) > 1e-9


def sea(sound: Sound) -> Facts:
    """What an irregular sea takes the place of."""
    listed, drawn, gaussian = (
        sound[f"waves.{key}"] is not None for key in ("components", "jonswap", "significant_steepness")
    )
    irregular = listed or drawn or gaussian
    source = "waves.significant_steepness" if gaussian else "waves.jonswap"
    because = "each component has its own" if listed else f"{source} draws those of its components"
    key, width = "waves.relative_width", sound["waves.relative_width"]
    if gaussian and width is None and "waves" in sound.raw:
        yield True, key, "a number from 0 to 0.2, because waves.significant_steepness is given"
    gauge_m, measured = sound["waves.record_x_m"], sound["waves.record"] is not None
    yield bool(gauge_m) and not measured, "waves.record_x_m", "0, because waves.record is not given"
    yield width is not None and not gaussian, key, "none, because waves.significant_steepness is not given"
    k_depth = _deep_water_number(sound)
    highest = min(0.5 * k_depth, STEEPEST) if k_depth else STEEPEST
    steepness, height = sound["waves.significant_steepness"] or 0, sound["waves.jonswap.significant_height_m"]
    yield steepness >= highest, "waves.significant_steepness", f"less than {highest:.4g}: waves break at 0.44"
    if height and k_depth:
        most = 2.0 * STEEPEST * sound["water.depth_m"] / k_depth
        rule = f"less than {most:.4g}, k H_s/2 = {STEEPEST:g} at waves.period_s: waves break at 0.44"
        yield height >= most, "waves.jonswap.significant_height_m", rule
    shortest_s = math.sqrt(2 * math.pi * (sound["buoy.diameter_m"] or 0) / (sound["gravity_mps2"] or math.inf))
    short = irregular and (sound["waves.period_s"] or math.inf) < shortest_s
    yield short, "waves.period_s", f"at least {shortest_s:.3g} s, whose waves are as long as the buoy is wide"
    yield irregular and sound["waves.phase_rad"], "waves.phase_rad", f"0: {because}"
    yield listed and sound["waves.direction_rad"], "waves.direction_rad", f"0: {because}"
    key = "tether.submergence"
    rule = "'full' in irregular waves: only the buoy is cut by the surface of a sea (buoy.submergence)"
    yield irregular and sound[key] == "free-surface", key, rule


def _deep_water_number(sound: Sound) -> float | None:
    """k H of waves.period_s in deep water, below that in any; None where a value is missing."""
    period, depth, g = (sound[key] for key in ("waves.period_s", "water.depth_m", "gravity_mps2"))
    return (2 * math.pi / period) ** 2 * depth / g if period and depth and g else None


def heights(sound: Sound) -> Iterator[str]:
    waves = sound.raw.get("waves")
    if not isinstance(waves, dict):
        return
    values = {name: waves[name] for name in HEIGHTS if waves.get(name) is not None}
    if not values:
        yield "waves.steepness: missing; allowed: exactly one of " + ", ".join(f"waves.{name}" for name in HEIGHTS)
    if "record" in values:
        values.pop("components", None)
    if len(values) > 1:
        several = " and ".join(f"waves.{name} = {shown(value)}" for name, value in values.items())
        yield f"waves: given {several}; allowed: exactly one of them"
    components, depth = sound["waves.components"] or (), sound["water.depth_m"] or math.inf
    total_m = sum(component["amplitude_m"] for component in components)
    if total_m >= depth:
        yield f"waves.components: given amplitudes of {total_m:.6g} m in all; allowed: less than water.depth_m, {depth}"
    highest = STEEPEST * (sound["gravity_mps2"] or math.inf)
    for index, component in enumerate(components):
        key, height = f"waves.components[{index}]", component["amplitude_m"]
        most = highest * (component["period_s"] / (2 * math.pi)) ** 2
        if height >= most:
            yield fault(f"{key}.amplitude_m", height, f"less than {most:.4g}, k A = 1: waves break at 0.44")
        if sound["motion.dimensions"] == 2 and _aslant(component.get("direction_rad")):
            yield fault(f"{key}.direction_rad", component["direction_rad"], _ALONG)


def current(sound: Sound) -> Iterator[str]:
    for axis in ("time_s", "height_m", "y_m", "x_m"):
        yield from sound.increasing(f"current.{axis}")
    if sound["current.law"] == "profile":
        yield from sound.paired("current.velocity_mps", "current.height_m")
    if sound["current.law"] != "table":
        return
    axes = {"times": "time_s", "heights": "height_m", "places along y": "y_m", "places along x": "x_m"}
    if sound["current.y_m"] is None:
        del axes["places along y"]
    sizes = {word: len(sound[f"current.{axis}"] or ()) for word, axis in axes.items()}
    allowed = "allowed: " + " x ".join(f"{size} {word}" for word, size in sizes.items())
    for key in (f"current.velocity_{component}_mps" for component in "xyz"):
        if all(sizes.values()) and sound[key]:
            wrong = _wrong_size(sound[key], list(sizes.items()))
            if wrong:
                yield f"{key}{wrong}; {allowed}"


def _wrong_size(block: object, sizes: list[tuple[str, int]]) -> str:
    """Where nested lists are not of the given sizes, and what is there; empty where they are."""
    if not isinstance(block, (list, tuple)):
        return f": given {shown(block)} in place of {sizes[0][0]}" if sizes else ""
    if not sizes:
        return f": given a list of {len(block)} in place of a number"
    word, size = sizes[0]
    if len(block) != size:
        return f": given {len(block)} {word}"
    for index, part in enumerate(block):
        if wrong := _wrong_size(part, sizes[1:]):
            return f"[{index}]{wrong}"
    return ""


def held_under(sound: Sound) -> Iterator[str]:
    """A line so long that its buoy, the whole sphere loaded as in water, would stand in the air above the sea.

    A uniform current leaves it no lower than its drag on the sphere and on the whole line would, all of it across and
    all of it down. What this bound lets pass, and other currents, the rest itself decides (`engine.time.statics`).
    """
    water, line = "depth_m density_kgpm3", "length_m area_m2 density_kgpm3"
    keys = [f"water.{key}" for key in water.split()] + [f"tether.{key}" for key in line.split()]
    keys += ["buoy.diameter_m", "buoy.mass_kg", "gravity_mps2", "anchor.position_m"]
    values, law = [sound[key] for key in keys], sound["tether.tension"]
    known = sound["current"] is None or sound["current.law"] == "uniform"
    if sound["buoy.submergence"] != "full" or not (known and law and all(values)):
        return
    if isinstance(law, dict):
        module = LAWS[NAMES.index(law["law"])]
        if any(module.faults(sound)):
            return
        law = module.Model.model_validate(law)
    depth, rho, length, area, density, D, mass, g, anchor = values
    lift, weight = (rho * math.pi * D**3 / 6 - mass) * g, (density - rho) * area * length * g
    pull = min(lift, lift - weight)
    if pull <= 0:  # not taut from end to end
        return
    d = sound["tether.diameter_m"] or math.sqrt(4 * area / math.pi)
    C_dp, C_dt, C_d = (sound[key] or 0 for key in _DRAGS)
    stretched = length * (1 + strain_at(max(lift, lift - weight), law))
    dragged = C_d * math.pi * D**2 / 4 + (C_dp + math.pi * C_dt) * d * stretched
    drag = 0.5 * rho * dragged * math.hypot(*sound["current.velocity_mps"] or ()) ** 2
    strain = strain_at(max(lift - weight / 2 - drag, 0), law)
    upright = max(pull - drag, 0) / math.hypot(pull - drag, drag)
    lowest = anchor[2] + length * (1 + strain) * upright - D / 2
    if lowest >= depth and strain < 10:  # beyond, statics says that the law does not carry the load
        rule = (
            f"above {lowest:.6g}, where a line of {length:g} m lets the sphere touch the water; or buoy.submergence = "
        )
        yield fault("water.depth_m", depth, rule + "'spherical-cap', with which it floats")


def cap(sound: Sound) -> Facts:
    """What a buoy that is partly in the water needs."""
    key, cap = "buoy.submergence", sound["buoy.submergence"] == "spherical-cap"
    rule = "'full', because solver.scheme is 'paper-box': eq. (30) as printed has the whole sphere in the water"
    yield cap and sound["solver.scheme"] == "paper-box", key, rule
    yield cap and sound["water"] is None, key, "'full', because there is no water"
    line = sound["tether.submergence"] == "free-surface"
    yield line and sound["water"] is None, "tether.submergence", "'full', because there is no water"
    rule = "0, because buoy.submergence is not 'spherical-cap': the whole sphere is always in the water"
    yield not cap and sound["buoy.impact_loss"], "buoy.impact_loss", rule
