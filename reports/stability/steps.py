"""One-step maps and shares of a scene in the stability report."""

from __future__ import annotations

import numpy as np

from ..figures.scene_shares import scene_shares
from ..figures.step_maps import step_maps
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.wording import EMPTY, number
from .folder import Study


def map_items(study: Study) -> list[Item]:
    """A figure for each line and one table of all."""
    items: list[Item] = [
        Heading("Eigenvalues of one step"),
        Text(
            "The map from one step to the next is differenced about a state of rest, with all its unknowns: the "
            "conserved variables q and V of every node and their rates. A method multiplies a mode of rate λ by its "
            "stability function R(λ Δt). Taut, rates are imaginary and nothing may leave the unit circle, however long "
            "the step. Under compression rates are real, and what grows has to lie outside: a step of many e-folds "
            "damps what should grow, or lets it grow the wrong way round, in every implicit method. Steps that control "
            "their own length are held to two e-folds of the fastest buckle for this reason (`solver.growth_per_step`)."
        ),
    ]
    rows = []
    for line in study.maps.values():
        if "fault" in line:
            items.append(Text(f"A line could not be judged: {line['fault']}."))
            continue
        values = {name: np.array(entry["re"]) + 1j * np.array(entry["im"]) for name, entry in line["methods"].items()}
        largest = max(entry["largest"] for entry in line["methods"].values())
        seen = f"{line['title']}, steps of {number(line['step_s'], 3)} s; largest modulus {number(largest, 7)}"
        caption = (
            f"A line {seen}. Eigenvalues μ, dots: inside or on the unit circle; crosses: outside, those beyond the "
            "panel on its edge. From `step_maps.json`."
        )
        items.append(
            Figure(step_maps(values), caption, f"Eigenvalues in the complex plane beside the unit circle: {seen}.")
        )
        rows += [_row(line, name, entry) for name, entry in line["methods"].items()]
    columns = (
        Column("line", align="left"), Column("method", align="left"), Column("Δt", "s"), Column("largest |μ| − 1"),
        Column("distance from closed form"), Column("should grow"), Column("grow"),
    )  # fmt: skip
    caption = (
        "Eigenvalues by line and method. Distance: the largest of those of the closed form's eigenvalues R(λ Δt) from "
        "the nearest one found. Grow: how many modes should and do lie outside the unit circle. From `step_maps.json`."
    )
    return [*items, Table(columns, tuple(rows), caption, small=True)]


def _row(line: dict, name: str, entry: dict) -> tuple[str, ...]:
    excess = entry["largest"] - 1
    distance = f"{entry['distance']:.1e}" if "distance" in entry else EMPTY
    growing = (str(entry["growing"]), str(entry["growing_found"])) if "growing" in entry else (EMPTY, EMPTY)
    return line["title"], name, number(line["step_s"], 3), f"{excess:.1e}".replace("-", "−"), distance, *growing


def share_items(study: Study) -> list[Item]:
    """Operations and times of scenes with parts taken away and added."""
    scenes = study.shares["scenes"]
    names = list(scenes)
    operations = np.array([scenes[name]["newton"] for name in names], float)
    times = np.array([scenes[name]["us_per_newton"] for name in names])
    rows = tuple(
        (
            name,
            str(entry["newton"]),
            str(entry["functions"]),
            str(entry["output"]),
            number(entry["us_per_newton"], 3),
            number(entry["us_per_step"], 3),
            ", ".join(word for word in PARTS if word in entry["kernels"]) or EMPTY,
        )
        for name, entry in scenes.items()
    )
    columns = (
        Column("scene", align="left"), Column("operations"), Column("functions"), Column("output"),
        Column("iteration", "µs"), Column("step", "µs"), Column("kernels that only some scenes call", align="left"),
    )  # fmt: skip
    caption = (
        "Cost of the parts of a scene. Operations: floating-point ones of one Newton iteration on 41 nodes, functions: "
        "of them square roots, exponentials and the like; output: of one stored sample. Counted from the kernels' own "
        f"sources. Times: medians of {study.shares['rounds']} rounds in turns on one core. From `scene_shares.json`."
    )
    low, high = operations.min() / operations[0], operations.max() / operations[0]
    seen = f"from {number(low, 2)} to {number(high, 2)} of the first scene's operations"
    figure = Figure(
        scene_shares(names, operations, times),
        f"What each part of a scene costs: {seen}. Memory traffic and what all scenes share keep times closer together "
        "than operations. From `scene_shares.json`.",
        f"Bars of operations and time per Newton iteration for {len(names)} scenes: {seen}.",
    )
    return [Heading("What a scene does not need"), figure, Table(columns, rows, caption, small=True)]


PARTS = (
    "sweep_bent", "sweep_unbent", "sweep", "wave_field", "wave_field_3d", "current_field", "planar_current",
    "current_field_3d", "shock_tension", "rotation_vector",
)  # fmt: skip
