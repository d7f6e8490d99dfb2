"""A line is let go and swings into a current: along the plane in which it was held, and across it."""

from engine import load_scene, simulate

along = {"motion.dimensions": 2, "current.velocity_mps": [[0.1, 0.0, 0.0], [0.7, 0.0, 0.0]]}
for overrides in (along, {}):
    scene = load_scene("swinging_line", overrides)
    run = simulate(scene, duration_s=120.0)
    print(run.status, f"in {scene.motion.dimensions} dimensions, let go at {scene.end.release_s} s")
    print(run.table()[["time_s", "x_m", "y_m", "z_m", "tension_top_N"]][::600].round(2).to_string(index=False))
