"""Scenes by name or from a file, with single values overridden by dotted keys.

    scene = load_scene("tethered_buoy", {"waves.steepness": 0.13, "water.depth_m": 21.6})
    scene = load_scene("tethered_buoy", steepness=0.13, depth_m=21.6)

The models are in `models`, the shipped scenes in `engine/scenes/*.toml`.
"""

import contextlib
import copy
import difflib
import inspect
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path

from engine.scene.faults import DEEPEST, TOO_DEEP, SceneError, ending_in, known_fields, shown, too_deep, unknown_key
from engine.scene.models import Scene, build_scene
from engine.scene.water_rules import BESIDE, HEIGHTS

_LONG_KEY = re.compile(rf"(?<![\w-])(?:[\w-]++\s*\.\s*){{{DEEPEST}}}")
_SHIPPED = Path(__file__).parents[1] / "scenes"


def list_scenes() -> list[str]:
    """Names of the scenes that come with the engine."""
    return sorted(path.stem for path in _SHIPPED.glob("*.toml"))


def shipped_text(name: str) -> str:
    """The TOML text of a shipped scene, with its comments: where each value comes from."""
    return (_SHIPPED / f"{name}.toml").read_text(encoding="utf-8")


def load_scene(name_or_path: str | Path, overrides: Mapping[str, object] | None = None, **keywords: object) -> Scene:
    """A validated scene from a shipped name or a TOML file.

    name_or_path: one of `list_scenes()`, or the path of a scene file. overrides: dotted key -> value; a value of None
    removes an optional key or section, a missing section is created, and waves of another kind (`water_rules.HEIGHTS`)
    take the place of those of the file. keywords: more of them, by the last word of a key where no other key ends in
    it, as steepness=0.13. The file of waves.record is looked for beside the scene file, or in the working directory if
    an override names it.
    Raises SceneError: every fault of the file and of the overrides at once; nothing of that name, unreadable, not TOML.
    """
    if not isinstance(overrides, Mapping | None):
        raise TypeError(f"overrides: given {overrides!r}; allowed: a mapping of keys to values")
    text, changes = _text_of(name_or_path), dict(overrides or {})
    for word, value in keywords.items():
        ends = ending_in(word, Scene)
        key = ends[0] if len(ends) == 1 else word
        if key in changes:
            rest = f"beside {key} = {shown(changes[key])}; allowed: one of the two"
            raise SceneError(f"{word}: given {shown(value)} {rest}")
        changes[key] = value
    folder = Path() if "waves.record" in changes else Path(name_or_path).parent
    return scene_from_toml(text, changes, str(name_or_path), folder)


def _name_keywords() -> None:
    """Put the keywords that `load_scene` takes into its signature, so that Tab completes them."""
    given = inspect.signature(load_scene)
    parameters = [entry for entry in given.parameters.values() if entry.kind != inspect.Parameter.VAR_KEYWORD]
    words = {key.rpartition(".")[2] for key in known_fields(Scene)}
    for word in sorted(word for word in words if len(ending_in(word, Scene)) == 1):
        parameters.append(inspect.Parameter(word, inspect.Parameter.KEYWORD_ONLY, default=...))
        load_scene.__annotations__[word] = object
    load_scene.__signature__ = given.replace(parameters=parameters)


_name_keywords()


def scene_from_toml(
    text: str, overrides: Mapping[str, object] | None = None, source: str = "scene text", folder: Path = Path()
) -> Scene:
    """A validated scene from TOML text, as `Scene.to_toml` writes it; overrides and SceneError as for `load_scene`.

    folder: in which the path of waves.record begins.
    """
    try:
        raw = _parsed(text, source)
    except tomllib.TOMLDecodeError as error:
        raise SceneError(f"{source}: not TOML: {error}{_faulty_line(text, str(error))}") from None
    raw, faults = _overridden(raw, overrides or {})
    return build_scene(raw, faults, folder)


def _parsed(text: str, source: str) -> dict[str, object]:
    """The content of TOML text. Raises TOMLDecodeError, and SceneError where it is nested beyond all use."""
    with contextlib.suppress(RecursionError):  # and for a key of very many parts the parser takes all memory
        raw = None if _LONG_KEY.search(text) else tomllib.loads(text)
        if raw is not None and not too_deep(raw):
            return raw
    raise SceneError(f"{source}: {TOO_DEEP}")


