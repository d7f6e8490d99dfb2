"""Answers of basins, orbits and seas say the numbers of their tables, each with its error, and every caveat."""

import pytest

from campaigns.basins.answer import sentences as of_basins
from engine import load_scene

CALM = {"motion": "A", "status": "ok", "found_by": "rest", "tension_top_max_N": 4000.0, "confirmed": "on 81 nodes"}
WORST = CALM | {"motion": "B", "found_by": "grid", "tension_top_max_N": 9000.0}
SHOCK = {"motion": "B", "status": "ok", "size": 2.0, "kick_x_mps": 1.0, "kick_z_mps": 1.0, "nodes": 41}


def basins(worst):
    scene = load_scene("tethered_buoy", {"water.depth_m": 22.5})
    starts = [{"motion": letter, "status": "ok"} for letter in "AAB"]
    starts += [{"motion": "", "status": "ok", "outcome": "unsettled"}, {"motion": "", "status": "newton-failed"}]
    motions = [motion | {"regime": "period-1", "steepness": 0.13} for motion in (CALM, worst)]
    parts = {"motions": motions, "shock": [SHOCK, SHOCK | {"nodes": 81}], "edge": []}
    return "\n".join(of_basins(starts, ["vx", "vz"], scene, parts))


@pytest.mark.parametrize("confirmed", ["NOT on 81 nodes", "not settled on 81 nodes"])
def test_basins_name_the_dangerous_motion_what_leads_to_it_and_what_is_not_sure(confirmed):
    answer = basins(WORST | {"confirmed": confirmed})
    for words in (
        "kA = 0.13 and H = 22.5 m: A from rest (period-1, 4 kN) and B (period-1, 9 kN).",
        "Of 5 starts 2 end in A and 1 end in B; 1 had not settled, and 1 failed.",
        "B is the dangerous one: it pulls 2.2 times as hard as A.",
        "2 m/s along the waves, 45 degrees upwards is the smallest that leads to B",
        f"It depends on how it is computed: B is found {confirmed}.",
    ):
        assert words in answer
    assert "Each motion stays at a tenth of the tolerance" in basins(WORST)
    assert "A pulls hardest: no start of the grid leads to more" in basins(WORST | {"tension_top_max_N": 3000.0})
