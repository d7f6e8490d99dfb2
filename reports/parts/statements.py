"""A statement put to the test: what is claimed, where it was looked, what was found, and the verdict that follows.

The verdict is computed from the checks and cannot be written: "holds" where every check passes, "does not hold" where
none does, "holds if" between, with the places where it does and where it does not; a dash where nothing was checked.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from .wording import EMPTY, listed

HOLDS, HOLDS_IF, FAILS = "holds", "holds if", "does not hold"


@dataclass(frozen=True)
class Statement:
    """One statement.

    claim      what is said, in a sentence
    found      what the runs say to it, with its numbers
    checks     (where, whether it holds there), one for every place at which it was looked
    threshold  what decides a check, in words and numbers
    """

    claim: str
    found: str
    checks: tuple[tuple[str, bool], ...]
    threshold: str = ""

    @property
    def verdict(self) -> str:
        """HOLDS, HOLDS_IF, FAILS, or a dash."""
        passed = [holds for _, holds in self.checks]
        return EMPTY if not passed else HOLDS if all(passed) else HOLDS_IF if any(passed) else FAILS

    @property
    def condition(self) -> str:
        """Of "holds if": where it holds, and where not; else nothing."""
        if self.verdict != HOLDS_IF:
            return ""
        sides = (grouped([where for where, holds in self.checks if holds is wanted]) for wanted in (True, False))
        return "{}; not {}".format(*sides)

    @property
    def said(self) -> str:
        """Verdict and condition."""
        return f"{self.verdict}: {self.condition}" if self.condition else self.verdict


def grouped(places: list[str]) -> str:
    """The places in a list; what some share around one number is said once.

    >>> grouped(["H = 21 m", "H = 22 m", "H = 22 m with a cap"]), grouped(["r", "theta"])
    ('H = 21 and 22 m, and H = 22 m with a cap', 'r and theta')
    """
    groups: dict[tuple[str, str], list[str]] = {}
    for place in places:
        part = re.fullmatch(r"(\D*)(\d\S*)(.*)", place)
        around, number = ((part[1], part[3]), part[2]) if part else ((place, ""), "")
        groups.setdefault(around, []).append(number)
    said = [f"{before}{listed(numbers)}{after}" for (before, after), numbers in groups.items()]
    return ", and ".join(said) if len(said) == 2 and any(" and " in one for one in said) else listed(said)
