"""Does the error of an exponent cover its start? One wave, many starts, a run each.

    python -m benchmarks.exponent_over_starts [--waves 21 700 20.8 400] [--steepness 0.13] [--starts 16] [--write]

The first run begins at rest, the others with a velocity of the buoy drawn from -2 to 2 m/s along x and along z. After
the transient each run has an exponent with the error of `analysis.tangent_lyapunov`, which knows this run alone. The
scatter of the runs is the true error; z = (exponent of a run - mean of all)/its error has a standard deviation of 1
where errors are right. A row has the mean of all with the error that its scatter gives, both errors of one run, and z.
Five minutes of a core a row. --waves: pairs of a depth (m) and the wave periods of each run; --write: into the page.
"""

import numpy as np

from analysis import tangent_lyapunov
from benchmarks.shared import command_line
from benchmarks.write_tables import publish
from engine import load_scene, simulate_each

TRANSIENT, SPEED_MPS = 100, 2.0


def growth_of_starts(depth_m, steepness, starts, periods):
    """Growth (periods, nats) of every run that reaches its end, in the order of the starts."""
    random, scenes = np.random.default_rng(5), []
    for start in range(starts):
        x, z = random.uniform(-SPEED_MPS, SPEED_MPS, 2) if start else (0.0, 0.0)
        changes = {"waves.steepness": steepness, "water.depth_m": depth_m, "output.tangent_vectors": 1}
        scenes.append(load_scene("tethered_buoy", {**changes, "start.buoy_velocity_mps": [float(x), 0.0, float(z)]}))
    runs = dict(simulate_each(scenes, periods))
    return [runs[start].tangent.growth_nats[:, 0] for start in range(starts) if runs[start].status == "ok"]


def row(depth_m, periods, growths):
    """The row that compares the scatter over starts with the errors of single runs, in bits a period."""
    exponents = [tangent_lyapunov(growth, TRANSIENT)[0] for growth in growths]
    values = np.array([exponent.value for exponent in exponents])
    errors = np.array([exponent.error for exponent in exponents])
    mean, scatter = values.mean(), values.std(ddof=1)
    z = np.std((values - mean) / errors, ddof=1)
    return [
        f"{depth_m:g}",
        str(len(values)),
        str(periods - TRANSIENT),
        f"{mean:+.3f} ± {scatter / np.sqrt(len(values)):.3f}",
        f"{values.min():+.3f}",
        f"{values.max():+.3f}",
        f"{scatter:.3f}",
        f"{np.sqrt(np.mean(errors**2)):.3f}",
        f"{z:.2f}",
    ]


def main():
    parser = command_line(__doc__)
    waves = "depths of the water (m), each with the wave periods of a run that are judged"
    parser.add_argument("--waves", type=float, nargs="+", default=[21.0, 700, 20.8, 400], metavar="M N", help=waves)
    parser.add_argument("--steepness", type=float, default=0.13, metavar="KA", help="kA of the wave")
    parser.add_argument("--starts", type=int, default=16, metavar="N", help="runs")
    parser.add_argument("--write", action="store_true", help="write the table into its page")
    options = parser.parse_args()
    rows = []
    for depth_m, judged in zip(options.waves[::2], options.waves[1::2], strict=True):
        periods = int(judged) + TRANSIENT
        growths = growth_of_starts(depth_m, options.steepness, options.starts, periods)
        rows.append(row(depth_m, periods, growths))
    publish("exponent_over_starts", rows, options.write)


if __name__ == "__main__":
    main()
