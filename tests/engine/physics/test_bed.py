"""Laws of the bed: Coulomb's friction, what a throw loses, the catenary that lies on it in part.

A mass m on the spring k and the damper c, which does not pull, comes back with the share e of its speed (Schwager &
Poeschel 2007), e = exp(-2 zeta/sqrt(1 - zeta^2) atan(sqrt(1 - zeta^2)/zeta)), zeta = c/(2 sqrt(k m)); while it slides,
friction takes mu (1 + e) v_n along the bed (Walton 1993).

On the bed without friction the tension is H. From the touch-down on, with s from there,
x = H s/EA + (H/w) asinh(w s/H), z = w s^2/2EA + (sqrt(H^2 + w^2 s^2) - H)/w.
"""

import math

import numpy as np
import pytest
from scipy.optimize import fsolve

from engine import load_scene, simulate
from engine.perturbations.tangent import Base
from engine.physics.bed import bed_load, bed_powers
from engine.planar.extras import G_V, more_across
from tests.engine.kernels import Stage, of_kind, parameters_of
from tests.engine.lines import DRY, Motion, equilibrium, held, line, linear, positions

BED = {"stiffness_Npm3": 1e7, "damping_Nspm3": 2e4, "friction": 0.4, "friction_speed_mps": 0.01}
CHAIN = {"length_m": 20.0, "area_m2": 1e-4, "density_kgpm3": 5000.0, "bending_stiffness_Nm2": 0.0}
EA, G, WEIGHT = 1e5, 9.81, 5000.0 * 1e-4 * 9.81


def bed(**changes):
    return parameters_of(line(DRY, held(15.0, 4.0), {"floor": {**BED, **changes}}, **CHAIN))[0]


def test_friction_is_coulombs_above_its_speed():
    p = bed()
    d = math.sqrt(4e-4 / math.pi)
    depth = 3.0 * p["bed_onset"]
    V = (0.3, -0.4, 0.0)
    load, by_V, by_z = bed_load(p, 1.0, -depth, V)
    normal = BED["stiffness_Npm3"] * d * (depth - 0.5 * p["bed_onset"])
    assert load[2] == pytest.approx(-normal)
    assert np.hypot(load[0], load[1]) == pytest.approx(0.4 * normal, rel=3e-4)
    assert load[0] / load[1] == pytest.approx(V[0] / V[1])
    assert of_kind(bed_powers, p, -depth, V)[1:] == pytest.approx((0.0, 0.0, np.dot(load, V)))
    assert bed_load(p, 1.0, 1e-9, V)[0] == (0.0, 0.0, 0.0)
    assert bed_load(p, 1.0, -depth, (0.0, 0.0, 50.0))[0] == (0.0, 0.0, 0.0), "the damper does not pull"
    # slopes, in the soft beginning too
    for z, V in ((-depth, (0.02, -0.01, -0.03)), (-0.4 * p["bed_onset"], (0.005, 0.02, -0.01))):
        _, by_V, by_z = bed_load(p, 1.0, z, V)
        for i, step in enumerate(1e-6 * np.eye(3)):
            sides = [np.array(bed_load(p, 1.0, z, tuple(V + sign * step))[0]) for sign in (1, -1)]
            assert np.array(by_V)[:, i] == pytest.approx((sides[0] - sides[1]) / 2e-6, rel=1e-5, abs=1e-6)
        h = 1e-4 * p["bed_onset"]
        sides = [np.array(bed_load(p, 1.0, z + sign * h, V)[0]) for sign in (1, -1)]
        assert by_z == pytest.approx((sides[0] - sides[1]) / (2 * h), rel=1e-5)


def test_a_line_that_slides_along_itself_resists_a_speed_across_by_friction_over_its_own_speed():
    stage = Stage(line(DRY, held(15.0, 4.0), {"floor": BED}, nodes=5, **CHAIN))
    Y, H = np.zeros((5, 6)), np.zeros((5, 10))
    Y[:, 2], stage.X[:, 1] = 0.3, -3.0 * stage.p["bed_onset"]
    base = Base(0.0, 1.0, 1.0, Y, stage.C_tilde)
    of_kind(more_across, stage.p, base, stage.X, stage.Q, stage.F, H)
    assert H[:, G_V] == pytest.approx(0.4 * 2.5 * WEIGHT / 0.3, rel=1e-3)


