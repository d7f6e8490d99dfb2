"""No timing: how often the tension of a random scene is wrong, and whether its run says so.

    .venv/bin/python -m benchmarks.random_scenes --seed 1 --count 100     # random scenes; a scene takes about 5 seconds
    .venv/bin/python -m benchmarks.random_scenes --odd                    # scenes with one extreme number

Each scene runs for 8 s, or for two wave periods if they are longer, with default settings on at least 41 nodes. The
reference has four times the elements, rtol/30 and a quarter of the longest step. Scene N of a seed is always the same.

wrong       the largest tension at the top is more than 5 % off, or the slack fraction is .05 off, the share of the time
            in which the top bears at most 5 % of its tension at rest
announced   the message of the run speaks of the accuracy (ACCURACY), of the largest tension or of others
others      of a run that is not wrong: the largest tension in an eighth of its time is off by 5 % of the largest of all

A largest tension below 0.1 % of the weight of the line, or below 1 % of the compression at rest, is rounding.
"""

import math
import re
from collections import Counter
from dataclasses import dataclass

import numpy as np

from analysis import slack_fraction
from benchmarks.shared import command_line
from campaigns.stability.limits import DONE, limited, load_kernels
from engine import SceneError, load_scene, simulate
from engine.run.rest import static_tension_N
from tests.engine.lines import DRY, SPACE, STILL, free, held

LENGTH_S, WAVES = 8.0, 2  # of a run
LIMIT_S = 60.0  # of processor time of a run
WRONG_TENSION, WRONG_SLACK = 0.05, 0.05
ROUNDING, PRESSED = 1e-3, 0.01  # of the weight of the line; of the compression at rest
SLACK = 0.05  # of the tension at rest
REFINED, RTOL, STEPS = 4, 30.0, 4.0
ACCURACY = re.compile(
    "holds? to|may be off|an element is folded|grid or tolerance|at rest the top bears|"
    "nor damping, so that its folds|a blow on the line"
)
OUTCOMES = "wrong, announced", "wrong, silent", "others, announced", "right, announced", "right, silent"
EIGHTHS = 8
NO_COMPARISON = "refused", "ended early", "no reference"
STEEL, ROPE = 7800.0, 1140.0  # kg/m3


class Draw:
    """Random numbers of one scene."""

    def __init__(self, seed: int, number: int) -> None:
        self.random = np.random.default_rng([seed, number])

    def between(self, low: float, high: float) -> float:
        return float(self.random.uniform(low, high))

    def scale(self, low: float, high: float) -> float:
        """A number whose logarithm is uniform."""
        return math.exp(self.between(math.log(low), math.log(high)))

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    def choice(self, values: tuple) -> object:
        return values[self.random.integers(len(values))]


def rope(draw: Draw) -> dict:
    """A rope of 3 to 100 m: soft to stiff, sometimes without bending stiffness or drag, sometimes with another law."""
    diameter_m = draw.scale(0.005, 0.05)
    area_m2 = math.pi * diameter_m**2 / 4
    stiffness_N = draw.scale(1e8, 5e10) * area_m2
    keys = {
        "length_m": draw.scale(3.0, 100.0),
        "area_m2": area_m2,
        "density_kgpm3": draw.scale(900.0, 4000.0),
        "nodes": draw.choice((41, 61, 81)),
        "bending_stiffness_Nm2": stiffness_N * diameter_m**2 / 16 * draw.scale(0.01, 2.0),
        "drag_normal": 0.0 if draw.chance(0.05) else draw.between(0.5, 2.0),
        "drag_tangential": draw.between(0.0, 0.2),
        "tension": {"law": "linear", "stiffness_N": stiffness_N},
    }
    if draw.chance(0.1):
        strains, shares = [-0.5, 0.0, 0.05, 0.2], [-0.1, 0.0, 0.02, 0.17]
        tensions = [share * stiffness_N for share in shares]
        keys["tension"] = {"law": "tabulated", "strain": strains, "tension_N": tensions}
    elif draw.chance(0.1):
        keys["tension"] = {"law": "tanh", "p": [0.05 * stiffness_N, 10.0, 0.0, 0.0, 0.5 * stiffness_N]}
    if draw.chance(0.15):
        keys["damping_critical"] = draw.scale(0.05, 1.0)
    return {f"tether.{key}": value for key, value in keys.items()}


