"""What the parts of the paper's campaign left: runs by name, or why there is none, for figures; `Results` to judge by.

For judging, a part that is not there, or cannot be read, leaves its place empty; statements that need it are undecided.
"""

import contextlib
import json
import math
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, field
from pathlib import Path

import numpy as np

from campaigns.breaking_line.lines import read_lines
from campaigns.figure_data import Array, Source, source
from campaigns.judge import samples_of
from campaigns.machinery import read_json, run_of, stored_run, trajectory_path
from campaigns.paper.measures import buckling_waves, calm_measures, scales, snaps, violent_measures
from engine.trajectory import TrajectoryError
from tables import LARGE, SMALL, Row, read_table

STRANGE = ("lambda_1_bits_per_period", "lambda_1_bits_error", "section_dimension", "section_dimension_error")
NODES = (41, 81)  # of the part `doubled`
EARLY = 10  # wave periods
TREATED = ("above_still_water", "submergence")


class LeftOut(Exception):
    """A figure that cannot be drawn; str() is the reason, as the report gives it."""


@dataclass(frozen=True)
class Plan:
    """A figure's data before it is computed: its title, the results behind it, and what computes its arrays."""

    title: str
    sources: tuple[Source, ...]
    arrays: Callable[[], dict[str, Array]]


@dataclass(frozen=True)
class Part:
    """A part's folder with its table and its provenance."""

    folder: Path
    rows: tuple[Row, ...]
    provenance: dict


@dataclass(frozen=True, eq=False)
class Parts:
    """The folder of the campaign, and what was read of it: several figures show the same run."""

    root: Path
    _parts: dict[str, Part] = field(default_factory=dict)
    _runs: dict[Path, tuple] = field(default_factory=dict)

    def part(self, name: str) -> Part:
        """A part by the name of its folder. Raises LeftOut where it is missing or unfinished."""
        if name not in self._parts:
            folder = self.root / name
            try:
                provenance = json.loads((folder / "provenance.json").read_text(encoding="utf-8"))
                self._parts[name] = Part(folder, read_table(folder / "table.csv"), provenance)
            except FileNotFoundError as error:
                raise LeftOut(f"the part `{name}` is not there: {Path(error.filename).name} is missing") from None
            except (OSError, ValueError, KeyError) as error:
                raise LeftOut(f"the part `{name}` cannot be read ({type(error).__name__}: {error})") from None
        return self._parts[name]

    def run(self, part: Part, label: str, **wanted) -> tuple[Row, object, Source]:
        """The one run of a part that is as wanted: its row, its trajectory, its Source. Raises LeftOut."""
        rows = matching(part.rows, wanted)
        if not rows:
            raise LeftOut(f"the part `{part.folder.name}` holds no run of {label}")
        row = rows[0]
        if row["status"] != "ok":
            raise LeftOut(f"the run of {label} ended early ({row['status']}: {row['message']})")
        path = trajectory_path(part.folder, row["run_key"])
        if path not in self._runs:
            try:
                trajectory = stored_run(part.folder, row["run_key"])
            except TrajectoryError as error:
                reason = str(error).removeprefix(f"{path}: ")  # what is written must not depend on the folder's place
                raise LeftOut(f"the file of {label}, {path.name}, is no use ({reason})") from None
            settings, run_s = trajectory.scene.to_toml(), trajectory.statistics["wall_s"]
            self._runs[path] = trajectory, source(label, self.root, path, path.stem, settings, run_s)
        return row, *self._runs[path]

    def of_buoy(self, steepness: float) -> tuple[object, Source]:
        """Trajectory and Source of the buoy's run at a steepness of the paper. Raises LeftOut."""
        return self.run(self.part("buoy"), f"kA = {steepness:g}", steepness=steepness)[1:]


@dataclass(frozen=True, eq=False)
class Results:
    """All that the statements are judged by."""

    lines: tuple[Row, ...] = ()  # runs of the breaking line (`breaking_line.lines`)
    buoy: dict[float, Row] = field(default_factory=dict)  # rows of the two long runs by steepness, with `snaps`
    doubled: tuple[Row, ...] = ()  # the two waves, with what twice the elements change (`_doubled`)
    sweep: tuple[Row, ...] = ()  # rows over steepness, one a motion
    # Rows of other depths, treatments and stiffnesses; those at the large wave, with linear waves continued above still
    # water, with `snaps`.
    dependence: tuple[Row, ...] = ()
    plane: tuple[Row, ...] = ()  # runs of figure 20
    plane_large: float = LARGE  # the steepness of its large wave
    # Of the scene of section 4.2 (`scales`, estimate_... of the natural frequencies, length_m), of its two motions
    # (`calm_measures`, `violent_measures`), of the slack rope (buckle_waves), of eq. (33) (oscillator_..., exponents).
    numbers: dict[str, float] = field(default_factory=dict)

    def number(self, name: str) -> float:
        """One of `numbers`, nan where there is none."""
        return self.numbers.get(name, math.nan)

    def depth(self) -> float:
        """The water depth of the scene as shipped, from the first row of the dependence study; nan without one."""
        if not self.dependence:
            return math.nan
        return self.dependence[0]["depth_m"]

    def usual(self) -> Row:
        """Treatments and stiffness of the scene as shipped, which leads the study."""
        return {key: self.dependence[0][key] for key in (*TREATED, "bending_stiffness_Nm2")}

    def over_depth(self, steepness: float, **treated: str) -> list[Row]:
        """Rows of the dependence study that ended as asked, at the shipped stiffness and these treatments, by depth."""
        if not self.dependence:
            return []
        wanted = self.usual() | treated | {"steepness": steepness, "status": "ok"}
        return sorted(matching(self.dependence, wanted), key=lambda row: row["depth_m"])


