"""The findings on a sea, or on a map of seas, in lines: loads, snaps, motions, memory of the start, chaos, doubts."""

import math
from collections import Counter
from collections.abc import Iterator

from campaigns.answers import greatest, in_newtons, line
from campaigns.explore.load import OVERBUOYANT
from campaigns.sea.cells import WELL_ABOVE
from engine.trajectory.excursions import EMERGES
from tables import EMERGED, TANGENT_ERROR, TANGENT_EXPONENT, Row, Rows, count, number_of, typed

SCATTERED = 0.05  # of the largest tension: a larger difference of runs in the same waves is reported
ROUNDED_UP = 1.05  # times a number, in print with two digits: no less than the number
FAILED = "No run ended, so there is nothing to say of this sea."


def sentences(cells: Rows, options) -> Iterator[str]:
    """At most eight sentences, from the rows of cells/table.csv. options: of the campaign."""
    known = [cell for cell in cells if cell["status"] == "ok"]
    if not known:
        yield FAILED
    elif len(cells) == 1:
        yield from _of_sea(known[0], options)
    else:
        yield from _of_map(known, len(cells), options)


def _of_sea(cell: Row, options) -> Iterator[str]:
    yield line("LOAD", _load(cell))
    yield line("FATIGUE", _fatigue(cell, options))
    yield line("SNAPS", _snaps(cell))
    yield line("MOTIONS", _visits(cell, options))
    yield line("STARTS", _memory(cell, options))
    if math.isfinite(cell[TANGENT_EXPONENT]):
        yield line("CHAOS", _exponent(cell, options))
    for doubt in _doubts(cell, options):
        yield line("CHECK", doubt)


def _memory(cell: Row, options) -> str:
    """Whether the start is forgotten, and after how many periods."""
    seas, apart_seas = cell["seas"], cell["apart_seas"]
    sign, periods = cell["sign"], cell["together_periods"]
    if sign == "+":
        words = "In this sea the buoy never forgets how it began: two starts stay apart however near they are"
        if math.isfinite(periods):
            words += f", but for spells of {cell['together_mean_periods']:.0f} periods on average"
        return f"{words}."
    if not sign:
        memory = "the starts were not seen to come together"
        if math.isfinite(periods):
            met = count(int(seas - apart_seas), "sea")
            memory = f"the starts come together after about {_rounded(periods)} periods in {met}"
        return f"There is no exponent, because no run carries a perturbation for long enough; {memory}."
    if sign != "−":
        decides = "longer runs (--hours) or more seas (--seeds) decide"
        if options.one_sea:
            decides = "longer runs (--hours) decide"
        elif options.most_hours:
            decides = f"--most-hours above {options.most_hours:g} draws more seas"
        return f"It is not decided whether this sea makes the buoy forget how it began: {decides}."
    if options.starts < 2:
        return "In this sea the buoy forgets a small difference of the start; with --starts 4 it is seen how fast."
    if not math.isfinite(periods):
        return (
            f"In this sea small differences of the start die out, but the {options.starts} starts were still apart at "
            "the end in every sea: there is more than one response."
        )
    words = f"In this sea the buoy forgets how it began after about {_rounded(periods)} periods"
    if apart_seas > 0:
        words += f"; in {apart_seas:.0f} of {seas:.0f} seas its starts were still apart at the end"
    partings = cell["partings_per_hour"]
    if partings > 0.0:
        words += f"; then groups of waves part the starts again {partings:.2g} times an hour"
    return f"{words}."


def _exponent(cell: Row, options) -> str:
    return (
        f"A small difference changes by {cell[TANGENT_EXPONENT]:+.3f} ± {cell[TANGENT_ERROR]:.3f} bits a peak period; "
        f"it grows in {100 * cell['growing_share']:.0f} % of the windows of {options.window} periods."
    )


def _visits(cell: Row, options) -> str:
    """How long the buoy is in the large motion of regular waves, beside the forecast by a slow envelope."""
    if options.no_regular:
        return "Motions of regular waves were left out."
    share, forecast = cell["large_share"], cell["forecast_share"]
    if not math.isfinite(share):
        return "In no regular wave up to 1.86 H_s were a small and a large motion found, so neither has a share."
    words = f"It is in the large motion {_percent(share)} of the time"
    if share > 0.0:
        words += f", for {cell['large_mean_periods']:.0f} periods on average"
    words += f"; a slow envelope would give {_percent(forecast)}"
    if forecast > 0.0:
        words += f" and {cell['forecast_mean_periods']:.0f} periods"
    return f"{words}."


def _snaps(cell: Row) -> str:
    rate, error = cell["snaps_per_hour"], cell["snaps_per_hour_error"]
    if not math.isfinite(rate):
        return "not counted, because the line bears no tension at rest."
    words = f"{rate:.0f} an hour"
    if math.isfinite(error):
        words += f" (± {error:.0f})"
    return f"{words}."


