"""Lines and random states in which every term of the paper's form is at work, and appendix A in their numbers."""

import numpy as np

from engine import load_scene
from engine.paper_box.line import line_of
from tests.engine.box_equations import tension
from tests.engine.paper_box.appendix import UNKNOWNS, M_right, P_right, letters

LAWS = {
    "linear": {"law": "linear", "stiffness_N": 5e4},
    "tanh": {"law": "tanh", "p": [2.0e4, 5.0, 0.3, -5.0e3, 1.0e4]},
    "tabulated": {"law": "tabulated", "strain": [-0.2, 0.0, 0.1, 0.3], "tension_N": [-500.0, 0.0, 3e3, 2e4]},
}
SLOPE_STEP = 1e-40


def scene_of(law="linear", dimensions=3, **overrides):
    return load_scene(
        "tethered_buoy",
        {
            "motion.dimensions": dimensions,
            "solver.scheme": "paper-box",
            "tether.tension": LAWS[law],
            "tether.nodes": 5,
            "tether.diameter_m": 0.05,
            "tether.bending_stiffness_Nm2": 24.0,
            "tether.torsion_stiffness_Nm2": 9.0,
            **overrides,
        },
    )


def states(seed, n, unit=True):
    """Y (13, n) with strain of both signs, shear, motion, bends and twist, and water (6, n)."""
    rng = np.random.default_rng(seed)
    Y = np.empty((13, n))
    Y[0] = rng.uniform(-0.15, 0.25, n)
    Y[1:3] = rng.normal(0, 300, (2, n))
    Y[3:6] = rng.normal(0, 2, (3, n))
    Y[6:10] = rng.normal(0, 1, (4, n))
    if unit:
        Y[6:10] /= np.linalg.norm(Y[6:10], axis=0)
    Y[10:13] = rng.normal(0, 1, (3, n))
    return Y, rng.normal(0, 1.5, (6, n))


def numbers(scene, Y, water):
    """The letters of appendix A at one node: Y (13,), water (6,), real or complex; constants from the scene itself."""
    tether, rho = scene.tether, scene.water.density_kgpm3
    d = tether.diameter_m
    displaced = rho * np.pi * d**2 / 4
    eps = np.asarray(Y[0])
    df = tension(tether.tension, eps.real + 1j * SLOPE_STEP).imag / SLOPE_STEP
    if np.iscomplexobj(eps) and eps.imag != 0:  # f' + i f'' Im(eps): the slope of the slope by differences
        step = 1e-5
        ends = [tension(tether.tension, eps.real + s * step + 1j * SLOPE_STEP).imag / SLOPE_STEP for s in (1, -1)]
        df = df + 1j * eps.imag * (ends[0] - ends[1]) / (2 * step)
    return letters(
        Y,
        **dict(zip(("Uc", "Vc", "Wc"), water[:3], strict=True)),
        Ac=water[3:],
        m=tether.density_kgpm3 * tether.area_m2,
        m_a=tether.added_mass * displaced,
        R=displaced * (1 + tether.added_mass),
        w0=(tether.density_kgpm3 - rho) * tether.area_m2 * scene.gravity_mps2,
        EI=tether.bending_stiffness_Nm2,
        GIp=tether.torsion_stiffness_Nm2,
        half_rho_d_pi_Cdt=0.5 * rho * d * np.pi * tether.drag_tangential,
        half_rho_d_Cdp=0.5 * rho * d * tether.drag_normal,
        f=tension(tether.tension, eps),
        df=df,
        sqrt=np.sqrt,
        absolute=lambda x: np.where(x.real < 0, -x, x),
    )


def M_and_P(scene, Y, water):
    """M (13, 13) and P (13,) of appendix A, corrected, at one node."""
    y = numbers(scene, Y, water)
    M = np.zeros((13, 13), complex)
    for (row, name), value in M_right(y).items():
        M[row - 1, UNKNOWNS.index(name)] = value
    rows = P_right(y)
    return M, np.array([rows[row] for row in range(1, 14)], complex)


__all__ = ["LAWS", "M_and_P", "line_of", "numbers", "scene_of", "states"]
