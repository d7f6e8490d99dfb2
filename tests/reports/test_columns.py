"""Tables from a campaign's dictionary of columns: heads, units and places come from the folder alone."""

import math

import pytest

from reports.parts.columns import HEADER, table_of
from reports.parts.content import plain
from reports.parts.folder import FolderError, read_columns

DICTIONARY = """name,unit,symbol,meaning,digits
steepness,,kA,wave steepness,3
radius_min_m,m,r_min,"least distance, after the transient",2
growth,bits,σ,exponent,3
growth_error,bits,,its standard error,3
status,,,,
"""


@pytest.fixture
def columns(tmp_path):
    (tmp_path / "columns.csv").write_text(DICTIONARY, encoding="utf-8")
    return read_columns(tmp_path)


def test_heads_units_places_and_caption_come_from_the_dictionary(columns):
    rows = [
        {"steepness": 0.13, "radius_min_m": 19.876, "growth": -0.04, "growth_error": 0.002, "status": "ok"},
        {"steepness": 0.1, "radius_min_m": math.nan, "growth": 1e-9, "growth_error": None, "status": ""},
    ]
    names = ["steepness", "radius_min_m", ("growth", "growth_error"), "status"]
    table = table_of(columns, names, rows, "Two runs.", {"status": lambda row: row["status"].upper()})
    assert [plain(column.title) for column in table.columns] == ["kA", "rmin", "σ", "status"]
    assert [(column.unit, column.align) for column in table.columns[1::2]] == [("m", "right"), ("", "left")]
    assert table.rows == (
        ("0.130", "19.88", "−0.040\u00a0±\u00a00.002", "OK"),
        ("0.100", "–", "1e-9\u00a0±\u00a0–", ""),
    )
    said = "Two runs. kA: wave steepness; rmin: least distance, after the transient; σ: exponent."
    assert plain(table.caption) == said
    with pytest.raises(KeyError):
        table_of(columns, ["mass"], rows, "")


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (None, "older version"),
        ("name,unit\n", "first line"),
        (",".join(HEADER) + "\na,,,,two\n", "cannot be read"),
        (",".join(HEADER) + "\na,b\n", "cannot be read"),
    ],
)
def test_a_folder_without_a_sound_dictionary_is_refused(tmp_path, content, fault):
    if content is not None:
        (tmp_path / "columns.csv").write_text(content, encoding="utf-8")
    with pytest.raises(FolderError, match=fault):
        read_columns(tmp_path)
