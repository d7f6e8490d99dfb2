"""Chaos beside periodic motions that began as chaos has to outlast their transients."""

from functools import partial
from types import SimpleNamespace

from campaigns.explore.transients import TIMES, outlasting
from campaigns.machinery.long_runs import until_judged
from campaigns.machinery.plan import Job
from engine import load_scene

SCENE = load_scene("tethered_buoy", steepness=0.13)
RUN = SimpleNamespace(tangent=None)
CHAOTIC = {"status": "ok", "regime": "chaotic", "regime_tighter": "chaotic", "periods": 465.0, "transient_periods": 155}


def asked(*rows):
    going = partial(until_judged, budget=1500, looks=True)
    jobs = [Job({}, SCENE, 1500, going=going, made=str(at), engine="") for at in range(len(rows))]
    by_key = {job.key: row for job, row in zip(jobs, rows, strict=True) if row}
    longer = outlasting(jobs, by_key, lambda at: (at - 1, at + 1))
    return {int(job.made): job for job in longer}


def settled(transient):
    return {"status": "ok", "regime": "period-6", "periods": 735.0, "transient_periods": transient}


def test_chaos_goes_on_where_a_neighbour_settled_late_and_only_there():
    jobs = asked(CHAOTIC, CHAOTIC, settled(200), None, CHAOTIC, settled(30), {"status": "newton-failed"})
    assert list(jobs) == [1]
    for periods, ends in ((465.0, False), (735.0, False), (TIMES * 200.0, True), (1440.0, True)):
        further = jobs[1].going(SCENE, RUN, CHAOTIC | {"periods": periods}, {})
        assert (further is None) == ends, periods
        assert ends or (further.scene.output.tangent_vectors, further.check) == (1, False)


def test_what_is_no_chaos_any_more_ends():
    (job,) = asked(CHAOTIC, settled(900)).values()
    assert job.going(SCENE, RUN, settled(900), {}) is None
