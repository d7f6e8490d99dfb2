"""Law: on an upright tether x and y are one and the same: a lateral perturbation is the planar tangent vector turned.

The tether stands or hangs straight, at rest, in a vertical current, or bouncing along itself through strains from 0 to
twice the static one; without waves nothing in the water tells x from y. The same perturbation (q_x, V_x) and (q_y, V_y)
then grows alike in `tangent` and in `lateral`, step by step and with the same shape; both are solved to
rounding, and growth of e^10 and decay of e^-30 on the way leave 1e-7 of that. In waves the two differ.

Law: a lateral perturbation of a buoy at rest is a pendulum, and nothing damps it. (Its frequency follows from
`test_lateral_stage`.)
"""

import numpy as np
import pytest

from engine import simulate
from tests.engine.lines import DRY, STILL, free, held, line, linear
from tests.engine.perturbations.tangents import Carried, Run


def current(w):
    return {"current": {"law": "uniform", "velocity_mps": [0.0, 0.0, w]}}


def bounce(w):
    return {"start.buoy_velocity_mps": [0.0, 0.0, w]}


RUNS = {
    "rising current": (STILL | current(0.6), 10.0),
    "sinking current": (STILL | current(-0.4), 10.0),
    "bounce in water": (STILL | bounce(0.8), 20.0),
    "hanging dry, bouncing": (DRY | bounce(2.0), 10.0),
    "held in a current": (STILL | current(0.5) | held(0.0, 21.0), 5.0),
    "free, pulled": (STILL | current(0.5) | free(0.0, 300.0), 2.0),
    "bounce, trbdf2": (STILL | bounce(0.8) | {"solver.integrator": "trbdf2"}, 10.0),
    "bounce, backward-euler": (STILL | bounce(0.8) | {"solver.integrator": "backward-euler"}, 10.0),
}


def growths(scene, duration_s):
    """Growth (nats) in each step of one perturbation across and one along x, and their shapes (n, 2) at the end."""
    run = Run(scene, duration_s)
    start = run.direction(3)
    start[:, [1, 3]] = 0.0
    start /= run.norm(start)
    planar = Carried(run, start[None])
    across, rates = np.ascontiguousarray(start[:, [0, 2]]), np.zeros((len(start), 2))
    weights = np.tile([1.0, run.weight], (len(start), 1))
    found = []
    for count in run.chunks():
        for i in range(count):
            before = planar.growth[0]
            planar.follow(i)
            found.append((run.carry_lateral(i, 1, weights, across, rates), planar.growth[0] - before))
    return np.array(found), across, planar.vectors[0]


@pytest.mark.parametrize("name", RUNS)
def test_across_is_along_on_an_upright_tether(name):
    overrides, duration_s = RUNS[name]
    found, across, along = growths(line(overrides, nodes=21), duration_s)
    assert len(found) > 15
    assert np.abs(found[:, 0] - found[:, 1]).max() < 1e-7
    assert np.abs(found.sum(axis=0)).max() > 0.5, "the perturbation was meant to do something"
    assert np.abs(across - along[:, [0, 2]]).max() < 1e-6
    assert np.abs(along[:, [1, 3]]).max() < 1e-6


def test_waves_tell_them_apart():
    found, _, _ = growths(line({"waves.steepness": 0.016}, nodes=21), 10.0)
    assert np.abs(found[:, 0] - found[:, 1]).max() > 1e-3


def test_a_dry_pendulum_neither_grows_nor_decays():
    """Its energy is the square of the length of the perturbation, so it keeps that to what the integrator takes.

    The first 100 s rid the perturbation of its fast modes, which the integrator damps; of the pendulum ESDIRK4(3) with
    steps of 0.1 s takes (omega dt)^4 times less than a tenth a second, 1e-6. The light tether has another energy than
    the weights say, T being not quite the scale: 1e-4.
    """
    light = DRY | {"tether.density_kgpm3": 1e-2, "tether.tension": linear(1e5)}
    run = simulate(line(light, {"output.lateral_growth": True}), duration_s=400.0)
    assert run.status == "ok"
    assert run.tangent.growth_nats.shape == (400, 0) and run.tangent.period_s == 1.0
    later = run.tangent.lateral_nats[100:]
    assert np.abs(later).max() < 1e-4
    assert abs(later.mean()) < 1e-6
