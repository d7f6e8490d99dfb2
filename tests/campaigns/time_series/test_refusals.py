"""What no answer can be given about is refused with every fault and what is allowed; nothing is written."""

import numpy as np
import pytest

from campaigns.time_series import WRITTEN, answer, main
from campaigns.time_series.record import read_table

ROWS = [f"{0.1 * k:.3f},{np.sin(k):.6f}" for k in range(300)]


def changed(row, text):
    return "\n".join(["t,x", *ROWS[:row], text, *ROWS[row + 1 :]])


FILES = {
    "nan.csv": changed(7, "0.700,nan"),
    "gap.csv": changed(7, "0.700,"),
    "word.csv": changed(7, "0.700,broken"),
    "comma.csv": changed(7, "0.700,1,5"),
    "semicolon.csv": changed(7, "0.700;1,5").replace(".000,", ".000;").replace(",", ";", 1),
    "jump.csv": "\n".join(["t,x", *ROWS[:100], *ROWS[150:]]),
    "back.csv": changed(7, "0.650,0.3").replace("0.600,", "0.800,"),
    "creep.csv": "\n".join(["t,x", *(f"{k * (1 + 1e-3 * k)},{np.sin(k)}" for k in range(300))]),
    "short.csv": "\n".join(["t,x", *ROWS[:99]]),
    "flat.csv": "\n".join(["t,x", *(f"{k},3.5" for k in range(300))]),
    "twice.csv": "\n".join(["x,x", *ROWS]),
    "empty.csv": "\n",
    "good.csv": "\n".join(["t,x", *ROWS]),
    "both.csv": "\n".join(["t,x", *(row.replace(".", ",") for row in ROWS)]),
    "units.csv": "\n".join(["t,x", "s,m", *ROWS]),
    "dates.csv": "\n".join(["t,x", *(f"2026-11-21 13:{k // 60:02d}:{k % 60:02d},{k % 7}" for k in range(300))]),
    "rounded.csv": "\n".join(["t,x", *(f"{k / 30:.2f},{np.sin(k)}" for k in range(300))]),
    "huge.csv": "\n".join(["t,x", *(f"{k},{np.sin(k)}e300" for k in range(300))]),
    "title.csv": "\n".join(["Tank 3", "", "t,x", *ROWS]),
    "blank.csv": "t x\n" + "\0" * 500,
    "mine/series.csv": "\n".join(["t,x", *ROWS]),
}
BINARY = {
    "image.csv": bytes(range(128, 256)),
    "latin1.csv": "t,höhe\n".encode("latin-1"),
    "table.xlsx": b"PK\x03\x04 and more",
    "packed.csv.gz": b"\x1f\x8b\x08 and more",
    "run.nc": b"CDF\x01 and more",
}


