"""Where the values of the breaking-line scene come from, where they differ from those of the tethered buoy."""

from __future__ import annotations

from ..parts.sources import NUMERICAL, PAPER, SOURCES, UNSTATED

_TEXT = f"{PAPER}, section 4.1.1"
BREAKING_SOURCES = SOURCES | {
    "tether.length_m": ("unstretched length of the line", _TEXT),
    "tether.area_m2": ("unstretched cross-section", _TEXT),
    "tether.density_kgpm3": ("density of the line", _TEXT),
    "tether.grid_refined": ("end towards which the grid is refined", NUMERICAL),
    "tether.bending_stiffness_Nm2": ("bending stiffness EI", f"{UNSTATED}; T′(0) I/A of a solid rod"),
    "tether.compression_barrier_N": ("force scale of the barrier below a strain of −0.5", NUMERICAL),
    "tether.tension.law": ("form of the tension law", _TEXT),
    "tether.torsion_stiffness_Nm2": ("torsion stiffness (no effect in a plane)", UNSTATED),
    "tether.drag_normal": ("normal drag coefficient (no effect without water)", "in air; drag is left out"),
    "tether.drag_tangential": ("tangential drag coefficient (no effect without water)", "in air; drag is left out"),
    "tether.added_mass": ("added-mass coefficient (no effect without water)", "in air; added mass is left out"),
    "anchor.rotation": ("rotation of the fixed end", f"{UNSTATED}; free to turn"),
    "end.kind": ("upper end", f"{_TEXT}: the end that breaks"),
    "end.force_N": ("static force on the end", f"{PAPER}, section 4.1.2; upwards half the weight: ends at one level"),
    "end.force_decay_s": ("fracture time t_br", f"{PAPER}, sections 4.1.2 and 4.1.3"),
    "end.rotation": ("rotation of the broken end", "free of moments"),
    "start.buoy_velocity_mps": ("velocity of the upper end at t = 0", f"{_TEXT}: static start"),
    "solver.courant": ("step over (shortest element that deforms)/(fastest wave)", NUMERICAL),
    "solver.shock_viscosity.quadratic": ("quadratic coefficient of the shock viscosity", NUMERICAL),
    "solver.shock_viscosity.linear": ("linear coefficient of the shock viscosity", NUMERICAL),
}
