"""Law (Calugareanu, White, Fuller): what the clamps are turned against each other is twist and writhe,

    Phi/(2 pi) = O1 L/(2 pi) + Wr,   Wr = (1/4 pi) int int (t1 x t2).(x1 - x2)/|x1 - x2|^3 ds1 ds2

over the rod and two straight lines that carry its clamped ends on to infinity; and it changes by two whole turns where
the rod passes through itself, which the model lets it do: it knows no contact.

Tolerance: the writhe is that of the polygon through the nodes (Klenin & Langowski, Biopolymers 54, 2000, method 1a),
order h^2 from that of the curve, as is O1.
"""

import numpy as np
import pytest

from engine import load_scene
from tests.engine.lines import Motion, positions
from tests.engine.spatial.rod_equations import Localised
from tests.engine.spatial.rods import at_rest

FAR = 1e4


def writhe(x):
    """Of a polygon (n, 3): for each pair of segments the solid angle under which they are seen to cross."""

    def unit(p, q):
        c = np.cross(p, q)
        size = np.linalg.norm(c, axis=-1, keepdims=True)
        return c / np.where(size > 0, size, 1.0)

    total = 0.0
    for i in range(len(x) - 3):
        a, b, c, d = x[i], x[i + 1], x[i + 2 : -1], x[i + 3 :]
        n = [unit(c - a, d - a), unit(d - a, d - b), unit(d - b, c - b), unit(c - b, c - a)]
        angles = [np.arcsin(np.clip(np.sum(n[k] * n[(k + 1) % 4], axis=1), -1, 1)) for k in range(4)]
        total += np.sum(sum(angles) * np.sign(np.sum(np.cross(d - c, b - a) * (c - a), axis=1)))
    return total / (2 * np.pi)


def link(Y, h, below, above):
    """Twist and writhe of a state, turns."""
    x = positions(Y, h)
    line = np.vstack([x[0] - FAR * np.array(below), x, x[-1] + FAR * np.array(above)])
    return Y[0, 10] * h.sum() / (2 * np.pi), writhe(line)


@pytest.mark.parametrize("m", [0.9, 0.6, 0.3])
def test_twist_and_writhe_are_the_turn_of_the_clamps(m):
    """The localised buckle from a shallow helix (m = 0.9) to a closed loop (0.3), where the writhe is 0.8 turns."""
    buckle = Localised(0.4, 0.3, 2.0, m)
    rod = buckle.rod(16.0, 1e5)
    errors = []
    for nodes in (161, 321, 641):
        Y, h = at_rest(rod, nodes, lambda s: buckle.state(rod, s))
        turned, writhed = link(Y, h, (1, 0, 0), (1, 0, 0))
        errors.append(abs(turned + writhed - rod.twist / (2 * np.pi)))
    assert writhed == pytest.approx(4 * np.arccos(m) / (2 * np.pi), abs=0.02)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2, abs=0.2)
    assert errors[-1] < 1e-3


@pytest.mark.parametrize("slack, lost", [(1.1, 0), (1.2, 2)])
def test_link_is_kept_until_the_rope_passes_through_itself(slack, lost):
    """The shipped rope, twisted by 1.25 turns: a loop at 1.1 m of slack; at 1.2 m it has thrown itself over."""
    rows = [[0, 0, 0], [0, 0, 0], [0, 0, -slack], [0, 0, -slack]]
    scene = load_scene("twisted_rope", {"end.motion.displacement_m": rows, "output.step_s": 5.0})
    motion = Motion(scene, 100.0)
    above = np.array(scene.end.direction) / np.linalg.norm(scene.end.direction)
    history = []
    for t, Y in motion.states():
        given = 1.25 * (np.sin(np.pi * t / 20) ** 2 if t < 10 else 1.0)
        history.append(given - sum(link(Y, motion.h, (0, 0, 1), above)))
    assert np.abs(np.array(history) - np.round(history)).max() < 5e-3
    assert np.all(np.diff(np.round(history)) >= 0)
    assert round(history[-1]) == lost
