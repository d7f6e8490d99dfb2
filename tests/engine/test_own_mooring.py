"""A scene from a few lengths: ropes beside catalogues, the choice of floating or submerged, questions on a terminal."""

import math
import re
from pathlib import Path

import pytest

from engine import load_scene
from engine.__main__ import main
from engine.own_mooring import ropes
from engine.own_mooring.scene import SUBMERGED, SURFACE, Mooring, scene_text
from engine.run.rest import rest_of
from engine.scene import scene_from_toml

LB_N, LB_PER_100FT_KGPM = 4.4482, 0.45359 / 30.48
OPTIONS = "--buoy-diameter 3 --depth 60 --rope nylon --rope-mm 50 --length 70 --wave-height 6 --wave-period 9"


def mooring(**changes):
    usual = {"buoy_diameter_m": 3.0, "depth_m": 60.0, "rope": ropes.rope_of("nylon", 0.05), "length_m": 70.0}
    return Mooring(**(usual | {"wave_height_m": 6.0, "wave_period_s": 9.0} | changes))


@pytest.mark.parametrize(
    ("material", "diameter_mm", "quantity", "stated", "share"),
    [  # catalogues that are not among the sources of the table
        ("nylon", 25.4 * 1.5, "breaking_load_N", 47800 * LB_N, 0.1),  # Industrial Rope Supply, three strands, 1 1/2 in
        ("nylon", 25.4 * 3.0, "breaking_load_N", 180000 * LB_N, 0.1),
        ("polypropylene", 25.4 * 2.0, "breaking_load_N", 46800 * LB_N, 0.35),
        ("polyester", 20.0, "breaking_load_N", 70e3, 0.1),  # Robline, Rapallo
        ("polyester", 28.0, "breaking_load_N", 135e3, 0.1),
        ("nylon", 25.4 * 2.0, "mass_kgpm", 95.0 * LB_PER_100FT_KGPM, 0.35),
        ("polypropylene", 25.4 * 2.0, "mass_kgpm", 69.0 * LB_PER_100FT_KGPM, 0.35),
        ("polyester", 24.0, "mass_kgpm", 0.351, 0.35),
    ],
)
def test_breaking_loads_and_masses_are_those_of_other_catalogues(material, diameter_mm, quantity, stated, share):
    assert getattr(ropes.rope_of(material, 1e-3 * diameter_mm), quantity) == pytest.approx(stated, rel=share)


@pytest.mark.parametrize("material", ropes.materials())
def test_a_rope_is_lighter_than_a_full_circle_and_bends_like_a_solid_rod(material):
    rope = ropes.rope_of(material, 0.05)
    assert 0.4 < rope.area_m2 / (math.pi * 0.05**2 / 4) < 1.0
    radius_m = math.sqrt(rope.area_m2 / math.pi)
    assert rope.bending_Nm2 == pytest.approx(rope.stiffness_N / rope.area_m2 * math.pi * radius_m**4 / 4)
    assert 0.3 < rope.stiffness_N / rope.breaking_load_N < 100


def test_every_number_of_the_table_of_ropes_has_its_source():
    lines = Path(ropes.__file__).with_name("ropes.toml").read_text(encoding="utf-8").splitlines()
    numbers = [line for line in lines if re.match(r"\w+ = [\d.]", line)]
    alone = [line for line in numbers if "#" not in line]
    assert len(numbers) > 20
    for line in alone:  # its source is the line below
        assert lines[lines.index(line) + 1].startswith("source = ")


@pytest.mark.parametrize("share", [0.999, 1.001])
def test_a_buoy_floats_where_the_stretched_rope_lets_it_reach_a_trough(share):
    length_m = share * mooring().longest_submerged_m
    short = mooring(length_m=length_m)
    scene = scene_from_toml(scene_text(short, "mine"))
    floats = share > 1.0
    assert short.kind == (SURFACE if floats else SUBMERGED)
    assert scene.buoy.submergence == "spherical-cap"
    # by hand: the rope carries the lift of half a sphere of sea water
    lift_N = 1025.0 * math.pi * 27.0 / 12.0 * 9.81
    top_m = length_m * (1.0 + lift_N / (1.18e8 * 0.05**2)) + 1.5
    assert (top_m > 57.0) == floats


