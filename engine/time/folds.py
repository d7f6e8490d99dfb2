"""Folds of a slack line that its elements do not resolve: every step watches them, and the message of a run says so if
its end is held.

Over an element that turns by theta, the box takes the mean of the tangents at its two ends: cos(theta/2). That of a
bend is sin(theta/2)/(theta/2). The chord of the bend is too short by the share 1 - (theta/2)/tan(theta/2).

Of 132 slack lines moved at one end, the largest tension of 38 was more than 5 % off on 41 and 81 nodes (refinement);
it came after the first fold beyond FOLD in all but 6 of them, two of which said that they ring. It was off by up to
TIMES the share, but for lines that ring. A line that a snap has straightened bears what its stretch does. So there is
no message where the line, straight between its ends, would bear TAUT of its largest tension; and none for a buoy on its
line, because snaps decide its largest tension.
"""

import math

import numpy as np

from ..compiled import kernel
from ..physics.strains import tension_at
from ..scene.models import Scene

FOLD = 0.77  # rad of turn in an element, where its chord is 5 % too short
TIMES = 3.0
TAUT = 0.5  # of the largest tension
AT_REST = 1.05  # times the tension at rest: a line that never bears more has the one of statics
FOLDS = (
    "folds of the slack line are smaller than its elements, one of which turns by {turn:.2g} rad: the largest tension, "
    "later than the first fold at t = {t:.3g} s, may be off by up to {off:.0%}; add nodes"
)


@kernel
def watch_turn(state, turn):
    """Keep the largest turn (rad) in an element, and the time at which one first passed FOLD."""
    state.max_turn = max(state.max_turn, turn)
    if turn > FOLD:
        state.folded = min(state.folded, state.t)


def words_of_folds(scene: Scene, state: np.void, columns: dict[str, np.ndarray]) -> str:
    """Says how far the largest tension of a held line may be off because of folds before it, or nothing."""
    high_N, line = columns["tension_top_high_N"], scene.tether
    peak = int(high_N.argmax()) if len(high_N) else 0
    if not len(high_N) or high_N[peak] <= AT_REST * high_N[0] or columns["time_s"][peak] < state["folded"]:
        return ""
    around = slice(max(peak - 1, 0), peak + 1)  # samples between which it is
    chord_m = np.linalg.norm([columns[name][around] for name in ("x_m", "y_m", "z_m")], axis=0).max()
    if tension_at(chord_m / line.length_m - 1.0, line.tension) > TAUT * high_N[peak]:
        return ""
    half = 0.5 * float(state["max_turn"])
    short = 1.0 - half / math.tan(half) if half < 0.5 * math.pi else 1.0
    return FOLDS.format(turn=2.0 * half, t=state["folded"], off=TIMES * short)
