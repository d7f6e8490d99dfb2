"""How far the tensions of a finished run hold: sentences for its message, each of one cause."""

import math
from typing import TYPE_CHECKING

import numpy as np

from ..digits import digits
from ..parameters.limits import longest_step
from ..parameters.scales import fastest_wave, jumps_of, ringing_period, wave_beyond
from ..physics.sea import AMPLITUDE, OMEGA, RECURRENCES, SPEED, K, rows_of
from ..physics.strains import tension_at
from ..physics.waves import MOST_URSELL, breaking_steepness, ursell_number, wave_number
from ..planar.columns import EPS  # in space the same column
from ..record import AT_Z, HELD, is_spatial, lengths_of
from ..scene.models import Scene
from ..spatial import lift
from ..time.folds import words_of_folds
from ..time.ringing import HEARD
from ..time.status import OK, WAVES_ON_ELEMENT
from ..trajectory.columns import Columns, largest_along
from .companions import NOTED, ROUNDING, SLACK, compression_N, other_grids, slack_samples, steps_too_long
from .rest import rest_of

if TYPE_CHECKING:
    from . import Run

MUCH = 0.5  # share of the energy of a sea
MANY = 8  # waves from which on a sea is meant to be random
STEEPEST = math.pi / 15.0  # k H_s/2 of seas in nature (DNV-RP-C205, 3.5.4: H_s is at most 1/15 of the length)
FASTER = 1.2  # times the speed at still water, to which waves are extrapolated
BENT = 0.5  # turn (rad) in an element at rest below which a finer grid has the same tension within 1 %
LONGER = 2.0  # bends of a line at its clamp: a longer element there makes tensions wrong by over a hundredth
SLACK_ERROR = 0.03  # two standard deviations of a slack fraction: a smaller error is not told
ENOUGH_SAMPLES = 4.0 / (12.0 * SLACK_ERROR**2)  # in which even a crossing at each would leave a smaller one
FEW_SAMPLES = 10  # from crossing to crossing, on average
UNBUCKLED = 4.0  # elements in a buckle: fewer keep it from growing
FINER = 4  # times the elements, of the line at rest with which a bent one is compared


def doubts_of(run: "Run", columns: Columns) -> str:
    """What the user has to know of a run that came to its end, before using its numbers; empty where there is nothing.

    columns: of its trajectory.
    """
    record, scene = run.record, run.scene
    inexact = [
        _coarse_at_rest(run),
        _folded_at_rest(run),
        bent_at_clamp(run),
        steps_too_long(run, columns),
        blows(record, scene, columns),
        unresolved(record, run.tables, scene, columns),
    ]
    bounds = [
        _unsteady_at_rest(run),
        _undamped(run, columns),
        _pressed_together(run, columns),
        _folded(run, columns),
    ]
    others = other_grids(run, columns, doubted=any(inexact), bounded=any(bounds))
    if not others.agree:
        inexact += bounds
    doubtful = (
        _few_samples(run, columns),
        _waves_on_element(run),
        _beyond_the_table(run, columns),
        _regular_waves(run),
        *_sea(run, columns),
    )
    return "; ".join(filter(None, (*inexact, others.words, *doubtful)))


def _folded(run, columns):
    """What folds that are smaller than an element say of a held line (`words_of_folds`), or nothing."""
    return words_of_folds(run.scene, run.state, columns) if run.record["end"] == HELD else ""


def _coarse_at_rest(run):
    """Says that a line which is bent at rest has another tension at the top on a finer grid, or nothing."""
    if run.rest is None or run.rest.turn < BENT:
        return ""
    nodes = FINER * (run.scene.tether.nodes - 1) + 1
    finer = rest_of(run.scene.with_values("tether", nodes=nodes))
    top_N = run.rest.top_N
    if finer.status != OK or abs(top_N - finer.top_N) <= NOTED * max(abs(top_N), abs(finer.top_N)):
        return ""
    return (
        f"at rest the top bears {digits(top_N, 4)} N on this grid and {digits(finer.top_N, 4)} N on {nodes} nodes: "
        "add tether.nodes"
    )


def _few_samples(run, columns):
    """Says how far the slack fraction holds where the line often snaps from one sample to the next, or nothing.

    A crossing lies anywhere between two samples, with a standard deviation of a step over the root of 12.
    """
    if run.started is not None or len(columns["time_s"]) > ENOUGH_SAMPLES:
        return ""
    slack = slack_samples(run.scene, columns)
    crossings = np.count_nonzero(slack[1:] != slack[:-1])
    error = 2.0 * math.sqrt(crossings / 12.0) / len(slack)
    if error <= SLACK_ERROR or len(slack) > FEW_SAMPLES * crossings:
        return ""
    return (
        f"the tension passes {SLACK:.0%} of its static value {crossings} times in {len(slack)} samples: the slack "
        f"fraction holds to {error:.1g}; lower output.step_s"
    )


