"""The values of a scene as its rules read them: those without a fault of their own.

Rules read plain data and leave out the values that are faulty in themselves: a model validator would be skipped as soon
as one field fails, and the user would see the faults one after the other.
"""

from collections.abc import Iterator
from itertools import pairwise

from pydantic import BaseModel
from pydantic_core import PydanticUndefined

from engine.scene.faults import Location, fault, known_fields, shown

Facts = Iterator[tuple[object, str, str]]  # whether a rule is broken, the key that breaks it, what it allows there


class _Faulty:
    """A value with a fault of its own: false, and equal to nothing, so that no rule holds of it."""

    def __bool__(self) -> bool:
        return False


FAULTY = _Faulty()


class Sound:
    """The values of a scene by dotted key; an absent one is its default, or None, a faulty one FAULTY.

    raw: the scene as nested dicts (TOML or model_dump). bad: locations of values that are faulty in themselves. model:
    of a scene, for the defaults.
    """

    def __init__(self, raw: dict[str, object], bad: set[Location], model: type[BaseModel]) -> None:
        self.raw, self.bad, self.fields = raw, bad, known_fields(model)

    def __getitem__(self, key: str) -> object:
        path = tuple(key.split("."))
        faulty = any(location[: len(path)] == path[: len(location)] for location in self.bad)
        return FAULTY if faulty else self._value(path)

    def _value(self, path: tuple[str, ...]) -> object:
        above = self._value(path[:-1]) if path[1:] else self.raw
        value = above.get(path[-1]) if isinstance(above, dict) else getattr(above, path[-1], None)
        if value is None and isinstance(above, dict):
            value = self.fields[".".join(path)].default
        return None if value is PydanticUndefined else value

    def fault(self, key: str, allowed: str) -> str:
        """The fault line of a key that breaks a rule."""
        value = self._value(tuple(key.split(".")))
        return f"{key}: missing; allowed: {allowed}" if value is None else fault(key, value, allowed)

    def increasing(self, key: str, allowed: str = "increasing values", may_stay: bool = False) -> Iterator[str]:
        """The first place, if any, where a series does not increase, as a fault line."""
        for index, (earlier, later) in enumerate(pairwise(self[key] or ()), 1):
            if later < earlier or (later == earlier and not may_stay):
                yield f"{key}[{index}]: given {shown(later)} after {shown(earlier)}; allowed: {allowed}"
                return

    def paired(self, key: str, partner: str) -> Iterator[str]:
        """The fault line of a list that is not as long as another."""
        values, partners = self[key], self[partner]
        if values and partners and len(values) != len(partners):
            yield f"{key}: given {len(values)} values; allowed: one for each of {partner}, {len(partners)}"
