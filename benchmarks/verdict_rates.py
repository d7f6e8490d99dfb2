"""How often is the verdict on a simulated motion (`analysis.motion_regime`) wrong, late, or missing?

    python -m benchmarks.verdict_rates [--quick] [--only WORD ...] [--cable] [--write]

Motions of which a much longer record of their own says what they are: eq. (33) over frequency, force and starts,
integrated exactly; tori and locked motions of a forced van der Pol oscillator; the Henon map; the strange nonchaotic
attractor of Grebogi, Ott, Pelikan & Yorke. --cable: also 60 buoys in small and moderate waves, at drawn depths and
stiffnesses, and kA = 0.13 at four depths (eight minutes of a core). Prints which motions got which word ("later" where
a motion settles only after the periods that were judged) and two tables: how many words are right, and the standard
deviation of z = (exponent of a stretch - that of the rest)/stated error. --write: all of it, into the pages.
"""

import math
from collections import Counter
from dataclasses import astuple, replace
from functools import partial

import numpy as np
from numba import njit

from analysis import motion_regime, next_look, tangent_lyapunov
from analysis.oscillator import SnapOscillator
from analysis.oscillator.growth import random_starts
from analysis.oscillator.strobing import growth_over_values
from benchmarks.known_records import GOLDEN
from benchmarks.shared import command_line
from benchmarks.write_tables import publish
from campaigns.machinery.long_runs import LEAST_CHECK, SURE
from engine import load_scene, simulate_each
from engine.views import state_of

BUDGET, TOLERANCE = 1500, 0.01
STRETCHES = 200, 500, 2000  # periods
VIOLENT_DEPTHS_M = 20.8, 21.0, 21.6, 22.5
OPEN = "undecided", "transient"


def snap_motions(count, periods):
    """(strobed, growth in nats) of eq. (33) at random frequencies, forces and starts."""
    random = np.random.default_rng(1)
    for start in random_starts(count, 2):
        oscillator = replace(SnapOscillator(), frequency=random.uniform(0.9, 1.6), force=random.uniform(0.8, 2.0))
        parameters = np.array([astuple(oscillator)])
        sums, section, _, _ = growth_over_values(parameters, start[None], 0, periods, 1, periods)
        if np.isfinite(section).all():
            yield section[0, 0], sums[0, 0, :, 0]


@njit(cache=False)
def _slopes(t, y, force, frequency):
    """Of x'' - 5 (1 - x^2) x' + x = force cos(frequency t), and of a perturbation."""
    x, v, dx, dv = y
    damping = 5.0 * (1.0 - x * x)
    return v, damping * v - x + force * np.cos(frequency * t), dv, (-10.0 * x * v - 1.0) * dx + damping * dv


@njit(cache=False)
def _moved(y, h, k):
    return y[0] + h * k[0], y[1] + h * k[1], y[2] + h * k[2], y[3] + h * k[3]


