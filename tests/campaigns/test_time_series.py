"""A column from a file gets the word that its motion has, and noise is never called chaos; tables of any common shape
are read, and a full disk or Ctrl-C is one line (what is refused: mistakes.toml)."""

import json
import shutil
import tracemalloc
from itertools import pairwise

import numpy as np
import pandas
import pytest
from scipy.signal import lfilter

from benchmarks.known_records import REGULAR
from campaigns.time_series import WRITTEN, answer, main, study
from campaigns.time_series.record import _numbers, read_record, read_table
from campaigns.time_series.study import successive_maxima
from reports import build
from reports.parts.folder import FolderError
from reports.time_series.report import record_and_spectrum
from tests.analysis.systems import henon, logistic, normal, states
from tests.campaigns.conftest import built_twice, rows_of

TIME = np.arange(1500) * 0.4
FORTY = np.arange(4000) * 2.0 * np.pi / 40.0
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


def answered(tmp_path, values, step=None, *options):
    """answer.json of the command for a file of values, and of times where there is a step; it must end well."""
    table, time = pandas.DataFrame({"x": values}), []
    if step is not None:
        table["t"], time = step * np.arange(len(values)), ["--time", "t"]
    path, out = tmp_path / "series.csv", tmp_path / "out"
    table.to_csv(path, index=False)
    assert main([str(path), "--column", "x", *time, *options, "--out", str(out)]) == 0
    return json.loads((out / "answer.json").read_text())


MOTIONS = {
    "sine": (np.sin(TIME), 0.4, (), "period-1"),
    "logistic": (logistic(3.9, 800), None, (), "chaotic"),
    "white": (normal(0, 800), None, (), "undecided"),
    "a gap marked": (np.where(np.arange(1500) == 700, -9999.0, np.sin(TIME)), 0.4, (), "undecided"),
    "sine with noise": (np.sin(TIME) + 0.01 * normal(0, 1500), 0.4, (), "period-1"),
    # maxima of one height that come ever faster: alike, and no period
    "chirp": (np.sin(TIME + 2e-4 * TIME**2), 0.4, (), "undecided"),
}
SLOW_MOTIONS = {
    "forced sine": (np.sin(TIME), 0.4, ("--period", "12.566370614359172"), "period-1"),
    "slow, too short": (np.sin(0.05 * np.arange(105)), 1.0, ("--period", "1"), "undecided"),
    "two, samples at the maxima": (np.sin(FORTY) + 0.3 * np.sin(0.5 * FORTY), 1.0, (), "period-2"),
    "two": (np.sin(TIME) + 0.2 * np.sin(0.5 * TIME), 0.4, (), "period-2"),
    "golden": (np.sin(FORTY) + 0.7 * np.sin(GOLDEN * FORTY), 1.0, (), "quasi-periodic"),
    "golden with noise": (
        np.sin(FORTY) + 0.1 * np.sin(GOLDEN * FORTY) + 0.01 * normal(0, 4000),
        1.0,
        (),
        "quasi-periodic",
    ),
    "period 4": (logistic(3.5, 400), None, (), "period-4"),
    "henon": (henon(800)[:, 0], 1.0, ("--period", "1"), "chaotic"),
    "white, strobed": (normal(0, 800), 1.0, ("--period", "1"), "undecided"),
    "ar1": (lfilter([1.0], [1.0, -0.95], normal(0, 2500)), 0.1, (), "undecided"),
    "two values": (np.sign(np.sin(TIME) + 0.1), 0.4, (), "period-1"),
    "random walk": (np.cumsum(normal(0, 4000)), 0.1, (), "transient"),
}


@pytest.mark.parametrize("name", [*MOTIONS, *(pytest.param(name, marks=pytest.mark.slow) for name in SLOW_MOTIONS)])
def test_each_motion_gets_its_word(tmp_path, capsys, name):
    values, step, options, word = {**MOTIONS, **SLOW_MOTIONS}[name]
    result = answered(tmp_path, values, step, *options)
    assert result["regime"] == word
    assert ["VERDICT", f"{word}:"] in [line.split()[:2] for line in capsys.readouterr().out.splitlines()]
    bits_per_nat = result["section"]["cycle"] / np.log(2.0)
    for exponent in result["exponents"].values():
        for bits, nats in (("bits_per_cycle", "nats_per_time"), ("bits_per_cycle_error", "error")):
            assert exponent[bits] == (exponent[nats] and pytest.approx(exponent[nats] * bits_per_nat))
    for (_, nats, *_), (measure, bits, *_) in pairwise(result["measures"]):
        if measure == "the same" and bits != "none":  # values and errors, both rounded to two digits of the errors
            wanted = [float(number) * bits_per_nat for number in nats.split(" +- ")]
            assert [float(number) for number in bits.split(" +- ")] == pytest.approx(wanted, abs=0.12 * wanted[-1])


