"""The pendulum in PyElastica (1.0.0 from PyPI), for `campaigns.accuracy`: a Cosserat rod with a heavy last node.

Same rope, weight, start and stiffness EA; a round rod of that section and modulus has the bending stiffness of the
scene. The rod starts stretched as it hangs. Its steps are explicit (position Verlet) and bounded by the turning of its
sections, whose inertia our rope has not: tens of microseconds. What is left different: shear deformation and that
inertia (both small here), and one node more than elements. Water, waves, drag and a buoy would have to be written by
the user, so the other works are not asked of it.
"""

import math
import time

import numpy as np

from campaigns.accuracy.peers.record import SAMPLE_S, sampled
from engine import Scene, Trajectory

SHEAR = 1.0 / 3.0  # shear modulus over Young's: incompressible


def simulate(scene: Scene, duration_s: float, elements: int, step_s: float) -> Trajectory:
    """A run as the engine's record: a Trajectory of the bob's places."""
    import elastica

    stepper, dt, t = elastica.PositionVerlet(), np.float64(step_s), np.float64(0.0)
    stepper.step(hanging(scene, elements)[0], t, dt)  # compiles what is not compiled yet
    system, rod = hanging(scene, elements)
    stride, samples = round(SAMPLE_S / step_s), round(duration_s / SAMPLE_S)
    places = [rod.position_collection[:, -1].copy()]
    start_s = time.perf_counter()
    for _ in range(samples):
        for _ in range(stride):
            t = stepper.step(system, t, dt)
        places.append(rod.position_collection[:, -1].copy())
    return sampled(scene, duration_s, np.array(places), time.perf_counter() - start_s, stride * samples)


def hanging(scene, elements):
    """(system, rod) of the scene at t = 0."""
    import elastica

    class System(elastica.BaseSystemCollection, elastica.Constraints, elastica.Forcing):
        pass

    tether, g = scene.tether, scene.gravity_mps2
    L, EA, mass = tether.length_m, tether.tension.stiffness_N, tether.density_kgpm3 * tether.area_m2
    system = System()
    rod = elastica.CosseratRod.straight_rod(
        elements, np.zeros(3), np.array([0.0, 0.0, -1.0]), np.array([1.0, 0.0, 0.0]), L,
        math.sqrt(tether.area_m2 / math.pi), tether.density_kgpm3, youngs_modulus=EA / tether.area_m2,
        shear_modulus=SHEAR * EA / tether.area_m2,
    )  # fmt: skip
    system.append(rod)
    rod.mass[-1] += scene.buoy.mass_kg
    s = np.linspace(0.0, L, elements + 1)
    rod.position_collection[2] = -(s + g * (scene.buoy.mass_kg * s + mass * (L * s - 0.5 * s * s)) / EA)
    for axis, speed in enumerate(scene.start.buoy_velocity_mps):
        rod.velocity_collection[axis] = speed * s / L
    held = np.array([True, True, True])
    system.constrain(rod).using(
        elastica.GeneralConstraint, constrained_position_idx=(0,), translational_constraint_selector=held
    )
    system.add_forcing_to(rod).using(elastica.GravityForces, acc_gravity=np.array([0.0, 0.0, -g]))
    system.finalize()
    return system, rod