def chain(draw: Draw) -> dict:
    """A steel chain of 3 to 100 m."""
    area_m2 = draw.scale(1e-5, 2e-3)
    keys = {
        "length_m": draw.scale(3.0, 100.0),
        "area_m2": area_m2,
        "density_kgpm3": STEEL,
        "nodes": draw.choice((41, 61, 81)),
        "bending_stiffness_Nm2": draw.choice((0.0, 0.01, 1.0)) * 1e3 * area_m2,
        "drag_normal": 2.0,
        "tension": {"law": "linear", "stiffness_N": draw.scale(1e9, 5e10) * area_m2},
    }
    return {f"tether.{key}": value for key, value in keys.items()}


def tension_share(scene: dict, force_N: float) -> float:
    """Strain, nearly, under a force."""
    law = scene["tether.tension"]
    stiffness_N = law.get("stiffness_N") or (law["p"][4] if law["law"] == "tanh" else law["tension_N"][2] / 0.05)
    return force_N / stiffness_N


def weight_of(line: dict) -> float:
    """Weight of a line in air, N."""
    return 9.81 * line["tether.density_kgpm3"] * line["tether.area_m2"] * line["tether.length_m"]


def moored(draw: Draw) -> dict:
    """A buoy on a rope in still water."""
    keys = rope(draw)
    diameter_m = draw.scale(0.4, 3.0)
    volume_kg = 1027.0 * math.pi * diameter_m**3 / 6
    mass_kg = volume_kg * draw.between(0.2, 0.9)
    while tension_share(keys, 9.81 * (volume_kg - mass_kg)) > 0.1:
        mass_kg += 0.2 * (volume_kg - mass_kg)
    strain = tension_share(keys, 9.81 * (volume_kg - mass_kg))
    return keys | {
        "buoy.diameter_m": diameter_m,
        "buoy.mass_kg": mass_kg,
        "buoy.added_mass_kg": 0.5 * volume_kg,
        "buoy.submergence": draw.choice(("full", "spherical-cap")),
        "water.depth_m": keys["tether.length_m"] * (1 + strain) + diameter_m * draw.between(0.0, 2.0),
        "waves": None,
    }


def buoy_in_waves(draw: Draw) -> dict:
    keys = moored(draw)
    period_s, ramp_s = draw.scale(2.5, 10.0), draw.choice((0.0, 5.0))
    waves = {"period_s": period_s, "steepness": draw.scale(0.005, 0.15), "ramp_s": ramp_s}
    if draw.chance(0.4):
        speed_mps = draw.between(-1.0, 1.0)
        keys["current"] = {"law": "uniform", "velocity_mps": [speed_mps, 0.0, 0.0]}
    if draw.chance(0.15):
        keys |= SPACE | {"start.buoy_velocity_mps": [0.0, 1e-5, 0.0]}
    return keys | {"waves": waves}


def kicked_buoy(draw: Draw) -> dict:
    speed_mps, angle = draw.scale(0.2, 6.0), draw.between(-math.pi, math.pi)
    return moored(draw) | {"start.buoy_velocity_mps": [speed_mps * math.sin(angle), 0.0, speed_mps * math.cos(angle)]}


def displaced_buoy(draw: Draw) -> dict:
    keys = moored(draw)
    away_m, angle = keys["tether.length_m"] * draw.between(0.02, 0.4), draw.between(0.6 * math.pi, 1.4 * math.pi)
    return keys | {"start.buoy_displacement_m": [away_m * math.sin(angle), 0.0, away_m * math.cos(angle)]}


def around(draw: Draw, line: dict) -> dict:
    """Air or still water around a held line, sometimes with a current."""
    if draw.chance(0.4):
        return DRY
    length_m = line["tether.length_m"]
    keys = STILL | {"water.depth_m": 2.5 * length_m, "anchor.position_m": [0.0, 0.0, 1.2 * length_m]}
    if draw.chance(0.25):
        keys["current"] = {"law": "uniform", "velocity_mps": [draw.between(-1.5, 1.5), 0.0, 0.0]}
    return keys


