"""The whole paper again: figures 2-7 and 9-20, every statement with a verdict, and what the answer depends on.

    python -m campaigns.paper                          everything, in under half an hour on two cores; again: nothing
    python -m campaigns.paper --parts breaking_line    one part, beside those that are in the folder already
    python -m campaigns.paper --quick                  short and few runs in three to five minutes, to see what there is

Protocol: the other campaigns run as parts, each in a folder of its own with its own report (`campaigns.paper.parts`);
`dependence` runs the two waves of section 4.2 with other answers to what the paper leaves out. The report, the data of
the figures and statements.csv are made from these folders alone. Random starts of eq. (33) come from a fixed seed,
nothing else is random. To change a scene, run the campaign of that part.
"""

import os
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from campaigns.machinery import Summary, cli, ended, stage
from campaigns.paper.order import PARTS
from campaigns.study import Order, Study
from tables import Rows


@dataclass
class Options(cli.Options):
    """The options of this campaign. out: that of the command, the folder of the results."""

    parts: list[str] = cli.option(
        "A B ...", f"parts to run (default: {' '.join(PARTS)})", cli.one_of(PARTS), PARTS, many=True
    )
    quick: bool = cli.flag("shorter and fewer runs: shows the report, concludes nothing")
    out: Path | None = None

    def read(self, faults: list[str]) -> None:
        """The parts in the order in which they run."""
        self.parts = [part for part in PARTS if part in self.parts]
        for part in PARTS:
            path = self.out / part
            if os.path.exists(path) and not os.path.isdir(path):  # pathlib raises where a name is too long
                given = f"--out: given {str(self.out)!r}, where {part} is a file"
                faults.append(f"{given}; allowed: a folder of this campaign")


def perform(order: Order) -> Summary:
    """Parts, figure data, statements; the latter two stay as they are where nothing is new."""
    from campaigns.paper import parts, results

    out = order.how.out
    summary = parts.run(order)
    complete = ended(out) and not summary.computed and results.is_there(out, order.how.report)
    if not complete:
        with stage("figures' data and statements"):
            results.write(out)
    return replace(summary, whole=complete)


def parameters(order: Order) -> dict:
    """What the provenance says of this campaign."""
    from campaigns.paper import dependence, results

    quick = order.options.quick
    return {"quick": quick, "made_by": results.maker(), "dependence": dependence.parameters(quick)}


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """How many of the paper's statements hold; a quick look at few and short runs says that it decides nothing."""
    from campaigns.answers import verdicts

    if order.options.quick:
        yield "A quick look: runs are few and short, so nothing is to be concluded from them."
    else:
        yield from verdicts(order.how.out, quoted=5)


STUDY = Study(
    name="paper",
    protocol=__doc__,
    options=Options,
    parameters=parameters,
    perform=perform,
    answer=answer,
    places=("jobs",),
)
main, read_order = STUDY.main, STUDY.read_order
