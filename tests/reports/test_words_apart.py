"""The words of a drawing can be read: none lies on another, numbers of an axis stand apart, none leaves the sheet."""

import io
from itertools import combinations

import numpy as np
import pytest
from matplotlib.text import Text
from PIL import Image, ImageSequence

from engine.animation import Shapes
from reports.buoy_sweep.report import report
from reports.figures.animations import tether_animation, tether_stills

APART = 2.0  # pixels of 100 to an inch, between two numbers of one axis; half a space


def crowded(figure) -> list[tuple[str, ...]]:
    """Words that lie on others, or beyond the edge of the sheet."""
    figure.draw_without_rendering()
    numbers, hidden = set(), set()
    for axis in (axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)):
        low, high = sorted(axis.get_view_interval())
        for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks()):
            drawn_numbers = numbers if low <= tick.get_loc() <= high else hidden
            drawn_numbers |= {tick.label1, tick.label2}
    words = [
        (word, word.get_window_extent())
        for word in figure.findobj(Text)
        if word.get_visible() and word.get_text().strip() and word not in hidden
    ]
    pairs = [
        (word.get_text(), second.get_text())
        for (word, a), (second, b) in combinations(words, 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > (-APART if {word, second} <= numbers else 1.0)
        and min(a.y1, b.y1) - max(a.y0, b.y0) > 1.0
    ]
    edge = figure.bbox.padded(1.0)
    return pairs + [
        (word.get_text(),) for word, box in words if not edge.contains(*box.min) or not edge.contains(*box.max)
    ]


def snap(way_m: float) -> Shapes:
    """A straight line whose upper end goes to and fro by `way_m`."""
    periods, share = np.linspace(2.0, 5.0, 60), np.linspace(0.0, 1.0, 9)
    x = way_m * np.sin(periods)[:, None] * share
    z = np.broadcast_to(20.0 * share, x.shape)
    across = np.linspace(-way_m - 3.0, way_m + 3.0, 20)
    pull = 2e3 * np.sin(periods) ** 2
    return Shapes(
        periods, "wave periods", x, z, np.ones_like(x), 1.5, (across, np.full((60, 20), 21.0)), (periods, pull)
    )


@pytest.mark.slow
@pytest.mark.parametrize("way_m", [0.1, 3.0, 9.0])
def test_the_tether_at_six_moments_however_far_it_swings(drawn, way_m):
    tether_stills(snap(way_m))
    assert crowded(drawn[0]) == []


def test_a_moving_picture_lasts_as_long_as_all_its_frames_though_some_are_left_out():
    """Of 60 frames every second is drawn; twelve a second."""
    with Image.open(io.BytesIO(tether_animation(snap(3.0)).data)) as moving:
        lasts_ms = sum(frame.info["duration"] for frame in ImageSequence.Iterator(moving))
    assert lasts_ms == pytest.approx(60 / 12 * 1e3, rel=0.05), "GIF counts in hundredths"


@pytest.mark.slow
def test_the_drawings_of_a_sweep(folder, drawn):
    report(folder)
    assert len(drawn) >= 3 and not any(map(crowded, drawn))
