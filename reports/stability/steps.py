"""One-step maps and shares of a scene in the stability report."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..figures.scene_shares import scene_shares
from ..figures.step_maps import step_maps
from ..parts.content import Column, Figure, Heading, Item, Table, Text
from ..parts.wording import EMPTY, decimals, number
from .folder import Study


def map_items(study: Study) -> Iterator[Item]:
    """A figure for each line and one table of all."""
    yield Heading("Eigenvalues of one step")
    yield Text(
        "The map from one step to the next is differenced about a state of rest, with all its unknowns: the conserved "
        "variables q and V of every node and their rates. A method multiplies a mode of rate λ by its stability "
        "function R(λ Δt). In a taut line the rates are imaginary and no eigenvalue may leave the unit circle, however "
        "long the step. Under compression the rates are real, and the modes that grow must have eigenvalues outside: a "
        "step of many e-folds damps them instead, in every implicit method. Steps that control their own length are "
        "held to two e-folds of the fastest buckle for this reason (`solver.growth_per_step`)."
    )
    rows = []
    for line in study.maps.values():
        values = {name: np.array(entry["re"]) + 1j * np.array(entry["im"]) for name, entry in line["methods"].items()}
        step, largest = number(line["step_s"], 3), max(entry["largest"] for entry in line["methods"].values())
        seen = f"{line['title']}, steps of {step} s; largest modulus {number(largest, 7)}"
        caption = (
            f"A line {seen}. Eigenvalues μ, dots: inside or on the unit circle; crosses: outside, those beyond the "
            "panel on its edge. From `step_maps.json`."
        )
        yield Figure(step_maps(values), caption, f"Eigenvalues in the complex plane beside the unit circle: {seen}.")
        for name, entry in line["methods"].items():
            excess = f"{entry['largest'] - 1:.1e}".replace("-", "−")
            distance = f"{entry['distance']:.1e}" if "distance" in entry else EMPTY
            growing = (str(entry.get(key, EMPTY)) for key in ("growing", "growing_found"))
            rows.append((line["title"], name, step, excess, distance, *growing))
    columns = (
        Column("line", align="left"), Column("method", align="left"), Column("Δt", "s"), Column("largest |μ| − 1"),
        Column("distance from closed form"), Column("should grow"), Column("grow"),
    )  # fmt: skip
    caption = (
        "Eigenvalues by line and method. Distance: the largest of those of the closed form's eigenvalues R(λ Δt) "
        "from the nearest one found. Grow: how many modes should and do lie outside the unit circle. From "
        "`step_maps.json`."
    )
    yield Table(columns, tuple(rows), caption, small=True)


def share_items(study: Study) -> Iterator[Item]:
    """Times of scenes with parts taken away and added."""
    scenes = study.shares["scenes"]
    times = np.array([scene["us_per_newton"] for scene in scenes.values()])
    shares = times / times[0]
    seen = f"{number(shares.min(), 2)} to {number(shares.max(), 2)} times the time of the first scene"
    yield Heading("What a scene does not need")
    yield Figure(
        scene_shares(list(scenes), times),
        f"What each part of a scene costs: a Newton iteration takes {seen}. A scene without a part does not compute "
        "it. From `scene_shares.json`.",
        f"Bars of the time of a Newton iteration for {len(scenes)} scenes: {seen}.",
    )
    columns = (
        Column("scene", align="left"), Column("Newton iteration", "µs"), Column("share of the first"),
        Column("step", "µs"),
    )  # fmt: skip
    rows = tuple(
        (name, number(scene["us_per_newton"], 3), decimals(share, 2), number(scene["us_per_step"], 3))
        for (name, scene), share in zip(scenes.items(), shares, strict=True)
    )
    rounds = f"medians of {study.shares['rounds']} rounds in turns on one core"
    yield Table(columns, rows, f"Cost of the parts of a scene: {rounds}. From `scene_shares.json`.", small=True)
