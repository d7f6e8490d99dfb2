"""Faults of a scene in words: one line each, with the key, what was given and what is allowed.

Faults of a single value are found by pydantic and put into words here; faults between values are found by
`rules`.
"""

import difflib
import math
import re
from collections.abc import Mapping
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


class SceneError(ValueError):
    """A scene that cannot be simulated. `faults`: one line per fault; `str()` is one message with all of them."""

    def __init__(self, faults: tuple[str, ...] | list[str] | str) -> None:
        self.faults = (faults,) if isinstance(faults, str) else tuple(faults)
        super().__init__(self.faults)  # the arguments that pickle hands back when an error crosses processes

    def __str__(self) -> str:
        count = len(self.faults)
        if count == 1:
            return f"faulty scene: {self.faults[0]}"
        return "\n".join([f"faulty scene, {count} faults:", *(f"  {fault}" for fault in self.faults)])


@dataclass(frozen=True)
class Allowed:
    """Annotation of a field type: what it allows, in words for a person."""

    text: str


def shown(value: object, most: int = 60) -> str:
    """A value in a fault line: as TOML would show it, and short."""
    text = {"True": "true", "False": "false", "None": "nothing"}.get(repr(value), repr(value))
    return text if len(text) <= most else text[: most - 3] + "..."


def fault(key: str, given: object, allowed: str) -> str:
    """One fault line."""
    return f"{key}: given {shown(given)}; allowed: {allowed}"


def _meant(given: object, key: str) -> str:
    """A hint for text in the place of a number: "21.6", "21,6", "21.6 m", and "20 cm" for a key in metres."""
    number = _NUMBER_TEXT.match(given) if isinstance(given, str) else None
    if number is None:
        return ""
    whole, part, power, unit = number.groups()
    text = whole + (f".{part}" if part else "") + (f"e{power}" if power else "")
    own = re.sub(r"\[\d+\]$", "", key).rpartition("_")[2]
    if unit and unit != own and (wanted := _sized(own)):
        found = _sized(unit)
        if found is None or found[0] != wanted[0]:
            return f" (a number in {own}, without its unit)"
        text = f"{float(text) * found[1] / wanted[1]:.12g}"
    why = "no unit" if unit else "with a dot" if "," in given else "without quotes"
    return f" ({why}: {text})"


def _sized(unit: str) -> tuple[str, float] | None:
    """What a unit measures, and its size; None for a unit that is not of `_UNITS`.

    >>> _sized("cm"), _sized("mm2"), _sized("kg"), _sized("ft")
    (('m', 0.01), ('m2', 1e-06), ('kg', 1.0), None)
    """
    name, power = (unit[:-1], int(unit[-1])) if unit[-1:].isdigit() else (unit, 1)
    for prefix, times in _PREFIXES.items():
        if name.startswith(prefix) and (known := _UNITS.get(name.removeprefix(prefix))):
            return known[0] + (str(power) if power > 1 else ""), (times * known[1]) ** power
    return None


def too_deep(value: object) -> bool:
    """Whether lists and tables lie within each other at more than DEEPEST levels: nothing could take them apart."""
    level = [value]
    for _ in range(DEEPEST):
        level = [
            inner
            for one in level
            if isinstance(one, (Mapping, list, tuple))
            for inner in (one.values() if isinstance(one, Mapping) else one)
        ]
    return bool(level)


def dotted(location: tuple[str | int, ...]) -> str:
    """("current", "height_m", 2) -> "current.height_m[2]"; a name that is no bare key of TOML in quotes."""
    text = ""
    for part in location:
        name = part if isinstance(part, int) or _BARE_KEY.match(part) else shown(part)
        text += f"[{name}]" if isinstance(part, int) else f".{name}" if text else str(name)
    return text


