"""Stiff and extreme scenes, random scenes, one-step maps, and what each part of a scene costs: a table and a report.

    python -m campaigns.stability                     everything, in about eight minutes on two cores
    python -m campaigns.stability --quick             the cases that matter most, a few random scenes: half a minute
    python -m campaigns.stability --fuzz 2000         as many random valid scenes, and as many invalid ones
    python -m campaigns.stability --drift-periods 0   leave out the long run

Protocol: every case is run to a verdict (ok, refused with a reason, a known limit, unexplained) in a process of its own
with a time limit, and says how its verdict is known: energy, refinement, closed form. Random scenes come from a fixed
seed. A verdict "unexplained" ends the campaign with exit code 1.
"""

from dataclasses import dataclass

from campaigns.machinery import cli
from campaigns.machinery.command import command

CAMPAIGN = "stability"
MODULE = "campaigns.stability"
FUZZ, QUICK_FUZZ = 1000, 40
DRIFT_PERIODS = 100_000


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked. fuzz: random scenes of each kind; drift_periods: 0 leaves it out."""

    quick: bool
    fuzz: int
    seed: int
    drift_periods: int
    how: cli.Running


def main(argv: list[str] | None = None) -> int:
    """The command. Returns the exit code (0, 1, 2 or 130)."""
    return command(MODULE, argv, read_order, study)


def parser():
    """The options of this campaign."""
    exits = "exit codes: 0 done, 1 unexplained verdicts, or stopped (disk full, no report), 2 bad input, 130 Ctrl-C"
    parser = cli.parser(MODULE, __doc__, exits)
    what = parser.add_argument_group("what is run")
    what.add_argument("--quick", action="store_true", help="fewer cases, fewer random scenes, no long run")
    cli.add(what, "--fuzz", "N", f"random scenes, N valid and N invalid (default: {FUZZ}; {QUICK_FUZZ} with --quick)")
    cli.add(what, "--seed", "N", "seed of the random scenes (default: 0)")
    periods = f"wave periods of the long regular run, 0 for none (default: {DRIFT_PERIODS}; 0 with --quick)"
    cli.add(what, "--drift-periods", "N", periods)
    where = parser.add_argument_group("how and where")
    cli.add(where, "--jobs", "N", f"cases at the same time (default: {cli.default_jobs()})")
    found = "folder of the results; what is found there is not done again"
    cli.add(where, "--out", "DIR", f"{found} (default: results/{CAMPAIGN})")
    where.add_argument("--no-report", action="store_true", help="leave out report.html and report.pdf")
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    quick = options.quick

    def number(words, option, usual, least):
        return cli.value(words, option, usual, cli.whole(least), cli.WHOLE.format(least), faults)

    fuzz = number(options.fuzz, "--fuzz", QUICK_FUZZ if quick else FUZZ, 0)
    seed = number(options.seed, "--seed", 0, 0)
    periods = number(options.drift_periods, "--drift-periods", 0 if quick else DRIFT_PERIODS, 0)
    if 0 < periods < 1000:
        faults.append(f"--drift-periods: given {periods}; allowed: 0, or 1000 and above")
    jobs = number(options.jobs, "--jobs", cli.default_jobs(), 1)
    how = cli.Running(cli.folder(options, CAMPAIGN, faults), jobs, "loky", None, not options.no_report)
    return Order(quick, fuzz, seed, periods, how)


def study(order: Order, argv: list[str]) -> int:
    """Run it: tasks, tables, provenance, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.machinery import session
    from campaigns.stability import tasks

    rows = []

    def work():
        timing, summary = tasks.done(order)
        rows.extend(summary.rows)
        return timing, summary

    parameters = {"seed": order.seed, "quick": order.quick, "fuzz": order.fuzz, "drift_periods": order.drift_periods}
    code = session.conduct(CAMPAIGN, MODULE, argv, order.how, parameters | {"jobs": order.how.jobs}, work)
    return code or (cli.EXIT_FAILED if any(row["status"] != "ok" for row in rows) else cli.EXIT_OK)