def matching(rows: Iterable[Row], wanted: Row) -> list[Row]:
    """The rows that have these entries."""
    return [row for row in rows if wanted.items() <= row.items()]


def read_results(directory: str | Path) -> Results:
    """Read the folder of `campaigns.paper`; never raises for a part."""
    parts, numbers, fields = Parts(Path(directory)), {}, {}
    for reader in (_lines, _sweep, _buoy, _doubled, _dependence, _plane, _oscillator):
        with contextlib.suppress(LeftOut, OSError, ValueError, KeyError, TrajectoryError):
            fields |= reader(parts, numbers)
    return Results(**fields, numbers=numbers)


def _lines(parts: Parts, numbers: dict) -> dict:
    return {"lines": read_lines(parts.root / "breaking_line")}


def _sweep(parts: Parts, numbers: dict) -> dict:
    return {"sweep": parts.part("sweep").rows}


def _buoy(parts: Parts, numbers: dict) -> dict:
    from engine import load_scene
    from engine.natural_frequencies import natural_frequencies

    part = parts.part("buoy")
    scene, transient = load_scene(part.folder / "scene.toml"), int(part.provenance["transient"] or 0)
    modes = natural_frequencies(scene)
    numbers["length_m"] = scene.tether.length_m
    if modes is not None:
        numbers |= {f"estimate_{name}": value for name, value in asdict(modes).items()}
        numbers |= scales(scene, modes, SMALL, LARGE)
    rows = {row["steepness"]: dict(row) for row in part.rows}
    for steepness in {SMALL, LARGE} & {*rows}:
        trajectory = run_of(part.folder, rows[steepness])
        if trajectory is None:
            continue
        rows[steepness] |= snaps(trajectory, transient)
        if steepness == SMALL:
            numbers |= calm_measures(trajectory, modes)
        else:
            numbers |= violent_measures(trajectory, transient)
    return {"buoy": rows}


def _doubled(parts: Parts, numbers: dict) -> dict:
    """Rows on the coarser grid, with the rms change of r (m) on the finer one, early and over the whole record."""
    part = parts.part("doubled")
    runs = {(row["waves.steepness"], row["tether.nodes"]): run_of(part.folder, row) for row in part.rows}
    coarse_nodes, fine_nodes = NODES
    rows = []
    for row in part.rows:
        steepness = row["waves.steepness"]
        coarse, fine = runs.get((steepness, coarse_nodes)), runs.get((steepness, fine_nodes))
        if row["tether.nodes"] != coarse_nodes or coarse is None or fine is None:
            continue
        off_m = fine.columns["radius_m"] - coarse.columns["radius_m"]
        early = samples_of(coarse.scene, EARLY) + 1
        rows.append(row | {"error_early_m": _rms(off_m[:early]), "error_m": _rms(off_m)})
    return {"doubled": tuple(rows)}


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _dependence(parts: Parts, numbers: dict) -> dict:
    """Rows with `snaps` at the large wave, of those that differ from the first in depth and buoyancy at most."""
    folder = parts.root / "dependence"
    rows, provenance = read_table(folder / "table.csv"), read_json(parts.root / "provenance.json") or {}
    transient = int(provenance.get("dependence", {}).get("transient") or 0)
    wanted = {key: rows[0][key] for key in ("above_still_water", "bending_stiffness_Nm2")} | {"steepness": LARGE}
    rows_with_snaps = []
    for row in rows:
        trajectory = None
        if wanted.items() <= row.items():
            trajectory = run_of(folder, row)
        if trajectory is not None:
            row = row | snaps(trajectory, transient)
        rows_with_snaps.append(row)
    return {"dependence": tuple(rows_with_snaps)}


def _plane(parts: Parts, numbers: dict) -> dict:
    part = parts.part("out_of_plane")
    with_profiles = matching(part.rows, {"profiles": 1, "status": "ok"})
    trajectory, waves = None, None
    if with_profiles:
        trajectory = run_of(part.folder, with_profiles[0])
    if trajectory is not None and trajectory.profiles:
        waves = buckling_waves(trajectory.profiles)
    if waves is not None:
        numbers["buckle_waves"] = waves
    return {"plane": part.rows, "plane_large": float(part.provenance["base"]["steepness"])}


def _oscillator(parts: Parts, numbers: dict) -> dict:
    part = parts.part("oscillator")
    numbers |= {f"oscillator_{key}": float(entry) for key, entry in part.provenance["oscillator"].items()}
    for row in matching(part.rows, {"part": "exponents"}):
        numbers |= {name: row[name] for name in STRANGE}
    return {}
