"""A rope hangs between two hooks: in a plane, and in space, where a wind blows it out of that plane."""

from engine import load_scene, simulate

calm = simulate(load_scene("hanging_line"), duration_s=5.0)
sag_m, hook_N = -calm.profiles.z_m[-1].min(), calm.table().tension_top_N.iloc[-1]
print(calm.status, f"calm: it sags by {sag_m:.3f} m and pulls at the hook by {hook_N:.3f} N")

in_wind = {
    "motion.dimensions": 3,
    "water": {"depth_m": 100.0, "density_kgpm3": 1.225},  # the fluid is air
    "current": {"law": "uniform", "velocity_mps": [0.0, 12.0, 0.0]},  # and blows across
}
windy = simulate(load_scene("hanging_line", in_wind), duration_s=5.0)
y, z = windy.profiles.y_m[-1], windy.profiles.z_m[-1]
print(windy.status, f"wind: it hangs {y.max():.3f} m to the side and {-z.min():.3f} m down")
