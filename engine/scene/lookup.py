"""The sound values of a scene, for rules between values.

Rules read plain data, leaving out the values that are faulty in themselves: a model validator would be skipped as soon
as one field fails, and the user would see the faults one after the other.
"""

from collections.abc import Iterator

from engine.scene.faults import shown

FAULTY = object()


class Sound:
    """Reads the values that are sound by themselves; an absent one is None."""

    def __init__(self, raw: dict[str, object], bad: set[tuple[str | int, ...]]) -> None:
        self.raw, self.bad = raw, bad

    def has(self, section: str) -> bool:
        """Is the section there, sound or not?"""
        return self.raw.get(section) is not None

    def value(self, key: str) -> object:
        """The value of a dotted key: None if absent, FAULTY if it has a fault of its own."""
        path = tuple(key.split("."))
        if any(location[: len(path)] == path[: len(location)] for location in self.bad):
            return FAULTY
        at: object = self.raw
        for part in path:
            at = at.get(part) if isinstance(at, dict) else None
        return at

    def values(self, *keys: str) -> tuple | None:
        """The values of the keys, or None unless all are there and sound."""
        found = tuple(self.value(key) for key in keys)
        return None if any(item is None or item is FAULTY for item in found) else found


def not_increasing(key: str, series: tuple) -> Iterator[str]:
    """The first place, if any, where a series does not increase, as a fault line."""
    for index in range(1, len(series)):
        if not series[index] > series[index - 1]:
            given = f"given {shown(series[index])} after {shown(series[index - 1])}"
            yield f"{key}[{index}]: {given}; allowed: increasing values"
            return
