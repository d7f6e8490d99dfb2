"""Static equilibrium of any scene, by the Newton routine of the dynamics.

With cq = 1 and no drag of motion, the velocity of a stage is the displacement from the last iterate; with cv = mu a
share mu of the masses resists it (N/m per kg). mu falls to zero as the iterates settle, so the last solve is the
static problem itself: at first a damped motion towards equilibrium, at last Newton's quadratic convergence.
Waves are left out; a current bends the tether. Held upper ends move to their place in the first iterate.
"""

import math
from itertools import product

import numpy as np

from ..arrays import Stage
from ..digits import digits
from ..parameters import numbers_of
from ..parameters.scales import buckling_load
from ..physics.strains import strain_at, tension_at
from ..planar import columns as col
from ..planar import state as planar
from ..record import BUOY, FREE, HELD, arc_lengths, has_extras, is_spatial, lengths_of
from ..scene.models import Scene
from ..spatial import lift
from ..spatial import state as spatial
from .newton import newton
from .status import IN_THE_AIR, OK, STATICS_FAILED

SHORT_M = 20.0  # a shorter line meets more resistance, and moves less, in proportion: it rests as one of this length
SOFTEST, FIRST, STIFFEST = 1e-8, 10.0, 1e9
TOLERANCE = 1e-9
CLOSE, BALANCED = 1e-6, 1e-9  # a line at rest moves less (m), against a resistance less than this share of its load
FAR_M = 1.0  # a line that moves so far keeps more of its resistance
MOST = 300  # a stiff line on its way to a clamp passes shear far above its load, by one scale an iteration
MOST_TURNS = 12  # a bight that the grid does not resolve keeps a folded node
# in place of a share of its length: a straight line; a held one as a catenary; one that lies on its bed and then rises
LEANING, HANGING, LYING = 1.0, 0.0, -1.0
SHARPEST = 2  # elements in which it turns upwards
NARROWEST = 1e-3  # of its length: the ends of a catenary are not nearer to each other
MOST_STRAIN = 10.0  # up to which the engine looks for the strain under a load (`scales.strain_at`)
NEARLY_NOTHING = -0.99  # a strain at which next to nothing is left of the line
SINKING = 0.01, 0.1, 1.0, 0.03, 0.3  # into the softest bed, of the length of the line, tried in turn
STIFFER = 10.0  # each bed over the one before
PRESSED = 10.0  # of weight and buckling load together: more compression than that is no rest on a bed
SPANS = 0.95, 0.98, 0.8, 0.9, 0.7, LEANING  # shares of its length that a slack line under a floating buoy spans


def static_equilibrium(record: np.void, scene: Scene, tables: np.ndarray) -> tuple[int, np.ndarray]:
    """Static equilibrium of a scene: a status code and the state. record, tables: parameters of the scene.

    Under a buoy that floats the line may stand upright, pressed together between buoy and anchor: a rest too, but one
    that buckles, or tips over about a pinned anchor where the line is too stiff to buckle, and Newton's method meets it
    as easily as the slack one. Then other guesses are tried, at last a straight line that leans. Of rests that press
    the line by more than its weight the one that does so least counts, if its bending can bear that. On a bed a folded
    line may be such a rest: there other beds to begin with are tried. A sphere that would stand in the air at rest with
    the buoyancy of one in the water has no rest.
    """
    code, Y = _least_pressed(record, scene, tables)
    if code == OK and record["end"] == BUOY and record["wet"] and not record["spherical_cap"]:
        top_m = scene.anchor.position_m[2] + np.trapezoid(lift.stretch_vectors(Y)[:, -1], arc_lengths(record, tables))
        code = IN_THE_AIR if top_m - record["D_buoy"] / 2 >= record["depth"] else OK
    return code, Y


def _least_pressed(record, scene, tables):
    """A status code and, of the rests that all guesses and beds lead to, the one that presses the line least."""
    h, best = lengths_of(record, tables), None
    weight, borne = abs(float(record["w0"])) * float(np.sum(h)), buckling_load(scene.tether, scene.end)
    capped, bedded = bool(record["spherical_cap"]), has_extras(record) and bool(record["floored"])
    for span, sinking in product(SPANS if capped else SPANS[:1], SINKING if bedded else SINKING[:1]):
        code, Y = _rest(record, scene, tables, span, sinking)
        if not (capped or bedded):
            return code, Y
        if code != OK and not bedded:
            break
        least = tension_at(float(Y[:, col.EPS].min()), scene.tether.tension) if code == OK else -math.inf
        folded = bedded and _folded(record, Y)
        if least >= -weight and not folded:
            return OK, Y
        if best is None or (not folded, least) > best[:2]:
            best = not folded, least, Y
    if best is not None and best[1] >= -(PRESSED * (weight + borne) if bedded else weight + borne):
        return OK, best[2]
    return STATICS_FAILED, Y


