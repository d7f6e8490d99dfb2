"""Law: starts that a coarse line is asked for first end as on the line itself, wherever the border of basins lies."""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.explore import coarse
from campaigns.explore.motions import Motion, Motions, in_a_row
from campaigns.explore.starts import Start
from tables import Column
from tests.campaigns.explore.toy import Job, Scene, State, ToyMotions

KICKS = np.linspace(-0.3, 0.3, 80)  # the border of the two basins is at 0


@dataclass(frozen=True)
class CoarseScene(Scene):
    tether = SimpleNamespace(nodes=11)


class CoarseMotions(ToyMotions):
    run_starts = Motions.run_starts


@pytest.fixture
def ended(tmp_path, monkeypatch):
    """ended(p, beside): motion of each kick, and how many runs there were on the line itself; p: of its coarse form."""

    def run(p, beside):
        monkeypatch.setattr(coarse, "coarse", lambda scene: CoarseScene(p))
        motions, scene = CoarseMotions(tmp_path, [Column("p", "", "p", "", 1)], in_a_row(1)), Scene(0.0)
        motions.add([Job({"p": 0.0}, scene)])
        motions.at[0] = [Motion(0, scene.settled(x), State(x), "kick") for x in (-1.0, 1.0)]
        on_the_line = []
        run_starts = motions.starts.run

        def counted(title, requests, listed=True):
            on_the_line.extend(request for request in requests if request.scene == scene)
            return run_starts(title, requests, listed)

        monkeypatch.setattr(motions.starts, "run", counted)
        starts = [(0, Start("kick", (x, 0.0))) for x in KICKS]
        motions_of_kicks = motions.run_starts("kicks", starts, beside)
        return [motions.at[0].index(motion) for motion in motions_of_kicks], len(on_the_line)

    return run


def in_a_line(number):
    return [beside for beside in (number - 1, number + 1) if 0 <= beside < len(KICKS)]


def alone(number):
    return ()


@pytest.mark.parametrize(
    ("p", "beside", "least", "most"),
    [(0.05, in_a_line, 0, 31), (0.25, alone, 81, np.inf), (0.5, alone, 80, 80)],
    ids=["its border is a little elsewhere", "its starts end otherwise", "it lacks a motion"],
)
def test_a_coarse_line_that_differs_is_corrected_not_believed_or_not_asked(ended, p, beside, least, most):
    motions, count = ended(p, beside)
    assert motions == list((KICKS > 0.0).astype(int)) and least <= count <= most
