"""A released loop leaves less compression than the rest of the motion has; its motion is that of space, where it opens.

kA = 0.109 to 0.136, H = 21.0 m, from rest: chaos, with a release in every fourth to sixth wave period.
"""

import numpy as np
import pytest

from engine.planar import columns as col
from engine.planar.state import largest_turn
from tests.engine.kernels import Steps, new_state, parameters_of
from tests.engine.lines import in_space, kick, line, ran

PER_PERIOD = 100  # samples


def least_of(columns):
    """Least top tension of every wave period, N, and whether a loop was released in it."""
    low, releases = columns["tension_top_low_N"][1:], np.diff(columns["loop_releases"])
    return low.reshape(-1, PER_PERIOD).min(axis=1), releases.reshape(-1, PER_PERIOD).any(axis=1)


@pytest.mark.parametrize("nodes", [21, 41])
def test_a_release_compresses_the_line_less_than_the_rest_of_the_run(nodes):
    least, released = least_of(ran(line({"waves.steepness": 0.118}, nodes=nodes), 60).columns)
    assert released.sum() >= 5
    assert least[released].min() > least[~released].min()


@pytest.mark.slow
@pytest.mark.parametrize("steepness", [0.109, 0.136])
def test_the_least_tension_of_41_nodes_is_that_of_81_and_of_space(steepness):
    waves = {"waves.steepness": steepness}
    push = kick(v=1e-5)
    plane, fine, space = (
        least_of(ran(scene, 200).columns)[0].min()
        for scene in (line(waves), line(waves, nodes=81), in_space(waves, push))
    )
    assert abs(plane - fine) < 150.0 and abs(plane - space) < 150.0


def test_a_release_turns_phi_alone_and_one_element_at_a_time():
    steps, state = Steps(line(nodes=11), 1.0), new_state()
    before = steps.inner.motion.Y.copy()
    before[4:, col.PHI] += 3.3
    before[8:, col.PHI] -= 3.5
    Y = before.copy()
    assert [steps.guard(state, Y)[1] for _ in range(2)] == [True, False]
    assert state["turned"] == 8 and state["releases"] == 1
    before[8:, col.PHI] += 2 * np.pi
    assert np.array_equal(Y, before)


def test_the_turn_of_every_element_is_watched():
    p = parameters_of(line(nodes=6))[0]
    for element in range(1, 6):
        Y = np.zeros((6, 6))
        Y[element:, col.PHI] = -2.0
        assert largest_turn(p, Y) == (2.0, element)
