"""How a campaign was made: its scene, each value with its source; where its time went; all of provenance.json."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from tables import EMPTY, decimals, number

from .content import Heading, Item, Items, Listing, Notice, Report, Table, Text, flat, heads, with_subscripts
from .folder import Folder

if TYPE_CHECKING:
    from engine import Scene

APPENDIX = "Appendix: how this was made"
_TIMES = {
    "compile_s": "compiling the kernels",
    "run_s": "runs with their analysis",
    "analysis_s": "analysis, the times of all workers added up",
    "report_s": "report",
}


def scene_items(scene: Scene, shipped: str, varied: dict[str, str], caption: str = "") -> Items:
    """The section with `scene_table`; caption: "" for that of a scene whose defaults are the shipped one's."""
    usual = f"The scene as run, from `scene.toml`; defaults are those of the scene `{shipped}`."
    return [Heading("Scene"), scene_table(scene, shipped, varied, caption or usual)]


def scene_table(scene: Scene, shipped: str, varied: dict[str, str], caption: str) -> Table:
    """Value, unit and source of every parameter of a scene.

    scene: as run. shipped: name of the shipped scene of the same kind; the source of its values is the comment beside
    them in its file, and a value that differs is marked "set by the user", as all values of another file are. varied:
    the keys that the campaign varied, with their values in words.
    """
    from engine import list_scenes, load_scene
    from engine.scene.reference import keys, sources

    default_sources, defaults = {}, {}
    if shipped in list_scenes():
        default_sources = sources(shipped)
        defaults = dict(_flat(load_scene(shipped).as_dict()))
    known, values = keys(), dict(_flat(scene.as_dict()))
    varied_keys = set(map(_key, varied))
    rows = []
    for name in dict.fromkeys([*values, *varied]):
        if name in ("name", "title") or _key(name) not in known:  # a campaign may vary what is no key of a scene
            continue
        key = known[_key(name)]
        if _key(name) in varied_keys:
            source = "varied by this campaign"
        elif values[name] == defaults.get(name):
            source = default_sources.get(name, "default of this work")
        elif name in defaults:
            source = f"set by the user (default {_shown(defaults[name])})"
        else:
            source = "set by the user"
        meaning, unit = key.meaning, key.unit
        if key.symbol:
            meaning += f", {key.symbol}"
        if unit in ("", "1"):
            unit = EMPTY
        shown = varied.get(name) or _shown(values[name])
        rows.append((f"`{name}`", with_subscripts(meaning), shown, unit, with_subscripts(source)))
    columns = heads("key", "parameter", ("value", ""), "unit", "source")
    origin = "Table, section, figure and eq. are those of Tjavaras et al. (1998)."
    return Table(columns, rows, f"{caption} {origin}")


def _key(name: str) -> str:
    """The key of a scene that a name such as "start.buoy_velocity_mps[0]", of an element of a list, stands for."""
    return re.sub(r"\[\d+\]", "", name)


def timing_items(folder: Folder, *costs: Item | None) -> Items:
    """What the runs cost: `costs`, where there are any, and the time split of a campaign; nothing for none of them."""
    items, rows = flat(costs), []
    for name, time in _flat(folder.provenance.get("timing")):
        if isinstance(time, (int, float)):
            part = _TIMES.get(name, name.removesuffix("_s").replace("_", " "))
            rows.append((part, decimals(time, 2)))
    if rows:
        caption = "Where the time of the campaign went, from `provenance.json`."
        items.append(Table(heads("part", ("wall time", "s")), rows, caption, small=False))
    if not items:
        return []
    return [Heading("Run times"), *items]


def provenance_items(folder: Folder) -> Items:
    """The command and everything else that provenance.json holds."""
    yield Heading("Provenance")
    entries = dict(folder.provenance)
    entries.pop("timing", None)
    command = entries.pop("command", None)
    if command:
        if isinstance(command, list):
            command = shlex.join(map(str, command))
        yield Text("The command:")
        yield Listing(str(command))
    rows = []
    for key, entry in _flat(entries):
        rows.append((f"`{key}`", _shown(entry)))
    if rows:
        caption = "All of `provenance.json` but the command and the times."
        yield Table(heads("entry", "value"), rows, caption)


def report_page(folder: Folder, title: str, items: Items, made: Items | None = None, subtitle: str = "") -> Report:
    """A report: its items, and how it was made in an appendix that ends with the provenance.

    made: of the appendix, in front of the provenance; None: run times and scene. subtitle: "" for the title of the
    scene and its water.
    """
    if made is None:
        scene = folder.scene
        made = [timing_items(folder), scene_items(scene, str(folder.provenance.get("scene") or scene.name), {})]
    appendix = []
    for item in flat([made, provenance_items(folder)]):
        if isinstance(item, Heading):
            item = Heading(item.text, 2)  # it divides the appendix
        appendix.append(item)
    subtitle = subtitle or "; ".join([folder.scene.title or folder.scene.name, *_water_of(folder)])
    return Report(title, subtitle, [*flat(items), Heading(APPENDIX), *appendix])


def _water_of(folder: Folder) -> Iterator[str]:
    """Wave period, depth and a uniform current of the scene, in words, but for keys that the campaign varied."""
    scene, varied = folder.scene, folder.columns
    if scene.waves is not None and "waves.period_s" not in varied:
        peak = " at the peak of the spectrum" if scene.waves.irregular else ""
        yield f"waves of {scene.waves.period_s:g} s{peak}"
    if scene.water is not None and "water.depth_m" not in varied:
        yield f"{scene.water.depth_m:g} m of water"
    varies = any(name.startswith("current.") for name in varied)
    if scene.current is not None and scene.current.law == "uniform" and not varies:
        speed_mps = math.hypot(*scene.current.velocity_mps)
        yield f"a current of {speed_mps:.3g} m/s"


def limits(title: str, lines: Iterable[str], nothing: str) -> Notice:
    """The warnings of a report in a box, or a note that says there are none."""
    lines = list(lines)
    if not lines:
        return Notice("note", "Nothing to warn of", (nothing,))
    return Notice("warning", title, lines)


def _flat(section: object, prefix: str = "") -> Iterator[tuple[str, object]]:
    """(dotted key, entry) of nested sections, in their order; nothing where there is no section."""
    if not isinstance(section, dict):
        return
    for key, entry in section.items():
        if isinstance(entry, dict):
            yield from _flat(entry, f"{prefix}{key}.")
        else:
            yield prefix + key, entry


def _shown(entry: object) -> str:
    """An entry in print; a long list by its ends and its length."""
    if isinstance(entry, bool):
        return "yes" if entry else "no"
    if isinstance(entry, float):
        return number(entry, 6)
    if isinstance(entry, (list, tuple)):
        if any(isinstance(item, (list, tuple, dict)) for item in entry):
            return f"{len(entry)} entries"
        words = list(map(_shown, entry))
        if len(words) > 6:
            return f"{words[0]}, {words[1]}, …, {words[-1]} ({len(words)} entries)"
        return f"[{', '.join(words)}]"
    return EMPTY if entry in (None, "") else str(entry)
