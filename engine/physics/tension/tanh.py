"""T = p1 tanh(p2 eps + p3) + p4 + p5 eps: the synthetic line of section 4.1.1 of the paper."""

import math
from typing import Literal

from engine.scene.values import Five, Section, described

IN_LANES = True


class Model(Section):
    """T = p1 tanh(p2 eps + p3) + p4 + p5 eps [section 4.1.1]."""

    law: Literal["tanh"]
    p: Five = described(
        "tanh: T = p1 tanh(p2 eps + p3) + p4 + p5 eps", symbol="p_1 ... p_5", paper="(20), section 4.1.1"
    )


def faults(sound):
    p1, p2, _, _, p5 = sound["tether.tension.p"] or (0.0,) * 5
    if min(p5, p1 * p2 + p5) < 0:
        yield sound.fault("tether.tension.p", "a tension that never falls with strain: p5 >= 0 and p1 p2 + p5 >= 0")


def numbers(law):
    return {f"p{i}": number for i, number in enumerate(law.p, 1)}, []


def value(eps, p, tables):
    th = math.tanh(p.p2 * eps + p.p3)
    return p.p1 * th + p.p4 + p.p5 * eps, p.p1 * p.p2 * (1.0 - th * th) + p.p5


def integral(eps, p, tables):
    # ln cosh x = |x| - ln 2 + ln(1 + exp(-2 |x|)) does not overflow
    x, x0 = abs(p.p2 * eps + p.p3), abs(p.p3)
    rise = p.p1 / p.p2 * (x - x0 + math.log1p(math.exp(-2.0 * x)) - math.log1p(math.exp(-2.0 * x0)))
    return rise + p.p4 * eps + 0.5 * p.p5 * eps * eps


def of_array(eps, p, tables):
    import numpy as np

    th = np.tanh(p["p2"] * eps + p["p3"])
    return p["p1"] * th + p["p4"] + p["p5"] * eps, p["p1"] * p["p2"] * (1 - th * th) + p["p5"]