def moved(draw: Draw, length_m: float) -> dict:
    """A motion of the upper end: harmonic with a ramp or without, or a table from rest to rest."""
    period_s, angle = draw.scale(1.0, 8.0), draw.between(0.0, 2 * math.pi)
    away_m = min(length_m * draw.scale(0.002, 0.1), 2.0)
    way = [away_m * math.cos(angle), 0.0, away_m * math.sin(angle)]
    if draw.chance(0.3):
        there, none = list(way), [0.0, 0.0, 0.0]
        return {"law": "table", "time_s": [0.0, 0.5 * period_s, period_s], "displacement_m": [none, there, none]}
    ramp_s = 0.0 if draw.chance(0.2) else period_s
    return {"law": "harmonic", "amplitude_m": way, "period_s": period_s, "ramp_s": ramp_s}


def place(draw: Draw, length_m: float) -> tuple[float, float]:
    angle = draw.between(-0.5 * math.pi, 0.5 * math.pi)
    return length_m * math.cos(angle), length_m * math.sin(angle)


def held_line(draw: Draw, line: dict, share: float) -> dict:
    """A held line whose ends are a share of its length apart, its upper end moved."""
    length_m = line["tether.length_m"]
    motion = moved(draw, length_m)
    keys = line | around(draw, line) | held(*place(draw, share * length_m), motion=motion)
    return keys | SPACE if draw.chance(0.1) else keys


def taut_line(draw: Draw) -> dict:
    line = rope(draw)
    return held_line(draw, line, 1.0 + tension_share(line, weight_of(line) * draw.scale(1.0, 100.0)))


def slack_line(draw: Draw) -> dict:
    return held_line(draw, rope(draw), draw.between(0.3, 0.995))


def slack_chain(draw: Draw) -> dict:
    return held_line(draw, chain(draw), draw.between(0.3, 0.98))


def lowered_line(draw: Draw) -> dict:
    """A held line, taut or nearly, whose end is moved towards the other one and stays there, or comes back."""
    line = draw.choice((rope, chain))(draw)
    length_m = line["tether.length_m"]
    x, z = place(draw, length_m * draw.between(0.95, 1.0))
    nearer = draw.between(0.1, 0.6)
    there, duration_s, none = [-nearer * x, 0.0, -nearer * z], draw.between(2.0, 6.0), [0.0, 0.0, 0.0]
    times, places = [0.0, duration_s], [none, there]
    if draw.chance(0.5):
        times, places = [0.0, 0.5 * duration_s, duration_s], [none, there, none]
    motion = {"law": "table", "time_s": times, "displacement_m": places}
    return line | around(draw, line) | held(x, z, motion=motion)


def released_line(draw: Draw) -> dict:
    """A held line, slack or taut, whose end is let go."""
    line = draw.choice((rope, chain))(draw)
    end = {"release_s": draw.between(0.1, 2.0)}
    if draw.chance(0.5):
        end["force_N"] = [0.0, 0.0, draw.scale(1.0, 100.0)]
    return line | around(draw, line) | held(*place(draw, line["tether.length_m"] * draw.between(0.3, 1.002)), **end)


def line_on_bed(draw: Draw) -> dict:
    """A chain or rope from an anchor on the bed to a moved end above it."""
    line = draw.choice((chain, rope))(draw)
    line["tether.density_kgpm3"] = max(line["tether.density_kgpm3"], 1300.0)
    length_m = line["tether.length_m"]
    height_m = length_m * draw.between(0.2, 0.6)
    along_m = math.sqrt(length_m**2 - height_m**2) * draw.between(0.85, 0.99)
    bed = {"stiffness_Npm3": draw.scale(1e5, 1e8), "damping_Nspm3": draw.choice((0.0, 1e5)), "friction": 0.3}
    motion = moved(draw, length_m)
    return STILL | line | held(along_m, height_m, motion=motion) | {"water.depth_m": 1.5 * length_m, "floor": bed}


