"""Where each numbered equation and each figure of the paper is: in the code, and in the reports.

NOTATION.md carries the same list for readers of the sources; a test holds the two together.
"""

from __future__ import annotations

from ..parts.content import Column, Heading, Item, Table, Text

BREAKING, BUOY, WHOLE = "report on the breaking line", "report on the buoy", "this report"
EQUATIONS = (
    ("eq. (1)", "local frame from the fixed one", "engine/paper_box/frame.py", ""),
    ("eq. (2)", "components of a vector", "engine/paper_box/frame.py", ""),
    ("eq. (3)", "rate of a vector in the local frame", "engine/paper_box/frame.py", ""),
    ("eq. (4)", "derivative along the line in the local frame", "engine/spatial/node.py", ""),
    ("eq. (5)", "Euler parameters", "engine/spatial/vectors.py", "as printed engine/paper_box/frame.py"),
    (
        "eq. (6)",
        "rotation matrix",
        "engine/spatial/vectors.py",
        f"{WHOLE}, misprints; as printed engine/paper_box/frame.py",
    ),
    ("eq. (7)", "strain", "engine/planar/node.py", "in space engine/spatial/node.py"),
    ("eq. (8)", "velocity", "engine/planar/node.py", f"{WHOLE}, misprints; in space engine/spatial/node.py"),
    ("eq. (9)", "mass of a stretched element", "engine/parameters.py", ""),
    ("eq. (10)", "area of a stretched element", "engine/parameters.py", ""),
    ("eq. (11)", "momentum", "engine/planar/node.py", f"{BUOY}, equations; in space engine/spatial/node.py"),
    (
        "eq. (12)",
        "momentum in the local frame",
        "engine/planar/node.py",
        f"{BREAKING}, equations; in space engine/spatial/node.py",
    ),
    ("eq. (13)", "torque", "engine/spatial/elimination.py", ""),
    ("eq. (14)", "bending moment about n", "engine/spatial/elimination.py", ""),
    ("eq. (15)", "bending moment about b", "engine/planar/elimination.py", "in space engine/spatial/elimination.py"),
    (
        "eq. (16)",
        "balance of moments",
        "engine/planar/elimination.py",
        f"{WHOLE}, misprints; in space engine/spatial/elimination.py",
    ),
    ("eq. (17)", "compatibility", "engine/planar/elimination.py", "in space engine/spatial/elimination.py"),
    (
        "eq. (18)",
        "compatibility, with the tangent",
        "engine/planar/elimination.py",
        f"{BREAKING}, equations; in space engine/spatial/elimination.py",
    ),
    (
        "eq. (19)",
        "compatibility in the local frame",
        "engine/planar/elimination.py",
        "in space engine/spatial/elimination.py",
    ),
    ("eq. (20)", "tension law", "engine/physics/tension.py", f"{BREAKING}, equations"),
    ("eq. (21)", "the thirteen equations", "engine/paper_box/line.py", ""),
    ("eq. (22)", "the thirteen unknowns", "engine/paper_box/line.py", ""),
    ("eq. (23)", "weight in water", "engine/planar/node.py", f"{WHOLE}, misprints; in space engine/spatial/node.py"),
    (
        "eq. (24)",
        "Morison's force on the line",
        "engine/planar/node.py",
        f"{WHOLE}, misprints; in space engine/spatial/node.py",
    ),
    ("eq. (25)", "box rule: value", "engine/time/integrators/midpoint.py", ""),
    ("eq. (26)", "box rule: rate", "engine/time/integrators/midpoint.py", ""),
    (
        "eq. (27)",
        "box rule: derivative along the line",
        "engine/time/integrators/midpoint.py",
        "engine/planar/elimination.py",
    ),
    ("eq. (28)", "the discrete equations", "engine/paper_box/box.py", "docs/paper_box.md"),
    ("eq. (29)", "slope of the tension law", "engine/physics/tension.py", f"{BREAKING}, fronts and shocks"),
    ("eq. (30)", "motion of the buoy", "engine/physics/ends.py", f"{BUOY}, equations"),
    ("eq. (31)", "spectral amplitude", "analysis/spectra.py", f"{WHOLE}, figs. 12, 17, 18"),
    (
        "eq. (32)",
        "Lyapunov exponent",
        "analysis/wolf_plateau.py",
        f"{WHOLE}, fig. 14; analysis/exponents.py, engine/perturbations/exponents.py",
    ),
    (
        "eq. (33)",
        "snap oscillator",
        "analysis/oscillator/equation.py",
        "report on eq. (33); closed form analysis/oscillator/pieces.py",
    ),
    *(
        (f"eq. ({number})", what, "engine/paper_box/nodal.py", "docs/appendix_a.md")
        for number, what in (
            (34, "M, columns of ε … w"),
            (35, "M, columns of ε … w"),
            (36, "M, column of β₀"),
            (37, "M, column of β₁"),
            (38, "M, column of β₂"),
            (39, "M, column of β₃"),
            (40, "P"),
        )
    ),
)
FIGURES = (
    ("fig. 2", "motion of the breaking line, 5 ms", "reports/paper/figures/breaking.py", BREAKING),
    ("fig. 3", "tension along the breaking line, 5 ms", "reports/paper/figures/breaking.py", BREAKING),
    ("fig. 4", "velocity along the breaking line, 5 ms", "reports/paper/figures/breaking.py", BREAKING),
    ("fig. 5", "motion of the breaking line, 50 ms", "reports/paper/figures/breaking.py", BREAKING),
    ("fig. 6", "tension along the breaking line, 50 ms", "reports/paper/figures/breaking.py", BREAKING),
    ("fig. 7", "velocity along the breaking line, 50 ms", "reports/paper/figures/breaking.py", BREAKING),
    ("fig. 9", "top tension, kA = 0.016", "reports/paper/figures/histories.py", f"{BUOY}, chosen runs"),
    ("fig. 10", "motion along r, kA = 0.016", "reports/paper/figures/histories.py", f"{BUOY}, chosen runs"),
    ("fig. 11", "motion along θ, kA = 0.016", "reports/paper/figures/histories.py", f"{BUOY}, chosen runs"),
    ("fig. 12", "spectra, kA = 0.016", "reports/paper/figures/spectra.py", f"{BUOY}, chosen runs"),
    ("fig. 13", "top tension, kA = 0.13", "reports/paper/figures/histories.py", f"{BUOY}, chosen runs"),
    ("fig. 14", "Lyapunov exponents over time", "reports/paper/figures/exponents.py", f"{BUOY}, regimes"),
    ("fig. 15", "motion along r, kA = 0.13", "reports/paper/figures/histories.py", f"{BUOY}, chosen runs"),
    ("fig. 16", "motion along θ, kA = 0.13", "reports/paper/figures/histories.py", f"{BUOY}, chosen runs"),
    ("fig. 17", "spectrum of r, kA = 0.13", "reports/paper/figures/spectra.py", f"{BUOY}, chosen runs"),
    ("fig. 18", "spectrum of θ, kA = 0.13", "reports/paper/figures/spectra.py", f"{BUOY}, chosen runs"),
    ("fig. 19", "sections: buoy (a), eq. (33) (b)", "reports/paper/figures/sections.py", "report on eq. (33)"),
    ("fig. 20", "motion across the plane of the waves", "reports/paper/figures/offplane.py", "report out of the plane"),
)


def index_items() -> list[Item]:
    """The section."""
    heads = tuple(Column(title, align="left") for title in ("in the paper", "what", "code", "more in"))
    figures = Table(
        heads,
        tuple((where, what, f"`{code}`", more) for where, what, code, more in FIGURES),
        "The paper's figures: what draws them, and where there is more. The sketches, fig. 1 (segment of the line) and "
        "fig. 8 (buoy in waves), are not drawn. Data: `figures/`.",
        small=True,
    )
    equations = Table(
        heads,
        tuple((where, what, f"`{code}`", more) for where, what, code, more in EQUATIONS),
        "The paper's equations: where they are in the code, and where reports and documents say more.",
        small=True,
    )
    text = "To find an equation or a figure in the sources search for it as written here; NOTATION.md has the list too."
    return [Heading("Where to find what"), Text(text), figures, equations]