def test_no_small_torus_is_a_period_because_its_record_begins_with_a_large_start():
    """The start is 4000 times as large as the motion, and has died out in the later half."""
    time = FORTY / (2.0 * np.pi)
    torus = np.sin(FORTY) + 0.7 * np.sin(GOLDEN * FORTY)
    x = torus + 4000.0 * np.exp(-time / 3.0) * np.cos(5.0 * time)
    verdict, _ = study.judged(x, study.seen(x, 1.0, 40.0))
    assert verdict.regime == "transient", verdict.reason


def test_a_point_of_the_section_that_lies_far_outside_is_named_by_its_time():
    """Its four phases are at 600, 605, 610 and 615: the row of a point is no row of the record."""
    x = np.sin(FORTY) + 100.0 * np.exp(-((np.arange(4000) - 1240.0) ** 2) / 50.0)
    verdict, _ = study.judged(x, study.seen(x, 0.5, 20.0))
    assert verdict.regime == "undecided" and "points of the section" in verdict.reason
    assert "600 after the first sample" in verdict.reason


def test_a_section_of_few_points_is_too_short_whatever_lies_outside():
    """Eleven maxima of a slow sine; noise has placed one of them elsewhere."""
    x = np.sin(2.0 * np.pi * np.arange(10_000) / 900.0)
    x[3000] += 0.05
    verdict, _ = study.judged(x, study.seen(x, 1.0))
    assert verdict.reason.startswith("too short"), verdict.reason


def test_the_ends_of_a_spline_are_no_points_of_a_section_between_samples():
    """A period of 7.3 samples: the spline errs twenty times as much at the last of them as within the record."""
    x = np.cos(2.0 * np.pi * np.arange(4000) / 7.3)
    verdict, _ = study.judged(x, study.seen(x, 1.0, 7.3))
    assert verdict.period == 1, verdict.reason


@pytest.mark.parametrize("off", [1e-4, -1e-4, 1e-3])
def test_a_forcing_period_that_is_slightly_wrong_is_set_right(off):
    """A section at 40.004 samples of a motion of period 40 drifts along the orbit, as in a transient. With the period
    of the line, in the eight digits in which the answer prints it, nothing is left of the drift."""
    clean = np.sin(FORTY) + 0.3 * np.sin(0.5 * FORTY)
    for x in (clean, clean + 1e-3 * normal(0, 4000)):
        line = study.line_beside(x, 0.5, 20.0 * (1.0 + off))
        assert line == pytest.approx(20.0, rel=1e-6) and study.line_beside(x, 0.5, 20.0) is None
        assert study.judged(x, study.seen(x, 0.5, round(line, 6)))[0].period == 2


@pytest.mark.parametrize("periods", [4, 7, 9, 38, 41])
def test_a_record_of_fewer_than_forty_periods_has_neither_a_period_nor_a_line(periods):
    x, period = np.sin(FORTY[: 40 * periods + 1]), 40.0
    assert study.line_beside(x, 1.0, 1.001 * period) is None or periods > 40
    for tolerance in (None, 0.05):
        verdict, _ = study.judged(x, study.seen(x, 1.0, period), tolerance)
        assert verdict.period == (1 if periods > 40 else None)


def test_no_slow_torus_is_a_period_because_its_steps_are_small():
    """Its amplitude changes by 40 % in 53 cycles, from one to the next by less than eight times the noise."""
    x = (1.0 + 0.4 * np.cos(FORTY * GOLDEN / 33.0)) * np.cos(FORTY + 0.3) + 0.01 * normal(1, 4000)
    view = study.seen(x, 1.0, 40.0)
    for tolerance in (None, 0.05):
        verdict, _ = study.judged(x, view, tolerance)
        assert verdict.period is None, verdict.reason
    x = (1.0 + 0.003 * np.cos(FORTY * GOLDEN / 33.0)) * np.cos(FORTY + 0.3) + 0.01 * normal(1, 4000)
    assert study.judged(x, study.seen(x, 1.0, 40.0))[0].period == 1


