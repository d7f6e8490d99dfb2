"""The whole paper again: figures 2-7 and 9-20, every statement with a verdict, and what the answer depends on.

    python -m campaigns.paper                          everything, in under half an hour on two cores; again: nothing
    python -m campaigns.paper --parts breaking_line    one part, beside those that are in the folder already
    python -m campaigns.paper --quick                  short and few runs in two minutes, to see what there is

Protocol: the other campaigns run as parts, each in a folder of its own with its own report (`campaigns.paper.parts`);
`dependence` runs the two waves of section 4.2 with other answers to what the paper leaves out. The report, the data of
the figures and statements.csv are made from these folders alone. Random starts of eq. (33) come from a fixed seed,
nothing else is random. To change a scene, run the campaign of that part.
"""

import time

from campaigns.machinery import cli
from campaigns.machinery.session import command, command_line
from campaigns.paper.order import PARTS, Order

CAMPAIGN = "paper"
MODULE = "campaigns.paper"


def main(argv: list[str] | None = None) -> int:
    """The command. Returns the exit code (0, 1, 2 or 130)."""
    return command(MODULE, argv, read_order, study)


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is run")
    parts = f"parts to run (default: {' '.join(PARTS)})"
    cli.add(what, "--parts", "A B ...", parts, cli.one_of(PARTS), PARTS, many=True)
    shorter = "shorter and fewer runs: shows the report, concludes nothing"
    what.add_argument("--quick", action="store_true", help=shorter)
    cli.add_running(parser.add_argument_group("how and where"), CAMPAIGN, backends=False)
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    how = cli.running(options, CAMPAIGN, faults)
    for part in PARTS:
        if (how.out / part).exists() and not (how.out / part).is_dir():
            faults.append(f"--out: given {str(how.out)!r}, where {part} is a file; allowed: a folder of this campaign")
    return Order(tuple(part for part in PARTS if part in options.parts), options.quick, how)


def study(order: Order, argv: list[str]) -> int:
    """Run it: parts, figure data, statements, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.machinery import session
    from campaigns.machinery.folder import claimed
    from campaigns.paper import dependence, parts, results

    begun = time.perf_counter()
    with claimed(order.how.out):
        parameters = {"jobs": order.how.jobs, "quick": order.quick, "made_by": results.maker()}
        parameters |= {"dependence": dependence.parameters(order.quick)}
        record, same = session.begun(order.how.out, CAMPAIGN, command_line(MODULE, argv), parameters)
        timing, summary = parts.run(order)
        whole = same and not summary.computed and results.there(order.how.out, order.how.report)
        if not whole:
            results.write(order.how.out)
            session.finish(order.how.out, record, summary, timing)
        fault = session.report(order.how.out, order.how.report and not whole, timing, begun)
    return session.say(order.how.out, summary, timing, order.how.report, fault)
