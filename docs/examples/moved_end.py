"""An end is moved as prescribed: shaken in a plane and in space, and taken along the rows of a table."""

from engine import load_scene, simulate

harmonic = {"law": "harmonic", "amplitude_m": [0.0, 0.0, 0.01], "period_s": 0.85, "ramp_s": 20.0}
plane = simulate(load_scene("shaken_line", {"motion.dimensions": 2, "end.motion": harmonic}), duration_s=40.0)
space = simulate(load_scene("shaken_line"), duration_s=40.0)
for run in (plane, space):
    middle = run.profiles.y_m[-100:, 40], run.profiles.z_m[-100:, 40]
    print(run.status, "the middle moves by", *(f"{abs(w).max() * 1e3:.2f} mm" for w in middle), "along y and z")

rows = [[0.0, 0.0, 0.0], [-4.0, 0.0, 1.0], [-4.0, 5.0, 1.0]]
table = {"law": "table", "time_s": [0.0, 10.0, 20.0], "displacement_m": rows}
moved = {"motion.dimensions": 3, "end.motion": table, "solver.newton_tolerance": 1e-8}
taken = simulate(load_scene("hanging_line", moved), duration_s=20.0)
print(taken.status, "the hook ends at", *taken.table()[["x_m", "y_m", "z_m"]].iloc[-1].round(6), "m")
