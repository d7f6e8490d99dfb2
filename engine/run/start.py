"""What a run begins in, where it does not begin at rest: the final state of another run, taken over into its scene.

Changes of `solver` and `output` leave the state as it is; after any other the run goes on by small steps. What becomes
of a state on another grid or in space, and what lies between two states, is in `engine.run.going_on`.
"""

from dataclasses import replace
from pathlib import Path

from ..scene.models import Scene
from ..trajectory import Trajectory
from ..trajectory.final_state import NONE, FinalState
from .going_on import in_space, on_grid_of, same_grid

Start = Trajectory | FinalState | str | Path | None  # the run, its final state, or its file; None: from rest
NO_CHANGE = ("name", "title", "start", "output")  # of the motion, once it goes on


def checked_start(scene: Scene, start: Start) -> FinalState | None:
    """The state to start from. Raises ValueError for one that a run of this scene cannot go on from."""
    if start is None:
        return None
    if isinstance(start, str | Path):
        start = Trajectory.load(start)
    state = start.final_state if isinstance(start, Trajectory) else start
    if state is None:
        fault = "a run without a final state: it ended early, kept energies, or is of the paper's own scheme"
    elif isinstance(state, FinalState):
        fault = fault_of(state, scene)
    else:
        fault = f"{state!r}; allowed: a Trajectory, its final_state, or its file"
    if fault:
        raise ValueError(f"start: given {fault}")
    return state


def fault_of(state: FinalState, scene: Scene) -> str:
    """Why a run of `scene` cannot go on from the state, as the end of a sentence; empty where it can."""
    if scene.solver.scheme == "paper-box" or scene.output.energy:
        return "a scene with solver.scheme = 'paper-box' or output.energy, which can only start from rest"
    if fault := state.fault():
        return fault
    if scene.motion.dimensions < state.scene.motion.dimensions:
        return "a state in 3 dimensions for a scene in 2: what lies across the plane would be lost"
    for key in ("kind", "position_m"):
        old, new = getattr(state.scene.end, key), getattr(scene.end, key)
        if old != new:
            return f"a state of a line with end.{key} = {old!r} for a scene with {new!r}: the end is another"
    return ""


def taken_over(state: FinalState | None, scene: Scene) -> tuple[FinalState | None, str]:
    """The state from which a run of `scene` goes on, and in words what was changed for it; "" where nothing was.

    The clock starts at 0 where the period of the waves or the step of the output is another. `fault_of` tells what
    cannot be taken over.
    """
    if state is None:
        return None, ""
    begin_s, changed = state.time_s, changes(state.scene, scene)
    words = [f"{key} {_word(old)} -> {_word(new)}" for key, (old, new) in changed.items()]
    other_samples = state.scene.sample_step_s() != scene.sample_step_s()
    if other_samples or "waves.period_s" in changed:
        words.append("the clock starts at 0")
        state = state.at_zero(with_samples=not other_samples)
    if state.scene.profile_step_s() != scene.profile_step_s():
        state = replace(state, profiles=NONE)
    if state.scene.motion.dimensions < scene.motion.dimensions:
        state = in_space(state, scene)
    if not same_grid(state.scene, scene):
        state = on_grid_of(scene, state)
        words.append("the state is interpolated")
    state = replace(state, scene=scene)
    if any(not key.startswith(("solver.", "output.")) for key in changed):
        state = state.restarted()
    return state, f"went on at t = {begin_s:.6g} s; changed: {', '.join(words)}" if words else ""


def changes(earlier: Scene, later: Scene) -> dict[str, tuple[object, object]]:
    """Key -> old and new value of what is not the same; of `output` only the step, and nothing of `start`."""
    old, new = (_by_key(scene.model_dump(mode="json", exclude=set(NO_CHANGE))) for scene in (earlier, later))
    changed = {key: (old.get(key), new.get(key)) for key in old | new if old.get(key) != new.get(key)}
    steps = earlier.sample_step_s(), later.sample_step_s()
    if steps[0] != steps[1] and "waves.period_s" not in changed:
        changed["output.step_s"] = steps
    return changed


def _by_key(values: dict[str, object], above: str = "") -> dict[str, object]:
    """Values by dotted key; absent ones left out."""
    by_key = {}
    for name, value in values.items():
        if isinstance(value, dict):
            by_key |= _by_key(value, f"{above}{name}.")
        elif value is not None:
            by_key[above + name] = value
    return by_key


def _word(value: object) -> str:
    """A value in the words of what was changed: short."""
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    if value is None:
        return "none"
    return text if len(text) <= 40 else "another list"
