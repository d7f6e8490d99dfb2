"""Law: a step multiplies every mode of a straight line by its method's stability function R(lambda dt).

The map (C, K) -> (C', K') of one step is differenced about a state of rest, by central
differences of 1e-6; its eigenvalues are good to 1e-5 or so. For a straight line of uniform strain eps the closed form
(a law of tests/engine/planar) gives the rates of the semi-discrete line,

    axial       lambda^2 = -EA k^2/m
    transverse  lambda^2 = -(T k^2/(1+eps) + EI k^4/(1+eps)^4)/m,     k = (2/h) tan(j pi h/(2 L))

Taut, nothing may grow at any step. Compressed, T < 0, rates are real, and what grows has to grow.
"""

import math

import numpy as np
import pytest

from engine.planar.columns import EPS  # in space the same column
from engine.run import Run
from engine.spatial import lift
from engine.time import integrators
from tests.engine.lines import DRY, held, line, linear
from tests.engine.modes import box

ORDER = {"esdirk43": 4, "trbdf2": 2, "generalized-alpha": 2, "backward-euler": 1, "midpoint": 2}
AT_INFINITY = {"esdirk43": 0.0, "trbdf2": 0.0, "generalized-alpha": 0.5, "backward-euler": 0.0, "midpoint": 1.0}
LENGTH_M, NODES, MASS_KGPM, EA_N, EI_NM2 = 10.0, 17, 0.5, 1e4, 2.0
TAUT, PUSHED = 0.02, -0.002
CHANGE = 1e-6
EXACT_NEWTON = {"solver.newton_tolerance": 1e-13, "solver.max_newton_iterations": 50}


def rates(strain):
    """Rates lambda (1/s, complex, both signs) of the semi-discrete straight line of that strain: the closed form."""
    k = box(np.arange(1, NODES - 1) * math.pi / LENGTH_M, LENGTH_M / (NODES - 1))
    stretch = 1 + strain
    axial = -EA_N * k**2 / MASS_KGPM
    transverse = -(EA_N * strain * k**2 / stretch + EI_NM2 * k**4 / stretch**4) / MASS_KGPM
    root = np.sqrt(np.concatenate([axial, transverse]).astype(complex))
    return np.concatenate([root, -root])


def factors(method, z, rho=0.5):
    """What one step makes of modes with lambda dt = z: R(z), and both roots of generalized-alpha."""
    if method == "backward-euler":
        return 1 / (1 - z)
    if method == "midpoint":
        return (1 + z / 2) / (1 - z / 2)
    if method == "generalized-alpha":
        return np.concatenate([np.linalg.eigvals(generalized_alpha(mode, rho)) for mode in z])
    A = integrators.METHODS[method].A
    ones = np.ones(len(A))
    return np.array([1 + mode * (A[-1] @ np.linalg.solve(np.eye(len(A)) - mode * A, ones)) for mode in z])


def generalized_alpha(z, rho):
    """The 2 x 2 map of (y, dt y') of Jansen, Whiting & Hulbert (2000) for y' = lambda y."""
    am, af = 0.5 * (3 - rho) / (1 + rho), 1 / (1 + rho)
    gamma = 0.5 + am - af
    after = np.array([[1.0, -gamma], [-z * af, am]])
    before = np.array([[1.0, 1 - gamma], [z * (1 - af), am - 1]])
    return np.linalg.solve(after, before)


def step_of(scene, strain):
    """The step of a run as a map of (C, K), flat, and (C, K) of rest; strain: of a straight line, else statics."""
    run = Run(scene, scene.solver.step_s)
    Y, begin = run.motion.Y.copy(), run.state.copy()
    # not the first step, for which C would be computed, nor the first sample, which is at the start
    begin["steps"], begin["samples"], begin["small_steps"], begin["dt"] = 1, 1, 0, scene.solver.step_s
    if strain is not None:
        Y[:, EPS] = strain
    rest = np.zeros((2, *run.motion.C.shape))
    q = lift.stretch_vectors(Y)
    rest[0, :, : q.shape[1]] = q

    def step(state):
        run.state = begin.copy()
        for part, values in zip(run.motion, (Y, Y, *state.reshape(rest.shape)), strict=True):
            part[:] = values
        run.advance(1)
        assert [int(run.state[name]) for name in ("status", "failures", "steps")] == [0, 0, 2]
        return np.ravel([run.motion.C, run.motion.K])

    return step, rest.ravel()


