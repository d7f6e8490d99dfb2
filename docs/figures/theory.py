"""Draw the five figures of THEORY.md beside this file: python docs/figures/theory.py [FOLDER].

Each is drawn 5 inches wide on a white ground, so that it can be read at 400 pixels and on a dark page, and is the same
file each time.
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

INK, WATER, ROPE, FORCE, QUIET = "#1a1a1a", "#1f6fb2", "#b3541e", "#a3123f", "#707070"
STYLE = {"font.size": 11, "svg.hashsalt": "theory", "figure.facecolor": "white", "mathtext.fontset": "cm"}


def canvas(height, x, z, columns=1):
    """A figure 5 inches wide with `columns` empty axes of equal scale, showing x and z (each a pair)."""
    figure, axes = plt.subplots(1, columns, figsize=(5.0, height), squeeze=False)
    for ax in axes[0]:
        ax.set(xlim=x, ylim=z, aspect="equal")
        ax.axis("off")
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.01, top=0.99, wspace=0.02)
    return figure, axes[0]


def arrow(ax, start, step, text="", color=INK, at=1.15, **text_options):
    """An arrow from `start` by `step`, with its text at the fraction `at` of its length."""
    start, step = np.asarray(start, float), np.asarray(step, float)
    ax.annotate(
        "", start + step, start, arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.5, "mutation_scale": 12}
    )
    if text:
        options = {"ha": "center", "va": "center", "color": color, **text_options}
        ax.text(*(start + at * step), text, **options)


def system():
    """The buoy on its tether: axes, water, wave, current, polar coordinates, local frame."""
    figure, (ax,) = canvas(4.6, (-3.2, 7.2), (-1.0, 8.6))
    x = np.linspace(-3.2, 7.2, 200)
    ax.fill_between(x, 6.0 + 0.3 * np.cos(1.1 * x - 2.4), 0, color=WATER, alpha=0.10, lw=0)
    ax.plot(x, 6.0 + 0.3 * np.cos(1.1 * x - 2.4), color=WATER, lw=1.8)
    ax.plot(x[[0, -1]], [6.0, 6.0], color=WATER, lw=0.8, ls="--")
    ax.fill_between(x, 0, -0.5, color=QUIET, alpha=0.35, lw=0)
    u = np.linspace(0, 1, 60)
    rope = np.array([3.1 * u + 0.5 * np.sin(np.pi * u), 5.3 * u - 0.2 * np.sin(np.pi * u)])
    ax.plot(*rope, color=ROPE, lw=2.5)
    ax.add_patch(plt.Circle(rope[:, -1], 0.55, facecolor="white", edgecolor=INK, lw=1.5, zorder=3))
    ax.plot([0, 3.1], [0, 5.3], color=QUIET, lw=0.9, ls=":")
    ax.plot([0, 0], [2.2, 4.2], color=QUIET, lw=0.9, ls=":")
    turn = np.linspace(np.pi / 2, np.arctan2(5.3, 3.1), 20)
    ax.plot(3.6 * np.cos(turn), 3.6 * np.sin(turn), color=QUIET, lw=1)
    ax.text(0.75, 3.95, r"$\theta$", color=QUIET)
    ax.text(1.35, 3.25, "$r$", color=QUIET)
    arrow(ax, (0, 0), (1.6, 0), "$x$", at=1.18)
    arrow(ax, (0, 0), (0, 1.6), "$z$", at=1.18)
    ax.plot(0, 0, "o", color=INK, ms=5)
    ax.plot(-0.55, 0.55, "o", mfc="white", mec=INK, ms=10)
    ax.plot(-0.55, 0.55, "x", color=INK, ms=6)
    ax.text(-1.15, 0.55, "$y$", va="center")
    ax.text(-0.1, -0.3, "anchor, $s=0$", ha="right", va="center")
    ax.text(3.85, 5.05, "buoy, $s=l_0$", va="center")
    node = rope[:, 28]
    t = rope[:, 29] - rope[:, 27]
    t /= np.hypot(*t)
    arrow(ax, node, 1.3 * t, r"$\mathbf{t}$", ROPE, 1.2)
    arrow(ax, node, 1.3 * np.array([-t[1], t[0]]), r"$\mathbf{n}$", ROPE, 1.2)
    ax.plot([node[0], node[0] + 1.2], [node[1]] * 2, color=QUIET, lw=0.9)
    ax.text(node[0] + 0.95, node[1] + 0.42, r"$\varphi$", color=QUIET)
    arrow(ax, (-2.4, 7.3), (1.9, 0), color=WATER)
    ax.text(-2.4, 7.5, "wave travels", color=WATER)
    ax.text(6.9, 6.9, r"$\eta(x,t)$", color=WATER, ha="right")
    arrow(ax, (6.3, 0.05), (0, 5.9), color=WATER)
    ax.text(6.1, 3.0, "$H$", color=WATER, ha="right")
    for height in (1.4, 2.6, 3.8, 5.0):
        arrow(ax, (-3.0, height), (0.5 + 0.15 * height, 0), color=WATER)
    ax.text(-3.0, 5.4, r"$\mathbf{U}_w$", color=WATER)
    return figure


def element():
    """Free bodies: an element of the tether, and the buoy."""
    figure, (left_axes, right) = canvas(2.7, (-2.6, 2.6), (-2.9, 2.9), 2)
    t, n = np.array([0.6, 0.8]), np.array([-0.8, 0.6])
    corners = [side * 1.1 * t + edge * 0.25 * n for side, edge in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    left_axes.add_patch(plt.Polygon(corners, facecolor=ROPE, alpha=0.35, edgecolor=ROPE))
    arrow(left_axes, 1.1 * t, 1.15 * t, r"$\mathbf{N}+\mathbf{N}_s ds$", FORCE, 1.05, ha="right")
    arrow(left_axes, -1.1 * t, -1.15 * t, r"$-\mathbf{N}$", FORCE, 1.2)
    arrow(left_axes, (0, 0), (0, -1.7), r"$w_0$", FORCE, 1.18)
    arrow(left_axes, 0.25 * n, 1.2 * n, r"$F_n$", FORCE, 1.25)
    arrow(left_axes, -0.5 * t - 0.5 * n, 1.3 * t, r"$F_t$", FORCE, 0.95, ha="left", va="top")
    left_axes.text(-2.5, 2.6, r"$\mathbf{N}=T\mathbf{t}+S_n\mathbf{n}+S_b\mathbf{b}$", va="center")
    for sign in (1, -1):
        turn = np.linspace(0.2, 2.4, 20) + (0 if sign > 0 else np.pi)
        bend = sign * 0.8 * t[:, None] + 0.55 * np.array([np.cos(turn - 0.6), np.sin(turn - 0.6)])
        left_axes.plot(*bend, color=QUIET, lw=1.2)
    left_axes.text(1.55, 1.15, "$M$", color=QUIET)
    left_axes.text(-1.95, -0.85, "$M$", color=QUIET)
    right.add_patch(plt.Circle((0, 0), 0.75, facecolor="white", edgecolor=INK, lw=1.5))
    arrow(right, (0, 0.75), (0, 1.3), "$B$", FORCE, 1.2)
    arrow(right, (0, 0), (0, -1.9), "$W$", FORCE, 1.15)
    arrow(right, (-0.45, -0.6), (-0.95, -1.25), r"$-\mathbf{N}$", FORCE, 1.2)
    arrow(right, (0.75, 0.25), (1.2, 0), color=FORCE)
    arrow(right, (0.75, -0.25), (1.2, 0), color=FORCE)
    right.text(1.0, 0.4, "wave", color=FORCE, va="bottom")
    right.text(1.0, -0.4, "drag", color=FORCE, va="top")
    return figure


def box():
    """The box of the paper in space and time, and the box of the conservation form with its elimination."""
    figure, (left_axes, right) = canvas(2.6, (-1.6, 3.4), (-0.9, 4.3), 2)
    left_axes.add_patch(plt.Rectangle((0, 0.6), 2.2, 2.2, facecolor=WATER, alpha=0.12, edgecolor=WATER))
    for x in (0, 2.2):
        for z in (0.6, 2.8):
            left_axes.plot(x, z, "o", color=INK, ms=7)
    left_axes.plot(1.1, 1.7, "s", color=FORCE, ms=6)
    left_axes.text(1.1, 1.95, "eq. (28)", ha="center", va="bottom", color=FORCE)
    for x, text in ((0, "$t_{i-1}$"), (2.2, "$t_i$")):
        left_axes.text(x, 0.15, text, ha="center")
    for z, text in ((0.6, "$k-1$"), (2.8, "$k$")):
        left_axes.text(-0.25, z, text, ha="right", va="center")
    left_axes.text(0.9, 3.8, "paper", ha="center")
    right.plot([0.6, 0.6], [-0.3, 3.4], color=ROPE, lw=2)
    for z, text in ((0.6, r"$a$"), (2.2, r"$b$"), (3.3, ""), (-0.3, "")):
        right.plot(0.6, z, "o", color=INK, ms=7)
        right.text(0.25, z, text, ha="right", va="center")
    right.text(0.9, 0.6, r"$v_a=R_ay_a+r_a$", va="center", color=WATER)
    right.text(0.9, 2.2, r"$v_b=R_by_b+r_b$", va="center", color=WATER)
    arrow(right, (1.6, 0.95), (0, 0.9), color=WATER)
    arrow(right, (-0.9, 0.6), (0, 1.6), color=QUIET)
    arrow(right, (-0.9, 2.2), (0, -1.6), "$h$", QUIET, 0.5, ha="right")
    right.text(0.9, 3.8, "stage, eliminated upward", ha="center")
    return figure


def stages():
    """One stage of a step: its rate is the slope from C~ to C over 1/c0."""
    figure, ax = plt.subplots(figsize=(5.0, 2.8))
    time = np.linspace(0, 1, 200)
    path = 0.15 + 0.7 * time**2
    ax.plot(time, path, color=WATER, lw=2)
    for c in (0.0, 0.5, 0.8, 1.0):
        level = np.interp(c, time, path)
        ax.plot(c, level, "o", color=INK, ms=6)
        ax.plot([c, c], [0, level], color=QUIET, lw=0.7, ls=":")
    c, back = 0.8, 0.25
    level, slope = np.interp(c, time, path), 1.4 * c
    start = (c - back, level - back * slope)
    ax.plot(*start, "s", color=FORCE, ms=7)
    ax.annotate("", (c, level), start, arrowprops={"arrowstyle": "-|>", "color": FORCE, "lw": 1.6})
    ax.text(start[0] + 0.02, start[1] - 0.03, r"$\tilde C$", color=FORCE, va="top")
    ax.text(c + 0.02, level - 0.02, "$C_i$", va="top")
    ax.text(0.14, 0.62, r"$K_i=c_0\,(C_i-\tilde C)$", color=FORCE)
    ax.annotate("", (c, 0.1), (c - back, 0.1), arrowprops={"arrowstyle": "<->", "color": QUIET})
    ax.text(c - back / 2, 0.13, r"$1/c_0=a_{ii}\Delta t$", ha="center", va="bottom", color=QUIET, fontsize=10)
    ax.set(xlim=(-0.08, 1.12), ylim=(0, 1.0), yticks=[], xticks=[0, 0.5, 0.8, 1])
    ax.set_xticklabels(["$t_n$", r"$t_n+c_j\Delta t$", r"$t_n+c_i\Delta t$", r"$t_{n+1}$"])
    ax.text(-0.06, np.interp(0, time, path) + 0.07, "$C_n$")
    ax.text(1.02, path[-1] + 0.02, "$C_{n+1}$")
    ax.spines[["top", "right", "left"]].set_visible(False)
    figure.subplots_adjust(left=0.02, right=0.98, bottom=0.13, top=0.98)
    return figure


def loop(size, count=241):
    """Angle of the tangent along a straight line with one loop of relative size `size`, and its shape."""
    s = np.linspace(-1, 1, count)
    phi = np.pi / 2 + np.pi * (1 + np.tanh(s / size))
    step = s[1] - s[0]
    return s, phi, np.cumsum(np.cos(phi)) * step, np.cumsum(np.sin(phi)) * step


def loop_release():
    """A loop of slack rope is pulled tight in the plane, until one element turns by pi; then it is released."""
    figure, axes = plt.subplots(1, 4, figsize=(5.0, 2.5), width_ratios=[1, 1, 1, 1.5])
    for ax, size, title in zip(axes, (0.25, 0.08, None), ("slack", "pulled tight", "released"), strict=False):
        if size:
            _, _, x, z = loop(size)
            ax.plot(x - x[0], z, color=ROPE, lw=2)
        else:
            ax.plot([0, 0], [0, 1.9], color=ROPE, lw=2)
        ax.set(xlim=(-0.35, 0.35), ylim=(-0.1, 2.1), aspect="equal")
        ax.set_title(title, fontsize=10)
        ax.axis("off")
    ax = axes[3]
    s, phi, *_ = loop(0.02, 12)
    ax.plot(s, phi, "o-", color=INK, ms=4, lw=1)
    ax.plot(s[6:], phi[6:] - 2 * np.pi, "o--", color=FORCE, ms=4, lw=1)
    ax.annotate("", (0.6, np.pi / 2 + 0.3), (0.6, 2.5 * np.pi - 0.3), arrowprops={"arrowstyle": "-|>", "color": FORCE})
    ax.text(0.52, 1.5 * np.pi, r"$-2\pi$", color=FORCE, ha="right", va="center")
    ax.set(xticks=[], yticks=[0.5 * np.pi, 2.5 * np.pi], ylim=(0, 3 * np.pi))
    ax.set_yticklabels([r"$\pi/2$", r"$5\pi/2$"], fontsize=9)
    ax.set_xlabel("node", fontsize=10)
    ax.set_title(r"$\varphi$", fontsize=11)
    ax.spines[["top", "right"]].set_visible(False)
    figure.subplots_adjust(left=0.01, right=0.98, bottom=0.14, top=0.88, wspace=0.25)
    return figure


FIGURES = {"system": system, "element": element, "box": box, "stages": stages, "loop_release": loop_release}


def main(folder):
    """Write FIGURES as SVG files into `folder`; returns their paths."""
    paths = []
    with plt.rc_context(STYLE):
        for name, draw in FIGURES.items():
            figure = draw()
            paths.append(Path(folder) / f"{name}.svg")
            figure.savefig(paths[-1], metadata={"Date": None})
            plt.close(figure)
    return paths


if __name__ == "__main__":
    for path in main(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent):
        print(path)
