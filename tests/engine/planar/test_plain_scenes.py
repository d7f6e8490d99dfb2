"""A plain scene has kernels of its own; those of all planar scenes give the same run, to the last bit."""

import numpy as np
import pytest

from engine import load_scene, parameters, simulate
from engine.record import PLAIN, RECORD


@pytest.mark.parametrize(
    "changes", [{}, {"tether.tension": {"law": "tanh", "p": [2e5, 8.0, 0.0, 0.0, 1e4]}}], ids=["linear", "tanh"]
)
def test_a_plain_scene_runs_the_same_by_the_kernels_of_all_scenes(changes, monkeypatch):
    carried = {"output.tangent_vectors": 1, "output.lateral_growth": True}
    current = {"current": {"law": "uniform", "velocity_mps": [0.3, 0.0, 0.0]}}
    scene = load_scene("tethered_buoy", {"tether.nodes": 9} | carried | current | changes)
    runs, kinds = [], []
    for answer in (True, False):
        monkeypatch.setattr(parameters, "is_plain", lambda scene, answer=answer: answer)
        kinds.append(parameters.record_of(scene, []).dtype)
        runs.append(simulate(scene, periods=2))
    assert kinds == [PLAIN, RECORD]
    plain, general = runs
    assert plain.statistics["newton_iterations"] == general.statistics["newton_iterations"]
    for name, values in plain.columns.items():
        np.testing.assert_array_equal(values, general.columns[name])
    np.testing.assert_array_equal(plain.tangent.growth_nats, general.tangent.growth_nats)
    np.testing.assert_array_equal(plain.tangent.lateral_nats, general.tangent.lateral_nats)