def _rest(record, scene, tables, span, sinking):
    """A status code and the first rest without a fold within an element to which a guess leads, or the last rest.

    A rest that is folded so seldom lasts.
    """
    code, best = STATICS_FAILED, None
    for Y, above in _guesses(record, scene, lengths_of(record, tables), span, sinking):
        found = _settle_on_bed(record, scene, tables, Y, sinking if above else 0.0)
        if found == OK or best is None:
            code, best = found, Y
        if found == OK and not _folded(record, Y):
            break
    return code, best


def _guesses(record, scene, h, span, sinking):
    """States from which a rest is looked for, and whether they hang above a bed: the first guess, a catenary, a line
    that lies on its bed and then rises, of a line in space its rest in a plane."""
    yield first_guess(record, scene, h, span), True
    if record["end"] == HELD and record["w0"] != 0.0:
        yield first_guess(record, scene, h, HANGING), True
    if record["end"] == BUOY and has_extras(record) and record["floored"] and record["w0"] > 0.0:
        # every attempt turns upwards in more elements than the last one: none is right for all lines
        corner = SHARPEST + SPANS.index(span) * len(SINKING) + SINKING.index(sinking)
        yield first_guess(record, scene, h, LYING, corner), False
    if is_spatial(record):
        flat = _rest_in_plane(record, scene, h, span, sinking)
        if flat is not None:
            yield flat, True


def _rest_in_plane(record, scene, h, span, sinking):
    """The state (n, 13) in space of a line that rests in the plane of its held end; None if it does not."""
    flat = scene.with_values("motion", dimensions=2)
    if record["end"] == HELD:
        x, y, z = scene.end.position_m
        flat = flat.with_values("end", position_m=(math.hypot(x, y), 0.0, z))
    flat_record, tables = numbers_of(flat)
    code, Y = _rest(flat_record, flat, tables, span, sinking)
    if code != OK:
        return None
    return lift.state_in_space(record, h, Y, _azimuth(scene, record))


def largest_turn(Y: np.ndarray) -> float:
    """Largest turn (rad) in one element of a state (n, 6 or 13)."""
    return float(np.abs(np.diff(Y[:, col.PHI])).max() if Y.shape[1] == 6 else lift.turns(Y).max())


def _folded(record, Y):
    """Does a line turn by more than a right angle in one element? Without bending a whole turn is none."""
    if record["bent"]:
        return largest_turn(Y) > 0.5 * math.pi
    q = lift.stretch_vectors(Y)
    return bool(np.min(np.sum(q[1:] * q[:-1], axis=1)) < 0.0)


def _settle_on_bed(record, scene, tables, Y, sinking):
    """As `settle`, with a bed: first one so soft that its line sinks into it, then stiffer ones; 0: with its own."""
    soft = record.copy()
    if sinking and has_extras(record) and record["floored"]:
        softer = sinking * float(np.sum(lengths_of(record, tables))) / float(record["bed_onset"])
        while softer > 1.0:
            soft["bed_stiffness"], soft["bed_onset"] = record["bed_stiffness"] / softer, record["bed_onset"] * softer
            trial = Y.copy()
            if settle(soft, scene, tables, trial) == OK:
                Y[:] = trial
            softer /= STIFFER
    return settle(record, scene, tables, Y)