def _folded_at_rest(run):
    """Says that an element of a line which nothing keeps from bending turns by more than a right angle, or nothing."""
    if run.rest is None or run.record["bent"] or run.rest.turn <= 0.5 * math.pi:
        return ""
    return (
        "at rest an element is folded, because the grid does not resolve the bight of a line without bending "
        "stiffness: add tether.nodes, or set tether.bending_stiffness_Nm2"
    )


def bent_at_clamp(run: "Run") -> str:
    """Says that the grid does not resolve the bend of a line at its clamp, or nothing.

    It bends there within sqrt(EI/T). Longer elements take this for a bend all along them. With a clamp that leans by 60
    degrees the shipped buoy on a line of 4 N m2 (45 mm) pulls with 3551, 3394 and 3357 N on elements of 0.25, 0.13 and
    0.03 m.
    """
    rest = run.rest
    if rest is None or rest.status != OK or not is_spatial(run.record):
        return ""
    turns, lengths = lift.turns(rest.Y)[[0, -1]], lengths_of(run.record, run.tables)[[0, -1]]
    bent = (turns > BENT) & [bool(run.record["clamp_below"]), bool(run.record["clamp_above"])]
    element_m = float(np.max(lengths, where=bent, initial=0.0))
    most_N = tension_at(float(rest.Y[:, EPS].max()), run.scene.tether.tension)
    if element_m**2 * most_N <= LONGER**2 * run.record["EI"]:
        return ""
    return (
        f"at a clamp the line bends within {math.sqrt(run.record['EI'] / most_N):.2g} m, and the element there is "
        f"{element_m:.2g} m long: tensions are those of the grid; pin the end, or refine the grid (tether.nodes, "
        "tether.grid_stretching)"
    )


def _waves_on_element(run):
    """Says what the uppermost element takes for the force of waves that do not reach so far down, or nothing."""
    record = run.record
    length, top_m = float(lengths_of(record, run.tables)[-1]), run.output.samples[:1, AT_Z].sum()
    top_m += run.scene.anchor.position_m[2]
    force_N = wave_beyond(record, length, float(top_m))
    if force_N <= HEARD * tension_at(1.0 / record["per_strain"], run.scene.tether.tension):
        return ""
    return WAVES_ON_ELEMENT.format(length=length, depth=1.0 / record["k"], force=digits(force_N, 2))


def _beyond_the_table(run, columns):
    """Says that the line was pulled beyond the last measured point of its tension law, or nothing."""
    law = run.scene.tether.tension
    damped = run.scene.tether.damping_Ns or run.scene.tether.damping_critical  # which has a part in the tension
    if law.law != "tabulated" or damped:
        return ""
    largest_N = float(largest_along(columns, run.scene.tether.length_m)[0].max())
    if not largest_N > law.tension_N[-1]:
        return ""
    return (
        f"the line bears {digits(largest_N, 4)} N, and tether.tension is measured up to {law.tension_N[-1]:g} N: the "
        "law goes on along its last slope; add points"
    )


def _undamped(run, columns):
    """Says of a moored buoy, or of a held line in water, that nothing calms the folds of its slack line, or nothing.

    On 21, 41 and 81 nodes the largest tensions of the shipped buoy without drag of the line differ by 4 % (kA = .03 and
    .1); with drag along the line alone, with a thousandth of its drag, or with tether.damping_critical = .1, by less
    than .1 %. A held line needs drag across it: with drag along it alone, the scene 7/50 of benchmarks.random_scenes
    bears 529 to 604 N at most on seven grids and tolerances, and 414.3 to 414.6 N with drag across it. Dry lines have
    neither; of them other grids tell (companions.other_grids).
    """
    scene, record, tether = run.scene, run.record, run.scene.tether
    if scene.buoy is None:
        calmed = record["cn"] > 0.0 or not record["wet"]
    else:
        calmed = max(record["cn"], record["ct"]) > 0.0
    if calmed or tether.damping_Ns or tether.damping_critical or columns["tension_top_low_N"].min() > 0.0:
        return ""
    missing = "drag across it" if scene.buoy is None else "drag"
    return (
        f"the line goes slack and has neither {missing} nor damping, so that its folds never calm down and the "
        "tensions of later snaps depend on grid and tolerance: set tether.drag_normal, or tether.damping_critical = 0.1"
    )


