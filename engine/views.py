"""A run as one asks for it in Python: figure, animation, snaps, extremes, spectrum, section, exponent and verdict.

The methods of `engine.Trajectory` stand here, because this is the only module of the engine that uses `analysis` and
matplotlib, and it imports both when a method is called. How the motion of a buoy is strobed and measured is declared
here once; the campaigns read it.
"""

from dataclasses import replace
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

from engine.atomic import write_atomic
from engine.digits import digits

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    import numpy
    import pandas
    import xarray
    from matplotlib.axes import Axes

    from analysis import Exponent, PoincareSection, Snaps, Spectrum, Verdict
    from engine.scene.models import Scene
    from engine.trajectory import Trajectory

LONGEST_PERIOD = 16
# Share of the motion's range. At the default solver tolerance the default sweep repeats within 0.007 or misses by 0.1.
STROBE_TOLERANCE = 0.01
LAST_PERIODS = 12  # drawn larger
NEEDED = 50  # periods that leave 32 after the transient, which `analysis.tangent_lyapunov` needs
LEAST_SHOWN = 0.01  # of the range of a run: a section of a periodic motion is a dot, and not its rounding enlarged
BELOW_TOP = 0.05  # of the largest tension at the top: what the line has to bear more elsewhere, to be told
PANELS = {  # of a figure over time -> the column that it shows, and its title
    "tension": ("tension_top_N", "tension at the upper end (N)"),
    "radius": ("radius_m", "distance r from the anchor (m)"),
    "angle": ("angle_rad", "angle θ from the vertical (rad)"),
}
FOLLOWED = 150  # periods over which a perturbation checks a verdict on a finer grid
WHOLE_WINDOW = 12  # periods of a spectrum are a multiple of it: motions of period 2, 3, 4 and 6 then do not leak


def in_regular_waves(scene: "Scene") -> bool:
    """Whether it is a scene of a buoy in regular waves: motions are strobed and judged once per wave period."""
    return scene.end.kind == "buoy" and scene.waves is not None and not scene.waves.irregular


def carries_tangents(scene: "Scene") -> bool:
    """Whether the engine can carry perturbations through this scene, for exponents and a verdict on its regime."""
    implicit = scene.solver.integrator in ("esdirk43", "trbdf2")
    return implicit and scene.tether.bending_stiffness_Nm2 > 0 and scene.motion.dimensions == 2


def _can_be_judged(run: "Trajectory") -> bool:
    """Whether the run has a `verdict`."""
    return run.status == "ok" and in_regular_waves(run.scene)


def carried(run: "Trajectory") -> bool:
    """Whether a run carried tangent vectors in its plane."""
    return run.tangent is not None and run.tangent.growth_nats.shape[1] > 0


def state_of(
    scene: "Scene", columns: "Mapping[str, numpy.ndarray]", first_sample: int
) -> "tuple[dict[str, numpy.ndarray], list[float]]":
    """Place (along the waves, z) and velocity (along and across the radius) of the buoy, and what counts as 1 in each.

    Places are measured by the larger extent of the path from first_sample on, velocities by their larger range: so a
    millimetre counts the same in every direction, and a buoy that turns round and round needs no other treatment.
    """
    import numpy as np

    from engine.trajectory.columns import along_waves, heading_of

    coordinates = {
        "along_m": along_waves(heading_of(scene), columns["x_m"], columns["y_m"]),
        "z_m": columns["z_m"],
        "radial_mps": columns["radius_rate_mps"],
        "lateral_mps": columns["radius_m"] * columns["angle_rate_radps"],
    }
    along, z, radial, lateral = (float(np.ptp(values[first_sample:])) for values in coordinates.values())
    # A buoy at rest has no range of its own; a micrometre, and a micrometre a second, are rest for this one.
    path_m, speed_mps = max(along, z, 1e-6), max(radial, lateral, 1e-6)
    return coordinates, [path_m, path_m, speed_mps, speed_mps]


