"""The sound values of a scene, for rules between values (`engine.scene.rules`)."""

from collections.abc import Iterator
from itertools import pairwise

from pydantic import BaseModel
from pydantic_core import PydanticUndefined

from engine.scene.faults import fault, known_fields, shown


class _Faulty:
    """A value with a fault of its own: false, and equal to nothing, so that no rule holds of it."""

    def __bool__(self) -> bool:
        return False


FAULTY = _Faulty()


class Sound:
    """The values of a scene by dotted key; an absent one is its default, or None, a faulty one FAULTY."""

    def __init__(self, raw: dict[str, object], bad: set[tuple[str | int, ...]], model: type[BaseModel]) -> None:
        self.raw, self.bad, self.fields = raw, bad, known_fields(model)

    def __getitem__(self, key: str) -> object:
        path = tuple(key.split("."))
        faulty = any(location[: len(path)] == path[: len(location)] for location in self.bad)
        return FAULTY if faulty else self._given(path)

    def _given(self, path: tuple[str, ...]) -> object:
        above = self._given(path[:-1]) if path[1:] else self.raw
        value = above.get(path[-1]) if isinstance(above, dict) else getattr(above, path[-1], None)
        if value is None and isinstance(above, dict):
            value = self.fields[".".join(path)].default
        return None if value is PydanticUndefined else value

    def fault(self, key: str, allowed: str) -> str:
        """The fault line of a key that breaks a rule."""
        value = self._given(tuple(key.split(".")))
        return f"{key}: missing; allowed: {allowed}" if value is None else fault(key, value, allowed)

    def increasing(self, key: str, allowed: str = "increasing values", may_stay: bool = False) -> Iterator[str]:
        """The first place, if any, where a series does not increase, as a fault line."""
        for index, (before, after) in enumerate(pairwise(self[key] or ()), 1):
            if after < before or (after == before and not may_stay):
                yield f"{key}[{index}]: given {shown(after)} after {shown(before)}; allowed: {allowed}"
                return

    def paired(self, key: str, other: str) -> Iterator[str]:
        """The fault line of a list that is not as long as another."""
        values, others = self[key], self[other]
        if values and others and len(values) != len(others):
            yield f"{key}: given {len(values)} values; allowed: one for each of {other}, {len(others)}"
