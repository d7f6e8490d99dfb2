"""One Newton update solves J D = -residual, with both from eq. (28) as it is printed.

The residual below is the box rule of the equations in vectors (`equations`) and the conditions at the ends; J is its
complex step. The water is frozen, as it is in the scheme's own Jacobian.
"""

import numpy as np
import pytest

from engine.paper_box.line import PLANE, SPACE, line_of
from engine.paper_box.newton import newton_update
from engine.paper_box.nodal import Level, P
from tests.engine.box_equations import LAWS
from tests.engine.lines import free, held
from tests.engine.paper_box.equations import scene_of, space_derivatives, states, upper_end

DT, STEP = 0.01, 1e-30
ACROSS = [i for i in SPACE if i not in PLANE]
ENDS = {  # in space, in a plane
    "buoy": ({}, {}),
    "held": (held(3.0, 1.0, 18.0), held(3.0, 18.0)),
    "free": ({"end": {"kind": "free", "force_N": [300.0, -200.0, 900.0]}, "buoy": None}, free(300.0, 900.0)),
}


def printed_28(scene, h, Y, water, Y_old, water_old):
    """All residuals (13 n,): lower end, boxes of (28) over 2 dt, upper end. Y (13, n)."""
    rate = (Y - Y_old) / DT
    g = -0.5 * (space_derivatives(scene, Y, rate, water) + space_derivatives(scene, Y_old, rate, water_old))
    boxes = np.diff(Y) + np.diff(Y_old) + h * (g[:, 1:] + g[:, :-1])
    b, a = Y[6:10, 0], Y_old[6:10, 0]
    below = [*Y[3:6, 0], b @ b - 1, -a[1] * b[0] + a[0] * b[1] + a[3] * b[2] - a[2] * b[3], *Y[11:13, 0]]
    above = upper_end(scene, DT, Y[:, -1:], Y_old[:, -1:], water[:, -1:], water_old[:, -1:])
    return np.concatenate([below, boxes.T.ravel(), above, Y[10:13, -1]])


def rows_of_plane(n):
    """Equations that a motion in the plane leaves: of 7 below, of each box, of 6 above."""
    boxes = (7 + 13 * k + i for k in range(n - 1) for i in PLANE)
    return [0, 1, 3, 6, *boxes, *(7 + 13 * (n - 1) + i for i in (0, 1, 5))]


@pytest.mark.parametrize("dimensions", [3, 2])
@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("law", LAWS)
def test_update_solves_the_printed_equations(law, end, dimensions):
    scene = scene_of(law, dimensions, **{"tether.grid_stretching": 1.0, **ENDS[end][3 - dimensions]})
    line = line_of(scene)
    n = scene.tether.nodes
    (Y, water), (Y_old, water_old) = states(1, n), states(2, n)
    Y_old = Y + 0.05 * (Y_old - Y)
    active, keep = (SPACE, range(13 * n)) if dimensions == 3 else (PLANE, rows_of_plane(n))
    if dimensions == 2:
        Y[ACROSS] = Y_old[ACROSS] = 0.0
        water[[2, 5]] = water_old[[2, 5]] = 0.0

    def residual(Y):
        return printed_28(scene, line.h, Y, water, Y_old, water_old)[list(keep)]

    columns = []
    for k in range(n):
        for i in active:
            moved = Y.astype(complex)
            moved[i, k] += 1j * STEP
            columns.append(residual(moved).imag / STEP)
    J, r = np.array(columns).T, residual(Y).real
    code, found, _ = newton_update(line, Y, water, 1.0 + DT, Level(1.0, Y_old, water_old, P(line, Y_old, water_old)))
    assert code == 0
    update, exact = found[0].T[:, active].ravel(), np.linalg.solve(J, -r)
    size = np.abs(exact.reshape(n, -1)).max(0)
    assert np.all(np.abs((update - exact).reshape(n, -1)) <= 1e-6 * size)
    assert np.all(np.abs(J @ update + r) <= 1e-6 * (np.abs(J) @ np.abs(exact) + np.abs(r)))
