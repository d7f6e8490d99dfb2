"""What each part of a scene costs: microseconds per Newton iteration with and without it, side by side on one core.

The same tether and buoy, the same fixed steps (TR-BDF2, 5 ms, 100 s), one part taken away or added at a time; settings
in turns, medians over the rounds.    python -m benchmarks.scene_cost
"""

import statistics

from engine import load_scene, simulate

ROUNDS, DURATION_S = 7, 100.0
FIXED = {"solver.integrator": "trbdf2", "solver.step_s": 0.005, "waves.steepness": 0.016}
DRY = {"water": None, "waves": None, "output.step_s": 0.05}
PROFILE = {"law": "profile", "height_m": [0.0, 10.0, 21.0], "velocity_mps": [[0.0, 0, 0], [0.2, 0, 0], [0.3, 0, 0]]}
SCENES = {
    "waves, water, bending (Table 1)": FIXED,
    "and a current profile": {**FIXED, "current": PROFILE},
    "and profiles kept every 0.05 s": {**FIXED, "output.profiles": True},
    "still water: no waves": {**FIXED, "waves": None, "output.step_s": 0.05},
    "no bending": {**FIXED, "tether.bending_stiffness_Nm2": 0.0},
    "three dimensions": {**FIXED, "motion.dimensions": 3},
    "three dimensions, dry": {**FIXED, **DRY, "motion.dimensions": 3},
    "three dimensions, no bending": {**FIXED, "motion.dimensions": 3, "tether.bending_stiffness_Nm2": 0.0},
    "dry: no water": {**FIXED, **DRY},
    "dry, no bending": {**FIXED, **DRY, "tether.bending_stiffness_Nm2": 0.0},
}


def scene_of(changes):
    """Table 1 with changes; a part that is set to None takes the values set within it along."""
    gone = {key for key, value in changes.items() if value is None}
    return load_scene("tethered_buoy", {k: v for k, v in changes.items() if k in gone or k.split(".")[0] not in gone})


def main():
    scenes = {name: scene_of(changes) for name, changes in SCENES.items()}
    times = {name: [] for name in scenes}
    for scene in scenes.values():
        simulate(scene, duration_s=1.0)
    for _ in range(ROUNDS):
        for name, scene in scenes.items():
            found = simulate(scene, duration_s=DURATION_S)
            assert found.status == "ok", f"{name}: {found.message}"
            times[name].append(1e6 * found.statistics["wall_s"] / found.statistics["newton_iterations"])
    whole = statistics.median(times["waves, water, bending (Table 1)"])
    for name, values in times.items():
        middle = statistics.median(values)
        print(f"{name:34s} {middle:6.2f} us per Newton iteration   {middle / whole:5.2f} of Table 1")


if __name__ == "__main__":
    main()
