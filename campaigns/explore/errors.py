"""How far largest tension and slack fraction of a row hold, from one companion of each row: the columns of ERRORS.

    E = (T_max - T_b) + 2 |T_b' - T_b| + T_ringing, at least LEAST of T_max

T_b, of the row after its transient: the mean of the largest tensions of every BLOCK wave periods; of a motion that
repeats after N, the largest of its last periods, LAST at least and a multiple of N. T_b': the same of the companion,
which goes on from the row's last state with twice the elements at a quarter of the tolerance. Where the row is judged
by the orbit that its run comes nearer to, T_b and the last state are those of the orbit.

2: where the orders hold (2 in the elements, 1 in the tolerance), the companion has a quarter of the error, and 4/3
would do; where a snap halves them, it has half of it. T_max - T_b: what is left of the transient in the row, and chance
where the motion does not repeat, because another record as long has another largest tension. T_ringing:
`unresolved_ringing_N`. LEAST: from 81 to 161 nodes, at a sixth of the tolerance, the largest tension of four periodic
motions changed by up to 2.7e-4 of itself, of which |T_b' - T_b| showed a sixth.

    E_slack = 4/3 |chi' - chi| + 3 s, at least half a sample of the wave period

chi, of the row after its transient, and chi', of the companion: mean slack fractions of stretches of BLOCK wave
periods, of a motion that repeats as long as for T_b; s: standard error of chi, from its stretches. 4/3: of stiff lines
the companion had less than a quarter of the error, where chance does not decide. 3: the stretches are few.

The companion of a chaotic row, and of a periodic one whose line goes slack, carries a perturbation: a slack line may be
chaotic on few elements and not on many, or the other way round, while the buoy repeats.

All are of the motion of the row. `message` says where its companion leaves that motion, if it has settled, where E is
above COARSE of T_max, where E_slack is above SLACK_COARSE and chi' further from chi than the stretches scatter, and
where the growth of the perturbation contradicts the regime (`analysis.growth_contradicts`).
Rows of runs in three dimensions stay empty.
"""

import math
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from analysis import block_maxima, growth_contradicts, remains, tangent_lyapunov
from analysis.approaches import NEARER
from analysis.snaps import NEAR_ZERO
from analysis.tangent_growth import turned
from campaigns.answers import in_newtons
from campaigns.explore.batches import batch
from campaigns.explore.multipliers import orbit_ahead
from campaigns.explore.rows import ERROR, SLACK, SLACK_ERROR, TANGENT, exponents
from campaigns.explore.starts import OUTCOME, reached, section_of
from campaigns.judge import UNFOLLOWED, job_from, periods_of, samples_of
from campaigns.machinery import TANGENTS, Job, Plan, Summary, orbits_in, run_of
from engine import simulate
from engine.run.rest import static_tension_N
from engine.scene.finer import finer
from engine.views import FOLLOWED, carried
from tables import (
    CHAOTIC,
    COARSE,
    JOINED,
    MESSAGE,
    OTHER_GROWTH,
    OTHER_MOTION,
    PEAK,
    PERIODIC,
    PERIODS_RUN,
    RINGING,
    RUN_KEY,
    STATUS,
    TANGENT_EXPONENT,
    TRANSIENT,
    UNSETTLED,
    WALL_S,
    Column,
    Row,
    counted,
    finite,
    number_of,
    of_words,
    read_table,
    write_table,
)

FOLDER = "errors"
BLOCK, LAST = 15, 5  # wave periods: two blocks in a companion, because shorter ones miss the beats of a torus
FOR = of_words("of_run", "content key of the run of table.csv whose companion this is", "of")
USUAL = Column(
    "tension_usual_max_N", "N", "T_b", f"mean of the largest tensions of every {BLOCK} wave periods at the end", 0
)
COLUMNS = (FOR, OUTCOME, STATUS, PERIODS_RUN, USUAL, SLACK, *TANGENT, WALL_S, RUN_KEY, MESSAGE)
REPEATING, OTHERS = 12, 40  # wave periods of a companion: at least, of a motion that repeats; of the others
# wave periods of a companion with a perturbation: where one has decided the regime of the row, and where an orbit did
GROWTH, GROWTH_AT_ORBIT = FOLLOWED, 45
LEFT_OUT = 0.25  # of these: until it has forgotten that its grid was changed
TIGHTER = 4  # times, as the square of an element
LEAST = 5e-4  # of the largest tension
SLACK_COARSE = 0.05  # an error of the slack fraction above it is told in words
CHANGED = "with twice the elements at a quarter of the tolerance"


