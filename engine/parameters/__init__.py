"""Scene -> numbers: a record of scalars (`engine.record`) and a share of one flat array of tables.

This is the only place where configuration is read for the kernels. A batch is an array of records and one `tables`
array; each record knows where its grid, its tension table, its current and its method begin.

In the paper: eq. (9) mass of a stretched element; eq. (10) area of a stretched element.
"""

import math

import numpy as np

from .. import record as codes
from ..physics import drag, ends, sea, tension, waves
from ..physics.sea_basis import few_waves
from ..physics.sea_series import LEFT_OUT, reach_of
from ..physics.sea_sum import STILL
from ..scene.models import Scene
from ..spatial import lift
from ..time import integrators
from . import scales
from .cover import has_rare_laws, is_plain

NOT_STRETCHED = 1e-6  # below this spacings differ by less than 1e-12, and the quotients of tanh lose their digits


def grid(length_m: float, nodes: int, stretching: float, refined: str = "both") -> np.ndarray:
    """Element lengths (nodes - 1,), m, at even xi; b = 0 (or next to nothing) even elements.

    Finer at both ends s(xi) = L/2 (1 + tanh(b (2 xi - 1))/tanh b), at the lower one L (1 + tanh(b (xi - 1))/tanh b), at
    the upper one L tanh(b xi)/tanh b.
    """
    xi = np.linspace(0.0, 1.0, nodes)
    if stretching < NOT_STRETCHED:
        return np.diff(length_m * xi)
    inside = {"both": 2 * xi - 1, "lower": xi - 1, "upper": xi}[refined]
    s = np.tanh(stretching * inside) / np.tanh(stretching)
    return np.diff(length_m * {"both": 0.5 * (1 + s), "lower": 1 + s, "upper": s}[refined])


def numbers_of(scene: Scene) -> tuple[np.void, np.ndarray]:
    """The parameter record of a scene that goes alone, and its tables as one array."""
    tables: list[np.ndarray] = []
    record = record_of(scene, tables)[0]
    return record, np.concatenate(tables)


def record_of(scene: Scene, tables: list[np.ndarray]) -> np.ndarray:
    """One parameter record; appends the scene's tables to the list of arrays `tables`.

    Returns a (1,) structured array of dtype `RECORD`, `PLAIN` or `EXTRA`; of `SPATIAL` or `EXTRA_SPATIAL` for
    motion.dimensions = 3.
    """
    extras = has_rare_laws(scene)
    if scene.motion.dimensions == 3:
        p = np.zeros(1, codes.EXTRA_SPATIAL if extras else codes.SPATIAL)
    else:
        p = np.zeros(1, codes.EXTRA if extras else codes.PLAIN if is_plain(scene) else codes.RECORD)
    record = p[0]

    def place(values):
        at = sum(part.size for part in tables)
        tables.append(np.asarray(values, float).ravel())
        return at

    tether = scene.tether
    h = grid(tether.length_m, tether.nodes, tether.grid_stretching, tether.grid_refined)
    _fill(record, nodes=tether.nodes, grid_at=place(h))
    _tether(record, scene, place)
    _water(record, scene, place)
    _end(record, scene, place)
    if codes.is_spatial(p):
        _turning(record, scene)
    _solver(record, scene, place, h)
    if extras:
        _extras(record, scene)
    return p


def _fill(record, **numbers):
    """Numbers into the fields of these names."""
    for name, number in numbers.items():
        record[name] = number


