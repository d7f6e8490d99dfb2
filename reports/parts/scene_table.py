"""The scene of a campaign as a table: every value with its unit, and who decided it."""

from __future__ import annotations

from .content import Column, Table
from .sources import SOURCES, unit_of
from .wording import number

_NOT_PARAMETERS = {"name", "title"}


def scene_table(scene, default, swept: dict[str, str], caption: str, sources: dict | None = None) -> Table:
    """Value, unit and source of every parameter.

    Args: `scene` as run; `default` the shipped scene of the same kind, whose values have the sources of `sources`, by
    default `reports.parts.sources`; `swept` maps the keys the campaign varied to the values in words. A value that
    differs from the default is marked "set by the user".
    """
    sources = SOURCES if sources is None else sources
    values, defaults = _flat(scene.as_dict()), _flat(default.as_dict())
    rows = []
    for key in [*values, *(key for key in swept if key not in values)]:
        if key in _NOT_PARAMETERS:
            continue
        meaning, source = sources.get(key, (key.rpartition(".")[2].replace("_", " "), ""))
        if key in swept:
            rows.append((f"`{key}`", meaning, swept[key], unit_of(key), "swept by this campaign"))
            continue
        if values[key] != defaults.get(key):
            before = f" (default {_shown(defaults[key])})" if key in defaults else ""
            source = f"set by the user{before}"
        rows.append((f"`{key}`", meaning, _shown(values[key]), unit_of(key), source or "default of this work"))
    columns = (
        Column("key", align="left"),
        Column("parameter", align="left"),
        Column("value"),
        Column("unit", align="left"),
        Column("source", align="left"),
    )
    return Table(columns, tuple(rows), caption, small=True)


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