def settle(record: np.void, scene: Scene, tables: np.ndarray, Y: np.ndarray) -> int:
    """Move the guess Y (n, 6 or 13) to static equilibrium, in place; the velocities come back as zero.

    record: parameter record (not changed). Returns a status code. The loop is Python: a score of Newton solves, and
    nothing more to compile.
    """
    p = record.copy()
    space = is_spatial(p)
    work = (spatial if space else planar).work_arrays.py_func(p, int(p["nodes"]))
    C_tilde = work.C_tilde
    axes = ("end_x", "end_y", "end_z") if space else ("end_x", "end_z")
    velocity = slice(len(axes), 2 * len(axes))
    half = 0.5 * lengths_of(p, tables)[:, None]
    size = min(scene.tether.length_m / SHORT_M, 1.0)
    softest, first, stiffest, close_m = SOFTEST / size, FIRST / size, STIFFEST / size, CLOSE * size
    mu, turns, settled = first, 0, None
    for _ in range(400):
        C_tilde[:, : len(axes)] = lift.stretch_vectors(Y)
        if p["end"] == HELD:
            q = C_tilde[:, : len(axes)]
            x, y, z = scene.end.position_m
            target_m = np.array((x, y, z) if space else (x, z))
            for axis, place in zip(axes, target_m - np.sum(half * (q[1:] + q[:-1]), axis=0), strict=True):
                p[axis] = place
        trial = Y.copy()
        code, _ = newton(p, tables, Stage(0.0, 0.0, 1.0, mu), TOLERANCE, MOST, trial, work)
        if settled is not None and (code != OK or (mu == 0.0 and np.abs(trial[:, velocity]).max() > close_m)):
            Y[:] = settled  # something is free to turn: with less resistance rounding errors move it
            return OK
        if code != OK:
            mu = 100.0 * max(mu, softest)
            if mu > stiffest:
                return STATICS_FAILED
            continue
        moved = np.abs(trial[:, velocity]).max()
        Y[:] = trial
        Y[:, velocity] = 0.0
        if mu == 0.0 and moved < close_m:
            folded = Y[:, col.EPS] < 0.0
            if p["bent"] or not folded.any() or turns == MOST_TURNS:
                return OK
            # without bending compression is no rest: a node turned round carries the same force as tension
            Y[folded, col.EPS] *= -1.0
            if space:
                lift.turn_back(Y, folded)
            else:
                Y[folded, col.PHI] += math.pi
            mu = first
            turns += 1
            continue
        share = mu * moved * float(p["m"]) * 2.0 * np.sum(half) * float(p["per_force"]) / 20.0
        if p["bent"] and 0.0 < mu and moved < close_m and share < BALANCED:
            settled = Y.copy()
        mu = 0.0 if mu <= softest else mu * (0.1 if moved < FAR_M * size else 0.5)
    return STATICS_FAILED


def first_guess(
    record: np.void, scene: Scene, h: np.ndarray, span: float = SPANS[0], corner: int = SHARPEST
) -> np.ndarray:
    """State (n, 6 or 13) from which `settle` starts: loads carried along a line, or an arc where the ends are slack.

    In space it lies in the vertical plane through the held end, or through the force on a free one. span: share of its
    length that a slack line under a floating buoy spans upright; LEANING: straight, at the height at which it floats;
    HANGING: a slack line between held ends is a catenary in place of an arc; LYING: one under a floating buoy lies on
    its bed, and turns upwards within `corner` elements.
    """
    if not is_spatial(record):
        return _in_plane(record, scene, h, (float(record["end_x"]), float(record["end_z"])), span, corner)
    force = (math.hypot(float(record["end_x"]), float(record["end_y"])), float(record["end_z"]))
    return lift.state_in_space(record, h, _in_plane(record, scene, h, force, span, corner), _azimuth(scene, record))


def _azimuth(scene, record):
    """Angle (rad) about z from x of the vertical plane of the held end, or of the force on a free one; else 0."""
    across = {HELD: scene.end.position_m, FREE: scene.end.force_N}.get(int(record["end"]))
    return math.atan2(across[1], across[0]) if across and (across[0] or across[1]) else 0.0


def _in_plane(record, scene, h, force, span, corner):
    s = np.concatenate([[0.0], np.cumsum(h)])
    Y, length = np.zeros((len(s), 6)), s[-1]
    if record["end"] == HELD:
        x, y, z = scene.end.position_m
        x = math.hypot(x, y) if is_spatial(record) else x  # along its azimuth
        if span == HANGING and math.hypot(x, z) < length:
            return _catenary(Y, s, x, z, record["w0"], scene.tether.tension)
        # a heavy line hangs below the chord, a light one above
        sag = 1.0 if (record["w0"] >= 0) == (x >= 0) else -1.0
        return _to_a_place(Y, s, x, z, sag)
    up, height = afloat(record, scene, s) if record["end"] == BUOY else (force[1], None)
    downstream = _downstream(scene.current) or (1.0 if record["w0"] >= 0 else -1.0)
    if height is not None:
        if span == LEANING:
            return _to_a_place(Y, s, downstream * math.sqrt(max(length**2 - height**2, 0.0)), height, downstream)
        if span == LYING:
            return _lying(Y, s, min(height, length), downstream, corner)
        return _to_a_place(Y, s, 0.0, min(height, span * length), downstream)
    Nx = np.full(len(s), force[0] if record["end"] == FREE else 0.0)
    Nz = up - record["w0"] * (length - s)
    T = np.hypot(Nx, Nz)
    Y[:, col.EPS] = [strain_at(load, scene.tether.tension) if load > 0 else 0.0 for load in T]
    angle = np.arctan2(Nz, Nx)
    heaviest = angle[np.argmax(T)] if T.max() > 0 else math.pi / 2
    # where the load changes sign along the line the guess keeps one direction, with compression
    against = np.cos(angle - heaviest) < 0
    Y[:, col.EPS] = np.where(against, 0.0, Y[:, col.EPS])
    Y[:, col.PHI] = np.where(against, heaviest, heaviest + np.angle(np.exp(1j * (angle - heaviest))))
    return Y


