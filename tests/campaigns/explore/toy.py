"""A system with known motions in place of the cable: x' = p + q x - x^3.

It has two stable states for p^2 < 4 q^3/27, else one. Starts are integrated here; the stages, the letters and the
bisection are those of `campaigns.explore`.
"""

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np

import engine
from analysis.motions import Settled, joins
from campaigns.explore import stages
from campaigns.explore.motions import Motions, Search
from campaigns.explore.starts import Ending
from campaigns.machinery.cli import Running
from campaigns.machinery.plan import Plan


@dataclass
class State:
    x: float

    def at_zero(self):
        return self


@dataclass(frozen=True)
class Scene:
    p: float
    q: float = 1.0
    waves = SimpleNamespace(period_s=1.0)

    def sample_step_s(self):
        return 0.01

    def settled(self, x: float) -> Settled:
        for _ in range(4000):
            x += 0.05 * (self.p + self.q * x - x**3)
        return Settled(1, np.array([[x]]), np.array([[x, x, 2.0 + x]]), np.array([2.0]), "")


@dataclass
class Job:
    """The run from rest of a place: it begins at x = -1."""

    labels: dict
    scene: Scene

    @property
    def key(self) -> str:
        return f"{self.labels}"


@dataclass
class Starts:
    """As `campaigns.explore.starts.Starts`, of this system; count: how many were run."""

    endings: list = field(default_factory=list)
    count: int = 0

    def run(self, title, requests, listed=True):
        endings = []
        for request in requests:
            state = request.start.state
            settled = request.scene.settled(request.start.kick[0] if state is None else state.x)
            record = np.repeat(settled.points, 12, axis=0), np.repeat(settled.measures, 11, axis=0)
            number = joins(*record, request.known)
            if number is not None:
                endings.append(Ending({"status": "ok", "outcome": "joined"}, number))
            else:
                state = State(float(settled.points[0, 0]))
                endings.append(Ending({"status": "ok", "outcome": ""}, None, settled, state))
        self.count += len(requests)
        if listed:
            self.endings += endings
        return endings


class ToyMotions(Motions):
    """The motions of places of this system; their judged runs are as they were."""

    def __init__(self, out, keys, neighbours, match_distance=0.0):
        super().__init__(Plan(Running(out), engine.simulate, dict, ()), keys, neighbours, match_distance)
        self.starts = Starts()

    def run_starts(self, title, starts, beside=None):
        return super().run_starts(title, starts)  # there is no line that could be coarse

    def judged_runs(self, title, jobs, ahead=()):
        for job in jobs:
            self.rows[job.key] = {"run_key": job.key, "status": "ok", "scene": job.scene}

    def judged_run(self, key):
        settled = self.rows[key]["scene"].settled(-1.0)
        return SimpleNamespace(settled=settled, final_state=State(float(settled.points[0, 0])))


def explored(monkeypatch, motions: ToyMotions, jobs: list[Job], kicks: int) -> ToyMotions:
    """The motions of these places, found, named, and not judged again."""
    monkeypatch.setattr(stages, "has_proposals", lambda scene: False)
    monkeypatch.setattr(stages, "outlasting", lambda *arguments: [])
    monkeypatch.setattr(stages, "reached", lambda run, orbits: run.settled)
    monkeypatch.setattr(stages, "proposals", lambda plan, scenes, *arguments: [[] for _ in scenes])
    places = stages.run_from_rest(motions, jobs)
    for part in stages.parts_beside_rest(motions, places, Search(None, kicks, 2.0, 1)):
        part()
    stages.name(motions)
    return motions