@pytest.mark.parametrize("bits", [5, 7, 8, 10, 12])
def test_a_period_in_the_steps_of_a_logger_is_a_period(bits):
    """No cycle has its samples at the phases of another one, so that each is rounded otherwise; a torus that is 40
    steps wide stays one."""
    angle, steps = FORTY * 40.0 / (24.0 - GOLDEN / 3.0), 2**bits - 1
    for torus in (0.0, 20.0 / steps):
        x = np.cos(angle) + 0.4 * np.cos(2.0 * angle + 1.0) + torus * np.cos(angle * GOLDEN)
        x = np.rint(steps * (x - x.min()) / np.ptp(x)) / steps
        verdict, _ = study.judged(x, study.seen(x, 1.0))
        assert verdict.period == (None if torus else 1), verdict.reason


def test_a_phase_at_which_the_motion_always_crosses_zero_tells_nothing():
    """A cosine of random amplitude is zero at two of its four phases but for rounding, which grows with time."""
    cycle = np.cos(2.0 * np.pi * np.arange(24 * 300 + 1) / 24.0)
    x = cycle * np.repeat(1.0 + (normal(3, 301) > 0.0), 24)[: len(cycle)]
    view = study.seen(x, 1.0, 24.0)
    assert study.judged(x, view)[0].regime == "undecided"
    assert np.allclose(np.abs(view.points), np.abs(x[::24][: len(view.points), None]))


@pytest.mark.slow
def test_the_answer_comes_with_errors_and_curves(tmp_path, capsys):
    result = answered(tmp_path, logistic(4.0, 1500))
    assert set(result["exponents"]) == {"wolf", "rosenstein"}
    for name in result["exponents"]:
        exponent = result["exponents"][name]
        assert (
            exponent["nats_per_time"] == pytest.approx(np.log(2.0), abs=3.0 * exponent["error"])
            and exponent["error"] < 0.1
        )
    dimension = result["dimension"]
    assert dimension["value"] == pytest.approx(1.0, abs=max(3.0 * dimension["error"], 0.1))
    assert all(item["passed"] for item in result["evidence"] if item["name"] in ("exponent", "0-1 test", "linear null"))
    files = [float(row["value"]) for row in rows_of(tmp_path / "out", "series.csv")]
    assert files == pytest.approx(logistic(4.0, 1500), rel=1e-14)
    names_told = {row["name"] for row in rows_of(tmp_path / "out", "columns.csv")}
    for name in ("spectrum", "section", "divergence", "dimension"):
        head, *rows = (tmp_path / "out" / f"{name}.csv").read_text().splitlines()
        assert len(rows) > 9 and names_told >= set(head.split(","))
    assert (tmp_path / "out" / "answer.txt").read_text() in capsys.readouterr().out


@pytest.mark.slow
def test_the_same_file_gives_the_same_bytes_and_units_and_origin_do_not_matter(tmp_path, capsys):
    files, words = [], []
    for values in (henon(400)[:, 0], henon(400)[:, 0], 21.0 - 1e-3 * henon(400)[:, 0]):
        result = answered(tmp_path, values)
        words.append((result["regime"], result["period"]))
        files.append({path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()})
    assert files[0] == files[1] and words[0] == words[2]


def test_maxima_are_those_of_the_curve_between_the_samples():
    """Heights and places of a cosine sampled 20 times a cycle, to h^4/384 and a tenth of it."""
    t = np.arange(500) * (2.0 * np.pi / 20.3)
    place, height = successive_maxima(3.0 * np.cos(t) + 1.0, 0.0)
    assert height == pytest.approx(np.full(len(height), 4.0), abs=1.1 * 3.0 * t[1] ** 4 / 384.0)
    assert np.diff(place) == pytest.approx(np.full(len(place) - 1, 20.3), abs=1e-2)


@pytest.mark.slow
def test_a_flow_at_its_maxima_is_chaotic_with_the_known_exponent(tmp_path, capsys):
    """Rossler's: 0.0714 nats a unit of time (Sprott 2003)."""
    result = answered(tmp_path, states("rossler", 19_000, 0.15)[:, 0], 0.15)
    wolf = result["exponents"]["wolf"]
    assert result["regime"] == "chaotic" and result["section"]["kind"] == "maxima"
    assert wolf["nats_per_time"] == pytest.approx(0.0714, abs=3.0 * wolf["error"])


@pytest.mark.slow
@pytest.mark.parametrize("kind", REGULAR)
def test_no_false_alarm_in_regular_records(kind):
    for number in range(3):
        known = REGULAR[kind](np.random.default_rng([number, 301]))
        view = study.seen(known.series, known.step, known.period)
        verdict, _ = study.judged(known.series, view)
        assert verdict.regime != "chaotic", (number, known.name, verdict.reason)


