"""A plain scene has kernels of its own; those of all planar scenes give the same run, to the last bit."""

import pytest

from engine import parameters, simulate
from engine.record import PLAIN, RECORD
from tests.engine.lines import assert_same, line, uniform


@pytest.mark.parametrize(
    "changes", [{}, {"tether.tension": {"law": "tanh", "p": [2e5, 8.0, 0.0, 0.0, 1e4]}}], ids=["linear", "tanh"]
)
def test_a_plain_scene_runs_the_same_by_the_kernels_of_all_scenes(changes, monkeypatch):
    carried = {"output.tangent_vectors": 1, "output.lateral_growth": True}
    current = uniform(0.3)
    scene = line(carried, current, changes, nodes=9)
    runs, kinds = [], []
    for answer in (True, False):
        monkeypatch.setattr(parameters, "is_plain", lambda scene, answer=answer: answer)
        kinds.append(parameters.record_of(scene, []).dtype)
        runs.append(simulate(scene, periods=2))
    assert kinds == [PLAIN, RECORD]
    assert_same(*runs)
