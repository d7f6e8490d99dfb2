"""How fast the planar engine is, and how accurate at that speed; MoorDyn beside it where it is installed.

    python -m benchmarks.planar_speed [--rounds N] [--core N] [--without-moordyn]

Work 1  kA = 0.13, H = 22.5 m, ten wave periods from rest: slack and snap every period, period-2 motion.
Work 2  kA = 0.08, 0.09 ... 0.16, H = 21.6 m, 50 s: the median and the largest error over the nine values.
Error   rms over the samples (every 0.05 s) of r(t) - r(t) of a refined run. How far a second refined run, with other
        nodes and tolerance, is from the first is printed beside it. Both codes are held against their own refined run;
        what makes MoorDyn comparable, and what is left different, is said in `campaigns.accuracy.peers.moordyn`.
Time    of stepping alone (`wall_s`; MoorDyn: its stepping calls): no compilation, statics or input. One core.
Noise   Settings take turns (A B C A B C ...), so that the machine's noise meets all; medians over the rounds. Near a
        snap the error of a loose tolerance is partly luck: every round multiplies rtol by another factor between 0.8
        and 1.25, and the table gives the median and the worst error. "Cheapest" is by either; nothing is interpolated.
Refined runs are kept in the temporary directory, in a folder named by the hash of the engine's sources.
"""

import argparse
import os
import tempfile
import time
from itertools import product
from pathlib import Path

import numpy as np

from campaigns.accuracy.peers import moordyn
from engine import load_scene, simulate, source_hash

PERIODS = 10
WORK_1 = {"water.depth_m": 22.5, "waves.steepness": 0.13}
STEEPNESS_2 = tuple(round(0.08 + 0.01 * i, 2) for i in range(9))
FACTORS = (1.0, 0.9, 1.1, 0.8, 1.25)  # of rtol, one a round

NODES, STRETCHING, RTOL = (41, 61, 81, 101, 121), (0.0, 0.5, 1.0), (0.1, 0.06, 0.03, 0.01, 0.003)
TRBDF2 = ((41, 0.01), (41, 0.001), (81, 0.01), (81, 0.001))
WORK_2 = ((41, 0.1), (41, 0.06), (41, 0.03), (41, 0.01), (41, 0.003), (81, 0.03), (81, 0.01))
# segments, steps a period; the steps are the longest, to the next hundred, that stay stable
MOORDYN = ((5, 900), (8, 1200), (9, 1300), (10, 1500), (16, 2500), (20, 3200), (23, 3700), (24, 3800))
REFINED_1, SECOND_1 = (641, 1e-5), (481, 1e-4)
REFINED_2, SECOND_2 = (321, 2e-5), (481, 1e-4)
REFINED_MOORDYN, SECOND_MOORDYN = (160, 28000), (80, 14000)


def scene(base, nodes, rtol, stretching=0.0, integrator="esdirk43", **more):
    return load_scene(
        "tethered_buoy",
        base | more | {
            "tether.nodes": nodes, "tether.grid_stretching": stretching, "solver.rtol": rtol,
            "solver.integrator": integrator, "output.step_s": moordyn.SAMPLE,
        },
    )  # fmt: skip


def kept(name, compute):
    """The array in the benchmark's cache, computed on the first call."""
    folder = Path(tempfile.gettempdir(), f"tether-benchmarks-{source_hash()[:16]}")
    folder.mkdir(exist_ok=True)
    path = folder / f"{name}.npy"
    if not path.exists():
        np.save(path, compute())
    return np.load(path)


def refined(base, nodes, rtol, **more):
    """r(t) of a refined run."""
    wanted = scene(base, nodes, rtol, **more)

    def compute():
        run = simulate(wanted, periods=PERIODS)
        if run.status != "ok":
            raise SystemExit(f"the refined run ({base}, {nodes} nodes, rtol {rtol:g}) ended early: {run.message}")
        return run.columns["radius_m"]

    return kept(wanted.key()[:32], compute)


def refined_moordyn(base, segments, steps):
    wanted = scene(base, 41, 0.03)
    name = f"moordyn-{moordyn.version()}-{wanted.key()[:16]}-{segments}-{steps}"
    return kept(name, lambda: moordyn.run(wanted, segments, steps, PERIODS)[0])


