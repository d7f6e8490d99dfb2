"""`campaigns.basins`: a grid of starts, the smallest one that leads to a motion, and the same motion at every phase."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from analysis import joins, settled
from campaigns import basins
from campaigns.basins import edge, main
from campaigns.basins.answer import _shock, sentences
from campaigns.basins.grid import PAIRS, StartGrid
from campaigns.basins.shocks import SHARP, Shock, smallest
from campaigns.explore.starts import KICKS, Start, section_of
from engine import load_scene, simulate, simulate_each
from engine.physics.waves import wave_number
from engine.scene import scene_from_toml
from reports.basins.report import report
from reports.parts.content import Figure, Table
from tables import PEAK
from tests.campaigns.conftest import finished, order_of, ran, rows_of
from tests.reports.conftest import of_kind

COARSE = {"tether.nodes": 9, "water.depth_m": 22.5}
QUICK = ["--set", "tether.nodes=9", "water.depth_m=21", "waves.amplitude_m=0.3", "--grid", "3", "--kick-speed", "1"]


@pytest.mark.parametrize("pair", PAIRS)
def test_a_turn_and_a_size_are_the_start_of_that_point(pair):
    grid = StartGrid(tuple(pair.split()), (7, 12), 3.0)
    names = {column.name for column in KICKS}
    for point in grid.points():
        from_point, back = grid.start(*point).labels(), grid.at(*grid.polar(*point), "").labels()
        assert from_point.keys() == back.keys() and names & from_point.keys()
        assert all(from_point[name] == pytest.approx(back[name], abs=1e-12) for name in names & from_point.keys())


def test_the_first_starts_of_a_grid_are_spread_over_it():
    grid = StartGrid(("vx", "vz"), (12, 12), 6.0)
    order = list(grid.spread(1))
    assert sorted(order) == list(range(144))
    quarters = {(grid.points()[number][0] > 0.0, grid.points()[number][1] > 0.0) for number in order[:8]}
    assert len(quarters) == 4


@pytest.mark.parametrize("centre", [(3.0, 0.4), (-1.0, -2.5), (0.2, 4.0)])
def test_the_smallest_start_is_the_nearest_point_of_a_disc(centre):
    """Along a ray to SHARP of its size, and between rays by as much as a last step gains."""
    radius, tried = 0.8, []

    def leads(starts):
        tried.extend(starts)
        places = [(size * math.cos(turn), size * math.sin(turn)) for turn, size in starts]
        return [math.dist(place, centre) <= radius for place in places]

    far = Shock(math.atan2(centre[1] + 0.5, centre[0]), math.hypot(centre[0], centre[1] + 0.5), 0.0)
    least, nearest = smallest(leads, far, 2.0 * math.pi), math.hypot(*centre) - radius
    assert leads([(least.turn, least.size)]) == [True] and leads([(least.turn, least.below)]) == [False]
    assert least.below >= (1.0 - SHARP) * least.size
    assert nearest <= least.size <= (1.0 + 2.5 * SHARP) * nearest
    assert len(tried) < 400


@pytest.mark.parametrize(
    ("across", "shock", "way"),
    [
        ("vx phase", {"kick_x_mps": -2.0, "crest": 0.25}, "against the waves, 0.25 T before a crest"),
        ("vz phase", {"kick_z_mps": 2.0, "crest": 0.5}, "upwards, 0.50 T before a crest"),
        ("vx vz", {"kick_x_mps": -1.0, "kick_z_mps": -1.0}, "against the waves, 45 degrees downwards"),
        ("x z", {"displacement_x_m": 0.01, "displacement_z_m": 1.0}, "upwards"),
    ],
)
def test_the_smallest_start_is_told_with_its_way(across, shock, way):
    row = shock | {"status": "ok", "size": 2.0, "motion": "B", "nodes": 81}
    unit = "m" if "x" in across.split() else "m/s"
    turned = {name: -value if "_x_" in name else value for name, value in row.items()}
    for shock_in_waves, along in ((row, 1.0), (turned, -1.0)):
        sentence = _shock([shock_in_waves, shock_in_waves | {"size": 2.1}], across.split(), along)
        assert sentence == f"The smallest start that leads to B is 2 {unit} {way}; on 81 nodes 2.1 {unit} {way}."


def test_runs_that_part_twice_as_far_every_wave_leave_the_edge_by_a_bit_a_wave(tmp_path, monkeypatch):
    """They go on until they are APART, and the edge is followed over MOST waves by many such stretches."""
    distances = edge.NEAR * 2.0 ** np.arange(12.0)
    together = np.count_nonzero(distances <= edge.APART) - 1
    columns = {"radius_m": np.ones(8), edge.TOP: np.ones(8)}
    fake = SimpleNamespace(narrow=lambda: distances, go_on=lambda periods: (SimpleNamespace(columns=columns), "key"))
    monkeypatch.setattr(edge, "Edge", lambda *_: SimpleNamespace(**vars(fake), scale=np.ones(4)))
    monkeypatch.setattr(edge, "section_of", lambda run: (np.zeros((together + 1, 4)),))
    motions = [SimpleNamespace(branch=SimpleNamespace(letter=letter)) for letter in "AB"]
    row = edge.edge_state(SimpleNamespace(plan=SimpleNamespace(out=tmp_path)), *motions)
    assert row["growth_bits_per_period"] == pytest.approx(1.0) and row["strobed_period"] == 1
    assert (row["status"], row["periods"]) == ("ok", together * math.ceil(edge.MOST / together))


def test_a_crest_is_one_over_the_anchor():
    """A mooring a tenth of a wave length down the waves meets the same crest a tenth of a period later."""
    base = load_scene("tethered_buoy", {"waves.steepness": 0.1})
    length_m = 2.0 * math.pi / wave_number(base.waves.period_s, base.water.depth_m, base.gravity_mps2)
    scene = scene_from_toml(base.to_toml(), {"anchor.position_m": [0.1 * length_m, 0.0, 0.0]})
    shock = {"status": "ok", "size": 2.0, "motion": "B", "nodes": 81.0, "kick_x_mps": 2.0, "phase_rad": 0.5 * math.pi}
    motion = {"status": "ok", "motion": "A", "regime": "period-1", PEAK: 2e3, "steepness": 0.1, "confirmed": ""}
    starts = [{"status": "ok", "motion": "B", "kick_x_mps": 2.0, "phase_rad": 0.0}]
    words = {}
    for place in (base, scene):
        parts = {"motions": [motion, motion | {"motion": "B", PEAK: 9e3}], "shock": [shock, shock], "edge": []}
        words[place] = " ".join(sentences(starts, ["vx", "phase"], place, parts))
    assert "0.25 T before a crest" in words[base] and "at 0 T 2 m/s" in words[base]
    assert "0.35 T before a crest" in words[scene] and "at 0.1 T 2 m/s" in words[scene]


def test_a_motion_started_at_another_phase_is_the_same():
    """Strobed at the phase of the wave, and its last state is one of the scene from rest."""
    base = load_scene("tethered_buoy", COARSE)
    phases = [None, math.pi, 2.0 * math.pi * 17 / 24]
    scenes = [Start("", phase=phase).scene(base) for phase in phases]
    lengths = [66 + share for share in (0.0, 0.5, 17 / 24)]
    runs = [run for _, run in sorted(simulate_each(scenes, periods=lengths), key=lambda pair: pair[0])]
    strobed, measures, scale = section_of(runs[0])
    known = settled(strobed, measures, scale=scale)
    for run in runs[1:]:
        assert joins(*section_of(run)[:2], [known]) == 0
        state = run.final_state.at_zero()
        often = round(run.scene.waves.period_s / run.scene.sample_step_s())  # with as many samples the clock goes on
        on = simulate(Start("", state=state, often=often).scene(base), periods=2, start=state)
        distance = np.abs((section_of(on)[0][:, None] - known.points) / scale).max(axis=2)
        assert known.period == 2 and distance.min(axis=1).max() < 0.02


def test_a_scene_with_one_motion(tmp_path):
    rows, (motion,) = ran(basins, tmp_path, *QUICK), rows_of(tmp_path, "motions/table.csv")
    assert [(row["kick_x_mps"], row["kick_z_mps"]) for row in rows[:4]] == [
        ("-1.0", "-1.0"), ("0.0", "-1.0"), ("1.0", "-1.0"), ("-1.0", "0.0"),
    ]  # fmt: skip
    assert {(row["motion"], row["status"]) for row in rows} == {("A", "ok")} and len(rows) == 9
    assert (motion["share"], motion["found_by"], motion["regime"]) == ("1.0", "rest", "period-1")
    kA = 0.3 * wave_number(5.0, 21.0, 9.81)
    assert float(motion["steepness"]) == pytest.approx(kA, rel=1e-9)
    assert motion["confirmed"].endswith(f"checked at {kA:.4g}")
    assert not (tmp_path / "shock").exists() and not (tmp_path / "edge").exists()
    earlier = finished(tmp_path / "starts") | finished(tmp_path / "motions")
    assert ran(basins, tmp_path, *QUICK) == rows
    assert finished(tmp_path / "starts") | finished(tmp_path / "motions") == earlier
    items = report(tmp_path).items
    assert of_kind(items, Figure) and of_kind(items, Table)


def test_a_grid_of_velocity_and_phase_has_every_pair():
    order = order_of(basins, "--across", "vx", "phase", "--grid", "5", "8", "--out", "new")
    assert order.options.grid.counts == (5, 8) and len(order.options.grid.points()) == 40
    assert order.options.grid.values(1)[2] == pytest.approx(0.5 * math.pi)


@pytest.mark.slow
def test_the_period_3_at_25_m(tmp_path):
    """On 41 nodes 16 of 49 kicks of up to 6 m/s lead to it, 5623 N; period 1 from rest, 4197 N (161: 5624, 4199 N)."""
    words = ["--set", "water.depth_m=25", "tether.nodes=21", "--grid", "5", "--no-report", "--out", str(tmp_path)]
    assert main(words) == 0
    rest, island = rows_of(tmp_path, "motions/table.csv")
    assert (rest["regime"], island["regime"]) == ("period-1", "period-3")
    assert float(rest["tension_top_max_N"]) == pytest.approx(4197.0, abs=5.0)
    assert float(island["tension_top_max_N"]) == pytest.approx(5623.0, abs=5.0)
    assert float(island["share_low"]) < 16 / 49 < float(island["share_high"])
    coarse, fine = rows_of(tmp_path, "shock/table.csv")
    assert float(fine["size"]) == pytest.approx(float(coarse["size"]), rel=0.05)
    (edge,) = rows_of(tmp_path, "edge/table.csv")
    assert (edge["status"], edge["strobed_period"]) == ("ok", "3")
    assert 4197.0 < float(edge["tension_top_max_N"]) < 5623.0 and float(edge["growth_bits_per_period"]) > 0.0
    assert len((tmp_path / "answer.txt").read_text().splitlines()) <= 8
