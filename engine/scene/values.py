"""Types of the values of a scene: what each allows, in words for a person, and the base of every section."""

from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Discriminator, Field, Tag
from pydantic_core import PydanticCustomError

from engine.scene.faults import FLAT, SOLID, Allowed

# No length, mass or stiffness of anything lies beyond these, and products of a few of them stay far from where floating
# point overflows (1.8e308) or loses digits (denormals, below 2.2e-308): sums of squares and cubes are safe everywhere.
SMALLEST, LARGEST = 1e-30, 1e30


def _zero_or_not_tiny(number: float) -> float:
    if 0 < number < SMALLEST:
        raise PydanticCustomError("tiny", "a number so small that it can only be meant as 0")
    return number


# Strict leaves: neither "1.0" nor true is a number, and 41.0 is not a count; a whole number is a number.
_Float = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-LARGEST, le=LARGEST)]
_UP_TO = f"{SMALLEST:g} to {LARGEST:g}"
_MOST = f"{LARGEST:g} in size"
Number = Annotated[_Float, Allowed("a finite number, at most " + _MOST)]
Positive = Annotated[_Float, Field(gt=0, ge=SMALLEST), Allowed(f"a finite number above 0, {_UP_TO}")]
NonNegative = Annotated[
    _Float, Field(ge=0), AfterValidator(_zero_or_not_tiny), Allowed(f"a finite number, 0 or above: 0, or {_UP_TO}")
]


def _number_from(low: float, high: float) -> Any:
    return Annotated[_Float, Field(ge=low, le=high), Allowed(f"a number from {low:g} to {high:g}")]


def _whole_from(low: int, high: int) -> Any:
    return Annotated[int, Field(strict=True, ge=low, le=high), Allowed(f"a whole number from {low} to {high}")]


UnitInterval = _number_from(0, 1)
Tolerance = Annotated[
    _Float, Field(gt=0, ge=SMALLEST, lt=1), Allowed(f"a number above 0 and below 1, {SMALLEST:g} or more")
]
Stretching = _number_from(0, 5)
Nodes = _whole_from(3, 20000)
Count = _whole_from(1, 10**9)
CountOrZero = _whole_from(0, 10**9)
MOST_COMPONENTS = 2000
Components = _whole_from(1, MOST_COMPONENTS)
PeakEnhancement = _number_from(1, 10)
RelativeWidth = _number_from(0, 0.2)
Flag = Annotated[bool, Field(strict=True), Allowed("true or false")]
Text = Annotated[str, Field(strict=True), Allowed("text")]
Name = Annotated[str, Field(strict=True, pattern=r"^[A-Za-z0-9_.-]+$"), Allowed("letters, digits, and any of _ . -")]
Vector = Annotated[tuple[_Float, _Float, _Float], Allowed("a list of 3 finite numbers [x, y, z], at most " + _MOST)]
Five = Annotated[tuple[_Float, _Float, _Float, _Float, _Float], Allowed("a list of 5 finite numbers, at most " + _MOST)]


def _several(kind: type, least: int, words: str) -> Any:
    allowed = Allowed(f"a list of at least {least} {words}, at most {_MOST}")
    return Annotated[tuple[kind, ...], Field(min_length=least), allowed]


Series = _several(_Float, 2, "finite numbers")
Axis = _several(_Float, 1, "finite number")
Vectors = _several(tuple[_Float, _Float, _Float], 2, "vectors [x, y, z]")
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
    Allowed(
        f"finite numbers, at most {_MOST}, as nested lists, indexed [time][height][x], or [time][height][y][x] with "
        "current.y_m"
    ),
]


def described(meaning: str, *default: object, symbol: str = "", paper: str = "", **options: object) -> Any:
    """The declaration of one scene key.

    meaning: a noun phrase for a person; default: left out where the key is required; symbol: the paper's letter, with
    an underscore before a subscript; paper: equation, table or section that has it. The unit is the suffix of the key.
    """
    return Field(*default, description=meaning, json_schema_extra={"symbol": symbol, "paper": paper}, **options)


class Section(BaseModel):
    """A part of a scene: immutable, and an unknown key is a fault."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"{name}: a scene does not change; load_scene(name, {{key: value}}) makes another one")

    def __dir__(self) -> list[str]:
        """The keys, and what a scene can do; without the names of pydantic."""
        own = {name for kind in type(self).__mro__ if issubclass(kind, Section) for name in vars(kind)}
        return sorted({*type(self).model_fields, *(name for name in own if not name.startswith(("_", "model_")))})
