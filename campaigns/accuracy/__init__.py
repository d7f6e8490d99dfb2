"""Error against run time: every method of the engine, solvers of scipy and other codes on seven works, and a report.

    python -m campaigns.accuracy                          all works, about ten minutes on two cores
    python -m campaigns.accuracy --quick                  three works, few settings, in half a minute
    python -m campaigns.accuracy --works snap violent     some of them

Protocol: refined runs, series of halved steps and of doubled grids first, side by side. Then what is timed, one run at
a time: all settings in turns, round by round, each round with another tolerance or step near the one named; medians are
reported. Run time is that of stepping alone, without compilation, statics, input and output. Other codes are held
against their own refined runs and against ours; what is not installed is a row that says so. Nothing is random.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

from campaigns.accuracy.plan import FACTORS, FULL, QUICK, Effort
from campaigns.accuracy.works import BY_NAME, UNITS
from campaigns.machinery import cli
from campaigns.machinery.command import command

CAMPAIGN = "accuracy"
MODULE = "campaigns.accuracy"


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked."""

    effort: Effort
    quick: bool
    peers: bool
    how: cli.Running


def main(argv: list[str] | None = None, simulate: Callable | None = None) -> int:
    """The command. simulate: in place of engine.simulate, same signature. Returns the exit code (0, 1, 2 or 130)."""
    return command(MODULE, argv, read_order, partial(study, simulate=simulate))


def parser():
    """The options of this campaign."""
    parser = cli.parser(MODULE, __doc__)
    what = parser.add_argument_group("what is run")
    cli.add(what, "--works", "A B ...", f"works (default: {' '.join(FULL.works)})")
    cli.add(what, "--rounds", "N", f"turns of every timed setting, 1 to {len(FACTORS)} (default: {FULL.rounds})")
    what.add_argument(
        "--quick", action="store_true", help=f"{' and '.join(QUICK.works)} alone, few settings, one round"
    )
    what.add_argument("--no-peers", action="store_true", help="leave out scipy and other codes")
    cli.add_running(parser.add_argument_group("how and where"), f"results/{CAMPAIGN}")
    return parser


def read_order(argv: list[str], faults: list[str]) -> Order:
    """The order in the words of the command line; every fault is appended to `faults`."""
    options = cli.split(parser(), argv, faults)
    effort = QUICK if options.quick else FULL
    if options.works == []:
        faults.append(f"--works: given nothing; allowed: one or more of {', '.join(FULL.works)}")
    allowed = "one of " + ", ".join(FULL.works)
    words = options.works or list(effort.works)
    works = cli.values(words, "--works", list(effort.works), cli.one_of(FULL.works), allowed, faults)
    said = f"a whole number from 1 to {len(FACTORS)}"
    count = cli.value(options.rounds, "--rounds", effort.rounds, cli.whole(1, len(FACTORS)), said, faults)
    effort = replace(effort, works=tuple(name for name in FULL.works if name in works), rounds=count)
    how = cli.running(options, CAMPAIGN, faults)
    return Order(effort, options.quick, not options.no_peers, how)


def study(order: Order, argv: list[str], simulate: Callable | None) -> int:
    """Run it: untimed runs, timed ones, tables, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.machinery import session

    where = {"backend": order.how.backend, "jobs": order.how.jobs, "dask_address": order.how.dask_address}
    work = partial(done, order, simulate)
    return session.conduct(CAMPAIGN, MODULE, argv, order.how, _parameters(order) | where, work)


def done(order: Order, simulate: Callable | None):
    """References, what is not timed, and what is: the last one run at a time. Then the tables that follow from them.

    Returns times and summary.
    """
    from campaigns.accuracy import jobs, orders, pieces
    from campaigns.accuracy.rows import COLUMNS
    from campaigns.machinery.folder import trajectory_path
    from campaigns.machinery.plan import plan_of
    from campaigns.machinery.row_cache import made_by
    from campaigns.machinery.runner import run, write_scene

    out, ours = order.how.out, simulate is None
    if ours:
        from engine import simulate
    own = (f"campaigns/accuracy/{name}" for name in ("rows.py", "works.py", "works.toml"))
    maker = made_by({}, "campaigns/breaking_line/theory", "engine", *own)
    plan = plan_of(order.how, simulate, jobs.point_row, COLUMNS, maker)
    phases = jobs.phases(out, order.effort, order.quick, order.peers and ours)
    write_scene(out, CAMPAIGN, next(filter(None, phases)))
    found = sum(trajectory_path(out, key).exists() for key in {job.key for phase in phases for job in phase})
    timing, known = {"compile_s": 0.0, "run_s": 0.0, "analysis_s": 0.0}, []
    for how, phase in zip((plan, plan, replace(plan, backend="threading", jobs=1)), phases, strict=True):
        known += phase
        more, summary = run(how, known)
        timing = {name: timing[name] + more[name] for name in timing}
    orders.write(out, summary.rows)
    if ours:
        pieces.keep(out, order.quick)
    return timing, replace(summary, computed=len(summary.rows) - found, found=found)


def _parameters(order: Order) -> dict[str, object]:
    from campaigns.accuracy.peers import notes
    from campaigns.machinery.machine import machine

    told = ("title", "measure", "period_s", "duration_s", "rough")
    works = [BY_NAME[name] for name in order.effort.works]
    return {
        "works": {
            work.name: {name: getattr(work, name) for name in told} | {"unit": UNITS[work.measure]} for work in works
        },
        "quick": order.quick,
        "rounds": order.effort.rounds,
        "peers": order.peers,
        "peer_notes": notes(order.effort.works, order.quick) if order.peers else {},
        "machine": machine(),
    }


def one_thread() -> None:
    """Linear algebra on one thread, as every other solver that is timed; to be called before NumPy is imported.

    The matrices of scipy's solvers are small: on a busy machine two threads were seen to take a hundred times longer.
    """
    for library in ("OPENBLAS", "OMP", "MKL"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