def errors(plan: Plan, summary: Summary) -> float:
    """Do the companion of every row, and fill ERROR of the rows and of table.csv; returns seconds of analysis.

    Rows without a transient, as of runs that ended early, stay empty. Raises as `runner.run`.
    """
    compared = []
    if plan.simulate is simulate:
        compared = list(filter(None, map(partial(_companion, plan), summary.rows)))
    jobs = [companion.job for companion in compared]
    analysis_s = batch(plan, FOLDER, "errors of the largest tensions", COLUMNS, companion_row, jobs)
    if not jobs:
        return analysis_s
    ended = {row["of_run"]: row for row in read_table(plan.out / FOLDER / "table.csv")}
    for companion in compared:
        row, result = companion.row, ended.get(companion.row["run_key"])
        if result is not None:
            error, words = error_N(row, companion.usual_N, result)
            row[ERROR.name] = finite(error)
            error, words_of_slack = slack_error(companion.slack, result, companion.resolved)
            row[SLACK_ERROR.name] = finite(error)
            words += [*words_of_slack, *words_of_growth(row, result)]
            row["message"] = "; ".join(filter(None, (row.get("message"), *words))) or None
    write_table(plan.out / "table.csv", plan.columns, summary.rows)
    return analysis_s


class _Companion(NamedTuple):
    """The job of a companion, with its row, and T_b (N) and the slack fractions of the stretches of that row.

    resolved: half a sample, in wave periods.
    """

    job: Job
    row: dict
    usual_N: float
    slack: np.ndarray
    resolved: float


def _companion(plan: Plan, row: dict) -> _Companion | None:
    """The companion of a row; None where there can be none."""
    transient, run = row.get("transient_periods"), run_of(plan.out, row)
    if transient is None or run is None or run.scene.motion.dimensions == 3:
        return None
    orbits = orbits_in(plan.out)
    period, periods_of_growth = _period(row), _periods_of_growth(row)
    changes = UNFOLLOWED | {"waves.ramp_s": 0.0}  # the waves of the last state have grown
    if periods_of_growth:
        changes[TANGENTS] = 1
    scene = finer(run.scene, elements=2, steps=TIGHTER, changes=changes)
    if period and f"{NEARER}: " in (row.get("evidence") or ""):
        run, transient = orbit_ahead(run, orbits)[0].run, 0  # a run on the orbit, from its first moment on
    if run.final_state is None:
        return None
    length, motion = OTHERS, None
    if period:
        length = max(REPEATING, 3 * period)
    length = max(length, periods_of_growth)
    if row.get("regime") not in (None, "", TRANSIENT):
        motion = reached(run, orbits)
    length = min(length, round(row["periods"]))
    job = job_from({"of_run": row["run_key"]}, scene, length, run.final_state.at_zero())
    job = replace(job, describe=partial(companion_row, period=period, motion=motion))
    resolved = 0.5 * run.scene.sample_step_s() / run.scene.waves.period_s
    shares = slack_shares(run, transient, period)
    return _Companion(job, row, usual_max_N(run, transient, period), shares, resolved)


def _periods_of_growth(row: dict) -> int:
    """Over how many wave periods a companion carries a perturbation; 0: none."""
    word = row.get("regime") or ""
    if word != CHAOTIC and not word.startswith(PERIODIC):
        return 0
    if math.isfinite(number_of(row, TANGENT_EXPONENT)):
        return GROWTH
    if number_of(row, SLACK.name) > 0.0:
        return GROWTH_AT_ORBIT
    return 0


def companion_row(trajectory, period: int | None = None, motion=None) -> Row:
    """The columns of COLUMNS that a companion fills. period, motion (`analysis.Settled`): of its row, where known."""
    scene, row = trajectory.scene, counted(trajectory, (WALL_S,))
    row["periods"] = periods_of(scene, trajectory.columns)
    if trajectory.status == "ok":
        row[USUAL.name] = usual_max_N(trajectory, LEFT_OUT * row["periods"], period)
        shares = slack_shares(trajectory, LEFT_OUT * row["periods"], period)
        if len(shares):
            row[SLACK.name] = float(shares.mean())
        if carried(trajectory):
            growth = turned(trajectory.tangent.growth_nats[:, 0], round(LEFT_OUT * row["periods"]))
            row |= exponents(TANGENT, *tangent_lyapunov(growth))
        if motion is not None:
            strobed, measures, _ = section_of(trajectory)
            row[OUTCOME.name] = JOINED
            if not remains(strobed, measures, motion):
                row[OUTCOME.name] = UNSETTLED
    return row


