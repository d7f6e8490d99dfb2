"""Data of figures 2-7: the breaking line every 10 ms, four cases a figure (section 4.1), in the paper's own units."""

import numpy as np

from campaigns.breaking_line.lines import named
from campaigns.figure_data import Array
from campaigns.paper.part_folders import LeftOut, Parts, Plan

INSTANT_S = 0.010
SHOWN = {  # what a figure shows: columns of the profiles with unit and meaning
    "motion": {"x_m": ("m", "horizontal place from the fixed end"), "z_m": ("m", "height above the fixed end")},
    "tension": {"tension_N": ("N", "tension")},
    "velocity": {"speed_mps": ("m s-1", "speed")},
}


def breaking(parts: Parts, cases: tuple[str, ...], what: str) -> Plan:
    """Figures 2-4 (cases FAST) and 5-7 (SLOW); what: a key of SHOWN."""
    part = parts.part("breaking_line")
    runs = {case: parts.run(part, f"case {named(case)}", case=case, kind="case") for case in cases}
    for case, (_, trajectory, _) in runs.items():
        if trajectory.profiles is None:
            raise LeftOut(f"the run of case {named(case)} kept no profiles (`output.profiles`)")
    title = f"{what.capitalize()} of the breaking line, cases {named(cases[0])} to {named(cases[-1])}"
    return Plan(title, tuple(source for *_, source in runs.values()), lambda: _arrays(runs, what))


def instants(profiles) -> np.ndarray:
    """Indices of the profiles every INSTANT_S."""
    wanted = np.arange(0.0, profiles.time_s[-1] + 1e-9, INSTANT_S)
    return np.unique(np.searchsorted(profiles.time_s, wanted - 1e-9).clip(max=len(profiles.time_s) - 1))


def _arrays(runs: dict, what: str) -> dict[str, Array]:
    arrays: dict[str, Array] = {}
    for case, (row, trajectory, _) in runs.items():
        profiles = trajectory.profiles
        rows = instants(profiles)
        time, place = f"case_{case}_time_s", f"case_{case}_s_m"
        arrays[time] = ((time,), profiles.time_s[rows], "s", f"time since the break began, case {named(case)}")
        arrays[place] = ((place,), profiles.s_m, "m", "unstretched length from the fixed end")
        for column, (unit, about) in SHOWN[what].items():
            values = getattr(profiles, column)[rows]
            arrays[f"case_{case}_{column}"] = ((time, place), values, unit, f"{about}, case {named(case)}")
        arrays[f"case_{case}_force_N"] = ((), trajectory.scene.end.force_N[0], "N", "static horizontal force F_hs")
        arrays[f"case_{case}_fracture_s"] = ((), row["breaking_time_s"], "s", "fracture time t_br")
    return arrays
