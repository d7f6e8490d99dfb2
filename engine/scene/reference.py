"""Every key of a scene in words: for docs/scene_keys.md and for the scene table of a report.

    python -m engine.scene.reference > docs/scene_keys.md

All of it comes from the declarations of the keys (`values.described`); where the value of a shipped scene comes from is
the comment beside that value in `engine/scenes/NAME.toml`.
"""

import re
import sys
import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

from engine.scene.faults import allowed_text, known_fields, law_names, section_models, shown
from engine.scene.load import shipped_text
from engine.scene.models import Scene

HEAD = """# Keys of a scene

The command `python -m engine.scene.reference > docs/scene_keys.md` makes this page from the model that checks scenes. A
test fails if the page is stale.

A scene is a TOML file, or a shipped scene with changes: `--set water.depth_m=22.5` on a command line,
`load_scene("tethered_buoy", {"water.depth_m": 22.5})` in Python. All units are SI. x points in the direction of the
waves, y across them, z up. Places are measured from the anchor, heights from the bed. If an optional section is left
out, its physics is left out of the run. Numbers are finite and at most 1e+30 in size; a number whose sign is restricted
is 0 or at least 1e-30 in size. The last column is the place in the paper; a number in brackets is an equation.
"""
ON_THE_PAGE = {  # what every number has in common is told once, above
    "a finite number above 0, 1e-30 to 1e+30": "> 0",
    "a finite number, 0 or above: 0, or 1e-30 to 1e+30": ">= 0",
    ", at most 1e+30 in size": "",
    "a finite number": "number",
    "finite number": "number",
    "a list of ": "",
    "a number from ": "",
    "a whole number from ": "whole, ",
}
SECTIONS = {
    "": "The scene itself",
    "tether": "The line",
    "anchor": "The lower end",
    "end": "The upper end",
    "buoy": "The buoy",
    "water": "Still water",
    "waves": "Waves",
    "floor": "The bed",
    "current": "Current",
    "motion": "Motion",
    "start": "Start",
    "solver": "Solver",
    "output": "Output",
}
UNITS = {
    "mps2": "m/s2", "kgpm3": "kg/m3", "Nm2": "N m2", "m2": "m2", "m2ps": "m2/s", "mps": "m/s", "Npm3": "N/m3",
    "Nspm3": "N s/m3", "Ns": "N s", "m": "m", "kg": "kg", "s": "s", "rad": "rad", "N": "N",
}  # fmt: skip
KINDS = {str: "text", bool: "flag", int: "whole number", float: "number", tuple: "list"}


@dataclass(frozen=True)
class Key:
    """One key of a scene. kind: of its value, in a word; default, allowed: in words; the others as declared."""

    name: str
    kind: str
    unit: str
    default: str
    allowed: str
    meaning: str
    symbol: str
    paper: str


@cache
def keys() -> dict[str, Key]:
    """Every key of a scene by its dotted name, in the order of the models."""
    fields = known_fields(Scene)
    return {name: _key(name, field, fields) for name, field in fields.items() if field.description}


@cache
def sources(scene: str) -> dict[str, str]:
    """Where each value of a shipped scene comes from: the comments beside the values in its file, by dotted key."""
    origins, table = {}, ""
    for line in shipped_text(scene).splitlines():
        if header := re.match(r"\[([\w.]+)\]", line):
            table = f"{header[1]}."
        elif (value := re.match(r"(\w+) *= *(.*?) +# *(.+)", line)) is not None:
            parsed = tomllib.loads(f"value = {value[2]}")["value"]
            inner = [f".{part}" for part in parsed] if isinstance(parsed, dict) else [""]
            origins |= {f"{table}{value[1]}{part}": value[3] for part in inner}
    return origins


def page() -> str:
    """The page as Markdown."""
    rows: dict[str, list[str]] = {section: [] for section in SECTIONS}
    for key in keys().values():
        top = key.name.partition(".")[0] if "." in key.name or key.name in SECTIONS else ""
        allowed = key.allowed
        for words, short in ON_THE_PAGE.items():
            allowed = allowed.replace(words, short)
        cells = (f"`{key.name}`", key.unit, key.default, allowed, key.meaning, key.symbol, key.paper)
        rows[top].append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    parts = [HEAD]
    for section, words in SECTIONS.items():
        title = f"## `{section}`: {words.lower()}" if section else f"## {words}"
        if section and not Scene.model_fields[section].is_required() and Scene.model_fields[section].default is None:
            title += " (may be left out)"
        head = "| key | unit | default | allowed | meaning | symbol | paper |\n|" + 7 * "---|"
        parts.append("\n".join([title, "", head, *rows[section], ""]))
    return "\n".join(parts)


def _key(name: str, field: FieldInfo, fields: dict[str, FieldInfo]) -> Key:
    bare, models = _bare(field.annotation), section_models(field.annotation)
    choices = get_args(bare) if get_origin(bare) is Literal else []
    if name.endswith(".law"):  # one model for each law; the key is the same in all of them
        choices = law_names(section_models(fields[name.rpartition(".")[0]].annotation))
    kind = "table" if models else KINDS[type(choices[0]) if choices else tuple if "tuple" in str(bare) else bare]
    suffix = re.search(f"_({'|'.join(UNITS)})$", name)
    unit = UNITS[suffix[1]] if suffix else "1" if "number" in kind or kind == "list" else ""
    allowed = ", ".join(f"`{choice}`" for choice in choices) or allowed_text(field.annotation, field.metadata) or ""
    allowed = "one of the laws below" if len(models) > 1 else allowed
    return Key(name, kind, unit, _default(field), allowed, field.description, **field.json_schema_extra)


def _bare(annotation):
    """The annotation without Annotated and without None."""
    parts = [part for part in get_args(annotation) if part is not type(None)]
    optional = type(None) in get_args(annotation) and len(parts) == 1
    return _bare(parts[0]) if optional or get_origin(annotation) is Annotated else annotation


def _default(field: FieldInfo) -> str:
    if field.is_required() or field.default_factory is not None:
        return "needed" if field.is_required() else "derived"
    if field.default is None:
        return "none"
    return f"`{shown(list(field.default) if isinstance(field.default, tuple) else field.default)}`"


if __name__ == "__main__":
    sys.stdout.write(page())
