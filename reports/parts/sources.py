"""Where every parameter of the tethered-buoy scene comes from: one table by scene key, read by the report alone."""

from __future__ import annotations

from .symbols import C_D, C_DP, C_DT, GI_P, L_0, M_A, P_1, RHO_W, T_I

PAPER = "Tjavaras et al. 1998"
TABLE_1 = f"{PAPER}, Table 1"
TEXT_42 = f"{PAPER}, section 4.2 (text)"
UNSTATED = "not stated in the paper"
NUMERICAL = "numerical choice of this work"

# key: (what it is, where the default comes from)
SOURCES: dict[str, tuple[str, str]] = {
    "gravity_mps2": ("gravity", f"{UNSTATED}; standard value, rounded"),
    "tether.length_m": (f"unstretched tether length {L_0}", TABLE_1),
    "tether.area_m2": ("unstretched cross-section", TABLE_1),
    "tether.density_kgpm3": ("density of the rope material", TABLE_1),
    "tether.diameter_m": ("rope diameter d", "from the cross-section, d = √(4A/π)"),
    "tether.nodes": ("grid nodes", f"{UNSTATED}; {NUMERICAL}"),
    "tether.grid_stretching": ("grid refinement towards an end", NUMERICAL),
    "tether.grid_refined": ("end or ends towards which the grid is refined", NUMERICAL),
    "tether.bending_stiffness_Nm2": (
        "bending stiffness EI",
        f"{UNSTATED}; a published example of the same buoy and rope",
    ),
    "tether.torsion_stiffness_Nm2": (
        f"torsion stiffness {GI_P} (no effect in a plane)",
        f"{UNSTATED}; a published example of the same buoy and rope",
    ),
    "tether.drag_normal": (f"normal drag coefficient {C_DP}", f"{PAPER}, section 2.3"),
    "tether.drag_tangential": (f"tangential drag coefficient {C_DT}", f"{PAPER}, section 2.3"),
    "tether.added_mass": ("normal added-mass coefficient", f"{UNSTATED}; potential flow about a cylinder"),
    "tether.tension.law": ("form of the tension law", TEXT_42),
    "tether.tension.stiffness_N": (f"tension law T = {P_1}ε: {P_1}", TEXT_42),
    "tether.tension.p": ("coefficients of the tanh law", f"{PAPER}, section 4.1.1"),
    "tether.tension.strain": ("strain of the tabulated law", "measured points"),
    "tether.tension.tension_N": ("tension of the tabulated law", "measured points"),
    "tether.compression_barrier_N": ("barrier against collapse below a strain of -0.5", NUMERICAL),
    "anchor.rotation": ("lower end, free to turn or clamped", f"{UNSTATED}; no moment at the anchor"),
    "end.kind": ("upper end", TEXT_42),
    "end.rotation": ("upper end, free to turn or clamped", f"{UNSTATED}; no moment at the buoy"),
    "buoy.diameter_m": ("buoy diameter D", TABLE_1),
    "buoy.mass_kg": ("buoy mass M", TABLE_1),
    "buoy.added_mass_kg": (f"buoy added mass {M_A}", TABLE_1),
    "buoy.drag": (f"buoy drag coefficient {C_D}", TABLE_1),
    "buoy.submergence": ("part of the buoy that the water loads", f"{PAPER}, eq. (30): the whole sphere at any height"),
    "buoy.impact_loss": ("share of an impact's energy that goes into spray", "not in the paper"),
    "water.depth_m": ("water depth H", f"{UNSTATED}; chosen because both cases of the paper come out as described"),
    "water.density_kgpm3": (
        f"water density {RHO_W}",
        f"{UNSTATED}; the value for which {M_A} = 907 kg is half the displaced mass",
    ),
    "waves.period_s": (f"wave period {T_I}", TEXT_42),
    "waves.steepness": ("wave steepness kA", TEXT_42),
    "waves.amplitude_m": ("wave amplitude A", TEXT_42),
    "waves.ramp_s": ("time over which the wave grows", f"{PAPER}, section 4.2.1: impulsive start"),
    "waves.phase_rad": ("wave phase at t = 0, x = 0", f"{UNSTATED}; {NUMERICAL}"),
    "waves.direction_rad": ("direction of travel", f"{PAPER}, figure 8"),
    "waves.above_still_water": (
        "wave motion above the still-water line",
        f"{UNSTATED}; linear theory extrapolated, codes differ here",
    ),
    "current.law": ("current", "none in the paper"),
    "motion.dimensions": ("dimensions of the motion", f"{TEXT_42}: planar under planar waves"),
    "start.buoy_velocity_mps": ("buoy velocity at t = 0", f"{PAPER}, section 4.2: static solution at rest"),
    "solver.scheme": ("form of the equations", f"{NUMERICAL}; the paper's equations, conservation form"),
    "solver.integrator": ("time integration", f"{NUMERICAL}; the paper uses the box rule"),
    "solver.rtol": ("relative error tolerance of a step", NUMERICAL),
    "solver.step_s": ("fixed time step", NUMERICAL),
    "solver.courant": ("fixed time step over the time a wave takes through the shortest element", NUMERICAL),
    "solver.shock_viscosity.quadratic": ("viscosity confined to shocks, quadratic coefficient", NUMERICAL),
    "solver.shock_viscosity.linear": ("viscosity confined to shocks, linear coefficient", NUMERICAL),
    "solver.max_step_s": ("longest time step", NUMERICAL),
    "solver.min_step_s": ("shortest time step", NUMERICAL),
    "solver.newton_tolerance": ("Newton tolerance", NUMERICAL),
    "solver.max_newton_iterations": ("most Newton iterations a step", NUMERICAL),
    "solver.growth_per_step": ("most growth of a buckle in a step (e-folds)", NUMERICAL),
    "solver.spectral_radius": ("spectral radius (generalized-alpha only)", NUMERICAL),
    "solver.loop_release": ("release of loops that a plane cannot open", NUMERICAL),
    "solver.max_loop_releases": ("most loop releases a run", NUMERICAL),
    "output.step_s": ("output step", NUMERICAL),
    "output.energy": ("energy budget kept (dry lines)", NUMERICAL),
    "output.profiles": ("profiles along the tether kept", NUMERICAL),
    "output.profiles_step_s": ("output step of the profiles", NUMERICAL),
    "output.tangent_vectors": ("perturbations carried along (Lyapunov exponents)", NUMERICAL),
    "output.lateral_growth": ("perturbation across the plane carried along", NUMERICAL),
}

# suffix of a key: the unit in print
_UNITS = {
    "_mps2": "m/s²",
    "_kgpm3": "kg/m³",
    "_radps": "rad/s",
    "_Nm2": "N\u00a0m²",
    "_mps": "m/s",
    "_m2": "m²",
    "_kg": "kg",
    "_rad": "rad",
    "_m": "m",
    "_s": "s",
    "_N": "N",
}


def unit_of(key: str) -> str:
    """The unit that the suffix of a key or column names, "–" for none.

    >>> unit_of("tether.bending_stiffness_Nm2"), unit_of("buoy.drag")
    ('N\xa0m²', '–')
    """
    return next((unit for suffix, unit in _UNITS.items() if key.endswith(suffix)), "–")
