"""Scenes that a command refuses because they can hardly be meant: a wrong unit, a wave that has long broken.

The engine runs what it is given (`engine.simulate` takes any of these); a command that is about to compute for minutes
asks first. The bounds are wide: what is refused is wrong by a factor, not by a few per cent.
"""

import math
from collections.abc import Iterator

from engine.scene.faults import fault

LONGEST_IN_DEPTHS = 20.0
AREA_RATIO = 100.0
SLENDER = 10.0
LINE_KGPM3, WATER_KGPM3 = (10.0, 30e3), (100.0, 20e3)
PERIODS_S = (0.05, 1000.0)
MOST_STRETCH = 10.0
Odd = tuple[str, object, str]  # key, what is given, what is allowed
PYTHON = "if it is meant, run it from Python: engine.simulate"


def doubts(scene, duration_s: float | None = None) -> Iterator[str]:
    """Fault lines of a scene, and of a run of that length; none where both are plausible.

    A run must end, and memory must hold what it keeps (`engine.parameters.limits`).
    """
    for key, given, allowed in _odd(scene):
        yield fault(key, given, f"{allowed}; {PYTHON}")
    if duration_s:
        from engine.parameters.limits import check_room

        try:
            check_room(scene, duration_s)
        except ValueError as error:
            yield str(error)


def _odd(scene) -> Iterator[Odd]:
    yield from _line(scene)
    if scene.water is not None and not WATER_KGPM3[0] <= scene.water.density_kgpm3 <= WATER_KGPM3[1]:
        yield _density("water.density_kgpm3", scene.water.density_kgpm3, WATER_KGPM3)
    elif scene.water is not None and scene.buoy is not None:
        yield from _buoy(scene)
    if scene.waves is not None:
        yield from _waves(scene)
    law = scene.tether.tension
    if scene.end.kind == "free" and law.law == "tanh":
        (p1, p2, p3, p4, p5), force = law.p, math.hypot(*scene.end.force_N)
        if p1 * math.tanh(p2 * MOST_STRETCH + p3) + p4 + p5 * MOST_STRETCH < force:
            reached = f"a law that reaches the {force:.4g} N of end.force_N below a strain of {MOST_STRETCH:g}"
            yield "tether.tension.p", law.p, f"{reached} (newtons, not kN?)"


def without_waves(name: str, scene) -> Iterator[str]:
    """Why the scene of that name is not one of a buoy in regular waves, in whose periods some campaigns count."""
    waves = scene.waves
    if waves is None or scene.water is None:
        yield f"--scene: given {name!r}, without a buoy in waves; allowed: a scene with a buoy, water and waves"
    elif scene.end.kind != "buoy":
        yield fault("end.kind", scene.end.kind, "'buoy' in this campaign")
    elif waves.irregular:
        seas = "record", "components", "jonswap", "significant_steepness"
        key = next(f"waves.{name}" for name in seas if getattr(waves, name) is not None)
        yield (
            f"{key}: given; allowed: one regular wave in this campaign, which strobes and judges motions once per wave "
            "period; campaigns.sea answers for a sea, campaigns.sweep varies a key in one, and engine.simulate runs "
            "irregular waves (docs/scenes.md#waves)"
        )


def _line(scene) -> Iterator[Odd]:
    tether = scene.tether
    if not LINE_KGPM3[0] <= tether.density_kgpm3 <= LINE_KGPM3[1]:
        yield _density("tether.density_kgpm3", tether.density_kgpm3, LINE_KGPM3)
    most = 0.25 * math.pi * (tether.length_m / SLENDER) ** 2
    if most < tether.area_m2:
        allowed = f"at most {most:.3g}, of a line {SLENDER:g} times as long as thick (m2, not mm2?)"
        yield "tether.area_m2", tether.area_m2, allowed
    circle = 0.25 * math.pi * tether.diameter_m**2
    if not 1.0 / AREA_RATIO < circle / tether.area_m2 < AREA_RATIO:
        allowed = f"about {math.sqrt(4.0 * tether.area_m2 / math.pi):.3g} m, the circle of tether.area_m2"
        yield "tether.diameter_m", tether.diameter_m, f"{allowed} (metres, not millimetres?)"
    if scene.water is not None and tether.length_m > LONGEST_IN_DEPTHS * scene.water.depth_m:
        allowed = f"at most {LONGEST_IN_DEPTHS:g} times water.depth_m, {scene.water.depth_m:g} (metres?)"
        yield "tether.length_m", tether.length_m, allowed


