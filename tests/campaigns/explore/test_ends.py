"""Where a motion ends: what its orbit tells, beside what runs have found."""

from types import SimpleNamespace

import pytest

from campaigns.explore import ends, tracing
from campaigns.explore.motions import UP
from tables import Column

KEY = Column("steepness", "", "kA", "", 3)


def told(monkeypatch, inside, outside, **result):
    """The columns of an end between two values, when the task on its orbit has this result."""
    monkeypatch.setattr(tracing, "line_task", lambda *_: "task")
    monkeypatch.setattr(tracing, "work", lambda *_: ([({"reason": ""} | result, [])], 0))
    motion = SimpleNamespace(settled=SimpleNamespace(period=2), place=0, state=None)
    end = ends._End(motion, UP, inside, outside, None, None, {"status": "ok"})
    motions = SimpleNamespace(keys=[KEY], plan=SimpleNamespace(out=tracing.Path()))
    (columns,) = ends.by_orbits(motions, [0.09, 0.1], [end], None).values()
    return columns


@pytest.mark.parametrize(("value", "error"), [(0.0965, 4e-6), (0.0960, 5e-4), (0.0972, 2e-4)])
def test_the_error_of_an_end_reaches_to_where_runs_found_the_motion_last_or_lost_it_first(monkeypatch, value, error):
    columns = told(monkeypatch, 0.0965, 0.0970, value=value, error=4e-6, kind="fold")
    assert (columns["steepness_end"], columns["kind"]) == (value, "fold")
    assert columns["error"] == pytest.approx(error, rel=1e-6)


def test_an_end_that_no_orbit_tells_says_why(monkeypatch):
    assert told(monkeypatch, 0.0965, 0.0970, reason="a loop is released") == {"no_orbit": "a loop is released"}
    far = told(monkeypatch, 0.0965, 0.0970, value=0.08, error=1e-6, kind="flip")
    assert far == {"no_orbit": "its orbit has the next flip at 0.08"}
