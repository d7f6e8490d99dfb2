"""Law: in still water without drag a sphere that goes in and out of it keeps its energy,

    (M + s M_a) |V|^2/2 + M g z + rho g int V_wet dh + the stretching of its line.

A sphere afloat is thrown up so that it leaves the water altogether, falls, goes under, and so on; the line is twice its
length, so soft that it ties the sphere down with no more than 150 N, and never slack.
"""

from functools import cache

import numpy as np

from tests.engine.caps import afloat, potential, volume
from tests.engine.lines import Motion, mean, positions

THROWN = {"up": [0.0, 0.0, 7.0], "aslant": [2.5, 0.0, 6.5]}
DURATION_S = 8.0


@cache
def history(thrown, **solver):
    """Energy over its kinetic part at the start, less one at the start; and the lowest point over the water (m)."""
    scene = afloat(
        {"start.buoy_velocity_mps": THROWN[thrown], "output.step_s": 0.02, "tether.added_mass": 0.0,
         "water.depth_m": 40.0, **{f"solver.{key}": value for key, value in solver.items()}},
        area_m2=1e-6, **{"tension.stiffness_N": 100.0},
    )  # fmt: skip
    motion, buoy, D = Motion(scene, DURATION_S), scene.buoy, scene.buoy.diameter_m
    assert motion.status == 0
    energies, heights = [], []
    for _, Y in motion.states():
        z = positions(Y, motion.h)[-1, 1]
        h = scene.water.depth_m - z + D / 2
        mass = buoy.mass_kg + buoy.added_mass_kg * volume(h, D) / volume(D, D)
        stretching = 0.5 * scene.tether.tension.stiffness_N * np.sum(motion.h * mean(Y[:, 0] ** 2))
        energies.append([0.5 * mass * np.sum(Y[-1, 2:4] ** 2), potential(scene, z), stretching])
        heights.append(-h)
    assert int(motion.inner.state["status"]) == 0
    energies = np.array(energies)
    return (energies.sum(axis=1) - energies[0].sum()) / energies[0, 0], np.array(heights)
