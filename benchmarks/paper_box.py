"""The paper's scheme against the conservation form: figure and tables of docs/paper_box.md. About seven minutes.

    .venv/bin/python -m benchmarks.paper_box        # writes docs/paper_box.png

1. kA = 0.016: error in r over 10 s against nodes and against steps, true accelerations and the print's component rates.
2. kA = 0.13: the scheme without its guards through the first slacks: error in r by the shape of the line and by the
   path of its end, turn per element; and where the guards stop it, for more grids and steps.
"""

import math
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from benchmarks.shared import save
from engine import load_scene, simulate
from engine.paper_box import run
from engine.paper_box.ends import force_and_velocity
from engine.paper_box.frame import turns
from engine.paper_box.line import line_of
from engine.paper_box.newton import solve
from engine.paper_box.nodal import level_of, positions
from engine.paper_box.start import at_rest
from engine.time.status import OK

SMALL_S, LARGE_S = 10.0, 30.0
DEPTHS = (22.5, 21.6)
SEEDED = {"motion.dimensions": 3, "start.buoy_velocity_mps": [0.0, 1e-5, 0.0]}
UNGUARDED = ((41, 0.005), (81, 0.005), (161, 0.0025))  # nodes, step (s): steps that pass the first slack


def scene_of(steepness, depth_m, **overrides):
    return load_scene(
        "tethered_buoy", {"waves.steepness": steepness, "water.depth_m": depth_m, "output.step_s": 0.1, **overrides}
    )


def radius(trajectory):
    return trajectory.columns["radius_m"]


def boxed(depth_m, nodes, step_s, accelerations=True):
    overrides = {"tether.nodes": nodes, "solver.step_s": step_s, "solver.scheme": "paper-box"}
    return radius(run(scene_of(0.016, depth_m, **overrides), SMALL_S, accelerations=accelerations))


def small_waves():
    """Errors in r (m) against nodes, steps extrapolated to zero, and against steps at 81 nodes."""
    fine = [
        radius(simulate(scene_of(0.016, 22.5, **{"tether.nodes": n, "solver.rtol": rtol}), duration_s=SMALL_S))
        for n, rtol in ((321, 1e-6), (161, 1e-5))
    ]
    print(f"kA 0.016, H 22.5: the reference is sure to {np.abs(fine[0] - fine[1]).max():.1e} m")
    grids, steps = (6, 11, 21, 41), (0.1, 0.05, 0.025, 0.0125, 0.00625)
    by_nodes = [
        np.abs((4 * boxed(22.5, n, 0.005) - boxed(22.5, n, 0.01)) / 3 - fine[0]).max() for n in grids
    ]  # fmt: skip
    by_steps = [np.abs(boxed(22.5, 81, step) - fine[0]).max() for step in steps]
    for name, values, errors in (("nodes", grids, by_nodes), ("step s", steps, by_steps)):
        print(f"  {name:7s}", *(f"{v:8g}: {e:.2e}" for v, e in zip(values, errors, strict=True)))
        print("    slopes", *(f"{s:.2f}" for s in np.log2(np.divide(errors[:-1], errors[1:]))))
    rates = np.abs(boxed(22.5, 41, 0.0125, False) - boxed(22.5, 41, 0.0125, True)).max()
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
        code, _, after = solve(line, step * step_s, level, 60)
        if code != OK:
            break
        level, V_before = after, V
        V = force_and_velocity(line, level.Y[:, -1])[1]
        end = end + 0.5 * step_s * (V + V_before)
        Y = level.Y
        size = np.sum(Y[6:10] ** 2, 0)
        scaled = Y.copy()
        scaled[6:10] /= np.sqrt(size)
        by_shape, by_unit_t = (np.linalg.norm(positions(line, state)[:, -1]) for state in (Y, scaled))
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
    print("  nodes  step s   status         t s     gap m   turn rad  |b|^2-1  error in r at the last sample, m")
    grids = [(nodes, step_s, {}) for nodes in (21, 41, 81, 161) for step_s in (0.0125, 0.005, 0.0025)]
    for nodes, step_s, motion in [*grids, (41, 0.005, SEEDED)]:
        overrides = {"tether.nodes": nodes, "solver.step_s": step_s, "solver.scheme": "paper-box", **motion}
        found = run(scene_of(0.13, depth_m, **overrides), LARGE_S)
        told, t, r = found.statistics, found.columns["time_s"][-1], radius(found)[-1]
        print(
            f"  {nodes:5d}  {step_s:.4f}  {found.status:13s} {told['end_time_s']:7.4f}  {told['closure_m']:.4f}  "
            f"{told['max_turn_rad']:.3f}     {told['euler_norm_error']:.4f}   {abs(r - np.interp(t, *known)):.5f}"
            f"{'  in three dimensions, seeded' if motion else ''}"
        )


