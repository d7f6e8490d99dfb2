"""Starts that the massless model proposes: one on each of its motions, found by many kicks in a moment."""

import math
from collections.abc import Sequence
from functools import cache, partial

import numpy as np

import engine
from analysis import approach_evidence, approached_period, joins, settled
from analysis.orbits import NoImage, OrbitMap, find_orbit
from campaigns.explore.starts import Start, kick_speed_mps
from campaigns.machinery import Plan, Store, Task, key_of, made_by, results
from engine.physics.strains import tension_at
from engine.physics.waves import wave_number

SCREENED, PERIODS = 64, 80  # kicks of a value, and wave periods of each
SCENES = 2  # that a worker is given at once
LONGER = 320  # wave periods of the start from rest and of kicks that come nearer to a period, if 80 do not settle them
DIFFERENCE = 1e-5  # of a state, for the derivative of the map over a wave period


def kicks(count: int, speed_mps: float, seed: int, place: int) -> list[tuple]:
    """Velocities (m/s) drawn independently and uniformly from the square of half width speed_mps, for a place.

    The interval of a share (`analysis.share_of`) needs independent draws. Eight points of a Halton sequence are a
    lattice of one spacing, which may fall into step with the basins.
    """
    drawn = np.random.default_rng([seed, place]).uniform(-speed_mps, speed_mps, (count, 2))
    return [tuple(kick) for kick in drawn.tolist()]


def screened(plan: Plan, scenes: Sequence, speed_mps: float | None, seed: int) -> list[list]:
    """For each scene the motions of its massless tether (`simplified`); none where that model does not cover a scene.

    A motion has velocity (m/s) and displacement from rest (m) of a start on it, its period in wave periods, its largest
    tension (N) and that at rest, the share of the kicks that end in it, and whether the start from rest does. All
    starts that have not settled count as one more, which has no start and no period. What was found is kept in the
    folder. Raises OSError.
    """
    from scipy.stats import qmc

    spread = 2.0 * qmc.Halton(2, seed=seed).random(SCREENED) - 1.0
    directions = np.vstack([spread, np.zeros(2)])
    tasks = []
    for scene in map(simplified, scenes):
        fastest_mps = kick_speed_mps(speed_mps, scene)
        key = key_of(scene.key(), fastest_mps, seed, engine.source_hash(), _maker())
        tasks.append(Task(key, partial(_motions, fastest_mps * directions, scene)))
    store = Store(plan.out / "proposals")
    return [result["motions"] for result in results(plan.how, store, "massless tethers", tasks, size=SCENES).results]


def proposals(plan: Plan, scenes: Sequence, speed_mps: float | None, seed: int) -> list[list]:
    """For each scene a start on each motion of its massless tether that kicks have found (`screened`)."""
    starts = []
    for motions in screened(plan, scenes, speed_mps, seed):
        begun = [motion for motion in motions if motion["kick"] and motion["share"]]
        starts.append([Start("massless", tuple(motion["kick"]), tuple(motion["moved"])) for motion in begun])
    return starts


def has_proposals(scene) -> bool:
    """Does the massless model cover a scene, once it is `simplified`?"""
    return engine.massless_covers(simplified(scene))


def simplified(scene):
    """The scene without the laws that the massless model lacks, because a start need only be near a motion.

    The floor, the damping of the line, its dry part and the push of the water along it go. A raised or shifted anchor
    goes to the origin, with the depth and the phase of the waves that it had. A current that changes with the height
    has everywhere the velocity that it has one length of the line above the bed; about a wetted cap there is none.
    """
    from engine.scene.sections import UniformCurrent

    waves, current, anchor = scene.waves, scene.current, scene.anchor.position_m
    if waves is None:
        return scene
    plain = {"damping_Ns": None, "damping_critical": None, "froude_krylov": "normal", "submergence": "full"}
    scene = scene.model_copy(update={"floor": None}).with_values("tether", **plain)
    if any(anchor):
        depth_m = scene.water.depth_m
        k = wave_number(waves.period_s, depth_m, scene.gravity_mps2)
        along_m = anchor[0] * math.cos(waves.direction_rad) + anchor[1] * math.sin(waves.direction_rad)
        scene = scene.with_values("waves", phase_rad=waves.phase_rad + k * along_m)
        scene = scene.with_values("water", depth_m=depth_m - anchor[2])
        scene = scene.with_values("anchor", position_m=(0.0, 0.0, 0.0))
    if scene.buoy is not None and scene.buoy.submergence != "full":
        return scene.model_copy(update={"current": None})
    if current is not None and current.law == "profile":
        velocities = zip(*current.velocity_mps, strict=True)
        velocity = [np.interp(scene.tether.length_m, current.height_m, component) for component in velocities]
        scene = scene.model_copy(update={"current": UniformCurrent(law="uniform", velocity_mps=velocity)})
    return scene