def _load(cell: Row) -> str:
    """The three-hour maximum, and what speaks against it."""
    if number_of(cell, EMERGED) > EMERGES:
        return f"{_storm(cell)} Not for design: {OVERBUOYANT}."
    return _storm(cell)


def _storm(cell: Row) -> str:
    storm_N = cell["storm_maximum_N"]
    if not math.isfinite(storm_N):
        largest = in_newtons(cell["largest_N"])
        return f"largest tension of the runs from rest {largest}; no three-hour maximum: {cell['storm_reason']}."
    words = (
        f"most probable three-hour maximum {in_newtons(storm_N)} (90 % interval {in_newtons(cell['storm_low_N'])} to "
        f"{in_newtons(cell['storm_high_N'])}) in a sea of H_s = {cell['significant_height_m']:.3g} m"
    )
    regular_N, regular_high_N, used = cell["regular_N"], cell["regular_high_N"], cell["utilisation"]
    if math.isfinite(regular_N):
        words += f", {storm_N / regular_N:.1f} times that of the regular design wave of H_s"
    if math.isfinite(regular_high_N):
        words += f" and {storm_N / regular_high_N:.1f} times that of 1.86 H_s"
    if math.isfinite(used):
        return f"{words}; with the factors of DNV-OS-E301, consequence class 1, the line is used to {100 * used:.0f} %."
    return f"{words}; tether.breaking_load_N gives the utilisation."


def _fatigue(cell: Row, options) -> str:
    return (
        f"one cycle of {in_newtons(cell['equivalent_load_N'])} a peak period does the damage of the sea "
        f"(S-N slope {options.slope:g})."
    )


def _doubts(cell: Row, options) -> Iterator[str]:
    """How finer runs compare, and what makes loads and responses doubtful."""
    value, error = cell[TANGENT_EXPONENT], cell[TANGENT_ERROR]
    finer, finer_error = cell["finer_bits_per_period"], cell["finer_error"]
    if math.isfinite(finer):
        agrees = "agrees"
        if abs(finer - value) > 2.0 * math.hypot(error, finer_error):
            agrees = "does NOT agree"
        yield f"The exponent of finer runs {agrees}: {finer:+.3f} ± {finer_error:.3f} bits a peak period."
    scatter = cell["load_scatter"]
    if scatter > SCATTERED:
        words = "Runs in the same waves, from other starts or with finer steps, differ by"
        words += f" {100 * scatter:.0f} % in their largest tension"
        if math.isfinite(cell["storm_maximum_N"]):
            words += "; the interval of LOAD has only those from rest"
        yield f"{words}."
    noise = cell["noise"]
    if noise * WELL_ABOVE > options.distance:
        yield (
            f"Starts that are together are still {noise:.2g} of the motion apart, by the steps of the solver: use a "
            f"smaller solver.rtol, or --distance above {ROUNDED_UP * WELL_ABOVE * noise:.2g}."
        )


def _of_map(cells: Rows, of_all: int, options) -> Iterator[str]:
    """cells: those with runs that ended; of_all: how many there are."""
    signs = Counter(cell["sign"] for cell in cells)
    words = (
        f"Of {of_all} sea states {signs['−']} make the buoy forget how it began, {signs['+']} never do, and "
        f"{signs['open']} are not decided"
    )
    unknown = of_all - signs["−"] - signs["+"] - signs["open"]
    if unknown:
        words += f"; of {unknown} there is no exponent, because no run carries a perturbation for long enough"
    if signs["open"] and not options.one_sea:
        words += f"; --most-hours above {options.most_hours:g} draws more seas of those that are not decided"
    yield f"{words}."
    for name, quantity, in_print in (
        ("large_share", "share of the large motion", _percent),
        ("storm_maximum_N", "three-hour maximum", in_newtons),
    ):
        worst = greatest(cells, name)
        if worst is not None:
            place = " and ".join(f"{key.key} = {typed(worst[key.key])}" for key in options.grid.keys)
            yield f"The {quantity} is largest at {place}: {in_print(worst[name])}."
    dry = sum(number_of(cell, EMERGED) > EMERGES for cell in cells)
    if dry:
        yield f"No load of {count(dry, 'state')} is for design: {OVERBUOYANT}."
    refused = sum(not math.isfinite(cell["storm_maximum_N"]) for cell in cells)
    if refused:
        yield f"{refused} states have no three-hour maximum; the column storm_reason says why."


def _rounded(periods: float) -> str:
    """A median over seas in print: to ten periods, and from 1000 on to a hundred, because it is known no better."""
    if periods >= 1000.0:
        return f"{round(periods, -2):.0f}"
    if periods >= 10.0:
        return f"{round(periods, -1):.0f}"
    return f"{periods:.0f}"


def _percent(share: float) -> str:
    """ "12 %" of a share of 0.12."""
    return f"{typed(100.0 * share, 2)} %"
