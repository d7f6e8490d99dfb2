"""Pictures of eq. (33): its section with zooms, a history, the errors of its exponent, orbit diagrams."""

import numpy as np

from ..parts import Picture
from ..parts.style import BLUE, GREEN, INK, SOFT, VERMILION
from .curves import Curve, Panel, curves
from .orbit_diagram import OrbitDiagram, Strobes

STATE = (r"displacement $\gamma$ (–)", r"velocity $\dot\gamma$ (–)")


def oscillator_section(states: np.ndarray, boxes: np.ndarray, orbit: np.ndarray | None) -> Picture:
    """The whole section: states (m, 2), the boxes (b, 4) of the zooms, points (p, 2) of a coexisting orbit or None."""
    alpha = 0.6 if len(states) > 20000 else 1.0
    lines = [Curve(*states.T, "", "", ",", INK, alpha=alpha), *_frames(boxes, 1)]
    if orbit is not None:
        lines.append(Curve(*orbit.T, f"attracting period-{len(orbit)} orbit", "", "o", VERMILION))
    return curves([[Panel(lines, *STATE)]], 4.9, "upper left", kind="png")


def oscillator_zooms(zooms: list[np.ndarray], boxes: np.ndarray) -> Picture:
    """One panel for each zoom: states (m, 2) inside its box (4,); the next box is drawn in."""
    panels = []
    for number, (states, box) in enumerate(zip(zooms, boxes, strict=True), 1):
        dots, limits = Curve(*states.T, "", "", ",", INK, alpha=0.7), {"xlim": box[:2], "ylim": box[2:]}
        labels = STATE if number == 1 else (STATE[0], "")
        panels.append(
            Panel([dots, *_frames(boxes[number:], number + 1)], *labels, f"zoom {number}", settings=limits, ticks=5)
        )
    return curves([panels], 3.5, "upper left", kind="png")


def _frames(boxes: np.ndarray, first: int) -> list[Curve]:
    """The outlines of boxes (b, 4), with their numbers."""
    corners = boxes[:, [0, 1, 1, 0, 0]], boxes[:, [2, 2, 3, 3, 2]]
    frames = []
    for number, (x, y) in enumerate(zip(*corners, strict=True), first):
        frames.append(Curve(x, y, f"zoom {number}", colour=(BLUE, GREEN)[number - 1]))
    return frames


def oscillator_history(periods: np.ndarray, displacement: np.ndarray, velocity: np.ndarray) -> Picture:
    """Histories over t/T (m,): displacement and velocity (m,); shaded where the tether is slack."""
    rows = []
    for values, label in ((displacement, r"$\gamma$ (–)"), (velocity, r"$\dot\gamma$ (–)")):
        slack = displacement < 0.0
        band = periods, np.where(slack, values.min(), np.nan), np.where(slack, values.max(), np.nan)
        history = Curve(periods, values, colour=INK, band=band)
        x_label = r"$t/T$ (forcing periods)" if rows else ""
        rows.append([Panel([history], x_label, label, level=0.0, settings={"xlim": (periods[0], periods[-1])})])
    return curves(rows, 2.9, share="x")


def oscillator_errors(convergence: np.ndarray, of_start: np.ndarray) -> Picture:
    """How the exponent settles.

    Left: running mean (time, mean, standard error) (b, 3) with its band. Right: standard deviation of the mean of k
    starts, from of_start (n,) cut into groups of k, against k, with the law k^-1/2 through k = 1.
    """
    time, mean, error = convergence.T
    band = (time, mean - 2 * error, mean + 2 * error)
    running = Curve(time, mean, "mean over starts, ± 2 standard errors", colour=BLUE, band=band)
    labels = ("time of each start's average (–)", r"$\lambda_1$ (nats per time)")
    running_panel = Panel([running], *labels, level=float(mean[-1]))
    sizes = 2 ** np.arange(20)
    sizes = sizes[(len(of_start) // sizes >= 8) | (sizes == 1)]
    groups, scatter = len(of_start) // sizes, np.empty(len(sizes))
    for place, (size, count) in enumerate(zip(sizes, groups, strict=True)):
        scatter[place] = of_start[: size * count].reshape(count, size).mean(axis=1).std(ddof=1)
    observed = Curve(sizes, scatter, "", "", "o", INK, 2 * scatter / np.sqrt(2.0 * (groups - 1)), 3.5)
    ends = sizes[[0, -1]]
    law = Curve(ends, scatter[0] * ends**-0.5, r"$k^{-1/2}$ from $k = 1$", colour=VERMILION)
    log = "xy" if (scatter > 0).all() else "x"  # starts on one periodic orbit may agree to the last bit
    right = Panel([observed, law], r"starts averaged, $k$", "scatter of the mean (nats per time)", log=log)
    return curves([[running_panel, right]], 2.8, "upper right")


def oscillator_diagram(values, strobed, exponents, errors, slack, label: str, marks) -> Picture:
    """Strobed displacement, both exponents and the slack share under it on the same axis.

    Args: `values` (p,); `strobed` (p, m); `exponents` (p, n, 2) and `errors` (p, n) of lambda_1, nats per time;
    `slack` (p, n); `label` of the parameter's axis; `marks` (value, text) drawn as vertical lines.
    """
    first, second = exponents[..., 0], exponents[..., 1]
    across = np.broadcast_to(values[:, None], first.shape)
    positive = first - 2.0 * errors > 0.0

    def dots(x: np.ndarray, y: np.ndarray, name: str, colour: str, size: float) -> Curve:
        return Curve(x.ravel(), y.ravel(), name, "", "o", colour, size=size)

    lines = [
        dots(across, second, r"$\lambda_2$", SOFT, 1.0),
        dots(across[~positive], first[~positive], r"$\lambda_1$", BLUE, 1.3),
        dots(across[positive], first[positive], r"$\lambda_1$, above 0 by two errors", VERMILION, 1.3),
    ]
    share = Panel([dots(across, slack, "", BLUE, 1.0)], y_label="slack share\n(–)", settings={"ylim": (-0.03, 1.03)})
    below = [Panel(lines, y_label="exponents\n(nats per time)", level=0.0), share]
    inside = [(at, text) for at, text in marks if values[0] <= at <= values[-1]]
    columns = []
    for at, points in zip(values, strobed, strict=True):
        columns.append(Strobes(at, points[np.isfinite(points)]))
    return OrbitDiagram(columns, (label, r"strobed $\gamma$ (–)"), below, marks=inside).drawn()
