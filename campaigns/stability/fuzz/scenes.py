"""Random valid scenes for `campaigns.stability.fuzz`: the same seed and number give the same scene.

Drawn section by section so that every rule between values holds. What extremes and faults are put into them:
`campaigns.stability.fuzz.faults`.
"""

import math

import numpy as np

MOST_NODES = 61


def log_uniform(rng, low, high):
    """A number between low and high, its logarithm evenly spread."""
    return float(math.exp(rng.uniform(math.log(low), math.log(high))))


def maybe(rng, share):
    """True in that share of the draws."""
    return bool(rng.random() < share)


def pick(rng, *choices):
    """One of the choices, all alike."""
    return choices[int(rng.integers(len(choices)))]


def vector(rng, size, space):
    """A vector [x, y, z] of about that size; y is 0 in a plane."""
    drawn = rng.normal(size=3) * size / math.sqrt(3)
    return [float(drawn[0]), float(drawn[1]) if space else 0.0, float(drawn[2])]


def increasing(rng, low, high, count):
    """That many increasing numbers from low to high."""
    return [float(x) for x in np.cumsum(np.r_[low, (high - low) * rng.dirichlet(np.ones(count - 1))])]


def plain_scene(rng):
    """A random valid scene of sizes that somebody could mean, as nested dicts."""
    space = maybe(rng, 0.35)
    raw = {"name": "fuzz", "gravity_mps2": pick(rng, 9.81, 9.81, 1.6, 0.0), "motion": {"dimensions": 3 if space else 2}}
    raw["tether"] = _tether(rng)
    kind = pick(rng, "buoy", "buoy", "held", "free")
    _end(rng, raw, kind, space)
    if maybe(rng, 0.7):
        _water(rng, raw, space)
    raw["solver"] = _solver(rng)
    raw["output"] = {"profiles": True} if maybe(rng, 0.2) else {}
    if maybe(rng, 0.3):
        raw["output"]["step_s"] = log_uniform(rng, 1e-3, 1.0)
    _allowed_together(rng, raw)
    return raw


def _tether(rng):
    tether = {
        "length_m": log_uniform(rng, 0.2, 300.0),
        "area_m2": log_uniform(rng, 1e-6, 1e-2),
        "density_kgpm3": log_uniform(rng, 10.0, 2e4),
        "nodes": round(log_uniform(rng, 3, MOST_NODES)),
        "bending_stiffness_Nm2": 0.0 if maybe(rng, 0.15) else log_uniform(rng, 1e-4, 1e4),
        "torsion_stiffness_Nm2": 0.0 if maybe(rng, 0.5) else log_uniform(rng, 1e-4, 1e3),
        "drag_normal": pick(rng, 0.0, 1.0, 2.5),
        "drag_tangential": pick(rng, 0.0, 0.1, 1.0),
        "added_mass": pick(rng, 0.0, 1.0, 5.0),
        "tension": _tension(rng),
    }
    if maybe(rng, 0.2):
        tether |= {"grid_stretching": float(rng.uniform(0.1, 3.0)), "grid_refined": pick(rng, "both", "lower", "upper")}
    if maybe(rng, 0.2):
        tether["diameter_m"] = log_uniform(rng, 1e-3, 0.3)
    if maybe(rng, 0.2):
        tether["compression_barrier_N"] = log_uniform(rng, 1.0, 1e5)
    return tether


def _tension(rng):
    law, size = pick(rng, "linear", "linear", "tanh", "tabulated"), log_uniform(rng, 1e2, 1e7)
    if law == "linear":
        return {"law": "linear", "stiffness_N": size}
    if law == "tanh":
        turn, shift = float(rng.uniform(1.0, 20.0)), float(rng.uniform(-3.0, 1.0))
        return {
            "law": "tanh",
            "p": [0.1 * size, turn, shift, -0.1 * size * math.tanh(shift), float(rng.uniform(0, size))],
        }
    below, above = int(rng.integers(1, 4)), int(rng.integers(1, 5))
    strain = [
        *increasing(rng, -float(rng.uniform(0.1, 0.9)), 0.0, below + 1),
        *increasing(rng, 0.0, 0.8, above + 1)[1:],
    ]
    force = np.cumsum(rng.exponential(0.1 * size, len(strain)) * (rng.random(len(strain)) < 0.8))
    return {"law": "tabulated", "strain": strain, "tension_N": [float(x) for x in force - force[below]]}