def _lying(Y, s, height, downstream, corner):
    """A line that lies downstream on its bed, as far as it is not needed to rise upright to a height (m)."""
    width = corner * s[-1] / (len(s) - 1)
    risen = np.clip(0.5 + (s - (s[-1] - height)) / width, 0.0, 1.0)
    lying = 0.0 if downstream > 0.0 else math.pi
    Y[:, col.PHI] = lying + (0.5 * math.pi - lying) * risen
    Y[:, col.KAPPA] = np.where((risen > 0.0) & (risen < 1.0), (0.5 * math.pi - lying) / width, 0.0)
    return Y


def _downstream(current):
    """1.0 or -1.0: the way along x in which a current flows in the mean; 0.0 if it flows in neither.

    The bight of a slack line lies there. One that begins upstream may settle with a whole turn in an element.
    """
    if current is None:
        return 0.0
    along = current.velocity_x_mps if current.law == "table" else np.atleast_2d(current.velocity_mps)[:, 0]
    return float(np.sign(np.mean(along)))


def _to_a_place(Y, s, x, z, sag):
    """A line stretched straight from the anchor to (x, z), m, or bent to an arc; sag: 1.0 for a bight on the right of
    the way there, -1.0 on the left."""
    length, chord = s[-1], math.hypot(x, z)
    direction = math.atan2(z, x) if chord > 0 else 0.0
    if chord >= length:
        Y[:, col.EPS] = chord / length - 1
        Y[:, col.PHI] = direction
    else:
        half = _arc(chord / length)
        Y[:, col.PHI] = direction + sag * half * (2 * s / length - 1)
        Y[:, col.KAPPA] = 2 * sag * half / length
    return Y


def _catenary(Y, s, x, z, w0, law):
    """A line from the anchor to (x, z), m, as it hangs, or rises where it is light; its strain does not lengthen it.

    Its angle has the tangent (s - s_low)/a, a = H/w of the horizontal force H (Irvine, Cable Structures, 1981).
    """
    from scipy.optimize import brentq

    length, down = s[-1], math.copysign(1.0, w0)
    span_m, rise_m = max(abs(x), NARROWEST * length), down * z
    shape = math.sqrt(max(length**2 - rise_m**2, span_m**2)) / span_m
    half = 1e-3  # of a line that is nearly straight
    if shape > 1.0 + NARROWEST**2:
        half = brentq(lambda u: math.sinh(u) - shape * u, 1e-9, 20.0)
    a = 0.5 * span_m / half
    along = s + 0.5 * (rise_m / math.tanh(half) - length)  # from the lowest point
    ahead = math.copysign(1.0, x)
    Y[:, col.PHI] = np.arctan2(down * along, ahead * a)
    Y[:, col.KAPPA] = down * ahead * a / (a**2 + along**2)
    Y[:, col.EPS] = [strain_at(abs(w0) * height_m, law) for height_m in np.hypot(a, along)]
    return Y


