"""Random scenes as strategies of Hypothesis: drawn section by section, of sizes that somebody could mean.

Most of them keep every rule between their values; `campaigns.stability.random_faults` draws the others again, and puts
extreme numbers and faults into them.
"""

import math

from hypothesis import strategies as st


def size(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers whose logarithm is drawn evenly enough."""
    return st.floats(math.log(low), math.log(high)).map(math.exp)


def none_or(low: float, high: float) -> st.SearchStrategy[float]:
    """Zero, or a size."""
    return st.just(0.0) | size(low, high)


def one_of(*values: object) -> st.SearchStrategy:
    """One of these values."""
    return st.sampled_from(values)


def vector(scale: float, space: bool) -> st.SearchStrategy[list[float]]:
    """Vectors [x, y, z] of up to that length an axis; y is 0 in a plane."""
    axis = st.floats(-1.0, 1.0).map(lambda share: round(share, 6) * scale)
    return st.tuples(axis, axis if space else st.just(0.0), axis).map(list)


def increasing(low: float, high: float, count: int) -> st.SearchStrategy[list[float]]:
    """That many increasing numbers from low to high."""
    shares = st.lists(st.floats(0.1, 1.0), min_size=count - 1, max_size=count - 1)
    return shares.map(
        lambda parts: [low + (high - low) * sum(parts[:i]) / sum(parts) for i in range(count - 1)] + [high]
    )


def record(optional: dict | None = None, **needed: st.SearchStrategy) -> st.SearchStrategy[dict]:
    """Dictionaries with every needed entry and some of the optional ones."""
    return st.fixed_dictionaries(needed, optional=optional or {})


def tanh_law(scale: float, turn: float, shift: float) -> dict:
    """A law without tension at no strain."""
    return {"law": "tanh", "p": [0.1 * scale, turn, shift, -0.1 * scale * math.tanh(shift), 0.5 * scale]}


def table_law(scale: float, below: list[float], above: list[float]) -> dict:
    """A table without tension at no strain, flat beyond a strain of 0.4."""
    strain = [*below, *above[1:]]
    return {"law": "tabulated", "strain": strain, "tension_N": [scale * min(value, 0.4) for value in strain]}


SCALE = size(1e2, 1e7)
KNOTS = st.tuples(st.floats(-0.9, -0.1), st.integers(2, 4)).flatmap(lambda ends: increasing(ends[0], 0.0, ends[1]))
TENSION = (
    record(law=st.just("linear"), stiffness_N=SCALE)
    | st.builds(tanh_law, SCALE, st.floats(1.0, 20.0), st.floats(-3.0, 1.0))
    | st.builds(table_law, SCALE, KNOTS, st.integers(2, 5).flatmap(lambda count: increasing(0.0, 0.8, count)))
)
TETHER = record(
    length_m=size(0.2, 300.0), area_m2=size(1e-6, 1e-2), density_kgpm3=size(10.0, 2e4), nodes=st.integers(3, 61),
    torsion_stiffness_Nm2=none_or(1e-4, 1e3), drag_normal=one_of(0.0, 1.0, 2.5), drag_tangential=one_of(0.0, 0.1, 1.0),
    added_mass=one_of(0.0, 1.0, 5.0), tension=TENSION, bending_stiffness_Nm2=size(1e-4, 1e4) | none_or(1e-4, 1e4),
    optional={
        "grid_stretching": st.floats(0.1, 3.0),
        "diameter_m": size(1e-3, 0.3), "compression_barrier_N": size(1.0, 1e5),
    },
)  # fmt: skip
IMPLICIT = one_of("midpoint", "backward-euler", "generalized-alpha")
EXTRAS = {
    "spectral_radius": st.floats(0.0, 1.0), "loop_release": one_of(True, False), "newton_tolerance": size(1e-10, 1e-2),
}  # fmt: skip
SHOCK = record(quadratic=size(1e-3, 2.0), linear=none_or(1e-3, 1.0))
SOLVERS = (
    st.just({}),
    record({**EXTRAS, "rtol": size(1e-4, 0.3)}, integrator=one_of("esdirk43", "trbdf2")),
    record({**EXTRAS, "shock_viscosity": SHOCK, "step_s": size(1e-3, 0.1)}, integrator=IMPLICIT),
    record(EXTRAS, integrator=IMPLICIT, courant=size(0.1, 20.0)),
)
OUTPUTS = (st.just({}), record({"step_s": size(1e-3, 1.0)}, profiles=st.just(True)))
PAPER_BOX, PERTURBED = (
    {"scheme": "paper-box"},
    record(tangent_vectors=st.integers(1, 3), lateral_growth=one_of(True, False)),
)


def ends_of(length_m: float, space: bool) -> dict[str, st.SearchStrategy[dict]]:
    """Sections of the upper end: a buoy, a held end that moves, is let go or clamped, or a free one under a force."""
    buoy = {
        "diameter_m": size(0.05, 3.0), "mass_kg": size(0.01, 1e5), "added_mass_kg": none_or(0.01, 1e5),
        "drag": one_of(0.0, 0.2, 1.0),
    }  # fmt: skip
    cap = record(**buoy, submergence=st.just("spherical-cap"), impact_loss=one_of(0.0, 0.5, 1.0))
    kick = {"start": record(buoy_velocity_mps=vector(1e-6, space) | vector(10.0, space))}
    shaken = record(
        law=st.just("harmonic"), amplitude_m=vector(0.1 * length_m, space), period_s=size(0.1, 20.0),
        ramp_s=one_of(0.0, 1.0),
    )  # fmt: skip
    places = st.lists(vector(0.3 * length_m, space), min_size=3, max_size=3).map(lambda rest: [[0.0] * 3, *rest])
    moved = record(law=st.just("table"), time_s=increasing(0.0, 5.0, 4), displacement_m=places)
    clamped = {"rotation": st.just("clamped"), "twist_rad": st.floats(-9.0, 9.0), "twist_ramp_s": one_of(0.0, 1.0)}
    held = {"kind": st.just("held"), "position_m": vector(length_m, space)}
    force = vector(0.1, space) | vector(1e2, space) | vector(1e5, space)
    return {
        "buoy": record(kick, buoy=record(**buoy)),
        "cap": record(kick, buoy=cap),
        "held": record(end=record({"motion": shaken | moved}, **held)),
        "let go": record(end=record({"force_N": vector(10.0, space)}, release_s=size(0.01, 1.0), **held)),
        "free": record(end=record({"force_decay_s": size(1e-3, 1.0)}, kind=st.just("free"), force_N=force)),
        "clamped": record(anchor=record(rotation=st.just("clamped")), end=record(clamped, **held)),
    }


def waves_of(depth_m: float, space: bool) -> dict[str, st.SearchStrategy[dict | None]]:
    """Sections of the waves in water of that depth."""
    heading = st.floats(-3.0, 3.0) if space else one_of(0.0, math.pi)
    over = {"ramp_s": one_of(0.0, 5.0), "above_still_water": one_of("extrapolate", "zero", "wheeler")}
    wave = {"period_s": size(0.5, 60.0)}
    height = none_or(1e-3 * depth_m, 0.2 * depth_m)
    spectrum = record(
        significant_height_m=size(0.01 * depth_m, 0.3 * depth_m), peak_enhancement=st.floats(1.0, 7.0),
        components=st.integers(1, 40), seed=st.integers(0, 99),
    )  # fmt: skip
    part = record(**wave, amplitude_m=height, phase_rad=st.floats(-4.0, 4.0), direction_rad=heading)
    regular = {"direction_rad": heading, **over}
    return {
        "none": st.none(),
        "steep": record(regular, **wave, steepness=none_or(1e-3, 0.4)),
        "high": record(regular, **wave, amplitude_m=height),
        "sea": record(regular, **wave, jonswap=spectrum),
        "parts": record(over, **wave, components=st.lists(part, min_size=1, max_size=4)),
    }


def currents_of(depth_m: float, space: bool) -> dict[str, st.SearchStrategy[dict | None]]:
    """Sections of the current in water of that depth."""
    speed = vector(5.0, space)
    block = st.floats(-5.0, 5.0)
    for count in (2, 3, 2):  # x, height, time
        block = st.lists(block, min_size=count, max_size=count)
    heights = st.lists(speed, min_size=4, max_size=4)
    return {
        "none": st.none(),
        "uniform": record(law=st.just("uniform"), velocity_mps=speed),
        "profile": record(law=st.just("profile"), height_m=increasing(0.0, depth_m, 4), velocity_mps=heights),
        "table": record(
            law=st.just("table"), x_m=st.just([-10.0, 10.0]), height_m=increasing(0.0, depth_m, 3),
            time_s=st.just([0.0, 5.0]), velocity_x_mps=block, velocity_z_mps=block,
        ),
    }  # fmt: skip


@st.composite
def plain_scene(draw) -> dict:
    """A scene of sizes that somebody could mean, as nested dicts; the kinds of its parts are drawn first."""
    space, wet = draw(one_of(False, False, True)), draw(one_of(True, True, False))
    waves, current = (
        draw(one_of("none", "steep", "high", "sea", "parts")),
        draw(one_of("none", "uniform", "profile", "table")),
    )
    end = draw(
        one_of("buoy", "held", "let go", "free", "free", *(["cap"] if wet else []), *(["clamped"] * 2 if space else []))
    )
    solver, output = draw(st.integers(0, len(SOLVERS) - 1)), draw(st.integers(0, len(OUTPUTS) - 1))
    special = draw(one_of(*["none"] * 4, *([] if space else ["perturbed", "paper-box"])))
    raw = {"name": "random", "gravity_mps2": draw(one_of(9.81, 9.81, 1.6, 0.0)), "tether": draw(TETHER)}
    raw |= {
        "motion": {"dimensions": 3 if space else 2},
        "solver": draw(SOLVERS[solver]),
        "output": draw(OUTPUTS[output]),
    }
    raw |= draw(ends_of(raw["tether"]["length_m"], space)[end])
    if wet:
        depth_m = draw(size(0.5, 500.0))
        parts = {"waves": draw(waves_of(depth_m, space)[waves]), "current": draw(currents_of(depth_m, space)[current])}
        raw["water"] = {"depth_m": depth_m, "density_kgpm3": draw(one_of(1027.0, 1027.0, 1.2, 13500.0))}
        raw |= {name: part for name, part in parts.items() if part is not None}
    if special == "perturbed":
        raw |= {"solver": {}, "output": draw(PERTURBED)}
    elif special == "paper-box":
        raw["solver"] = dict(PAPER_BOX)
    return raw
