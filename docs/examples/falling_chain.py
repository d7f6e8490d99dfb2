"""A folded chain is let go at one end, which overtakes a free fall: in a plane, and the same in space."""

from math import cos, sin, sqrt

from engine import load_scene, simulate

plane = load_scene("falling_chain")
turned = {"motion.dimensions": 3, "end.position_m": [0.25 * cos(0.7), 0.25 * sin(0.7), 0.0]}
runs = [simulate(scene, duration_s=0.5) for scene in (plane, load_scene("falling_chain", turned))]
for run in runs:
    table = run.table()
    lowest = table.z_m.idxmin()
    fall_m, taken_s = -table.z_m[lowest], table.time_s[lowest] - plane.end.release_s
    print(run.status, f"{fall_m:.3f} m in {taken_s:.3f} s; free fall {sqrt(2 * fall_m / 9.81):.3f} s")
