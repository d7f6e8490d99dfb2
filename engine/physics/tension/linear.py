"""T = p1 eps, in tension and in compression (section 4.2 of the paper)."""

from typing import Literal

from engine.scene.values import Positive, Section, described

IN_LANES = True


class Model(Section):
    """T = stiffness_N * eps, in tension and in compression [f(eps) = p1 eps, section 4.2]."""

    law: Literal["linear"] = described("form of the tension law; the other keys depend on it", paper="(20)")
    stiffness_N: Positive = described(
        "linear: T = stiffness eps, in tension and compression", symbol="p_1", paper="(20), section 4.2"
    )


def faults(sound):
    return ()


def numbers(law):
    return {"p1": law.stiffness_N}, []


def strain_under(load, law):
    return load / law.stiffness_N


def value(eps, p, tables):
    return p.p1 * eps, p.p1


def integral(eps, p, tables):
    return 0.5 * p.p1 * eps * eps


def of_array(eps, p, tables):
    return p["p1"] * eps, 0 * eps + p["p1"]
