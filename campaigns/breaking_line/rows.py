"""A run of the breaking line as one row of numbers, with what exact one-dimensional theory says of the same line.

A column that does not apply stays empty (None): no profiles or no energies kept, a law without closed theory, a run
that ended before what is measured. A line without gravity (kind "straight") stays straight: no recoil, no buckling.
"""

import math

import numpy as np

from campaigns.breaking_line import motion_measures as measures
from campaigns.breaking_line.theory import theory_of
from tables import LOOPS, MESSAGE, REJECTED, RUN_KEY, STATISTICS, STATUS, Column, Row, counted, of_words

_COUNTED = tuple(column for column in STATISTICS if column not in (LOOPS, REJECTED))
COLUMNS = (
    of_words("case", "case of the paper; p: fracture in 50 ms"),
    of_words("kind", "case, doubled (grid), stiffness, straight (no gravity), series (of grids)", "run"),
    STATUS,
    Column("force_N", "N", "F", "static force on the end", 0),
    Column("breaking_time_s", "s", "t_br", "fracture time", 3),
    Column("bending_stiffness_Nm2", "N m²", "EI", "bending stiffness", 1),
    Column("nodes", "", "nodes", "nodes of the line", 0),
    Column("end_speed_mps", "m/s", "v", "speed of the broken end, median from 5 ms after the break on", 2),
    Column("end_speed_least_mps", "m/s", "v_least", "least speed of the end from then on", 2),
    Column("end_speed_most_mps", "m/s", "v_most", "largest speed of the end from then on", 2),
    Column("end_speed_theory_mps", "m/s", "v exact", "speed of the end, exact", 2),
    Column("end_speed_shocked_theory_mps", "m/s", "v shocked", "the same behind a shock of full strength", 2),
    Column("end_speed_error", "", "v off", "largest relative difference from the exact speed at any time", 5),
    Column("speed_largest_mps", "m/s", "largest v", "largest speed of any node at any time", 2),
    Column(
        "front_speed_mps", "m/s", "front",
        "speed of the front: contours of 80 to 98 % of the static tension, extrapolated to all of it", 1,
    ),
    Column("front_speed_theory_mps", "m/s", "front exact", "√(T′/m) at the static tension", 1),
    Column(
        "slack_front_speed_mps", "m/s", "slack front",
        "speed of the edge of the slack part: contours of small strain, extrapolated to no tension", 1,
    ),
    Column("slack_front_speed_theory_mps", "m/s", "slack exact", "√(T′/m) at no tension", 1),
    Column("arrival_theory_s", "s", "arrival", "exact time at which front or shock is at the fixed end", 4),
    Column(
        "shock_birth_m", "m", "born at",
        "distance from the broken end at which the front turns vertical, extrapolated from its first 40 %", 2,
    ),
    Column("shock_birth_theory_m", "m", "born exact", "where exact characteristics first cross", 2),
    Column("shock_birth_theory_s", "s", "born then", "when exact characteristics first cross", 5),
    Column("shock_speed_mps", "m/s", "shock", "speed of the shock over all profiles that show it", 1),
    Column("shock_speed_theory_mps", "m/s", "shock exact", "speed of the exact shock over the same profiles", 1),
    Column("shock_offset_m", "m", "off by", "place of the shock less the exact one, mean", 4),
    Column("shock_offset_largest_m", "m", "at most", "largest distance of the shock from the exact one", 4),
    Column("shock_offset_elements", "", "elements", "median of that distance, in elements", 2),
    Column("strain_error", "", "ε off", "mean of |ε − exact| over the line and the second half of the way", 6),
    Column("strain_overshoot", "", "above", "largest strain above the static one before arrival, over it", 4),
    Column("strain_rise", "", "rise", "largest rise of strain towards the broken end before arrival, over it", 4),
    Column("x_min_m", "m", "x_min", "leftmost point; the fixed end is at 0", 3),
    Column("left_of_fixed_end_m", "m", "left of it", "unstretched length that has been left of the fixed end", 2),
    Column("recoil_m", "m", "recoil", "way of the broken end towards the fixed one", 2),
    Column("recoil_120ms_m", "m", "recoil_120", "that way after 120 ms", 2),
    Column("vertical_m", "m", "vertical", "largest rise or fall of any node", 3),
    Column("vertical_beyond_m", "m", "beyond", "the same beyond the quarter at the fixed end", 3),
    Column("steepest_tilt_rad", "rad", "tilt", "steepest element, followed round", 2),
    Column("buckled_m", "m", "folded", "length up to where an element is steeper than 0.2 rad at the end", 2),
    Column("half_energy_s", "s", "half", "when half of the strain energy is left", 4),
    Column("tension_spread", "", "T spread", "then: standard deviation of the tension over its mean", 2),
    Column("kinetic_spread", "", "v spread", "then: share of the line that would hold its energy at one speed", 2),
    Column("fast_share", "", "fast", "then: share of the line faster than 0.9 of the settled end speed", 2),
    Column("resting_share", "", "resting", "then: share of the line slower than 0.1 of that speed", 2),
    Column("stored_J", "J", "stored", "strain energy at the start", 0),
    Column("kinetic_J", "J", "kinetic", "kinetic energy at the end of the run", 0),
    Column("kinetic_largest_J", "J", "largest kinetic", "largest kinetic energy", 0),
    Column("strain_J", "J", "strain", "strain energy at the end", 0),
    Column("gravity_J", "J", "weight", "change of the energy of the weight", 0),
    Column("end_work_J", "J", "taken out", "work of the decaying end force on the line, below zero", 0),
    Column("end_work_theory_J", "J", "exact", "that work in the exact simple wave", 0),
    Column("bending_J", "J", "bending", "work against the shear forces", 1),
    Column("viscous_J", "J", "viscosity", "dissipated by the shock viscosity", 1),
    Column("scheme_space_J", "J", "scheme", "dissipated by the discretisation in space", 2),
    Column("scheme_time_J", "J", "in time", "dissipated by the integrator", 2),
    Column("remainder_J", "J", "remainder", "at the start + work − all the rest", 3),
    Column("remainder_largest_J", "J", "at any time", "largest size of the remainder", 3),
    Column("lost_at_arrival_J", "J", "lost by then", "dissipated when front or shock is at the fixed end", 1),
    Column("lost_at_arrival_theory_J", "J", "lost exact", "lost in the exact shock by then", 1),
    *_COUNTED,
    RUN_KEY,
    MESSAGE,
)  # fmt: skip

