"""The stability report: statements follow the tables, pages need nothing else, a broken folder is refused."""

import json

import pytest

from campaigns.machinery.folder import write_table
from campaigns.stability import cases as judged
from campaigns.stability import fuzz
from reports import build
from reports.parts.folder import FolderError
from reports.stability.report import VERDICTS, read_study, unexplained_items

METHOD = {"re": [0.5, 1.5, 9.0], "im": [0.5, 0.0, 0.0], "largest": 9.0, "distance": 2e-7}
METHOD |= {"growing": 2, "growing_found": 2}
SHARE = {"us_per_newton": 5.0, "us_per_step": 20.0, "newton_per_step": 4.0}
OK = {"verdict": "ok", "run_status": "ok"}
LIMIT = {"verdict": "known limit", "run_status": "newton-failed", "limit": "ill-posed in slack"}
CASES = [
    {"group": "EI", "case": "soft", **OK, "measured": 1e-3, "bar": 0.02, "how": "refinement"},
    {"group": "EI", "case": "none", **LIMIT},
    {"group": "input", "case": "two nodes", "verdict": "refused", "run_status": "refused", "message": "nodes: 2"},
    {"group": "drift", "case": "1000 waves", **OK, "measured": 2e-9, "bar": 0.01, "wall_s": 3.0},
]
RANDOM = [
    {"kind": "valid", "number": 0, "outcome": "ok", "status": "ok", "message": "", "wall_s": 0.1},
    {"kind": "valid", "number": 1, "outcome": "ended", "status": "step-limit", "message": "why", "wall_s": 0.2},
    {"kind": "invalid", "number": 0, "outcome": "refused", "status": "", "message": "why", "wall_s": 0.01},
]


def folder(place, cases=CASES, random=RANDOM):
    place.mkdir()
    rows = [{"part": "case", "about": row["group"], "dimensions": 2, **row} for row in cases]
    write_table(place / "table.csv", judged.COLUMNS, rows)
    write_table(place / "fuzz.csv", fuzz.COLUMNS, [{"meaning": "as told", **row} for row in random])
    line = {"title": "taut", "step_s": 0.05, "methods": {"midpoint": METHOD}}
    shares = {"rounds": 3, "length_s": 1.0, "scenes": {"whole": SHARE, "dry": {**SHARE, "us_per_newton": 4.0}}}
    made_by = {"campaign": "stability", "quick": False, "command": ["python"]}
    for name, content in {"step_maps": {"taut": line}, "scene_shares": shares, "provenance": made_by}.items():
        (place / f"{name}.json").write_text(json.dumps(content))
    return place


def test_verdicts_and_faults_follow_the_tables(tmp_path):
    study = read_study(folder(tmp_path / "out"))
    assert [len(study.judged(word)) for word in VERDICTS] == [2, 1, 1, 0]
    assert study.unsound() == [] and unexplained_items(study)[0].kind == "note"


def test_what_is_unexplained_leads(tmp_path):
    lost = {"group": "EA", "case": "stiff", "verdict": "unexplained", "run_status": "hang", "message": "no answer"}
    crash = {"kind": "valid", "number": 7, "outcome": "crash", "status": "", "message": "exit code 11", "wall_s": 1.0}
    notice = unexplained_items(read_study(folder(tmp_path / "out", [*CASES, lost], [*RANDOM, crash])))[0]
    assert notice.kind == "warning" and len(notice.lines) == 2
    assert "stiff" in notice.lines[0] and "exit code 11" in notice.lines[1]


@pytest.mark.parametrize("random", [RANDOM, []])
def test_same_folder_same_bytes(tmp_path, random):
    place = folder(tmp_path / "out", random=random)
    first = [path.read_bytes() for path in build(place)]
    assert [path.read_bytes() for path in build(place)] == first
    assert first[0].count(b"<figure") == first[0].count(b"<figcaption") == 2


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
