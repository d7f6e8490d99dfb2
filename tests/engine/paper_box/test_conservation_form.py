"""Row by row the paper's form is the conservation form in another frame, where the accelerations are true ones.

At a planar state with random rates: N_s of the engine's nodal quantities (G), q_t = V_s and EI kappa_s = -(1+eps)^3 S,
turned into the local frame, are -(M dY/dt + P). With the component rates of the print, rows 2 and 3 are off by
(m_a V - R U_c) times the rate of turning.
"""

import numpy as np
import pytest

from engine import parameters
from engine.arrays import Stage, Work
from engine.paper_box.frame import rotation
from engine.paper_box.line import line_of
from engine.paper_box.nodal import P, times_M
from engine.planar import columns as col
from engine.planar.node import node_quantities, shape
from tests.engine.paper_box.states import LAWS, scene_of

N = 25


def planar_states():
    """Planar (n, 6), rates of eps, phi and V, water (n, 4)."""
    rng = np.random.default_rng(8)
    Y = np.column_stack([rng.uniform(-0.1, 0.3, N), rng.normal(0, 300, N), *rng.normal(0, 2, (2, N)),
                         rng.uniform(0.5, 2.5, N), rng.normal(0, 1, N)])  # fmt: skip
    return Y, rng.normal(0, 1, N), rng.normal(0, 2, N), rng.normal(0, 3, (N, 2)), rng.normal(0, 1.5, (N, 4))


def paper_states(Y, eps_t, phi_t, V_t, F):
    """The same in the paper's unknowns and their rates, (13, n) each, and its water; a = pi/2 - phi."""
    a, a_t = np.pi / 2 - Y[:, 4], -phi_t
    state, rate = np.zeros((13, N)), np.zeros((13, N))
    state[[0, 1, 12]] = Y[:, 0], -Y[:, 1], -Y[:, 5]
    state[6], state[9] = np.cos(a / 2), np.sin(a / 2)
    rate[0], rate[6], rate[9] = eps_t, -0.5 * a_t * state[9], 0.5 * a_t * state[6]
    cos, sin = np.cos(a), np.sin(a)
    state[3], state[4] = Y[:, 3] * cos + Y[:, 2] * sin, -Y[:, 3] * sin + Y[:, 2] * cos
    rate[3] = V_t[:, 1] * cos + V_t[:, 0] * sin + a_t * state[4]
    rate[4] = -V_t[:, 1] * sin + V_t[:, 0] * cos - a_t * state[3]
    zero = np.zeros(N)
    return state, rate, np.array([F[:, 1], F[:, 0], zero, F[:, 3], F[:, 2], zero])


@pytest.mark.parametrize("law", LAWS)
def test_rows_are_those_of_the_conservation_form(law):
    scene = scene_of(law, dimensions=2, **{"tether.nodes": N})
    tables = []
    record = parameters.record_of(scene, tables)[0]
    tables = np.concatenate(tables)
    Y, eps_t, phi_t, V_t, F = planar_states()
    t, n = (np.column_stack(pair) for pair in ((np.cos(Y[:, 4]), np.sin(Y[:, 4])), (-np.sin(Y[:, 4]), np.cos(Y[:, 4]))))
    q_t = eps_t[:, None] * t + ((1 + Y[:, 0]) * phi_t)[:, None] * n
    work = Work(*(np.zeros((N, width)) for width in (2, 4, col.NODE_WIDTH, 0, 0, 4)))
    Q, X = work.Q, work.X
    shape(record, tables, Y, Q, X)
    work.C_tilde[:] = np.column_stack([Q[:, 5:7] - q_t, Y[:, 2:4] - V_t])
    work.F[:] = F
    node_quantities(record, tables, Stage(0.0, 1.0, 1.0, 1.0), Y, work)

    state, rate, water = paper_states(Y, eps_t, phi_t, V_t, F)
    assert np.allclose(rotation(state[6:10])[0][[1, 0]].T, t)
    line = line_of(scene, accelerations=True)
    Y_s = -(times_M(line, state, rate, water) + P(line, state, water))
    O3, T, slope = state[12], Q[:, 3] * t[:, 0] + Q[:, 4] * t[:, 1], Q[:, 2]
    side = -n  # the paper's n in a plane
    force = np.column_stack([slope * Y_s[0] - O3 * state[1], Y_s[1] + O3 * T])
    assert np.allclose(force[:, :1] * t + force[:, 1:] * side, Q[:, 9:11], rtol=1e-11, atol=1e-9)
    moved = np.column_stack([Y_s[3] - O3 * state[4], Y_s[4] + O3 * state[3]])
    assert np.allclose(moved[:, :1] * t + moved[:, 1:] * side, q_t, rtol=1e-11, atol=1e-11)
    assert np.allclose(-line.EI * Y_s[12], -Q[:, 18], rtol=1e-11)
    # beta_s turns t by Omega_3
    assert np.allclose(2 * (state[6] * Y_s[9] - state[9] * Y_s[6]), O3)
    assert not np.any(Y_s[[2, 5, 7, 8, 10, 11]])

    printed = line_of(scene)
    off = -(times_M(printed, state, rate, water) + P(printed, state, water)) - Y_s
    u, u_c = state[3], rotation(state[6:10])[0][0] * water[0] + rotation(state[6:10])[0][1] * water[1]
    expected = (printed.R * u_c - printed.m_a * u) * -phi_t
    assert np.allclose(off[1], expected, rtol=1e-10, atol=1e-10)
    assert not np.any(np.abs(np.delete(off, 1, axis=0)) > 1e-9)
