"""Faults of a scene in words: one line each, with the key, what was given and what is allowed.

Faults of a single value are found by pydantic and put into words here; faults between values are found by
`rules`.
"""

import difflib
import re
from dataclasses import dataclass
from typing import Annotated, Literal, get_args, get_origin

from pydantic import BaseModel, ValidationError

# tables whose keys depend on one of them
_TAGS = {("tether", "tension"): "law", ("current",): "law", ("end", "motion"): "law"}
_BARE_KEY = re.compile(r"^[A-Za-z0-9_-]+$")
_NUMBER_TEXT = re.compile(r"^\s*([-+]?\d+)(?:[.,](\d+))?(?:e([-+]?\d+))?\s*(\w*)\s*$")
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


def shown(value: object) -> str:
    """A value in a fault line: as TOML would show it, and short."""
    text = {"True": "true", "False": "false", "None": "nothing"}.get(repr(value), repr(value))
    return text if len(text) <= 60 else text[:57] + "..."


def fault(key: str, given: object, allowed: str) -> str:
    """One fault line."""
    return f"{key}: given {shown(given)}; allowed: {allowed}"


def _meant(given: object) -> str:
    """A hint for text in the place of a number: "21.6", "21,6", "21.6 m"."""
    number = _NUMBER_TEXT.match(given) if isinstance(given, str) else None
    if number is None:
        return ""
    whole, part, power, unit = number.groups()
    text = whole + (f".{part}" if part else "") + (f"e{power}" if power else "")
    why = "no unit" if unit else "with a dot" if "," in given else "without quotes"
    return f" ({why}: {text})"


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


def known_keys(model: type[BaseModel], prefix: str = "") -> list[str]:
    """Every dotted key a scene may have, sections included."""
    keys: list[str] = []
    for name, field in model.model_fields.items():
        keys.append(prefix + name)
        for inner in section_models(field.annotation):
            keys += [key for key in known_keys(inner, f"{prefix}{name}.") if key not in keys]
    return keys


def suggestion(key: str, keys: list[str]) -> str:
    """ "; did you mean ...?" for a key that is close to a known one in full or in its last word, else ""."""
    close = difflib.get_close_matches(key, keys, n=1, cutoff=0.75)
    if not close:
        last = {known.rpartition(".")[2]: known for known in reversed(keys)}
        close = [last[word] for word in difflib.get_close_matches(key.rpartition(".")[2], list(last), n=1, cutoff=0.75)]
    return f"; did you mean {close[0]!r}?" if close else ""


def unknown_key(key: str, given: object, scene_model: type[BaseModel]) -> str:
    """The fault line of a key that no scene has."""
    keys = known_keys(scene_model)
    section = key.rpartition(".")[0]
    beside = [known.rpartition(".")[2] for known in keys if known.rpartition(".")[0] == section]
    where = f"allowed in {section}" if section else "allowed"
    allowed = f"; {where}: {', '.join(beside)}" if beside else ""
    return f"{key}: unknown key, given {shown(given)}{suggestion(key, keys)}{allowed}"


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


def _tag_choices(model: type[BaseModel], path: tuple[str, ...]) -> list[str]:
    models = [model]
    for part in path:
        models = [found for owner in models for found in section_models(owner.model_fields[part].annotation)]
    return [get_args(found.model_fields[_TAGS[path]].annotation)[0] for found in models]


def _has_tag(model: type[BaseModel], tag: str) -> bool:
    return any(get_args(model.model_fields[name].annotation) == (tag,) for name in _TAGS.values())


def _field_text(model: type[BaseModel], location: tuple[str | int, ...], tag: str | None) -> str | None:
    models, text = [model], None
    for depth, part in enumerate(location):
        if isinstance(part, int):  # a table inside a list has its own words, a number those of the whole list
            continue
        if tag is not None and location[:depth] in _TAGS:
            models = [owner for owner in models if _has_tag(owner, tag)]
        fields = [owner.model_fields[part] for owner in models if part in owner.model_fields]
        if not fields:  # an index inside a list: the whole list is described
            break
        text = allowed_text(fields[0].annotation, fields[0].metadata)
        models = section_models(fields[0].annotation)
    return text


def _untagged(location: tuple[str | int, ...]) -> tuple[tuple[str | int, ...], str | None]:
    # pydantic puts the tag of a discriminated union into the location; the user's key has none
    location = tuple(part for part in location if part not in (FLAT, SOLID))
    for path in _TAGS:
        if location[: len(path)] == path and len(location) > len(path):
            return (*path, *location[len(path) + 1 :]), str(location[len(path)])
    return location, None


def _inside(other: dict, item: dict) -> bool:
    return len(other["loc"]) > len(item["loc"]) and other["loc"][: len(item["loc"])] == item["loc"]


def field_faults(error: ValidationError, scene_model: type[BaseModel]) -> tuple[list[str], set[tuple[str | int, ...]]]:
    """Fault lines of single values, and the locations of the values that are at fault.

    error: pydantic's, from validating `scene_model`. Faults between values are left to `cross_faults`.
    """
    lines: list[str] = []
    bad: set[tuple[str | int, ...]] = set()
    items = error.errors(include_url=False)
    for item in items:
        location, tag = _untagged(tuple(item["loc"]))
        kind = item["type"]
        if kind in ("scene_consistency", "default_factory_not_called"):
            continue  # the first is found again by cross_faults; the second only follows from another fault
        if kind == "too_short" and any(_inside(other, item) for other in items):
            continue  # pydantic counts sound elements only: the faulty ones are reported themselves
        if kind in ("union_tag_invalid", "union_tag_not_found"):
            path = tuple(part for part in location if isinstance(part, str))
            location = (*location, _TAGS[path])
            allowed = "one of " + ", ".join(repr(choice) for choice in _tag_choices(scene_model, path))
            given = item["input"].get(_TAGS[path]) if isinstance(item["input"], dict) else item["input"]
        else:
            allowed, given = _field_text(scene_model, location, tag) or item["msg"], item["input"]
        short = kind == "missing" and isinstance(location[-1], int)  # a list of too few: shown as a whole, once
        location = location[:-1] if short else location
        bad.add(location)
        key = dotted(location)
        if kind == "extra_forbidden" and tag is not None:
            lines.append(f"{key}: given {shown(given)}, which law = {tag!r} does not have")
        elif kind == "extra_forbidden":
            lines.append(unknown_key(key, given, scene_model))
        elif kind in ("missing", "union_tag_not_found") and not short:
            lines.append(f"{key}: missing; allowed: {allowed}")
        else:
            lines.append(fault(key, given, allowed) + (_meant(given) if "number" in allowed else ""))
    return list(dict.fromkeys(lines)), bad
