"""How a finished run of `campaigns.stability` is judged: each check measures one number that a bar is set for.

check(run, case) -> Check: `run` is a finished Trajectory whose status is "ok", `case` a Case of `campaigns.stability`.
Nothing here knows what the engine does inside; where another run is needed (refinement) it is made by the public
`simulate`.
"""

import math
from functools import partial
from typing import NamedTuple

import numpy as np

from engine import Trajectory, load_scene, simulate
from engine.physics.strains import strain_at, tension_at

FINER_NODES, FINER_RTOL, FINER_STEPS = 2, 10.0, 4
SAMPLES = 1000  # of a closed form in a period
PUSHED_S, SEEN = 0.02, (1e-5, 3e-4)  # after the push of the case; share of the length, small enough to be linear
CLOSED_GROWTH = "closed form of the fastest buckle"
LEAST_RANGE = 1e-3  # of the length: below this a difference is measured against the length, not against the motion


class Check(NamedTuple):
    """What a check says of a run.

    measured: the number that a bar is set for. method: how we know it. tension: what the largest tension at the top is
    off, over that of the closed form or the other run; None where nothing is said of it.
    """

    measured: float
    method: str
    tension: float | None = None


def finite(run, case) -> Check:
    """Every sample finite and none missing: what is asked of every run, and all that is asked of this one."""
    return Check(0.0, "finite and complete")


def rest(run, case) -> Check:
    """Distance (share of the length) from r = int (1 + eps(T(s))) ds, T(s) = |lift - w0 (L - s)|, at any time."""
    from scipy.integrate import quad

    scene = run.scene
    tether, buoy, g = scene.tether, scene.buoy, scene.gravity_mps2
    rho_w = scene.water.density_kgpm3 if scene.water else 0.0
    lift = (rho_w * math.pi * buoy.diameter_m**3 / 6 - buoy.mass_kg) * g
    w0 = (tether.density_kgpm3 - rho_w) * tether.area_m2 * g
    L = tether.length_m
    stretched = quad(lambda s: 1 + strain_at(abs(lift - w0 * (L - s)), tether.tension), 0.0, L, epsrel=1e-10)[0]
    return Check(float(np.abs(run.columns["radius_m"] - stretched).max()) / L, "closed form of the static line")


def stays(run, case) -> Check:
    """How far (share of the length) the upper end, or where it is held the rope, moves from static equilibrium."""
    moved = max(np.ptp(run.columns[name]) for name in ("x_m", "y_m", "z_m"))
    if run.profiles is not None:
        lines = run.profiles
        moved = max(np.ptp(axis, axis=0).max() for axis in (lines.x_m, lines.y_m, lines.z_m))
    return Check(float(moved) / run.scene.tether.length_m, "static equilibrium stays")


def refined(run, case) -> Check:
    """Rms difference of r, over its range, from a run of twice the elements, a tenth of the tolerance, and a quarter of
    the longest step, by the default method whatever that of the case.
    """
    nodes, solver = FINER_NODES * (run.scene.tether.nodes - 1) + 1, run.scene.solver
    finer = {"tether.nodes": nodes, "solver.rtol": solver.rtol / FINER_RTOL, "solver.integrator": "esdirk43"}
    finer["solver.max_step_s"] = max(solver.max_step_s / FINER_STEPS, solver.min_step_s)
    return compared(run, case, finer, "refinement")


def as_fine(run, case) -> Check:
    """The same from a run with the number of nodes that the case names."""
    nodes = case.options["nodes"]
    finer = {"tether.nodes": nodes, "tether.grid_stretching": 0.0, "tether.grid_refined": "both"}
    return compared(run, case, {**finer, "solver.rtol": 0.01}, f"run on {nodes} even nodes")


def compared(run, case, changes: dict, method: str) -> Check:
    """Rms of r - r' over the range of r', r' of the run with changes, and how far the largest tensions are apart.

    Both are infinite where that run does not end well.
    """
    other = simulate(load_scene("tethered_buoy", {**case.changes, **changes}), duration_s=case.length_s)
    if other.status != "ok":
        return Check(math.inf, method, math.inf)
    r, finer = run.columns["radius_m"], other.columns["radius_m"]
    scale = max(float(np.ptp(finer)), LEAST_RANGE * run.scene.tether.length_m)
    return Check(float(np.sqrt(np.mean((r - finer) ** 2))) / scale, method, apart(largest_N(run), largest_N(other)))


def largest_N(run: Trajectory) -> float:
    """Largest tension at the top, between the samples too."""
    return float(run.columns["tension_top_high_N"].max())


def apart(found: float, right: float) -> float:
    """Relative distance from what is right."""
    return abs(found / right - 1.0)


