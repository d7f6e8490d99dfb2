"""Starts that the massless model proposes: one on each of its motions, found by many kicks in a moment."""

import hashlib
from collections.abc import Sequence
from functools import partial
from itertools import repeat

import numpy as np

import engine
from campaigns.machinery.folder import keep_json, kept_json
from campaigns.machinery.plan import Plan
from campaigns.machinery.pools import opened
from campaigns.machinery.progress import stage
from campaigns.motions.starts import Start

SCREENED, PERIODS = 64, 80  # kicks of a value, and wave periods of each


def kicks(count: int, speed_mps: float, seed: int, skipped: int = 0) -> np.ndarray:
    """(count, 2) velocities (m/s) on the square of half width speed_mps: points of a scrambled Halton sequence."""
    from scipy.stats import qmc

    points = qmc.Halton(2, seed=seed).random(skipped + count)[skipped:]
    return speed_mps * (2.0 * points - 1.0)


def proposals(plan: Plan, scenes: Sequence, speed_mps: float, seed: int) -> list[list[Start]]:
    """For each scene a start on each motion of its massless tether; none where that model does not cover a scene.

    What was found is kept in the folder. Raises OSError.
    """
    path = plan.how.out / "proposals.json"
    keys = [_key_of(scene, speed_mps, seed) for scene in scenes]
    known = kept_json(path)
    missing = [(key, scene) for key, scene in zip(keys, scenes, strict=True) if key not in known]
    if missing:
        count = len(missing)
        kicked = kicks(SCREENED, speed_mps, seed)
        done = 0
        with (
            opened(plan.how.backend, min(plan.how.jobs, count), plan.how.dask_address) as execute,
            stage("massless tethers", float(count), "values", lambda: float(done)),
        ):
            for (key, _), found in execute(partial(_proposed, kicked), missing):
                known[key] = found
                done += 1
        keep_json(path, {key: known[key] for key in keys})
    return [[Start("massless", tuple(kick), tuple(moved)) for kick, moved in known[key]] for key in keys]


def _key_of(scene, *settings) -> str:
    return hashlib.sha256(repr((scene.key(), engine.source_hash(), SCREENED, PERIODS, *settings)).encode()).hexdigest()


def _proposed(kicked: np.ndarray, task: tuple) -> list[tuple[list[float], list[float]]]:
    """Velocity (m/s) and displacement from rest (m) on each motion that the massless tether of a scene has."""
    from analysis import joins, settled

    _, scene = task
    try:
        rest = np.array(engine.massless_rest(scene))
        starts = np.column_stack([*map(partial(np.full, len(kicked)), rest), kicked])
        runs = engine.massless_runs(scene, starts, PERIODS)
    except ValueError:  # not covered
        return []
    known, found = [], []
    for strobed, measures in zip(runs.strobed, runs.measures, strict=True):
        if not (np.isfinite(strobed).all() and joins(strobed, measures, known) is None):
            continue
        later = strobed[len(strobed) // 2 :]
        place, speed = np.ptp(later[:, :2], axis=0).max(), np.ptp(later[:, 2:], axis=0).max()
        swing = np.ptp(measures[len(measures) // 2 :, :2])  # of r
        omega = 2.0 * np.pi / scene.waves.period_s
        size = max(place, swing, 1e-6), max(speed, omega * swing, 1e-6)
        motion = settled(strobed, measures, scale=[*repeat(size[0], 2), *repeat(size[1], 2)])
        if motion is not None:
            known.append(motion)
            x, z, u, w = map(float, strobed[-1])
            found.append(([u, w], [x - rest[0], z - rest[1]]))
    return found
