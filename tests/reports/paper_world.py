"""Results in which everything is as the paper says: what the statements are tried on."""

from dataclasses import replace

from engine.natural_frequencies import Modes
from reports.breaking_line.runs import COLUMNS, FAST, SLOW, Line
from reports.out_of_plane.runs import Run, Study
from reports.paper.measures import Calm, Violent
from reports.paper.results import Results
from reports.paper.snaps import Scales

STRAINS = {"1": 0.099, "2": 0.178, "3": 0.228, "4": 0.292}
DEPTHS = (21.0, 22.5)


class Profile:
    """A trajectory of a break: all but some first nodes are at their speed after t_br, and nothing pulls any more."""

    def __init__(self, speed_mps: float, reached_s: float, tension_N: float = 0.0, resting: int = 0):
        import numpy as np

        self.profiles = self
        self.time_s = np.linspace(0.0, 0.1, 101)
        self.s_m = np.linspace(0.0, 60.0, 61)
        self.speed_mps = np.where(self.time_s >= reached_s - 1e-9, speed_mps, 0.0)[:, None] * np.ones(61)
        self.speed_mps[:, :resting] = 0.0
        self.tension_N = np.full((101, 61), tension_N)


def line(case: str, kind: str = "case", **changed) -> Line:
    """A row of the breaking line as the paper tells it."""
    n, slow = int(case[0]), case.endswith("p")
    speed = 700.0 * STRAINS[case[0]]
    row = dict.fromkeys(COLUMNS, None) | {"case": case, "kind": kind, "status": "ok"}
    row |= {
        "force_N": (45e3, 180e3, 315e3, 450e3)[n - 1],
        "breaking_time_s": 0.05 if slow else 0.005,
        "end_speed_mps": speed,
        "end_speed_most_mps": speed,
        "speed_largest_mps": speed,
        "front_speed_mps": (300.0, 700.0, 720.0, 500.0)[n - 1],
        "front_speed_theory_mps": (300.0, 700.0, 720.0, 500.0)[n - 1],
        "slack_front_speed_mps": 260.0,
        "slack_front_speed_theory_mps": 260.0,
        "end_time_s": 1.0,
        "arrival_theory_s": (0.91, 0.7, 0.55, 0.6)[n - 1],
        "recoil_m": 3.0 * n,
        "recoil_120ms_m": 5.0 * n,
        "vertical_m": 1.0 / n,
        "vertical_beyond_m": 0.5 / n,
        "steepest_tilt_rad": 1.0,
        "x_min_m": -1.0 if n == 4 else 0.0,
        "tension_spread": 0.6 if slow else 0.8,
        "kinetic_spread": 0.6 if slow else 0.4,
        "fast_share": 0.1 if slow else 0.3,
        "resting_share": 0.2 if slow else 0.4,
        "stored_J": 1e5 * n,
        "kinetic_largest_J": 0.9e5 * n,
        "end_work_J": 0.0,
    }
    return Line(row | changed, Profile(speed, row["breaking_time_s"]) if kind == "case" else None, "")


def buoy(steepness: float, **changed) -> dict:
    """A row of the buoy as the paper tells it."""
    large = steepness > 0.1
    row = {
        "steepness": steepness,
        "status": "ok",
        "regime": "chaotic" if large else "period-1",
        "regime_tighter": "",
        "strobed_period": float("nan") if large else 1.0,
        "radius_min_m": 20.0,
        "radius_max_m": 21.0,
        "tension_top_min_N": -100.0 if large else 1000.0,
        "tension_top_max_N": 9000.0 if large else 3000.0,
        "slack_fraction": 0.1 if large else 0.0,
        "lyapunov_tangent_bits_per_period": 0.2 if large else -0.01,
        "lyapunov_tangent_error": 0.01,
        "lyapunov_wolf_bits_per_period": 0.2 if large else 0.001,
        "lyapunov_wolf_error": 0.01,
    }
    if large:
        row |= {"near_zero": 0.5, "compressed": 0.1, "compressed_inwards": 0.9, "begun_inwards": 1.0, "turned": 1.0}
        row |= {"peak_periods": 0.1, "apart_periods": 2.0}
        row |= {f"{side}_{what}": size for side in ("radial", "angular") for what, size in (("line", 0.1), ("at", 1.0))}
    return row | changed


def deep(steepness: float, depth_m: float, **changed) -> dict:
    """A row of the dependence study."""
    treated = {"above_still_water": "extrapolate", "submergence": "full", "bending_stiffness_Nm2": 0.4}
    return {**buoy(steepness), "depth_m": depth_m, **treated, **changed}


def again(label: float, error_m: float = 1e-3) -> dict:
    """A row of the repeated runs of a sweep."""
    run = {"label": label, "run": "twice the elements", "status": "ok", "periods": 100}
    return run | {"error_early_m": error_m, "error_m": error_m}


def pushed(steepness: float, direction: str = "lateral", **changed) -> Run:
    """A row out of the plane."""
    large = steepness > 0.1
    row = {
        "steepness": steepness,
        "status": "ok",
        "dimensions": 3,
        "depth_m": 21.0,
        "seed_direction": direction,
        "profiles": 0,
        "buoy_motion": "growth" if large else "decay",
        "rope_motion": "growth" if large else "decay",
        "buoy_share_of_inplane": 0.5,
        "rope_share_of_inplane": 0.5,
        "buoy_lateral_max_m": 1.0,
        "rope_lateral_max_m": 0.0 if direction == "along" else 1.0,
    }
    return Run(row | changed)


class Oscillator:
    """Eq. (33) with a strange attractor."""

    def __init__(self, **changed: float):
        self.oscillator = {"frequency": 1.14, "lift": 0.68, "force": 1.4}
        self.values = {
            "lambda_1_bits_per_period": 0.5,
            "lambda_1_bits_error": 0.01,
            "section_dimension": 1.7,
            "section_dimension_error": 0.01,
        } | changed

    def number(self, part: str, column: str) -> float:
        return self.values[column]


def world(**changed) -> Results:
    """All of it; changed: fields of Results."""
    doubled = [line(case, "doubled") for case in (*FAST, *SLOW)]
    rows = tuple(deep(kA, H) for kA in (0.13, 0.016) for H in DEPTHS)
    runs = (pushed(0.016), pushed(0.13), pushed(0.13, "along"))
    usual = Results(
        lines=(*(line(case) for case in (*FAST, *SLOW)), *doubled),
        static=tuple(STRAINS.items()),
        steepening=(("1", -0.1), ("2", 0.1), ("3", 0.1), ("4", 0.1)),
        modes=Modes(2000.0, 0.04, 1.0, 0.196, 1.26),
        rest_length_m=20.0,
        buoy={kA: buoy(kA) for kA in (0.016, 0.13)},
        accuracy=(again(0.016), again(0.13)),
        sweep=tuple(buoy(kA) for kA in (0.05, 0.13, 0.14)),
        dependence=rows,
        calm=Calm(20.8, 0.5, 1000.0, 1.0, 0.19, 0.2, 0.1, 0.99, 0.99, 1e-3, 1e-3, 0.2, 0.4, 0.01, 0.01, 0.99),
        violent=Violent(0.5, 1.99, 0.01),
        oscillator=Oscillator(),
        plane=Study(None, runs, {"steepness": 0.13}, 50),
        buckle=(21.0, 9.0),
        scales=Scales(0.1, 39.0, 1.5, 1.14, 0.68, 1.4),
    )
    return replace(usual, **changed)