def strobed_states(
    run: "Trajectory",
    first_period: int,
    phase: float = 0.0,
    transient_periods: int = 0,
    columns: "Mapping[str, numpy.ndarray] | None" = None,
) -> "tuple[numpy.ndarray, list[float]]":
    """States (n, 4) of the buoy once per wave period (`state_of`), and what counts as 1 in each coordinate.

    first_period: wave periods that are left out of this scale. phase: of the period, at which they are taken.
    transient_periods: left out of the states. columns: of the run, where not all samples are to be taken.
    """
    from analysis import poincare_section

    step_s, period_s = _forcing(run)
    first_sample = round(first_period * period_s / step_s)  # of the scale
    coordinates, scale = state_of(run.scene, run.columns if columns is None else columns, first_sample)
    return poincare_section(coordinates, step_s, period_s, phase, transient_periods).points, scale


def strobed_radius(run: "Trajectory", transient_periods: int) -> "numpy.ndarray":
    """r (m) and r' (m/s) of the buoy at t = k T, k >= transient_periods, as (m, 2), up to the first sample that is not
    finite; empty for a record that ends before.
    """
    import numpy as np

    from analysis import poincare_section

    step_s, period_s = _forcing(run)
    series = np.column_stack([run.columns["radius_m"], run.columns["radius_rate_mps"]])
    sound = series[np.logical_and.accumulate(np.isfinite(series).all(axis=1))]
    if (len(sound) - 1) * step_s < transient_periods * period_s - 1e-6 * step_s:
        return np.empty((0, 2))
    return poincare_section(sound, step_s, period_s, transient_periods=transient_periods).points


def spectrum(run: "Trajectory", column: str = "radius_m", transient_periods: int | None = None) -> "Spectrum":
    """Eq. (31) of a column of the table after the transient, the first third of the run (`analysis.spectrum`).

    The window is the last multiple of 12 forcing periods, so that motions of period 2, 3, 4 or 6 do not leak. Raises
    ValueError where neither regular waves nor a shaken end drive the run, as do `section`, `exponent` and `verdict`.
    """
    from analysis import spectrum as spectrum_of

    step_s, period_s = _forcing(run)
    periods, first = _periods(run), _transient(run, transient_periods)
    if first >= periods:
        raise ValueError(f"transient_periods: given {first}; allowed: less than the {periods} periods of the run")
    length = (periods - first) // WHOLE_WINDOW * WHOLE_WINDOW or periods - first
    return spectrum_of(run[column], step_s, period_s, periods - length, length)


def section(
    run: "Trajectory",
    columns: "str | Sequence[str]" = ("radius_m", "radius_rate_mps"),
    transient_periods: int | None = None,
    phase: float = 0.0,
) -> "PoincareSection":
    """Columns of the table once per period after the transient, its first third (`analysis.poincare_section`)."""
    from analysis import poincare_section

    shown = {name: run[name] for name in ([columns] if isinstance(columns, str) else columns)}
    return poincare_section(shown, *_forcing(run), phase, _transient(run, transient_periods))


def exponent(run: "Trajectory", transient_periods: int | None = None) -> "Exponent":
    """The largest Lyapunov exponent after the transient, that of `verdict` or the first third, in bits per forcing
    period.

    From the tangent dynamics where the run carried them (`output.tangent_vectors`), else by Wolf's method from r, which
    is far less certain and takes seconds; its `method` says which, and over which periods: `verdict` may rest on an
    earlier look, and then on fewer of them.
    """
    from analysis import tangent_lyapunov, wolf_lyapunov
    from analysis.tangent_growth import turned

    (step_s, period_s), first = _forcing(run), _transient(run, transient_periods)
    if transient_periods is None and _can_be_judged(run):
        first = verdict(run).transient or first
    last = _periods(run)
    if carried(run):
        growth_nats = turned(run.tangent.growth_nats[:, 0], first)
        last = len(run.tangent.growth_nats)
        first = last - len(growth_nats)
        result = tangent_lyapunov(growth_nats)[0]
    else:
        radius_m = run.columns["radius_m"][round(first * period_s / step_s) :]
        result = wolf_lyapunov(radius_m, step_s).in_bits_per_period(period_s)
    result = replace(result, method=f"{result.method}, over periods {first} to {last}")
    if not carried(run) and not result.found and carries_tangents(run.scene):
        return replace(result, reason=f"{result.reason}; output.tangent_vectors = 1 measures it in {NEEDED} periods")
    return result


