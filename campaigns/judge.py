"""The verdict on the motion of a buoy in waves: its state as the analysis takes it, its regime, its exponents."""

import math
from functools import partial

import engine.scene
from campaigns.finer import finer
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carried, carries_tangents, exponent, state_of, verdict

LEAST_JUDGED = 40  # periods after the transient below which a record is not judged: exponents are then left out
OPEN = ("undecided", "transient")  # regimes that decide nothing
LEAST_CHECK, SURE = 90, 2.5  # wave periods at the tighter tolerance; errors by which chaos is then expected to show
TANGENTS, LATERAL = "output.tangent_vectors", "output.lateral_growth"


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


def going_on(
    scene, trajectory, row, checks, budget: int, looks: bool, start=None, most: int | None = None, least: float = 0.0
):
    """What a run whose regime is asked for does next (`campaigns.machinery.plan.Further`); None when it is told.

    start: the state of another run that it begins in; None: as the scene says. most: wave periods after which it is not
    looked at again, though `budget` allows it.
    looks: it is looked at after 90, 135, 205, ... wave periods, `budget` at most, and perturbations are carried from
    the first look on that finds no period, and none that it comes nearer to; else it takes `budget` periods at once.
    One that looks chaotic goes on at a tenth of the tolerance until that shows there too, at most for as long as it was
    judged; at first for as long as it takes to show by SURE errors.
    least: wave periods that chaos has to last, because transients of such a length are known (`explore.transients`).
    """
    from analysis.evidence import read_evidence
    from analysis.looks import CLOSE, next_look
    from analysis.looks import looks as looks_at
    from campaigns.machinery.plan import Further

    ends = list(looks_at(budget)) if looks else []
    if row is None:
        return Further(scene, ends[0] if ends else budget, start)
    done = row.get("periods")
    if row["status"] != "ok" or row.get("regime") is None or done is None:
        return None
    # whole periods: samples need not add up to them to the last digit, and a check of nothing would go on for ever
    ahead = next((end for end in ends if end > round(done)), None)
    may_go_on = ahead is not None and (most is None or ahead <= most)
    if row["regime"] == "chaotic" and done < least and may_go_on:
        return Further(_carrying(scene), ahead - done, trajectory)
    judged, check = round(done) - (row.get("transient_periods") or 0), checks.get(round(done))
    if row["regime"] == "chaotic" and row.get("regime_tighter") is None:
        value, error = row["lyapunov_tangent_bits_per_period"], row["lyapunov_tangent_error"]
        enough = max(math.ceil(judged * (SURE * error / value) ** 2), LEAST_CHECK)
        return Further(finer(_carrying(scene), steps=10), min(enough, judged), trajectory, check=True)
    if check is not None and check.status == "ok" and row.get("regime_tighter") != "chaotic":
        if (ran := len(check.tangent.growth_nats)) < judged:
            return Further(check.scene, min(math.ceil(0.5 * ran), judged - ran), check, check=True)
    if row["regime"] not in OPEN or not may_go_on:
        return None
    failed = {name for name, *_, met in read_evidence(row.get("evidence") or "") if met == "no"}
    loose = CLOSE in failed and done > next_look()
    unclear = row["regime"] == "undecided" and (row.get("strobed_period") is None or loose)
    wanted = unclear or (trajectory is not None and carried(trajectory))
    scene = _carrying(scene) if wanted and carries_tangents(scene) else scene
    return Further(scene, ahead - done, trajectory)


def _carrying(scene):
    """The scene with a perturbation in its plane. One across it is for those who ask (`output.lateral_growth`): it
    costs a seventh more, and large motions release loops, which leaves no rate across the plane.
    """
    return engine.scene.scene_from_toml(scene.to_toml(), {TANGENTS: 1})


def judged_scene(order, changes: dict, least: int = LEAST_JUDGED):
    """The scene of a study's order with these changes, and with the perturbations added that a verdict needs.

    Unless --set says otherwise, it carries one perturbation in the plane and, with one there, one across the plane.
    Nothing is added where the engine cannot carry them, or below `least` periods after the transient. Returns None
    where the scene is faulty.
    """
    scene = order.scene(changes)
    if scene is None or order.looks or not carries_tangents(scene) or order.periods - order.transient < least:
        return scene
    extra = {} if TANGENTS in order.changes else {TANGENTS: 1}
    if LATERAL not in order.changes and (extra or scene.output.tangent_vectors):
        extra[LATERAL] = True
    return order.scene({**changes, **extra}) if extra else scene


def judged_job(order, labels: dict, scene, start=None, most: int | None = None):
    """A run of a study's order: of the length asked for, or as long as its regime needs (`going_on`).

    start: the state (`engine.final_state`) of another run that it begins in; None: as the scene says. most: as there;
    the run is the same one, and goes on for those who ask for more of it.
    """
    from campaigns.machinery.plan import Job

    if not carries_tangents(scene):
        return job_from(labels, scene, order.periods, start)
    going = partial(going_on, budget=order.periods, looks=order.looks, start=start, most=most)
    made = f"{'looks' if order.looks else ''}{_from(start)}"
    return Job(labels, scene, order.periods, going=going, carrying=order.looks, made=made)


def job_from(labels: dict, scene, periods: float, start=None):
    """A run of a fixed length that begins in the state `start`, or without one as its scene says."""
    from campaigns.machinery.plan import Job

    going = None if start is None else partial(_once, periods=periods, start=start)
    return Job(labels, scene, periods, going=going, made=_from(start))


def _from(start) -> str:
    return "" if start is None else f" from {start.digest()}"


def _once(scene, trajectory, row, checks, periods, start):
    from campaigns.machinery.plan import Further

    return Further(scene, periods, start) if row is None else None
