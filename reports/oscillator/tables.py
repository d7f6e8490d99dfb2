"""Tables and equations of the report on eq. (33)."""

from __future__ import annotations

import math

import numpy as np

from ..parts.content import Column, Equation, Heading, Item, Table, Text, sub
from ..parts.wording import EMPTY, decimals, number
from .folder import Study

LAMBDA_1, LAMBDA_2 = "λ" + sub("1"), "λ" + sub("2")

OSCILLATOR = Equation(
    "dot.double(gamma) + mu dot(gamma) + a gamma = F sin omega t + B - W, quad a = cases(1 quad &gamma >= 0, 0 "
    "quad &gamma < 0)",
    "Acceleration plus mu times velocity plus a times displacement equals F sine omega t plus B minus W, with a "
    "one where "
    "the displacement is not negative and zero where it is.",
    "33",
)
PIECE = Equation(
    "vec(gamma, dot(gamma)) (tau) = Phi_a (tau) vec(x, v) + q_a (tau), quad det Phi_a = upright(e)^(-mu tau)",
    "Within a piece the state is a fundamental matrix times a constant vector plus a forced response, and the "
    "determinant "
    "of the matrix is e to the minus mu tau.",
)
CROSSING = Equation(
    "min(abs(gamma(t_1)), abs(gamma(t_2))) > (t_2 - t_1)^2 / 8 max abs(dot.double(gamma)) quad arrow.r.double quad "
    'upright("no crossing between two ends on one side")',
    "If both ends lie on one side and the nearer one is farther from zero than an eighth of the interval squared "
    "times the "
    "largest curvature, there is no crossing in between.",
)
EXPONENTS = Equation(
    "lambda_i = lim_(n -> infinity) 1 / (n T) sum_(k = 1)^n ln R_(i i)^((k)), quad lambda_1 + lambda_2 = -mu, quad "
    "D = 1 + lambda_1 / abs(lambda_2)",
    "The exponents are the mean logarithms of the diagonal of R over a period; their sum is minus mu; the "
    "Kaplan-Yorke "
    "dimension of the section is one plus lambda one by the absolute value of lambda two.",
)
_MEANING = {
    "damping": ("μ", "damping by radiated waves"),
    "frequency": ("ω", "forcing frequency, by the radial natural frequency"),
    "force": ("F", "forcing amplitude"),
    "lift": ("B − W", "buoyancy less weight"),
    "phase": ("φ", "phase of the forcing at the strobe, rad"),
}
_PAPER = {"damping": 0.025, "frequency": 1.14, "force": 1.4, "lift": 0.68, "phase": 0.0}


def parameter_table(study: Study) -> Table:
    """The numbers of eq. (33) as run, with their source."""
    rows = tuple(
        (
            _MEANING[key][0],
            _MEANING[key][1],
            number(value, 10),
            ("Tjavaras et al. 1998, figure 19" if key != "phase" else "not stated in the paper; choice of this work")
            if value == _PAPER[key]
            else f"given; the default is {number(_PAPER[key])}",
        )
        for key, value in study.oscillator.items()
        if key in _MEANING
    )
    columns = (Column("symbol", align="left"), Column("what it is", align="left"), Column("value"))
    return Table((*columns, Column("source", align="left")), rows, "The oscillator as run, from `scene.toml`.")


def equation_items(study: Study) -> list[Item]:
    """The equation, how it is integrated, and what the exponents are."""
    return [
        Heading("Equation and method"),
        Text("All quantities are dimensionless (mass, buoy diameter, natural frequency of the radial motion):"),
        OSCILLATOR,
        parameter_table(study),
        Text("Each piece, taut or slack, has a closed form; there is no step whose size would matter:"),
        PIECE,
        Text(
            "The times of switching are bracketed and found to rounding. None is missed, because an interval "
            "counts as free "
            "of crossings only where a bound of the curvature proves it; else it is halved:"
        ),
        CROSSING,
        Text(
            "The force aγ is continuous at γ = 0, so that the velocity field is too, and the tangent map carries "
            "over a switch "
            "without a jump: the saltation matrix is the identity. With two tangent vectors re-orthonormalised "
            "every period,"
        ),
        EXPONENTS,
    ]


