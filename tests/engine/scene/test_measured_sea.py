"""Law: a measured elevation is at its gauge what was measured, and elsewhere what the known sea is there; a record that
cannot be one is refused with its key and the reason.
"""

import numpy as np
import pytest
import tomli_w

from engine import load_scene
from engine.physics.sea import elevation_m
from engine.scene import SceneError, scene_from_toml

KEYS = {"tether.nodes": 11, "water.depth_m": 22.5}
TIME_S = 7.0 + 0.25 * np.arange(2400)
KNOWN = load_scene("tethered_buoy", KEYS | {"waves.jonswap": {"significant_height_m": 1.0, "seed": 3}})
GAUGE_M = 3.0
ELEVATION = elevation_m(KNOWN, TIME_S, GAUGE_M)


def written(path, time_s, elevation):
    lines = [f"{t!r},{eta!r}\n" for t, eta in zip(time_s.tolist(), elevation.tolist(), strict=True)]
    path.write_text("time_s,elevation_m\n" + "".join(lines))
    return KEYS | {"waves.record": str(path), "waves.record_x_m": GAUGE_M}


def test_the_sea_is_the_record_at_its_gauge_and_travels_on(tmp_path):
    """But for the ends, because 600 s are no period of the known sea."""
    path = tmp_path / "gauge.csv"
    scene = load_scene("tethered_buoy", written(path, TIME_S, ELEVATION))
    for x, ends in ((GAUGE_M, 40), (GAUGE_M + 10.0, 200)):
        there = elevation_m(KNOWN, TIME_S, x)
        difference = (elevation_m(scene, TIME_S, x) - there)[ends:-ends]
        assert np.sqrt(np.mean(difference**2)) < 0.02 * there.std()
    path.unlink()  # the scene has what it needs
    assert scene_from_toml(scene.to_toml()) == scene


def test_a_record_lies_beside_the_scene_file_or_where_an_override_says(tmp_path, monkeypatch):
    """The place is not in the key of the scene: a folder may be moved, and its runs stay."""
    waves = {"period_s": 5.0, "record": "gauge.csv", "record_x_m": GAUGE_M}
    text, keys = tomli_w.dumps(KNOWN.as_dict() | {"waves": waves}), set()
    for name in ("here", "there"):
        folder = tmp_path / name
        folder.mkdir()
        written(folder / "gauge.csv", TIME_S, ELEVATION)
        (folder / "scene.toml").write_text(text)
        keys.add(load_scene(folder / "scene.toml").key())
    monkeypatch.chdir(tmp_path / "here")
    written(tmp_path / "there" / "gauge.csv", TIME_S, 0.5 * ELEVATION)
    keys.add(load_scene(tmp_path / "there" / "scene.toml", {"waves.record": "gauge.csv"}).key())
    assert len(keys) == 1


BROKEN = {
    "short": (TIME_S[:100], ELEVATION[:100], "at least 20 periods"),
    "gap": (np.delete(TIME_S, slice(50, 60)), np.delete(ELEVATION, slice(50, 60)), "from 19.25 to 22 s is a gap"),
    "trend": (TIME_S, ELEVATION + 0.01 * TIME_S, "no trend"),
    "millimetres": (TIME_S, 1e3 * ELEVATION, "in metres"),
    "coarse": (TIME_S[::8], ELEVATION[::8], "steps of at most 0.625 s"),
    "hole": (TIME_S, np.where(TIME_S == TIME_S[5], np.nan, ELEVATION), "elevation_m in line 7 is 'nan'"),
    "empty": (TIME_S[:0], ELEVATION[:0], "at least one row"),
    "uneven": (TIME_S + 0.05 * np.sin(TIME_S), ELEVATION, "uneven step"),
    "still": (TIME_S, 0.0 * ELEVATION, "not constant"),
    "slow": (TIME_S, np.sin(0.06 * TIME_S), "of its energy lies outside"),
    # 0.4^2/(1 + 0.4^2) of the energy has ten times the period
    "swell": (TIME_S, np.sin(0.4 * np.pi * TIME_S) + 0.4 * np.sin(0.04 * np.pi * TIME_S), "14 % of its energy"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_what_cannot_be_a_sea_is_refused_in_words(name, tmp_path):
    *columns, words = BROKEN[name]
    with pytest.raises(SceneError) as refusal:
        load_scene("tethered_buoy", written(tmp_path / "gauge.csv", *columns))
    assert len(refusal.value.faults) == 1 and words in str(refusal.value)
