"""What each piece of a run costs at the default setting: `costs.json`, microseconds per Newton iteration and per run.

Assembly, waves and elimination are timed by themselves, each repeated on the state of the buoy in mid motion; what a
Newton iteration of a whole run costs beyond them is the rest of Newton's method and of the stages. Output is the
difference between runs that keep a sample every hundredth of a period and hardly any; Python is what a call of
`simulate` takes beyond its stepping: the scene as numbers, statics, the record.
"""

import json
import statistics
import time
from pathlib import Path

import numpy as np

from campaigns.accuracy_works import BUOY
from engine.atomic import write_atomic

REPEATS, ROUNDS = 20_000, 7
PERIODS = 40
CHANGES = {"waves.steepness": 0.13, "water.depth_m": 22.5}  # Table 1 in the waves of the snapping work
STAGE_S = 0.02  # of the implicit stage that is assembled: about that of a usual step


def keep(out: Path, quick: bool = False) -> None:
    """Write costs.json unless it is there already, from this very engine. Raises OSError."""
    from engine import source_hash

    path = out / "costs.json"
    try:
        if json.loads(path.read_text(encoding="utf-8"))["engine"] == source_hash():
            return
    except (OSError, ValueError, KeyError, TypeError):
        pass
    content = {"engine": source_hash(), **costs(rounds=3 if quick else ROUNDS)}
    write_atomic(path, (json.dumps(content, indent=2) + "\n").encode())


def costs(rounds: int = ROUNDS) -> dict[str, object]:
    """Microseconds of every piece, {"nodes", "rtol", "per_iteration_us": {...}, "per_run_ms": {...}, ...}."""
    from engine import load_scene, simulate

    scene = load_scene(BUOY, CHANGES)
    sparse = load_scene(BUOY, CHANGES | {"output.step_s": PERIODS * scene.waves.period_s})
    times = {"run": [], "sparse": [], "call": []}
    for _ in range(rounds):
        began = time.perf_counter()
        run = simulate(scene, periods=PERIODS)
        times["call"].append(time.perf_counter() - began)
        times["run"].append(run.statistics["wall_s"])
        times["sparse"].append(simulate(sparse, periods=PERIODS).statistics["wall_s"])
    run_s, sparse_s, call_s = (statistics.median(values) for values in times.values())
    iterations = run.statistics["newton_iterations"]
    pieces = _pieces(run, rounds)
    output = max(run_s - sparse_s, 0.0)
    per_iteration = {
        "assembly": pieces["assembly"],
        "waves": pieces["waves"],
        "elimination": pieces["all"] - pieces["assembly"] - pieces["waves"],
        "rest of Newton and stages": 1e6 * (run_s - output) / iterations - pieces["all"],
        "output": 1e6 * output / iterations,
    }
    return {
        "nodes": scene.tether.nodes,
        "rtol": scene.solver.rtol,
        "integrator": scene.solver.integrator,
        "periods": PERIODS,
        "newton_iterations": iterations,
        "steps": run.statistics["steps"],
        "per_iteration_us": per_iteration,
        "stepping_ms": 1e3 * run_s,
        "python_ms": 1e3 * (call_s - run_s),
    }


def _pieces(run, rounds: int) -> dict[str, float]:
    """Median microseconds of one assembly of nodal quantities, of the waves, and of a whole linear solve."""
    from engine.parameters import record_of
    from engine.planar import state

    tables: list = []
    record = record_of(run.scene, tables)
    tables = np.concatenate(tables)
    p, n = record[0], int(record[0]["nodes"])
    Y, C = _mid_motion(run, n)
    X, F, Q, E, D, _ = state.work_arrays(p, n)
    loops = _loops()
    found = {}
    for name, loop in loops.items():
        loop(p, tables, Y, C, X, F, Q, E, D, 10)
        times = []
        for _ in range(rounds):
            began = time.perf_counter()
            loop(p, tables, Y, C, X, F, Q, E, D, REPEATS)
            times.append(time.perf_counter() - began)
        found[name] = 1e6 * statistics.median(times) / REPEATS
    return found


def _mid_motion(run, n: int) -> tuple[np.ndarray, np.ndarray]:
    """A state (n, 6) like those of the run: the straight line between its ends, stretched and moving."""
    top = {name: float(run.columns[name][-1]) for name in ("x_m", "z_m", "radius_m")}
    length = run.scene.tether.length_m
    share = np.linspace(0.0, 1.0, n)
    Y = np.zeros((n, 6))
    Y[:, 0] = top["radius_m"] / length - 1.0
    Y[:, 2] = 0.5 * share
    Y[:, 3] = 0.2 * share
    Y[:, 4] = np.arctan2(top["z_m"], top["x_m"])
    C = np.column_stack([(1 + Y[:, 0]) * np.cos(Y[:, 4]), (1 + Y[:, 0]) * np.sin(Y[:, 4]), Y[:, 2], Y[:, 3]])
    return Y, C


def _loops() -> dict:
    import numba

    from engine.planar import node, state

    rate = 1.0 / STAGE_S

    @numba.njit
    def assembly(p, tables, Y, C, X, F, Q, E, D, count):
        for _ in range(count):
            node.shape(p, tables, Y, Q, X)
            node.node_quantities(p, tables, rate, rate, 1.0, Y, C, F, Q)

    @numba.njit
    def waves(p, tables, Y, C, X, F, Q, E, D, count):
        for i in range(count):
            node.water(p, tables, 1e-3 * i, 1.0, X, F)

    @numba.njit
    def everything(p, tables, Y, C, X, F, Q, E, D, count):
        for i in range(count):
            state.assemble(p, tables, 1e-3 * i, 1.0, rate, rate, Y, C, X, F, Q, E, D)

    return {"assembly": assembly, "waves": waves, "all": everything}
