"""The exponent of a record by Wolf's method where it does not depend on the settings, with an honest error.

One setting gives a number whatever the record is. Believe it where neighbouring settings agree: over embedding
dimensions m_0, m_0 + 1, m_0 + 2 and evolution times 1/4, 1/2, 3/4, 1 mean period, the value is the median over the
settings that qualify. The error holds what blocks of the record disagree on, what the settings disagree on, and two
known biases: the finite length of the vectors, seen by doubling it, and the noise on them (WolfRun.noise_bias),

    error^2 = median(block error)^2 + (half the range of the middle 68 % of the settings)^2
              + rms(doubled - value)^2 + median(noise bias)^2

Without the last two noisy maps, where the first two are small, miss the truth by three errors. The value is not
corrected for either: it stays what Wolf's method gives. m_0 unfolds the motion (false neighbours). A setting does not
qualify when half of its vectors end longer than 0.3 of the rms radius of the attractor: growth is then bounded by its
size, and the exponent too small.

The paper does not say how the settings behind its figure 14 were chosen.

In the paper: eq. (32) Lyapunov exponent.
"""

from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from analysis.embedding import choose_embedding, noise_level
from analysis.exponents import NATS_PER_TIME, Exponent, no_exponent
from analysis.sampling import checked_positive, checked_series, locked
from analysis.wolf_pairs import wolf_run

METHOD = "Wolf et al. 1985, plateau"
EVOLUTION_PERIODS = (0.25, 0.5, 0.75, 1.0)
DIMENSIONS = 3
LONGEST_END = 0.3
LEAST_SETTINGS = 3
LEAST_PERIODS = 20
LEAST_SAMPLES = 200


def wolf_lyapunov(series: ArrayLike, step_s: float) -> Exponent:
    """Largest Lyapunov exponent of a series: the median of Wolf's method over a plateau of settings.

        lambda = 1/(K e) sum_k ln(L'_k/L_k)   for each (m, e);   value = median, error: head of this file

    series (n,)     any unit, evenly sampled; what was left of a transient counts as motion
    step_s          sampling step [s], or 1 for a map
    The delay and m_0 are those of choose_embedding, the noise that of noise_level. Theiler's window is the mean period
    or the span of a delay vector, whichever is longer. For one setting of one's own there is `wolf_run`.
    Returns an Exponent in nats per unit of time; positive: neighbours part exponentially; about 0: they do not. A
    stable periodic motion shows 0 at best, not its negative exponent: once settled, nothing in the record decays.
    NaN with a reason, never 0, when fewer than three settings qualify or the record has fewer than 20 mean periods.
    details: values, errors, end_lengths (d, e; ends in rms radii), qualified (d, e; bool), dimensions (d,), evolutions
    (e,) [samples], block_error, spread, length_change, noise_bias, noise, embedding (EmbeddingChoice), and of the
    setting nearest to the median run (WolfRun), whose convergence over time_s is fig. 14 of the paper.
    Raises ValueError for values that are not finite.
    Source: Wolf, Swift, Swinney & Vastano, Physica D 16, 285 (1985); what is ours: heads of this file, of wolf_pairs.
    """
    x, step_s = checked_series(series), checked_positive(step_s, "step_s")
    if len(x) < LEAST_SAMPLES or np.ptp(x) == 0.0:
        return no_exponent(METHOD, f"{LEAST_SAMPLES} samples of a series that moves are needed, given {len(x)}")
    embedding = choose_embedding(x)
    lag, period = embedding.lag, embedding.mean_period
    if len(x) < LEAST_PERIODS * period:
        return no_exponent(METHOD, f"{LEAST_PERIODS} mean periods are needed, given {len(x) / period:.3g}")
    dimensions = tuple(range(embedding.dimension, embedding.dimension + DIMENSIONS))
    evolutions = tuple(sorted({max(1, round(share * period)) for share in EVOLUTION_PERIODS}))
    noise = noise_level(x, lag)

    def run(m, e, lengths=1.0):
        theiler = max(round(period), (m - 1) * lag)
        return wolf_run(x, step_s, lag, m, e, theiler, noise, lengths)

    used = {"dimensions": dimensions, "evolutions": evolutions, "noise": noise, "embedding": embedding}
    return _plateau(run, used)


def _plateau(run, details):
    """The Exponent of runs over all settings: pairs of a dimension and an evolution time."""
    grid = len(details["dimensions"]), len(details["evolutions"])
    settings = list(product(details["dimensions"], details["evolutions"]))
    runs, measured = [], []
    for setting in settings:
        runs.append(run(*setting))
        measured.append((runs[-1].value, runs[-1].error, _typical_end(runs[-1])))
    values, errors, ends = np.array(measured).T
    qualified = np.isfinite(values) & (ends <= LONGEST_END)
    arrays = {"values": values, "errors": errors, "end_lengths": ends, "qualified": qualified}
    details |= {name: locked(array.reshape(grid)) for name, array in arrays.items()}
    if np.sum(qualified) < min(LEAST_SETTINGS, len(runs)):
        why = f"vectors end longer than {LONGEST_END} rms radii: the growth is bounded, not exponential"
        if not np.isfinite(values).all():
            why = runs[int(np.argmin(np.isfinite(values)))].reason
        return no_exponent(METHOD, f"{np.sum(qualified)} of {len(runs)} settings qualify; {why}", details=details)
    value, used = float(np.median(values[qualified])), np.flatnonzero(qualified)
    low, high = np.quantile(values[used], [0.16, 0.84])
    change = np.array([run(*settings[k], lengths=2.0).value - values[k] for k in used])
    change = change[np.isfinite(change)]
    parts = {
        "block_error": float(np.median(errors[used])),
        "spread": float(0.5 * (high - low)),
        "length_change": float(np.sqrt(np.mean(change**2))) if len(change) else np.nan,
        "noise_bias": float(np.median([runs[k].noise_bias for k in used])),
    }
    error = float(np.sqrt(sum(part**2 for part in parts.values())))
    reason = f"median of {len(used)} of {len(runs)} settings, {low:.4g} to {high:.4g} nats/time"
    nearest = runs[used[np.argmin(np.abs(values[used] - value))]]
    return Exponent(value, error, NATS_PER_TIME, METHOD, reason, details | parts | {"run": nearest})


def _typical_end(run):
    """Median length at the end of an evolution, in rms radii; inf where nothing was followed."""
    followed = run.end_length[np.isfinite(run.end_length)]
    return float(np.median(followed) / run.size) if len(followed) else np.inf
