"""What each part of a scene costs: microseconds of a Newton iteration with and without it, side by side.

The same tether and buoy, the same fixed steps (TR-BDF2, 5 ms), one part taken away or added at a time. Times are
medians over rounds in which the scenes take turns on one core.
"""

import statistics

from engine import load_scene, simulate

ROUNDS, LENGTH_S = 7, 40.0
QUICK_ROUNDS, QUICK_LENGTH_S = 3, 10.0
TABLE_1 = "waves, water, bending (Table 1)"
_FIXED = {"solver.integrator": "trbdf2", "solver.step_s": 0.005, "waves.steepness": 0.016}
_DRY = {"water": None, "waves": None, "output.step_s": 0.05}
_PROFILE = {"law": "profile", "height_m": [0.0, 10.0, 21.0], "velocity_mps": [[0.0, 0, 0], [0.2, 0, 0], [0.3, 0, 0]]}
SCENES = {
    TABLE_1: _FIXED,
    "and a current profile": {**_FIXED, "current": _PROFILE},
    "and profiles kept every 0.05 s": {**_FIXED, "output.profiles": True},
    "still water: no waves": {**_FIXED, "waves": None, "output.step_s": 0.05},
    "no bending": {**_FIXED, "tether.bending_stiffness_Nm2": 0.0},
    "dry: no water": {**_FIXED, **_DRY},
    "dry, no bending": {**_FIXED, **_DRY, "tether.bending_stiffness_Nm2": 0.0},
    "three dimensions": {**_FIXED, "motion.dimensions": 3},
    "three dimensions, dry": {**_FIXED, **_DRY, "motion.dimensions": 3},
    "three dimensions, no bending": {**_FIXED, "motion.dimensions": 3, "tether.bending_stiffness_Nm2": 0.0},
}


def measured(quick: bool = False) -> dict[str, object]:
    """{"rounds", "length_s", "scenes": {name: {"us_per_newton", "us_per_step", "newton_per_step"}}}."""
    rounds, length_s = (QUICK_ROUNDS, QUICK_LENGTH_S) if quick else (ROUNDS, LENGTH_S)
    scenes, runs = {}, {name: [] for name in SCENES}
    for name, changes in SCENES.items():
        # a part that is set to None takes the values set within it along
        gone = {key for key, value in changes.items() if value is None}
        left = {key: value for key, value in changes.items() if key in gone or key.split(".")[0] not in gone}
        scenes[name] = load_scene("tethered_buoy", left)
        simulate(scenes[name], duration_s=0.5)
    for _ in range(rounds):
        for name, scene in scenes.items():
            runs[name].append(simulate(scene, duration_s=length_s).statistics)
    costs = {}
    for name, found in runs.items():
        spent_us = 1e6 * statistics.median(run["wall_s"] for run in found)
        newton, steps = found[0]["newton_iterations"], found[0]["steps"]  # the same in every round
        costs[name] = {"us_per_newton": spent_us / newton, "us_per_step": spent_us / steps}
        costs[name]["newton_per_step"] = newton / steps
    return {"rounds": rounds, "length_s": length_s, "scenes": costs}
