"""The same run, finer: what it changes of a number is the error of that number."""

import engine.scene


def finer(scene, elements: int = 1, steps: int = 1, changes: dict | None = None):
    """The same scene, finer: with `elements` times the elements, and at 1/steps of its tolerance.

    Where the step is fixed, it is the step that is divided. changes: of other keys.
    """
    changes = dict(changes or {})
    if elements > 1:
        changes["tether.nodes"] = elements * (scene.tether.nodes - 1) + 1
    if steps > 1:
        step_s = scene.solver.step_s
        key, value = ("solver.step_s", step_s) if step_s else ("solver.rtol", scene.solver.rtol)
        changes[key] = value / steps
    return engine.scene.scene_from_toml(scene.to_toml(), changes)
