"""The answer of a sweep has the numbers of the rows of its tables, and is short whatever was run."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from campaigns.explore.answer import sentences
from campaigns.machinery.session import MOST_LINES
from engine import load_scene
from engine.natural_frequencies import natural_frequencies

ANSWERS = tomllib.loads(Path(__file__).with_name("answers.toml").read_text(encoding="utf-8"))
USUAL = ANSWERS.pop("usual")


def known(rows, usual):
    """Rows with their usual entries; what is none is None, as in a table."""
    entries_of_rows = []
    for row in rows:
        entries = usual | row
        for name, entry in entries.items():
            if entry == "none":
                entries[name] = None
        entries_of_rows.append(entries)
    return entries_of_rows


def answer(rows=(), companions=(), ends=()) -> dict[str, str]:
    """The lines by the word that each begins with."""
    tables = (
        known(rows, USUAL),
        "steepness",
        "kA",
        load_scene("tethered_buoy"),
        known(companions, USUAL),
        known(ends, {}),
    )
    return dict(line.split(maxsplit=1) for line in sentences(*tables))


@pytest.mark.parametrize("name", ANSWERS)
def test_an_answer_has_the_numbers_of_the_rows(name):
    tables = dict(ANSWERS[name])
    words = tables.pop("words")
    lines = answer(**tables)
    for head, phrases in words.items():
        assert all(phrase in lines[head] for phrase in phrases), lines[head]


def test_lines_come_in_the_order_of_their_use_and_the_load_is_told_beside_the_static_one():
    lines = answer(ANSWERS["from rest"]["rows"])
    assert list(lines) == ["LOAD", "JUMP", "MOTIONS", "STARTS", "CHAOS", "OPEN"], (
        "no line on snaps, which no row counts"
    )
    times = 9100.0 / natural_frequencies(load_scene("tethered_buoy")).static_tension_N
    assert f"9.1 kN, {times:.1f} times static" in lines["LOAD"]


@pytest.mark.parametrize("count", [0, 1, 2, 40])
def test_an_answer_is_short_whatever_was_run(count):
    regimes = ["period-1", "period-12", "quasi-periodic", "chaotic", "transient", "undecided", ""]
    rng, rows = np.random.default_rng(count), []
    for n in range(count):
        row = {"steepness": 0.01 * n, "regime": rng.choice(regimes), "loop_releases": n % 2}
        rows.append(row | {"tension_top_max_N": float(10 ** rng.uniform(3.0, 5.0))})
    lines = sentences(known(rows, USUAL), "steepness", "kA", load_scene("tethered_buoy"))
    assert 1 <= len(lines) <= MOST_LINES and all(len(line) < 700 and "nan" not in line for line in lines)
