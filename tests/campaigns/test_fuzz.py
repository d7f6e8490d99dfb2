"""Random scenes: a small part of what `campaigns.stability --fuzz` runs, and that its judge can tell a fault.

Laws: the same seed gives the same scenes; valid ones are accepted and then run, end with a reason, or are refused in
words, with finite numbers throughout; invalid ones are refused, every line naming a key and what is allowed.
"""

import os
import time
import tomllib
from functools import partial
from types import SimpleNamespace

import numba
import numpy as np
import pytest

from campaigns.stability import fuzz
from campaigns.stability.random_scenes import INVALID, VALID, drawn, faults_of, smallest
from engine.scene import build_scene, load_scene

SEED, COUNT = 20241, 300


@pytest.fixture(scope="module")
def valid():
    return drawn(VALID, SEED, COUNT)


def test_the_same_seed_gives_the_same_scenes_and_another_others():
    first = drawn(VALID, SEED, 3)
    assert first == drawn(VALID, SEED, 3) != drawn(VALID, SEED + 1, 3)
    assert all(map(build_scene, first))


@pytest.mark.slow
def test_valid_scenes_are_accepted_and_have_every_part_that_a_scene_may_have(valid):
    scenes = [build_scene(raw) for raw in valid]
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
        assert 0 < sum(bool(present(scene)) for scene in scenes) < COUNT


def test_invalid_scenes_are_refused_with_what_is_allowed():
    assert {fuzz.refuse_invalid(raw)[0] for raw in drawn(INVALID, SEED, 60)} == {"refused"}


def changed(raw):
    """The sections, and keys of them, in which a scene differs from the shipped one with its name."""

    def leaves(entry, path=()):
        if isinstance(entry, dict):
            return {leaf for key, value in entry.items() for leaf in leaves(value, (*path, key))}
        return {(path, repr(entry))}

    return {path[:2] for path, _ in leaves(raw) ^ leaves(tomllib.loads(load_scene(raw["name"]).to_toml()))}


@pytest.mark.slow
def test_what_is_unsound_is_shrunk():
    found = smallest(VALID, SEED, COUNT, lambda raw: "current" in raw)
    assert "current" in found and not faults_of(found)
    assert {key for section, key in changed(found) if section != "current"} == {"nodes"}
    assert smallest(VALID, SEED, 10, lambda raw: False) is None


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
    ("text", "outcome"),
    [("output.step_s: given 0; allowed: > 0", "refused"), ("must have different signs", "traceback")],
)
def test_an_error_is_a_refusal_only_where_it_names_a_key_and_what_is_allowed(monkeypatch, text, outcome):
    def raises(*_, **__):
        raise ValueError(text)

    monkeypatch.setattr("engine.simulate", raises)
    assert fuzz.judged(VALID, drawn(VALID, SEED, 1)[0])["outcome"] == outcome


@pytest.mark.parametrize(
    ("call", "way", "said"),
    [
        pytest.param(partial(time.sleep, 60), fuzz.LATE, "0.5 s", marks=pytest.mark.slow),
        (partial(os._exit, 3), fuzz.DIED, "3"),
        (lambda: 1 / 0, fuzz.RAISED, "ZeroDivisionError"),
        (lambda: "it is " + "done", fuzz.DONE, "done"),
    ],
)
def test_a_call_that_does_not_return_is_ended_and_one_that_dies_is_seen(call, way, said):
    found, answer, wall_s = fuzz.limited(call, 0.5)
    assert found == way and said in answer and wall_s < 5


@pytest.mark.slow
def test_machine_code_that_does_not_return_is_ended_too():
    @numba.njit
    def forever():
        x = 0.0
        while x < 1.0:
            x *= 0.5
        return x

    assert fuzz.limited(forever, 3.0)[0] == fuzz.LATE