def large_waves(axes):
    for depth_m, (above, below) in zip(DEPTHS, axes, strict=True):
        known = reference(depth_m)
        where_it_stops(depth_m, known)
        for (nodes, step_s), colour in zip(UNGUARDED, ("C3", "C1", "C0"), strict=True):
            began = time.perf_counter()
            t, shape, path, turn, norm, unit = unguarded(depth_m, nodes, step_s)
            r = np.interp(t, *known)
            label = f"{nodes} nodes, {1e3 * step_s:g} ms"
            print(f"  no guards, {label}: reached {t[-1]:.3f} s in {time.perf_counter() - began:.0f} s")
            shown = slice(None, None, round(0.05 / step_s))
            above.semilogy(t[shown], np.abs(shape - r)[shown], colour, lw=1, label=label)
            above.semilogy(t[shown], np.abs(path - r)[shown], colour, lw=0.6, ls=":")
            below.semilogy(t[shown], turn[shown], colour, lw=1)
            for at in (5.4, 5.6, 6.0, 8.0, 10.0, 12.0, 20.0, 30.0):
                if at <= t[-1] + 1e-9:
                    k = np.argmin(np.abs(t - at))
                    print(
                        f"    t {at:4.1f}: shape {shape[k] - r[k]:+.5f}  path {path[k] - r[k]:+.5f}  "
                        f"|t| = 1 {unit[k] - r[k]:+.5f} m  "
                        f"turn {turn[k]:.3f} rad  |b|^2-1 {norm[k]:.4f};  before: turn {turn[: k + 1].max():.3f}"
                    )
        above.set(title=f"kA = 0.13, H = {depth_m} m", ylabel="error in r (m)", ylim=(1e-6, 20))
        below.set(ylabel="turn in one element (rad)", xlabel="t (s)", ylim=(1e-4, 20))
        below.axhline(math.pi / 2, color="0.5", lw=0.8, ls="--")
        for axis in (above, below):
            axis.set_xlim(0, LARGE_S)


def main():
    figure = plt.figure(figsize=(9, 8.2), layout="constrained")
    order, *large = figure.subplot_mosaic(
        [["order", "order"], ["e0", "e1"], ["t0", "t1"]], height_ratios=(1.1, 1, 1)
    ).values()
    grids, by_nodes, steps, by_steps = small_waves()
    h = 20.0 / (np.array(grids) - 1)
    order.loglog(h, by_nodes, "o-", label="elements h (m), steps extrapolated")
    order.loglog(steps, by_steps, "s-", label="steps (s), 81 nodes")
    order.loglog(h, by_nodes[0] * (h / h[0]) ** 2, "k:", lw=0.8, label="order 2")
    order.loglog(steps, by_steps[0] * (np.array(steps) / steps[0]) ** 2, "k:", lw=0.8)
    order.set(title="kA = 0.016, H = 22.5 m: distance from the conservation form")
    order.set(xlabel="h (m) or step (s)", ylabel="largest error in r, 10 s (m)")
    order.legend(fontsize=8)
    e0, e1, t0, t1 = large
    large_waves(((e0, t0), (e1, t1)))
    e0.legend(fontsize=7, loc="lower right", title="solid: by the shape, dotted: by the path", title_fontsize=7)
    save(figure, "paper_box.png", 48)


if __name__ == "__main__":
    main()
