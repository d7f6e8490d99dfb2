"""A massless tether with a point buoy: what it does from hundreds of starts in a second, to know where to look.

Four numbers are its state. The equations are those of the buoy at the end of the cable, eq. (30); a line without mass,
drag and bending has a tension and a direction only. `engine.massless.kernels` has the equations and the steps.
"""

import math
from dataclasses import dataclass

import numpy as np

from ..natural_frequencies import natural_frequencies
from ..parameters import numbers_of
from ..parameters.cover import has_rare_laws
from ..physics.strains import strain_at, tension_at
from ..physics.tension import LAWS, NAMES
from ..scene.models import Scene
from ..simd.vector import COUNT, REAL, WHOLE, fields_of, lane_zeros

# in a wave period, or in one of the radial motion where that is shorter
STEPS_PER_PERIOD = {"full": 40, "spherical-cap": 80}


@dataclass(frozen=True, eq=False)
class MasslessRuns:
    """What k starts do in p wave periods; NaN from the period on in which a state ceases to be finite.

    strobed   (k, p + 1, 4)  x, z (m), U, W (m/s) at the beginning of every wave period, and at the end of the last
    measures  (k, p, 3)      least and largest distance r (m) from the anchor, and largest tension (N), of each period
    """

    strobed: np.ndarray
    measures: np.ndarray


def massless_covers(scene: Scene) -> bool:
    """Has a scene a massless model: a buoy that floats, regular waves in a plane, no current or a uniform one?"""
    return why_not_covered(scene) is None


def massless_runs(
    scene: Scene, starts: np.ndarray, periods: int, steps_per_period: int | None = None, first_period: int = 0
) -> MasslessRuns:
    """Move a point buoy on a massless tether from many starts, by a method of order 4 with equal steps.

    starts            (k, 4) x, z (m, from the anchor), U, W (m/s) of the buoy
    periods           wave periods to follow them
    steps_per_period  by default 40, or 80 of a wetted cap, more where the radial natural period is shorter than the
                      wave's: nine of ten kicks of up to 6 m/s end within 1e-3 m after ten periods
    first_period      wave periods that have passed at the starts: runs go on from strobed[:, -1] bit for bit

    Bending, weight, inertia and drag of the line are left out, all else is the scene's. Returns MasslessRuns. A start
    that flies off becomes NaN. Raises ValueError for a scene without a massless model and for a bad argument.
    """
    record, tables = _parameters(scene)
    starts = np.ascontiguousarray(starts, float)
    if starts.ndim != 2 or starts.shape[1] != 4:
        raise ValueError(f"starts has the shape {starts.shape}; allowed: (k, 4), rows of x, z, U, W")
    steps = _steps(scene) if steps_per_period is None else steps_per_period
    counts = {"periods": (periods, 1), "steps_per_period": (steps, 1), "first_period": (first_period, 0)}
    for name, (number, least) in counts.items():
        if number < least or number != int(number):
            raise ValueError(f"{name} is {number}; allowed: a whole number from {least} on")
    settings = scene.tether.length_m, scene.waves.period_s, int(first_period), int(steps)
    return MasslessRuns(*_march(scene, record, tables, starts, int(periods), settings))


def massless_rest(scene: Scene) -> tuple[float, float]:
    """Place (x, z), m, at which the tension carries buoyancy less weight and the drag of a current, without waves.

    A wetted cap rises until its lift is the tension, or until it floats above a slack line. Raises ValueError for a
    scene without a massless model, and for a law that carries that load at no strain.
    """
    from ..time.statics import afloat

    record, _ = _parameters(scene)
    record["w0"] = 0.0
    length, law = scene.tether.length_m, scene.tether.tension
    up, floats_at = afloat(record, scene, np.array([0.0, length]))
    if floats_at is not None:
        return 0.0, floats_at
    u, _, w = scene.current.velocity_mps if scene.current is not None else (0.0, 0.0, 0.0)
    drag = float(record["C_buoy"]) * math.hypot(u, w)
    load = math.hypot(drag * u, up + drag * w)
    strain = strain_at(load, law)
    if abs(tension_at(strain, law) - load) > 1e-6 * load:
        raise ValueError(f"tether.tension gives no strain at which the line carries {load:.4g} N")
    r = length * (1.0 + strain)
    return r * drag * u / load, r * (up + drag * w) / load


def why_not_covered(scene: Scene) -> str | None:
    """What a scene has that the massless model does not cover, in words; None where it covers the scene."""
    current, waves, buoy = scene.current, scene.waves, scene.buoy
    if scene.end.kind != "buoy" or scene.motion.dimensions != 2:
        return "an upper end that is not a buoy, or three dimensions"
    if waves is None or waves.irregular:
        return "no waves, or irregular ones: it counts in wave periods"
    if current is not None and (current.law != "uniform" or buoy.submergence != "full"):
        return "a current that is not uniform, or one about a wetted cap"
    if has_rare_laws(scene):
        return "a line with damping, a surface, a floor, an anchor of its own or the whole push of the water"
    volume = math.pi / 6.0 * buoy.diameter_m**3
    if scene.water.density_kgpm3 * volume <= buoy.mass_kg:
        return "a buoy that sinks"
    return None


def _parameters(scene):
    """Parameter record and tables; refuses a scene that the model does not cover."""
    if reason := why_not_covered(scene):
        raise ValueError(f"the massless tether does not cover this scene: {reason}")
    return numbers_of(scene)


def _march(scene, record, tables, starts, periods, settings):
    """Arrays of MasslessRuns; side by side but for a law that is looked up in a table."""
    from .kernels import march, march_lanes

    k = len(starts)
    if not LAWS[NAMES.index(scene.tether.tension.law)].IN_LANES:
        strobed, measures = np.full((k, periods + 1, 4), np.nan), np.full((k, periods, 3), np.nan)
        X, F = np.zeros((1, 2)), np.zeros((1, 4))
        for i, start in enumerate(starts):
            march(record, tables, *settings, tuple(start), strobed[i], measures[i], X, F)
        return strobed, measures
    blocks = -(-k // COUNT)
    shapes = (len(REAL),), (blocks, 4), (blocks, periods + 1, 4), (blocks, periods, 3), (1, 2), (1, 4)
    arrays = tuple(lane_zeros(*shape) for shape in shapes)
    values, side_by_side, strobed, measures = arrays[:4]
    values[:] = np.array(fields_of(record, REAL))[:, None]
    side_by_side[:] = np.resize(starts, (blocks, COUNT, 4)).transpose(0, 2, 1)
    strobed[:] = measures[:] = np.nan
    counts = np.array(fields_of(record, WHOLE))
    march_lanes(np.zeros(1, record.dtype), counts, arrays, tables, *settings)
    lanes = strobed, measures
    return tuple(np.moveaxis(array, -1, 1).reshape(-1, *array.shape[1:-1])[:k] for array in lanes)


def _steps(scene):
    """Steps a wave period, by the faster of waves and radial motion under the load of the whole sphere."""
    modes = natural_frequencies(scene.with_values("buoy", submergence="full"))
    steps = STEPS_PER_PERIOD[scene.buoy.submergence]
    return math.ceil(steps * max(1.0, modes.radial_radps / modes.wave_radps if modes else 1.0))