def section_models(annotation: object) -> list[type[BaseModel]]:
    """The models that an annotation names, at any depth of Annotated and unions."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for part in get_args(annotation) for model in section_models(part)]


@cache
def known_fields(model: type[BaseModel]) -> dict[str, FieldInfo]:
    """Every dotted key a scene may have, sections included, with its declaration: of several the one with a meaning."""
    found: dict[str, FieldInfo] = {}
    for name, field in model.model_fields.items():
        below = [known_fields(inner).items() for inner in section_models(field.annotation)]
        for key, declared in [(name, field), *((f"{name}.{key}", inner) for part in below for key, inner in part)]:
            if key not in found or not found[key].description:
                found[key] = declared
    return found


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


def unknown_key(key: str, given: object, scene_model: type[BaseModel]) -> str:
    """The fault line of a key that no scene has."""
    keys = list(known_fields(scene_model))
    if len(ends := ending_in(key, scene_model)) > 1:
        return f"{key}: the end of {len(ends)} keys, given {shown(given)}; allowed: one of {', '.join(ends)}"
    section = key.rpartition(".")[0]
    beside = [known.rpartition(".")[2] for known in keys if known.rpartition(".")[0] == section]
    where = f"allowed in {section}" if section else "allowed"
    allowed = f"; {where}: {', '.join(beside)}" if beside else ""
    meant = f"; did you mean {_INSTEAD[key]}?" if key in _INSTEAD else suggestion(key, keys)
    return f"{key}: unknown key, given {shown(given, 20)}{meant}{allowed}"


def allowed_text(annotation: object, metadata: list[object] | tuple[object, ...] = ()) -> str | None:
    """What a field allows, in words: its Allowed, its choices, or the keys of its table; None where nothing says."""
    for item in metadata:
        if isinstance(item, Allowed):
            return item.text
    if get_origin(annotation) is Literal:
        return "one of " + ", ".join(repr(value) for value in get_args(annotation))
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return "a table with the keys " + ", ".join(annotation.model_fields)
    if get_origin(annotation) is Annotated:
        inner, *more = get_args(annotation)
        return allowed_text(inner, more)
    for part in get_args(annotation):
        text = allowed_text(part)
        if text is not None:
            return text
    return None


def law_names(models: list[type[BaseModel]]) -> list[str]:
    """The names of laws, each of which is one model of a table."""
    return [get_args(model.model_fields["law"].annotation)[0] for model in models]


def _placed(location: tuple[str | int, ...], model: type[BaseModel]) -> tuple:
    """Where a fault is: the user's location, the models of that table, the law that they are of, what is allowed there.

    location: pydantic's, into which it puts the law of a table, and how deep a block is nested.
    """
    models, place, law, text = [model], [], None, None
    for part in location:
        if len(models) > 1:
            law, models = part, [found for found in models if law_names([found]) == [part]]
        elif part not in (FLAT, SOLID):
            place.append(part)
            if models and part in models[0].model_fields:  # a number in a list is described with the whole list
                field = models[0].model_fields[part]
                text, models = allowed_text(field.annotation, field.metadata), section_models(field.annotation)
    return tuple(place), models, law, text


def field_faults(error: ValidationError, scene_model: type[BaseModel]) -> tuple[list[str], set[tuple[str | int, ...]]]:
    """Fault lines of single values, and the locations of the values that are at fault.

    error: pydantic's, from validating `scene_model`. Faults between values are left to `cross_faults`.
    """
    lines: list[str] = []
    bad: set[tuple[str | int, ...]] = set()
    items = error.errors(include_url=False)
    for item in items:
        kind, given = item["type"], item["input"]
        if kind in ("scene_consistency", "default_factory_not_called"):
            continue  # the first is found again by cross_faults; the second only follows from another fault
        size = len(item["loc"])
        if kind == "too_short" and any(other["loc"][:size] == item["loc"] != other["loc"] for other in items):
            continue  # pydantic counts sound elements only: the faulty ones are reported themselves
        place, models, law, text = _placed(item["loc"], scene_model)
        bad.add(place)
        allowed = text or item["msg"]
        if kind in ("union_tag_invalid", "union_tag_not_found"):
            place = (*place, "law")
            allowed = "one of " + ", ".join(repr(name) for name in law_names(models))
            given = given.get("law") if isinstance(given, dict) else given
        short = kind == "missing" and isinstance(place[-1], int)  # a list of too few: shown as a whole, once
        key = dotted(place[:-1] if short else place)
        if kind == "extra_forbidden" and law is not None:
            lines.append(f"{key}: given {shown(given)}, which law = {law!r} does not have")
        elif kind == "extra_forbidden":
            lines.append(unknown_key(key, given, scene_model))
        elif kind in ("missing", "union_tag_not_found") and not short:
            lines.append(f"{key}: missing; allowed: {allowed}")
        else:
            lines.append(fault(key, given, allowed) + (_meant(given, key) if "number" in allowed else ""))
    return list(dict.fromkeys(lines)), bad
