"""Data of the figures of single motions: 2-7 (section 4.1), 9-13 and 15-18 (section 4.2), and 20.

Figures 2-7: the breaking line every 10 ms, four cases a figure, in the paper's own units.

Figures 9-18: the tethered buoy at the paper's two steepnesses. Tension over the static tension T_s, radius over the
static radius r_0 = l_0 + Dl; the angle has no static value but 0 and stays in rad. The static state is the first sample
of a run, which starts in it. The record is shown up to where the window of eq. (31) ends, tau_0 + n T_i = 60 T_i.

Figure 20: motion across the plane of the waves after a push of 1e-5 m/s, of the buoy and of the rope.
"""

import numpy as np

from campaigns.breaking_line.lines import named
from campaigns.figure_data import Array
from campaigns.judge import samples_of
from campaigns.paper.measured import LeftOut, Parts, Plan
from campaigns.paper.measures import WINDOW, in_window
from engine.natural_frequencies import natural_frequencies
from tables import BODIES, LARGE, SMALL

INSTANT_S = 0.010
SHOWN = {  # what a figure shows: columns of the profiles with unit and meaning
    "motion": {"x_m": ("m", "horizontal place from the fixed end"), "z_m": ("m", "height above the fixed end")},
    "tension": {"tension_N": ("N", "tension")},
    "velocity": {"speed_mps": ("m s-1", "speed")},
}
TITLES = {"tension": "Tension", "radial": "Radial motion of the buoy", "angular": "Angular motion of the buoy"}
TENSIONS = {"": "tension", "_low": "least tension since the last sample", "_high": "largest tension since then"}
MOTIONS = {"radial": ("radius_m", "r/r_0", "1"), "angular": ("angle_rad", "theta", "rad")}  # column, name, unit
WAVES = {"small": SMALL, "large": LARGE}  # in the order of the paper's key


def breaking(parts: Parts, cases: tuple[str, ...], quantity: str) -> Plan:
    """Figures 2-4 (cases FAST) and 5-7 (SLOW); quantity: a key of SHOWN."""
    part = parts.part("breaking_line")
    runs = {case: parts.run(part, f"case {named(case)}", case=case, kind="case") for case in cases}
    for case, (_, trajectory, _) in runs.items():
        if trajectory.profiles is None:
            raise LeftOut(f"the run of case {named(case)} kept no profiles (`output.profiles`)")
    title = f"{quantity.capitalize()} of the breaking line, cases {named(cases[0])} to {named(cases[-1])}"
    return Plan(title, tuple(source for *_, source in runs.values()), lambda: _breaking(runs, quantity))


def _breaking(runs: dict, quantity: str) -> dict[str, Array]:
    arrays = {}
    for case, (row, trajectory, _) in runs.items():
        profiles = trajectory.profiles
        wanted = np.arange(0.0, profiles.time_s[-1] + 1e-9, INSTANT_S)
        rows = np.unique(np.searchsorted(profiles.time_s, wanted - 1e-9).clip(max=len(profiles.time_s) - 1))
        time, place = f"case_{case}_time_s", f"case_{case}_s_m"
        arrays[time] = ((time,), profiles.time_s[rows], "s", f"time since the break began, case {named(case)}")
        arrays[place] = ((place,), profiles.s_m, "m", "unstretched length from the fixed end")
        for column, (unit, about) in SHOWN[quantity].items():
            values = getattr(profiles, column)[rows]
            arrays[f"case_{case}_{column}"] = ((time, place), values, unit, f"{about}, case {named(case)}")
        arrays[f"case_{case}_force_N"] = ((), trajectory.scene.end.force_N[0], "N", "static horizontal force F_hs")
        arrays[f"case_{case}_fracture_s"] = ((), row["breaking_time_s"], "s", "fracture time t_br")
    return arrays


def history(parts: Parts, steepness: float, side: str) -> Plan:
    """Figures 9-11, 13, 15 and 16; side: "tension", "radial" or "angular"."""
    trajectory, source = parts.of_buoy(steepness)
    return Plan(f"{TITLES[side]} at kA = {steepness:g}", (source,), lambda: history_arrays(trajectory, side))


def history_arrays(trajectory, side: str) -> dict[str, Array]:
    """The record up to the end of the window of eq. (31)."""
    scene, dimension = trajectory.scene, ("time_s",)
    last = samples_of(scene, sum(WINDOW)) + 1
    shown = {name: values[:last] for name, values in trajectory.columns.items()}
    arrays = {
        "time_s": (dimension, shown["time_s"], "s", "time"),
        "wave_period_s": ((), scene.waves.period_s, "s", "wave period T_i"),
        "window_start_periods": ((), WINDOW[0], "1", "start of the window of eq. (31), in wave periods"),
        "window_periods": ((), WINDOW[1], "1", "length of the window of eq. (31), in wave periods"),
    }
    if side == "tension":
        static = shown["tension_top_N"][0]
        for suffix, meaning in TENSIONS.items():
            tension = shown[f"tension_top{suffix}_N"]
            arrays[f"tension{suffix}_N"] = (dimension, tension, "N", f"{meaning}, at the top end")
            arrays[f"tension{suffix}_over_static"] = (dimension, tension / static, "1", f"{meaning} over T_s")
        return arrays | {"static_tension_N": ((), static, "N", "static tension T_s at the top end")}
    if side == "radial":
        static = shown["radius_m"][0]
        return arrays | {
            "radius_m": (dimension, shown["radius_m"], "m", "distance of the buoy from the anchor"),
            "radius_over_static": (dimension, shown["radius_m"] / static, "1", "r over r_0"),
            "static_radius_m": ((), static, "m", "static distance r_0 = l_0 + Dl"),
            "unstretched_m": ((), scene.tether.length_m, "m", "unstretched length l_0"),
        }
    return arrays | {"angle_rad": (dimension, shown["angle_rad"], "rad", "angle of the buoy from the vertical")}