@pytest.mark.parametrize("zeta", [0.1, 0.4])
def test_an_inclined_throw_loses_what_theory_says(dimensions, zeta):
    """The nodes of a line of next to no tension are such masses."""
    mass, width, mu, limp = WEIGHT / G, math.sqrt(4e-4 / math.pi), 0.1, 1e-4
    damping = 2 * zeta * math.sqrt(BED["stiffness_Npm3"] * width * mass) / width
    more = {"gravity_mps2": 0.0, "tether.tension": linear(limp), "anchor.position_m": [0.0, 0.0, 1e-3],
            "end.kind": "free", "end.force_N": [1e-3 * limp, 0.0, 0.0], "buoy": None,
            "motion.dimensions": dimensions, "output.step_s": 1e-3, "solver.rtol": 1e-5,
            "floor": BED | {"damping_Nspm3": damping, "friction": mu}}  # fmt: skip
    scene = line(DRY, more, nodes=9, **CHAIN)
    Y, fast, slide = equilibrium(scene).Y.copy(), 1.0, 2.0
    V = slice(dimensions, 2 * dimensions)
    Y[1:, V] = [slide, -fast] if dimensions == 2 else [0.6 * slide, 0.8 * slide, -fast]
    motion = Motion(scene, 0.012, start=Y)
    motion.run()
    thrown = motion.Y[2:-1, V]
    root = math.sqrt(1 - zeta**2)
    e = math.exp(-2 * zeta / root * math.atan2(root, zeta))
    assert thrown[:, -1] / fast == pytest.approx(e, rel=5e-3)
    assert slide - np.linalg.norm(thrown[:, :-1], axis=1) == pytest.approx(mu * (1 + e) * fast, rel=5e-3)


def catenary(x, z):
    """Tension (N) on the bed and length (m) that lies on it, of a line to (x, z)."""

    def miss(unknowns):
        H, lying = unknowns
        s = CHAIN["length_m"] - lying
        hung = H * s / EA + H / WEIGHT * np.arcsinh(WEIGHT * s / H)
        up = WEIGHT * s**2 / (2 * EA) + (np.hypot(H, WEIGHT * s) - H) / WEIGHT
        return lying * (1 + H / EA) + hung - x, up - z

    return fsolve(miss, (10.0, 10.0), xtol=1e-12)


def test_a_line_that_lies_on_the_bed_in_part(dimensions):
    x, z = 18.6, 5.0
    H, lying = catenary(x, z)
    assert 5.0 < lying < 14.0
    errors = []
    for nodes in (81, 161):
        scene = line(DRY, held(x, z), {"floor": BED, "motion.dimensions": dimensions, "tether.tension": linear(EA)},
                     nodes=nodes, **CHAIN)  # fmt: skip
        motion = equilibrium(scene)
        computed = EA * motion.Y[[0, -1], 0]
        expected = H, np.hypot(H, WEIGHT * (CHAIN["length_m"] - lying))
        errors.append(np.abs(computed / expected - 1).max())
        lowest = positions(motion.Y, motion.h)[:, -1].min()
        assert lowest < 0.0
    assert errors[0] < 2e-3
    assert errors[1] < 0.6 * errors[0]


def test_a_buoy_that_sinks_to_a_bed_is_told_as_the_reason():
    """The sphere displaces 1027 pi 1.5^3/6 kg; the bed bears lines alone."""
    sinks = {"buoy.mass_kg": 1900.0, "buoy.submergence": "spherical-cap", "floor": BED, "waves": None}
    run = simulate(load_scene("tethered_buoy", sinks), duration_s=0.05)
    assert run.status == "statics-failed"
    assert "displaces 1814.9 kg of water, so that it sinks" in run.message


def test_a_line_too_long_to_lie_stretched_is_refused_in_words():
    run = simulate(line(DRY, held(15.0, 0.3), {"floor": BED, "tether.tension": linear(EA)}, nodes=41, **CHAIN),
                   duration_s=0.05)  # fmt: skip
    assert run.status == "statics-failed"
    assert "longer than the way along the bed" in run.message
