"""A key of a scene that a sweep varies: any number of it, a whole number, or one element of a list."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce

from campaigns.columns import Column
from campaigns.machinery import cli
from engine.scene.faults import suggestion
from engine.scene.reference import keys

KINDS = ("number", "whole number")


@dataclass(frozen=True)
class Varied:
    """A key with its values, and the column of the table that holds them. index: of the list's element, None: a number.

    key: as on the command line, "water.depth_m" or "start.buoy_velocity_mps[1]".
    """

    key: str
    name: str
    index: int | None
    values: tuple
    column: Column

    def put(self, value: float, base, changes: dict[str, object]) -> Iterator[str]:
        """Put a value into the changes of a scene; yields the fault of a list that has no such element.

        base: the scene whose list it is; two keys may change two elements of one list.
        """
        if self.index is None:
            changes[self.name] = value
            return
        whole = changes.get(self.name)
        if whole is None:
            whole = reduce(lambda part, name: getattr(part, name, None), self.name.split("."), base)
        if not isinstance(whole, list | tuple) or self.index >= len(whole):
            yield f"--vary {self.key}: the scene has no such element; {self.name} is {whole}"
            return
        changes[self.name] = [*whole[: self.index], value, *whole[self.index + 1 :]]


def varied(words: list[str], faults: list[str]) -> Varied | None:
    """The key and values of KEY LO HI COUNT; None where one is at fault."""
    key = words[0]
    element = re.fullmatch(r"(.+)\[(\d+)\]", key)
    name, index = (element[1], int(element[2])) if element else (key, None)
    known = keys()
    values = cli.evenly(words[1:], f"--vary {key}", faults)
    if name not in known:
        faults.append(f"--vary {key}: no such key{suggestion(name, list(known))}")
        return None
    kind = known[name].kind
    if kind not in KINDS and not (kind == "list" and element):
        a_list = f"one element of it, as {name}[0]" if kind == "list" else "a key that holds a number"
        faults.append(f"--vary {key}: holds a {kind}; allowed: {a_list}")
        return None
    if kind == "whole number":
        values = list(dict.fromkeys(round(value) for value in values))
    return Varied(key, name, index, tuple(values), _column(key, known[name], values)) if values else None


def _column(key: str, declared, values: list) -> Column:
    unit = "" if declared.unit == "1" else declared.unit
    symbol = declared.symbol if declared.symbol not in ("", "-", "–") else key.rpartition(".")[2]
    digits = max((len(f"{value:.6f}".rstrip("0").partition(".")[2]) for value in values), default=0)
    meaning = declared.meaning[:1].lower() + declared.meaning[1:].rstrip(".")
    return Column(key, unit, symbol, meaning, digits)
