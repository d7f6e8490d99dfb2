"""Types of the values of a scene: what each allows, in words for a person, and the base of every section."""

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from engine.scene_faults import FLAT, SOLID, Allowed

# Strict leaves: neither "1.0" nor true is a number, and 41.0 is not a count; a whole number is a number.
_Float = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Number = Annotated[_Float, Allowed("a finite number")]
Positive = Annotated[_Float, Field(gt=0), Allowed("a finite number above 0")]
NonNegative = Annotated[_Float, Field(ge=0), Allowed("a finite number, 0 or above")]
UnitInterval = Annotated[_Float, Field(ge=0, le=1), Allowed("a number from 0 to 1")]
Tolerance = Annotated[_Float, Field(gt=0, lt=1), Allowed("a number above 0 and below 1")]
Stretching = Annotated[_Float, Field(ge=0, le=5), Allowed("a number from 0 to 5")]
Nodes = Annotated[int, Field(strict=True, ge=3, le=20000), Allowed("a whole number from 3 to 20000")]
Count = Annotated[int, Field(strict=True, ge=1, le=10**9), Allowed("a whole number from 1 to 1000000000")]
CountOrZero = Annotated[int, Field(strict=True, ge=0, le=10**9), Allowed("a whole number from 0 to 1000000000")]
Flag = Annotated[bool, Field(strict=True), Allowed("true or false")]
Text = Annotated[str, Field(strict=True), Allowed("text")]
Name = Annotated[str, Field(strict=True, pattern=r"^[A-Za-z0-9_.-]+$"), Allowed("letters, digits, and any of _ . -")]
Vector = Annotated[tuple[_Float, _Float, _Float], Allowed("a list of 3 finite numbers [x, y, z]")]
Five = Annotated[tuple[_Float, _Float, _Float, _Float, _Float], Allowed("a list of 5 finite numbers")]
Series = Annotated[tuple[_Float, ...], Field(min_length=2), Allowed("a list of at least 2 finite numbers")]
Axis = Annotated[tuple[_Float, ...], Field(min_length=1), Allowed("a list of at least 1 finite number")]
Vectors = Annotated[
    tuple[tuple[_Float, _Float, _Float], ...], Field(min_length=2), Allowed("a list of at least 2 vectors [x, y, z]")
]
_Flat = tuple[tuple[tuple[_Float, ...], ...], ...]
_Solid = tuple[_Flat, ...]


def _block_kind(value: object) -> str:
    """FLAT or SOLID: how deep the lists are nested, judged by the first entries."""
    depth = 0
    while isinstance(value, (list, tuple)) and value:
        value, depth = value[0], depth + 1
    return SOLID if depth > 3 else FLAT


Block = Annotated[
    Annotated[_Flat, Field(min_length=1), Tag(FLAT)] | Annotated[_Solid, Field(min_length=1), Tag(SOLID)],
    Discriminator(_block_kind),
    Allowed("finite numbers as nested lists, indexed [time][height][x], or [time][height][y][x] with current.y_m"),
]


class Section(BaseModel):
    """A part of a scene: immutable, and an unknown key is a fault."""

    model_config = ConfigDict(frozen=True, extra="forbid")
