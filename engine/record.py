"""What the kernels know of a scene and of a run: records of named numbers, and the codes of choices.

`engine.parameters` fills a RECORD (in three dimensions a SPATIAL) from a scene; a STATE holds where a run is. Kernels
and readers of scenes both import this module; it imports nothing of the engine.
"""

from typing import NamedTuple

import numpy as np

BUOY, HELD, FREE = 0, 1, 2  # end: what the upper end is
STILL, HARMONIC, TABLE = 0, 1, 2  # end_motion: how a held end is moved
EXTRAPOLATE, ZERO, WHEELER = 0, 1, 2  # above: the water above the still water level
RUNGE_KUTTA, ONE_STAGE = 0, 1  # method: the two families of time integrators

PLACE, STRAIN, TENSION, SPEED = 0, 3, 4, 5  # columns of a profile, one row a node: x, y, z (m); 1; N; m/s
PROFILE_WIDTH = 6
# columns of the samples of the upper end: time; place x, y, z; velocity x, y, z; tension there, least tension along the
# line, least and greatest tension at the upper end since the sample before; largest distance from the plane; loops
# released since t = 0; height of the lowest node; ringing (N) that the steps since the sample before did not resolve;
# tension at the lower end; largest tension along the line, and the arc length s at which it is; greatest tension at the
# lower end since the sample before
(
    TIME, AT_X, AT_Y, AT_Z, AT_U, AT_V, AT_W, TOP, LEAST, TOP_LOW, TOP_HIGH, OFFPLANE, RELEASES, LOWEST, MISSED,
    FOOT, MOST, MOST_AT, FOOT_HIGH,
) = range(19)  # fmt: skip
SAMPLE_WIDTH = 19
BEGIN, STEP, KIND = range(3)  # columns of the times of a trail: t (s), dt (s), one of the next
SMALL_STEPS = 3  # of backward Euler after a sudden start, or where an end is let go
RELEASE_STEPS = 8  # of backward Euler after a loop release
CONTROLLED, EULER, RESTART = 0.0, 1.0, 2.0  # of Runge-Kutta, one-stage, backward Euler after a sudden start or release
WIDTHS = {2: (6, 4), 3: (13, 6)}  # dimensions -> unknowns and conserved variables of a node
STRETCH = 5  # column of the nodal array Q at which q = (1 + eps) t begins, in a plane and in space


def _dtype(counts, values):
    return [(name, np.int64) for name in counts.split()] + [(name, np.float64) for name in values.split()]


# `engine.parameters` says what a field is. NAME_at: where an array begins in `tables`, NAME_n: its rows. At grid_at are
# the lengths h (m) of the elements: tables[grid_at + k - 1] lies between the nodes k - 1 and k; node 0 is the anchor.
# order: 1 + the lower order of a method and its embedded one; shortest_wave: its k^2; Rw: R, and ma: m_a of NOTATION.md
RECORD = np.dtype(
    _dtype(
        "nodes grid_at law law_at law_n drag drag_at drag_n wet waves current cur_at cur_nx cur_ny cur_nz cur_nt "
        "above end end_motion end_at end_n sea_n sea_at sea_few sea_few_at spherical_cap bent viscous method stages "
        "method_at adaptive max_newton loop_release max_releases at_rest all_waves",
        "m w0 EI p1 p2 p3 p4 p5 diameter ct cn drag1 drag2 drag3 drag4 ma Rw depth k omega amplitude phase "
        "direction ramp M_total M_wave lift C_buoy D_buoy M_added B_whole impact_loss end_x end_z end_release "
        "end_fx end_fz end_decay barrier c_quadratic c_linear sea_reach sea_span sea_wide sea_top per_strain per_force "
        "per_speed per_curvature order rtol newton_tolerance fixed_step max_step min_step start_x start_z inertia "
        "per_ringing phase_per_step shortest output_step release_step turn_step growth_per_step shortest_wave "
        "profile_step window alpha_m alpha_f gamma pace",
    )
)
# Three dimensions have a type of their own: a kernel that serves both is compiled for each on its first use. Their own
# fields come first: Numba would take a record that only goes on after the planar fields for a planar one.
SPATIAL = np.dtype(
    _dtype(
        "clamp_below clamp_above",
        "GI dir_x dir_y end_y end_fy start_y below_x below_y below_z above_x above_y above_z "
        "carry0 carry1 carry2 carry3 twist twist_ramp",
    )
    + RECORD.descr
)
# A planar scene whose every term has the form that lanes have too (`parameters.cover.is_plain`): no other is compiled.
PLAIN = np.dtype(_dtype("plain", "") + RECORD.descr)
# Scenes with a law of `engine.physics.extras`, in a plane and in space: no other scene has its fields, or compiles it
_EXTRAS = _dtype(
    "surfaced floored",
    "anchor_x anchor_y anchor_z damping pushed buoyed bed_stiffness bed_damping bed_friction bed_speed bed_onset",
)
EXTRA = np.dtype(_dtype("extra", "") + _EXTRAS + RECORD.descr)
EXTRA_SPATIAL = np.dtype(_dtype("extra_spatial", "") + _EXTRAS + SPATIAL.descr)


class Kind(NamedTuple):
    """What the type of a record says of its scene, so that each scene gets the kernels that it needs.

    spatial: three dimensions; extras: a law of `engine.physics.extras`; plain: every term as lanes have it.
    """

    spatial: bool = False
    extras: bool = False
    plain: bool = False


KINDS = {
    RECORD: Kind(),
    SPATIAL: Kind(spatial=True),
    PLAIN: Kind(plain=True),
    EXTRA: Kind(extras=True),
    EXTRA_SPATIAL: Kind(spatial=True, extras=True),
}
# small_steps, cautious: steps of backward Euler, of slow growth still to come; attempts: steps tried up to window_end;
# small, cut: the trial is one of backward Euler, ends at the corner (s), which no step may cross; dt_before: the last
# accepted step (0: of no use); turned: upper node of the element whose released turn is held, with the sign of the
# turn, or 0; low, high, foot: extremes of the top tension and greatest tension at the lower end since the last sample;
# first, first_profile: numbers of the samples and profiles, counted from t = 0, with which the output begins; folded:
# time (s) at which an element first turned by more than FOLD of `engine.time.folds`, inf before
STATE = np.dtype(
    _dtype(
        "status samples profiles small_steps steps rejected newton failures releases attempts cautious trail energies "
        "small cut first first_profile turned",
        "t dt dt_before low high foot max_turn min_strain window_end trial_dt corner ringing folded",
    )
)


def lengths_of(record: np.void, tables: np.ndarray) -> np.ndarray:
    """The element lengths (nodes - 1,), m, of a record."""
    return tables[record["grid_at"] :][: record["nodes"] - 1]


def arc_lengths(record: np.void, tables: np.ndarray) -> np.ndarray:
    """The unstretched arc length (nodes,), m, of every node of a record."""
    return np.append(0.0, np.cumsum(lengths_of(record, tables)))


def has_extras(record: np.void | np.dtype) -> bool:
    """Is this record, or its dtype, that of a scene with a law of `engine.physics.extras`?"""
    return KINDS[getattr(record, "dtype", record)].extras


def is_spatial(record: np.void | np.dtype) -> bool:
    """Is this record, or its dtype, that of a scene in three dimensions?"""
    return KINDS[getattr(record, "dtype", record)].spatial