def _end(rng, raw, kind, space):
    length = raw["tether"]["length_m"]
    if kind == "buoy":
        diameter = log_uniform(rng, 0.05, 3.0)
        mass = 520.0 * diameter**3 * log_uniform(rng, 0.05, 5.0)
        raw["buoy"] = {
            "diameter_m": diameter, "mass_kg": mass, "added_mass_kg": mass * pick(rng, 0.0, 0.5),
            "drag": pick(rng, 0.0, 0.2, 1.0),
        }  # fmt: skip
        if maybe(rng, 0.4):
            raw["start"] = {"buoy_velocity_mps": vector(rng, log_uniform(rng, 1e-6, 10.0), space)}
    elif kind == "held":
        raw["end"] = {"kind": "held", "position_m": vector(rng, length * float(rng.uniform(0.1, 1.2)), space)}
        if maybe(rng, 0.4):
            raw["end"]["motion"] = {
                "law": "harmonic", "amplitude_m": vector(rng, 0.1 * length, space),
                "period_s": log_uniform(rng, 0.1, 20.0), "ramp_s": pick(rng, 0.0, 1.0),
            }  # fmt: skip
        elif maybe(rng, 0.3):
            places = [[0.0, 0.0, 0.0], *(vector(rng, 0.3 * length, space) for _ in range(3))]
            raw["end"]["motion"] = {"law": "table", "time_s": increasing(rng, 0.0, 5.0, 4), "displacement_m": places}
        if maybe(rng, 0.3):
            raw["end"]["release_s"] = log_uniform(rng, 0.01, 1.0)
            if maybe(rng, 0.5):
                raw["end"]["force_N"] = vector(rng, 10.0, space)
        if space and maybe(rng, 0.4):
            raw["anchor"] = {"rotation": "clamped"}
            if maybe(rng, 0.5):
                raw["end"] |= {
                    "rotation": "clamped",
                    "twist_rad": float(rng.normal() * 3),
                    "twist_ramp_s": pick(rng, 0.0, 1.0),
                }
    else:
        raw["end"] = {"kind": "free", "force_N": vector(rng, log_uniform(rng, 0.1, 1e5), space)}
        if maybe(rng, 0.4):
            raw["end"]["force_decay_s"] = log_uniform(rng, 1e-3, 1.0)


def _water(rng, raw, space):
    raw["water"] = {"depth_m": log_uniform(rng, 0.5, 500.0), "density_kgpm3": pick(rng, 1027.0, 1027.0, 1.2, 13500.0)}
    if raw["gravity_mps2"] > 0 and maybe(rng, 0.7):
        heading = float(rng.uniform(-3, 3)) if space else pick(rng, 0.0, math.pi)
        raw["waves"] = {
            "period_s": log_uniform(rng, 0.5, 60.0),
            "direction_rad": heading,
            "ramp_s": pick(rng, 0.0, 0.0, 5.0),
        }
        if maybe(rng, 0.25):
            _sea(rng, raw, space)
        elif maybe(rng, 0.7):
            raw["waves"]["steepness"] = float(rng.uniform(0.0, 0.4))
        else:
            raw["waves"]["amplitude_m"] = float(rng.uniform(0.0, 0.2)) * raw["water"]["depth_m"]
        raw["waves"]["above_still_water"] = pick(rng, "extrapolate", "zero", "wheeler")
    law = pick(rng, None, None, "uniform", "profile", "table")
    speed, depth = log_uniform(rng, 0.01, 5.0), raw["water"]["depth_m"]
    if law == "uniform":
        raw["current"] = {"law": law, "velocity_mps": vector(rng, speed, space)}
    elif law == "profile":
        heights = increasing(rng, 0.0, depth, 4)
        raw["current"] = {"law": law, "height_m": heights, "velocity_mps": [vector(rng, speed, space) for _ in heights]}
    elif law == "table":
        block = (speed * rng.normal(size=(2, 3, 2))).tolist()
        raw["current"] = {
            "law": law, "x_m": [-10.0, 10.0], "height_m": increasing(rng, 0.0, depth, 3), "time_s": [0.0, 5.0],
            "velocity_x_mps": block, "velocity_z_mps": block,
        }  # fmt: skip


