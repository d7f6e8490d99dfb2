"""Without water the energy of a swinging line comes and goes by an error of second order in h, and does not drift.

The pendulum of `tests/engine/test_energy.py`, 2 m long with bending, started as a rigid body at 2 rad/s. Neither
M dY/dt in the local frame nor the nodal products conserve anything exactly; in time the box rule neither damps nor
feeds.
"""

import numpy as np
import pytest

from engine.paper_box.frame import to_fixed, to_local
from engine.paper_box.line import line_of
from engine.paper_box.newton import solve
from engine.paper_box.nodal import level_of, positions
from engine.paper_box.start import at_rest
from engine.time.status import OK
from tests.engine.lines import DRY, energy, free, line, linear

STEP_S, SWING_S = 0.005, 2.5


def planar(Y):
    """Planar unknowns (n, 6) of a state (13, n) in the plane of axes 1 and 2."""
    a = np.unwrap(2 * np.arctan2(Y[9], Y[6]))
    W, U, _ = to_fixed(Y[6:10], Y[3:6])
    return np.column_stack([Y[0], -Y[1], U, W, np.pi / 2 - a, -Y[12]])


def balance(nodes, swings):
    """Change of the energy since the start over the kinetic energy then, after every step."""
    scene = line(
        DRY, free(), {"solver.scheme": "paper-box"}, length_m=2.0, area_m2=5e-4, density_kgpm3=1000.0, nodes=nodes,
        bending_stiffness_Nm2=0.5, tension=linear(1e4),
    )  # fmt: skip
    rope = line_of(scene)
    code, Y = at_rest(scene, rope)
    assert code == OK
    up, along, _ = positions(rope, Y)
    Y[3:6] = to_local(Y[6:10], 2.0 * np.array([along, -up, 0 * up]))
    level, energies = level_of(rope, 0.0, Y), []
    for _ in range(round(swings * SWING_S / STEP_S)):
        energies.append(energy(scene, planar(level.Y), rope.h))
        code, _, level = solve(rope, level.t + STEP_S, level, 12)
        assert code == OK
    energies = np.array(energies)
    assert np.ptp(energies[:, 0]) > 0.99 * energies[0, 0]  # it comes to rest and swings back
    total = energies.sum(1)
    return (total - total[0]) / energies[0, 0]


@pytest.mark.slow
def test_the_error_is_of_second_order_and_does_not_drift():
    """The last of six swings is no further off than the first two."""
    change, fine, swing = balance(11, 6), balance(21, 1), round(SWING_S / STEP_S)
    worst = np.abs(change[:swing]).max()
    assert worst < 0.025
    assert abs(np.log2(worst / np.abs(fine).max()) - 2) < 0.2
    assert np.abs(change[-swing:]).max() < 1.2 * np.abs(change[: 2 * swing]).max()
    assert abs(np.mean(change[-swing:])) < 2 * abs(np.mean(change[:swing]))
