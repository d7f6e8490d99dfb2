"""The small push that lets a motion leave its plane: a velocity of the buoy at t = 0, across the waves or along them.

Without one nothing in the equations leaves the plane of uni-directional waves: y = 0 stays exactly 0 in three
dimensions too. The paper pushes the buoy by 1e-5 m/s across the waves (section 4.2.2, figure 20).
"""

import math

SEED_MPS = 1e-5
# name: components along and across the waves; a mirrored push has to give the mirrored motion, one along the waves none
DIRECTIONS = {
    "lateral": (0.0, 1.0),
    "mirrored": (0.0, -1.0),
    "oblique": (math.sqrt(0.5), math.sqrt(0.5)),
    "along": (1.0, 0.0),
}


def velocity(seed_mps: float, direction: str) -> list[float]:
    """The velocity (3,) in m/s of a push of that size and direction, for waves along x."""
    along, across = DIRECTIONS[direction]
    return [seed_mps * along, seed_mps * across, 0.0]


def in_space(scene):
    """The scene in three dimensions, and whether a push had to be added: (scene, added).

    A scene whose buoy starts without a velocity across its waves gets SEED_MPS there. Perturbations that only a planar
    run can carry are left out. Raises SceneError for what three dimensions do not allow.
    """
    from engine.scene import scene_from_toml

    heading = scene.waves.direction_rad
    sine, cosine = (math.sin(heading), math.cos(heading)) if heading else (0.0, 1.0)
    vx, vy, vz = scene.start.buoy_velocity_mps
    changes = {"motion.dimensions": 3, "output.tangent_vectors": 0, "output.lateral_growth": False}
    added = math.isclose(-vx * sine + vy * cosine, 0.0, abs_tol=1e-300)
    if added:
        changes["start.buoy_velocity_mps"] = [vx - SEED_MPS * sine, vy + SEED_MPS * cosine, vz]
    return scene_from_toml(scene.to_toml(), changes), added
