"""Orbit diagram of eq. (33) as an image of counts, both exponents and the slack share under it on the same axis."""

from __future__ import annotations

import numpy as np

from ..parts.content import Picture
from ..parts.style import BLUE, DENSITY_COLOURS, SOFT, VERMILION, picture_of, sheet

_ROWS = 320


def oscillator_diagram(values, strobed, exponents, errors, slack, label: str, marks) -> Picture:
    """Density of strobed displacement, exponents, slack.

    Args: `values` (p,); `strobed` (p, m); `exponents` (p, n, 2) and `errors` (p, n) of lambda_1, nats per time;
    `slack` (p, n); `label` of the parameter's axis; `marks` (value, text) drawn as vertical lines.
    """
    from matplotlib.colors import LinearSegmentedColormap, LogNorm

    finite = strobed[np.isfinite(strobed)]
    edges = np.linspace(finite.min() - 1e-6, finite.max() + 1e-6, _ROWS + 1)
    counts = np.array([np.histogram(column, edges)[0] for column in strobed]).T
    half = 0.5 * (values[1] - values[0])
    with sheet(6.2) as figure:
        top, middle, low = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": [3, 1.7, 0.8]})
        top.grid(False)
        colours = LinearSegmentedColormap.from_list("density", DENSITY_COLOURS)
        mesh = top.pcolormesh(
            np.append(values - half, values[-1] + half),
            edges,
            np.ma.masked_equal(counts, 0),
            norm=LogNorm(1, max(int(counts.max()), 2)),
            cmap=colours,
            rasterized=True,
        )
        figure.colorbar(mesh, ax=[top, middle, low], label="points in a pixel", aspect=50, pad=0.01)
        top.set_ylabel(r"strobed $\gamma$ (–)")
        first, second = exponents[..., 0], exponents[..., 1]
        across = np.broadcast_to(values[:, None], first.shape)
        positive = first - 2.0 * errors > 0.0
        middle.plot(across.ravel(), second.ravel(), ".", color=SOFT, markersize=1.3, label=r"$\lambda_2$")
        middle.plot(across[~positive], first[~positive], ".", color=BLUE, markersize=2.0, label=r"$\lambda_1$")
        middle.plot(
            across[positive], first[positive], ".", color=VERMILION, markersize=2.0,
            label=r"$\lambda_1$, above 0 by two errors",
        )  # fmt: skip
        middle.axhline(0.0, color=SOFT, linewidth=0.7)
        middle.set_ylabel("exponents\n(nats per time)")
        middle.legend(loc="lower center", bbox_to_anchor=(0.5, 0.99), ncols=3, markerscale=4, borderpad=0.1)
        low.plot(across.ravel(), slack.ravel(), ".", color=BLUE, markersize=1.3)
        low.set_ylim(-0.03, 1.03)
        low.set_ylabel("slack share\n(–)")
        low.set_xlabel(label)
        for at, text in marks:
            if values[0] <= at <= values[-1]:
                for axes in (top, middle, low):
                    axes.axvline(at, color=SOFT, linewidth=0.8, linestyle=(0, (3, 2)))
                top.annotate(
                    text, (at, 1.0), xycoords=("data", "axes fraction"), fontsize=7.5, ha="center", va="bottom"
                )
        low.set_xlim(values[0] - half, values[-1] + half)
        figure.align_ylabels([top, middle, low])
        return picture_of(figure, "png")
