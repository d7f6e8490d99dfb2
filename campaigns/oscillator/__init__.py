"""Eq. (33), the snap oscillator: section, exponents, orbit diagrams, periodic orbits, and a report.

    python -m campaigns.oscillator                            the paper's figure 19(b), in about a minute
    python -m campaigns.oscillator --effort 0.02              the same with a fiftieth of the work
    python -m campaigns.oscillator --set force=1.2 phase=0.5  other parameters of the equation

Protocol: the motion is integrated exactly (closed form within each piece), so there is no step and no tolerance to
choose. Every part is one row of table.csv, and its arrays are one file; parts found there are not done again. Random
starts come from a fixed seed.
"""

from campaigns.oscillator.options import Options
from campaigns.study import Order, Study
from tables import Rows, number_of


def _work():
    """What takes a second to import, which --help does not need."""
    from campaigns.oscillator import study

    return study


def answer(order: Order, rows: Rows) -> list[str]:
    """The exponent in words, where that part has a result; the force up to which the line stays taut."""
    from analysis.oscillator import SnapOscillator, grazing_force

    sentences = []
    exponents = next((row for row in rows if row["part"] == "exponents" and row["status"] == "ok"), None)
    if exponents is not None:
        value, error = number_of(exponents, "lambda_1_bits_per_period"), number_of(exponents, "lambda_1_bits_error")
        word = "neither shown chaotic nor regular"
        if value > 2 * error:
            word = "chaotic"
        elif value < -2 * error:
            word = "regular"
        sentences.append(f"The motion is {word}: largest exponent {value:.4f} +- {error:.4f} bits per forcing period.")
        starts, elsewhere = number_of(exponents, "starts"), number_of(exponents, "elsewhere")
        if elsewhere > 0:
            others = f"{elsewhere:.0f} of {starts:.0f} starts"
            sentences.append(f"The start decides: {others} end in a periodic motion instead.")
    force = grazing_force(SnapOscillator(**order.options.changes))
    if force > 0.0:
        sentences.append(f"The line stays taut up to a force of F = {force:.4f}.")
    return sentences


STUDY = Study(
    name="oscillator",
    protocol=__doc__,
    options=Options,
    parameters=lambda order: _work().parameters(order.options),
    perform=lambda order: _work().perform(order),
    answer=answer,
    places=("jobs",),
)
main, read_order = STUDY.main, STUDY.read_order