def spectra(parts: Parts, steepness: float, sides: tuple[str, ...]) -> Plan:
    """Figures 12, 17 and 18: eq. (31) of the radial and the angular motion."""
    trajectory, source = parts.of_buoy(steepness)
    if not in_window(trajectory):
        periods = trajectory.columns["time_s"][-1] / trajectory.scene.waves.period_s
        raise LeftOut(f"eq. (31) needs {sum(WINDOW)} wave periods, the run at kA = {steepness:g} has {periods:.4g}")
    if natural_frequencies(trajectory.scene) is None:
        raise LeftOut("the buoy of this scene has no natural frequencies to mark")
    title = f"Spectrum of the buoy's {' and '.join(sides)} motion at kA = {steepness:g}"
    return Plan(title, (source,), lambda: _spectra(trajectory, sides))


def _spectra(trajectory, sides: tuple[str, ...]) -> dict[str, Array]:
    from analysis import spectral_peaks, spectrum

    scene = trajectory.scene
    modes = natural_frequencies(scene)
    static_m = trajectory.columns["radius_m"][0]
    arrays = {
        "wave_radps": ((), modes.wave_radps, "rad s-1", "wave frequency"),
        "natural_radial_radps": ((), modes.radial_radps, "rad s-1", "natural frequency, radial, section 4.2.1"),
        "natural_angular_radps": ((), modes.pendulum_radps, "rad s-1", "natural frequency, angular, section 4.2.1"),
        "static_radius_m": ((), static_m, "m", "static distance r_0 = l_0 + Dl"),
        "start_periods": ((), WINDOW[0], "1", "tau_0/T_i of eq. (31)"),
        "periods": ((), WINDOW[1], "1", "n of eq. (31)"),
    }
    for side in sides:
        column, name, unit = MOTIONS[side]
        motion = trajectory.columns[column] / (static_m if side == "radial" else 1.0)
        lines = spectrum(motion, scene.sample_step_s(), scene.waves.period_s, *WINDOW)
        # the mean is bin 0, and no oscillation
        arrays["omega_radps"] = (("omega_radps",), lines.angular_frequency_radps[1:], "rad s-1", "angular frequency")
        arrays[f"{side}_amplitude"] = (("omega_radps",), lines.amplitude[1:], unit, f"eq. (31) of {name}")
        peaks = np.array([peak.angular_frequency_radps for peak in spectral_peaks(lines)])
        if len(peaks):  # the format has no dimension of length zero
            about = f"peaks of the spectrum of {name}, largest first"
            arrays[f"{side}_peaks_radps"] = ((f"{side}_peak",), peaks, "rad s-1", about)
    return arrays


def offplane_histories(parts: Parts) -> Plan:
    """Figure 20."""
    part, runs = parts.part("out_of_plane"), {}
    for name, kA in WAVES.items():
        wanted = {**part.provenance["base"], "steepness": kA}
        runs[name] = parts.run(part, f"kA = {kA:g} with a push across the waves", **wanted)
    sources = tuple(source for *_, source in runs.values())
    return Plan("Motion across the plane of the waves", sources, lambda: _offplane(runs))


def _offplane(runs: dict) -> dict[str, Array]:
    from analysis import envelope_of

    arrays = {}
    for name, (row, trajectory, _) in runs.items():
        scene, columns, kA = trajectory.scene, trajectory.columns, f"kA = {WAVES[name]:g}"
        period_s, of_time, of_envelope = scene.waves.period_s, (f"{name}_time_s",), (f"{name}_periods",)
        arrays[of_time[0]] = (of_time, columns["time_s"], "s", "time")
        for body, column in BODIES.items():
            size = np.abs(columns[column])
            arrays[f"{name}_{body}_m"] = (of_time, size, "m", f"distance from the plane, {body}, {kA}")
            time, largest = envelope_of(size[np.isfinite(size)], scene.sample_step_s(), period_s)
            arrays[of_envelope[0]] = (of_envelope, time / period_s, "1", "time in wave periods")
            about = f"largest distance from the plane in each wave period, {body}, {kA}"
            arrays[f"{name}_{body}_envelope_m"] = (of_envelope, largest, "m", about)
        arrays[f"{name}_inplane_m"] = ((), row["inplane_m"], "m", f"half the range of the buoy in the plane, {kA}")
        arrays["wave_period_s"] = ((), period_s, "s", "wave period T_i")
        arrays["static_radius_m"] = ((), columns["radius_m"][0], "m", "static distance r_0 of the buoy from the anchor")
        arrays["push_mps"] = ((), row["seed_mps"], "m s-1", "velocity across the waves at t = 0")
    return arrays
