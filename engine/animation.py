"""A line in motion as a GIF: its shapes in true proportion, beside them the tension at its upper end.

`Trajectory.animate` and the report of a sweep both draw with it. The colours are those of Okabe & Ito, which
colour-blind readers can tell apart.
"""

import io
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from engine.trajectory import Trajectory

BLUE, VERMILION, ORANGE, SKY, INK = "#0072b2", "#d55e00", "#e69f00", "#56b4e9", "black"
FRAMES_PER_SECOND = 12
DOTS_PER_INCH, COLOURS, MOST_FRAMES = 90, 64, 48  # of a GIF
SHOWN_PERIODS = 3.0  # about the largest tension
MARGIN_M = 1.0
LEAST_WIDE = 0.4  # of the height of a panel


class Shapes(NamedTuple):
    """Shapes of a line over some time: `times` (m,) in `unit`, places x and z (m, n) in m, tension (m, n) in N.

    unit        "wave periods", or "s" without waves
    diameter_m  of the buoy; 0 without
    water       x (k,) and height (m, k) of the surface in m; None without
    record      times (j,), tension at the upper end (j,) in N, over the same time and finer
    """

    times: np.ndarray
    unit: str
    x_m: np.ndarray
    z_m: np.ndarray
    tension_N: np.ndarray
    diameter_m: float
    water: tuple[np.ndarray, np.ndarray] | None
    record: tuple[np.ndarray, np.ndarray]

    def pull_kN(self, rows: object) -> np.ndarray:
        """Tension at the upper end in the given frames."""
        return 1e-3 * np.interp(self.times[rows], *self.record)


def shapes_of(run: "Trajectory", begin_s: float | None = None, duration_s: float | None = None) -> Shapes:
    """The shapes of a run that kept profiles, from `begin_s` on for `duration_s`.

    Where these are not given: three wave periods about the largest tension after the first two; without waves all.
    Raises ValueError for a run without profiles, or with fewer than two in this time.
    """
    lines, scene, time_s = run.profiles, run.scene, run.columns["time_s"]
    if lines is None:
        raise ValueError("the run kept no shapes of its line; load its scene with output.profiles = true")
    top = run.columns["tension_top_high_N"]
    unit, unit_s = ("s", 1.0) if scene.waves is None else ("wave periods", scene.waves.period_s)
    end_s = float(time_s[-1]) if len(time_s) else 0.0
    if duration_s is None:
        duration_s = end_s if scene.waves is None else SHOWN_PERIODS * unit_s
    if begin_s is None and len(time_s):
        late = time_s >= min(2.0 * unit_s, 0.5 * end_s)  # the start from rest is left out where the record goes on
        begin_s = float(time_s[late][np.argmax(top[late])]) - 0.6 * duration_s
        begin_s = min(max(begin_s, 0.0), max(end_s - duration_s, 0.0))
    inside = (lines.time_s >= (begin_s or 0.0)) & (lines.time_s <= (begin_s or 0.0) + duration_s)
    if inside.sum() < 2:
        raise ValueError(f"two shapes at least are needed, and the run has {inside.sum()} in this time")
    part = (time_s >= lines.time_s[inside][0]) & (time_s <= lines.time_s[inside][-1])
    x, z = lines.x_m[inside], lines.z_m[inside]
    diameter_m = 0.0 if scene.buoy is None else scene.buoy.diameter_m
    water = None
    if scene.waves is not None:
        from engine.physics.sea import elevation_m

        beyond = max(3.0 * diameter_m, 0.25 * float(z.max()))  # of the rope, on both sides
        across = np.linspace(x.min() - beyond, x.max() + beyond, 80)
        anchor = scene.anchor.position_m  # places of a run are told from there
        height = elevation_m(scene, lines.time_s[inside][:, None], anchor[0] + across, anchor[1])
        water = across, scene.water.depth_m - anchor[2] + height
    record = time_s[part] / unit_s, top[part]
    return Shapes(lines.time_s[inside] / unit_s, unit, x, z, lines.tension_N[inside], diameter_m, water, record)


def animated(figure: "Figure", shapes: Shapes) -> bytes:
    """The GIF, drawn in an empty figure: shapes on the left, tension with the moment marked on the right."""
    scene, pull = figure.subplots(1, 2, gridspec_kw={"width_ratios": [1.0, 1.25]})
    moving, place = shape_panel(scene, shapes)
    clock = scene.set_title("")
    tension_panel(pull, shapes)
    (moment,) = pull.plot([], [], "o", color=VERMILION, markersize=6)

    def show(row: int) -> None:
        place(row)
        clock.set_text(f"{shapes.times[row]:.2f} {shapes.unit}")
        moment.set_data([shapes.times[row]], [shapes.pull_kN(row)])

    return moving_picture(figure, [*moving, clock, moment], len(shapes.times), show, FRAMES_PER_SECOND)


