"""A sweep with every motion of a value searches as it is asked to, and says what it cannot have."""

import engine
from campaigns import buoy_sweep
from campaigns.explore import ends, stages
from campaigns.explore.motions import Motions, Search
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan
from tests.campaigns.conftest import order_of


def test_kicks_are_as_many_as_fast_and_of_the_seed_as_asked_for(tmp_path, monkeypatch):
    words = ["--steepness", "0.1", "0.12", "--starts", "3", "--kick-speed", "2.5", "--seed", "7"]
    order = order_of(buoy_sweep, *words, "--out", tmp_path / "new")
    searches = []
    monkeypatch.setattr(stages, "explore", lambda motions, jobs, search, *later: searches.append(search))
    monkeypatch.setattr(Motions, "write", lambda motions: None)
    monkeypatch.setattr(ends, "find_ends", lambda motions, scenes: None)
    plan = Plan(Running(tmp_path), engine.simulate, None, ())
    buoy_sweep.runs(order, plan, order.cases)
    assert searches == [Search(order, 3, 2.5, 7)]