def verdict(run: "Trajectory", tighter: "Mapping[int, Exponent] | None" = None) -> "Verdict":
    """The regime of a buoy in regular waves with the evidence for it (`analysis.motion_regime`), as campaigns judge it.

    Chaos and tori need a run with `output.tangent_vectors` = 1, and any word 135 periods or more.
    tighter: as in `analysis.motion_regime`.
    """
    from analysis import motion_regime

    if not in_regular_waves(run.scene):
        raise ValueError("a verdict needs a buoy in regular waves")
    if run.status != "ok":
        raise ValueError(f"a verdict needs a run that reached its end, and this one is {run.status}: {run.message}")
    strobed, scale = strobed_states(run, _periods(run) // 2)
    growth = run.tangent.growth_nats[: len(strobed) - 1, 0] if carried(run) else None
    settings = {"scale": scale, "tolerance": STROBE_TOLERANCE, "max_period": LONGEST_PERIOD}
    result = motion_regime(strobed, growth, tighter=tighter, **settings)
    reasons = [result.reason]
    if not result.evidence:
        reasons.append(f"most motions are told in {look_after(look_after(look_after(0)))}")
    if growth is None and result.regime == "undecided" and carries_tangents(run.scene):
        reasons.append("chaos and tori need output.tangent_vectors = 1")
    return replace(result, reason="; ".join(reasons))


def doubt_of_verdict(run: "Trajectory") -> str:
    """What speaks against the verdict of a run on twice the elements at a quarter of the tolerance, in words.

    The run goes on from its last state for FOLLOWED waves on the finer grid, and carries a perturbation. "" where this
    contradicts nothing, where the verdict is neither chaos nor a period, and where the line was never slack: only the
    folds of a slack line depend on the elements as much.
    """
    from analysis import growth_contradicts, tangent_lyapunov
    from analysis.tangent_growth import turned
    from engine import simulate
    from engine.scene import SceneError
    from engine.scene.finer import finer

    if not (_can_be_judged(run) and carried(run) and run.final_state):
        return ""
    word = verdict(run).regime
    told = word == "chaotic" or word.startswith("period")
    if not told or run.columns["tension_top_low_N"].min() > 0.0:
        return ""
    try:
        scene = finer(run.scene, elements=2, steps=4, changes={"waves.ramp_s": 0.0})
    except SceneError:  # no scene has so many nodes
        return ""
    later = simulate(scene, FOLLOWED, start=run.final_state.at_zero())
    if not carried(later):
        return ""
    (growth,) = tangent_lyapunov(turned(later.tangent.growth_nats[:, 0], FOLLOWED // 4))
    own = exponent(run)
    if not growth_contradicts(word, (own.value, own.error), (growth.value, growth.error)):
        return ""
    rate = f"{growth.value:+.2f} ± {growth.error:.2f} bits a wave"
    return (
        f"on {scene.tether.nodes} nodes with smaller steps perturbations grow by {rate}, so the regime may be another: "
        "use more tether.nodes"
    )


def look_after(periods: int) -> int:
    """After how many periods a motion is judged next that was judged after `periods` (`analysis.next_look`)."""
    from analysis import next_look

    return next_look(periods)


def longer_decides(run: "Trajectory") -> bool:
    """Whether a longer run may find another verdict (`analysis.looks.longer_decides`)."""
    from analysis.looks import longer_decides

    result = verdict(run)
    return longer_decides(result.regime, result.reason)


def facts(run: "Trajectory") -> dict[str, str]:
    """What a run did, in words: the name of a fact -> its text; extremes of all of it, and after its beginning."""
    time_s, waves = run.columns["time_s"], run.scene.waves
    end_s = float(time_s[-1]) if len(time_s) else 0.0
    length = f"{end_s:g} s"
    if waves is not None:
        length = f"{digits(end_s / waves.period_s, 4)} wave periods, {digits(end_s, 4)} s"
    texts = {"scene": run.scene.title or run.scene.name, "run": f"{run.status}, {length}"}
    if run.message:
        texts["message"] = run.message
    if run.began:
        texts["began"] = run.began
    if len(time_s) > 3:
        texts["radius"] = _in_words(run, "radius_m", "m")
        from engine.trajectory.columns import largest_along

        texts["tension"] = _in_words(run, "tension_top_N", "N at the top")
        largest_N, breaking_N = run.columns["tension_top_high_N"].max(), run.scene.tether.breaking_load_N
        most_N, places_m = largest_along(run.columns, run.scene.tether.length_m)
        place = int(most_N.argmax())
        if most_N[place] > (1.0 + BELOW_TOP) * largest_N:
            place_m = digits(places_m[place], 4)
            texts["line"] = (
                f"bears up to {most_N[place]:.2f} N (t = {time_s[place]:.5g} s), {place_m} m from the anchor"
            )
        if breaking_N is not None:
            texts["strength"] = (
                f"largest tension of the line is {most_N[place] / breaking_N:.2%} of tether.breaking_load_N"
            )
        texts |= _snaps_in_words(run)
    loops = run.statistics.get("loop_releases")
    if loops:
        texts["loops"] = f"{loops} released, because a plane cannot open them; in motion.dimensions = 3 they open"
    if _can_be_judged(run):
        if carried(run):
            texts["exponent"] = str(exponent(run))
        texts["verdict"] = str(verdict(run))
    return texts


def _snaps_in_words(run: "Trajectory") -> dict[str, str]:
    """The fact "snaps" of a whole run; nothing of a line that bears no tension at rest, by which snaps are measured."""
    try:
        counted = snaps_of(run.scene, run.columns)
    except ValueError:
        return {}
    text = f"{len(counted)} in {digits(counted.watched_s, 4)} s"
    if len(counted):
        hardest = counted.peak_N.argmax()
        text += f"; the hardest pulls with {counted.peak_N[hardest]:.2f} N (t = {counted.peak_s[hardest]:.5g} s)"
    return {"snaps": f"whole run: {text}"}


def snaps(
    run: "Trajectory",
    static_N: float | None = None,
    ringing_s: float | None = None,
    slack_share: float | None = None,
    snap_share: float = 1.0,
    transient_s: float = 0.0,
) -> "pandas.DataFrame":
    """A table of the snaps of a run, one a row, as `analysis.detect_snaps` defines them; `attrs` has its thresholds.

    static_N     static tension (N); None: that of the scene at rest
    ringing_s    longest period of axial ringing (s); None: 2 l/c of the line, and two samples at least
    slack_share, snap_share   thresholds of slack and of a snap, as shares of the static tension; None: 0.05
    transient_s  snaps that count before it are left out (s)
    A run that is not finite is looked at up to there. Raises ValueError for a line that bears no tension at rest.
    """
    options = {} if slack_share is None else {"slack_share": slack_share}
    return snaps_of(
        run.scene, run.columns, static_N, ringing_s, snap_share=snap_share, transient_s=transient_s, **options
    ).table()


def snaps_of(
    scene: "Scene",
    columns: "Mapping[str, numpy.ndarray]",
    static_N: float | None = None,
    ringing_s: float | None = None,
    **options: float,
) -> "Snaps":
    """`analysis.Snaps` of the columns of a run of the scene. options: of `analysis.detect_snaps`; others as of `snaps`.

    The line's ends move apart at `radius_rate_mps`, also where one is held; the buoy meets a spring f'/l0 (N/m).
    """
    import numpy as np

    from analysis import detect_snaps
    from analysis.sampling import checked_positive
    from engine.natural_frequencies import axial_period_s, impact_Nspm
    from engine.run.rest import static_tension_N

    step_s = scene.sample_step_s()
    tension, high, rate = (columns[name] for name in ("tension_top_N", "tension_top_high_N", "radius_rate_mps"))
    sound = np.logical_and.accumulate(np.isfinite(tension + high + rate))
    if static_N is not None:
        static_N = checked_positive(static_N, "static_N")
    else:
        static_N = static_tension_N(scene, columns) if sound.any() else np.nan
        if not static_N > 0.0:
            raise ValueError(
                f"snaps: the line bears {digits(static_N, 4)} N at rest; give static_N, which they are measured by"
            )
    if ringing_s is None:
        ringing_s = max(axial_period_s(scene, static_N), 2.0 * step_s)
    return detect_snaps(
        tension[sound],
        step_s,
        static_N,
        ringing_s,
        high_N=high[sound],
        rate_mps=rate[sound],
        impact_Nspm=impact_Nspm(scene, static_N),
        **options,
    )


# what `extremes` tells: column of the least values, of the largest values
_WATCHED = {
    "radius_m": ("radius_m", "radius_m"),
    "angle_rad": ("angle_rad", "angle_rad"),
    "tension_top_N": ("tension_top_low_N", "tension_top_high_N"),
    "tension_anchor_N": ("tension_anchor_N", "tension_anchor_high_N"),
    "tension_line_N": ("tension_min_N", "tension_max_N"),
}


def extremes(run: "Trajectory") -> "pandas.DataFrame":
    """Least and largest values with their times: of the whole run, and after its beginning.

    The index has the part ("whole run", "after t = 166.65 s") and the quantity: radius and angle of the upper end,
    tension there, at the anchor and anywhere along the line. The ends are watched at every step, the line at samples.
    The beginning is the first third under what drives a run with one period, and a ramp of the waves.
    """
    import pandas

    rows = {}
    for quantity in _WATCHED:
        for part, *values in _extremes(run, quantity):
            rows[part, quantity] = values
    index = pandas.MultiIndex.from_tuples(rows, names=["part", "quantity"])
    return pandas.DataFrame(rows.values(), index, ["least", "least_s", "largest", "largest_s"]).sort_index(
        ascending=False, level="part", sort_remaining=False
    )


def _extremes(run: "Trajectory", quantity: str) -> "Iterator[tuple[str, float, float, float, float]]":
    """Of each part of a run: its name, the least value of a quantity and its time, the largest and its time."""
    from engine.trajectory.columns import largest_along

    time_s, waves = run.columns["time_s"], run.scene.waves
    low, high = (run.columns[name] for name in _WATCHED[quantity])
    if quantity == "tension_line_N":
        high, _ = largest_along(run.columns, run.scene.tether.length_m)
    ramped = 0 if waves is None else int((time_s < waves.ramp_s).sum())
    begun = ramped if _forced(run.scene) is None else max(ramped, len(time_s) // 3)
    for first in sorted({0, min(begun, len(time_s) - 1)}):
        least, largest = first + low[first:].argmin(), first + high[first:].argmax()
        part = f"after t = {time_s[first]:.5g} s" if first else "whole run"
        yield part, low[least], time_s[least], high[largest], time_s[largest]


def _in_words(run: "Trajectory", quantity: str, unit: str) -> str:
    """`_extremes` in a line."""
    texts = []
    for part, least, least_s, largest, largest_s in _extremes(run, quantity):
        ends = f"{least:.2f} (t = {least_s:.5g} s) to {largest:.2f} {unit} (t = {largest_s:.5g} s)"
        texts.append(f"{part}: {ends}")
    return "; ".join(texts)


def animate(
    run: "Trajectory", path: "str | Path", begin_s: float | None = None, duration_s: float | None = None
) -> None:
    """Write a GIF: line and buoy in true proportion, beside them the tension at the upper end.

    begin_s, duration_s: the part of the run (s); by default three wave periods about the largest tension after the
    first two, without waves all. The scene needs `output.profiles` = true. Raises ValueError without shapes, OSError.
    """
    from matplotlib.figure import Figure

    from engine.animation import animated, shapes_of

    if not str(path).endswith(".gif"):
        raise ValueError(f"path: given {str(path)!r}; allowed: a file whose name ends in .gif")
    shapes = shapes_of(run, begin_s, duration_s)
    write_atomic(path, animated(Figure(figsize=(6.8, 3.4), layout="constrained"), shapes))


def html(run: "Trajectory") -> str:
    """The facts as a table, for a notebook."""
    rows = "".join(f"<tr><th>{escape(name)}</th><td>{escape(text)}</td></tr>" for name, text in facts(run).items())
    return f"<table>{rows}</table>"


def to_xarray(run: "Trajectory") -> "xarray.Dataset":
    """Everything that `save` writes but the final state, as an xarray Dataset with units and long names."""
    import xarray

    from engine.trajectory.final_state import PREFIX

    data = xarray.load_dataset(BytesIO(run.to_bytes()), engine="scipy")
    return data.drop_vars([name for name in data.variables if name.startswith(PREFIX)])


def plot(run: "Trajectory", path: "str | Path | None" = None) -> "dict[str, Axes]":
    """A figure: tension, radius and angle over the whole run and its end; section and spectrum, or else the path.

    path: a .png, .svg or .pdf file to write; without one the figure belongs to `matplotlib.pyplot`: a notebook shows
    it, a script with `pyplot.show()`. Returns matplotlib's Axes by the name of the panel.
    """
    import numpy as np
    from matplotlib import pyplot
    from matplotlib.figure import Figure

    look = {"linewidth": 0.6, "rasterized": True}  # thousands of strokes
    time, unit, parts = run.columns["time_s"], "t (s)", {"": slice(None)}
    rows = [[name, "path"] for name in PANELS]
    sound = all(np.isfinite(run.columns[column]).all() for column, _ in PANELS.values())
    forced = sound and _forced(run.scene) is not None and _periods(run) > 1
    if forced:
        period_s = _forcing(run)[1]
        time, unit = time / period_s, "t/T (forcing periods)"
        parts["last "] = time >= time[-1] - LAST_PERIODS
        rows = [*([name, f"last {name}"] for name in PANELS), ["section", "spectrum"]]
    figure = (pyplot.figure if path is None else Figure)(figsize=(10.0, 2.5 * len(rows)), layout="constrained")
    axes = figure.subplot_mosaic(rows)
    for prefix, part in parts.items():
        span = f", last {LAST_PERIODS} periods" if prefix else ""
        low, high = run["tension_top_low_N"][part], run["tension_top_high_N"][part]
        axes[f"{prefix}tension"].fill_between(time[part], low, high, alpha=0.35, linewidth=0, rasterized=True)
        for name, (column, title) in PANELS.items():
            axes[f"{prefix}{name}"].plot(time[part], run[column][part], **look)
            axes[f"{prefix}{name}"].set(title=f"{title}{span}")
        axes[f"{prefix}angle"].set(xlabel=unit)
    if forced:
        points, lines = run.section().points, run.spectrum()
        axes["section"].plot(*points.T, ".", markersize=3)
        title = f"once per period, after period {_transient(run, None)}"
        axes["section"].set(xlabel="r (m)", ylabel="dr/dt (m/s)", title=title)
        _widened(axes["section"], run.columns["radius_m"], run.columns["radius_rate_mps"])
        ratio = lines.angular_frequency_radps * period_s / (2.0 * np.pi)
        shown = (ratio > 0.0) & (ratio <= 2.5)
        axes["spectrum"].semilogy(ratio[shown], lines.amplitude[shown], linewidth=0.8)
        axes["spectrum"].set(xlabel="frequency/forcing frequency", title=f"spectrum of r (m), last {lines.periods} T")
    else:
        axes["path"].plot(run.columns["x_m"], run.columns["z_m"], **look)
        axes["path"].set(xlabel="x (m)", ylabel="z (m)", title="path of the upper end", aspect="equal")
    for panel in axes.values():
        if panel.get_yscale() == "linear":
            panel.ticklabel_format(useOffset=False)
    outcome = verdict(run).regime if _can_be_judged(run) else run.status
    figure.suptitle(f"{run.scene.title or run.scene.name}: {outcome}")
    if path is not None:
        content, kind = BytesIO(), str(path).rpartition(".")[2]
        figure.savefig(content, format=kind, dpi=100)
        write_atomic(path, content.getvalue())
    return axes


def _widened(axes: "Axes", across: "numpy.ndarray", upward: "numpy.ndarray") -> None:
    """Let the axes show LEAST_SHOWN of the range of two series at least."""
    import numpy as np

    for series, limits, set_limits in (
        (across, axes.get_xlim(), axes.set_xlim),
        (upward, axes.get_ylim(), axes.set_ylim),
    ):
        middle, half = 0.5 * sum(limits), 0.5 * LEAST_SHOWN * float(np.ptp(series))
        set_limits(min(limits[0], middle - half), max(limits[1], middle + half))


def _forced(scene: "Scene") -> float | None:
    """Period (s) of what drives a scene: of regular waves, or of an end that is shaken; None without either."""
    if scene.waves is not None:
        return None if scene.waves.irregular else scene.waves.period_s
    return getattr(scene.end.motion, "period_s", None)


def _forcing(run: "Trajectory") -> tuple[float, float]:
    """Sampling step and forcing period (s); ValueError for a scene that nothing drives with one period."""
    period_s = _forced(run.scene)
    if period_s is None:
        raise ValueError("neither regular waves nor a shaken end: this run has no period to look at it by")
    return run.scene.sample_step_s(), period_s


def _periods(run: "Trajectory") -> int:
    """Whole forcing periods of its record."""
    step_s, period_s = _forcing(run)
    return int((len(run.columns["time_s"]) - 1) * step_s / period_s + 1e-6)


def _transient(run: "Trajectory", periods: int | None) -> int:
    """Periods left out: these, else the first third of the run, as `analysis.motion_regime` does."""
    return _periods(run) // 3 if periods is None else periods
