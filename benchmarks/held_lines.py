"""Held lines: the figures and tables of docs/scenes.md#held-lines. About half a minute; nothing is timed.

    .venv/bin/python -m benchmarks.held_lines       # writes docs/twisted_rope.png and docs/swinging_line.png

1. The twisted rope: rest against the localised buckle over nodes, and its shape.
2. The swinging line: its path over nodes and tolerance.
3. The falling chain: its fall against that of a chain folded without gap (Calkin & March 1989).

Closed forms are those that tests/engine/spatial checks.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import quad
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from benchmarks.shared import DOCS, command_line, shrink
from engine import load_scene, simulate
from reports.figures.curves import Curve, Panel, curves
from reports.parts.content import Picture
from tests.engine.spatial.test_held_lines import LENGTH as L
from tests.engine.spatial.test_held_lines import G, fall
from tests.engine.spatial.test_torsion_localised import slack_of, torque_of


@dataclass(frozen=True)
class Localised:
    """The buckle of an infinitely long rod under tension T and torque M (Coyne 1990; van der Heijden & Thompson 2000).

    With m = M/(2 sqrt(EI T)), k = sqrt(T/EI), a = sqrt(1 - m^2), theta and psi the polar angles of t about the axis,
    1 - cos theta = 2 a^2 sech^2(k a s),  psi = m k s + arctan((a/m) tanh(k a s)).
    deflection: largest distance from the axis, m; half of what the ends come closer, extension left out.
    """

    k: float
    T: float
    m: float
    deflection: float

    def angles(self, s):
        """theta and psi at s from the middle."""
        k, a, m = self.k, np.sqrt(1 - self.m**2), self.m
        return 2 * np.arcsin(a / np.cosh(k * a * s)), m * k * s + np.arctan(a / m * np.tanh(k * a * s))


def localised(scene, slack_m):
    """The localised buckle of the scene's rope and twist with this slack."""
    m = brentq(lambda m: slack_of(scene, m) - slack_m, 0.56, 1 - 1e-12)
    EI = scene.tether.bending_stiffness_Nm2
    T = torque_of(scene, m) ** 2 / (4 * EI * m**2)
    return Localised(np.sqrt(T / EI), T, m, 0.5 * slack_m)


