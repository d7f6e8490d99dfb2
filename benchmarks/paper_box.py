"""The paper's scheme against the conservation form: figure and tables of docs/trust.md. About seven minutes.

    .venv/bin/python -m benchmarks.paper_box        # writes docs/paper_box.png

1. kA = 0.016: error in r over 10 s against nodes and against steps, true accelerations and the print's component rates.
2. kA = 0.13: the scheme without its guards through the first slacks: error in r by the shape of the line and by the
   path of its end, turn per element; and where the guards stop it, for more grids and steps.
"""

import math
import time

import numpy as np
import pandas as pd

from benchmarks.shared import DOCS, command_line, shrink
from engine import load_scene, simulate
from engine.paper_box.driver import run
from engine.paper_box.ends import force_and_velocity
from engine.paper_box.line import line_of, turns
from engine.paper_box.newton import solve
from engine.paper_box.nodal import level_of, positions
from engine.paper_box.start import at_rest
from engine.time.status import OK
from reports.figures.curves import COLOURS, Curve, Panel, curves
from reports.parts.style import SOFT

SMALL_S, LARGE_S = 10.0, 30.0
DEPTHS = (22.5, 21.6)
SEEDED = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.0, 1e-5, 0.0]}
STATISTICS = ("end_time_s", "closure_m", "max_turn_rad", "euler_norm_error")
SEEN_S = (5.4, 5.6, 6.0, 8.0, 10.0, 12.0, 20.0, 30.0)
UNGUARDED = ((41, 0.005), (81, 0.005), (161, 0.0025))  # nodes, step (s): steps that pass the first slack


def scene_of(steepness, depth_m, **overrides):
    return load_scene(
        "tethered_buoy", {"waves.steepness": steepness, "water.depth_m": depth_m, "output.step_s": 0.1, **overrides}
    )


def radius(trajectory):
    return trajectory.columns["radius_m"]


def boxed(nodes, step_s, accelerations=True):
    overrides = {"tether.nodes": nodes, "solver.step_s": step_s, "solver.scheme": "paper-box"}
    return radius(run(scene_of(0.016, 22.5, **overrides), SMALL_S, accelerations=accelerations))


def small_waves():
    """Errors in r (m) against nodes, steps extrapolated to zero, and against steps at 81 nodes."""
    fine = [
        radius(simulate(scene_of(0.016, 22.5, **{"tether.nodes": n, "solver.rtol": rtol}), duration_s=SMALL_S))
        for n, rtol in ((321, 1e-6), (161, 1e-5))
    ]
    print(f"kA 0.016, H 22.5: the reference is sure to {np.abs(fine[0] - fine[1]).max():.1e} m")
    grids, steps = (6, 11, 21, 41), (0.1, 0.05, 0.025, 0.0125, 0.00625)
    by_nodes = [np.abs((4 * boxed(n, 0.005) - boxed(n, 0.01)) / 3 - fine[0]).max() for n in grids]
    by_steps = [np.abs(boxed(81, step) - fine[0]).max() for step in steps]
    for name, values, errors in (("nodes", grids, by_nodes), ("step s", steps, by_steps)):
        print(f"  {name:7s}", *(f"{v:8g}: {e:.2e}" for v, e in zip(values, errors, strict=True)))
        print("    slopes", *(f"{s:.2f}" for s in np.log2(np.divide(errors[:-1], errors[1:]))))
    rates = np.abs(boxed(41, 0.0125, False) - boxed(41, 0.0125, True)).max()
    print(f"  component rates in place of accelerations move r by {rates:.1e} m")
    return grids, by_nodes, steps, by_steps


def unguarded(depth_m, nodes, step_s):
    """After every step, guards off: t, r by shape and by path, turn, | |beta|^2 - 1 |, r by the shape with |t| = 1."""
    overrides = {"tether.nodes": nodes, "solver.scheme": "paper-box", "solver.step_s": step_s}
    scene = scene_of(0.13, depth_m, **overrides)
    line = line_of(scene)
    code, Y = at_rest(scene, line)
    level = level_of(line, 0.0, Y)
    end, V = positions(line, Y)[:, -1], force_and_velocity(line, Y[:, -1])[1]
    rows = []
    for step in range(1, round(LARGE_S / step_s) + 1):
        code, _, next_level = solve(line, step * step_s, level, 60)
        if code != OK:
            break
        level, V_before = next_level, V
        V = force_and_velocity(line, level.Y[:, -1])[1]
        end = end + 0.5 * step_s * (V + V_before)
        Y = level.Y
        size = np.sum(Y[6:10] ** 2, 0)
        scaled = Y.copy()
        scaled[6:10] /= np.sqrt(size)
        by_shape = np.linalg.norm(positions(line, Y)[:, -1])
        by_unit_t = np.linalg.norm(positions(line, scaled)[:, -1])
        turn = turns(Y[6:10], Y[10:13], line.h).max()
        rows.append([level.t, by_shape, np.linalg.norm(end), turn, np.abs(size - 1).max(), by_unit_t])
    return np.array(rows).T


