"""The verdict on the motion of a buoy in waves: its state as the analysis takes it, its regime, its exponents."""

from functools import partial

import engine.scene
from engine.views import LONGEST_PERIOD, STROBE_TOLERANCE, carried, carries_tangents, state_of

LEAST_JUDGED = 40  # periods after the transient below which no verdict is possible: exponents are then left out
TANGENTS, LATERAL = "output.tangent_vectors", "output.lateral_growth"


def tighter_scene(scene):
    """The scene at a tenth of its tolerance, or of its step where that is fixed."""
    step_s = scene.solver.step_s
    key, value = ("solver.step_s", step_s / 10) if step_s else ("solver.rtol", scene.solver.rtol / 10)
    return engine.scene.scene_from_toml(scene.to_toml(), {key: value})


def tangent_of(trajectory, transient_periods: int):
    """The exponent of a run's tangent dynamics in bits per wave period; without a value where it carried none."""
    from analysis import tangent_lyapunov
    from analysis.exponents import BITS_PER_PERIOD, no_exponent

    if not carried(trajectory):
        return no_exponent("tangent dynamics", "no perturbation was carried along", BITS_PER_PERIOD)
    return tangent_lyapunov(trajectory.tangent.growth_nats, transient_periods)[0]


def verdict_of(trajectory, transient_periods: int, tangent=None, simulate=None):
    """The regime of a finished run: (Verdict, Wolf Exponent of r in bits per wave period, regime_tighter).

    tangent: its `tangent_of`; without one the verdict is that of the samples alone. A motion in three dimensions within
    millimetres of the plane of the waves has its state in that plane. Every period after the transient counts, those
    with a loop release too. simulate: to repeat a run that looks chaotic at a ten times tighter tolerance; its regime
    is regime_tighter, None where that was not done.
    """
    import numpy as np

    from analysis import regime, wolf_lyapunov

    scene, columns = trajectory.scene, trajectory.columns
    step_s, period_s = scene.sample_step_s(), scene.waves.period_s
    first = round(transient_periods * period_s / step_s)  # sample after the transient
    wolf = wolf_lyapunov(columns["radius_m"][first:], step_s).in_bits_per_period(period_s)
    coordinates, scale = state_of(columns, step_s, period_s, transient_periods)
    judged = partial(
        regime,
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
    verdict, tighter = judged(), None
    if verdict.regime == "chaotic" and simulate is not None:
        again = simulate(tighter_scene(scene), duration_s=float(columns["time_s"][-1]))
        tighter = again.status
        if again.status == "ok":
            tighter = verdict_of(again, transient_periods, tangent_of(again, transient_periods))[0].regime
        verdict = judged(tighter=tighter)
    return verdict, wolf, tighter


def judged_scene(order, changes: dict, least: int = LEAST_JUDGED):
    """The scene of a study's order with these changes, and with the perturbations added that a verdict needs.

    Unless --set says otherwise, it carries one perturbation in the plane and, with one there, one across the plane.
    Nothing is added where the engine cannot carry them, or below `least` periods after the transient. Returns None
    where the scene is faulty.
    """
    scene = order.scene(changes)
    if scene is None or order.periods - order.transient < least or not carries_tangents(scene):
        return scene
    extra = {} if TANGENTS in order.changes else {TANGENTS: 1}
    if LATERAL not in order.changes and (extra or scene.output.tangent_vectors):
        extra[LATERAL] = True
    return order.scene({**changes, **extra}) if extra else scene
