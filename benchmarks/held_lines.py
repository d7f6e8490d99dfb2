"""Held lines: the figures and tables of docs/held_lines.md. About half a minute; nothing is timed.

    .venv/bin/python -m benchmarks.held_lines       # writes docs/twisted_rope.png and docs/swinging_line.png

1. The twisted rope: rest against the localised buckle over nodes, and its shape.
2. The swinging line: its path over nodes and tolerance.
3. The falling chain: its fall against that of a chain folded without gap (Calkin & March 1989).

Closed forms are those that tests/engine/spatial checks.
"""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from tests.engine.spatial.rod_equations import Localised
from tests.engine.spatial.test_held_lines_released import LENGTH as L
from tests.engine.spatial.test_held_lines_released import G, fall

from benchmarks.shared import save
from engine import load_scene, simulate

COLOURS = plt.get_cmap("viridis")


def localised(scene, slack_m):
    """The localised buckle of the scene's rope and twist with this slack."""
    tether = scene.tether
    EI, GI = tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2

    def buckle(m):
        torque = (scene.end.twist_rad - 4 * math.acos(m)) * GI / tether.length_m
        return Localised(EI, GI, torque**2 / (4 * EI * m**2), m)

    return buckle(brentq(lambda m: buckle(m).shortening - slack_m, 0.56, 1 - 1e-12))


def shape(buckle, length, count=4001):
    """x, y, z (count, 3) of the buckle, z along the axis, from integrals of t."""
    s = np.linspace(-length / 2, length / 2, count)
    theta, psi, _ = buckle.angles(s)
    t = np.stack([np.sin(theta) * np.cos(psi), np.sin(theta) * np.sin(psi), np.cos(theta)], 1)
    x = np.vstack([np.zeros(3), np.cumsum(0.5 * np.diff(s)[:, None] * (t[1:] + t[:-1]), axis=0)])
    x[:, :2] -= 0.5 * (x[0, :2] + x[-1, :2])
    return x


def turned(x, middle, onto):
    """x (n, 3) turned about z so that its point `middle` lies in the direction `onto` (2,)."""
    angle = math.atan2(onto[1], onto[0]) - math.atan2(x[middle, 1], x[middle, 0])
    c, s = math.cos(angle), math.sin(angle)
    return np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1], x[:, 2]], 1)


def line_at(profiles, time_s):
    """x, y, z (n, 3) of the line at the kept time next to `time_s`."""
    i = int(np.argmin(np.abs(profiles.time_s - time_s)))
    return np.stack([profiles.x_m[i], profiles.y_m[i], profiles.z_m[i]], 1)


def twisted_rope():
    print("twisted rope: nodes | T, N | off axis, m | against the localised buckle, %")
    for nodes in (61, 121, 241, 481, 961):
        scene = load_scene("twisted_rope", {"tether.nodes": nodes})
        run = simulate(scene, duration_s=100.0)
        table, length = run.table(), scene.tether.length_m
        pull, off = table.tension_top_N.iloc[-1], np.hypot(*line_at(run.profiles, 100.0)[:, :2].T).max()
        buckle = localised(scene, length - table.z_m.iloc[-1])
        apart = 100 * (np.array([pull / buckle.T, off / buckle.deflection]) - 1)
        print(f"  {nodes} | {pull:.4f} | {off:.4f} | {apart[0]:+.2f} {apart[1]:+.2f}", run.status)
        if nodes == 241:
            kept = run, shape(buckle, length)
    print(f"  closed form: T {buckle.T:.4f} N, {buckle.deflection:.4f} m, m {buckle.m:.4f}")
    return kept


