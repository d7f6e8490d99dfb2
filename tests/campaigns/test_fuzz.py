"""Random scenes: a small seeded part of what `campaigns.stability --fuzz` runs, and that its judge can tell a fault.

Laws: the same seed and number give the same scene; valid ones are accepted and then run, end with a reason, or are
refused in words, with finite numbers throughout; invalid ones are refused, every line naming a key and what is allowed.
"""

from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest

from campaigns.stability import fuzz, limited
from campaigns.stability.fuzz.faults import extreme_scene, faults_of
from campaigns.stability.fuzz.scenes import plain_scene
from engine.scene import build_scene

SEED = 20240


@pytest.mark.slow
@pytest.mark.parametrize("number", range(30))
def test_a_valid_scene_is_answered(number):
    row = fuzz.judge_valid(SEED, number)
    assert row["outcome"] in fuzz.SOUND, row
    assert row["outcome"] == "ok" or len(row["message"]) > 40


def test_invalid_scenes_are_refused_with_what_is_allowed():
    for number in range(150):
        lines = faults_of(fuzz.invalid_case(SEED, number))
        assert lines
        for line in lines:
            assert fuzz.CLEAR.match(line) and len(line) <= 400, line


def test_the_same_seed_gives_the_same_scene_and_another_another():
    again = [fuzz.valid_case(SEED, 7) for _ in range(2)]
    assert again[0] == again[1] != fuzz.valid_case(SEED + 1, 7)


def test_random_scenes_reach_every_part_of_a_scene():
    scenes = [build_scene(fuzz.valid_case(SEED, number)[0]) for number in range(300)]
    assert {scene.end.kind for scene in scenes} == {"buoy", "held", "free"}
    assert {scene.motion.dimensions for scene in scenes} == {2, 3}
    assert {scene.tether.tension.law for scene in scenes} == {"linear", "tanh", "tabulated"}
    assert {scene.solver.scheme for scene in scenes} == {"conservation", "paper-box"}
    assert {scene.current.law for scene in scenes if scene.current} == {"uniform", "profile", "table"}
    assert len({scene.solver.integrator for scene in scenes}) == 5
    for present in (
        lambda s: s.waves, lambda s: s.end.motion, lambda s: s.end.release_s, lambda s: s.end.force_decay_s,
        lambda s: s.solver.shock_viscosity, lambda s: s.solver.courant, lambda s: s.output.tangent_vectors,
        lambda s: s.output.profiles, lambda s: s.anchor.rotation == "clamped", lambda s: s.tether.grid_stretching,
    ):  # fmt: skip
        assert 5 < sum(bool(present(scene)) for scene in scenes) < 295


def test_an_extreme_scene_is_still_valid_and_differs():
    rng = np.random.default_rng(3)
    raw = plain_scene(rng)
    other = extreme_scene(rng, raw)
    assert other != raw and not faults_of(other)


def made(status="ok", message="", samples=11, spoil=None):
    """A finished run as far as its judge looks at it: one second in samples of 0.1 s."""
    columns = {"time_s": np.arange(samples) * 0.1, "radius_m": np.ones(samples)}
    if spoil is not None:
        columns["radius_m"][3] = spoil
    scene = SimpleNamespace(sample_step_s=lambda: 0.1)
    return SimpleNamespace(columns=columns, profiles=None, status=status, message=message, scene=scene)


@pytest.mark.parametrize(
    ("run", "outcome"),
    [
        (made(), "ok"),
        (made(samples=10), "incomplete"),
        (made(spoil=np.nan), "not-finite"),
        (made(spoil=-np.inf, status="newton-failed", message="why"), "not-finite"),
        (made(status="newton-failed", message="why", samples=4), "ended"),
        (made(status="newton-failed", samples=4), "silent"),
    ],
)
def test_the_judge_tells_a_fault_from_an_answer(run, outcome):
    assert fuzz.outcome_of(run, 1.0)[0] == outcome


@pytest.mark.parametrize(
    ("error", "outcome"),
    [
        ("output.step_s: given 0; allowed: > 0", "refused"),
        ("f(a) and f(b) must have different signs", "traceback"),
        ("", "traceback"),
    ],
)
def test_an_error_is_a_refusal_only_where_it_names_a_key_and_what_is_allowed(error, outcome, monkeypatch):
    def raises(raw, length_s):
        raise ValueError(error)

    monkeypatch.setattr(fuzz, "_run", raises)
    monkeypatch.setattr(fuzz, "load_kernels", lambda: None)
    assert fuzz.judge_valid(SEED, 2)["outcome"] == outcome


def test_a_call_that_does_not_return_is_ended_and_one_that_dies_is_seen():
    import os
    import time

    kind, _, wall_s = limited.limited(lambda: time.sleep(60), 0.3)
    assert kind == limited.LATE and wall_s < 5
    assert limited.limited(lambda: os._exit(3), 10)[:2] == (limited.DIED, 3)
    kind, (name, text, trace), _ = limited.limited(lambda: 1 / 0, 10)
    assert (kind, name, text) == (limited.RAISED, "ZeroDivisionError", "division by zero") and "1 / 0" in trace
    assert limited.limited(lambda: np.arange(3).sum(), 10)[:2] == (limited.DONE, 3)


@pytest.mark.slow
def test_machine_code_that_does_not_return_is_ended_too():
    import numba

    @numba.njit
    def forever():
        x = 0.0
        while x < 1.0:
            x *= 0.5
        return x

    assert limited.limited(forever, 3.0)[0] == limited.LATE


@pytest.mark.slow
def test_two_hundred_of_each():
    valid = [fuzz.judge_valid(SEED + 1, number) for number in range(200)]
    invalid = [fuzz.judge_invalid(SEED + 1, number) for number in range(200)]
    assert [row for row in valid if row["outcome"] not in fuzz.SOUND] == []
    assert {row["outcome"] for row in invalid} == {"refused"}
    counts = Counter(row["outcome"] for row in valid)
    assert counts["ok"] > 80 and counts["ended"] > 20
