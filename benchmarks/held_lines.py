"""Held lines: the figures and tables of docs/held_lines.md. About half a minute; nothing is timed.

    .venv/bin/python -m benchmarks.held_lines       # writes docs/twisted_rope.png and docs/swinging_line.png

1. The twisted rope: rest against the localised buckle over nodes, and its shape
   (`tests/engine/spatial/test_torsion_localised.py` checks the formulas).
2. The swinging line: its path over nodes and tolerance.
3. The falling chain: its fall against that of a chain folded without gap (Calkin & March 1989).
"""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq

from benchmarks.shared import save
from engine import load_scene, simulate

COLOURS = plt.get_cmap("viridis")


def localised(scene, slack_m):
    """T (N), distance off the axis (m), cos of the angle in the middle, k and m of the buckle with this slack."""
    tether = scene.tether
    EI, GI, L = tether.bending_stiffness_Nm2, tether.torsion_stiffness_Nm2, tether.length_m

    def torque(m):
        return (scene.end.twist_rad - 4 * math.acos(m)) * GI / L

    m = brentq(lambda m: 8 * EI * m * math.sqrt(1 - m**2) / torque(m) - slack_m, 0.56, 1 - 1e-12)
    T = torque(m) ** 2 / (4 * EI * m**2)
    return T, slack_m / 2, 2 * m**2 - 1, math.sqrt(T / EI), m


def shape(k, m, length, count=4001):
    """x, y, z (count, 3) of the buckle, z along the axis, from integrals of t."""
    s = np.linspace(-length / 2, length / 2, count)
    a = math.sqrt(1 - m**2)
    theta = 2 * np.arcsin(a / np.cosh(k * a * s))
    psi = m * k * s + np.arctan(a / m * np.tanh(k * a * s))
    t = np.stack([np.sin(theta) * np.cos(psi), np.sin(theta) * np.sin(psi), np.cos(theta)], 1)
    x = np.vstack([np.zeros(3), np.cumsum(0.5 * np.diff(s)[:, None] * (t[1:] + t[:-1]), axis=0)])
    x[:, :2] -= 0.5 * (x[0, :2] + x[-1, :2])
    return x


def turned(x, middle, onto):
    """x (n, 3) turned about z so that its point `middle` lies in the direction `onto` (2,)."""
    angle = math.atan2(onto[1], onto[0]) - math.atan2(x[middle, 1], x[middle, 0])
    c, s = math.cos(angle), math.sin(angle)
    return np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1], x[:, 2]], 1)


def line_at(profiles, i):
    return np.stack([profiles.x_m[i], profiles.y_m[i], profiles.z_m[i]], 1)


def twisted_rope():
    print("twisted rope: nodes | T, N | off axis, m | against the localised buckle, %")
    for nodes in (61, 121, 241, 481, 961):
        scene = load_scene("twisted_rope", {"tether.nodes": nodes})
        run = simulate(scene, duration_s=100.0)
        table, last = run.table(), line_at(run.profiles, -1)
        pull, off = table.tension_top_N.iloc[-1], np.hypot(*last[:, :2].T).max()
        T, deflection, cosine, k, m = localised(scene, scene.tether.length_m - table.z_m.iloc[-1])
        print(
            f"  {nodes} | {pull:.4f} | {off:.4f} | {100 * (pull / T - 1):+.2f} {100 * (off / deflection - 1):+.2f}",
            run.status,
        )
        if nodes == 241:
            kept = run, shape(k, m, scene.tether.length_m)
    print(f"  closed form: T {T:.4f} N, {deflection:.4f} m, cos theta {cosine:.3f}, m {m:.4f}; L k sqrt(1-m^2) "
          f"{k * math.sqrt(1 - m**2) * scene.tether.length_m:.1f}")  # fmt: skip
    return kept


def draw_rope(run, closed):
    figure = plt.figure(figsize=(9.5, 5.2), layout="constrained")
    space, side, front = (figure.add_subplot(1, 3, 1, projection="3d"), *(figure.add_subplot(1, 3, i) for i in (2, 3)))
    profiles = run.profiles
    last = line_at(profiles, -1)
    middle = len(last) // 2
    closed = turned(closed, len(closed) // 2, last[middle, :2])
    closed[:, 2] += last[middle, 2] - closed[len(closed) // 2, 2]
    times = (10.0, 25.0, 40.0, 55.0, 100.0)
    for i, t in enumerate(times):
        x = line_at(profiles, int(np.argmin(np.abs(profiles.time_s - t))))
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
    paths = {}
    for nodes in (41, 81, 161, 321):
        run = simulate(load_scene("swinging_line", {"tether.nodes": nodes}), duration_s=60.0)
        paths[nodes] = run.table()[["x_m", "y_m", "z_m"]].to_numpy()
        if nodes == 81:
            kept = run
    for nodes in (41, 81, 161):
        print(f"  {nodes}: {1e3 * np.linalg.norm(paths[nodes] - paths[321], axis=1).max():.1f} mm")
    fine = simulate(load_scene("swinging_line", {"solver.rtol": 0.003}), duration_s=60.0)
    change = fine.table()[["x_m", "y_m", "z_m"]].to_numpy() - paths[81]
    print(f"  81, rtol 0.003: {1e3 * np.linalg.norm(change, axis=1).max():.2f} mm")
    return kept


def draw_swing(run):
    figure, axes = plt.subplots(1, 2, figsize=(8.5, 5), layout="constrained", sharey=True, width_ratios=(15.5, 6.5))
    times = (0.0, 3.0, 5.0, 8.0, 12.0, 20.0, 60.0)
    table = run.table()
    for axis, name in zip(axes, ("x", "y"), strict=True):
        for i, t in enumerate(times):
            x = line_at(run.profiles, int(np.argmin(np.abs(run.profiles.time_s - t))))
            axis.plot(x[:, "xy".index(name)], x[:, 2], color=COLOURS(0.9 * i / (len(times) - 1)), label=f"{t:.0f} s")
        axis.plot(table[f"{name}_m"], table.z_m, "k:", lw=0.9, label="path of the free end")
        axis.set(xlabel=f"{name} (m)", aspect="equal")
    axes[0].set(ylabel="z (m)", title="seen along the current")
    axes[1].set(title="seen across it", xlim=(-1.5, 5))
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside right center", fontsize=8)
    save(figure, "swinging_line.png")


def falling_chain():
    L, g = load_scene("falling_chain").tether.length_m, 9.81
    print("falling chain, hooks 2 cm apart: fall, m | time, s | folded chain | free fall")
    changes = {"end.position_m": [0.02, 0.0, 0.0], "tether.nodes": 641, "output.step_s": 1e-3}
    run = simulate(load_scene("falling_chain", changes | {"tether.bending_stiffness_Nm2": 1e-7}), duration_s=0.475)
    table = run.table()
    for x in (0.2, 0.4, 0.6, 0.8, 0.88):
        t = np.interp(x, -table.z_m[table.time_s > 0.1], table.time_s[table.time_s > 0.1]) - 0.1
        exact = quad(lambda u: 2 * math.sqrt((1 - u * u / L) / (2 * g * (1 - u * u / (2 * L)))), 0, math.sqrt(x))[0]
        print(f"  {x} | {t:.4f} | {exact:.4f} | {math.sqrt(2 * x / g):.4f}")


def main():
    draw_rope(*twisted_rope())
    draw_swing(swinging_line())
    falling_chain()


if __name__ == "__main__":
    main()
