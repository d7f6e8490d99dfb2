"""A column from a file gets the word that its motion has, and noise is never called chaos."""

import json

import numpy as np
import pytest
from scipy.signal import lfilter

from campaigns.time_series import main
from campaigns.time_series.record import Record
from campaigns.time_series.study import study, successive_maxima
from tests.analysis.forced_records import KINDS, SAMPLES, record
from tests.analysis.maps import henon, logistic
from tests.analysis.systems import states
from tests.campaigns.conftest import rows_of

TIME = np.arange(1500) * 0.4
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)


def noise(samples):
    return np.random.default_rng(0).normal(size=samples)


def answered(tmp_path, values, step=None, *options):
    """answer.json of the command for a file of values, and of times where there is a step; it must end well."""
    rows = ["x"] if step is None else ["t,x"]
    rows += [f"{v:.15g}" if step is None else f"{k * step:.9g},{v:.15g}" for k, v in enumerate(values)]
    path, out = tmp_path / "series.csv", tmp_path / "out"
    path.write_text("\n".join(rows) + "\n")
    time = [] if step is None else ["--time", "t"]
    assert main([str(path), "--column", "x", *time, *options, "--out", str(out)]) == 0
    return json.loads((out / "answer.json").read_text())


MOTIONS = {
    "sine": (np.sin(TIME), 0.4, (), "period-1"),
    "logistic": (logistic(3.9, 800), None, (), "chaotic"),
    "white": (noise(800), None, (), "undecided"),
}
MORE = {
    "forced sine": (np.sin(TIME), 0.4, ("--period", "12.566370614359172"), "period-1"),
    "two": (np.sin(TIME) + 0.2 * np.sin(0.5 * TIME), 0.4, (), "period-2"),
    "golden": (np.sin(TIME) + 0.7 * np.sin(GOLDEN * TIME), 0.4, (), "quasi-periodic"),
    "period 4": (logistic(3.5, 400), None, (), "period-4"),
    "henon": (henon(800)[:, 0], 1.0, ("--period", "1"), "chaotic"),
    "white, strobed": (noise(800), 1.0, ("--period", "1"), "undecided"),
    "ar1": (lfilter([1.0], [1.0, -0.95], noise(2500)), 0.1, (), "undecided"),
    # maxima of one height that come ever faster: alike, and no period
    "chirp": (np.sin(TIME + 2e-4 * TIME**2), 0.4, (), "undecided"),
    "two values": (np.sign(np.sin(TIME) + 0.1), 0.4, (), "period-1"),
    "random walk": (np.cumsum(noise(4000)), 0.1, (), "transient"),
}


@pytest.mark.parametrize("name", [*MOTIONS, *(pytest.param(name, marks=pytest.mark.slow) for name in MORE)])
def test_each_motion_gets_its_word(tmp_path, capsys, name):
    values, step, options, word = {**MOTIONS, **MORE}[name]
    found = answered(tmp_path, values, step, *options)
    assert found["regime"] == word
    assert ["VERDICT", f"{word}:"] in [line.split()[:2] for line in capsys.readouterr().out.splitlines()]


@pytest.mark.slow
def test_the_answer_comes_with_errors_and_curves(tmp_path, capsys):
    found = answered(tmp_path, logistic(4.0, 1500))
    for name in ("wolf", "rosenstein", "kantz"):
        one = found["exponents"][name]
        assert one["nats_per_time"] == pytest.approx(np.log(2.0), abs=3.0 * one["error"]) and one["error"] < 0.1
    dimension = found["dimension"]
    assert dimension["value"] == pytest.approx(1.0, abs=max(3.0 * dimension["error"], 0.1))
    assert all(item["passed"] for item in found["evidence"] if item["name"] in ("exponent", "0-1 test", "linear null"))
    kept = [float(row["value"]) for row in rows_of(tmp_path / "out", "series.csv")]
    assert kept == pytest.approx(logistic(4.0, 1500), rel=1e-14)
    told = {row["name"] for row in rows_of(tmp_path / "out", "columns.csv")}
    for name in ("spectrum", "section", "divergence", "dimension"):
        head, *rows = (tmp_path / "out" / f"{name}.csv").read_text().splitlines()
        assert len(rows) > 9 and told >= set(head.split(","))
    assert (tmp_path / "out" / "answer.txt").read_text() in capsys.readouterr().out


@pytest.mark.slow
def test_the_same_file_gives_the_same_bytes_and_units_and_origin_do_not_matter(tmp_path, capsys):
    kept, words = [], []
    for values in (henon(400)[:, 0], henon(400)[:, 0], 21.0 - 1e-3 * henon(400)[:, 0]):
        found = answered(tmp_path, values)
        words.append((found["regime"], found["period"]))
        kept.append({path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()})
    assert kept[0] == kept[1] and words[0] == words[2]


def test_maxima_are_those_of_the_curve_between_the_samples():
    """Heights and places of a cosine sampled 20 times a cycle, to h^4/384 and a tenth of it."""
    t = np.arange(500) * (2.0 * np.pi / 20.3)
    place, height = successive_maxima(3.0 * np.cos(t) + 1.0, 0.0)
    assert height == pytest.approx(np.full(len(height), 4.0), abs=1.1 * 3.0 * t[1] ** 4 / 384.0)
    assert np.diff(place) == pytest.approx(np.full(len(place) - 1, 20.3), abs=1e-2)


@pytest.mark.slow
def test_a_flow_at_its_maxima_is_chaotic_with_the_known_exponent(tmp_path, capsys):
    """Rossler's: 0.0714 nats a unit of time (Sprott 2003)."""
    found = answered(tmp_path, states("rossler", 19_000, 0.15)[:, 0], 0.15)
    wolf = found["exponents"]["wolf"]
    assert found["regime"] == "chaotic" and found["section"]["kind"] == "maxima"
    assert wolf["nats_per_time"] == pytest.approx(0.0714, abs=3.0 * wolf["error"])


@pytest.mark.slow
@pytest.mark.parametrize("period", [None, 1.0], ids=["maxima", "strobed"])
@pytest.mark.parametrize("kind", KINDS)
def test_no_false_alarm_in_any_column(kind, period, tmp_path):
    found = study(Record(record(kind, 301), 1.0 / SAMPLES, "s", "x", tmp_path), period)
    assert found.verdict.regime != "chaotic", found.verdict.reason