def rms_mm(a, b):
    return 1e3 * float(np.sqrt(np.mean((a - b) ** 2))) if len(a) == len(b) else np.inf


def timed(wanted, reference):
    """(ms per wave period, error in mm, microseconds per Newton iteration) of one run of ours."""
    run = simulate(wanted, periods=PERIODS)
    wall, iterations = run.statistics["wall_s"], run.statistics["newton_iterations"]
    return 1e3 * wall / PERIODS, rms_mm(run.columns["radius_m"], reference), 1e6 * wall / iterations


def take_turns(settings, rounds):
    """settings: {label: callable(round) -> numbers}. Returns {label: array (rounds, numbers)}."""
    found = {label: [] for label in settings}
    for j in range(rounds):
        for label, measure in settings.items():
            found[label].append(measure(j))
    return {label: np.array(rows) for label, rows in found.items()}


def summary(rows):
    """Median ms per period, median error, worst error."""
    return float(np.median(rows[:, 0])), float(np.median(rows[:, 1])), float(rows[:, 1].max())


def cheapest(title, results, limits=(2.0, 5.0)):
    """Print the cheapest setting within each limit; {(limit, which): ms}."""
    found = {}
    for which, column in (("median", 1), ("worst", 2)):
        for limit in limits:
            within = [(summary(rows), label) for label, rows in results.items() if summary(rows)[column] <= limit]
            if not within:
                print(f"{title}, {which} error <= {limit:g} mm: none of these settings")
                continue
            (ms, median, worst), label = min(within)
            found[limit, which] = ms
            print(
                f"{title}, {which} error <= {limit:g} mm: {ms:.2f} ms at {label} ({median:.2f}, worst {worst:.2f} mm)"
            )
    return found


def work_1(rounds, with_moordyn):
    print(f"\nWork 1: kA = 0.13, H = 22.5 m, {PERIODS} wave periods")
    reference = refined(WORK_1, *REFINED_1)
    off = rms_mm(refined(WORK_1, *SECOND_1), reference)
    print(
        f"refined run {REFINED_1[0]} nodes, rtol {REFINED_1[1]:g}; "
        f"another ({SECOND_1[0]} nodes, rtol {SECOND_1[1]:g}) is {off:.2f} mm off"
    )

    def ours(nodes, rtol, stretching=0.0, integrator="esdirk43"):
        runs = [scene(WORK_1, nodes, rtol * factor, stretching, integrator) for factor in FACTORS]
        return lambda j: timed(runs[j % len(runs)], reference)

    settings = {
        f"{n} nodes, stretching {g:g}, rtol {r:g}": ours(n, r, g) for n, g, r in product(NODES, STRETCHING, RTOL)
    } | {f"trbdf2, {n} nodes, rtol {r:g}": ours(n, r, integrator="trbdf2") for n, r in TRBDF2}
    if with_moordyn:
        settings |= moordyn_settings()
    found = take_turns(settings, rounds)
    theirs = {label: rows for label, rows in found.items() if label.startswith("MoorDyn")}
    mine = {label: rows for label, rows in found.items() if label not in theirs}
    print_grid(mine)
    for label in [label for label in mine if label.startswith("trbdf2")] + list(theirs):
        ms, median, worst = summary(found[label])
        print(f"{label}: {ms:.2f} ms per period, {median:.2f} mm (worst {worst:.2f})")
    fast = cheapest("ours", mine)
    if theirs:
        slow = cheapest("MoorDyn", theirs)
        for limit, which in sorted(fast.keys() & slow.keys()):
            ratio = slow[limit, which] / fast[limit, which]
            print(f"MoorDyn's time over ours at {limit:g} mm ({which} error): {ratio:.1f}")
    per_iteration = np.median(found["41 nodes, stretching 0, rtol 0.03"][:, 2])
    print(f"41 nodes, rtol 0.03: {per_iteration:.2f} us per Newton iteration")


def print_grid(results):
    print("ms per wave period: median error in r (worst) in mm; columns are rtol")
    for stretching in STRETCHING:
        print(f"  stretching {stretching:g}".ljust(18) + "".join(f"{r:>22g}" for r in RTOL))
        for nodes in NODES:
            cells = [summary(results[f"{nodes} nodes, stretching {stretching:g}, rtol {r:g}"]) for r in RTOL]
            print(f"{nodes:>12} nodes" + "".join(f"{a:>9.2f}: {b:4.1f} ({c:4.1f})" for a, b, c in cells))


