"""A twisted rope is slackened and forms a loop, the localised buckle of a long rod. (A plane knows no twist.)"""

from math import acos, sqrt

import numpy as np
from scipy.optimize import brentq

from engine import load_scene, simulate

scene = load_scene("twisted_rope")
run = simulate(scene, duration_s=100.0)
table, profiles = run.table(), run.profiles
pull_N, off_axis_m = table.tension_top_N.iloc[-1], np.hypot(profiles.x_m[-1], profiles.y_m[-1]).max()
print(run.status, f"it pulls by {pull_N:.3f} N, {off_axis_m:.3f} m off the axis")
middle_N = profiles.tension_N[-1, 60]  # negative: the tangent there points back along the axis
print(f"the middle of the loop bears {middle_N:.3f} N")

tether, turned = scene.tether, scene.end.twist_rad
EI, GI, length = tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2, tether.length_m
slack_m = length - table.z_m.iloc[-1]


def torque(m):
    """What is left of the turn when the helix has taken 4 arccos m of it, N m; m = M/(2 sqrt(EI T))."""
    return (turned - 4 * acos(m)) * GI / length


m = brentq(lambda m: 8 * EI * m * sqrt(1 - m * m) / torque(m) - slack_m, 0.56, 1 - 1e-12)
buckle_N = (torque(m) / (2 * m)) ** 2 / EI
print(f"closed form for this slack: {buckle_N:.3f} N, {slack_m / 2:.3f} m off the axis")