def _extras(record, scene):
    """What only the laws of `engine.physics.extras` have."""
    for axis, place in zip("xyz", scene.anchor.position_m, strict=True):
        record[f"anchor_{axis}"] = place
    tether, floor = scene.tether, scene.floor
    record["damping"] = tether.damping_Ns or 0.0
    if tether.damping_critical:  # c = zeta l sqrt(T' m), l the mean element
        element = tether.length_m / (tether.nodes - 1)
        record["damping"] = tether.damping_critical * element * record["m"] * scales.fastest_wave(record, scene)
    if tether.froude_krylov == "whole":  # of R, what acts along the line too
        _fill(record, pushed=record["Rw"] - record["ma"], Rw=record["ma"])
    if tether.submergence == "free-surface":
        buoyed = scene.water.density_kgpm3 * tether.area_m2 * scene.gravity_mps2
        _fill(record, surfaced=True, buoyed=buoyed)
    if floor is not None:
        stiffness, weight = floor.stiffness_Npm3 * tether.diameter_m, abs(record["w0"]) or record["m"]
        _fill(
            record,
            floored=True,
            bed_stiffness=stiffness,
            bed_damping=floor.damping_Nspm3 * tether.diameter_m,
            bed_friction=floor.friction,
            bed_speed=floor.friction_speed_mps,
            bed_onset=weight / stiffness,  # the depth of the line's own weight
        )


def _tether(record, scene, place):
    tether = scene.tether
    wet = scene.water is not None
    rho_w = scene.water.density_kgpm3 if wet else 0.0
    d = tether.diameter_m
    displaced = rho_w * math.pi * d**2 / 4
    added_mass = tether.added_mass * displaced
    _fill(
        record,
        m=tether.density_kgpm3 * tether.area_m2,
        w0=(tether.density_kgpm3 - rho_w) * tether.area_m2 * scene.gravity_mps2,
        EI=tether.bending_stiffness_Nm2,
        bent=tether.bending_stiffness_Nm2 > 0,
        wet=wet,
        ct=0.5 * rho_w * math.pi * d * tether.drag_tangential,
        cn=0.5 * rho_w * d * tether.drag_normal,
        ma=added_mass,
        Rw=displaced + added_mass,
        barrier=tether.compression_barrier_N,
        diameter=d,
        law=tension.NAMES.index(tether.tension.law),
        drag=drag.NAMES.index("quadratic" if tether.drag is None else tether.drag.law),
    )
    _law(record, tension.LAWS, "law", tether.tension, place)
    if tether.drag is not None:
        _law(record, drag.LAWS, "drag", tether.drag, place)


def _law(record, laws, field, section, place):
    """The numbers of a law, whose code the record has in `field`, and its table at field_at."""
    numbers, table = laws[record[field]].numbers(section)
    _fill(record, **numbers)
    if len(table):
        record[f"{field}_at"] = place(table)


def _water(record, scene, place):
    wave, current = scene.waves, scene.current
    if scene.water is not None:
        record["depth"] = scene.water.depth_m
    if wave is not None:
        periods, amplitudes, phases, _ = sea.components_of(scene)
        several = len(periods) > 1
        # of several waves the peak period, for what is measured in wave lengths; a sea of one wave is a regular wave
        period_s = wave.period_s if several else float(periods[0])
        above = {"extrapolate": codes.EXTRAPOLATE, "zero": codes.ZERO, "wheeler": codes.WHEELER}
        _fill(
            record,
            k=waves.wave_number(period_s, scene.water.depth_m, scene.gravity_mps2),
            omega=2 * math.pi / period_s,
            phase=phases[0],
            ramp=wave.ramp_s,
            waves=amplitudes.any(),
            amplitude=amplitudes[0],
            above=above[wave.above_still_water],
        )
        if codes.is_spatial(record):
            record["dir_x"], record["dir_y"] = sea.direction_of(wave.heading_rad)
        else:
            record["direction"] = math.cos(wave.heading_rad)  # 1 or -1: `scene.rules` allow no other in a plane
        if several:
            groups = sea.groups_of(scene)
            _fill(record, amplitude=0.0, sea_n=len(groups), sea_at=place(groups))
            if not codes.is_spatial(record):
                few = few_waves(scene)
                _fill(record, sea_few=len(few.groups), sea_few_at=place(few.groups), sea_wide=few.wide, sea_top=few.top)
                place(few.shares)
    if current is not None:
        _current(record, current, place)


