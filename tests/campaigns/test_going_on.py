"""What a run does next (`campaigns.machinery.long_runs`): on to its next look, to a tighter tolerance, or nothing.

Chaos beside periodic motions that began as chaos has to outlast their transients (`campaigns.explore.stages`).
"""

from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from analysis.looks import BLURRED
from campaigns.explore.stages import TIMES, let_chaos_last, outlasting
from campaigns.machinery import worker
from campaigns.machinery.cli import Running
from campaigns.machinery.folder import trajectory_path
from campaigns.machinery.long_runs import LEAST_CHECK, LongRun, Part, until_judged
from campaigns.machinery.plan import Job, Plan
from campaigns.machinery.runner import run_campaign
from engine import load_scene
from tables import PERIODS_RUN, RUN_KEY, STATUS
from tests.campaigns.fake_engine import sines

SCENE = load_scene("tethered_buoy", steepness=0.13)
CHAOTIC = {
    "status": "ok", "regime": "chaotic", "periods": 700.0, "transient_periods": 233,
    "lyapunov_tangent_bits_per_period": 0.1, "lyapunov_tangent_error": 0.02,
}  # fmt: skip
RUN = SimpleNamespace(tangent=None)


LASTING = {**CHAOTIC, "regime_tighter": "chaotic", "periods": 465.0, "transient_periods": 155}


def next_part(checks=None, budget=1500, looks=True, run=RUN, **row):
    return until_judged(SCENE, run, {**CHAOTIC, **row}, checks or {}, budget, looks)


def checked(periods, status="ok"):
    return SimpleNamespace(status=status, scene="tighter", tangent=SimpleNamespace(growth_nats=np.zeros((periods, 1))))


@pytest.mark.parametrize(("looks", "periods"), [(True, 60), (False, 300)])
def test_a_run_begins_with_its_first_look_or_its_whole_length(looks, periods):
    assert until_judged(SCENE, None, None, {}, 300, looks) == Part(SCENE, periods)


@pytest.mark.parametrize(
    "row", [{"regime": "period-2"}, {"status": "newton-failed"}, {"regime": None}, {"regime_tighter": "chaotic"},
            {"regime": "undecided", "periods": 1440.0},
            {"regime": "undecided", "regime_reason": f"no period: {BLURRED}"}],
)  # fmt: skip
def test_what_is_told_or_has_failed_or_used_its_budget_ends(row):
    assert next_part(**row) is None


def test_a_check_as_long_as_the_run_ends_though_its_periods_are_not_whole_to_the_last_digit():
    row = {
        "periods": 310.00000000000006,
        "transient_periods": 103,
        "regime": "undecided",
        "regime_tighter": "undecided",
    }
    following = next_part({310: checked(207)}, **row)
    assert (round(following.periods, 6), following.check) == (155, False)


@pytest.mark.parametrize(("most", "ends"), [(309, True), (310, False)])
def test_the_cell_of_a_map_is_not_looked_at_beyond_its_own_budget(most, ends):
    row = {**CHAOTIC, "regime": "undecided", "periods": 205.0}
    assert (until_judged(SCENE, RUN, row, {}, 1500, True, most=most) is None) == ends


@pytest.mark.parametrize(
    ("regime", "period", "carried"), [("undecided", None, 1), ("undecided", 2, 0), ("transient", None, 0)]
)
def test_the_undecided_go_on_with_perturbations_and_what_settles_or_repeats_without(regime, period, carried):
    following = next_part(regime=regime, strobed_period=period, periods=205.0)
    assert (following.periods, following.start, following.check) == (105, RUN, False)
    assert (following.scene.output.tangent_vectors, following.scene.solver.rtol) == (carried, SCENE.solver.rtol)
    assert next_part(regime=regime, periods=205.0, budget=280).periods == 75


def test_a_period_that_nothing_confirms_goes_on_with_perturbations_from_the_second_look_on():
    loose = {"regime": "undecided", "strobed_period": 8, "evidence": "period: 8/0.01/yes; close: 0.004/0.002/no"}
    no_orbit = loose | {"evidence": "period: 8/0.01/yes; close: 0.001/0.002/yes"}
    for row, periods, carried in ((loose, 90.0, 0), (loose, 135.0, 1), (no_orbit, 135.0, 1)):
        assert next_part(**row, periods=periods).scene.output.tangent_vectors == carried


@pytest.mark.parametrize(("error", "periods"), [(0.001, LEAST_CHECK), (0.02, 117), (0.04, 467)])
def test_chaos_goes_on_at_a_tenth_of_the_tolerance_as_long_as_it_takes_to_show(error, periods):
    following = next_part(lyapunov_tangent_error=error)
    assert (following.periods, following.start, following.check) == (periods, RUN, True)
    assert (
        following.scene.solver.rtol == pytest.approx(SCENE.solver.rtol / 10)
        and following.scene.output.tangent_vectors == 1
    )


def test_a_check_that_does_not_show_it_goes_on_itself_and_then_the_run():
    refused = {"regime": "undecided", "regime_tighter": "undecided"}
    following = next_part({700: checked(117)}, **refused)
    assert (following.scene, following.periods, following.check) == ("tighter", 59, True) and len(
        following.start.tangent.growth_nats
    ) == 117
    assert next_part({700: checked(420)}, **refused).periods == 47
    for ended in (checked(467), checked(50, "newton-failed")):
        following = next_part({700: ended}, **refused)
        assert (following.periods, following.start, following.check) == (35, RUN, False)