def _density(key: str, given: float, bounds: tuple[float, float]) -> Odd:
    return key, given, f"{bounds[0]:g} to {bounds[1]:g} (kg/m3, not t/m3 or g/cm3?)"


def _buoy(scene) -> Iterator[Odd]:
    buoy, water = scene.buoy, scene.water
    if buoy.diameter_m >= water.depth_m:
        allowed = f"less than water.depth_m, {water.depth_m:g} (metres, not millimetres?)"
        yield "buoy.diameter_m", buoy.diameter_m, allowed
        return
    displaced = water.density_kgpm3 * math.pi * buoy.diameter_m**3 / 6.0
    if buoy.mass_kg >= displaced:
        allowed = f"less than the {displaced:.4g} kg of water that it displaces, or it sinks"
        yield "buoy.mass_kg", buoy.mass_kg, allowed
    law = scene.tether.tension
    lift = (displaced - buoy.mass_kg) * scene.gravity_mps2
    if law.law == "linear" and lift > MOST_STRETCH * law.stiffness_N:
        allowed = f"{lift / MOST_STRETCH:.3g} N at least, as the buoy pulls with {lift:.4g} N (newtons, not kN?)"
        yield "tether.tension.stiffness_N", law.stiffness_N, allowed


def _waves(scene) -> Iterator[Odd]:
    waves = scene.waves
    if not PERIODS_S[0] <= waves.period_s <= PERIODS_S[1]:
        allowed = f"{PERIODS_S[0]:g} to {PERIODS_S[1]:g} s (seconds, not milliseconds?)"
        yield "waves.period_s", waves.period_s, allowed
        return
    if abs(waves.direction_rad) > 2.0 * math.pi:
        allowed = f"-2 pi to 2 pi rad (radians, not degrees: {math.radians(waves.direction_rad):.4g}?)"
        yield "waves.direction_rad", waves.direction_rad, allowed
    from engine.physics.waves import breaking_steepness, wave_number

    k = wave_number(waves.period_s, scene.water.depth_m, scene.gravity_mps2)
    limit = breaking_steepness(k, scene.water.depth_m)
    for key, given, steepness in (
        ("steepness", waves.steepness, 1.0),
        ("amplitude_m", waves.amplitude_m, k),
        ("significant_steepness", waves.significant_steepness, 1.0),
        ("jonswap.significant_height_m", getattr(waves.jonswap, "significant_height_m", None), k / 2.0),
    ):
        if given is not None and given * steepness > limit:
            percent = " (a share, not per cent?)" if key == "steepness" and given > 1.0 else ""
            most = f"at most {limit / steepness:.3f}"
            yield f"waves.{key}", given, f"{most}, where a wave of {waves.period_s:g} s breaks in this depth{percent}"
        elif given is not None:
            yield from _too_long(scene, k, 2.0 * given * steepness / k)


def _too_long(scene, k: float, height_m: float) -> Iterator[Odd]:
    """A wave of wave number k (rad/m) that is too long for its height in this depth to be linear."""
    from engine.physics.waves import MOST_URSELL, ursell_number

    ursell = ursell_number(k, height_m, scene.water.depth_m)
    if ursell > MOST_URSELL:
        beyond = (
            f"H L^2/depth^3 = {ursell:.3g} is above {MOST_URSELL:g}, where waves are no longer linear (Hedges 1995)"
        )
        yield "waves.period_s", scene.waves.period_s, f"a shorter period or lower waves, because {beyond}"
