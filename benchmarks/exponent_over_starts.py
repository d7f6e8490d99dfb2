"""Does the error of an exponent cover its start? One wave, many starts, a run each.

    python -m benchmarks.exponent_over_starts [--depth 21] [--steepness 0.13] [--starts 16] [--periods 800]

The first run begins at rest, the others with a velocity of the buoy drawn from -2 to 2 m/s along x and along z. After
the transient each run has an exponent with the error of `analysis.tangent_lyapunov`, which knows this run alone. The
scatter of the runs is the true error; z = (exponent of a run - mean of all)/its error has a standard deviation of 1
where errors are right. Printed: the mean of all with the error that its scatter gives, both errors of one run, and z.
Five minutes of a core, as it is.
"""

import argparse

import numpy as np

from analysis import tangent_lyapunov
from engine import load_scene, simulate_each

TRANSIENT, SPEED_MPS = 100, 2.0


def grown(depth_m, steepness, starts, periods):
    """Growth (periods, nats) of every run that reaches its end, in the order of the starts."""
    random, scenes = np.random.default_rng(5), []
    for start in range(starts):
        x, z = random.uniform(-SPEED_MPS, SPEED_MPS, 2) if start else (0.0, 0.0)
        changes = {"waves.steepness": steepness, "water.depth_m": depth_m, "output.tangent_vectors": 1}
        scenes.append(load_scene("tethered_buoy", {**changes, "start.buoy_velocity_mps": [float(x), 0.0, float(z)]}))
    runs = dict(simulate_each(scenes, periods))
    return [runs[start].tangent.growth_nats[:, 0] for start in range(starts) if runs[start].status == "ok"]


def report(growths):
    """The lines that compare the scatter over starts with the errors of single runs."""
    found = [tangent_lyapunov(growth, TRANSIENT)[0] for growth in growths]
    values, errors = (np.array([getattr(one, name) for one in found]) for name in ("value", "error"))
    mean, scatter = values.mean(), values.std(ddof=1)
    yield f"{len(found)} starts, {found[0].details['periods']} periods each: exponents in bits a period"
    yield f"mean of all          {mean:+.4f} ± {scatter / np.sqrt(len(found)):.4f}"
    yield f"from rest            {values[0]:+.4f} ± {errors[0]:.4f}"
    yield f"least and largest    {values.min():+.4f}, {values.max():+.4f}"
    yield f"scatter of the runs  {scatter:.4f}"
    yield f"error of one run     {np.sqrt(np.mean(errors**2)):.4f} (root mean square)"
    yield f"z                    standard deviation {np.std((values - mean) / errors, ddof=1):.2f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--depth", type=float, default=21.0, metavar="M", help="depth of the water, m")
    parser.add_argument("--steepness", type=float, default=0.13, metavar="KA", help="kA of the wave")
    parser.add_argument("--starts", type=int, default=16, metavar="N", help="runs")
    parser.add_argument("--periods", type=int, default=800, metavar="N", help="wave periods of each")
    given = parser.parse_args()
    for line in report(grown(given.depth, given.steepness, given.starts, given.periods)):
        print(line)


if __name__ == "__main__":
    main()
