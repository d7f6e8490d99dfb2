"""What the parts of the paper's campaign left, read for judging: rows by part, and a few numbers of single motions.

A part that is not there, or cannot be read, leaves its place empty and a reason in `missing`; statements that need it
are then undecided.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from ..breaking_line.runs import COLUMNS as LINE_COLUMNS
from ..breaking_line.runs import WORDS as LINE_WORDS
from ..breaking_line.runs import Line, read_lines
from ..buoy_sweep.physics import Modes, natural_frequencies
from ..buoy_sweep.runs import COLUMNS as BUOY_COLUMNS
from ..buoy_sweep.runs import PAPER_STEEPNESS
from ..oscillator.folder import read_study as read_oscillator
from ..out_of_plane.runs import COLUMNS as PLANE_COLUMNS
from ..out_of_plane.runs import WORDS as PLANE_WORDS
from ..out_of_plane.runs import read_study as read_plane
from ..parts.folder import Folder, FolderError, read_folder
from .measures import Calm, Violent, buckling_waves, calm_measures, violent_measures
from .snaps import Scales, scales, snaps

SMALL, LARGE = PAPER_STEEPNESS  # section 4.2.1 and 4.2.2
TREATED = ("above_still_water", "submergence")
JUDGED = (
    "regime_tighter",
    "strobed_period",
    *(f"lyapunov_{method}_{what}" for method in ("tangent", "wolf") for what in ("bits_per_period", "error")),
)
DEPENDENCE_COLUMNS = ("steepness", "depth_m", *TREATED, "bending_stiffness_Nm2", *BUOY_COLUMNS[1:], *JUDGED)


@dataclass(frozen=True, eq=False)
class Results:
    """All that the statements are judged by.

    lines         runs of the breaking line
    static        strain at the static tension by case, from the tension law of the scene
    steepening    by how much a wave at 0.99 of that strain is faster than at it, as a share, by case
    modes, scales   the paper's estimates, and other closed forms, from the scene of the buoy
    buoy          rows of the two long runs by steepness;  accuracy: the same runs tighter and finer
    sweep         rows over steepness;  dependence: rows of other depths, treatments and stiffnesses
                  (rows at the large wave, with linear waves continued above still water, have `snaps.COLUMNS` too)
    calm, violent numbers of the two motions that no table has
    oscillator, plane   studies of eq. (33) and of figure 20
    buckle        (depth in m, half waves of the slack rope)
    missing       part -> why it is not there
    """

    lines: tuple[Line, ...] = ()
    static: tuple[tuple[str, float], ...] = ()
    steepening: tuple[tuple[str, float], ...] = ()
    modes: Modes | None = None
    scales: Scales | None = None
    rest_length_m: float = 0.0
    buoy: dict[float, dict] = field(default_factory=dict)
    accuracy: tuple[dict, ...] = ()
    sweep: tuple[dict, ...] = ()
    dependence: tuple[dict, ...] = ()
    calm: Calm | None = None
    violent: Violent | None = None
    oscillator: object | None = None
    plane: object | None = None
    buckle: tuple[float, float] | None = None
    missing: dict[str, str] = field(default_factory=dict)

    def depth(self) -> float:
        """The water depth of the scene as shipped, from the first row of the dependence study; nan without one."""
        return float(self.dependence[0]["depth_m"]) if self.dependence else float("nan")

    def over_depth(self, steepness: float, **treated: str) -> list[dict]:
        """Rows of the dependence study at the shipped stiffness and these treatments, by depth."""
        if not self.dependence:
            return []
        wanted = self.usual() | treated | {"steepness": steepness}
        found = [row for row in self.dependence if all(row[key] == entry for key, entry in wanted.items())]
        return sorted(found, key=lambda row: row["depth_m"])

    def usual(self) -> dict:
        """Treatments and stiffness of the scene as shipped, which leads the study."""
        return {key: self.dependence[0][key] for key in (*TREATED, "bending_stiffness_Nm2")}


def read_results(directory: str | Path) -> Results:
    """Read the folder of `campaigns.paper`; never raises for a part."""
    directory = Path(directory)
    found: dict[str, object] = {}
    missing: dict[str, str] = {}
    for part, reader in _READERS.items():
        try:
            found |= reader(directory / part)
        except FolderError as error:
            missing[part] = "; ".join(error.faults)
        except (OSError, ValueError, KeyError) as error:
            missing[part] = f"it cannot be read ({type(error).__name__}: {error})"
    return Results(**found, missing=missing)


def _breaking(folder: Path) -> dict:
    from campaigns.breaking_line.theory import theory_of

    lines = read_lines(read_folder(folder, LINE_COLUMNS, LINE_WORDS))
    static, steepening = [], []
    for line in lines:
        if line.kind == "case" and line.ok and line.trajectory is not None and not line.case.endswith("p"):
            theory = theory_of(line.trajectory.scene, float(line.trajectory.columns["time_s"][-1]))
            if theory is not None:
                strain = float(theory.strain_at(1.0))
                faster = theory.wave_speed(0.99 * strain) / theory.wave_speed(strain) - 1.0
                static.append((line.name, strain))
                steepening.append((line.name, float(faster)))
    return {"lines": lines, "static": tuple(static), "steepening": tuple(steepening)}


def _buoy(folder: Path) -> dict:
    from engine import Trajectory

    study = read_folder(folder, BUOY_COLUMNS, ("planar_regime",))
    rows = {float(row["steepness"]): row for row in study.table.to_dict("records")}
    modes = natural_frequencies(study.scene)
    found = {"buoy": rows, "modes": modes, "rest_length_m": study.scene.tether.length_m, "accuracy": _again(study)}
    found["scales"] = None if modes is None else scales(study.scene, modes, SMALL, LARGE)
    transient = int(study.provenance.get("transient") or 0)
    runs = {
        steepness: Trajectory.load(study.trajectory_path(row["run_key"]))
        for steepness, row in rows.items()
        if steepness in PAPER_STEEPNESS and row["status"] == "ok"
    }
    if SMALL in runs:
        found["calm"] = calm_measures(runs[SMALL], modes)
    if LARGE in runs:
        found["violent"] = violent_measures(runs[LARGE], transient)
    for steepness, trajectory in runs.items():
        rows[steepness] |= snaps(trajectory, transient)
    return found


def _again(study: Folder) -> tuple[dict, ...]:
    import pandas

    path = study.directory / "accuracy" / "table.csv"
    return tuple(pandas.read_csv(path).to_dict("records")) if path.exists() else ()


def _sweep(folder: Path) -> dict:
    return {"sweep": tuple(read_folder(folder, BUOY_COLUMNS, ("planar_regime",)).table.to_dict("records"))}


def _dependence(folder: Path) -> dict:
    import pandas

    words = ["status", "regime", "message", *TREATED]
    table = pandas.read_csv(folder / "table.csv", dtype=dict.fromkeys(words, str))
    absent = [name for name in DEPENDENCE_COLUMNS if name not in table]
    if absent:
        raise ValueError(f"table.csv lacks {', '.join(absent)}")
    rows = table.fillna(dict.fromkeys(words, "")).to_dict("records")
    return {"dependence": tuple(row | _snaps(folder, row, rows[0]) for row in rows)}


def _snaps(folder: Path, row: dict, usual: dict) -> dict[str, float]:
    """`snaps.COLUMNS` of a row at the large wave that differs from the first in depth and buoyancy at most."""
    from engine.trajectory import Trajectory, TrajectoryError

    same = "above_still_water", "bending_stiffness_Nm2"
    if row["steepness"] != LARGE or row["status"] != "ok" or any(row[key] != usual[key] for key in same):
        return {}
    told = json.loads((folder.parent / "provenance.json").read_text(encoding="utf-8"))
    try:
        trajectory = Trajectory.load(folder / "trajectories" / f"{row['run_key']}.nc")
    except TrajectoryError:
        return {}
    return snaps(trajectory, int(told.get("dependence", {}).get("transient") or 0))


def _plane(folder: Path) -> dict:
    study = read_plane(read_folder(folder, PLANE_COLUMNS, PLANE_WORDS))
    shaped = next((run for run in study.runs if run["profiles"] and run.ok), None)
    trajectory = study.trajectory(shaped) if shaped is not None else None
    if trajectory is None or trajectory.profiles is None:
        return {"plane": study}
    waves = buckling_waves(trajectory.profiles)
    return {"plane": study, "buckle": None if waves is None else (float(shaped["depth_m"]), waves)}


def _oscillator(folder: Path) -> dict:
    return {"oscillator": read_oscillator(folder)}


_READERS = {
    "breaking_line": _breaking,
    "buoy": _buoy,
    "sweep": _sweep,
    "dependence": _dependence,
    "out_of_plane": _plane,
    "oscillator": _oscillator,
}
