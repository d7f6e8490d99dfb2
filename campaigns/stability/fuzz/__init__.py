"""Random scenes against the engine: what each does, in one word and one line (`campaigns.stability --fuzz N`).

valid scenes: "ok"; "ended" (a status with its reason; finite samples up to there); "refused" (ValueError that names a
key and what is allowed).
invalid scenes: "refused", every line naming a key and what is allowed.
Anything else is a fault of the program: "hang" (over the time limit), "crash" (its process died), "traceback",
"not-finite", "incomplete" (ok, but samples are missing), "silent" (ended without a reason), "accepted" (an invalid
scene), "unclear" (a message without a key or without what is allowed).
"""

import re
from functools import cache

import numpy as np

from campaigns.stability.fuzz import faults, scenes
from campaigns.stability.limited import DIED, DONE, LATE, limited

LIMIT_S = 60.0
SOUND = ("ok", "ended", "refused")
SAMPLES, LENGTH_S = 40, 1.0  # a run lasts for so many output samples, or for so long ...
STEPS = 1e4  # ... and for no more of the longest steps: what is asked for has to be possible in the time limit
CLEAR = re.compile(r"^.+: .*(allowed|unknown key|which law = .* does not have)", re.DOTALL)


def valid_case(seed: int, number: int) -> tuple[dict, float]:
    """(scene as nested dicts, run length in s) of a valid scene."""
    rng = np.random.default_rng([seed, 1, number])
    raw = scenes.plain_scene(rng)
    if number % 2:
        raw = faults.extreme_scene(rng, raw)
    from engine.scene import build_scene
    from engine.scene.size_limits import longest_step

    scene = build_scene(raw)
    asked_s = LENGTH_S if scenes.maybe(rng, 0.2) else SAMPLES * scene.sample_step_s()
    return raw, min(asked_s, STEPS * longest_step(scene)[1])


def invalid_case(seed: int, number: int) -> dict:
    """A scene with faults, as nested dicts."""
    rng = np.random.default_rng([seed, 2, number])
    raw = scenes.plain_scene(rng)
    return faults.faulty_scene(rng, raw)


@cache
def load_kernels() -> None:
    """Load all machine code, of a plane and of space, once in a process: a fork of it then has nothing to load."""
    from engine import load_scene, simulate

    carried = {"output.tangent_vectors": 1, "output.lateral_growth": True, "tether.nodes": 5}
    for changes in ({"motion.dimensions": 3}, carried):
        simulate(load_scene("tethered_buoy", changes), duration_s=5.05)


def judge_invalid(seed: int, number: int) -> dict[str, object]:
    """What the engine says of an invalid scene: {"number", "outcome", "status", "message", "wall_s"}."""
    raw = invalid_case(seed, number)
    kind, answer, wall_s = limited(lambda: faults.faults_of(raw), LIMIT_S)
    outcome, message = _unsound(kind, answer)
    if kind == DONE:
        unclear = [line for line in answer if not CLEAR.match(line) or len(line) > 400]
        outcome = "unclear" if unclear else "refused" if answer else "accepted"
        message = "; ".join(unclear or answer)
    return {"number": number, "outcome": outcome, "status": "", "message": message, "wall_s": wall_s}


def judge_valid(seed: int, number: int) -> dict[str, object]:
    """What the engine makes of a valid scene, as `judge_invalid`; status is that of the run."""
    load_kernels()
    raw, length_s = valid_case(seed, number)
    kind, answer, wall_s = limited(lambda: _run(raw, length_s), LIMIT_S)
    outcome, message = _unsound(kind, answer)
    status = ""
    if kind == DONE:
        outcome, status, message = answer
    return {"number": number, "outcome": outcome, "status": status, "message": message, "wall_s": wall_s}


def _unsound(kind: str, answer: object) -> tuple[str, str]:
    if kind == LATE:
        return "hang", f"no answer within {LIMIT_S:g} s of computing"
    if kind == DIED:
        return "crash", f"its process ended with exit code {answer}"
    if kind == DONE:
        return "", ""
    name, text, trace = answer
    if name == "ValueError" and CLEAR.match(text):
        return "refused", text
    return "traceback", trace


def _run(raw: dict, length_s: float) -> tuple[str, str, str]:
    from engine import simulate
    from engine.scene import build_scene

    scene = build_scene(raw)
    run = simulate(scene, duration_s=length_s)
    return outcome_of(run, length_s)


def outcome_of(run, length_s: float) -> tuple[str, str, str]:
    """(outcome, status, message) of a finished run of that length."""
    arrays = [*run.columns.values()]
    if run.profiles is not None:
        lines = run.profiles
        arrays += [lines.x_m, lines.y_m, lines.z_m, lines.strain, lines.tension_N, lines.speed_mps]
    if not all(np.isfinite(array).all() for array in arrays):
        return "not-finite", run.status, run.message
    if run.status == "ok":
        missing = len(run.columns["time_s"]) != int(length_s / run.scene.sample_step_s() * (1 + 1e-12) + 1e-9) + 1
        return ("incomplete" if missing else "ok"), run.status, run.message
    return ("ended" if run.message else "silent"), run.status, run.message
