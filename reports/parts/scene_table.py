"""The scene of a campaign as a table: every value with its unit, and where it comes from."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .content import Column, Table, with_subscripts
from .wording import EMPTY, number

if TYPE_CHECKING:
    from engine import Scene

_NOT_PARAMETERS = {"name", "title"}
_OURS = "default of this work"


def scene_table(scene: Scene, shipped: str, varied: dict[str, str], caption: str) -> Table:
    """Value, unit and source of every parameter of a scene.

    scene: as run. shipped: name of the shipped scene of the same kind; the source of its values is the comment beside
    them in its file, and a value that differs is marked "set by the user". varied: the keys that the campaign varied,
    with their values in words.
    """
    from engine import load_scene
    from engine.scene.reference import keys, sources

    told, known = sources(shipped), keys()
    values, defaults = _flat(scene.as_dict()), _flat(load_scene(shipped).as_dict())
    rows = []
    for name in [*values, *(name for name in varied if name not in values)]:
        if name in _NOT_PARAMETERS:
            continue
        key = known[name]
        if name in varied:
            shown, source = varied[name], "varied by this campaign"
        else:
            shown, source = _shown(values[name]), told.get(name, _OURS)
            if values[name] != defaults.get(name):
                source = "set by the user" + (f" (default {_shown(defaults[name])})" if name in defaults else "")
        meaning = key.meaning + (f", {key.symbol}" if key.symbol else "")
        unit = key.unit if key.unit not in ("", "1") else EMPTY
        rows.append((f"`{name}`", with_subscripts(meaning), shown, unit, with_subscripts(source)))
    left = {"align": "left"}
    heads = (Column("key", **left), Column("parameter", **left), Column("value"), Column("unit", **left))
    where = "Table, section, figure and eq. are those of Tjavaras et al. (1998)."
    return Table((*heads, Column("source", **left)), tuple(rows), f"{caption} {where}", small=True)


def _flat(section: dict, prefix: str = "") -> dict[str, object]:
    """Nested sections as dotted keys, in the order of the scene."""
    flat: dict[str, object] = {}
    for key, entry in section.items():
        if isinstance(entry, dict):
            flat.update(_flat(entry, f"{prefix}{key}."))
        else:
            flat[prefix + key] = entry
    return flat


def _shown(entry: object) -> str:
    """A value in print; a long list by its length and ends."""
    if isinstance(entry, bool):
        return "yes" if entry else "no"
    if isinstance(entry, (int, float)):
        return number(float(entry), 6)
    if isinstance(entry, (list, tuple)):
        if len(entry) > 6 or any(isinstance(item, (list, tuple)) for item in entry):
            return f"{len(entry)} entries"
        return "[" + ", ".join(_shown(item) for item in entry) + "]"
    return str(entry)