def _current(record, current, place):
    if current.law == "table":
        x, y, z, t = current.x_m, current.y_m or (0.0,), current.height_m, current.time_s
        u, w = np.array(current.velocity_x_mps), np.array(current.velocity_z_mps)
        v = np.zeros_like(u) if current.velocity_y_mps is None else np.array(current.velocity_y_mps)
    else:
        x, y, t = (0.0,), (0.0,), (0.0,)
        z = current.height_m if current.law == "profile" else (0.0,)
        u, v, w = np.reshape(np.transpose(current.velocity_mps), (3, 1, -1, 1))
    _fill(
        record,
        current=u.any() or v.any() or w.any(),
        cur_nx=len(x),
        cur_ny=len(y),
        cur_nz=len(z),
        cur_nt=len(t),
        cur_at=place(np.concatenate([np.ravel(part) for part in (x, y, z, t, u, v, w)])),  # `physics.water`
    )


def _put(record, name, vector):
    """A vector [x, y, z] into the fields name_x or namex, ...; in a plane without y."""
    for axis, value in zip("xyz", vector, strict=True):
        if axis != "y" or codes.is_spatial(record):
            record[name + axis] = value


def _end(record, scene, place):
    end, buoy = scene.end, scene.buoy
    kinds = {"buoy": codes.BUOY, "held": codes.HELD, "free": codes.FREE}
    _fill(record, end=kinds[end.kind], end_release=math.inf)
    if end.kind == "free":
        _put(record, "end_", end.force_N)
        record["end_decay"] = end.force_decay_s or 0.0
    if end.kind == "held":
        _held(record, end, place)
    if end.kind != "buoy":
        return
    wet = scene.water is not None
    rho_w = scene.water.density_kgpm3 if wet else 0.0
    volume = math.pi * buoy.diameter_m**3 / 6
    added = buoy.added_mass_kg if wet else 0.0
    _fill(
        record,
        M_total=buoy.mass_kg + added,
        M_wave=rho_w * volume + added,  # what the acceleration of the water acts on
        lift=(rho_w * volume - buoy.mass_kg) * scene.gravity_mps2,
        C_buoy=0.5 * rho_w * buoy.drag * math.pi * buoy.diameter_m**2 / 4,
        spherical_cap=wet and buoy.submergence == "spherical-cap",
        D_buoy=buoy.diameter_m,
        M_added=added,
        impact_loss=buoy.impact_loss,
        B_whole=rho_w * volume * scene.gravity_mps2,
    )
    _put(record, "start_", scene.start.buoy_velocity_mps)


def _held(record, end, place):
    if end.release_s is not None:
        record["end_release"] = end.release_s
        _put(record, "end_f", end.force_N or (0.0, 0.0, 0.0))
    motion = end.motion
    if motion is None:
        return
    if motion.law == "table":
        table = ends.table_of(motion.time_s, motion.displacement_m)
        _fill(record, end_motion=codes.TABLE, end_n=len(motion.time_s), end_at=place(table))
        return
    shaken, R = motion.law == "harmonic", getattr(motion, "radius_m", 0.0)
    sine, cosine = (motion.amplitude_m, (0.0, 0.0, 0.0)) if shaken else ((0.0, 0.0, -R), (R, 0.0, 0.0))
    rows = [*sine, 2 * math.pi / motion.period_s, motion.phase_rad, motion.ramp_s, *cosine]  # `physics.ends`
    _fill(record, end_motion=codes.HARMONIC, end_at=place(rows))


