"""Faults of a scene in words: one line each, with the key, what was given and what is allowed.

Faults of a single value are found by pydantic and put into words here; faults between values are found by
`rules`.
"""

import difflib
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Literal, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

_BARE_KEY = re.compile(r"^[A-Za-z0-9_-]+$")
_NUMBER_TEXT = re.compile(r"^\s*([-+]?\d+)(?:[.,](\d+))?(?:e([-+]?\d+))?\s*(\w*)\s*$")
# units that people write after a number: (unit of the keys, size in it); with a prefix, and squared, they are known too
_UNITS = {
    "m": ("m", 1.0), "g": ("kg", 1e-3), "t": ("kg", 1e3), "s": ("s", 1.0), "min": ("s", 60.0), "h": ("s", 3600.0),
    "N": ("N", 1.0), "rad": ("rad", 1.0), "deg": ("rad", math.pi / 180.0),
}  # fmt: skip
_PREFIXES = {"": 1.0, "k": 1e3, "c": 1e-2, "m": 1e-3}
# keys that no scene has, for which the nearest name would mislead
_INSTEAD = dict.fromkeys(("waves.height_m", "height_m"), "'waves.amplitude_m', half of the height")
DEEPEST = 32  # levels of lists and tables; scenes have six
TOO_DEEP = f"given lists or tables within each other; allowed: at most {DEEPEST} levels"
FLAT, SOLID = "nested to depth 3", "nested to depth 4"  # kinds of a block of numbers, as pydantic names them
LONGEST_VALUE, SHORT_VALUE = 60, 20  # letters of a value in a fault line

Location = tuple[str | int, ...]  # of a value: names of tables and keys, places in lists


class SceneError(ValueError):
    """A scene that cannot be simulated. `faults`: one line per fault; `str()` is one message with all of them."""

    def __init__(self, faults: tuple[str, ...] | list[str] | str) -> None:
        self.faults = (faults,) if isinstance(faults, str) else tuple(faults)
        super().__init__(self.faults)  # the arguments that pickle hands back when an error crosses processes

    def __str__(self) -> str:
        if len(self.faults) == 1:
            return f"faulty scene: {self.faults[0]}"
        return "\n  ".join([f"faulty scene, {len(self.faults)} faults:", *self.faults])


@dataclass(frozen=True)
class Allowed:
    """Annotation of a field type: what it allows, in words for a person."""

    text: str


def shown(value: object, longest: int = LONGEST_VALUE) -> str:
    """A value in a fault line: as TOML would show it, and short."""
    text = {"True": "true", "False": "false", "None": "nothing"}.get(repr(value), repr(value))
    return text if len(text) <= longest else text[: longest - 3] + "..."


def fault(key: str, value: object, allowed: str) -> str:
    """One fault line."""
    return f"{key}: given {shown(value)}; allowed: {allowed}"


def _number_hint(value: object, key: str) -> str:
    """A hint for text in the place of a number: "21.6", "21,6", "21.6 m", and "20 cm" for a key in metres."""
    number = _NUMBER_TEXT.match(value) if isinstance(value, str) else None
    if number is None:
        return ""
    integer, decimals, power, unit = number.groups()
    text = integer + (f".{decimals}" if decimals else "") + (f"e{power}" if power else "")
    key_unit = re.sub(r"\[\d+\]$", "", key).rpartition("_")[2]
    wanted = _measure_of(key_unit)
    if unit and unit != key_unit and wanted:
        measure = _measure_of(unit)
        if measure is None or measure[0] != wanted[0]:
            return f" (a number in {key_unit}, without its unit)"
        text = f"{float(text) * measure[1] / wanted[1]:.12g}"
    if unit:
        return f" (no unit: {text})"
    return f" (with a dot: {text})" if "," in value else f" (without quotes: {text})"