def usual_max_N(trajectory, transient_periods: float, period: int | None) -> float:
    """T_b of the head of this file; nan of a record that has no whole block after its transient."""
    scene, columns = trajectory.scene, trajectory.columns
    if period:
        return float(columns["tension_top_high_N"][-samples_of(scene, _whole(period)) :].max())
    first = samples_of(scene, transient_periods) + 1
    largest = block_maxima(columns["tension_top_high_N"][first:], samples_of(scene, BLOCK))
    if not len(largest):
        return math.nan
    return float(largest.mean())


def slack_shares(trajectory, transient_periods: float, period: int | None) -> np.ndarray:
    """Slack fraction of each whole stretch at the end of a record; the head of this file says how long they are."""
    scene, tension_N = trajectory.scene, trajectory.columns["tension_top_N"]
    threshold_N = max(NEAR_ZERO * static_tension_N(scene, trajectory.columns), 0.0)
    in_period = scene.waves.period_s / scene.sample_step_s()
    stretch = BLOCK
    if period:
        stretch = _whole(period)
    samples = round(stretch * in_period)
    count = round(len(tension_N) - 1 - transient_periods * in_period) // samples
    slack = tension_N[len(tension_N) - count * samples :] <= threshold_N
    return slack.reshape(count, samples).mean(axis=1)


def slack_error(shares: np.ndarray, companion: dict, resolved: float) -> tuple[float, list]:
    """E_slack of the head of this file, nan where it is not known, and what a reader has to be told of it."""
    if not len(shares):
        return math.nan, []
    difference, scatter = abs(number_of(companion, SLACK.name) - shares.mean()), 0.0
    if len(shares) > 1:
        scatter = shares.std(ddof=1)
    error = float(4.0 / 3.0 * difference + 3.0 * scatter / math.sqrt(len(shares)))
    error, words = max(error, resolved), []
    if error > SLACK_COARSE and difference > 2.0 * scatter:
        words.append(f"the slack fraction holds to {error:.2f} only")
    return error, words


def error_N(row: dict, usual_N: float, companion: dict) -> tuple[float, list]:
    """E of the head of this file, nan where it is not known, and what a reader has to be told of it.

    row: of the run, whose T_b is usual_N; companion: the row of its companion.
    """
    if companion["status"] != "ok":
        return math.nan, [f"error of the largest tension not known: {CHANGED} the run ended, {companion['status']}"]
    largest_N, again_N = number_of(row, PEAK), number_of(companion, USUAL.name)
    error = largest_N - usual_N + 2.0 * abs(again_N - usual_N) + (row.get(RINGING.name) or 0.0)
    error, words = max(error, LEAST * largest_N), []
    if companion[OUTCOME.name] == UNSETTLED:
        words.append(f"{CHANGED} it {OTHER_MOTION}: largest tensions {in_newtons(usual_N, again_N)}")
    if error > COARSE * largest_N:
        words.append(f"the largest tension holds to {100.0 * error / largest_N:.0f} % only")
    return error, words


def words_of_growth(row: dict, companion: dict) -> list[str]:
    """What a reader has to be told where the growth of a perturbation on the finer grid contradicts the regime."""
    value, error = _growth_of(companion)
    if not growth_contradicts(row.get("regime") or "", _growth_of(row), (value, error)):
        return []
    return [f"{CHANGED} {OTHER_GROWTH}: by {value:+.2f} ± {error:.2f} bits a wave"]


def _growth_of(row: dict) -> tuple[float, float]:
    """The exponent of a row, and its standard error."""
    value, error = TANGENT
    return number_of(row, value.name), number_of(row, error.name)


def _period(row: dict) -> int | None:
    """Wave periods after which a row's motion repeats, by its verdict, or where it has none by its strobed state."""
    word = row.get("regime")
    if not word:
        return row.get("strobed_period")
    if word.startswith(PERIODIC):
        return int(word.removeprefix(PERIODIC))
    return None


def _whole(period: int) -> int:
    """The least multiple of a period that is LAST at least."""
    return period * math.ceil(LAST / period)