def shape(buckle, length, middle, count=4001):
    """x, y, z (count, 3) of the buckle, z along the axis, from integrals of t, with its middle at `middle`."""
    s = np.linspace(-length / 2, length / 2, count)
    theta, psi = buckle.angles(s)
    t = np.stack([np.sin(theta) * np.cos(psi), np.sin(theta) * np.sin(psi), np.cos(theta)], 1)
    x = np.vstack([np.zeros(3), np.cumsum(0.5 * np.diff(s)[:, None] * (t[1:] + t[:-1]), axis=0)])
    x[:, :2] -= 0.5 * (x[0, :2] + x[-1, :2])
    off = x[count // 2]
    angle = math.atan2(middle[1], middle[0]) - math.atan2(off[1], off[0])
    return Rotation.from_euler("z", angle).apply(x) + np.array([0.0, 0.0, middle[2] - off[2]])


def line_at(profiles, time_s):
    """x, y, z (n, 3) of the line at the kept time next to `time_s`."""
    i = int(np.argmin(np.abs(profiles.time_s - time_s)))
    return np.stack([profiles.x_m[i], profiles.y_m[i], profiles.z_m[i]], 1)


def rope_shapes(moments: list[tuple[str, np.ndarray, np.ndarray, np.ndarray]]) -> Picture:
    """Three views: x-z in true proportion, y-z and x-y with y enlarged by its own axis.

    Args: per moment a label and x, y, z (nn,) in m of the nodes, from the anchor to the upper end.
    """
    from matplotlib import colormaps

    panels = []
    for title, across, up in (("from the side", "x", "z"), ("along x", "y", "z"), ("from above", "x", "y")):
        lines = []
        for k, (label, *places) in enumerate(moments):
            shade = colormaps["viridis"](0.85 * k / max(len(moments) - 1, 1))
            horizontal, vertical = places["xyz".index(across)], places["xyz".index(up)]
            lines.append(Curve(horizontal, vertical, label, mark=".", colour=shade, size=2.0, width=0.8))
            lines.append(Curve(horizontal[-1:], vertical[-1:], line="", mark="o", colour=shade, size=5.0))
        settings = {}
        if title == "from the side":
            settings = {"aspect": "equal", "adjustable": "datalim"}
        panels.append(Panel(lines, f"${across}$ (m)", f"${up}$ (m)", title, settings=settings, ticks=4))
    return curves([panels], 3.6, "below", kind="png")


def draw(name, profiles, times, **curves):
    """docs/NAME.png: the line at some times, and more lines (n, 3), from three sides."""
    lines = curves | {f"{time_s:g} s": line_at(profiles, time_s) for time_s in times}
    path = DOCS / f"{name}.png"
    path.write_bytes(rope_shapes([(label, *x.T) for label, x in lines.items()]).data)
    shrink(path, 128)


def twisted_rope():
    print("twisted rope: nodes | T, N | off axis, m | against the localised buckle, %")
    for nodes in (61, 121, 241, 481, 961):
        scene = load_scene("twisted_rope", {"tether.nodes": nodes})
        run = simulate(scene, duration_s=100.0)
        table, length, rest = run.table(), scene.tether.length_m, line_at(run.profiles, 100.0)
        pull, off = table.tension_top_N.iloc[-1], np.hypot(*rest[:, :2].T).max()
        buckle = localised(scene, length - table.z_m.iloc[-1])
        deviations = 100 * (np.array([pull / buckle.T, off / buckle.deflection]) - 1)
        print(f"  {nodes} | {pull:.4f} | {off:.4f} | {deviations[0]:+.2f} {deviations[1]:+.2f}", run.status)
        if nodes == 241:
            closed = shape(buckle, length, rest[nodes // 2])
            draw("twisted_rope", run.profiles, (10.0, 25.0, 40.0, 55.0, 100.0), **{"closed form": closed})
    print(f"  closed form: T {buckle.T:.4f} N, {buckle.deflection:.4f} m, m {buckle.m:.4f}")


def swinging_line():
    print("swinging line: largest change of the free end's path over 60 s against 321 nodes; of rtol/10")

    def swung(**changes):
        run = simulate(load_scene("swinging_line", changes), duration_s=60.0)
        return run, run.table()[["x_m", "y_m", "z_m"]].to_numpy()

    paths = {nodes: swung(**{"tether.nodes": nodes})[1] for nodes in (41, 161, 321)}
    shipped, paths[81] = swung(**{"tether.nodes": 81})
    paths["81, rtol 0.003"] = swung(**{"solver.rtol": 0.003})[1]
    for name, against in ((41, 321), (81, 321), (161, 321), ("81, rtol 0.003", 81)):
        print(f"  {name}: {1e3 * np.linalg.norm(paths[name] - paths[against], axis=1).max():.2f} mm")
    times = (0.0, 3.0, 5.0, 8.0, 12.0, 20.0, 60.0)
    draw("swinging_line", shipped.profiles, times, **{"path of the free end": paths[81]})


def falling_chain():
    print("falling chain, hooks 2 cm apart: fall, m | time, s | folded chain | free fall")
    tight = {"end.position_m": [0.02, 0.0, 0.0], "tether.nodes": 641, "tether.bending_stiffness_Nm2": 1e-7}
    t, _, z = fall(0.475, **tight, **{"output.step_s": 1e-3})
    for x in (0.2, 0.4, 0.6, 0.8, 0.88):
        exact = quad(lambda u: 2 * math.sqrt((1 - u * u / L) / (2 * G * (1 - u * u / (2 * L)))), 0, math.sqrt(x))[0]
        print(f"  {x} | {np.interp(x, -z[t > 0], t[t > 0]):.4f} | {exact:.4f} | {math.sqrt(2 * x / G):.4f}")


if __name__ == "__main__":
    command_line(__doc__).parse_args()
    twisted_rope()
    swinging_line()
    falling_chain()