def flying_end(draw: Draw) -> dict:
    """A free end under a force that a fracture takes away."""
    line = rope(draw)
    end = free(0.0, weight_of(line) * draw.scale(2.0, 100.0)) | {"end.force_decay_s": draw.scale(0.05, 2.0)}
    return line | around(draw, line) | end


KINDS = {  # and how often
    buoy_in_waves: 6, kicked_buoy: 2, displaced_buoy: 1, taut_line: 3, slack_line: 3, slack_chain: 2, lowered_line: 2,
    released_line: 2, line_on_bed: 2, flying_end: 1,
}  # fmt: skip


def random_scene(seed: int, number: int) -> tuple[str, dict]:
    """The kind of a random scene, and its changes of the shipped one."""
    draw = Draw(seed, number)
    kind = draw.choice(tuple(kind for kind, times in KINDS.items() for _ in range(times)))
    return kind.__name__, kind(draw)


def odd_scenes() -> dict[str, dict]:
    """Name -> changes of the shipped scene: a buoy in waves, a taut and a slack line, each with one extreme number."""
    extremes = {
        "EA = 1e9 N": {"tether.tension.stiffness_N": 1e9},
        "EA = 1e4 N": {"tether.tension.stiffness_N": 1e4},
        "EI = 0": {"tether.bending_stiffness_Nm2": 0.0},
        "EI = 1e4 N m2": {"tether.bending_stiffness_Nm2": 1e4},
        "1 kg/m3": {"tether.density_kgpm3": 1.0},
        "as heavy as water": {"tether.density_kgpm3": 1027.0},
        "20,000 kg/m3": {"tether.density_kgpm3": 2e4},
        "3 m long": {"tether.length_m": 3.0},
        "2 km long": {"tether.length_m": 2000.0},
        "without drag": {"tether.drag_normal": 0.0, "tether.drag_tangential": 0.0},
        "without drag across": {"tether.drag_normal": 0.0},
        "drag 30": {"tether.drag_normal": 30.0},
        "added mass 20": {"tether.added_mass": 20.0},
        "current 3 m/s": {"current": {"law": "uniform", "velocity_mps": [3.0, 0.0, 0.0]}},
        "g = 1.6 m/s2": {"gravity_mps2": 1.6},
        "g = 25 m/s2": {"gravity_mps2": 25.0},
        "dense water": {"water.density_kgpm3": 3000.0},
        "grid refined upwards": {"tether.grid_stretching": 3.0, "tether.grid_refined": "upper"},
        "damped critically": {"tether.damping_critical": 1.0},
        "in space": SPACE,
    }
    scenes = {}
    for name, keys in extremes.items():
        length_m = keys.get("tether.length_m", 20.0)
        stretched_m = length_m * (1 + 2000.0 / keys.get("tether.tension.stiffness_N", 5e4))
        waves = {"period_s": 5.0, "steepness": 0.08}
        scenes[f"buoy, {name}"] = {"waves": waves, "water.depth_m": stretched_m + 1.0} | keys
        water = STILL | {"water.depth_m": 3 * length_m, "anchor.position_m": [0.0, 0.0, length_m]}
        for line, share, away in (("taut line", 1.002, 0.005), ("slack line", 0.8, 0.1)):
            way = [0.6 * away * length_m, 0.0, 0.8 * away * length_m]
            motion = {"law": "harmonic", "amplitude_m": way, "period_s": 3.0, "ramp_s": 3.0}
            place_m = 0.8 * share * length_m, 0.6 * share * length_m
            scenes[f"{line}, {name}"] = water | held(*place_m, motion=motion) | keys
    return scenes


@dataclass(frozen=True)
class Result:
    """Largest tension at the top, slack fraction (NaN without a tension at rest), message and rounding of a run.

    parts_N (EIGHTHS,): largest tension in each part of its time.
    """

    status: str
    largest_N: float
    slack: float
    message: str
    rounding_N: float = 0.0
    parts_N: tuple = ()


