"""The oscillator campaign: its parts are rows with files, found again, computed again only where lost; its report."""

import pytest

from campaigns import oscillator
from reports import build
from reports.oscillator.report import PARTS, read_study
from tests.campaigns.conftest import built_twice, rows_of, untimed

QUICK = ["--effort", "0.005", "--no-report"]


def made(folder, *words):
    assert oscillator.main([*QUICK, *words, "--out", str(folder)]) == 0
    return folder


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    return made(tmp_path_factory.mktemp("study") / "out")


def rows(folder):
    return {row["part"]: row for row in rows_of(folder)}


def test_every_part_is_a_row_with_its_file(out):
    table = rows(out)
    assert len(table) == 6 and all(row["status"] == "ok" for row in table.values())
    assert {path.stem for path in (out / "trajectories").glob("*.nc")} == {row["run_key"] for row in table.values()}
    assert "The line stays taut up to a force of F = 0.2046." in (out / "answer.txt").read_text()


def test_what_is_there_is_found_and_a_damaged_part_is_computed_again_with_the_same_numbers(out, capsys):
    row, earlier = rows(out)["orbits"], (out / "table.csv").read_bytes()
    made(out)
    assert "6: 0 computed, 6 found" in capsys.readouterr().out
    assert (out / "table.csv").read_bytes() == earlier
    path = out / "trajectories" / f"{row['run_key']}.nc"
    content = path.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    made(out)
    assert "6: 1 computed, 5 found" in capsys.readouterr().out
    assert untimed([rows(out)["orbits"]]) == untimed([row])


@pytest.mark.parametrize(
    ("exponent", "word"), [(0.41, "chaotic"), (0.39, "neither"), (-0.39, "neither"), (-0.41, "regular")]
)
def test_the_motion_has_the_sign_of_an_exponent_of_more_than_two_errors(exponent, word):
    row = {"part": "exponents", "status": "ok", "lambda_1_bits_per_period": exponent, "lambda_1_bits_error": 0.2}
    sentence, *_ = oscillator.answer(oscillator.read_order([], []), [row | {"starts": 9, "elsewhere": 0}])
    assert sentence.startswith(f"The motion is {word}")


@pytest.mark.slow
def test_parts_beside_each_other_give_the_same_numbers(out, tmp_path):
    alone = made(tmp_path / "alone", "--jobs", "1")
    assert untimed(rows_of(alone)) == untimed(rows_of(out))


def test_another_range_touches_only_its_diagram(out, capsys):
    made(out, "--force-range", "0.2", "0.4", "4")
    assert "6: 1 computed, 5 found" in capsys.readouterr().out


@pytest.mark.slow
def test_same_folder_same_report_and_a_lost_part_leaves_the_rest(out):
    page, _ = built_twice(out)
    assert page.count(b"<figure") == page.count(b"<figcaption") == 6
    key = next(row["run_key"] for row in rows_of(out) if row["part"] == "history")
    (out / "trajectories" / f"{key}.nc").unlink()
    study = read_study(out)
    assert set(study.faults) == {"history"} and set(study.arrays) == set(PARTS) - {"history"}
    assert build(out)[0].read_bytes().count(b"<figure") == 5