@pytest.mark.parametrize(
    ("material", "diameter_mm", "length_m", "depth_m", "buoy_diameter_m"),
    [
        ("nylon", 7.7, 368.4, 325.9, 0.33),
        ("nylon", 10.7, 203.3, 129.6, 0.3),
        ("polyester", 18.9, 90.7, 60.7, 1.46),
        ("wire", 4.5, 416.1, 305.5, 0.55),
    ],
)
def test_a_slack_rope_in_still_water_bears_its_weight(material, diameter_mm, length_m, depth_m, buoy_diameter_m):
    """The buoy carries it from the bed up to itself; the rest lies. An element kept a turn of 3.1 to 9.4 rad."""
    rope = ropes.rope_of(material, 1e-3 * diameter_mm)
    wanted = mooring(buoy_diameter_m=buoy_diameter_m, depth_m=depth_m, rope=rope, length_m=length_m)
    rest = rest_of(scene_from_toml(scene_text(wanted, "mine")))
    assert rest.status == 0 and rest.turn < 0.5 * math.pi
    assert rest.top_N == pytest.approx(wanted.hanging_N, rel=0.02)  # its draught is not known


@pytest.mark.parametrize(
    "changes",
    [{"wave_height_m": 0.0, "wave_period_s": None}, {"current_mps": -0.5}, {"mass_kg": 5000.0}, {"length_m": 30.0}],
)
@pytest.mark.parametrize("material", ropes.materials())
def test_what_is_written_is_a_scene_of_these_values(material, changes):
    wanted = mooring(rope=ropes.rope_of(material, 0.05), **changes)
    assert wanted.faults() == []
    text = scene_text(wanted, "mine")
    scene = scene_from_toml(text)
    assert scene.tether.density_kgpm3 * scene.tether.area_m2 == pytest.approx(wanted.rope.mass_kgpm, rel=1e-3)
    assert scene.buoy.added_mass_kg == pytest.approx(1025.0 * math.pi * 27.0 / 12.0, rel=1e-4)
    assert (scene.waves is None) == (wanted.wave_height_m == 0.0) and scene.floor is not None
    lines = text.splitlines()
    values = [line for line in lines if re.match(r"(?!name|title)\w+ = ", line)]
    assert len(values) > 15
    assert all(" # " in line or lines[lines.index(line) - 1].startswith("# ") for line in values)


def test_the_options_of_a_new_scene_may_stand_in_front(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["--new", "first.toml", *OPTIONS.split()]) == main([*OPTIONS.split(), "--new", "mine.toml"]) == 0
    first, mine = ((tmp_path / name).read_text() for name in ("first.toml", "mine.toml"))
    assert first.replace('"first"', '"mine"') == mine


def test_options_and_answers_on_a_terminal_write_the_same_scene(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["--new", "mine.toml", *OPTIONS.split()]) == 0
    by_options = (tmp_path / "mine.toml").read_text()
    (tmp_path / "mine.toml").unlink()
    typed = iter("3|half|60|hemp|nylon|50|70|six|6|9|".split("|"))  # two of them are asked again; Enter: no current
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    monkeypatch.setattr("builtins.input", lambda question: next(typed))
    assert main(["--new", "mine.toml"]) == 0
    assert next(typed, None) is None and "given hemp; allowed: one of nylon" in capsys.readouterr().out
    assert (tmp_path / "mine.toml").read_text() == by_options
    assert load_scene("mine.toml").tether.breaking_load_N == pytest.approx(1.39357e8 * 0.05**2, rel=1e-3)


def test_an_interrupted_question_writes_nothing(tmp_path, monkeypatch):
    def interrupted(question):
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.stdin.isatty", lambda: True)
    monkeypatch.setattr("builtins.input", interrupted)
    assert main(["--new", "mine.toml"]) == 130
    assert list(tmp_path.iterdir()) == []
