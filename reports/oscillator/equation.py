"""Equation (33) in its report: the equation, its numbers, and how it is integrated."""

from __future__ import annotations

from analysis.oscillator import SnapOscillator

from ..parts.content import Column, Equation, Heading, Item, Table, Text
from ..parts.wording import number
from .folder import Study

OSCILLATOR = Equation(
    "dot.double(gamma) + mu dot(gamma) + a gamma = F sin omega t + B - W, quad a = cases(1 quad &gamma >= 0, 0 quad "
    "&gamma < 0)",
    "Acceleration plus mu times velocity plus a times displacement equals F sine omega t plus B minus W, with a one "
    "where the displacement is not negative and zero where it is.",
    "33",
)
PIECE = Equation(
    "vec(gamma, dot(gamma)) (tau) = Phi_a (tau) vec(x, v) + q_a (tau), quad det Phi_a = upright(e)^(-mu tau)",
    "Within a piece the state is a fundamental matrix times a constant vector plus a forced response, and the "
    "determinant of the matrix is e to the minus mu tau.",
)
CROSSING = Equation(
    "min(abs(gamma(t_1)), abs(gamma(t_2))) > (t_2 - t_1)^2 / 8 max abs(dot.double(gamma)) quad arrow.r.double quad "
    'upright("no crossing between two ends on one side")',
    "If both ends lie on one side and the nearer one is farther from zero than an eighth of the interval squared "
    "times the largest curvature, there is no crossing in between.",
)
EXPONENTS = Equation(
    "lambda_i = lim_(n -> infinity) 1 / (n T) sum_(k = 1)^n ln R_(i i)^((k)), quad lambda_1 + lambda_2 = -mu, quad D "
    "= 1 + lambda_1 / abs(lambda_2)",
    "The exponents are the mean logarithms of the diagonal of R over a period; their sum is minus mu; the "
    "Kaplan-Yorke dimension of the section is one plus lambda one by the absolute value of lambda two.",
)
FIGURE_19 = "Tjavaras et al. 1998, figure 19"
NUMBERS = {  # symbol, what it is, source of the usual value
    "damping": ("μ", "damping by radiated waves", FIGURE_19),
    "frequency": ("ω", "forcing frequency, by the radial natural frequency", FIGURE_19),
    "force": ("F", "forcing amplitude", FIGURE_19),
    "lift": ("B − W", "buoyancy less weight", FIGURE_19),
    "phase": ("φ", "phase of the forcing at the strobe, rad", "not stated in the paper; choice of this work"),
}


def subtitle(study: Study) -> str:
    """The numbers as run, in a line."""
    return ", ".join(
        f"{NUMBERS[key][0]} = {number(study.oscillator[key])}" for key in ("force", "lift", "damping", "frequency")
    )


def equation_items(study: Study) -> list[Item]:
    """The equation, how it is integrated, and what the exponents are."""
    rows = []
    for key, (symbol, meaning, source) in NUMBERS.items():
        given, usual = study.oscillator[key], getattr(SnapOscillator, key)
        source = source if given == usual else f"given; the default is {number(usual)}"
        rows.append((symbol, meaning, number(given, 10), source))
    columns = [Column(title, align="left") for title in ("symbol", "what it is", "source")]
    columns.insert(2, Column("value"))
    return [
        Heading("Equation and method"),
        Text("All quantities are dimensionless (mass, buoy diameter, natural frequency of the radial motion):"),
        OSCILLATOR,
        Table(tuple(columns), tuple(rows), "The oscillator as run, from `scene.toml`."),
        Text("Each piece, taut or slack, has a closed form, so there is no time step:"),
        PIECE,
        Text(
            "The times of switching are bracketed and found to rounding. None is missed, because an interval counts "
            "as free of crossings only where a bound of the curvature proves it; else it is halved:"
        ),
        CROSSING,
        Text(
            "The force aγ is continuous at γ = 0. So the velocity field is too, and the tangent map carries over a "
            "switch without a jump: the saltation matrix is the identity. With two tangent vectors "
            "re-orthonormalised every period,"
        ),
        EXPONENTS,
    ]