@cache
def _maker() -> str:
    return made_by("analysis", "campaigns/explore/proposals.py")


def _motions(kicked: np.ndarray, scene) -> dict:
    """`screened` of a scene."""
    try:
        rest = np.array(engine.massless_rest(scene))
    except ValueError:  # not covered
        return {"motions": []}
    starts = np.column_stack([np.tile(rest, (len(kicked), 1)), kicked])
    known, motions, numbers = [], [], range(len(kicked))
    loose = {"kick": None, "moved": None, "period": None, "tension_N": 0.0, "share": 0.0, "rest": False}
    for periods in (PERIODS, LONGER):
        runs = engine.massless_runs(scene, starts[numbers], periods)
        ringing = []
        for number, strobed, measures in zip(numbers, runs.strobed, runs.measures, strict=True):
            if not np.isfinite(strobed).all():
                continue
            from_rest = number == SCREENED
            joined = joins(strobed, measures, known)
            settled = None
            if joined is None:
                settled = _settled(scene, strobed, measures, from_rest and periods == LONGER)
            if joined is not None:
                motion = motions[joined]
            elif settled is not None:
                known.append(settled)
                x, z, u, w = map(float, strobed[-1])
                motion = {"kick": [u, w], "moved": [x - rest[0], z - rest[1]], "period": settled.period}
                motion |= {"tension_N": float(settled.measures[:, 2].max()), "share": 0.0, "rest": False}
                motions.append(motion)
            elif periods < LONGER and (from_rest or approached_period(strobed, np.ptp(strobed, axis=0))):
                ringing.append(number)
                continue
            else:
                motion = loose
                largest_N = float(measures[len(measures) // 2 :, 2].max())
                motion["tension_N"] = max(motion["tension_N"], largest_N)
            if from_rest:
                motion["rest"] = True
            else:
                motion["share"] += 1.0 / SCREENED
        if not ringing:
            break
        numbers = ringing[::-1]  # the one from rest first: others join what it comes to
    if loose["tension_N"]:
        motions.append(loose)
    static_N = tension_at(float(np.hypot(*rest)) / scene.tether.length_m - 1.0, scene.tether.tension)
    for motion in motions:
        motion["static_N"] = max(float(static_N), 0.0)
    return {"motions": motions}


def _settled(scene, strobed: np.ndarray, measures: np.ndarray, ahead: bool):
    """The periodic motion to which a massless run has settled, in the scale of its size within the period; ahead: or to
    which it comes nearer. None: neither."""
    later = strobed[len(strobed) // 2 :]
    place, speed = np.ptp(later[:, :2], axis=0).max(), np.ptp(later[:, 2:], axis=0).max()
    swing = np.ptp(measures[len(measures) // 2 :, :2])  # of r
    omega = 2.0 * np.pi / scene.waves.period_s
    size = max(place, swing, 1e-6), max(speed, omega * swing, 1e-6)
    scale = np.repeat(size, 2)
    motion = settled(strobed, measures, scale=scale)
    if motion is not None and motion.period:
        return motion
    start = _orbit_ahead(scene, strobed, scale) if ahead else None
    if start is None:
        return None
    run = engine.massless_runs(scene, start[None], PERIODS)
    return settled(run.strobed[0], run.measures[0], scale=scale)


def _orbit_ahead(scene, strobed: np.ndarray, scale: np.ndarray) -> np.ndarray | None:
    """A state (4,) on the periodic orbit that a massless run comes nearer to (`analysis.approaches`); None: on none."""

    def step(z, _):
        starts = np.vstack([z, z + DIFFERENCE * np.eye(4), z - DIFFERENCE * np.eye(4)])
        image, *beside = engine.massless_runs(scene, starts * scale, 1).strobed[:, -1] / scale
        if not np.isfinite(beside).all():
            raise NoImage("the buoy flies off")
        slope = np.subtract(beside[:4], beside[4:]).T / (2.0 * DIFFERENCE)
        return image, lambda V: slope @ V

    period = approached_period(strobed, scale)
    orbit = find_orbit(OrbitMap(step), strobed[-1] / scale, 0.0, period or 1, count=4)
    if not orbit.found:
        return None
    errors = orbit.residuals + DIFFERENCE
    approach = approach_evidence(strobed, orbit.points * scale, orbit.multipliers, errors, scale)
    return orbit.points[0] * scale if approach.passed else None
