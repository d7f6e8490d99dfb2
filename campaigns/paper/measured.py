"""What the parts of the paper's campaign left, read for judging: rows by part, and a few numbers of single motions.

A part that is not there, or cannot be read, leaves its place empty and a reason in `missing`; statements that need it
are then undecided.
"""

import json
import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path

from campaigns.breaking_line.lines import read_lines
from campaigns.machinery.folder import trajectory_path
from campaigns.paper.measures import LARGE, SMALL, buckling_waves, calm_measures, violent_measures
from campaigns.paper.snaps import scales, snaps
from campaigns.tables import Row, read_rows

TREATED = ("above_still_water", "submergence")


@dataclass(frozen=True, eq=False)
class Results:
    """All that the statements are judged by.

    lines        runs of the breaking line (`breaking_line.lines`)
    buoy         rows of the two long runs by steepness, with `snaps`;  accuracy: the same runs tighter and finer
    sweep        rows over steepness;  dependence: rows of other depths, treatments and stiffnesses (rows at the large
                 wave, with linear waves continued above still water, with `snaps`)
    plane        runs of figure 20;  plane_large: the steepness of its large wave
    numbers      of the scene of section 4.2 (`scales`, estimate_... of the natural frequencies, length_m), of its two
                 motions (`calm_measures`, `violent_measures`), of the slack rope (buckle_depth_m, buckle_waves) and of
                 eq. (33) (oscillator_..., its exponents)
    missing      part -> why it is not there
    """

    lines: tuple[Row, ...] = ()
    buoy: dict[float, Row] = field(default_factory=dict)
    accuracy: tuple[Row, ...] = ()
    sweep: tuple[Row, ...] = ()
    dependence: tuple[Row, ...] = ()
    plane: tuple[Row, ...] = ()
    plane_large: float = LARGE
    numbers: dict[str, float] = field(default_factory=dict)
    missing: dict[str, str] = field(default_factory=dict)

    def number(self, name: str) -> float:
        """One of `numbers`, nan where there is none."""
        return self.numbers.get(name, math.nan)

    def depth(self) -> float:
        """The water depth of the scene as shipped, from the first row of the dependence study; nan without one."""
        return self.dependence[0]["depth_m"] if self.dependence else math.nan

    def usual(self) -> Row:
        """Treatments and stiffness of the scene as shipped, which leads the study."""
        return {key: self.dependence[0][key] for key in (*TREATED, "bending_stiffness_Nm2")}

    def over_depth(self, steepness: float, **treated: str) -> list[Row]:
        """Rows of the dependence study that ended as asked, at the shipped stiffness and these treatments, by depth."""
        if not self.dependence:
            return []
        wanted = self.usual() | treated | {"steepness": steepness, "status": "ok"}
        found = [row for row in self.dependence if all(row[key] == entry for key, entry in wanted.items())]
        return sorted(found, key=lambda row: row["depth_m"])


def read_results(directory: str | Path) -> Results:
    """Read the folder of `campaigns.paper`; never raises for a part."""
    from engine.trajectory import TrajectoryError

    found: dict[str, object] = {}
    numbers: dict[str, float] = {}
    missing: dict[str, str] = {}
    for part, reader in _READERS.items():
        folder = Path(directory) / part
        try:
            if not folder.is_dir():
                raise FileNotFoundError("there is no such folder")
            found |= reader(folder, numbers)
        except FileNotFoundError as error:
            missing[part] = f"{Path(error.filename).name} is missing" if error.filename else str(error)
        except (OSError, ValueError, KeyError, TrajectoryError) as error:
            missing[part] = f"it cannot be read ({type(error).__name__}: {error})"
    return Results(**found, numbers=numbers, missing=missing)


def _provenance(folder: Path) -> dict:
    return json.loads((folder / "provenance.json").read_text(encoding="utf-8"))


def _breaking(folder: Path, numbers: dict) -> dict:
    return {"lines": read_lines(folder)}


def _buoy(folder: Path, numbers: dict) -> dict:
    from engine import Trajectory, load_scene
    from engine.natural_frequencies import natural_frequencies

    rows = {row["steepness"]: dict(row) for row in read_rows(folder / "table.csv")}
    scene, transient = load_scene(folder / "scene.toml"), int(_provenance(folder)["transient"] or 0)
    modes = natural_frequencies(scene)
    numbers["length_m"] = scene.tether.length_m
    if modes is not None:
        numbers |= {f"estimate_{name}": value for name, value in asdict(modes).items()}
        numbers |= scales(scene, modes, SMALL, LARGE)
    for steepness, row in rows.items():
        if steepness in (SMALL, LARGE) and row["status"] == "ok":
            trajectory = Trajectory.load(trajectory_path(folder, row["run_key"]))
            row |= snaps(trajectory, transient)
            small = steepness == SMALL
            numbers |= calm_measures(trajectory, modes) if small else violent_measures(trajectory, transient)
    again = folder / "accuracy" / "table.csv"
    return {"buoy": rows, "accuracy": read_rows(again) if again.exists() else ()}


def _sweep(folder: Path, numbers: dict) -> dict:
    return {"sweep": read_rows(folder / "table.csv")}


def _dependence(folder: Path, numbers: dict) -> dict:
    rows = read_rows(folder / "table.csv")
    transient = int(_provenance(folder.parent).get("dependence", {}).get("transient") or 0)
    return {"dependence": tuple(row | _snaps(folder, row, rows[0], transient) for row in rows)}


def _snaps(folder: Path, row: Row, usual: Row, transient: int) -> dict[str, float]:
    """`snaps` of a row at the large wave that differs from the first in depth and buoyancy at most."""
    from engine.trajectory import Trajectory, TrajectoryError

    same = "above_still_water", "bending_stiffness_Nm2"
    if row["steepness"] != LARGE or row["status"] != "ok" or any(row[key] != usual[key] for key in same):
        return {}
    try:
        return snaps(Trajectory.load(trajectory_path(folder, row["run_key"])), transient)
    except TrajectoryError:
        return {}


def _plane(folder: Path, numbers: dict) -> dict:
    from engine.trajectory import Trajectory, TrajectoryError

    rows, found = read_rows(folder / "table.csv"), {}
    for row in rows:
        if row["profiles"] and row["status"] == "ok":
            with_shape = trajectory_path(folder, row["run_key"])
            try:
                profiles = Trajectory.load(with_shape).profiles
            except TrajectoryError:
                break
            waves = None if profiles is None else buckling_waves(profiles)
            if waves is not None:
                numbers |= {"buckle_depth_m": row["depth_m"], "buckle_waves": waves}
            break
    return found | {"plane": rows, "plane_large": float(_provenance(folder)["base"]["steepness"])}


def _oscillator(folder: Path, numbers: dict) -> dict:
    numbers |= {f"oscillator_{key}": float(entry) for key, entry in _provenance(folder)["oscillator"].items()}
    for row in read_rows(folder / "table.csv"):
        if row["part"] == "exponents":
            numbers |= {name: entry for name, entry in row.items() if name in STRANGE}
    return {}


STRANGE = ("lambda_1_bits_per_period", "lambda_1_bits_error", "section_dimension", "section_dimension_error")
_READERS: dict[str, Callable[[Path, dict], dict]] = {
    "breaking_line": _breaking,
    "buoy": _buoy,
    "sweep": _sweep,
    "dependence": _dependence,
    "out_of_plane": _plane,
    "oscillator": _oscillator,
}