@pytest.mark.parametrize(
    ("words", "parts"),
    [
        ("", ["FILE.csv: missing"]),
        ("god.csv --column x", ["no such file", "did you mean 'good.csv'?", "allowed: a text file"]),
        (". --column x", ["a folder"]),
        ("image.csv --column x", ["not text", "save it as UTF-8"]),
        ("latin1.csv --column x", ["not text", "save it as UTF-8"]),
        ("blank.csv --column x", ["not text"]),
        ("table.xlsx --column x", ["a spreadsheet", "save the sheet as CSV"]),
        ("packed.csv.gz --column x", ["compressed", "gunzip"]),
        ("run.nc --column x", ["netCDF", "table().to_csv(NEW)"]),
        ("both.csv --column x", ["has 4 cells, the names are 2", "with a dot, not a comma"]),
        ("units.csv --column x", ["'m', is no number", "a line of units is taken out"]),
        ("dates.csv --column x --time t", ["dates and clock times are not read; give --step SECONDS"]),
        ("rounded.csv --column x --time t", ["where times are only rounded, give --step 0.033"]),
        ("huge.csv --column x", ["at most 1e+100 in size"]),
        ("title.csv --column x", ["the names are 2 (Tank, 3)", "begun with #"]),
        ("good.csv --column x --time x", ["given 'x' as both"]),
        ("mine/series.csv --column x --out mine", ["holds a series.csv that is not known to be of this"]),
        ("whole/series.csv --column x --out whole", ["where whole/series.csv would be written over"]),
        ("empty.csv --column x", ["empty"]),
        ("good.csv", ["--column: not given; allowed: t, x"]),
        ("good.csv --column X1", ["no column 'X1'", "allowed: t, x"]),
        ("good.csv --column x --time time", ["--time: no column 'time'"]),
        ("good.csv --column x --time t --step 0.1", ["given both"]),
        ("good.csv --column x --step 0,1", ["--step: given '0,1'"]),
        ("good.csv --column x --step 0.1 --period -5", ["--period: given '-5'", "above 0"]),
        ("good.csv --column x --step 0.1 --period 0.15", ["samples are 0.1 apart"]),
        ("good.csv --column x --step 0.1 --period 20", ["of a record of 29.9 s", "40 periods"]),
        ("good.csv --column x --tolerance 2", ["--tolerance"]),
        ("good.csv --colum x", ["--colum: no such option; did you mean --column?"]),
        ("good.csv other.csv --column x", ["other.csv: given beside good.csv"]),
        ("good.csv --column", ["expected one argument"]),
        ("nan.csv --column x", ["row 8 below the names, 'nan', is not finite"]),
        ("gap.csv --column x", ["row 8 below the names, '', is empty"]),
        ("word.csv --column x", ["'broken', is no number"]),
        ("comma.csv --column x", ["row 8 below the names has 3 cells, the names are 2"]),
        ("jump.csv --column x --time t", ["steps of 0.1 s, but of 5.1 s after row 100", "even sampling"]),
        ("back.csv --column x --time t", ["0.65 follows 0.8", "times in seconds that increase"]),
        ("creep.csv --column x --time t", ["even sampling"]),
        ("short.csv --column x", ["given 99 samples; allowed: 100 or more"]),
        ("flat.csv --column x", ["every value is 3.5", "a series that moves"]),
        ("twice.csv --column x", ["two columns are called 'x'"]),
        ("good.csv --column x --out good.csv", ["good.csv is a file"]),
        ("good.csv --column x --out campaign", ["which holds buoy_sweep"]),
        ("nan.csv --column y --step 0 --period x --out nan.csv", ["4 faults", "--step", "--period", "--out"]),
    ],
)
def test_faults(tmp_path, monkeypatch, capsys, words, parts):
    monkeypatch.chdir(tmp_path)
    for place in ("mine", "whole", "campaign"):
        (tmp_path / place).mkdir()
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    for name, content in BINARY.items():
        (tmp_path / name).write_bytes(content)
    (tmp_path / "whole" / "series.csv").write_text(FILES["good.csv"])
    (tmp_path / "whole" / "provenance.json").write_text('{"campaign": "time_series"}')
    (tmp_path / "campaign" / "provenance.json").write_text('{"campaign": "buoy_sweep"}')
    before = sorted(path.name for path in tmp_path.rglob("*"))
    assert main(words.split()) == 2
    said = capsys.readouterr()
    assert said.out == "" and "nothing was run or written" in said.err
    for part in parts:
        assert part in said.err
    assert sorted(path.name for path in tmp_path.rglob("*")) == before


@pytest.fixture
def good(tmp_path, monkeypatch):
    """The words for a sound file, in the folder that it lies in."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.csv").write_text(FILES["good.csv"])
    return ["good.csv", "--column", "x", "--out"]


def test_no_name_is_no_folder(good, tmp_path, capsys):
    """As from --out "$RESULTS" with a variable that is not set: not the current folder."""
    assert main([*good, ""]) == 2
    assert "--out: given ''" in capsys.readouterr().err and len(list(tmp_path.iterdir())) == 1


def test_a_full_disk_leaves_the_answer_and_one_line(good, tmp_path, monkeypatch, capsys):
    write = answer.write_atomic

    def full(path, content):
        if path.name == "series.csv":
            raise OSError(28, "No space left on device")
        write(path, content)

    monkeypatch.setattr(answer, "write_atomic", full)
    assert main([*good, "out"]) == 1
    said = capsys.readouterr()
    assert "VERDICT" in said.out and "is full" in said.err and said.err.count("\n") == 1
    monkeypatch.setattr(answer, "write_atomic", write)
    assert main([*good, "out"]) == 0  # with room again, into the same folder
    # What the command will not write over is what it writes.
    kept = {file.name for file in (tmp_path / "out").iterdir()}
    assert kept == {*WRITTEN, "provenance.json"} - {"report.html", "report.pdf"}


def test_ctrl_c_is_one_line(good, tmp_path, monkeypatch, capsys):
    def stopped(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("campaigns.time_series.study.study", stopped)
    assert main([*good, "out"]) == 130
    assert "interrupted" in capsys.readouterr().err and not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "text",
    [
        "x\ty\n" + "1 \t2\n" * 5,
        "x;y\n" + "1;2\n" * 5,
        "# remark\nx y\n" + "1   2\n" * 5,
        "1,2\n" * 6,
        '"x, m";"y"\r\n' + '"1";"2"\r\n' * 5,
        ("x\ty\r\n" + "1\t2\r\n" * 5).encode("utf-16"),
        ("x,y\n" + "1, 2\n" * 5).encode("utf-8-sig"),
    ],
)
def test_tables_of_any_common_shape_are_read(tmp_path, text):
    (tmp_path / "table").write_bytes(text if isinstance(text, bytes) else text.encode())
    for k, cells in enumerate(read_table(tmp_path / "table").values()):
        assert [float(cell) for cell in cells][:5] == [1.0 + k] * 5