def shape_panel(axes: "Axes", shapes: Shapes) -> tuple[list, Callable[[int], None]]:
    """Water, anchor, line and buoy on the axes: what moves, and the function that puts it where a frame has it.

    Thick: parts of the line without tension.
    """
    from matplotlib.patches import Circle

    radius, highest = 0.5 * shapes.diameter_m, float(shapes.z_m.max())
    if shapes.water is not None:
        highest = max(highest + radius, float(shapes.water[1].max()))
    x_min, x_max = float(shapes.x_m.min()) - radius - MARGIN_M, float(shapes.x_m.max()) + radius + MARGIN_M
    top = highest + MARGIN_M
    margin = max(0.0, 0.5 * (LEAST_WIDE * top - (x_max - x_min)))  # of a panel too narrow for the numbers below it
    lowest = min(float(shapes.z_m.min()), 0.0) - 0.3
    axes.set(xlim=(x_min - margin, x_max + margin), ylim=(lowest, top), aspect="equal")
    axes.set(xlabel="$x$ (m)", ylabel="$z$ (m)")
    (surface,) = axes.plot([], [], color=SKY, linewidth=1.2)
    (rope,) = axes.plot([], [], color=BLUE, linewidth=1.0)
    (slack,) = axes.plot([], [], color=VERMILION, linewidth=2.4, solid_capstyle="round")
    buoy = axes.add_patch(Circle((0.0, 0.0), radius, facecolor=ORANGE, edgecolor=INK, linewidth=0.8, zorder=3))
    axes.plot([0.0], [0.0], "^", color=INK, markersize=5)

    def place(row: int) -> None:
        x, z = shapes.x_m[row], shapes.z_m[row]
        if shapes.water is not None:
            surface.set_data(shapes.water[0], shapes.water[1][row])
        rope.set_data(x, z)
        slack.set_data(x, np.where(shapes.tension_N[row] > 0.0, np.nan, z))
        buoy.set_center((float(x[-1]), float(z[-1])))

    return [surface, rope, slack, buoy], place


def tension_panel(axes: "Axes", shapes: Shapes) -> None:
    """The tension at the upper end (kN) over time."""
    times, tension_N = shapes.record
    axes.axhline(0.0, color=INK, linewidth=0.5)
    axes.plot(times, 1e-3 * tension_N, color=INK, linewidth=1.0)
    label = "$t/T_i$ (wave periods)" if shapes.unit == "wave periods" else "$t$ (s)"
    axes.set(xlabel=label, ylabel="tension at the top (kN)", xmargin=0.02)


def moving_picture(figure: "Figure", artists: list, frames: int, show: Callable[[int], None], per_second: int) -> bytes:
    """A GIF of `frames` frames, `per_second` in a second. `show(k)` changes the `artists` to their state in frame k.

    Only the artists are drawn again for each frame; the rest of the figure is drawn once. All frames have one layout
    and one palette. If there are more than MOST_FRAMES, frames are left out, and the GIF lasts as long as with all of
    them.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    figure.set_dpi(DOTS_PER_INCH)
    canvas = FigureCanvasAgg(figure)
    show(0)
    for artist in artists:
        artist.set_animated(True)
    canvas.draw()
    background, images = canvas.copy_from_bbox(figure.bbox), []
    stride = -(-frames // MOST_FRAMES)
    for frame in range(0, frames, stride):
        canvas.restore_region(background)
        show(frame)
        for artist in artists:
            artist.draw(canvas.get_renderer())
        images.append(Image.fromarray(np.array(canvas.buffer_rgba())).convert("RGB"))
    sampled_images = images[:: max(1, len(images) // 6)]
    sample = np.hstack([np.asarray(image) for image in sampled_images])
    # MAXCOVERAGE does not weigh a colour by its area; otherwise a small red dot would turn brown
    palette = Image.fromarray(sample).quantize(COLOURS, Image.Quantize.MAXCOVERAGE)
    first, *rest = (image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images)
    target = io.BytesIO()
    first.save(target, "gif", save_all=True, append_images=rest, duration=round(1000 * stride / per_second), loop=0)
    return target.getvalue()