def moordyn_settings():
    """MoorDyn's settings for work 1, after a word on how far the two models agree."""
    reference = refined_moordyn(WORK_1, *REFINED_MOORDYN)
    off = rms_mm(refined_moordyn(WORK_1, *SECOND_MOORDYN), reference)
    print(f"MoorDyn's refined run: {REFINED_MOORDYN[0]} segments; with {SECOND_MOORDYN[0]} it is {off:.2f} mm off")
    small = WORK_1 | {"waves.steepness": 0.016}
    apart = rms_mm(refined_moordyn(small, 40, 8000), refined(small, 161, 1e-4))
    bent = rms_mm(reference, refined(WORK_1, *REFINED_1))
    limp = rms_mm(reference, refined(WORK_1, 321, 1e-4, **{"tether.bending_stiffness_Nm2": 4e-4}))
    print(
        f"the two refined models apart: {apart:.3f} mm at kA = 0.016 (never slack); at kA = 0.13 {bent:.1f} mm, "
        f"and {limp:.1f} mm with our bending stiffness cut to 4e-4 N m2"
    )
    wanted = scene(WORK_1, 41, 0.03)

    def measure(segments, steps):
        def once(j):
            radius, ms = moordyn.run(wanted, segments, steps, PERIODS)
            return ms, rms_mm(radius, reference), np.nan

        return once

    return {
        f"MoorDyn RK4, {segments} segments, step {5e3 / steps:.2f} ms": measure(segments, steps)
        for segments, steps in MOORDYN
    }


def work_2(rounds):
    print(f"\nWork 2: kA = {STEEPNESS_2[0]} ... {STEEPNESS_2[-1]}, H = 21.6 m, 50 s")
    bases = [{"water.depth_m": 21.6, "waves.steepness": steepness} for steepness in STEEPNESS_2]
    references = [refined(base, *REFINED_2) for base in bases]
    apart = [rms_mm(refined(base, *SECOND_2), r) for base, r in zip(bases, references, strict=True)]
    print(
        f"refined runs {REFINED_2[0]} nodes, rtol {REFINED_2[1]:g}; others ({SECOND_2[0]} nodes, rtol {SECOND_2[1]:g}) "
        f"are {np.median(apart):.2f} mm off in the median, {max(apart):.1f} at most"
    )

    def measure(nodes, rtol):
        runs = [[scene(base, nodes, rtol * factor) for base in bases] for factor in FACTORS]

        def once(j):
            rows = [timed(a, b) for a, b in zip(runs[j % len(runs)], references, strict=True)]
            ms, errors, per_iteration = np.array(rows).T
            return ms.mean(), np.median(errors), per_iteration.mean(), errors.max()

        return once

    found = take_turns({setting: measure(*setting) for setting in WORK_2}, rounds)
    for (nodes, rtol), rows in found.items():
        ms, error, per_iteration, most = np.median(rows, axis=0)
        print(
            f"{nodes:>4} nodes, rtol {rtol:<6g} {ms:5.2f} ms per wave period; median error {error:.1f} mm, "
            f"largest {most:.0f} mm (of all rounds {rows[:, 3].max():.0f}); {per_iteration:.2f} us per Newton iteration"
        )


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=5, help="turns of every setting (default 5)")
    parser.add_argument("--core", type=int, help="the core to run on (default: the last one allowed; Linux)")
    parser.add_argument("--without-moordyn", action="store_true")
    given = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0)) if given.core is None else given.core})
    print(f"load at the start: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores; {given.rounds} rounds")
    wanted = scene(WORK_1, 41, 0.03)
    simulate(wanted, periods=1)
    began = time.perf_counter()
    run = simulate(wanted, periods=PERIODS)
    whole = time.perf_counter() - began
    stepping = run.statistics["wall_s"]
    print(f"one call of simulate, {PERIODS} periods: {1e3 * whole:.1f} ms, of which stepping {1e3 * stepping:.1f}")
    with_moordyn = not given.without_moordyn and moordyn.version() is not None
    print(f"MoorDyn: {moordyn.version() or 'not installed: pip install moordyn==2.7.2'}")
    work_1(given.rounds, with_moordyn)
    work_2(given.rounds)
    print(f"load at the end: {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
