"""A run of the breaking line as one row of numbers, with what exact one-dimensional theory says of the same line.

A column that does not apply stays empty (None): no profiles or no energies kept, a law without closed theory, a run
that ended before what is measured. A line without gravity (kind "straight") stays straight: no recoil, no buckling.
"""

import math

import numpy as np

from campaigns.breaking_line import measures
from campaigns.breaking_line.theory import theory_of
from campaigns.columns import Column

_STATISTICS = (
    "max_turn_rad",
    "min_strain",
    "steps",
    "newton_iterations",
    "newton_failures",
    "end_time_s",
    "wall_s",
)
COLUMNS = tuple(
    map(
        Column,
        (
            "case",
            "kind",
            "status",
            "force_N",
            "breaking_time_s",
            "bending_stiffness_Nm2",
            "nodes",
            "end_speed_mps",
            "end_speed_least_mps",
            "end_speed_most_mps",
            "end_speed_theory_mps",
            "end_speed_shocked_theory_mps",
            "end_speed_error",
            "speed_largest_mps",
            "front_speed_mps",
            "front_speed_theory_mps",
            "slack_front_speed_mps",
            "slack_front_speed_theory_mps",
            "arrival_theory_s",
            "shock_birth_m",
            "shock_birth_theory_m",
            "shock_birth_theory_s",
            "shock_speed_mps",
            "shock_speed_theory_mps",
            "shock_offset_m",
            "shock_offset_largest_m",
            "shock_offset_elements",
            "strain_error",
            "strain_overshoot",
            "strain_rise",
            "x_min_m",
            "left_of_fixed_end_m",
            "recoil_m",
            "recoil_120ms_m",
            "vertical_m",
            "vertical_beyond_m",
            "steepest_tilt_rad",
            "buckled_m",
            "half_energy_s",
            "tension_spread",
            "kinetic_spread",
            "fast_share",
            "resting_share",
            "stored_J",
            "kinetic_J",
            "kinetic_largest_J",
            "strain_J",
            "gravity_J",
            "end_work_J",
            "end_work_theory_J",
            "bending_J",
            "viscous_J",
            "scheme_space_J",
            "scheme_time_J",
            "remainder_J",
            "remainder_largest_J",
            "lost_at_arrival_J",
            "lost_at_arrival_theory_J",
            *_STATISTICS,
            "run_key",
            "message",
        ),
    )
)

BEFORE_ARRIVAL = 0.98  # of the time at which something is at the fixed end: ripples are looked for up to then
COMMON_S = 0.12  # the shortest of the paper's run lengths, to compare recoil at one time


def breaking_row(trajectory) -> dict[str, object]:
    """The columns of `COLUMNS` that a trajectory of the breaking line fills; those left out are unknown."""
    scene = trajectory.scene
    row = {
        "status": trajectory.status,
        "message": trajectory.message,
        "force_N": math.hypot(*scene.end.force_N),
        "breaking_time_s": scene.end.force_decay_s,
        "bending_stiffness_Nm2": scene.tether.bending_stiffness_Nm2,
        "nodes": scene.tether.nodes,
    }
    row |= {name: trajectory.statistics.get(name) for name in _STATISTICS}
    end_s = float(trajectory.columns["time_s"][-1]) if len(trajectory.columns["time_s"]) else 0.0
    theory = theory_of(scene, end_s) if end_s > 0.0 else None
    if theory is not None:
        row |= _theory_columns(theory)
    if trajectory.status == "ok":
        row |= _end_columns(trajectory, theory)
        if trajectory.profiles is not None and len(trajectory.profiles.time_s) > 1:
            row |= _profile_columns(trajectory, theory)
        if trajectory.energy is not None:
            row |= _energy_columns(trajectory.energy, theory)
    return {name: _known(entry) for name, entry in row.items()}


