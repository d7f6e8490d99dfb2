"""A run of the accuracy campaign as one row: what it was, its error, what it cost."""

import functools
import math

import numpy as np

from campaigns import columns
from campaigns.accuracy.works import BY_NAME, RADIUS, STRAIN, UNITS, Work
from campaigns.columns import MESSAGE, RUN_KEY, STATUS, WALL_S, Column, names
from campaigns.machinery.plan import KeptRun

STEPPING = (columns.STEPS, columns.REJECTED, columns.NEWTON, columns.NEWTON_FAILURES)
COUNTED = (columns.END_S, *STEPPING, columns.LOOPS, columns.TURN)
COLUMNS = (
    Column("work", symbol="work", meaning="what is simulated"),
    Column("kind", symbol="kind", meaning="what the run is for"),
    Column("method", symbol="method", meaning="integrator or scheme of the engine, or the other code"),
    Column("nodes", "", "nodes", "nodes of the line; segments or elements of other codes", 0),
    Column("control", symbol="control", meaning="what is varied: a tolerance, a step, a Courant number"),
    Column("setting", "", "setting", "its value in the first round", 6),
    Column("round", "", "round", "turn of a timed setting", 0),
    STATUS,
    Column("error", "", "error", "distance from the reference, or from the exact solution, in error_unit", 4),
    Column("error_early", "", "early", "the same over the first half of the run", 4),
    Column("error_unit", symbol="unit", meaning="mm, or per cent of the static strain"),
    Column("error_against_ours", "", "off ours", "distance of another code from our refined run, in error_unit", 4),
    WALL_S,
    *COUNTED,
    Column("peer_version", symbol="version", meaning="of the other code"),
    RUN_KEY,
    MESSAGE,
)
STATISTICS = names((WALL_S, *COUNTED))
EARLY = 0.5  # share of the run over which error_early is taken


def point_row(
    trajectory, work_name: str, reference: KeptRun | None = None, ours: KeptRun | None = None
) -> dict[str, object]:
    """The columns of `COLUMNS` that a run fills; those left out are unknown.

    reference, ours: the runs that error and error_against_ours are taken against, None for none; the error of a
    breaking line is taken against the exact solution. A run that ended early has no error.
    """
    work = BY_NAME[work_name]
    row = {"status": trajectory.status, "message": trajectory.message, "error_unit": UNITS[work.measure]}
    row |= {name: trajectory.statistics[name] for name in STATISTICS if name in trajectory.statistics}
    if trajectory.status != "ok":
        return row
    if work.measure == STRAIN:
        return row | {"error": strain_error(trajectory)}
    found = samples_of(work, trajectory)
    if reference and (samples := kept_samples(work, reference)) is not None:
        early = int(EARLY * len(samples))
        row |= {"error": rms_mm(found, samples), "error_early": rms_mm(found[:early], samples[:early])}
    if ours and (samples := kept_samples(work, ours)) is not None:
        row["error_against_ours"] = rms_mm(found, samples)
    return row


def samples_of(work: Work, trajectory) -> np.ndarray:
    """What is compared: r (m,) in m, or places (m, 3)."""
    if work.measure == RADIUS:
        return trajectory.columns["radius_m"]
    return np.stack([trajectory.columns[name] for name in ("x_m", "y_m", "z_m")], axis=1)


@functools.lru_cache(maxsize=32)
def _kept(work_name: str, kept: KeptRun, stamp: object) -> np.ndarray | None:
    run = kept.load()
    return samples_of(BY_NAME[work_name], run) if run.status == "ok" else None


def kept_samples(work: Work, kept: KeptRun) -> np.ndarray | None:
    """The samples of a finished run; None where there is none, or where it ended early."""
    stamp = kept.stamp()
    return None if stamp is None else _kept(work.name, kept, stamp)


def rms_mm(found: np.ndarray, reference: np.ndarray) -> float:
    """rms distance in mm of two series of the same length in m; inf where the lengths differ."""
    if found.shape != reference.shape:
        return math.inf
    square = (found - reference) ** 2
    return 1e3 * float(np.sqrt(np.mean(square.sum(axis=1) if square.ndim == 2 else square)))


def strain_error(trajectory) -> float:
    """Mean over line and profiles of |strain - exact strain|, per cent of the static strain."""
    lines, tether, end = trajectory.profiles, trajectory.scene.tether, trajectory.scene.end
    line = tuple(tether.tension.p), tether.density_kgpm3 * tether.area_m2, tether.length_m
    exact = _exact(*line, end.force_N[0], end.force_decay_s, tuple(lines.time_s[1:]), tuple(lines.s_m))
    share = np.trapezoid(np.abs(lines.strain[1:] - exact), lines.s_m, axis=1) / tether.length_m
    return 100.0 * float(share.mean()) / float(lines.strain[0].mean())


@functools.lru_cache(maxsize=64)
def _exact(law, mass, length, force_N, decay_s, times, places) -> np.ndarray:
    from campaigns.breaking_line.theory import fitted_break

    motion = fitted_break(law, mass, length, force_N, decay_s, times[-1])
    return np.array([motion.at(np.array(places), time_s)[0] for time_s in times])