def reference(depth_m):
    overrides = {"tether.nodes": 321, "solver.rtol": 1e-3, "output.step_s": 0.005}
    fine = simulate(scene_of(0.13, depth_m, **overrides), duration_s=LARGE_S)
    coarse = simulate(scene_of(0.13, depth_m, **{**overrides, "tether.nodes": 161}), duration_s=LARGE_S)
    sure = np.abs(radius(fine) - radius(coarse)).max()
    turn = fine.statistics["max_turn_rad"]
    print(f"kA 0.13, H {depth_m}: the reference is sure to {sure:.1e} m, turn per element {turn:.2g} rad at 321 nodes")
    return fine.columns["time_s"], radius(fine)


def where_it_stops(depth_m, known):
    rows = []
    grids = [(nodes, step_s, {}) for nodes in (21, 41, 81, 161) for step_s in (0.0125, 0.005, 0.0025)]
    for nodes, step_s, motion in [*grids, (41, 0.005, SEEDED)]:
        overrides = {"tether.nodes": nodes, "solver.step_s": step_s, "solver.scheme": "paper-box", **motion}
        result = run(scene_of(0.13, depth_m, **overrides), LARGE_S)
        row = {"nodes": nodes, "step_s": step_s, "dimensions": 3 if motion else 2, "status": result.status}
        statistics = {name: result.statistics[name] for name in STATISTICS}
        off = abs(radius(result)[-1] - np.interp(result.columns["time_s"][-1], *known))
        rows.append({**row, **statistics, "last_error_m": off})
    print(pd.DataFrame(rows).to_string(index=False))


def large_waves(depth_m):
    """Panels of the error in r, by the shape solid and by the path dotted, and of the largest turn in one element."""
    known, errors, turned = reference(depth_m), [], []
    where_it_stops(depth_m, known)
    for (nodes, step_s), colour in zip(UNGUARDED, COLOURS, strict=False):
        start_s = time.perf_counter()
        t, shape, path, turn, norm, unit = unguarded(depth_m, nodes, step_s)
        r = np.interp(t, *known)
        label = f"{nodes} nodes, {1e3 * step_s:g} ms"
        print(f"  no guards, {label}: reached {t[-1]:.3f} s in {time.perf_counter() - start_s:.0f} s")
        columns = {"t": t, "shape": shape - r, "path": path - r, "|t| = 1": unit - r, "turn": turn, "|b|^2-1": norm}
        columns = pd.DataFrame({**columns, "turn before": np.maximum.accumulate(turn)})
        printed = [np.argmin(np.abs(t - time_s)) for time_s in SEEN_S if time_s <= t[-1] + 1e-9]
        print(columns.iloc[printed].round(5).to_string())
        shown = columns[:: round(0.05 / step_s)]
        for column, name, line in (("shape", label, "-"), ("path", "", ":")):
            errors.append(Curve(shown["t"], np.abs(shown[column]), name, line, colour=colour))
        turned.append(Curve(shown["t"], shown["turn"], colour=colour))
    title, limits = f"kA = 0.13, H = {depth_m} m", {"xlim": (0, LARGE_S)}
    error = Panel(errors, "t (s)", "error in r (m)", title, "y", settings={**limits, "ylim": (1e-6, 20)})
    return error, Panel(turned, "t (s)", "turn in one element (rad)", "", "y", math.pi / 2, limits)


def main():
    command_line(__doc__).parse_args()
    grids, by_nodes, steps, by_steps = small_waves()
    lines = []
    for name, mark, values, errors in (
        ("elements h (m), steps extrapolated", "o", 20.0 / (np.array(grids) - 1), by_nodes),
        ("steps (s), 81 nodes", "s", np.array(steps), by_steps),
    ):
        lines.append(Curve(values, errors, name, mark=mark))
        lines.append(Curve(values, errors[0] * (values / values[0]) ** 2, "", ":", colour=SOFT))
    title = "kA = 0.016, H = 22.5 m: distance from the conservation form; dotted: order 2"
    order = Panel(lines, "h (m) or step (s)", "largest error in r, 10 s (m)", title, "xy")
    large = [large_waves(depth_m) for depth_m in DEPTHS]
    path = DOCS / "paper_box.png"
    path.write_bytes(curves([[order], *zip(*large, strict=True)], 8.2, "lower right", kind="png").data)
    shrink(path, 48)


if __name__ == "__main__":
    main()