def test_the_parts_of_a_check_are_one_record():
    def check(periods):
        return SimpleNamespace(periods=periods, followed_by=lambda later: check(periods + later.periods))

    run = LongRun(None, row={"periods": 700.0}, part=Part(SCENE, 90, check=True))
    for periods in (90, 45, 70):
        run.take(check(periods))
    assert run.checks[700].periods == 205 and run.trajectory is None


def in_parts(scene, trajectory, row, checks, count):
    """So many parts of three wave periods."""
    periods = 0.0 if row is None else row["periods"]
    return Part(scene, 3, trajectory) if periods < 3 * count - 0.5 else None


@pytest.mark.parametrize("counts", [(1, 1), (1, 3), (2, 3), (3, 2)])
def test_a_run_on_disk_goes_on_by_what_is_asked_for_beyond_it(counts, tmp_path):
    (tmp_path / "trajectories").mkdir()
    starts = []

    def simulate(scene, periods, duration_s, start=None):
        starts.append(start)
        run = sines(scene, periods)
        run.columns["time_s"] += 0.0 if start is None else start.columns["time_s"][-1]
        return run

    def describe(run):
        return {"status": "ok", "periods": run.columns["time_s"][-1] / SCENE.waves.period_s}

    plan = Plan(Running(tmp_path, 1, "threading"), simulate, describe, (STATUS, PERIODS_RUN, RUN_KEY))
    finished = 0
    for count in counts:
        summary = run_campaign(plan, [Job({}, SCENE, 1500, going=partial(in_parts, count=count))])
        longest = max(count, finished)
        assert summary.rows[0]["periods"] == pytest.approx(3.0 * longest)
        assert [start is None for start in starts] == [finished + part == 0 for part in range(longest - finished)]
        assert summary.computed == (longest > finished)
        starts.clear()
        finished = longest


def longer_jobs(*rows):
    going = partial(until_judged, budget=1500, looks=True)
    jobs = [Job({}, SCENE, 1500, going=going, made=str(at), engine="") for at in range(len(rows))]
    by_key = {job.key: row for job, row in zip(jobs, rows, strict=True) if row}
    longer = outlasting(jobs, by_key, lambda at: (at - 1, at + 1))
    return {int(job.made): job for job in longer}


def settled(transient):
    return {"status": "ok", "regime": "period-6", "periods": 735.0, "transient_periods": transient}


def test_chaos_goes_on_where_a_neighbour_settled_late_and_only_there():
    jobs = longer_jobs(LASTING, LASTING, settled(200), None, LASTING, settled(30), {"status": "newton-failed"})
    assert list(jobs) == [1]
    for periods, ends in ((465.0, False), (735.0, False), (TIMES * 200.0, True), (1440.0, True)):
        further = jobs[1].going(SCENE, RUN, LASTING | {"periods": periods}, {})
        assert (further is None) == ends, periods
        assert ends or (further.scene.output.tangent_vectors, further.check) == (1, False)


def test_chaos_that_settles_late_asks_the_chaos_beside_it_to_last_longer():
    rows, rounds = [LASTING | {"periods": 205.0}, LASTING | {"periods": 205.0}, settled(90)], []
    jobs = [Job({}, SCENE, 1500, made=str(at), engine="") for at in range(len(rows))]

    class Places:
        def __init__(self):
            self.jobs, self.rows = jobs, {job.key: row for job, row in zip(jobs, rows, strict=True)}

        def neighbours(self, place):
            return place - 1, place + 1

        def judged_runs(self, title, late):
            """The run in the middle settles after 310 wave periods; the first one would be chaotic for ever."""
            rounds.append([int(job.made) for job in late])
            for job in late:
                self.rows[job.key] = settled(310) if job.made == "1" else LASTING | {"periods": 1000.0}

    places = Places()
    let_chaos_last(places)
    assert rounds == [[1], [0], [0]]
    assert places.rows[jobs[0].key]["periods"] == 1000.0 < TIMES * 310


def test_what_is_no_chaos_any_more_ends():
    (job,) = longer_jobs(LASTING, settled(900)).values()
    assert job.going(SCENE, RUN, settled(900), {}) is None


def two_parts_and_two_checks(scene, trajectory, row, checks):
    """What a run does that lasts two parts of two periods, and is checked for twice as long."""
    if row is None or row["periods"] < 4:
        return Part(scene, 2, trajectory)
    check = checks.get(4)
    if check is None:
        return Part(scene, 2, trajectory, check=True)
    if check.columns["time_s"][-1] < 8 * scene.waves.period_s - 1e-6:
        return Part(scene, 2, check, check=True)
    return None


def test_a_run_is_saved_between_its_parts_but_not_while_it_is_checked(tmp_path, monkeypatch):
    """Because checks are not kept: a run that is killed in one begins it again."""
    (tmp_path / "trajectories").mkdir()
    monkeypatch.setattr(worker, "SAVED_S", -1.0)
    job = Job({}, load_scene("tethered_buoy"), 4, going=two_parts_and_two_checks)
    path, saved = trajectory_path(tmp_path, job.key), []

    def simulate(scene, periods=None, duration_s=None, start=None):
        saved.append(path.read_bytes() if path.exists() else b"")
        run = sines(scene, periods)
        if start is not None:
            run.columns["time_s"] += start.columns["time_s"][-1]
        return run

    def row(run):
        return {"status": "ok", "periods": run.columns["time_s"][-1] / run.scene.waves.period_s}

    worker.run_jobs(Plan(Running(tmp_path), simulate, row, ()), [job])
    nothing, first, *in_checks = saved
    assert nothing == b"" and first and in_checks == [first] * 2
    assert path.read_bytes() != first