@pytest.fixture
def good(tmp_path, monkeypatch):
    """The words for a sound file, in the folder that it lies in."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "good.csv").write_text("x\n" + "\n".join(f"{np.sin(0.1 * k):.6f}" for k in range(300)))
    return ["good.csv", "--column", "x", "--out"]


def test_a_full_disk_leaves_the_answer_and_one_line(good, tmp_path, monkeypatch, capsys):
    write = answer.write_atomic

    def full(path, content):
        if path.name == "series.csv":
            raise OSError(28, "No space left on device")
        write(path, content)

    monkeypatch.setattr(answer, "write_atomic", full)
    assert main([*good, "out"]) == 1
    printed = capsys.readouterr()
    assert "VERDICT" in printed.out and "is full" in printed.err and printed.err.count("\n") == 1
    monkeypatch.setattr(answer, "write_atomic", write)
    assert main([*good, "out"]) == 0  # with room again, into the same folder
    # What the command will not write over is what it writes.
    files = {file.name for file in (tmp_path / "out").iterdir()}
    assert files == {*WRITTEN, "provenance.json"} - {"report.html", "report.pdf"}


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
        "x,word,y\n" + '"1",one, 2\n' * 5,
    ],
)
def test_tables_of_any_common_shape_are_read(tmp_path, text):
    (tmp_path / "table").write_bytes(text if isinstance(text, bytes) else text.encode())
    table, faults = read_table(tmp_path / "table"), []
    first, last = _numbers(table, {"x": 0, "y": len(table.names) - 1}, faults).values()
    assert not faults
    assert list(first)[:5] == [1.0] * 5 and list(last)[:5] == [2.0] * 5


def read(place, rows, time="t"):
    """The record of x in a table of t and x with these rows, or with those that it has, and its faults."""
    path, faults = place / "table", []
    if rows is not None:
        path.write_text(f"t,x\n{rows}")
    return read_record(str(path), "x", time, None, faults), faults


@pytest.mark.parametrize("cell", ["1_0", "0x10", "1 0", "", "nan", "1e400", "1#0"])
@pytest.mark.parametrize("row", [1, 47])
def test_what_is_no_plain_number_is_refused_by_its_row_wherever_it_stands(tmp_path, cell, row):
    cells = ["0.5", "1.5"] * 60
    cells[row - 1] = cell
    record, (line,) = read(tmp_path, "".join(f"{k},{cell}\n" for k, cell in enumerate(cells)))
    assert record is None
    assert line.startswith(f"--column x: row {row} below the names, {cell!r}, is") and "allowed: finite numbers" in line


def test_of_a_quotation_that_does_not_end_only_the_begin_is_shown(tmp_path):
    _, (line,) = read(tmp_path, '0,"1\n' + "1,2\n" * 500, time=None)
    assert "row 1 below the names, '1\\n" in line and len(line) < 200


def test_an_empty_line_among_the_numbers_of_a_single_column_is_an_empty_cell(tmp_path):
    """Spreadsheets write an empty cell so: without it, the later samples would come too early."""
    path, numbers, faults = tmp_path / "table", "1\n2\n" * 60, []
    path.write_text(f"x\n\n{numbers}\n\n")
    assert len(read_record(str(path), None, None, 0.5, faults).values) == 120 and not faults
    for text, row in ((f"x\n{numbers}\n{numbers}", 121), (f"1\n\n{numbers}", 2)):
        path.write_text(text)
        read_record(str(path), None, None, 0.5, faults)
        assert f"row {row} below the names, '', is empty" in faults.pop()


def test_separators_at_the_end_of_a_line_are_no_columns(tmp_path):
    """Loggers end their lines with them."""
    (tmp_path / "table").write_text("time_s;x;;\n" + "".join(f"{0.1 * k:.1f};{k % 7};;\n" for k in range(200)))
    faults = []
    record = read_record(str(tmp_path / "table"), None, None, None, faults)
    assert not faults and record.column == "x" and record.step == pytest.approx(0.1)


def test_a_row_of_other_length_is_refused_by_its_row(tmp_path):
    record, faults = read(tmp_path, "1,2\n" * 45 + "1\n1,2,3\n", time=None)
    assert record is None and "row 46 below the names has 1 cells, the names are 2" in faults[0]


@pytest.mark.slow
def test_a_large_file_takes_little_more_memory_than_its_numbers(tmp_path):
    t = np.arange(300_000)
    x = np.sin(0.1 * t)
    text = "".join(f"{k},{value!r}\n" for k, value in zip(t.tolist(), x.tolist(), strict=True))
    read(tmp_path, text)
    tracemalloc.start()
    record, faults = read(tmp_path, None)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert not faults and np.array_equal(record.values, x)
    assert peak < 8 * record.values.nbytes  # as cells of text they are 25 times as large


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    place = tmp_path_factory.mktemp("series")
    t = 0.3 * np.arange(3000)
    rows = "\n".join(repr(float(value)) for value in np.sin(t) + 0.7 * np.sin(0.61803 * t))
    (place / "tank.csv").write_text(f"load_N\n{rows}\n")
    assert main([str(place / "tank.csv"), "--column", "load_N", "--step", "0.3", "--out", str(place / "out")]) == 0
    return place / "out"


@pytest.mark.slow
def test_the_page_says_the_verdict_and_shows_every_curve(judged):
    page, pdf = built_twice(judged)
    text = page.decode()
    assert "The motion is quasi-periodic" in text and "load_N" in text
    assert text.count("<figure") == 3 and text.count("alt=") + text.count("aria-label") >= 3
    assert pdf.startswith(b"%PDF")


@pytest.mark.slow
def test_a_folder_of_an_older_version_is_drawn_without_what_is_gone(judged, tmp_path):
    """It has Kantz's curve, and the slopes at one delay more."""
    older = tmp_path / "older"
    shutil.copytree(judged, older, ignore=shutil.ignore_patterns("report.*"))
    growth, dimension = pandas.read_csv(older / "divergence.csv"), pandas.read_csv(older / "dimension.csv")
    growth.insert(1, "kantz_nats", 0.5)
    growth.to_csv(older / "divergence.csv", index=False)
    further = dimension.assign(delays=dimension["delays"] + 1, slope=7.0)
    pandas.concat([dimension, further]).to_csv(older / "dimension.csv", index=False)
    html, _ = build(older)
    assert html.read_text(encoding="utf-8") == build(judged, again=True)[0].read_text(encoding="utf-8")


