"""What each piece of a run costs at the default setting: `costs.json`, microseconds per Newton iteration and per run.

Assembly, waves and elimination are timed by themselves, each repeated on the state of the buoy in mid motion; what a
Newton iteration of a whole run costs beyond them is the rest of Newton's method and of the stages. Output is the
difference between runs that keep a sample every hundredth of a period and hardly any; Python is what a call of
`simulate` takes beyond its stepping: the scene as numbers, statics, the record.
"""

import time
from functools import partial
from pathlib import Path
from timeit import timeit

import numba

from campaigns.accuracy.plan import BUOY
from campaigns.machinery.folder import keep_json, kept_json
from engine import load_scene, simulate, source_hash
from engine.arrays import Stage
from engine.physics.water import water
from engine.planar import node
from engine.run import Run
from engine.time.newton import assemble

REPEATS, ROUNDS = 5_000, 15
PERIODS = 40
CHANGES = {"waves.steepness": 0.13, "water.depth_m": 22.5}  # Table 1 in the waves of the snapping work
RATE = 1.0 / 0.02  # of the implicit stage that is assembled: about that of a usual step, 0.02 s


# Each piece over and over: of a record, its tables, a state in mid motion, and Newton's work arrays.
@numba.njit
def assembly(p, tables, Y, work, count):
    for _ in range(count):
        node.shape(p, tables, Y, work.Q, work.X)
        node.node_quantities(p, tables, Stage(0.0, 1.0, RATE, RATE), Y, work)


@numba.njit
def waves(p, tables, Y, work, count):
    for i in range(count):
        water(p, tables, 1e-3 * i, 1.0, work.X, work.F)


@numba.njit
def everything(p, tables, Y, work, count):
    for i in range(count):
        assemble(p, tables, Stage(1e-3 * i, 1.0, RATE, RATE), Y, work)


LOOPS = {"assembly": assembly, "waves": waves, "all": everything}


def keep(out: Path, quick: bool = False) -> None:
    """Write costs.json unless it is there already, from this very engine. Raises OSError."""
    path, engine = out / "costs.json", {"engine": source_hash()}
    if not engine.items() <= kept_json(path).items():
        keep_json(path, engine | costs(rounds=3 if quick else ROUNDS))


def costs(rounds: int = ROUNDS) -> dict[str, object]:
    """What every piece costs: a Newton iteration in `per_iteration_us`, a whole run in `stepping_ms`, `python_ms`.

    All take turns, and the least of the rounds counts: what else the machine does only adds.
    """
    scene = load_scene(BUOY, CHANGES)
    sparse = load_scene(BUOY, CHANGES | {"output.step_s": PERIODS * scene.waves.period_s})
    state = Run(scene, PERIODS * scene.waves.period_s)
    state.advance(state.goal)
    work = state.kind.work_arrays(state.record, scene.tether.nodes)
    work.C_tilde[:] = state.motion.C
    loops = {name: partial(loop, state.record, state.tables, state.motion.Y, work) for name, loop in LOOPS.items()}
    entries = []
    for loop in loops.values():
        loop(10)
    for _ in range(rounds):
        start_s = time.perf_counter()
        run = simulate(scene, periods=PERIODS)
        times = {"call": time.perf_counter() - start_s - run.statistics["wall_s"], "run": run.statistics["wall_s"]}
        times["sparse"] = simulate(sparse, periods=PERIODS).statistics["wall_s"]
        entries.append(
            times | {name: timeit(partial(loop, REPEATS), number=1) / REPEATS for name, loop in loops.items()}
        )
    least = {name: min(times[name] for times in entries) for name in entries[0]}
    iterations = run.statistics["newton_iterations"]
    output = max(least["run"] - least["sparse"], 0.0)
    seconds = {
        "assembly": least["assembly"],
        "waves": least["waves"],
        "elimination": least["all"] - least["assembly"] - least["waves"],
        "rest of Newton and stages": (least["run"] - output) / iterations - least["all"],
        "output": output / iterations,
    }
    return {
        "nodes": scene.tether.nodes,
        "rtol": scene.solver.rtol,
        "integrator": scene.solver.integrator,
        "periods": PERIODS,
        "newton_iterations": iterations,
        "steps": run.statistics["steps"],
        "per_iteration_us": {name: 1e6 * value for name, value in seconds.items()},
        "stepping_ms": 1e3 * least["run"],
        "python_ms": 1e3 * least["call"],
    }