def _measure_of(unit: str) -> tuple[str, float] | None:
    """What a unit measures, and its size; None for a unit that is not of `_UNITS`.

    >>> _measure_of("cm"), _measure_of("mm2"), _measure_of("kg"), _measure_of("ft")
    (('m', 0.01), ('m2', 1e-06), ('kg', 1.0), None)
    """
    name, power = (unit[:-1], int(unit[-1])) if unit[-1:].isdigit() else (unit, 1)
    for prefix, times in _PREFIXES.items():
        base = _UNITS.get(name.removeprefix(prefix)) if name.startswith(prefix) else None
        if base:
            return base[0] + (str(power) if power > 1 else ""), (times * base[1]) ** power
    return None


def too_deep(value: object) -> bool:
    """Whether lists and tables lie within each other at more than DEEPEST levels: nothing could take them apart."""
    level = [value]
    for _ in range(DEEPEST):
        below = []
        for item in level:
            if isinstance(item, Mapping):
                below += item.values()
            elif isinstance(item, (list, tuple)):
                below += item
        level = below
    return bool(level)


def dotted(location: Location) -> str:
    """("current", "height_m", 2) -> "current.height_m[2]"; a name that is no bare key of TOML in quotes."""
    text = ""
    for part in location:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            name = part if _BARE_KEY.match(part) else shown(part)
            text += f".{name}" if text else name
    return text


def section_models(annotation: object) -> list[type[BaseModel]]:
    """The models that an annotation names, at any depth of Annotated and unions."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in section_models(part)]


@cache
def known_fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Every dotted key a scene may have, sections included, with its declaration: of several the one with a meaning."""
    fields: dict[str, FieldInfo] = {}

    def add(key, field):
        if key not in fields or not fields[key].description:
            fields[key] = field

    for name, field in model.model_fields.items():
        add(name, field)
        for section in section_models(field.annotation):
            for key, inner in known_fields(section).items():
                add(f"{name}.{key}", inner)
    return fields


def suggestion(key: str, keys: list[str]) -> str:
    """ "; did you mean ...?" for a key that is close to a known one in full or in its last word, else ""."""
    close = difflib.get_close_matches(key, keys, n=1, cutoff=0.75)
    if not close:
        last = {known.rpartition(".")[2]: known for known in reversed(keys)}
        close = [last[word] for word in difflib.get_close_matches(key.rpartition(".")[2], list(last), n=1, cutoff=0.75)]
    return f"; did you mean {close[0]!r}?" if close else ""


def ending_in(word: str, model: type[BaseModel]) -> list[str]:
    """The keys of which a word is the whole or, where there is none, the last part."""
    known = {} if word in _INSTEAD else known_fields(model)
    return [word] if word in known else [key for key in known if key.rpartition(".")[2] == word]


def unknown_key(key: str, value: object, scene_model: type[BaseModel]) -> str:
    """The fault line of a key that no scene has."""
    ends = ending_in(key, scene_model)
    if len(ends) > 1:
        return f"{key}: the end of {len(ends)} keys, given {shown(value)}; allowed: one of {', '.join(ends)}"
    keys = list(known_fields(scene_model))
    hint = f"; did you mean {_INSTEAD[key]}?" if key in _INSTEAD else suggestion(key, keys)
    section = key.rpartition(".")[0]
    names = [known.rpartition(".")[2] for known in keys if known.rpartition(".")[0] == section]
    if names:
        hint += f"; allowed in {section}: " if section else "; allowed: "
        hint += ", ".join(names)
    return f"{key}: unknown key, given {shown(value, SHORT_VALUE)}{hint}"


def allowed_text(annotation: object, metadata: list[object] | tuple[object, ...] = ()) -> str | None:
    """What a field allows, in words: its Allowed, its choices, or the keys of its table; None where nothing says."""
    for item in metadata:
        if isinstance(item, Allowed):
            return item.text
    if get_origin(annotation) is Literal:
        return _one_of(get_args(annotation))
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return "a table with the keys " + ", ".join(annotation.model_fields)
    if get_origin(annotation) is Annotated:
        inner, *metadata = get_args(annotation)
        return allowed_text(inner, metadata)
    return next(filter(None, map(allowed_text, get_args(annotation))), None)


