"""TOML text of plain nested data: the standard library reads TOML but does not write it."""

import json
import re

_BARE_KEY = re.compile(r"^[A-Za-z0-9_-]+$")


def toml_text(data: dict[str, object]) -> str:
    """TOML of nested dicts whose leaves are str, bool, int, finite float or (nested) lists of these.

    Reading the text with `tomllib.loads` gives equal data: floats are written with the digits that identify them.
    A dict inside a list is written inline. Raises TypeError for anything else.
    """
    return "\n".join(_table_lines(data, ())) + "\n"


def _table_lines(table: dict[str, object], path: tuple[str, ...]) -> list[str]:
    lines = [f"{_key(name)} = {_value(value)}" for name, value in table.items() if not isinstance(value, dict)]
    for name, value in table.items():
        if isinstance(value, dict):
            inner = (*path, name)
            lines += ["", f"[{'.'.join(map(_key, inner))}]", *_table_lines(value, inner)]
    return lines


def _key(name: str) -> str:
    return name if _BARE_KEY.match(name) else _string(name)


def _string(text: str) -> str:
    # A TOML basic string is a JSON string in which DEL must be escaped as well.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: object) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(name)} = {_value(item)}" for name, item in value.items()) + "}"
    raise TypeError(f"no TOML for a {type(value).__name__}: {value!r}")