def afloat(record, scene, s):
    """Force (N) with which a buoy holds an upright line, and its height (m) where it floats on a slack one, or None.

    A spherical cap rises until its lift is what the line, longer by then, carries, or until it floats by itself.
    """
    from scipy.optimize import brentq

    full_lift, D, law = float(record["lift"]), float(record["D_buoy"]), scene.tether.tension
    if not record["spherical_cap"] or full_lift <= 0:
        return full_lift, None

    surface = float(record["depth"]) - scene.anchor.position_m[2]  # above the anchor

    def lift(z):
        x = min(max((surface - z) / D + 0.5, 0.0), 1.0)
        return full_lift - float(record["B_whole"]) * (1.0 - x * x * (3.0 - 2.0 * x))

    def left(load):
        """Lift that is not carried where the line is stretched by this load."""
        loads = load - record["w0"] * (s[-1] - s)
        strains = np.array([strain_at(T, law) if T > 0 else 0.0 for T in loads])
        return lift(s[-1] + np.sum(0.5 * np.diff(s) * (strains[1:] + strains[:-1]))) - load

    def zero(function, low, high):
        """Where it is 0, or nearly so: a guess need not have converged, and extreme scenes do not."""
        return brentq(function, low, high, full_output=True, disp=False)[0]

    if left(full_lift) >= 0:
        return full_lift, None
    if left(0.0) > 0:
        return zero(left, 0.0, full_lift), None
    return 0.0, zero(lift, surface - D / 2, surface + D / 2)


def _arc(ratio):
    """Half angle a of a circular arc with chord/length = sin(a)/a = ratio, in (0, pi]."""
    from scipy.optimize import brentq

    if math.sin(math.pi) >= ratio * math.pi:
        return math.pi  # a circle, as far as rounding tells
    return brentq(lambda a: math.sin(a) - ratio * a, 1e-9, math.pi)


def why_no_rest(record: np.void, scene: Scene) -> str:
    """Why `settle` found no rest, as far as can be told: the end of the sentence that `status.ADVICE` begins."""
    law, loads = scene.tether.tension, loads_of(record, scene)
    if loads is not None:
        largest = max(loads)
        carried = tension_at(MOST_STRAIN, law)
        if largest > carried:
            return (
                f"the line has to carry {digits(largest, 4)} N, and tether.tension gives {digits(carried, 4)} N at a "
                f"strain of {MOST_STRAIN:g}; lower the load or raise the stiffness"
            )
        if largest == 0 and not record["bent"]:
            return (
                "nothing pulls on the line and it has no bending stiffness, so that nothing gives it a shape; add "
                "gravity, a force or tether.bending_stiffness_Nm2"
            )
    pull = tension_at(NEARLY_NOTHING, law)
    if pull > 0 and (loads is None or pull > min(loads)):
        return (
            f"tether.tension still pulls with {digits(pull, 4)} N at a strain of {NEARLY_NOTHING:g}; let it fall to "
            "zero where the line is not stretched"
        )
    if scene.floor is not None and scene.end.kind == "held":
        x, y, z = scene.end.position_m
        low = scene.anchor.position_m[2]
        if math.hypot(x, y) + abs(low) + abs(low + z) < scene.tether.length_m:
            return (
                "the line is longer than the way along the bed and straight up to both ends: nothing stretches it "
                "where it lies, because the bed at rest has no friction; shorten it, or move its held end away"
            )
    if scene.floor is not None and scene.end.kind == "buoy":
        mass_kg, displaced_kg = scene.buoy.mass_kg, scene.water.density_kgpm3 * math.pi * scene.buoy.diameter_m**3 / 6.0
        if mass_kg > displaced_kg:
            return (
                f"the buoy, {mass_kg:.5g} kg, displaces {displaced_kg:.5g} kg of water, so that it sinks, and the bed "
                "bears the line alone; lower buoy.mass_kg, or leave out [floor]"
            )
    if record["spherical_cap"]:
        return (
            "the iteration did not settle; where the buoy floats on a slack line (buoy.submergence 'spherical-cap'), "
            "give the line more tether.nodes or tether.bending_stiffness_Nm2, or make water.depth_m larger than its "
            "length"
        )
    return (
        "the iteration did not settle; try more tether.nodes, a tether.tension with stiffness in compression too, a "
        "weaker current, or a held end that the line reaches without being folded"
    )


def loads_of(record: np.void, scene: Scene) -> tuple[float, float] | None:
    """Static forces (N) at the upper and at the lower end, without current.

    None where they follow from the place: of a held end, and of a buoy that may come out of the water.
    """
    if record["end"] == BUOY and not record["spherical_cap"]:
        side, up = 0.0, float(record["lift"])
    elif record["end"] == FREE:
        x, y, up = scene.end.force_N
        side = math.hypot(x, y)
    else:
        return None
    return math.hypot(side, up), math.hypot(side, up - float(record["w0"]) * scene.tether.length_m)
