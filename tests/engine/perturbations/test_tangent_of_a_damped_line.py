"""Law: about a state of rest the growths are those of the linearised box equations under the integrator.

Tether and buoy lean in a steady current. The box equations, written out in `box_equations`, are linearised there by
complex step: B dY' = -J dY, whose finite eigenvalues lambda are the small motions of the discrete line. One step of a
Runge-Kutta method multiplies each by its stability function R(lambda dt), so the growths are ln|R(lambda dt)| per dt.
What the box equations leave undetermined is gone after one step of these L-stable methods.

Growths of single vectors of an oscillating pair swing with its angle; sums of the fastest j do not, where there is a
gap behind the j-th. They then differ from the law by exp(-gap t) over the time of the average: below 1e-6 here.
"""

import numpy as np
import pytest
import scipy.linalg

from engine import simulate
from engine.time.integrators import METHODS
from tests.engine.box_equations import jacobian
from tests.engine.lines import equilibrium, line

NODES, SPEED = 5, (0.8, 0.1)
SCENE = {
    "waves": None,
    "current": {"law": "uniform", "velocity_mps": [SPEED[0], 0.0, SPEED[1]]},
    "tether.tension": {"law": "linear", "stiffness_N": 2e3},
    "buoy.drag": 4.0,
    "output.tangent_vectors": 4 * NODES,
}
SETTLED, UNTIL = 100, 200  # s
GAP = 0.1  # 1/s, between real parts


def leaning(**solver):
    return line(SCENE, {f"solver.{key}": value for key, value in solver.items()}, nodes=NODES, bending_stiffness_Nm2=24)


@pytest.fixture(scope="module")
def eigenvalues():
    """Finite lambda (1/s) of the linearised box equations, largest real part first."""
    scene = leaning()
    Y = equilibrium(scene).Y
    F = np.zeros((NODES, 4))
    F[:, :2] = SPEED
    C = np.stack([(1 + Y[:, 0]) * np.cos(Y[:, 4]), (1 + Y[:, 0]) * np.sin(Y[:, 4]), Y[:, 2], Y[:, 3]], 1)
    # a stage with C~ = C and the rate c has the matrix J + c B
    at_one, at_two = (jacobian(scene, (c, c, 1.0), Y, C, F) for c in (1.0, 2.0))
    J, B = 2 * at_one - at_two, at_two - at_one
    above, below = scipy.linalg.eigvals(-J, B, homogeneous_eigvals=True)
    finite = np.abs(below) > 1e-9 * np.abs(above)
    found = above[finite] / below[finite]
    assert np.all(found.real < 0), "the line was meant to be stable"
    return found[np.argsort(-found.real)]


def stability(method, z):
    """R(z) of a stiffly accurate Runge-Kutta method for y' = lambda y, z = lambda dt."""
    if method == "backward-euler":
        return 1 / (1 - z)
    A = METHODS[method].A
    ones = np.ones(len(A))
    return np.array([1 + w * A[-1] @ np.linalg.solve(np.eye(len(A)) - w * A, ones) for w in z])


def growths(scene):
    """Mean growth of each vector (nats/s) once directions have settled."""
    run = simulate(scene, duration_s=UNTIL)
    assert run.status == "ok" and run.tangent.growth_nats.shape == (UNTIL, 4 * NODES)
    assert run.tangent.period_s == 1.0
    assert not run.tangent.released.any()
    return run.tangent.growth_nats[SETTLED:].mean(axis=0)


@pytest.mark.parametrize("method, step_s", [("esdirk43", 0.05), ("trbdf2", 0.02), ("backward-euler", 0.05)])
def test_growths_are_those_of_the_stability_function(method, step_s, eigenvalues):
    expected = np.sort(np.log(np.abs(stability(method, eigenvalues * step_s))))[::-1] / step_s
    found = growths(leaning(integrator=method, step_s=step_s))
    count = len(expected)
    gaps = np.append(-np.diff(expected) > GAP, True)
    assert gaps.sum() >= 5
    sums = np.cumsum(expected)[gaps], np.cumsum(found[:count])[gaps]
    assert sums[1] == pytest.approx(sums[0], rel=1e-5)
    # nothing else is left after one step: the rest loses all but rounding in each
    assert np.all(found[count:] < -20 / step_s)