@njit(cache=False)
def _van_der_pol(force, frequency, periods, steps):
    """Strobed states and growth, by Runge and Kutta's method."""
    out, growth = np.empty((periods, 2)), np.empty(periods)
    y, h = (2.0, 0.0, 1.0, 0.0), 2.0 * np.pi / frequency / steps
    for p in range(periods):
        out[p] = y[:2]
        for k in range(steps):
            t = k * h
            a = _slopes(t, y, force, frequency)
            b = _slopes(t + 0.5 * h, _moved(y, 0.5 * h, a), force, frequency)
            c = _slopes(t + 0.5 * h, _moved(y, 0.5 * h, b), force, frequency)
            d = _slopes(t + h, _moved(y, h, c), force, frequency)
            y = _moved(_moved(_moved(_moved(y, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, d)
        length = np.hypot(y[2], y[3])
        growth[p], y = np.log(length), (y[0], y[1], y[2] / length, y[3] / length)
    return out, growth


def van_der_pol_motions(count, periods):
    """(strobed, growth) of tori and locked motions: the force is too weak for chaos."""
    random = np.random.default_rng(3)
    for _ in range(count):
        yield _van_der_pol(random.uniform(0.1, 1.0), random.uniform(0.8, 3.0), periods, 300)


def nonchaotic_motions(count, periods):
    """x' = 2 sigma tanh(x) cos(2 pi theta), theta' = theta + golden mean: strange, and not chaotic, for sigma > 1."""
    random = np.random.default_rng(5)
    for _ in range(count):
        x, theta, sigma = 0.5, random.random(), random.uniform(1.1, 2.0)
        turns = 2.0 * np.pi * (theta + GOLDEN * np.arange(periods))
        out = np.column_stack([np.empty(periods), np.cos(turns), np.sin(turns)])
        for k in range(periods):
            out[k, 0] = x
            x = 2.0 * sigma * np.tanh(x) * out[k, 1]
        # a shift of theta neither grows nor shrinks: the largest exponent is 0, that of x is negative
        yield out, np.zeros(periods)


def henon_motions(count, periods):
    """(strobed, growth) of the Henon map, b = 0.3, over a: periods and chaos."""
    for a in np.linspace(1.0, 1.4, count):
        (x, y), (u, w) = (0.1, 0.1), (1.0, 0.0)
        out, growth = np.empty((periods, 2)), np.empty(periods)
        for k in range(periods):
            out[k] = x, y
            u, w = -2.0 * a * x * u + w, 0.3 * u
            length = np.hypot(u, w)
            growth[k], u, w = np.log(length), u / length, w / length
            x, y = 1.0 - a * x * x + y, 0.3 * x
        yield out, growth


def cable_motions(changes, periods):
    """(strobed, growth, scale, depth in words) of the scene `tethered_buoy` with each of these changes."""
    scenes = [load_scene("tethered_buoy", {"output.tangent_vectors": 1, **keys}) for keys in changes]
    runs = dict(simulate_each(scenes, periods))
    for number in range(len(scenes)):
        run, step_s, period_s = runs[number], scenes[number].sample_step_s(), scenes[number].waves.period_s
        if run.status != "ok":
            print(f"{changes[number]}: {run.status}")
            continue
        states, scale = state_of(scenes[number], run.columns, round(periods // 2 * period_s / step_s))
        strobed = np.column_stack(list(states.values()))[:: round(period_s / step_s)]
        yield strobed, run.tangent.growth_nats[:, 0], np.array(scale), f"H = {scenes[number].water.depth_m} m"


def mild_cables(count, periods):
    """Buoys in small and moderate waves at random depths, stiffnesses in tension and in bending."""
    random = np.random.default_rng(7)
    changes = []
    for drawn in random.uniform((0.016, 20.8, 4e4, -0.7), (0.1, 25.0, 8e4, 0.5), (count, 4)):
        steepness, depth_m, stiffness_N, bending_exponent = drawn
        changes.append(
            {
                "waves.steepness": steepness,
                "water.depth_m": depth_m,
                "tether.tension.stiffness_N": stiffness_N,
                "tether.bending_stiffness_Nm2": 10.0**bending_exponent,
            }
        )
    return cable_motions(changes, periods)


def violent_cables(count, periods):
    """kA = 0.13 at the depths where it is chaos, chaos, a torus and period 2, pushed in two ways."""
    changes = []
    for depth_m in VIOLENT_DEPTHS_M:
        for push_mps in (0.0, 0.1):
            velocity = [push_mps, 0.0, 0.0]
            keys = {"waves.steepness": 0.13, "water.depth_m": depth_m, "start.buoy_velocity_mps": velocity}
            changes.append(keys)
    return cable_motions(changes, periods)


KINDS = {  # motions, how many, periods of each
    "eq. (33)": (snap_motions, 400, 20_000),
    "van der Pol": (van_der_pol_motions, 150, 20_000),
    "Henon map": (henon_motions, 100, 20_000),
    "strange nonchaotic": (nonchaotic_motions, 50, 20_000),
}
CABLES = {"cable, mild": (mild_cables, 60, 1000), "cable, kA = 0.13": (violent_cables, 8, 6000)}


def truth(strobed, growth, scale):
    """What the end of a long record is ("periodic", "torus", "chaotic", "not known"), and since when."""
    tail = min(1000, len(strobed) // 4)
    for n in range(1, 65):
        if np.all(np.abs(strobed[n:] - strobed[:-n])[-tail:] < TOLERANCE * scale):
            orbit = strobed[len(strobed) - n + (np.arange(len(strobed)) - len(strobed)) % n]
            off = np.flatnonzero((np.abs(strobed - orbit) > 3.0 * TOLERANCE * scale).any(axis=1))
            return "periodic", off[-1] + 1 if len(off) else 0
    (exponent,) = tangent_lyapunov(growth[len(growth) // 2 :])
    if exponent.value > max(5.0 * exponent.error, 0.005):
        return "chaotic", 0
    return "torus" if abs(exponent.value) + 3.0 * exponent.error < 0.02 else "not known", 0


def judged(strobed, growth, scale):
    """The verdict, look by look as `campaigns.judge` goes on; what a motion does next stands for its tighter run."""
    checks, since, end, budget = {}, BUDGET, 0, min(BUDGET, len(growth))
    while end < budget:
        end = min(next_look(end), budget)
        known = np.where(np.arange(end) < since, np.nan, growth[:end])
        look = partial(motion_regime, strobed[: end + 1], known, scale=scale, tolerance=TOLERANCE, tighter=checks)
        verdict = look()
        if verdict.regime == "chaotic" and end not in checks:
            exponent = next(item for item in verdict.evidence if item.name == "exponent")
            enough = math.ceil((verdict.points - 1) * (SURE * exponent.error / exponent.value) ** 2)
            length = min(max(enough, LEAST_CHECK), verdict.points - 1)
            checks[end] = tangent_lyapunov(growth[end : end + length])[0]
            verdict = look()
        if verdict.regime not in ("undecided", "transient"):
            break
        since = min(since, end) if verdict.regime == "undecided" else since
    return verdict


def scatter(growth, length):
    """(value of a stretch - that of the rest)/error, for the first 40 stretches of that length."""
    growth = growth[500:]
    (total,) = tangent_lyapunov(growth)
    spacing = min(length, 500)
    overlap = np.sqrt(1.0 - length / len(growth))  # the whole contains the stretch, and so lies nearer to it
    scores = []
    for first in range(0, len(growth) - length, spacing)[:40]:
        (exponent,) = tangent_lyapunov(growth[first : first + length])
        scores.append((exponent.value - total.value) / (overlap * exponent.error))
    return scores


def right(true_word, word):
    """Whether a word is that of the truth."""
    return (true_word, word) in (("periodic", "periodic"), ("torus", "quasi-periodic"), ("chaotic", "chaotic"))


def counted(kind, generate, count, periods):
    """(Counter of (truth, settles later, word), mean of the periods judged, {name, stretch: scores z}) of a kind."""
    counts, judged_periods, scores = Counter(), [], {}
    for strobed, growth, *known_scale in generate(count, periods):
        # of the settled motion: starts of eq. (33) may lie a hundred times as far out
        scale, depth = known_scale or (max(1.0, np.ptp(strobed[periods // 2 :], axis=0).max()), "")
        (true_word, since), verdict = truth(strobed, growth, scale), judged(strobed, growth, scale)
        judged_periods.append(verdict.transient + verdict.points - 1)
        word = "periodic" if verdict.period else verdict.regime
        counts[true_word, since > judged_periods[-1], word] += 1
        if generate is violent_cables or (true_word == "chaotic" and not depth):
            for length in STRETCHES:
                scores.setdefault((f"buoy, {depth}" if depth else kind, length), []).extend(scatter(growth, length))
    return counts, np.mean(judged_periods), scores


def rates_row(kind, counts, mean_periods):
    """The row of a kind of motions in the table of words."""
    totals = Counter()
    for (true_word, settles_later, word), number in counts.items():
        if true_word == "not known":
            outcome = "not known"
        elif right(true_word, word):
            outcome = "right"
        elif settles_later:
            outcome = "later"
        elif word in OPEN:
            outcome = "open"
        else:
            outcome = "wrong"
        totals[outcome] += number
    cells = [str(totals[outcome]) for outcome in ("right", "wrong", "open", "later")]
    return [kind, str(counts.total()), *cells, f"{mean_periods:.0f}"]


def errors_rows(scores):
    """The rows of the table of errors: a motion, and the scatter of z over stretches of each length."""
    rows = []
    for name in dict.fromkeys(name for name, _ in scores):
        cells = [f"{np.std(scores[name, length]):.2f} ({len(scores[name, length])})" for length in STRETCHES]
        rows.append([name, *cells])
    return rows


def main():
    parser = command_line(__doc__)
    parser.add_argument("--quick", action="store_true", help="a tenth of the motions")
    parser.add_argument("--only", nargs="+", default=[""], metavar="WORD", help="kinds whose name has this word")
    parser.add_argument("--cable", action="store_true", help="runs of the engine too: eight minutes of a core")
    parser.add_argument("--write", action="store_true", help="write the tables into their page: of all kinds")
    options = parser.parse_args()
    if options.write and (options.quick or options.only != [""] or not options.cable):
        parser.error("--write: the tables of the page have all motions; give --cable, and neither --quick nor --only")
    rows, scores = [], {}
    for kind, (generate, count, periods) in (KINDS | CABLES if options.cable else KINDS).items():
        if not any(word in kind for word in options.only):
            continue
        number = count // 10 if options.quick else count
        counts, mean_periods, of_kind = counted(kind, generate, number, periods)
        for (true_word, settles_later, word), times in sorted(counts.items()):
            print(f"{kind}: {true_word}{' later' if settles_later else ''}, called {word}: {times}", flush=True)
        rows.append(rates_row(kind, counts, mean_periods))
        scores |= of_kind
    publish("verdict_rates", rows, options.write)
    publish("exponent_errors", errors_rows(scores), options.write)


if __name__ == "__main__":
    main()