def _unsteady_at_rest(run):
    """Says that at rest a buoy lies below its line and presses it upwards: the first motion ends this equilibrium.

    A line that floats presses its buoy where it is longer than the way up. It does not fall. On 41, 81 and 161 nodes
    the largest tensions of three such moorings of benchmarks.random_moorings differ by .3 % at most. Those of a fourth,
    which is slack for two thirds of the time, differ by 3 % at its first snap and by 1 % later.
    """
    scene, rest = run.scene, run.rest
    if scene.buoy is None or rest is None or any(scene.start.buoy_displacement_m):
        return ""
    weight_N = float(run.record["w0"]) * scene.tether.length_m
    if weight_N <= 0.0 or rest.top_N >= -ROUNDING * weight_N:
        return ""
    return (
        f"the buoy does not carry the line, whose top is pressed with {digits(-rest.top_N, 4)} N at rest: it falls out "
        "of an equilibrium that does not last, and the grid decides how; give the buoy more buoyancy, or the line less "
        "weight"
    )


def _pressed_together(run, columns):
    """Says how far the largest tension holds where a line is pressed together and its elements cannot buckle.

    The fastest buckle under a force P is 2 pi sqrt(2 EI/P) long (Triantafyllou & Howell 1994). Shorter elements let the
    line give way; longer ones bear P. Drag across the line calms this.
    """
    pressed_N = compression_N(run, columns)
    if pressed_N == 0.0:
        return ""
    element_m = float(lengths_of(run.record, run.tables).max())
    buckle_m = 2 * math.pi * math.sqrt(2 * float(run.record["EI"]) / pressed_N)
    if buckle_m >= UNBUCKLED * element_m:
        return ""
    largest_N = columns["tension_top_high_N"].max()
    return (
        f"elements of {element_m:.2g} m cannot buckle as the line does, which is pressed together: without drag across "
        f"the line the largest tension, {digits(largest_N, 4)} N, holds to {digits(pressed_N, 2)} N; add nodes"
    )


def _regular_waves(run):
    """Says that regular waves would break, or are too long for their height to be linear, or nothing."""
    waves, water = run.scene.waves, run.scene.water
    if waves is None or waves.irregular:
        return ""
    k, amplitude = float(run.record["k"]), float(run.record["amplitude"])
    steepest, ursell = breaking_steepness(k, water.depth_m), ursell_number(k, 2.0 * amplitude, water.depth_m)
    if k * amplitude > steepest:
        return (
            f"the waves are of kA = {k * amplitude:.3g}: above {steepest:.3g} a wave of {waves.period_s:g} s breaks in "
            "this depth"
        )
    if ursell > MOST_URSELL:
        return (
            f"waves of {waves.period_s:g} s are too long to be linear in this depth: H L^2/depth^3 = {ursell:.3g} is "
            f"above {MOST_URSELL:g} (Hedges 1995)"
        )
    return ""


def _sea(run, columns):
    """Says of a sea what its laws do not cover: short or steep waves, extrapolated ones, too few for a long run."""
    scene = run.scene
    if not run.record["sea_n"]:
        return
    rows = rows_of(scene)
    energy, omega = rows[:, AMPLITUDE] ** 2, np.sort(rows[:, OMEGA])
    if scene.buoy is not None:
        short = float(energy[rows[:, K] * scene.buoy.diameter_m > 1.0].sum() / energy.sum())
        if short > MUCH:
            yield (
                f"{100 * short:.0f} % of the energy of the sea is in waves with k D > 1, shorter than six diameters of "
                "the sphere: eq. (30) has no diffraction, and overstates their force"
            )
    waves, depth = scene.waves, scene.water.depth_m
    steepness = wave_number(waves.period_s, depth, scene.gravity_mps2) * math.sqrt(2.0 * energy.sum())
    if steepness > STEEPEST:
        yield (
            f"k H_s/2 = {steepness:.2g} of the sea is above {STEEPEST:.2g}, that of the steepest seas in nature: its "
            "higher waves would break"
        )
    above_m = scene.anchor.position_m[2] + columns["z_m"].max() - depth
    if waves.above_still_water == "extrapolate":
        speed = rows[:, SPEED]
        faster = np.linalg.norm(speed * np.exp(rows[:, K] * above_m)) / np.linalg.norm(speed)
        if faster > FASTER:
            yield (
                f"{above_m:.2g} m above still water, where the upper end was, extrapolated waves are {faster:.2g} "
                "times as fast as at its level: waves.above_still_water = 'wheeler' or 'zero' bounds them"
            )
    measured = waves.record is not None
    spacings = len(omega) - int(measured)  # those of a drawn sea lie anywhere in equal parts of a band
    spacing = (omega[-1] - omega[0]) / spacings if spacings else 0.0
    recurs_s = 2 * math.pi / spacing if spacing else math.inf
    if len(omega) >= MANY and run.duration_s > (1.0 if measured else RECURRENCES) * recurs_s:
        yield (
            f"the sea has {len(omega)} waves and {'repeats' if measured else 'nearly repeats its groups'} after some "
            f"{digits(recurs_s, 4)} s: "
            + ("use a longer record" if measured else "give it more waves, or run several seeds")
        )


