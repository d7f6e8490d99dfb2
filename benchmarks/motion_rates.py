"""How often is a start put to the wrong motion, and after how many periods (`analysis.settled`, `joins`, `grouped`)?

    python -m benchmarks.motion_rates [--systems N] [--starts N] [--cable] [--write]

Forced systems drawn at random, most with several motions: Duffing's two wells, the driven pendulum, eq. (33), the Henon
map; --cable: the buoy at six depths and steepnesses, kicked on a grid (two minutes more). The truth is that of 3000
periods: the period of the last 600, within 1e-4, and which of them lie on each other (the buoy: 200 periods, and the
largest tension). Starts run one after the other, as a campaign runs them: every period, has it joined a known motion;
every 15 periods from 60 on, has it settled; after 400 periods it is unsettled. "Confirmed": the same, but a motion
without a period counts only when it is the same 300 periods later. --write: with --cable, into the page.
"""

from collections import Counter

import numpy as np
from numba import njit

from analysis import detect_period, distance, joins, settled
from analysis.motions import APART
from analysis.oscillator import SnapOscillator, snap_motion
from benchmarks.shared import command_line
from benchmarks.write_tables import publish
from engine import load_scene, simulate_each
from engine.views import state_of

LONG, BUDGET, SAMPLES = 3000, 400, 64
CONFIRM = 300  # periods
DUFFING, PENDULUM = range(2)
BUOYS = ((25.0, 0.13), (22.5, 0.13), (21.0, 0.1), (21.0, 0.13), (20.8, 0.13), (21.0, 0.04))  # depth, steepness


@njit(cache=False)
def _force(law, damping, force, frequency, t, x, v):
    spring = x - x**3 if law == DUFFING else -np.sin(x)
    return spring - damping * v + force * np.cos(frequency * t)


@njit(cache=False)
def _flow(law, damping, force, frequency, x, v):
    """(LONG, SAMPLES, 2): x and v within each period, by the classical Runge-Kutta method."""
    out, h = np.empty((LONG, SAMPLES, 2)), 2.0 * np.pi / frequency / SAMPLES
    for k in range(LONG):
        for i in range(SAMPLES):
            out[k, i, 0], out[k, i, 1] = x, v
            t = i * h
            a1 = _force(law, damping, force, frequency, t, x, v)
            a2 = _force(law, damping, force, frequency, t + h / 2, x + h / 2 * v, v + h / 2 * a1)
            a3 = _force(law, damping, force, frequency, t + h / 2, x + h / 2 * v + h * h / 4 * a1, v + h / 2 * a2)
            a4 = _force(law, damping, force, frequency, t + h, x + h * v + h * h / 2 * a2, v + h * a3)
            x, v = x + h * v + h * h / 6 * (a1 + a2 + a3), v + h / 6 * (a1 + 2 * (a2 + a3) + a4)
    return out


def duffing(draw, starts):
    law = DUFFING, draw.uniform(0.1, 0.3), draw.uniform(0.1, 0.5), draw.uniform(0.7, 1.4)
    return [_flow(*law, *start) for start in draw.uniform(-2.0, 2.0, (starts, 2))]


def pendulum(draw, starts):
    law = PENDULUM, draw.uniform(0.1, 0.3), draw.uniform(0.5, 2.0), draw.uniform(0.5, 1.0)
    records = []
    for start in draw.uniform(-2.0, 2.0, (starts, 2)):
        angle, speed = np.moveaxis(_flow(*law, *start), -1, 0)
        records.append(np.stack([np.cos(angle), np.sin(angle), speed], axis=-1))
    return records


def snap(draw, starts):
    oscillator = SnapOscillator(draw.uniform(0.025, 0.1), draw.uniform(0.9, 1.6), draw.uniform(0.8, 2.0))
    begin = draw.uniform((-60.0, -25.0), (20.0, 25.0), (starts, 2))
    records = []
    for start in begin:
        motion = snap_motion(oscillator, start, LONG, SAMPLES)
        states = np.stack([motion.displacement, motion.velocity], axis=-1)
        records.append(states[:-1].reshape(LONG, SAMPLES, 2))
    return records


def henon(draw, starts):
    a, b = draw.uniform(0.9, 1.4), draw.uniform(0.2, 0.5)
    state = draw.uniform(-1.0, 1.0, (2, 20 * starts))
    out = [state]
    with np.errstate(over="ignore", invalid="ignore"):
        for _ in range(LONG - 1):
            state = np.stack([1.0 - a * state[0] ** 2 + state[1], b * state[0]])
            out.append(state)
    flows = np.array(out).transpose(2, 0, 1)
    return list(flows[np.isfinite(flows).all(axis=(1, 2))][:starts, :, None])


def record(flow):
    """States at the strobe, least and largest values of the periods, and the size of the motion within them."""
    measures = np.hstack([flow.min(axis=1), flow.max(axis=1)])
    return flow[:, 0], measures[:-1], np.maximum(np.ptp(flow[-100:], axis=(0, 1)), 1e-6)


def _label_of(late, period, motions):
    """The first motion of this period on which the states lie; the number of motions where there is none."""
    for label, (known_period, tree, spacing) in enumerate(motions):
        if period == known_period and np.median(tree.query(late)[0]) <= max(3.0 * spacing, 1e-3):
            return label
    return len(motions)


def truth(states, scale):
    """Labels of the runs by their last 600 states, and the period of each label (None: aperiodic)."""
    from scipy.spatial import cKDTree

    labels, motions = [], []
    for x in states:
        late = x[-600:] / scale
        period = detect_period(late, 64, 1e-4, np.ones(len(scale))).period
        label = _label_of(late, period, motions)
        labels.append(label)
        if label == len(motions):
            tree = cKDTree(late)
            spacing = 0.0 if period else np.median(tree.query(late, k=2)[0][:, 1])
            motions.append((period, tree, spacing))
    return labels, [motion[0] for motion in motions]