def heave(run, case) -> Check:
    """Relative loss of the swing of tension in the last tenth of a free heave without drag, which stays for ever."""
    swing_N = abs(run.scene.start.buoy_displacement_m[2]) * run.scene.tether.tension.stiffness_N
    swing_N /= run.scene.tether.length_m
    last = slice(-len(run.columns["time_s"]) // 10, None)
    high, low = run.columns["tension_top_high_N"], run.columns["tension_top_low_N"]
    mean_N = 0.5 * (high.max() + low.min())
    kept = 0.5 * (high[last].max() - low[last].min())
    return Check(apart(kept, swing_N), "closed form of free heave", apart(mean_N + kept, mean_N + swing_N))


def shaken(run, case) -> Check:
    """Distance of the largest change of tension from that of a bar whose end is shaken along it, over the latter.

    T - T_0 = sqrt(m EA) (v(t) + 2 sum_j v(t - 2 j l_0/c)), v the speed of the end: d'Alembert's waves, dry, no drag.
    """
    tether, motion = run.scene.tether, run.scene.end.motion
    EA, m = tether.tension.stiffness_N, tether.density_kgpm3 * tether.area_m2
    back_s = 2.0 * tether.length_m * math.sqrt(m / EA)
    parts = math.ceil(back_s / motion.period_s * SAMPLES)
    t = np.arange(math.ceil(case.length_s / back_s) * parts) * (back_s / parts)
    ramp = np.sin(0.5 * math.pi * np.minimum(t / motion.ramp_s, 1.0)) ** 2 if motion.ramp_s else 1.0
    v = np.gradient(ramp * np.sin(2.0 * math.pi / motion.period_s * t + motion.phase_rad), t)
    before = v.reshape(-1, parts)  # a row for each time that a wave takes there and back
    waves = 2.0 * np.cumsum(before, axis=0) - before
    largest = waves.ravel()[t <= case.length_s].max()
    right_N = math.hypot(*motion.amplitude_m) * math.sqrt(m * EA) * float(largest)
    rest_N = float(run.columns["tension_top_N"][0])
    found_N = largest_N(run)
    return Check(apart(found_N - rest_N, right_N), "waves in a bar", apart(found_N, rest_N + right_N))


def pendulum(run, case) -> Check:
    """Largest tension of a bob thrown sideways with v on a light stiff dry line: M g + 2 M v^2/l, because the half of
    the second term that was not there at t = 0 rings.
    """
    scene, line = run.scene, run.scene.tether
    speed = math.hypot(*scene.start.buoy_velocity_mps)
    right_N = scene.buoy.mass_kg * (scene.gravity_mps2 + 2.0 * speed**2 / line.length_m)
    off = apart(largest_N(run), right_N)
    return Check(off, "closed form of a pendulum", off)


POWERS = {
    "_mps2": 0.0,
    "_mps": 0.5,
    "_m": 1.0,
    "_m2": 2.0,
    "_s": 0.5,
    "_kg": 3.0,
    "_N": 3.0,
    "_Nm2": 5.0,
}


def froude(run, case) -> Check:
    """Distance of r over the size, and of the tension over its cube, from a run of the scene so many times as large."""
    size = case.options["size"]

    def scaled(part):
        found = {}
        for key, value in part.items():
            power = next((power for unit, power in POWERS.items() if key.endswith(unit)), 0.0)
            if isinstance(value, dict):
                found[key] = scaled(value)
            elif power and value is not None:
                found[key] = (np.array(value) * size**power).tolist()
            else:
                found[key] = value
        return found

    large = type(run.scene).model_validate(scaled(run.scene.model_dump()))
    other = simulate(large, duration_s=case.length_s * math.sqrt(size))
    samples = min(len(run.columns["radius_m"]), len(other.columns["radius_m"]))
    r, larger = run.columns["radius_m"][:samples], other.columns["radius_m"][:samples] / size
    distance = float(np.abs(r - larger).max()) / float(np.ptp(r))
    return Check(distance, f"the scene {size:g} times as large", apart(largest_N(run), largest_N(other) / size**3))


def bounded(run, case) -> Check:
    """Range of r over the length: what neither grows nor rings stays near its rest."""
    return Check(float(np.ptp(run.columns["radius_m"])) / run.scene.tether.length_m, "r stays within one length")


def energy(run, case) -> Check:
    """Largest change of kinetic + gravity + stretching + bending energy over the largest kinetic one; dry scenes."""
    scene, lines = run.scene, run.profiles
    tether, h = scene.tether, np.diff(lines.s_m)
    m = tether.density_kgpm3 * tether.area_m2
    inner = partial(np.trapezoid, x=lines.s_m, axis=1)
    kinetic = 0.5 * m * inner(lines.speed_mps**2)
    gravity = m * scene.gravity_mps2 * inner(lines.z_m)
    if scene.buoy is not None:
        kinetic = kinetic + 0.5 * scene.buoy.mass_kg * lines.speed_mps[:, -1] ** 2
        gravity = gravity + scene.buoy.mass_kg * scene.gravity_mps2 * lines.z_m[:, -1]
    stretching = inner(stretching_energy(tether.tension, lines.strain))
    parts = np.array([kinetic, gravity, stretching, bending_energy(tether, lines, h)])
    total = parts.sum(axis=0)
    return Check(float(np.abs(total - total[0]).max() / parts[0].max()), "energy")


def stretching_energy(law, strain: np.ndarray) -> np.ndarray:
    """int T deps per unstretched length (N), of the shape of strain."""
    from scipy.integrate import cumulative_trapezoid

    if law.law == "linear":
        return 0.5 * law.stiffness_N * strain**2
    grid = np.linspace(-0.999, 5.0, 60001)
    force = np.array([tension_at(strain, law) for strain in grid])
    work = cumulative_trapezoid(force, grid, initial=0.0)
    return np.interp(strain, grid, work) - np.interp(0.0, grid, work)


def bending_energy(tether, lines, h: np.ndarray) -> np.ndarray:
    """EI/2 int kappa^2 ds (J) per profile, from the turns between neighbouring elements."""
    sides = np.diff(np.stack([lines.x_m, lines.y_m, lines.z_m]), axis=2)
    sides = sides / np.maximum(np.linalg.norm(sides, axis=0), 1e-300)
    cosine = np.clip(np.sum(sides[:, :, 1:] * sides[:, :, :-1], axis=0), -1.0, 1.0)
    spacing = 0.5 * (h[1:] + h[:-1])
    return 0.5 * tether.bending_stiffness_Nm2 * np.sum(np.arccos(cosine) ** 2 / spacing, axis=1)


def buckling(run, case) -> Check:
    """Relative distance of the growth rate of a compressed straight line from rate^2 = (P k^2 - EI k^4)/m.

    The fastest of k = j pi/L is projected out of the shape, so that slower ones that began larger do not count; P is
    the mean over the time of the fit, in which the mode is between `SEEN` of the length.
    """
    tether, lines = run.scene.tether, run.profiles
    m, EI, L = tether.density_kgpm3 * tether.area_m2, tether.bending_stiffness_Nm2, tether.length_m
    k = np.arange(1, tether.nodes // 2) * math.pi / L
    pushed = lines.time_s > PUSHED_S
    P = -np.median(lines.tension_N[pushed][: len(lines.time_s) // 10])
    square = (P * k**2 - EI * k**4) / m
    if square.max() <= 0:
        return Check(math.inf, CLOSED_GROWTH)
    along = np.array([lines.x_m[0, -1], lines.z_m[0, -1]]) / math.hypot(lines.x_m[0, -1], lines.z_m[0, -1])
    sideways = along[0] * lines.z_m - along[1] * lines.x_m
    size = np.abs(sideways @ np.sin(k[square.argmax()] * lines.s_m)) * 2 / tether.nodes
    chosen = pushed & (size > SEEN[0] * L) & (np.maximum.accumulate(size) < SEEN[1] * L)
    if chosen.sum() < 5:
        return Check(math.inf, CLOSED_GROWTH)
    rate = np.polyfit(lines.time_s[chosen], np.log(size[chosen]), 1)[0]
    return Check(abs(float(rate) / math.sqrt(square.max()) - 1.0), CLOSED_GROWTH)


def straight(run, case) -> Check:
    """Largest distance (share of the length) of a node from the chord: what is symmetric stays so, stable or not."""
    lines = run.profiles
    points = np.stack([lines.x_m, lines.y_m, lines.z_m], axis=2)
    chord = points[:, -1] - points[:, 0]
    along = chord / np.linalg.norm(chord, axis=1)[:, None]
    off = points - np.einsum("tni,ti->tn", points, along)[:, :, None] * along[:, None, :]
    return Check(float(np.linalg.norm(off, axis=2).max()) / run.scene.tether.length_m, "symmetry")


def drift(run, case) -> Check:
    """Largest change of the strobed r, over the range of r in a period, between the first and the last tenth of a run.

    The first fiftieth is left out (the start dies out); strobed at the wave period, r of a steady motion is constant.
    """
    r = run.columns["radius_m"][len(run.columns["radius_m"]) // 50 :]
    tenth = len(r) // 10
    first, last = r[:tenth], r[-tenth:]
    moved = max(abs(first.mean() - last.mean()), float(np.abs(last - last.mean()).max()))
    top = run.columns["tension_top_high_N"][-tenth:].mean() - run.columns["tension_top_low_N"][-tenth:].mean()
    swing = top / run.scene.tether.tension.stiffness_N * run.scene.tether.length_m
    return Check(float(moved) / swing, "strobed r, last tenth against first")