def exponent_table(study: Study) -> Table:
    """Exponent and error against the time averaged."""
    convergence = study.arrays["exponents"]["convergence"]
    damping, period = study.oscillator["damping"], 2.0 * math.pi / study.oscillator["frequency"]
    wanted = np.unique(np.geomspace(1, len(convergence), 7).round().astype(int)) - 1
    rows = []
    for time, mean, error in convergence[wanted]:
        second = -damping - mean
        places = max(2, min(12, 1 - math.floor(math.log10(error)))) if error > 0 else 6
        bits = period / math.log(2.0)
        dimension = 1.0 + mean / abs(second) if mean > 0 else 0.0
        rows.append(
            (
                str(round(time / period)),
                decimals(time, 0),
                decimals(mean, places),
                decimals(error, places),
                decimals(second, places),
                decimals(mean * bits, max(1, places - 1)),
                decimals(error * bits, max(1, places - 1)),
                decimals(dimension, 4),
            )
        )
    columns = (
        Column("average over", "periods"),
        Column("time"),
        Column(LAMBDA_1, "nats/time"),
        Column("error", "nats/time"),
        Column(LAMBDA_2, "nats/time"),
        Column(LAMBDA_1, "bits/period"),
        Column("error", "bits/period"),
        Column("D of the section"),
    )
    caption = (
        f"Exponents against the time averaged for each of {study.rows['exponents']['starts']} starts; one standard "
        "error. From the "
        "part `exponents`."
    )
    return Table(columns, tuple(rows), caption)


def orbit_table(study: Study) -> Table | None:
    """Every periodic orbit found, with multipliers; None where there is none."""
    arrays = study.arrays.get("orbits", {})
    if "table" not in arrays:
        return None
    damping, frequency = study.oscillator["damping"], study.oscillator["frequency"]
    rows = []
    for period, real1, imag1, real2, imag2, residual, first in arrays["table"]:
        m1, m2 = complex(real1, imag1), complex(real2, imag2)
        wanted = math.exp(-damping * period * 2.0 * math.pi / frequency)
        point = arrays["points"][int(first)]
        rows.append(
            (
                str(int(period)),
                "stable" if max(abs(m1), abs(m2)) < 1 else "unstable",
                f"{decimals(point[0], 6)}, {decimals(point[1], 6)}",
                _complex(m1),
                _complex(m2),
                f"{abs((m1 * m2).real / wanted - 1.0):.0e}",
                f"{residual:.0e}",
            )
        )
    columns = (
        Column("period"),
        Column("stability", align="left"),
        Column("leftmost strobed point (γ, velocity)"),
        Column("multiplier 1"),
        Column("multiplier 2"),
        Column("product off by", "relative"),
        Column("residual"),
    )
    caption = f"Periodic orbits met by Newton's method ({len(rows)}), by period. From the part `orbits`."
    return Table(columns, tuple(rows), caption, small=True)


def part_table(study: Study) -> Table:
    """What each part cost, and whether it succeeded."""
    rows = tuple(
        (
            part,
            row["status"],
            row["starts"] or EMPTY,
            row["periods"] or EMPTY,
            row["transient"] or EMPTY,
            decimals(float(row["wall_s"]), 2) if row["wall_s"] else EMPTY,
        )
        for part, row in study.rows.items()
    )
    columns = (
        Column("part", align="left"),
        Column("status", align="left"),
        Column("starts"),
        Column("periods"),
        Column("left out", "periods"),
        Column("wall time", "s"),
    )
    return Table(columns, rows, "The parts of the study, from `table.csv`.")


def _complex(value: complex) -> str:
    if value.imag == 0.0:
        return number(value.real, 6)
    sign = "+" if value.imag > 0 else "−"
    return f"{number(value.real, 6)} {sign} {number(abs(value.imag), 6)}i"
