"""Law: above the surface the line is dry, below it is in the water, and still water makes no energy of its passages.

Lowe and Langley (OMAE 2006) state 47.11 kN at the top of their jumper at rest, its lower end above the bed.
"""

import math

import numpy as np
import pytest

from engine import load_scene
from engine.physics.extras import surface_load, wetting
from engine.physics.strains import tension_at
from tests.engine.kernels import parameters_of
from tests.engine.lines import DRY, STILL, equilibrium, harmonic, held, line, ran

FREE = {"tether.submergence": "free-surface", "tether.diameter_m": 0.04, "tether.area_m2": math.pi * 0.02**2}
TIGHT = {"solver.step_s": 0.01, "solver.newton_tolerance": 1e-12, "solver.max_newton_iterations": 40}
SHAKEN = harmonic([0.3, 0.0, 0.5], 2.0)


def tensions(*changes):
    scene = line(held(12.0, 9.0, motion=SHAKEN), FREE, TIGHT, *changes, nodes=9)
    return ran(scene, duration_s=3.0).columns["tension_top_N"]


def test_far_above_and_far_below(dimensions):
    space = {"motion.dimensions": dimensions}
    above = {"anchor.position_m": [0.0, 0.0, 60.0]}
    dry = tensions(space, DRY, {"tether.submergence": "full"})
    assert tensions(space, above, STILL) == pytest.approx(dry, rel=1e-6)
    deep = {"water.depth_m": 60.0, "waves.steepness": 0.02}
    wet = tensions(space, deep, {"tether.submergence": "full"})
    assert tensions(space, deep) == pytest.approx(wet, rel=1e-6)
    assert np.abs(wet / dry - 1).max() > 0.1


def test_what_the_force_does_is_what_the_water_has():
    """d/dt [s m_a |v_p|^2/2 + lift's] = (load of the water).V for a piece of line that passes a still surface."""
    p = parameters_of(line(held(12.0, 9.0), FREE, STILL))[0]
    tangent = np.array([0.6, 0.48, 0.64])
    across = np.eye(3) - np.outer(tangent, tangent)
    V, A, rate = np.array([1.0, -2.0, -1.5]), np.array([3.0, 2.0, -4.0]), 1e-6

    def energy(t):
        v, z = V + A * t, 21.0 + 0.004 + V[2] * t + 0.5 * A[2] * t * t
        wet = wetting(p, 0.0, 1.0, (1.0, 0.0, 0.0), (0.0, 0.0, z), tuple(v))
        return 0.5 * wet[0] * p["ma"] * v @ across @ v

    place, ahead, still = (0.0, 0.0, 21.004), (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    wet = wetting(p, 0.0, 1.0, ahead, place, tuple(V))
    assert 0.2 < wet[0] < 0.8
    inertia = p["ma"] * across @ A
    buoyancy = np.array([0.0, 0.0, p["buoyed"]])
    load = np.array(surface_load(p, 1.0, ahead, wet, tuple(V - still), tuple(tangent), tuple(inertia))[0])
    # G has w0 = mg - B in full; the surface gives back (1 - s) B
    power = (inertia + load) @ V - (1 - wet[0]) * buoyancy @ V
    assert power == pytest.approx((energy(rate) - energy(-rate)) / (2 * rate), rel=1e-6)


def test_the_jumper_at_rest():
    scene = load_scene("lowe_langley")
    top = tension_at(float(equilibrium(scene).Y[-1, 0]), scene.tether.tension)
    assert top == pytest.approx(47.11e3, abs=5.0)


@pytest.mark.parametrize("key, nothing", [("froude_krylov", "normal"), ("damping_critical", 0.0)])
def test_switches_that_are_off_are_not_there(key, nothing):
    scene = line({f"tether.{key}": nothing})
    assert "anchor_z" not in parameters_of(scene)[0].dtype.names