def result_of(changes: dict, refined: bool) -> Result:
    scene = load_scene("tethered_buoy", changes)
    duration_s = max(LENGTH_S, WAVES * getattr(scene.waves, "period_s", 0.0))
    sample_s = scene.sample_step_s()
    if refined:
        nodes, solver = REFINED * (scene.tether.nodes - 1) + 1, scene.solver
        damping = scene.tether.damping_critical  # a share of that of an element: the same damping of the line
        scene = scene.with_values("tether", nodes=nodes, damping_critical=damping and REFINED * damping)
        finer = {"rtol": solver.rtol / RTOL, "max_step_s": solver.max_step_s / STEPS}
        scene = scene.with_values("solver", **finer)
    run = simulate(scene, duration_s=duration_s)
    if run.status != "ok":
        return Result(run.status, math.nan, math.nan, run.message)
    line, rest_N, slack = scene.tether, static_tension_N(scene, run.columns), math.nan
    weight_N = line.density_kgpm3 * line.area_m2 * line.length_m * max(scene.gravity_mps2, 1e-3)
    rounding_N = max(ROUNDING * weight_N, -PRESSED * rest_N)
    if rest_N > rounding_N:
        slack = slack_fraction(run.columns["tension_top_N"], sample_s, SLACK * rest_N).fraction
    parts = np.array_split(run.columns["tension_top_high_N"], EIGHTHS)
    parts_N = tuple(float(part.max()) for part in parts)
    return Result(run.status, max(parts_N), slack, run.message, rounding_N, parts_N)


def compared(changes: dict) -> tuple[str, str]:
    """The outcome of a scene, and the numbers of both runs in words."""
    try:
        load_scene("tethered_buoy", changes)
    except SceneError as error:
        return "refused", error.faults[0]
    way, run, _ = limited(lambda: result_of(changes, refined=False), LIMIT_S)
    if way != DONE:
        return "no reference", f"default settings: {run}"
    if run.status != "ok":
        return "ended early", f"{run.status}: {run.message}"
    way, finer, _ = limited(lambda: result_of(changes, refined=True), LIMIT_S)
    if way != DONE or finer.status != "ok":
        return "no reference", finer if way != DONE else f"{finer.status}: {finer.message}"
    off = other_off = 0.0
    if max(abs(run.largest_N), abs(finer.largest_N)) > run.rounding_N:
        off = abs(run.largest_N / finer.largest_N - 1)
        other_off = np.abs(np.subtract(run.parts_N, finer.parts_N)).max() / abs(finer.largest_N)
    wrong = off > WRONG_TENSION or abs(run.slack - finer.slack) > WRONG_SLACK
    announced = bool(ACCURACY.search(run.message))
    words = f"{run.largest_N:.4g} N, refined {finer.largest_N:.4g} N ({off:.1%})"
    words += f", slack {run.slack:.3f}, refined {finer.slack:.3f}; {run.message or 'no message'}"
    if wrong:
        return OUTCOMES[0 if announced else 1], words
    if announced:
        return OUTCOMES[2 if other_off > WRONG_TENSION else 3], words
    return OUTCOMES[4], words


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first scene (default 0)")
    parser.add_argument("--count", type=int, default=100, help="number of scenes (default 100)")
    parser.add_argument("--odd", action="store_true", help="the scenes with an extreme number in their place")
    options = parser.parse_args()
    load_kernels()
    numbers = range(options.first, options.first + options.count)
    scenes = [(f"{options.seed}/{number}", *random_scene(options.seed, number)) for number in numbers]
    if options.odd:
        scenes = [(name, name.partition(",")[0], changes) for name, changes in odd_scenes().items()]
    counts: dict[str, Counter] = {}
    for name, kind, changes in scenes:
        outcome, words = compared(changes)
        counts.setdefault(kind, Counter())[outcome] += 1
        print(f"{name} | {kind} | {outcome} | {words}", flush=True)
    print(f"\n| kind | scenes | {' | '.join(OUTCOMES + NO_COMPARISON)} |")
    counts["all"] = sum(counts.values(), Counter())
    for kind, count in counts.items():
        print(f"| {kind} | {count.total()} | {' | '.join(str(count[name]) for name in OUTCOMES + NO_COMPARISON)} |")


if __name__ == "__main__":
    main()
