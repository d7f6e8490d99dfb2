"""Random scenes: a valid one runs to its end, ends with a reason, or is refused in words; its numbers are finite.

An invalid one is refused, and every line names a key and says what is allowed. Hypothesis shrinks what breaks a law.
"""

import re

import pytest
from hypothesis import HealthCheck, given, settings

import engine
from campaigns.stability.limits import DONE, limited, load_kernels, outcome_of
from engine.parameters.limits import longest_step
from engine.scene import build_scene
from tests.engine.random_scenes import faults_of, invalid_scene, valid_scene

LIMIT_S = 60.0
SAMPLES, STEPS = 40, 3e3  # of a run at most; longest steps that it lasts at most, because the time is limited
CLEAR = re.compile(r"^.+: .*(allowed|unknown key|which law = .* does not have)", re.DOTALL)
LONGEST_LINE = 400


def examples(count):
    checks = list(HealthCheck)
    return settings(max_examples=count, deadline=None, database=None, derandomize=True, suppress_health_check=checks)


@examples(60)
@given(invalid_scene())
def test_an_invalid_scene_is_refused_with_what_is_allowed(raw):
    lines = faults_of(raw)
    assert lines
    assert all(CLEAR.match(line) and len(line) <= LONGEST_LINE for line in lines), lines


def outcome(raw):
    """What becomes of a valid scene: "ok", "ended" or "refused", or the word for a fault."""
    scene = build_scene(raw)
    length_s = min(SAMPLES * scene.sample_step_s(), STEPS * longest_step(scene)[1])
    try:
        run = engine.simulate(scene, duration_s=length_s)
    except ValueError as error:
        return "refused" if CLEAR.match(str(error)) else f"a reason that is not clear: {error}"
    return outcome_of(run, length_s)


@pytest.mark.slow
@examples(100)
@given(valid_scene())
def test_a_valid_scene_runs_or_ends_with_a_reason_or_is_refused_in_words(raw):
    load_kernels()
    way, answer, _ = limited(lambda: outcome(raw), LIMIT_S)
    assert way == DONE, answer
    assert answer in ("ok", "ended", "refused")
