"""The verdict on the motion of a buoy in waves: its regime and its exponents, and the runs that a verdict needs."""

from functools import partial

from campaigns.machinery import TANGENTS, Job, once, until_judged
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carried, carries_tangents, exponent, state_of, verdict

LEAST_JUDGED = 40  # wave periods after the transient; a shorter record is not judged, and has no exponents
LATERAL = "output.lateral_growth"
UNFOLLOWED = {TANGENTS: 0, LATERAL: False}  # changes of a scene: without perturbations


def periods_of(scene, columns) -> float:
    """Wave periods of a record."""
    return (len(columns["time_s"]) - 1) * scene.sample_step_s() / scene.waves.period_s


def samples_of(scene, periods: float) -> int:
    """Samples in so many wave periods."""
    return round(periods * scene.waves.period_s / scene.sample_step_s())


def tangent_of(trajectory, transient_periods: int):
    """The exponent of a run's tangent dynamics in bits per wave period; no value if it carried no perturbation."""
    from analysis.exponents import BITS_PER_PERIOD, no_exponent

    if not carried(trajectory):
        return no_exponent("tangent dynamics", "no perturbation was carried along", BITS_PER_PERIOD)
    return exponent(trajectory, transient_periods)


def motion_of(trajectory, checks):
    """The Verdict on a run from rest, look by look, from its strobed state and its tangent dynamics.

    checks: Trajectories that went on from this run at a tighter tolerance, by the wave periods at which they began;
    None: this run has no such checks.
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
    """The verdict on the samples alone, as for a record of unknown origin, and Wolf's exponent of r.

    Returns (Verdict, Exponent in bits per wave period). tangent: the Exponent of `tangent_of` for this run. Of a
    motion in three dimensions only the state in the plane of the waves is judged. All periods after the transient
    count, also those with a loop release.
    """
    import numpy as np

    from analysis import regime, wolf_lyapunov

    scene, columns = trajectory.scene, trajectory.columns
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    first_sample = round(transient_periods * period_s / step_s)  # after the transient
    wolf = wolf_lyapunov(columns["radius_m"][first_sample:], step_s).in_bits_per_period(period_s)
    coordinates, scale = state_of(scene, columns, first_sample)
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
    """The scene of a study's order with these changes, and with the perturbations that a verdict needs.

    Unless --set says otherwise, the scene carries one perturbation in the plane and, if there is one in the plane, one
    across it. No perturbation is added if the engine cannot carry it, if the run has fewer than `least` periods after
    the transient, or if the run is judged look by look, because such a run adds its perturbations itself. Returns None
    if the scene is faulty.
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
    """A run of a study's order: of the length of the order, or as long as its regime needs (`long_runs.until_judged`).

    start: the state (`engine.FinalState`) of another run in which this run begins; None: the start of the scene.
    most: as for `until_judged`. Runs with different `most` have the same key, so a longer one goes on from a shorter.
    """
    if not carries_tangents(scene):
        return job_from(labels, scene, order.periods, start)
    going = partial(until_judged, budget=order.periods, looks=order.looks, start=start, most=most)
    made = f"{'looks' if order.looks else ''}{_name_of(start)}"
    return Job(labels, scene, order.periods, going=going, carrying=order.looks, made=made)


def job_from(labels: dict, scene, periods: float, start=None):
    """A run of a fixed length that begins in the state `start`; None: with the start of its scene."""
    going = None if start is None else partial(once, periods=periods, start=start)
    return Job(labels, scene, periods, going=going, made=_name_of(start))


def _name_of(start) -> str:
    """The part of a run's key that names its start."""
    return "" if start is None else f" from {start.digest()}"
