"""The cases of `campaigns.stability`, read from cases.toml: what is run, how it is judged, how it may end."""

import copy
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

REFUSED, ABOVE_BAR = "refused", "above bar"


@dataclass(frozen=True)
class Ending:
    """An expected ending besides "ok" with the check below its bar, and why it is expected.

    statuses: of runs that end early; REFUSED for a scene that the engine does not accept; ABOVE_BAR for a check that
    may fail.
    """

    statuses: tuple[str, ...] = ()
    why: str = ""


@dataclass(frozen=True)
class Case:
    """One row of the table.

    changes: keys of the scene; check: a function of `campaigns.stability.checks`; bar: what the number that it measures
    must stay below; ending: what else is expected; quick: whether the case is also part of `--quick`.
    """

    group: str
    name: str
    changes: dict
    length_s: float = 10.0
    check: str = "refined"
    bar: float = 0.02
    ending: Ending = Ending()
    quick: bool = False
    options: dict = field(default_factory=dict)


@cache
def _file() -> dict:
    return tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


def regular() -> dict:
    """Changes that give the regular motion of the buoy."""
    return dict(_file()["sets"]["regular"])


def all_cases() -> list[Case]:
    """Every case, in the order of the report."""
    return [case for group, rows in _file()["cases"].items() for row in rows for case in _cases(group, row)]


def _cases(group: str, row: dict) -> Iterator[Case]:
    """The cases of a row of cases.toml: one, or one for each place in the lists of `vary`."""
    row = copy.deepcopy(row)
    fixed = {key: value for name in row.pop("sets", ()) for key, value in _file()["sets"][name].items()}
    fixed |= row.pop("changes", {})
    if "ending" in row:
        ending = _file()["endings"][row["ending"]]
        row["ending"] = Ending(tuple(ending["statuses"]), ending["why"])
    varied, quick, length_s = (row.pop(name, None) for name in ("vary", "quick", "length_s"))
    name = row.pop("name")
    for place, values in enumerate(zip(*varied.values(), strict=True) if varied else [()]):
        changes = fixed | dict(zip(varied or (), values, strict=True))
        changes = {key: None if value == "none" else value for key, value in changes.items()}
        length = {} if length_s is None else {"length_s": length_s[place] if isinstance(length_s, list) else length_s}
        chosen = quick is True or (quick is not None and place in quick)
        yield Case(group, name.format(*values), changes, **length, **row, quick=chosen)