def eigenvalues(method, strain, step_s, dimensions=2):
    """Eigenvalues of the numerical derivative of the engine's step; strain None: a line that hangs between its ends."""
    if strain is None:
        place, gravity_mps2 = 0.8 * LENGTH_M, 9.81
    else:
        place, gravity_mps2 = LENGTH_M * (1 + max(strain, 0.0)), 0.0
    scene = line(
        DRY, held(place, 0.0), EXACT_NEWTON,
        {
            "gravity_mps2": gravity_mps2, "motion.dimensions": dimensions, "solver.integrator": method,
            "solver.step_s": step_s, "output.step_s": 0.999 * step_s,
        },
        length_m=LENGTH_M, nodes=NODES, area_m2=5e-4, density_kgpm3=1000.0, bending_stiffness_Nm2=EI_NM2,
        tension=linear(EA_N),
    )  # fmt: skip
    step, rest = step_of(scene, strain)
    size = rest.size
    derivative = np.empty((size, size))
    for column in range(size):
        of_rates = column >= size // 2
        change = np.zeros(size)
        change[column] = CHANGE / step_s if of_rates else CHANGE
        derivative[:, column] = (step(rest + change) - step(rest - change)) / (2 * change[column])
    return np.linalg.eigvals(derivative)


@pytest.mark.parametrize("method", ORDER)
def test_the_stability_function_is_that_of_its_order_and_damping(method):
    z = np.array([1e-2j, 5e-3j])
    error = np.abs(factors(method, z)[None, :] - np.exp(z)[:, None]).min(axis=1)
    assert np.log2(error[0] / error[1]) == pytest.approx(ORDER[method] + 1, abs=0.15)
    at_infinity = np.abs(factors(method, np.array([-1e9 + 0j]))).max()
    assert at_infinity == pytest.approx(AT_INFINITY[method], abs=1e-6)


def distance_from_closed_form(method, values, strain, step_s):
    return np.abs(values - factors(method, rates(strain) * step_s)[:, None]).min(axis=1).max()


@pytest.mark.parametrize(
    ("step_s", "dimensions"), [(1e-3, 2), (0.05, 2), (3.0, 2), pytest.param(0.05, 3, marks=pytest.mark.slow)]
)
def test_taut_modes_are_multiplied_as_the_method_says_and_none_grows(step_s, dimensions):
    for method in ORDER:
        values = eigenvalues(method, TAUT, step_s, dimensions)
        assert distance_from_closed_form(method, values, TAUT, step_s) < 1e-4, method
        assert np.abs(values).max() < 1 + 1e-5, method


def test_no_mode_of_a_hanging_line_grows():
    for method in ORDER:
        assert np.abs(eigenvalues(method, None, 0.05)).max() < 1 + 1e-5, method


@pytest.mark.parametrize("e_folds", [1.5, 15.0])
def test_under_compression_the_modes_that_grow_do(e_folds):
    """In steps of fifteen e-folds of the fastest buckle a method damps the growth, as its R says."""
    step_s = e_folds / rates(PUSHED).real.max()
    for method in ORDER:
        values = eigenvalues(method, PUSHED, step_s)
        assert distance_from_closed_form(method, values, PUSHED, step_s) < 2e-5, method
        if e_folds < 2.0:
            growing = (rates(PUSHED).real * step_s > 1e-9).sum()
            assert growing == (np.abs(values) > 1 + 1e-6).sum() == 7, method


def test_two_e_folds_a_step_follow_the_growth_and_fifteen_do_not():
    """What solver.growth_per_step is for: R(2) of the default method is e^2 to 1 %, and R(15) has nothing of e^15."""
    two, fifteen = factors("esdirk43", np.array([2.0, 15.0]) + 0j).real
    assert two == pytest.approx(np.exp(2.0), rel=0.01)
    assert abs(fifteen) < 1e-3 * np.exp(15.0)


def test_space_has_the_same_modes_twice():
    planar, space = (eigenvalues("trbdf2", TAUT, 0.05, dimensions) for dimensions in (2, 3))
    assert len(space) == 1.5 * len(planar)
    assert np.abs(space[None, :] - planar[:, None]).min(axis=1).max() < 1e-5
