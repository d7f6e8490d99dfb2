"""Eigenvalues of the engine's one-step map about straight and hanging lines, against the closed form.

The map (C, K) -> (C', K') of one step is differenced numerically about a state of rest. For a straight line of uniform
strain eps the closed form (held as a law in tests/engine/planar) gives the rates of the semi-discrete line,

    axial       lambda^2 = -EA k^2/m
    transverse  lambda^2 = -(T k^2/(1+eps) + EI k^4/(1+eps)^4)/m,     k = (2/h) tan(j pi h/(2 L))

and a method multiplies a mode by its stability function R(lambda dt). Compressed, T < 0, rates are real: modes grow,
and their eigenvalues have to lie outside the unit circle, at exp(lambda dt).
"""

import math

import numpy as np

from engine import load_scene
from engine.time import integrators
from engine.time.one_step import OneStep

METHODS = ("esdirk43", "trbdf2", "generalized-alpha", "backward-euler", "midpoint")
LENGTH_M, NODES, MASS_KGPM, EA_N, EI_NM2 = 10.0, 17, 0.5, 1e4, 2.0
TAUT, PUSHED = 0.02, -0.002
CHANGE = 1e-6
_SCENE = {
    "water": None, "waves": None, "buoy": None, "gravity_mps2": 0.0, "tether.length_m": LENGTH_M, "tether.nodes": NODES,
    "tether.area_m2": 5e-4, "tether.density_kgpm3": 1000.0, "tether.bending_stiffness_Nm2": EI_NM2,
    "tether.tension": {"law": "linear", "stiffness_N": EA_N}, "solver.newton_tolerance": 1e-13,
    "solver.max_newton_iterations": 50,
}  # fmt: skip


LINES = {  # name: (what it is, strain or None: hanging, step in s or e-folds of the fastest buckle, dimensions)
    "taut": ("taut, strain 0.02", TAUT, 0.05, 2),
    "taut in space": ("taut, strain 0.02, in space", TAUT, 0.05, 3),
    "hanging": ("hanging between ends at 0.8 of its length", None, 0.05, 2),
    "pushed": ("straight under compression, 1.5 e-folds of the fastest buckle in a step", PUSHED, "1.5 e-folds", 2),
    "pushed too far": ("the same, 15 e-folds in a step", PUSHED, "15 e-folds", 2),
}


def rates(strain: float) -> np.ndarray:
    """Rates lambda (1/s, complex, both signs) of the semi-discrete straight line of that strain: the closed form."""
    j = np.arange(1, NODES - 1)
    k = 2 * (NODES - 1) / LENGTH_M * np.tan(0.5 * j * math.pi / (NODES - 1))
    stretch = 1 + strain
    axial = -EA_N * k**2 / MASS_KGPM
    transverse = -(EA_N * strain * k**2 / stretch + EI_NM2 * k**4 / stretch**4) / MASS_KGPM
    root = np.sqrt(np.concatenate([axial, transverse]).astype(complex))
    return np.concatenate([root, -root])


def factors(method: str, z: np.ndarray, rho: float = 0.5) -> np.ndarray:
    """What one step makes of modes with lambda dt = z: R(z), and both roots of generalized-alpha."""
    if method == "backward-euler":
        return 1 / (1 - z)
    if method == "midpoint":
        return (1 + z / 2) / (1 - z / 2)
    if method == "generalized-alpha":
        return np.concatenate([np.linalg.eigvals(_generalized_alpha(one, rho)) for one in z])
    A = integrators.METHODS[method].A
    ones = np.ones(len(A))
    return np.array([1 + one * (A[-1] @ np.linalg.solve(np.eye(len(A)) - one * A, ones)) for one in z])


def _generalized_alpha(z, rho):
    """The 2 x 2 map of (y, dt y') of Jansen, Whiting & Hulbert (2000) for y' = lambda y."""
    am, af = 0.5 * (3 - rho) / (1 + rho), 1 / (1 + rho)
    gamma = 0.5 + am - af
    after = np.array([[1.0, -gamma], [-z * af, am]])
    before = np.array([[1.0, 1 - gamma], [z * (1 - af), am - 1]])
    return np.linalg.solve(after, before)


def of_line(name: str) -> dict[str, object]:
    """Eigenvalues of every method about one line of LINES.

    {"title", "step_s", "methods": {method: {"re", "im", "largest", and for straight lines "distance" (largest distance
    of a closed-form eigenvalue from the nearest one found), "growing", "growing_found": how many should be and are
    outside the unit circle}}}
    """
    title, strain, step, dimensions = LINES[name]
    step_s = step if isinstance(step, float) else float(step.split()[0]) / float(rates(strain).real.max())
    found = {}
    for method in METHODS:
        values = eigenvalues(method, strain, step_s, dimensions)
        entry = {"re": values.real.tolist(), "im": values.imag.tolist(), "largest": float(np.abs(values).max())}
        if strain is not None:
            z = rates(strain) * step_s
            entry["distance"] = float(np.abs(values - factors(method, z)[:, None]).min(axis=1).max())
            entry |= {"growing": int((z.real > 1e-9).sum()), "growing_found": int((np.abs(values) > 1 + 1e-6).sum())}
        found[method] = entry
    return {"title": title, "step_s": step_s, "methods": found}


def eigenvalues(method: str, strain: float | None, step_s: float, dimensions: int) -> np.ndarray:
    """Eigenvalues of the numerical derivative of the engine's step about one state of rest."""
    place = [0.8 * LENGTH_M, 0.0, 0.0] if strain is None else [LENGTH_M * (1 + max(strain, 0.0)), 0.0, 0.0]
    changes = {
        **_SCENE, "end": {"kind": "held", "position_m": place}, "motion.dimensions": dimensions,
        "solver.integrator": method, "solver.step_s": step_s, "output.step_s": 0.999 * step_s,
    }  # fmt: skip
    if strain is None:
        changes["gravity_mps2"] = 9.81
    step = OneStep(load_scene("tethered_buoy", changes), strain)
    rest = np.array([step.C, step.K])

    def after(values):
        return np.ravel(step(*values.reshape(rest.shape)))

    changes = np.diag(np.repeat([CHANGE, CHANGE / step_s], step.C.size))
    J = [(after(rest.ravel() + one) - after(rest.ravel() - one)) / (2 * one.max()) for one in changes]
    return np.linalg.eigvals(np.transpose(J))
