"""The verdict on the motion of a buoy in waves: its state as the analysis takes it, its regime, its exponents."""

from functools import partial

from campaigns.machinery.long_runs import TANGENTS, once, until_judged
from campaigns.machinery.plan import Job
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carried, carries_tangents, exponent, state_of, verdict

LEAST_JUDGED = 40  # periods after the transient below which a record is not judged: exponents are then left out
LATERAL = "output.lateral_growth"


def tangent_of(trajectory, transient_periods: int):
    """The exponent of a run's tangent dynamics in bits per wave period; without a value where it carried none."""
    from analysis.exponents import BITS_PER_PERIOD, no_exponent

    if not carried(trajectory):
        return no_exponent("tangent dynamics", "no perturbation was carried along", BITS_PER_PERIOD)
    return exponent(trajectory, transient_periods)


def motion_of(trajectory, checks=None):
    """The Verdict on a run from rest, look by look, from its strobed state and its tangent dynamics.

    checks: Trajectories that went on from it at a tighter tolerance, by its wave periods then; None: none ever does.
    """
    from analysis import tangent_lyapunov
    from analysis.exponents import BITS_PER_PERIOD, no_exponent

    if checks is None:
        return verdict(trajectory)
    tighter = {}
    for end, check in checks.items():
        if check.status == "ok":
            (tighter[end],) = tangent_lyapunov(check.tangent.growth_nats[:, :1])
        else:
            tighter[end] = no_exponent("tangent dynamics", f"the run ended: {check.status}", BITS_PER_PERIOD)
    return verdict(trajectory, tighter)


def record_regime(trajectory, transient_periods: int, tangent=None):
    """The verdict on the samples of a run alone, as on a record of unknown origin, and Wolf's exponent of r.

    Returns (Verdict, Exponent in bits per wave period). tangent: its `tangent_of`. A motion in three dimensions within
    millimetres of the plane of the waves has its state in that plane. Every period after the transient counts, those
    with a loop release too.
    """
    import numpy as np

    from analysis import regime, wolf_lyapunov

    scene, columns = trajectory.scene, trajectory.columns
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    first = round(transient_periods * period_s / step_s)  # sample after the transient
    wolf = wolf_lyapunov(columns["radius_m"][first:], step_s).in_bits_per_period(period_s)
    coordinates, scale = state_of(columns, step_s, period_s, transient_periods)
    verdict = regime(
        np.column_stack(list(coordinates.values())),
        step_s,
        period_s,
        transient_periods=transient_periods,
        tangent_exponent=tangent,
        wolf_exponent=wolf,
        scale=scale,
        tolerance=STROBE_TOLERANCE,
        max_period=LONGEST_PERIOD,
    )
    return verdict, wolf


def judged_scene(order, changes: dict, least: int = LEAST_JUDGED):
    """The scene of a study's order with these changes, and with the perturbations added that a verdict needs.

    Unless --set says otherwise, it carries one perturbation in the plane and, with one there, one across the plane.
    Nothing is added where the engine cannot carry them, or below `least` periods after the transient. Returns None
    where the scene is faulty.
    """
    scene = order.scene(changes)
    if scene is None or order.looks or not carries_tangents(scene) or order.periods - order.transient < least:
        return scene
    extra = {}
    if TANGENTS not in order.changes:
        extra[TANGENTS] = 1
    if LATERAL not in order.changes and (extra or scene.output.tangent_vectors):
        extra[LATERAL] = True
    if extra:
        return order.scene({**changes, **extra})
    return scene


def judged_job(order, labels: dict, scene, start=None, most: int | None = None):
    """A run of a study's order: of the length asked for, or as long as its regime needs (`long_runs.until_judged`).

    start: the state (`engine.FinalState`) of another run that it begins in; None: as the scene says. most: as there;
    the run is the same one, and goes on for those who ask for more of it.
    """
    if not carries_tangents(scene):
        return job_from(labels, scene, order.periods, start)
    going = partial(until_judged, budget=order.periods, looks=order.looks, start=start, most=most)
    made = f"{'looks' if order.looks else ''}{_from(start)}"
    return Job(labels, scene, order.periods, going=going, carrying=order.looks, made=made)


def job_from(labels: dict, scene, periods: float, start=None):
    """A run of a fixed length that begins in the state `start`, or without one as its scene says."""
    going = None if start is None else partial(once, periods=periods, start=start)
    return Job(labels, scene, periods, going=going, made=_from(start))


def _from(start) -> str:
    return "" if start is None else f" from {start.digest()}"
