"""Law: a run that goes on from the final state of another is the run that did not stop, to the last bit."""

import numpy as np
import pytest

from engine import Trajectory, simulate, simulate_each
from tests.engine.lines import SEA, assert_same, kick, line
from tests.engine.physics.caps import CAP

SMALL = {"tether.nodes": 9, "waves.steepness": 0.06, "water.depth_m": 22.5}
CARRIED = {"output.tangent_vectors": 2, "output.lateral_growth": True}
RELEASES = {"tether.nodes": 21, "waves.steepness": 0.13, "water.depth_m": 21.0}  # loops, at 12.6 and 18.6 periods
KINDS = {
    "plane": SMALL,
    "carried": {**SMALL, **CARRIED},
    "profiles, samples closer than steps": {
        **SMALL,
        "output.profiles": True,
        "output.profiles_step_s": 0.7,
        "output.step_s": 0.0125,
    },
    "space": {**SMALL, "motion.dimensions": 3, **kick(v=1e-3)},
    "fixed steps": {**SMALL, "solver.integrator": "generalized-alpha", "solver.step_s": 0.02},
    "a sea": {**SMALL, **SEA},
    "a sea, in and out of the water": {**SMALL, **SEA, **CAP, "output.tangent_vectors": 1},
    "loop releases": {**RELEASES, **CARRIED},
    "loop releases in space": {**RELEASES, "motion.dimensions": 3},
}
PARTS = (3.5, 2.0, 4.5)  # wave periods; the first ends within a period of growth
LONGER = (11.5, 2.0, 5.5)  # with a loop release in each of the last two


def parts_of(scene, lengths):
    """Runs of these lengths, each from the end of the one before."""
    parts = []
    for length in lengths:
        parts.append(simulate(scene, periods=length, start=parts[-1] if parts else None))
    return parts


def assert_continues(uninterrupted, parts):
    joined = parts[0]
    for part in parts[1:]:
        joined = joined.followed_by(part)
    assert_same(joined, uninterrupted)


@pytest.mark.parametrize("kind", KINDS)
def test_parts_make_the_whole(kind):
    scene = line(KINDS[kind])
    lengths = LONGER if "releases" in kind else PARTS
    uninterrupted = simulate(scene, periods=sum(lengths))
    assert uninterrupted.status == "ok"
    parts = parts_of(scene, lengths)
    assert_continues(uninterrupted, parts)
    released = [part.statistics["loop_releases"] for part in parts]
    assert released == ([0, 1, 1] if "releases" in kind else [0, 0, 0])
    assert not any(part.began for part in parts)


def test_a_hundred_restarts():
    scene = line(RELEASES)
    uninterrupted = simulate(scene, periods=20)
    assert uninterrupted.statistics["loop_releases"] >= 2
    assert_continues(uninterrupted, parts_of(scene, (0.2,) * 100))


@pytest.mark.parametrize("of, lengths", [(SMALL, PARTS), (RELEASES, LONGER)], ids=["calm", "loop releases"])
def test_in_lanes_too_and_through_files(tmp_path, of, lengths):
    shares = (1 / 3, 2 / 3, 1.0)
    scenes = [line({**of, **CARRIED, "waves.steepness": share * of["waves.steepness"]}) for share in shares]
    parts, starts = [[], [], []], None
    for number, length in enumerate(lengths):
        for i, part in simulate_each(scenes, periods=length, starts=starts):
            part.save(tmp_path / f"{i}{number}.nc")
            parts[i].append(Trajectory.load(tmp_path / f"{i}{number}.nc"))
        starts = [tmp_path / f"{i}{number}.nc" for i in range(3)]
    for scene, pieces in zip(scenes, parts, strict=True):
        uninterrupted = simulate(scene, periods=sum(lengths))
        assert_continues(uninterrupted, pieces)
        assert pieces[-1].final_state.digest() == uninterrupted.final_state.digest()


def test_a_run_that_ends_goes_on_among_the_others_as_long_as_somebody_says():
    """To other lengths, and from its sixth period on with perturbations."""
    steepness, lengths, shares = (0.02, 0.04, 0.06), (3, 9, 6), []
    pieces: dict[int, Trajectory] = {}

    def then(number, part):
        pieces[number] = pieces[number].followed_by(part) if number in pieces else part
        periods = round(pieces[number].columns["time_s"][-1] / part.scene.waves.period_s)
        perturbations = CARRIED if periods >= 6 else {}
        return (line({**SMALL, **perturbations, **kA[number]}), 3, part) if periods < lengths[number] else None

    kA = [{"waves.steepness": value} for value in steepness]
    scenes = [line({**SMALL, **value}) for value in kA]
    assert len(list(simulate_each(scenes, periods=[3, 3, 3], progress=shares.append, then=then))) == 6
    assert all(0.0 <= share <= 1.0 for share in shares) and shares[-1] == 1.0
    for scene, length, run in zip(scenes, lengths, pieces.values(), strict=True):
        assert np.array_equal(simulate(scene, periods=length).columns["radius_m"], run.columns["radius_m"])
    growth = pieces[1].tangent.growth_nats
    assert np.isnan(growth[:6]).all() and np.isfinite(growth[6:]).all() and pieces[0].tangent is None
