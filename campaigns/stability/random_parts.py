"""What `campaigns.stability.random_scenes` puts into scenes: parts that somebody could mean, extremes, junk, faults."""

import math

_LINES = ("breaking_line", "falling_chain", "hanging_line", "shaken_line", "swinging_line", "twisted_rope")
_SEA = {"period_s": 5.0, "jonswap": {"significant_height_m": 0.5, "components": 10}}
_BUOYS = (  # changes of the keys of the tethered buoy
    {}, {"motion.dimensions": 3}, {"solver.scheme": "paper-box"}, {"buoy.submergence": "spherical-cap"},
    {"output.tangent_vectors": 2, "output.lateral_growth": True}, {"start.buoy_velocity_mps": [1.0, 0.0, -1.0]},
    {"waves": _SEA},
)  # fmt: skip
BASES = (*(("tethered_buoy", changes) for changes in _BUOYS), *((name, {}) for name in _LINES))
_TABLE = {"law": "tabulated", "strain": [-0.5, 0.0, 0.1, 0.3], "tension_N": [-1e3, 0.0, 1e3, 1e3]}
_WAVE = {"period_s": 4.0, "ramp_s": 1.0}
_WAVELET = {"period_s": 3.0, "amplitude_m": 0.2, "phase_rad": 1.0, "direction_rad": math.pi}
_BLOCK = [[[0.1, 0.2], [0.3, 0.4], [0.5, 0.6]], [[0.6, 0.5], [0.4, 0.3], [0.2, 0.1]]]
_PROFILE = {"law": "profile", "height_m": [0.0, 10.0], "velocity_mps": [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0]]}
_MOVED = {
    "law": "table",
    "time_s": [0.0, 1.0, 3.0],
    "displacement_m": [[0.0, 0.0, 0.0], [0.2, 0.0, 0.1], [0.0, 0.0, -0.1]],
}
_SHAKEN = {"law": "harmonic", "amplitude_m": [0.1, 0.0, 0.1], "period_s": 2.0, "ramp_s": 1.0}
PARTS = {  # key: what may stand there, None for nothing
    "gravity_mps2": (0.0, 1.6, 9.81),
    "motion.dimensions": (2, 3, 3),
    "tether.bending_stiffness_Nm2": (0.0, 0.1, 100.0),
    "tether.torsion_stiffness_Nm2": (0.0, 1.0),
    "tether.grid_stretching": (0.0, 1.0, 3.0),
    "tether.grid_refined": ("both", "lower", "upper"),
    "tether.compression_barrier_N": (0.0, 100.0),
    "tether.tension": (
        {"law": "linear", "stiffness_N": 1e4}, {"law": "tanh", "p": [5e3, 5.0, -0.5, 2310.6, 1e3]}, _TABLE,
    ),
    "buoy.submergence": ("full", "spherical-cap"),
    "buoy.impact_loss": (0.0, 0.5, 1.0),
    "end.motion": (None, _MOVED, _SHAKEN),
    "end.release_s": (None, 0.1),
    "end.force_decay_s": (None, 0.05),
    "end.rotation": ("pinned", "clamped"),
    "anchor.rotation": ("pinned", "clamped"),
    "water": (None, {"depth_m": 25.0, "density_kgpm3": 1027.0}),
    "waves": (
        None, {**_WAVE, "steepness": 0.1}, {**_WAVE, "amplitude_m": 0.5}, {**_WAVE, "components": [_WAVELET, _WAVELET]},
        _SEA,
    ),
    "waves.above_still_water": ("extrapolate", "zero", "wheeler"),
    "waves.direction_rad": (0.0, math.pi, 1.0),
    "current": (
        None, {"law": "uniform", "velocity_mps": [1.0, 0.0, 0.1]},
        _PROFILE,
        {"law": "table", "x_m": [-10.0, 10.0], "height_m": [0.0, 10.0, 20.0], "time_s": [0.0, 5.0],
         "velocity_x_mps": _BLOCK, "velocity_z_mps": _BLOCK},
    ),
    "start.buoy_velocity_mps": ([1.0, 0.0, -1.0], [0.0, 1e-6, 0.0]),
    "solver": (
        {}, {"scheme": "paper-box"}, {"integrator": "trbdf2", "rtol": 0.01, "loop_release": False},
        {"integrator": "midpoint", "step_s": 0.01}, {"integrator": "backward-euler", "courant": 2.0},
        {"integrator": "generalized-alpha", "step_s": 0.01, "spectral_radius": 0.8},
        {"integrator": "generalized-alpha", "courant": 1.0, "shock_viscosity": {"quadratic": 1.0, "linear": 0.2}},
    ),
    "output": (
        {}, {"profiles": True}, {"step_s": 0.02, "energy": True}, {"tangent_vectors": 2, "lateral_growth": True},
        {"lateral_growth": True},
    ),
}  # fmt: skip
EXTREMES = (5e-324, 1e-310, 1e-200, 1e-30, 1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e12, 1e30, 1e150, 1e200, 1.7e308, 0.0, -0.0)
JUNK = (None, True, False, "", "text", "1.0", "\x00", "ü" * 300, [], [1.0], [[]], {}, {"a": 1}, -1, -1e-300, 0, 1.5)
JUNK += (math.nan, math.inf, -math.inf, 10**400, -(10**400), [math.nan] * 3, [1.0] * 7, {"law": "linear"}, {"law": 3})
UNKNOWN = ("lenght_m", "x", "", "a.b", "law", "nodes", "\n")
BROKEN_RULES = (
    ("tether", "nodes", 2),
    ("tether", "tension", {"law": "tabulated", "strain": [0.0, 0.0], "tension_N": [0.0, 1.0]}),
    ("tether", "tension", {"law": "tanh", "p": [1.0, -2.0, 0.0, 0.0, 1.0]}),
    ("waves", "steepness", -0.1),
    ("waves", "direction_rad", 1.0),
    ("current", "law", "table"),
    ("end", "kind", "free"),
    ("end", "kind", "held"),
    ("end", "twist_rad", 3.0),
    ("motion", "dimensions", 2),
    ("start", "buoy_velocity_mps", [0.0, 1.0, 0.0]),
    ("solver", "min_step_s", 1.0),
    ("solver", "courant", 1.0),
    ("output", "profiles_step_s", 0.1),
    ("output", "tangent_vectors", 10**9),
)
