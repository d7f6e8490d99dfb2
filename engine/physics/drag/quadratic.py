"""Coefficients that do not depend on the speed: Morison's drag as the paper has it, eq. (24)."""

from typing import Literal

from engine.scene.values import Section, described

IN_LANES = True


class Model(Section):
    """Coefficients that are the same at every speed."""

    law: Literal["quadratic"] = described("form of the drag law; the other keys depend on it", paper="(24)")


def faults(sound):
    return ()


def numbers(law):
    return {}, []


def along(speed, p, tables):
    return 1.0, 0.0


def across(speed, p, tables):
    return 1.0, 0.0