def errors_of_ringing(record: np.void, scene: Scene, time_s: np.ndarray, lost_N: np.ndarray) -> np.ndarray:
    """Error (N) of the tension at each sample, from ringing that was lost until then.

    What was lost would ring on until drag has taken it away, a' = -beta a^2, 1/a = 1/a_0 + beta (t - t_0): of a mass M
    on the line, and of the line itself, beta = 4 C/(3 pi omega M^2), C |v| v the drag.
    """
    length = scene.tether.length_m
    moved = float(record["inertia"]) / length
    line = (moved - float(record["M_total"])) / float(record["m"])  # length that moves as its end does
    drag = float(record["C_buoy"]) + float(record["ct"]) * line
    omega = 2 * math.pi / ringing_period(record, scene)
    beta = 4 * drag / (3 * math.pi * omega * moved**2)
    with np.errstate(divide="ignore"):
        return 1 / (beta * time_s + np.minimum.accumulate(1 / lost_N - beta * time_s))


def unresolved(record: np.void, tables: np.ndarray, scene: Scene, columns: Columns) -> str:
    """Says how far the largest tension holds where ringing was lost, and other and later ones; at most to itself."""
    time_s, high, lost_N = columns["time_s"], columns["tension_top_high_N"], columns["unresolved_N"]
    if not lost_N.any():
        return ""
    peak, largest_N = int(high.argmax()), float(np.abs(high).max())
    errors = errors_of_ringing(record, scene, time_s, lost_N)
    errors[:-1] = np.maximum(errors[:-1], errors[1:])  # what a step lost is booked with the sample after it
    errors = np.minimum(errors, largest_N)
    worst, large = int(errors.argmax()), np.flatnonzero(errors > NOTED * largest_N)
    if not len(large):
        return ""
    key, step_s = longest_step(scene)
    if record["adaptive"]:
        key = "solver.shortest_period_s or solver.max_step_s"
    cause = f"axial ringing of period {ringing_period(record, scene):.2g} s is"
    if record["all_waves"]:
        cause = f"axial waves on elements of {lengths_of(record, tables)[-1]:.2g} m are"
    largest = f"{digits(high[peak], 4)} N at t = {digits(time_s[peak], 4)} s"
    holds = f"the largest tension, {largest}, holds to {digits(errors[peak], 2)} N"
    if errors[worst] > 1.1 * errors[peak]:
        holds += f", others to {digits(errors[worst], 2)} N (t = {digits(time_s[worst], 4)} s)"
    settled = large[-1] + 1
    if settled < len(errors):
        holds += f", from t = {digits(time_s[settled], 4)} s on to {digits(errors[settled:].max(), 2)} N"
    return f"{cause} not resolved by steps of up to {step_s:.2g} s: {holds}; lower {key}"


def blows(record: np.void, scene: Scene, columns: Columns) -> str:
    """Says where a held end is set in motion or stopped at once, if that makes the largest force.

    A jump of velocity v sends out a wave of the force v sqrt(m T'). Spread over longer than a wave takes along the line
    and back it makes less, because what comes back takes it away. It is told where it makes most of what the largest
    force, of either sign, is above that at rest: until the wave has come back twice.
    """
    wave_mps, jumps = fastest_wave(record, scene), []
    back_s, sample_s = 2 * scene.tether.length_m / wave_mps, float(record["output_step"])
    high = columns["tension_top_high_N"]
    forces = np.maximum(high, -columns["tension_top_low_N"])
    largest_s, rise_N = columns["time_s"][forces.argmax()], forces.max() - abs(high[0])
    for t, speed, spread_s in jumps_of(scene.end):
        force_N = float(record["m"]) * wave_mps * speed * min(1.0, back_s / max(spread_s, 1e-300))
        soon = t - spread_s <= largest_s <= t + spread_s + 2 * back_s + sample_s
        if soon and 0 < rise_N < 2 * force_N and force_N > NOTED * forces.max():
            jumps.append(f"by {speed:.2g} m/s at t = {digits(t, 4)} s (about {digits(force_N, 2)} N)")
    if not jumps:
        return ""
    return f"the velocity of end.motion jumps {' and '.join(jumps)}, a blow on the line: let it begin and end at rest"
