"""The stability report: statements follow the tables, pages need nothing else, a broken folder is refused."""

import csv
import json
import re

import pytest

from campaigns.columns import names
from campaigns.stability.run import COLUMNS
from campaigns.stability.tasks import FUZZ_COLUMNS
from reports import build
from reports.parts.folder import FolderError

METHOD = {
    "re": [0.5, 1.5, 9.0],
    "im": [0.5, 0.0, 0.0],
    "largest": 9.0,
    "distance": 2e-7,
    "growing": 2,
    "growing_found": 2,
}
SHARE = {
    "newton": 1000,
    "functions": 3,
    "output": 50,
    "kernels": ["sweep_bent"],
    "us_per_newton": 5.0,
    "us_per_step": 20.0,
}
CASES = [
    {
        "group": "EI",
        "case": "soft",
        "verdict": "ok",
        "run_status": "ok",
        "measured": 1e-3,
        "bar": 0.02,
        "how": "refinement",
    },
    {
        "group": "EI",
        "case": "none",
        "verdict": "known limit",
        "run_status": "newton-failed",
        "limit": "ill-posed in slack",
    },
    {
        "group": "input",
        "case": "two nodes",
        "verdict": "refused",
        "run_status": "refused",
        "message": "faulty scene: nodes: 2",
    },
    {
        "group": "drift",
        "case": "1000 waves",
        "verdict": "ok",
        "run_status": "ok",
        "measured": 2e-9,
        "bar": 0.01,
        "wall_s": 3.0,
    },
]
RANDOM = [
    {"kind": "valid", "number": 0, "outcome": "ok", "status": "ok", "message": "", "wall_s": 0.1},
    {"kind": "valid", "number": 1, "outcome": "ended", "status": "step-limit", "message": "why", "wall_s": 0.2},
    {"kind": "invalid", "number": 0, "outcome": "refused", "status": "", "message": "why", "wall_s": 0.01},
]


def folder(place, cases=CASES, random=RANDOM):
    place.mkdir()
    for name, columns, rows in (
        ("table.csv", names(COLUMNS), [{"part": "case", "dimensions": 2, **row} for row in cases]),
        ("fuzz.csv", names(FUZZ_COLUMNS), random),
    ):
        with open(place / name, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, columns)
            writer.writeheader()
            writer.writerows(rows)
    line = {"title": "taut", "step_s": 0.05, "methods": {"midpoint": METHOD}}
    (place / "step_maps.json").write_text(json.dumps({"taut": line, "lost": {"fault": "its worker process ended"}}))
    scenes = {"whole": SHARE, "dry": {**SHARE, "newton": 400, "us_per_newton": 4.0, "kernels": ["sweep_unbent"]}}
    (place / "scene_shares.json").write_text(json.dumps({"rounds": 3, "length_s": 1.0, "scenes": scenes}))
    (place / "provenance.json").write_text(json.dumps({"campaign": "stability", "quick": False, "command": ["python"]}))
    return place


def text_of(place):
    html, _ = build(place)
    page = re.sub(r"base64,[A-Za-z0-9+/=]+", "", html.read_text(encoding="utf-8"))
    return " ".join(re.sub(r"<[^>]+>", " ", page).split())


def test_the_statements_follow_the_tables(tmp_path):
    text = text_of(folder(tmp_path / "out"))
    assert "4 cases: 2 ok, 1 refused and 1 known limit." in text
    assert "2 random valid and 1 random invalid scenes: none hung" in text
    assert "Nothing unexplained" in text
    assert "Ill-posed in slack. Seen in: none (newton-failed)." in text
    assert "nodes: 2" in text and "faulty scene" not in text
    assert "moves by 2e-9 of its range" in text
    assert "400 to 1000 floating-point operations" in text
    assert "within 2e-07, for every method" in text
    assert "A line could not be judged: its worker process ended" in text


def test_what_is_unexplained_leads(tmp_path):
    lost = {"group": "EA", "case": "stiff", "verdict": "unexplained", "run_status": "hang", "message": "no answer"}
    crash = {"kind": "valid", "number": 7, "outcome": "crash", "status": "", "message": "exit code 11", "wall_s": 1.0}
    text = text_of(folder(tmp_path / "out", [*CASES, lost], [*RANDOM, crash]))
    assert "1 unexplained" in text and "EA, stiff: hang no answer" in text
    assert "1 fault of the program" in text and "random valid scene 7: crash, exit code 11" in text
    assert "Nothing unexplained" not in text


def test_without_random_scenes_that_is_said(tmp_path):
    assert "None were asked for" in text_of(folder(tmp_path / "out", random=[]))


def test_same_folder_same_bytes_and_nothing_from_outside(tmp_path):
    place = folder(tmp_path / "out")
    first = [path.read_bytes() for path in build(place)]
    assert [path.read_bytes() for path in build(place)] == first
    page = re.sub(r"base64,[A-Za-z0-9+/=]+", "", first[0].decode())
    assert "http" not in page and "<script" not in page
    assert page.count("<figure") == page.count("<figcaption") == page.count("alt=")


@pytest.mark.parametrize("name", ["table.csv", "fuzz.csv", "step_maps.json", "scene_shares.json"])
def test_a_broken_folder_is_refused(tmp_path, name):
    place = folder(tmp_path / "out")
    (place / name).unlink()
    with pytest.raises(FolderError, match=name):
        build(place)
    if name != "fuzz.csv":
        (place / name).write_text("{")
        with pytest.raises(FolderError, match=name):
            build(place)