BEFORE_ARRIVAL = 0.98  # of the time at which something is at the fixed end: ripples are looked for up to then
END_SPEEDS = ("end_speed_mps", "end_speed_least_mps", "end_speed_most_mps")
COMMON_S = 0.12  # the shortest of the paper's run lengths, to compare recoil at one time


def breaking_row(trajectory) -> Row:
    """The columns of `COLUMNS` that a trajectory of the breaking line fills; those left out are unknown."""
    scene = trajectory.scene
    row = counted(trajectory, _COUNTED) | {
        "force_N": math.hypot(*scene.end.force_N),
        "breaking_time_s": scene.end.force_decay_s,
        "bending_stiffness_Nm2": scene.tether.bending_stiffness_Nm2,
        "nodes": scene.tether.nodes,
    }
    times, profiles, energy = trajectory.columns["time_s"], trajectory.profiles, trajectory.energy
    theory = None
    if len(times) and times[-1] > 0.0:
        theory = theory_of(scene, float(times[-1]))
    if theory is not None:
        row |= _theory_columns(theory)
    if trajectory.status == "ok":
        row |= dict(zip(END_SPEEDS, measures.settled_end_speed(trajectory), strict=True))
        if theory is not None:
            row["end_speed_error"] = measures.end_speed_error(trajectory, theory)
        if profiles is not None and len(profiles.time_s) > 1:
            row["speed_largest_mps"] = profiles.speed_mps.max()
            if theory is not None:
                row |= _front_columns(profiles, theory, scene.gravity_mps2)
            if scene.gravity_mps2 > 0.0:
                row |= measures.recoil(profiles, COMMON_S)
            if scene.gravity_mps2 > 0.0 and energy is not None:
                row |= measures.spread(trajectory)
        if energy is not None:
            row |= _energy_columns(energy, theory)
    return row


def _theory_columns(theory) -> Row:
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


def _front_columns(profiles, theory, gravity_mps2: float) -> Row:
    ripple = measures.strain_overshoot(profiles, BEFORE_ARRIVAL * theory.arrival_s)
    row = dict(zip(("strain_overshoot", "strain_rise"), ripple, strict=True)) | {
        "front_speed_mps": measures.front_speed(profiles, theory),
        "slack_front_speed_mps": measures.slack_front_speed(profiles, theory),
        "strain_error": measures.strain_error(profiles, theory),
    }
    if not theory.shocked:
        return row
    if gravity_mps2 == 0.0:
        row["shock_birth_m"] = measures.shock_birth(profiles, theory)
    times, places, exact = measures.shock_track(profiles, theory)
    if len(times) >= measures.LEAST_POINTS:
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


def _energy_columns(energy, theory) -> Row:
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