def _one_of(names: list[str] | tuple[str, ...]) -> str:
    return "one of " + ", ".join(map(repr, names))


def law_names(models: list[type[BaseModel]]) -> list[str]:
    """The names of laws, each of which is one model of a table."""
    return [get_args(model.model_fields["law"].annotation)[0] for model in models]


@dataclass(frozen=True)
class _Place:
    """Where a fault is.

    location: the user's; models: of the table there; law: that it is of, or None; allowed: there, or None.
    """

    location: Location
    models: list[type[BaseModel]]
    law: str | None
    allowed: str | None


def _place_of(location: Location, model: type[BaseModel]) -> _Place:
    """location: pydantic's, into which it puts the law of a table, and how deep a block is nested."""
    models, parts, law, allowed = [model], [], None, None
    for part in location:
        if len(models) > 1:
            law, models = part, [choice for choice in models if law_names([choice]) == [part]]
        elif part not in (FLAT, SOLID):
            parts.append(part)
            if models and part in models[0].model_fields:  # a number in a list is described with the whole list
                field = models[0].model_fields[part]
                allowed, models = allowed_text(field.annotation, field.metadata), section_models(field.annotation)
    return _Place(tuple(parts), models, law, allowed)


def field_faults(error: ValidationError, scene_model: type[BaseModel]) -> tuple[list[str], set[Location]]:
    """Fault lines of single values, and the locations of the values that are at fault.

    error: pydantic's, from validating `scene_model`. Faults between values are left to `cross_faults`.
    """
    lines: list[str] = []
    locations: set[Location] = set()
    for item in _items_of(error):
        place = _place_of(item["loc"], scene_model)
        locations.add(place.location)
        lines.append(_line_of(item, place, scene_model))
        if item["type"] == "union_tag_not_found" and isinstance(item["input"], dict):
            lines += _lists_as_text(item["input"], place)
    return list(dict.fromkeys(lines)), locations


def _lists_as_text(table: dict, place: _Place) -> Iterator[str]:
    """Fault lines of the lists without brackets in a table without a law, whose values are not judged otherwise."""
    for name, value in table.items():
        if isinstance(value, str) and "," in value:
            yield fault(dotted((*place.location, name)), value, "a list") + _in_brackets(value)


def _in_brackets(text: str) -> str:
    """The hint for a list as text: "0,0,0"."""
    return f" (written '[{text.strip('()[] ')}]')"


def _items_of(error: ValidationError) -> Iterator[dict]:
    """The faults that pydantic has found, without those that only follow from others."""
    items = error.errors(include_url=False)
    for item in items:
        location = item["loc"]
        if item["type"] in ("scene_consistency", "default_factory_not_called"):
            continue  # the first is found again by cross_faults; the second only follows from another fault
        elements = [other["loc"] for other in items if other["loc"][: len(location)] == location != other["loc"]]
        if item["type"] == "too_short" and elements:
            continue  # pydantic counts sound elements only: the faulty ones are reported themselves
        yield item


def _line_of(item: dict, place: _Place, scene_model: type[BaseModel]) -> str:
    """The fault line of one of pydantic's faults."""
    kind, value, location = item["type"], item["input"], place.location
    allowed = place.allowed or item["msg"]
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        location, allowed = (*location, "law"), _one_of(law_names(place.models))
        value = value.get("law") if isinstance(value, dict) else value
    too_few = kind == "missing" and isinstance(location[-1], int)  # a list of too few: shown as a whole, once
    key = dotted(location[:-1] if too_few else location)
    if kind == "extra_forbidden" and place.law is not None:
        return f"{key}: given {shown(value)}, which law = {place.law!r} does not have"
    if kind == "extra_forbidden":
        return unknown_key(key, value, scene_model)
    if kind in ("missing", "union_tag_not_found") and not too_few:
        return f"{key}: missing; allowed: {allowed}"
    hint = _number_hint(value, key) if "number" in allowed else ""
    if allowed.startswith("a list of") and isinstance(value, str) and "," in value:
        hint = _in_brackets(value)
    return fault(key, value, allowed) + hint