def _faulty_line(text: str, message: str) -> str:
    """The line that the parser's message names, quoted; empty where it names none."""
    number = re.search(r"at line (\d+)", message)
    lines = text.splitlines()
    if number is None or int(number[1]) > len(lines):
        return ""
    line = lines[int(number[1]) - 1].strip()
    comma = "; numbers have a dot, not a comma" if re.search(r"= *-?\d+,\d+\s*(#|$)", line) else ""
    return f": {shown(line)}{comma}"


def parse_assignment(text: str) -> tuple[str, object]:
    """("water.depth_m", 21.6) from "water.depth_m=21.6", as given to --set on a command line.

    The value is read as TOML, or is text where it is not TOML; `none` stands for None, which removes the key.
    Raises SceneError without a key or an equals sign.
    """
    key, equals, value = (part.strip() for part in text.partition("="))
    if not equals or not key:
        raise SceneError(f"--set: given {text!r}; allowed: KEY=VALUE, for instance water.depth_m=21.6")
    if value == "none":
        return key, None
    try:
        parsed = _parsed(f"value = {value}", f"--set {shown(key)}")
    except tomllib.TOMLDecodeError:
        if re.fullmatch(r"[+-]?(\.\d+|\d+\.)([eE][+-]?\d+)?", value):
            return key, float(value)  # TOML asks for a digit on both sides of the dot
        if value.startswith(("{", "[")):
            allowed = "a list or table of TOML, in single quotes or the shell takes its double ones"
            example = "--set 'tether.tension={law=\"linear\", stiffness_N=5e4}'"
            raise SceneError(f"--set {key}: given {value!r}; allowed: {allowed}: {example}") from None
        return key, value
    return key, parsed["value"] if parsed.keys() == {"value"} else value


def _text_of(name_or_path: str | Path) -> str:
    names, name = list_scenes(), str(name_or_path)
    path = _SHIPPED / f"{name}.toml" if name in names else Path(name)
    allowed = f"allowed: a scene file, or one of {', '.join(names)}"
    try:
        return path.read_text(encoding="utf-8-sig")
    except IsADirectoryError:
        fault = f"{name!r} is a folder; {allowed}"
    except UnicodeDecodeError:
        fault = f"{name!r} is not text in UTF-8; allowed: a TOML file, saved as UTF-8"
    except FileNotFoundError:
        close = difflib.get_close_matches(name, names, n=1)
        fault = f"there is no scene and no file {name!r}{f'; did you mean {close[0]!r}?' if close else ''}; {allowed}"
    except (OSError, ValueError) as error:
        fault = f"{name!r} cannot be read: {error}"
    raise SceneError(fault)


def _plain(value: object) -> object:
    """Lists and Python scalars in place of tuples, NumPy arrays and NumPy scalars."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    return [_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


def _overridden(raw: dict[str, object], overrides: Mapping[str, object]) -> tuple[dict[str, object], tuple[str, ...]]:
    """A copy of the raw scene with the overrides, and the faults of their keys; values are checked later."""
    raw, faults = copy.deepcopy(raw), []
    if isinstance(raw.get("waves"), dict):
        _drop_inherited_heights(raw, overrides)
    for key, value in overrides.items():
        *above, last = key.split(".") if isinstance(key, str) else [""]
        if not all((*above, last)):
            faults.append(f"{key!r}: not a key; allowed: names joined by dots, for instance water.depth_m")
            continue
        if too_deep(value):
            faults.append(f"{key}: {TOO_DEEP}")
            continue
        if key not in known_fields(Scene):
            faults.append(unknown_key(key, value, Scene))
            continue
        table = raw
        for part in above:
            if isinstance(table, dict):
                if table.get(part) is None and value is not None:
                    table[part] = {}
                table = table.get(part)
        if isinstance(table, dict) and value is None:
            table.pop(last, None)
        elif isinstance(table, dict):
            table[last] = _plain(value)
        elif value is not None:  # the fault is without the value: a sweep gives many, and the fault is one
            faults.append(f"{key}: cannot be set, because {'.'.join(above)} is not a table")
    return raw, tuple(faults)


def _drop_inherited_heights(raw: dict[str, object], overrides: Mapping[str, object]) -> None:
    """A new height of the waves, of whatever kind (HEIGHTS), takes the place of the one that the file gives."""
    names = {key: key.split(".")[1] for key in overrides if str(key).startswith("waves.")}
    heights = {key: name for key, name in names.items() if name in HEIGHTS}
    if any(overrides[key] is not None for key in heights):
        inherited = set(HEIGHTS) - set(heights.values())
        for name in tuple(inherited):
            inherited.update(BESIDE.get(name, ()))
        raw["waves"] = {name: value for name, value in raw["waves"].items() if name not in inherited}