def _sea(rng, raw, space):
    """An irregular sea in the place of the regular wave."""
    waves, depth = raw["waves"], raw["water"]["depth_m"]
    if maybe(rng, 0.5):
        waves["jonswap"] = {
            "significant_height_m": float(rng.uniform(0.01, 0.3)) * depth, "peak_enhancement": float(rng.uniform(1, 7)),
            "components": int(rng.integers(1, 40)), "seed": int(rng.integers(100)),
        }  # fmt: skip
        return
    del waves["direction_rad"]
    waves["components"] = [
        {
            "period_s": log_uniform(rng, 0.5, 60.0), "amplitude_m": 0.05 * float(rng.random()) * depth,
            "phase_rad": float(rng.uniform(-4, 4)),
            "direction_rad": float(rng.uniform(-3, 3)) if space else pick(rng, 0.0, math.pi),
        }
        for _ in range(int(rng.integers(1, 5)))
    ]  # fmt: skip


def _solver(rng):
    solver = {}
    if maybe(rng, 0.4):
        solver["integrator"] = pick(rng, "esdirk43", "trbdf2", "midpoint", "backward-euler", "generalized-alpha")
    if maybe(rng, 0.3):
        solver["rtol"] = log_uniform(rng, 1e-4, 0.3)
    if maybe(rng, 0.2):
        solver["step_s"] = log_uniform(rng, 1e-3, 0.1)
    elif solver.get("integrator") in ("midpoint", "backward-euler", "generalized-alpha") and maybe(rng, 0.3):
        solver["courant"] = log_uniform(rng, 0.1, 20.0)
    if maybe(rng, 0.1):
        solver["spectral_radius"] = float(rng.random())
    if maybe(rng, 0.1):
        solver["shock_viscosity"] = {"quadratic": float(rng.uniform(0, 2)), "linear": float(rng.uniform(0, 1))}
    if maybe(rng, 0.1):
        solver["loop_release"] = False
    if maybe(rng, 0.1):
        solver["newton_tolerance"] = log_uniform(rng, 1e-10, 1e-2)
    return solver


def _allowed_together(rng, raw):
    """Put right what the draws above could not know of each other, and add what depends on everything."""
    tether, solver, end = raw["tether"], raw["solver"], raw.get("end", {"kind": "buoy"})
    space = raw["motion"]["dimensions"] == 3
    clamped = [part for part in (raw.get("anchor", {}), end) if part.get("rotation") == "clamped"]
    unguided = end.get("release_s") is not None and not any(end.get("force_N") or ())
    if (clamped or unguided) and tether["bending_stiffness_Nm2"] == 0.0:
        tether["bending_stiffness_Nm2"] = 0.1
    if len(clamped) == 2 and tether["torsion_stiffness_Nm2"] == 0.0:
        tether["torsion_stiffness_Nm2"] = 0.1
    bent, fixed = tether["bending_stiffness_Nm2"] > 0, solver.get("integrator") in ("midpoint", "generalized-alpha")
    if bent and not clamped and "shock_viscosity" not in solver and not space and maybe(rng, 0.15):
        if maybe(rng, 0.4) and _paper_takes(raw):
            solver["scheme"] = "paper-box"
        elif not fixed:
            raw["output"] |= {"tangent_vectors": int(rng.integers(0, 4)), "lateral_growth": maybe(rng, 0.5)}

    regular = not {"jonswap", "components"} & set(raw.get("waves", ()))
    if "water" in raw and "buoy" in raw and regular and "scheme" not in solver and maybe(rng, 0.4):
        raw["buoy"] |= {"submergence": "spherical-cap", "impact_loss": pick(rng, 0.0, 0.5, 1.0)}


def _paper_takes(raw):
    return "compression_barrier_N" not in raw["tether"] and "integrator" not in raw["solver"]