def draw_rope(run, closed):
    figure = plt.figure(figsize=(9.5, 5.2), layout="constrained")
    space, side, front = (figure.add_subplot(1, 3, 1, projection="3d"), *(figure.add_subplot(1, 3, i) for i in (2, 3)))
    profiles = run.profiles
    last = line_at(profiles, 100.0)
    middle = len(last) // 2
    closed = turned(closed, len(closed) // 2, last[middle, :2])
    closed[:, 2] += last[middle, 2] - closed[len(closed) // 2, 2]
    times = (10.0, 25.0, 40.0, 55.0, 100.0)
    for i, t in enumerate(times):
        x = line_at(profiles, t)
        style = {"color": COLOURS(0.9 * i / (len(times) - 1)), "lw": 2.2 if t == times[-1] else 1.2}
        space.plot(*x.T, **style)
        side.plot(x[:, 0], x[:, 2], label=f"{t:.0f} s", **style)
        front.plot(x[:, 1], x[:, 2], **style)
    for axis, name, column in ((side, "x (m)", 0), (front, "y (m)", 1)):
        axis.plot(closed[:, column], closed[:, 2], "k--", lw=0.9, label="closed form")
        axis.set(xlabel=name, xlim=(-0.7, 0.7), ylim=(0, 6.2), aspect=0.45)
    side.set_ylabel("z (m)")
    side.legend(fontsize=8, loc="upper left")
    space.set(xlabel="x", ylabel="y", zlabel="z", xlim=(-0.7, 0.7), ylim=(-0.7, 0.7), zlim=(0, 6.2))
    space.set(xticks=(-0.5, 0, 0.5), yticks=(-0.5, 0, 0.5), zticks=range(7))
    space.tick_params(labelsize=7)
    space.set_box_aspect((1, 1, 2.6), zoom=1.35)
    space.view_init(18, -55)
    save(figure, "twisted_rope.png")


def swinging_line():
    print("swinging line: largest change of the free end's path over 60 s against 321 nodes; of rtol/10")

    def swung(**changes):
        run = simulate(load_scene("swinging_line", changes), duration_s=60.0)
        return run, run.table()[["x_m", "y_m", "z_m"]].to_numpy()

    paths = {nodes: swung(**{"tether.nodes": nodes})[1] for nodes in (41, 161, 321)}
    kept, paths[81] = swung(**{"tether.nodes": 81})
    paths["81, rtol 0.003"] = swung(**{"solver.rtol": 0.003})[1]
    for name, against in ((41, 321), (81, 321), (161, 321), ("81, rtol 0.003", 81)):
        print(f"  {name}: {1e3 * np.linalg.norm(paths[name] - paths[against], axis=1).max():.2f} mm")
    return kept


def draw_swing(run):
    figure, axes = plt.subplots(1, 2, figsize=(8.5, 5), layout="constrained", sharey=True, width_ratios=(15.5, 6.5))
    times = (0.0, 3.0, 5.0, 8.0, 12.0, 20.0, 60.0)
    table = run.table()
    for axis, name in zip(axes, ("x", "y"), strict=True):
        for i, t in enumerate(times):
            x = line_at(run.profiles, t)
            axis.plot(x[:, "xy".index(name)], x[:, 2], color=COLOURS(0.9 * i / (len(times) - 1)), label=f"{t:.0f} s")
        axis.plot(table[f"{name}_m"], table.z_m, "k:", lw=0.9, label="path of the free end")
        axis.set(xlabel=f"{name} (m)", aspect="equal")
    axes[0].set(ylabel="z (m)", title="seen along the current")
    axes[1].set(title="seen across it", xlim=(-1.5, 5))
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside right center", fontsize=8)
    save(figure, "swinging_line.png")


def falling_chain():
    print("falling chain, hooks 2 cm apart: fall, m | time, s | folded chain | free fall")
    tight = {"end.position_m": [0.02, 0.0, 0.0], "tether.nodes": 641, "tether.bending_stiffness_Nm2": 1e-7}
    t, _, _, z = fall(0.475, **tight, **{"output.step_s": 1e-3})
    for x in (0.2, 0.4, 0.6, 0.8, 0.88):
        exact = quad(lambda u: 2 * math.sqrt((1 - u * u / L) / (2 * G * (1 - u * u / (2 * L)))), 0, math.sqrt(x))[0]
        print(f"  {x} | {np.interp(x, -z[t > 0], t[t > 0]):.4f} | {exact:.4f} | {math.sqrt(2 * x / G):.4f}")


def main():
    draw_rope(*twisted_rope())
    draw_swing(swinging_line())
    falling_chain()


if __name__ == "__main__":
    main()