def _theory_columns(theory) -> dict[str, object]:
    speeds, shocked = theory.speeds, theory.shocked
    return {
        "end_speed_theory_mps": speeds.end_speed_mps,
        "end_speed_shocked_theory_mps": speeds.shock_end_speed_mps if shocked else None,
        "front_speed_theory_mps": speeds.front_speed_mps,
        "slack_front_speed_theory_mps": speeds.slack_front_speed_mps,
        "arrival_theory_s": theory.arrival_s,
        "shock_birth_theory_m": theory.start.distance_m if shocked else None,
        "shock_birth_theory_s": theory.start.time_s if shocked else None,
        "end_work_theory_J": theory.end_work_J,
    }


def _end_columns(trajectory, theory) -> dict[str, object]:
    names = ("end_speed_mps", "end_speed_least_mps", "end_speed_most_mps")
    row = dict(zip(names, measures.settled_end_speed(trajectory), strict=True))
    return row | ({"end_speed_error": measures.end_speed_error(trajectory, theory)} if theory is not None else {})


def _profile_columns(trajectory, theory) -> dict[str, object]:
    profiles, scene = trajectory.profiles, trajectory.scene
    row = {"speed_largest_mps": profiles.speed_mps.max()}
    if theory is not None:
        row |= _front_columns(profiles, theory)
        if scene.gravity_mps2 == 0.0 and theory.shocked:
            row["shock_birth_m"] = measures.shock_birth(profiles, theory)
    if scene.gravity_mps2 > 0.0:
        row |= measures.recoil(profiles, COMMON_S)
    if trajectory.energy is not None and scene.gravity_mps2 > 0.0:
        row |= measures.spread(trajectory)
    return row


def _front_columns(profiles, theory) -> dict[str, object]:
    overshoot, rise = measures.strain_overshoot(profiles, BEFORE_ARRIVAL * theory.arrival_s)
    row = {
        "front_speed_mps": measures.front_speed(profiles, theory),
        "slack_front_speed_mps": measures.slack_front_speed(profiles, theory),
        "strain_overshoot": overshoot,
        "strain_rise": rise,
        "strain_error": measures.strain_error(profiles, theory),
    }
    times, places, exact = measures.shock_track(profiles, theory)
    if theory.shocked and len(times) >= measures.LEAST_POINTS:
        off = np.abs(places - exact)
        elements = np.diff(profiles.s_m)[np.searchsorted(profiles.s_m, exact).clip(1, len(profiles.s_m) - 1) - 1]
        row |= {
            "shock_speed_mps": -np.polyfit(times, places, 1)[0],
            "shock_speed_theory_mps": -np.polyfit(times, exact, 1)[0],
            "shock_offset_m": np.mean(places - exact),
            "shock_offset_largest_m": np.max(off),
            "shock_offset_elements": np.median(off / elements),
        }
    return row


def _energy_columns(energy, theory) -> dict[str, object]:
    row = {
        "stored_J": energy.stored_J,
        "kinetic_J": energy.kinetic_J[-1],
        "kinetic_largest_J": energy.kinetic_J.max(),
        "strain_J": energy.strain_J[-1],
        "gravity_J": energy.gravity_J[-1] - energy.gravity_J[0],
        "remainder_J": energy.remainder_J()[-1],
        "remainder_largest_J": np.max(np.abs(energy.remainder_J())),
    }
    ended = ("end_work_J", "bending_J", "viscous_J", "scheme_space_J", "scheme_time_J")
    row |= {name: getattr(energy, name)[-1] for name in ended}
    if theory is not None and energy.time_s[-1] >= theory.arrival_s:
        lost = energy.viscous_J + energy.scheme_space_J + energy.scheme_time_J
        row |= {
            "lost_at_arrival_J": np.interp(theory.arrival_s, energy.time_s, lost),
            "lost_at_arrival_theory_J": theory.lost_J,
        }
    return row


def _known(entry: object) -> object:
    if isinstance(entry, (float, np.floating)):
        return float(entry) if math.isfinite(entry) else None
    return entry