@pytest.mark.slow
def test_any_name_of_a_column_can_be_drawn():
    for name in ("$x_{1", "load_N", "a b " * 40, "\\frac", "Zug in N²"):
        assert b"<svg" in record_and_spectrum(*np.ones((4, 30)), ("s", name)).data


@pytest.mark.slow
def test_what_is_missing_is_named(judged, tmp_path):
    (tmp_path / "provenance.json").write_text((judged / "provenance.json").read_text())
    (tmp_path / "section.csv").write_text("time_s,value_0\n0,x\n")
    with pytest.raises(FolderError) as fault:
        build(tmp_path)
    assert "answer.json is missing" in str(fault.value) and "section.csv cannot be read" in str(fault.value)


def tension_file(tmp_path, hertz=0.0):
    """Half sines of 6 kN, once in 10 s, for 200 s, with zero between them and a ringing of 1.5 kN at each end."""
    time_s = 0.005 * np.arange(40001)
    since_s = np.mod(time_s - 2.0, 5.0)
    pull = np.sin(2.0 * np.pi * (time_s - 2.0) / 10.0)
    tension_N = 6e3 * np.maximum(pull, 0.0) + 3e3 * np.sin(2.0 * np.pi * hertz * since_s) * np.exp(-since_s / 0.3)
    path = tmp_path / "tension.csv"
    np.savetxt(path, np.column_stack([time_s, tension_N]), delimiter=",", header="time_s,T", comments="")
    return path


@pytest.mark.parametrize("hertz", [0.0, 40.0])
def test_snaps_of_a_measured_tension_are_counted_once_though_the_line_rings(tmp_path, hertz, capsys):
    words = [
        str(tension_file(tmp_path, hertz)),
        "--snaps",
        "--static",
        "2000",
    ]  # times and column are found by themselves
    assert main([*words, "--ringing", "0.054", "--out", str(tmp_path / "out")]) == 0
    assert "20 snaps in 200 s" in capsys.readouterr().out
    taut_s = pandas.read_csv(tmp_path / "out" / "snaps.csv").taut_s
    np.testing.assert_allclose(taut_s, 2.0 + 10.0 * np.arange(20), atol=0.1)


def test_a_record_without_snaps_is_told_why(tmp_path, capsys):
    """A sensor whose zero is 150 N too high shows no slack below 100 N."""
    tension_N = 150.0 + np.maximum(6e3 * np.sin(0.01 * np.arange(2000)), 0.0)
    np.savetxt(tmp_path / "tension.csv", tension_N, header="T", comments="")
    assert main([str(tmp_path / "tension.csv"), "--step", "0.1", "--snaps", "--static", "2000"]) == 0
    printed = capsys.readouterr().out
    assert "0 snaps" in printed and "between 150 and 6150 N" in printed
