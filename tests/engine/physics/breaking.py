"""Straight breaks of the line of section 4.1: no gravity, an even grid, what exact theory is held against."""

from functools import cache

from campaigns.breaking_line.theory import theory_of
from engine import load_scene, simulate

FORCES_N = {"1": 45e3, "2": 180e3, "3": 315e3, "4": 450e3}
CASES = (*FORCES_N, *(f"{case}p" for case in FORCES_N))


def straight(case, nodes, **changes):
    """The scene of a case without gravity."""
    plain = {
        "gravity_mps2": 0.0,
        "tether.nodes": nodes,
        "tether.grid_stretching": 0.0,
        "tether.grid_refined": "both",
        "end.force_N": [FORCES_N[case[0]], 0.0, 0.0],
        "end.force_decay_s": 0.05 if case.endswith("p") else 0.005,
    }
    return load_scene("breaking_line", {**plain, **changes})


@cache
def theory(case):
    return theory_of(straight(case, 201), 0.2)


@cache
def broken(case, nodes):
    """The run of a case up to the time at which front or shock is at the fixed end."""
    run = simulate(straight(case, nodes), duration_s=theory(case).arrival_s)
    assert run.status == "ok", run.message
    return run
