"""The misprints of the paper, as its equations were derived again (docs/appendix_a.md holds the derivations)."""

from __future__ import annotations

from ..parts.content import Column, Heading, Item, Table, Text

ROWS = (
    ("eq. (6), C₃₁", "β₁β₃ + β₀β₂", "2 (β₁β₃ + β₀β₂)", "t, n, b are not at right angles otherwise"),
    ("eqs. (8), (24)", "first local components with i", "with t", "i is an axis of the fixed frame"),
    (
        "eq. (16)",
        "factors (1 + ε)⁻² on the moments",
        "multiplied by (1 + ε)²: M′ + Ω × M + (1 + ε)³ t × T = 0",
        "not wrong; this is the form of rows 12 and 13 of eq. (40)",
    ),
    (
        "2.2, before eq. (19)",
        "t = ∂R/∂s₁ = ∂R/∂s (1 + ε), as it reads",
        "∂R/∂s / (1 + ε)",
        "ds₁ = (1 + ε) ds; eq. (18) has it right",
    ),
    ("eq. (23)", "−w₀ k", "along the vertical axis", "the appendix projects the weight on axis 1, eq. (23) on axis 3"),
    (
        "eq. (24), inertia",
        "−[ρA dv_c/dt + m_a (dv_c/dt − dv/dt)]",
        "+[…]",
        "accelerating water pushes the tether along; eqs. (36), (37) have the right sign",
    ),
    (
        "eq. (24), rates",
        "rates of components in a frame that turns",
        "normal components of the true accelerations",
        "the force must not depend on the roll of the frame; the same to the paper's accuracy",
    ),
    ("eqs. (36), (37)", "14 entries", "13", "one zero too many at the end"),
    ("eq. (40), row 1", "S_b Ω₂ − S_b Ω₃", "S_b Ω₂ − S_n Ω₃", "first component of Ω × T"),
    (
        "eq. (40), rows 2, 3",
        "no term in the acceleration of the water",
        "+ R n·dU_c/dt and + R b·dU_c/dt, R = ρA + m_a",
        "eq. (24) has them; without, the tether would feel the drag of waves alone",
    ),
    ("eq. (40), rows 12, 13", "GL_p (in the scan)", "GI_p", "eq. (13)"),
    ("eqs. (34), (35), (38), (39)", "missing in the scan", "docs/appendix_a.md", "derived, and found in a manual"),
    ("4.1.2", "the wave takes 0.55 to 0.91 s", "0.055 to 0.091 s", "the length over the printed law's wave speeds"),
    ("4.1.2", "about 500 m/s at high tension", "see the statement", "√(T′/m) of the printed tension law"),
)


def misprint_items() -> list[Item]:
    """The section."""
    heads = tuple(Column(title, align="left") for title in ("where", "printed", "right", "why"))
    caption = (
        "Misprints and slips. All 169 entries of M and 13 rows of P of eqs. (34)-(40) were derived again by computer "
        "algebra and agree with the corrected print (docs/appendix_a.md)."
    )
    return [
        Heading("Misprints"),
        Text("Whoever programs the paper needs these corrections; with the equations as printed some runs go wrong."),
        Table(heads, ROWS, caption, small=True),
    ]