def _turning(record, scene):
    """Torsion and clamps: what only three dimensions have."""
    anchor, end = scene.anchor, scene.end
    record["GI"] = scene.tether.torsion_stiffness_Nm2
    upwards = (0.0, 0.0, 1.0)
    chord = end.position_m if end.kind == "held" and any(end.position_m) else upwards
    for name, clamp in (("below", anchor), ("above", end)):
        record[f"clamp_{name}"] = clamp.rotation == "clamped"
        direction = np.array(clamp.direction or chord)
        _put(record, f"{name}_", direction / np.linalg.norm(direction))
    # Where no twist is: the rotation of the lower clamp into the upper one, by the shortest ways to the chord and on.
    # Straight from clamp to clamp would say the same of a line in a plane, but nothing where the clamps oppose each
    # other (a line that hangs between two vertical ones).
    way = np.array(chord) / np.linalg.norm(chord)
    below, above = ([float(record[f"{name}_{axis}"]) for axis in "xyz"] for name in ("below", "above"))
    carried = lift.product(lift.shortest_rotation(way, above), lift.shortest_rotation(below, way))
    for i, part in enumerate(carried):
        record[f"carry{i}"] = part
    _fill(record, twist=end.twist_rad or 0.0, twist_ramp=end.twist_ramp_s or 0.0)


def _solver(record, scene, place, h):
    solver = scene.solver
    method = integrators.METHODS[solver.integrator]
    record["adaptive"] = method.ADAPTIVE and solver.step_s is None
    if method.ADAPTIVE:
        weights = [method.A.ravel(), method.A.sum(axis=1), method.A[-1] - method.B_EMBEDDED]
        _fill(
            record,
            method=codes.RUNGE_KUTTA,
            stages=len(method.A),
            method_at=place(np.concatenate(weights)),
            order=min(method.ORDER, method.EMBEDDED_ORDER) + 1,
        )
    else:
        alpha_m, alpha_f, gamma = method.alphas(solver.spectral_radius)
        _fill(record, method=codes.ONE_STAGE, alpha_m=alpha_m, alpha_f=alpha_f, gamma=gamma)
    driven = [part.period_s for part in (scene.waves, scene.end.motion) if hasattr(part, "period_s")]
    shock = solver.shock_viscosity
    if shock is not None:
        _fill(record, viscous=True, c_quadratic=shock.quadratic, c_linear=shock.linear)
    begun = (*scene.start.buoy_velocity_mps, *scene.start.buoy_displacement_m)
    moving = scene.end.kind == "buoy" and any(begun)
    impulsive = record["waves"] and scene.waves.ramp_s == 0
    moved = record["end_motion"] != codes.STILL or bool(scene.end.twist_ramp_s)
    _fill(
        record,
        phase_per_step=method.PHASE,
        output_step=scene.sample_step_s(),
        profile_step=scene.profile_step_s(),
        fixed_step=solver.step_s or (min(driven) / 400 if driven else 0.0125),
        max_step=min(scales.longest_steps(scene).values()),
        min_step=solver.min_step_s,
        rtol=solver.rtol,
        growth_per_step=solver.growth_per_step,
        shortest=solver.shortest_period_s or solver.max_step_s / 50,
        shortest_wave=(math.pi / h.min()) ** 2,
        newton_tolerance=solver.newton_tolerance or 1e-2 * solver.rtol,
        max_newton=solver.max_newton_iterations,
        loop_release=solver.loop_release,
        max_releases=solver.max_loop_releases,
        at_rest=not (moving or impulsive or moved),
        all_waves=scene.end.kind == "held" and scene.end.release_s is None,  # let go, a line whips: no ringing
    )
    scales.put_scales(record, scene, h)
    if record["sea_n"]:
        error_mps = record["newton_tolerance"] / record["per_speed"]
        if scene.motion.dimensions == 2:
            record["sea_reach"], record["sea_span"] = reach_of(scene, LEFT_OUT * error_mps)
        else:
            record["sea_reach"] = STILL * error_mps / sea.shear_of(scene)
    if solver.courant is not None:
        record["pace"] = solver.courant / scales.fastest_wave(record, scene)
        record["fixed_step"] = record["pace"] * float(h.min())
    usual = 0.1 if scene.waves is None else scene.waves.period_s / 50
    record["window"] = min(solver.max_step_s, usual) if record["adaptive"] else record["fixed_step"]
