"""`python -m engine.scene.reference`: every key of a scene as a page (docs/scene_keys.md), from the model itself.

    python -m engine.scene.reference > docs/scene_keys.md

Type, unit, default and what is allowed come from the model, the meaning and the place in the paper from
`scene_meanings`.
"""

import re
import sys
from typing import Annotated, Literal, get_args, get_origin

from pydantic import BaseModel
from pydantic_core import PydanticUndefined

from engine.scene.faults import allowed_text, section_models, shown
from engine.scene.meanings import MEANINGS
from engine.scene.models import Scene

HEAD = """# Keys of a scene

Made by `python -m engine.scene.reference > docs/scene_keys.md` from the model that checks scenes; a test fails where
this page is stale. A scene is a TOML file, or a shipped one with changes: `--set water.depth_m=22.5` on a command line,
`load_scene("tethered_buoy", {"water.depth_m": 22.5})` in Python. SI units; x with the waves, y across, z up from the
bed, the anchor at the origin. A section that may be left out is absent from the physics without it. Symbols and where
each equation lives: `NOTATION.md`.
"""
SECTIONS = {
    "": "The scene itself",
    "tether": "The line",
    "anchor": "The lower end",
    "end": "The upper end",
    "buoy": "The buoy",
    "water": "Still water",
    "waves": "Waves",
    "current": "Current",
    "motion": "Motion",
    "start": "Start",
    "solver": "Solver",
    "output": "Output",
}
UNITS = {
    "mps2": "m/s2", "kgpm3": "kg/m3", "Nm2": "N m2", "m2": "m2", "mps": "m/s",
    "m": "m", "kg": "kg", "s": "s", "rad": "rad", "N": "N",
}  # fmt: skip
KINDS = {str: "text", bool: "flag", int: "whole number", float: "number", tuple: "list"}


def page() -> str:
    """The page as Markdown."""
    rows: dict[str, list[str]] = {section: [] for section in SECTIONS}
    for key, field in leaves(Scene):
        top = key.partition(".")[0] if "." in key or key in SECTIONS else ""
        rows[top].append(_row(key, field))
    parts = [HEAD]
    for section, words in SECTIONS.items():
        title = f"## `{section}`: {words.lower()}" if section else f"## {words}"
        if section and not Scene.model_fields[section].is_required() and Scene.model_fields[section].default is None:
            title += " (may be left out)"
        head = "| key | type | unit | default | allowed | meaning | in the paper |\n|---|---|---|---|---|---|---|"
        parts.append("\n".join([title, "", head, *rows[section], ""]))
    return "\n".join(parts)


def leaves(model: type[BaseModel], prefix: str = "") -> list[tuple[str, object]]:
    """(key, field) of every key, each once: sections that are no table of their own by a law are entered only."""
    found: dict[str, object] = {}
    for name, field in model.model_fields.items():
        inner = section_models(field.annotation)
        if not inner or prefix + name in MEANINGS:
            found.setdefault(prefix + name, field)
        for part in inner:
            for key, below in leaves(part, f"{prefix}{name}."):
                found.setdefault(key, below)
    return list(found.items())


def _row(key: str, field) -> str:
    meaning, where = MEANINGS[key]
    cells = [f"`{key}`", _kind(field), _unit(key, _kind(field)), _default(field), _allowed(key, field), meaning, where]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def _bare(annotation):
    """The annotation without Annotated and without None."""
    while get_origin(annotation) is Annotated:
        annotation = get_args(annotation)[0]
    parts = [part for part in get_args(annotation) if part is not type(None)]
    if type(None) in get_args(annotation) and len(parts) == 1:
        return _bare(parts[0])
    return annotation


def _kind(field) -> str:
    bare = _bare(field.annotation)
    if section_models(bare):
        return "table"
    if get_origin(bare) is Literal:
        return KINDS[type(get_args(bare)[0])]
    if get_origin(bare) is tuple or "tuple" in str(bare):
        return "list"
    return KINDS[bare]


def _unit(key: str, kind: str) -> str:
    name = key.rpartition(".")[2]
    for suffix, unit in UNITS.items():
        if name.endswith(f"_{suffix}"):
            return unit
    return "1" if "number" in kind or kind == "list" else ""


def _default(field) -> str:
    if field.is_required():
        return "needed"
    if field.default is None or field.default is PydanticUndefined:
        return "none" if field.default is None else "derived"
    if isinstance(field.default, tuple):
        return f"`{list(field.default)}`"
    return f"`{shown(field.default)}`"


def _allowed(key: str, field) -> str:
    if key.endswith(".law"):  # one model for each law; the key is the same in all of them
        owner = Scene
        for part in key.split(".")[:-1]:
            models = section_models(owner.model_fields[part].annotation)
            owner = models[0]
        return ", ".join(f"`{get_args(model.model_fields['law'].annotation)[0]}`" for model in models)
    bare = _bare(field.annotation)
    if get_origin(bare) is Literal:
        return ", ".join(f"`{value}`" for value in get_args(bare))
    models = section_models(field.annotation)
    if len(models) > 1:
        return "one of the laws below"
    text = allowed_text(field.annotation, field.metadata) or ""
    return re.sub(r"^one of ", "", text)


def main() -> int:
    """Print the page."""
    sys.stdout.write(page())
    return 0


if __name__ == "__main__":
    sys.exit(main())