def cases(systems, starts, cable):
    """kind, records (strobed, measures), scale, labels, periods of the labels."""
    draw = np.random.default_rng(1)
    for kind in (duffing, pendulum, snap, henon):
        for _ in range(systems):
            records = [record(flow) for flow in kind(draw, starts)]
            if records:
                states, measures, scales = zip(*records, strict=True)
                scale = np.median(scales, axis=0)
                yield kind.__name__, list(zip(states, measures, strict=True)), scale, *truth(states, scale)
    for depth, steepness in BUOYS if cable else ():
        grid = np.linspace(-6.0, 6.0, 7)
        changes = {"water.depth_m": depth, "waves.steepness": steepness}
        kicks = ({**changes, "start.buoy_velocity_mps": [float(x), 0.0, float(z)]} for x in grid for z in grid)
        runs = dict(simulate_each([load_scene("tethered_buoy", kick) for kick in kicks], periods=200))
        yield "buoy", *_of_buoys([runs[i] for i in range(len(runs))])


def _of_buoys(runs):
    records = []
    for run in runs:
        step_s, period_s = run.scene.sample_step_s(), run.scene.waves.period_s
        coordinates, scale = state_of(run.scene, run.columns, round(140 * period_s / step_s))
        samples = round(period_s / step_s)
        columns = np.column_stack([run.columns["radius_m"], run.columns["tension_top_high_N"]])
        cut = np.lib.stride_tricks.sliding_window_view(columns, samples + 1, axis=0)[::samples]
        measures = np.column_stack([cut[:, 0].min(axis=1), cut.max(axis=2)])
        records.append((np.column_stack(list(coordinates.values()))[::samples], measures, scale))
    highest = np.array([measures[-60:, -1].max() for _, measures, _ in records])
    two = highest.max() > 1.2 * highest.min()  # the large motion and the small one
    labels = (highest > highest.mean()).astype(int) if two else np.zeros(len(runs), dtype=int)
    states, measures, scales = zip(*records, strict=True)
    return list(zip(states, measures, strict=True)), np.max(scales, axis=0), list(labels), None


def answers_of(records, scale, confirm=0):
    """For each run (answer, index of its motion, after how many periods); and the motions that are known in the end."""
    known, answers = [], []
    for states, measures in records:
        answer, index, n = "unsettled", None, 0
        for n in range(8, min(BUDGET, len(measures)) + 1):
            index = joins(states[: n + 1], measures[:n], known)
            if index is not None:
                answer = "joined"
                break
            if n < 60 or n % 15:
                continue
            motion = settled_motion(states, measures, n, scale, confirm)
            if motion is not None:
                answer, index = "settled", place_of(motion, known)
                break
        answers.append((answer, index, n))
    return answers, known


def settled_motion(states, measures, n, scale, confirm):
    """The motion on which a run has settled after n periods, and still is `confirm` periods later; or None."""
    motion = settled(states[: n + 1], measures[:n], scale=scale)
    if motion is None or motion.period is not None or not confirm:
        return motion
    later = settled(states[n : n + confirm + 1], measures[n : n + confirm], scale=scale)
    return later if later is not None and distance(motion, later) <= APART else None


def place_of(motion, known):
    """The index of the known motion that this one is; a new one is added to them."""
    if known:
        distances = [distance(motion, candidate) for candidate in known]
        nearest = int(np.argmin(distances))
        if distances[nearest] <= APART:
            return nearest
    known.append(motion)
    return len(known) - 1


def count(total, answers, known, labels, periods):
    """Add to `total` how many answers are right, wrong, or of chaos that ends; returns the periods that they took."""
    took, label_of_motion = [], {}  # the truth of a motion is that of the run it was found by
    for (answer, index, n), label in zip(answers, labels, strict=True):
        if index is None:
            total["unsettled"] += 1
            continue
        took.append(n)
        true_label = label_of_motion.setdefault(index, label)
        chaos_ends = periods is not None and periods[label] is not None and known[index].period is None
        if chaos_ends:
            total["outlasted"] += 1
        elif true_label != label:
            total[f"wrong: {answer}"] += 1
    return took


def rows_of(systems, starts, cable):
    """A row of the table for each kind of system."""
    totals, confirmed, took = {}, {}, {}
    for kind, records, scale, labels, periods in cases(systems, starts, cable):
        total = totals.setdefault(kind, Counter())
        answers, known = answers_of(records, scale)
        took.setdefault(kind, []).extend(count(total, answers, known, labels, periods))
        total.update(systems=1, starts=len(labels), motions=len(set(labels)), found=len(known))
        if periods is not None:
            later = confirmed.setdefault(kind, Counter())
            count(later, *answers_of(records, scale, CONFIRM), labels, periods)
    heads = "systems", "motions", "found", "starts", "wrong: joined", "wrong: settled", "outlasted"
    for kind, total in totals.items():
        outlasted = str(confirmed[kind]["outlasted"]) if kind in confirmed else "not run"
        median, longest = np.percentile(took[kind], (50, 95))
        cells = [str(total[head]) for head in heads]
        yield [kind, *cells, outlasted, str(total["unsettled"]), f"{median:.0f}", f"{longest:.0f}"]


def main():
    parser = command_line(__doc__)
    parser.add_argument("--systems", type=int, default=25)
    parser.add_argument("--starts", type=int, default=24)
    parser.add_argument("--cable", action="store_true")
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    if options.write and not options.cable:
        parser.error("--write: the table of the page has the buoy too; give --cable")
    publish("motion_rates", list(rows_of(options.systems, options.starts, options.cable)), options.write)


if __name__ == "__main__":
    main()
