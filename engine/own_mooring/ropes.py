"""Properties of ropes by material and diameter, from the coefficients of ropes.toml."""

import math
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path


@dataclass(frozen=True)
class Rope:
    """A rope of a nominal diameter d.

    area_m2: of the material, mass per length / density, which displaces water. stiffness_N: EA. elsewhere: what further
    sources say of it. bending_Nm2: EA A/(4 pi), that of a solid rod of this area, which
    threads that slide on each other do not reach.
    """

    title: str
    diameter_m: float
    density_kgpm3: float
    area_m2: float
    stiffness_N: float
    breaking_load_N: float
    source: str
    elsewhere: str

    @property
    def mass_kgpm(self) -> float:
        """Mass per length in air."""
        return self.density_kgpm3 * self.area_m2

    @property
    def bending_Nm2(self) -> float:
        """E I with E = EA/A and I = A^2/(4 pi)."""
        return self.stiffness_N * self.area_m2 / (4.0 * math.pi)


@cache
def _table() -> dict[str, dict]:
    return tomllib.loads(Path(__file__).with_name("ropes.toml").read_text(encoding="utf-8"))


def materials() -> dict[str, str]:
    """Name in the table -> what the rope is."""
    return {name: row["title"] for name, row in _table().items()}


def rope_of(material: str, diameter_m: float) -> Rope:
    """The rope of a material of `materials` with a nominal diameter. Raises KeyError."""
    row = _table()[material]
    breaking_N = row["breaking_Npm2"] * diameter_m**2 + row.get("breaking_Npm3", 0.0) * diameter_m**3
    stiffness_N = row.get("stiffness_per_breaking", 0.0) * breaking_N
    if "stiffness_Npm2" in row:
        stiffness_N = row["stiffness_Npm2"] * diameter_m**2
    return Rope(
        title=row["title"],
        diameter_m=diameter_m,
        density_kgpm3=row["density_kgpm3"],
        area_m2=row["mass_kgpm3"] * diameter_m**2 / row["density_kgpm3"],
        stiffness_N=stiffness_N,
        breaking_load_N=breaking_N,
        source=row["source"],
        elsewhere=row.get("elsewhere", "no further source"),
    )
