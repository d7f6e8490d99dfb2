"""One Newton update solves J D = -residual, with both from eq. (28) as it is printed.

The residual below is (28) in matrices: M (13 x 13) and P of `appendix`, node by node and box by box, and the conditions
at the ends; J is its complex step. The water is frozen, as it is in the scheme's own Jacobian.
"""

from types import SimpleNamespace

import numpy as np
import pytest

from engine.paper_box import box, ends
from engine.paper_box.line import line_of
from tests.engine.box_equations import buoy_of, tension
from tests.engine.lines import free, held
from tests.engine.paper_box.appendix import C_right
from tests.engine.paper_box.states import LAWS, M_and_P, scene_of, states

DT, STEP = 0.01, 1e-30
ENDS = {
    "buoy": ({}, {}),
    "held": (held(3.0, 1.0, 18.0), held(3.0, 18.0)),
    "free": ({"end": {"kind": "free", "force_N": [300.0, -200.0, 900.0]}, "buoy": None}, free(300.0, 900.0)),
}
UP = [1, 2, 0]  # of the paper's fixed axes, the first of which is up: x, y, z
PLANE = [0, 1, 3, 4, 6, 9, 12]


def C_of(beta):
    return np.array(C_right(SimpleNamespace(**{f"b{i}": beta[i] for i in range(4)})))


def buoy_force(scene, Y, water):
    """Mass of the buoy, V, and N less the other forces on it, at the last node; axis 1 up."""
    C = C_of(Y[6:10])
    N, V = (C.T @ np.array(local) for local in ([tension(scene.tether.tension, np.asarray(Y[0])), Y[1], Y[2]], Y[3:6]))
    mass, lift, drag, load = buoy_of(scene)
    outside = (lift + drag((V - water[:3])[UP]) + load(water[3:][UP]))[np.argsort(UP)]
    return mass, V, N - outside


def printed_28(scene, h, Y, water, Y_old, water_old):
    """All residuals (13 n,): lower end, boxes of (28), upper end. Y (13, n)."""
    n = Y.shape[1]
    new = [M_and_P(scene, Y[:, k], water[:, k]) for k in range(n)]
    old = [M_and_P(scene, Y_old[:, k].astype(complex), water_old[:, k]) for k in range(n)]
    b, a = Y[6:10, 0], Y_old[6:10, 0]
    rows = [Y[3:6, 0], [b @ b - 1, -a[1] * b[0] + a[0] * b[1] + a[3] * b[2] - a[2] * b[3]], Y[11:13, 0]]
    for k in range(1, n):
        box_row = 2 * DT * (Y[:, k] - Y[:, k - 1] + Y_old[:, k] - Y_old[:, k - 1])
        for j in (k - 1, k):
            box_row = box_row + h[k - 1] * (new[j][0] + old[j][0]) @ (Y[:, j] - Y_old[:, j])
            box_row = box_row + DT * h[k - 1] * (new[j][1] + old[j][1])
        rows.append(box_row)
    top = Y[:, -1]
    if scene.end.kind == "buoy":
        mass, V, now = buoy_force(scene, top, water[:, -1])
        _, V_old, before = buoy_force(scene, Y_old[:, -1], water_old[:, -1])
        rows.append(mass * (V - V_old) / DT + 0.5 * (now + before))
    elif scene.end.kind == "held":
        rows.append(C_of(top[6:10]).T @ top[3:6])
    else:
        N = C_of(top[6:10]).T @ np.array([tension(scene.tether.tension, np.asarray(top[0])), top[1], top[2]])
        rows.append(N - np.array(scene.end.force_N)[np.argsort(UP)])
    rows.append(top[10:13])
    return np.concatenate(rows)


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
    active = list(range(13))
    if dimensions == 2:
        active = PLANE
        for X in (Y, Y_old):
            X[[i for i in range(13) if i not in PLANE]] = 0.0
        for F in (water, water_old):
            F[[2, 5]] = 0.0
    old = box.Level(1.0, Y_old, water_old, box.P(line, Y_old, water_old))
    rows, blocks = box.residual(line, Y, water, 1.0 + DT, old)
    found, _ = box.Band(line).update(rows, blocks, ends.force_per(line, 1.0))

    def residual(Y):
        return printed_28(scene, line.h, Y, water, Y_old, water_old)

    keep = list(range(13 * n)) if dimensions == 3 else rows_of_plane(n)
    columns = [(i, k) for k in range(n) for i in active]
    J = np.empty((len(keep), len(columns)))
    for c, (i, k) in enumerate(columns):
        moved = Y.astype(complex)
        moved[i, k] += 1j * STEP
        J[:, c] = residual(moved)[keep].imag / STEP
    r = residual(Y.astype(complex))[keep].real
    update = found.T[:, active].ravel()
    exact = np.linalg.solve(J, -r)
    size = np.abs(exact.reshape(n, -1)).max(0)
    assert np.all(np.abs((update - exact).reshape(n, -1)) <= 1e-6 * size)
    left = J @ update + r
    assert np.all(np.abs(left) <= 1e-6 * (np.abs(J) @ np.abs(exact) + np.abs(r)))
