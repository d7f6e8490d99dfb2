"""No timing: how often `campaigns.sea` has the right sign of the exponent of a sea. 40 minutes on two cores.

    .venv/bin/python -m benchmarks.sea_signs [--cells N] [--nodes N]

Random seas about the shipped buoy with the wetted cap: significant steepness 0.01 to 0.14, relative width 0.002 to 0.2,
depth 21 to 25 m, 64 waves. The campaign's rule: eight quarters of an hour, and twice as many while the exponent is
within CLEAR errors of 0, up to twelve hours. The reference: three other seas of 3,000 periods at a quarter of the
tolerance.
"""

import math
from collections.abc import Sequence

import numpy as np
from joblib import Parallel, delayed

from analysis import sea_lyapunov
from benchmarks.shared import command_line
from campaigns.sea.rows import CLEAR
from engine import load_scene, simulate_batch

TRANSIENT, QUARTER_S, FEWEST, MOST = 40, 900.0, 8, 48  # periods; seconds; seas
REFERENCE_SEEDS, REFERENCE_PERIODS, TIGHTER = (101, 102, 103), 3000, 0.0075


def states(count: int) -> list[dict]:
    random, drawn = np.random.default_rng(20261128), []
    for _ in range(count):
        steepness = round(random.uniform(0.01, 0.14), 4)
        width = round(math.exp(random.uniform(math.log(0.002), math.log(0.2))), 4)
        keys = {"waves.significant_steepness": steepness, "waves.relative_width": width}
        drawn.append(keys | {"water.depth_m": round(random.uniform(21.0, 25.0), 2)})
    return drawn


def exponent(state: dict, nodes: int, seeds: Sequence[int], periods: int, rtol: float | None = None) -> tuple:
    """Exponent and error in bits a peak period, over seas of these seeds."""
    usual = {"buoy.submergence": "spherical-cap", "waves.jonswap": None}
    usual |= {"waves.component_count": 64, "output.tangent_vectors": 1, "tether.nodes": nodes}
    if rtol is not None:
        usual["solver.rtol"] = rtol
    scenes = [load_scene("tethered_buoy", usual | state | {"waves.seed": seed}) for seed in seeds]
    growths = [run.tangent.growth_nats[:, 0] for run in simulate_batch(scenes, periods=periods) if run.status == "ok"]
    found = sea_lyapunov(growths, TRANSIENT)
    return found.value, found.error


def by_rule(state: dict, nodes: int) -> tuple:
    seas, period_s = FEWEST, load_scene("tethered_buoy").waves.period_s
    while True:
        value, error = exponent(state, nodes, range(1, seas + 1), TRANSIENT + round(QUARTER_S / period_s))
        if abs(value) >= CLEAR * error or seas >= MOST:
            return value, error, seas
        seas = min(2 * seas, MOST)


def sign(value: float, error: float) -> str:
    if abs(value) <= 2.0 * error:
        return "open"
    return "+" if value > 0.0 else "−"


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--cells", type=int, default=20, help="seas to draw (default 20)")
    parser.add_argument("--nodes", type=int, default=41, help="nodes of the line (default 41)")
    options = parser.parse_args()
    drawn = states(options.cells)
    workers = Parallel(2, return_as="generator")
    ruled = list(workers(delayed(by_rule)(state, options.nodes) for state in drawn))
    reference = REFERENCE_SEEDS, REFERENCE_PERIODS, TIGHTER
    exact = workers(delayed(exponent)(state, options.nodes, *reference) for state in drawn)
    print(
        "| k H_s/2 | width | depth (m) | seas | exponent | sign | reference | sign |\n|---|---|---|---|---|---|---|---|"
    )
    right = 0
    for state, (value, error, seas), (true, true_error) in zip(drawn, ruled, exact, strict=True):
        signs = sign(value, error), sign(true, true_error)
        right += signs[0] == signs[1]
        place = " | ".join(f"{number:g}" for number in state.values())
        found, truth = f"{value:+.3f} ± {error:.3f}", f"{true:+.3f} ± {true_error:.3f}"
        print(f"| {place} | {seas} | {found} | {signs[0]} | {truth} | {signs[1]} |", flush=True)
    print(f"\n{right} of {len(drawn)} signs are those of the reference")


if __name__ == "__main__":
    main()
