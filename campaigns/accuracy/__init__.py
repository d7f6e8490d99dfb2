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
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path

from campaigns.accuracy.points import FACTORS, FULL, LONG_PERIODS, QUICK, Effort, Point
from campaigns.accuracy.works import BY_NAME, PERIOD_S, UNITS, Work
from campaigns.machinery import cli
from campaigns.machinery.kept_run import KeptRun

CAMPAIGN = "accuracy"
MODULE = "campaigns.accuracy"


@dataclass(frozen=True)
class Order:
    """What the command line asks for, checked."""

    effort: Effort
    quick: bool
    peers: bool
    how: cli.Running


def main(argv: list[str] | None = None, simulate=None) -> int:
    """The command. simulate: in place of engine.simulate, same signature. Returns the exit code (0, 1, 2 or 130)."""
    return cli.command(MODULE, argv, read_order, partial(study, simulate=simulate))


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

    def rounds(text: str) -> int:
        number = cli.whole(1)(text)
        if number > len(FACTORS):
            raise ValueError(text)
        return number

    said = f"a whole number from 1 to {len(FACTORS)}"
    count = cli.value(options.rounds, "--rounds", effort.rounds, rounds, said, faults)
    effort = replace(effort, works=tuple(name for name in FULL.works if name in works), rounds=count)
    how = cli.running(options, CAMPAIGN, faults)
    return Order(effort, options.quick, not options.no_peers, how)


def study(order: Order, argv: list[str], simulate) -> int:
    """Run it: untimed runs, timed ones, tables, report. Raises CampaignStopped, OSError, KeyboardInterrupt."""
    from campaigns.accuracy.plan import first_phase, second_phase, third_phase
    from campaigns.accuracy.rows import COLUMNS
    from campaigns.machinery import session
    from campaigns.machinery.runner import plan_of

    ours = simulate is None
    if ours:
        from engine import simulate
    plan = plan_of(order.how, simulate, _undescribed, COLUMNS, _maker())
    known: dict[tuple[str, str], KeptRun] = {}
    first = engine_jobs(first_phase(order.effort), known)
    for job in first:
        known[job.labels["work"], job.labels["kind"]] = KeptRun(_file(order.how.out, job.key))
    second = engine_jobs(second_phase(order.effort), known)
    third = engine_jobs(third_phase(order.effort), known)
    others = _peer_jobs(order, known) if order.peers and ours else ([], [], [])
    phases = [first + others[0], second + others[1], side_by_side(third, others[2], order.effort.rounds)]
    runs = partial(_in_phases, phases=phases, costs=ours, quick=order.quick)
    jobs = [job for phase in phases for job in phase]
    return session.conduct(CAMPAIGN, MODULE, argv, plan, jobs, _parameters(order), report=order.how.report, runs=runs)


def side_by_side(ours: list, others: list, rounds: int) -> list:
    """Timed jobs in the order in which they run: those of other codes, which run once, in the middle round of ours on
    the same work, so that the machine's noise meets both."""
    middle = rounds // 2
    found = [job for job in ours if job.labels["round"] < middle]
    rest = [job for job in ours if job.labels["round"] == middle]
    for work in dict.fromkeys(job.labels["work"] for job in (*rest, *others)):
        found += [job for job in (*rest, *others) if job.labels["work"] == work]
    return found + [job for job in ours if job.labels["round"] > middle]


def _in_phases(plan, jobs: list, phases: list, costs: bool, quick: bool):
    """References, what is not timed, and what is: the last one run at a time. Then the tables that follow from them."""
    from campaigns.accuracy import orders, pieces
    from campaigns.machinery import session

    found = sum(_file(plan.directory, key).exists() for key in {job.key for job in jobs})
    timing, done = {"compile_s": 0.0, "run_s": 0.0, "analysis_s": 0.0}, []
    for how, phase in zip((plan, plan, replace(plan, backend="threading", jobs=1)), phases, strict=True):
        done += phase
        more, summary = session.run(how, done)
        timing = {name: timing[name] + more[name] for name in timing}
    orders.write(plan.directory, summary.rows)
    if costs:
        pieces.keep(plan.directory, quick)
    return timing, replace(summary, computed=len(summary.rows) - found, found=found)


def _undescribed(trajectory):
    raise NotImplementedError("every run of this campaign is described by its own job")


def _maker() -> str:
    from campaigns.machinery.row_store import made_by

    return made_by({}, "campaigns/breaking_line/theory", "engine", "campaigns/accuracy/rows.py", "campaigns/accuracy/works.py")


def engine_jobs(points: list[Point], references: dict[tuple[str, str], KeptRun]) -> list:
    """Jobs of the engine's points; references: the runs that errors are taken against, by work and kind."""
    from campaigns.accuracy.rows import point_row
    from campaigns.machinery.runner import make_job

    jobs = []
    for point in points:
        work = BY_NAME[point.work]
        length_s = LONG_PERIODS * PERIOD_S if point.kind == "long" else work.duration_s
        against = "grid" if point.kind == "tolerance" else "reference"
        reference = None if point.kind in ("reference", "long") else references.get((work.name, against))
        describe = partial(point_row, work_name=work.name, reference=reference)
        scene = work.made(point.changes())
        made = f"{point.kind}-{point.round}"
        jobs.append(make_job(scene, duration_s=length_s, labels=asdict(point), describe=describe, made=made))
    return jobs


def _file(out: Path, key: str) -> Path:
    from campaigns.machinery.folder import trajectory_path

    return trajectory_path(out, key)


def _peer_jobs(order: Order, references: dict[tuple[str, str], KeptRun]) -> tuple[list, list, list]:
    from campaigns.accuracy.peers import peer_jobs

    ours = {work: path for (work, kind), path in references.items() if kind == "reference"}
    return peer_jobs(order.how.out, order.effort.works, order.quick, ours)


def _parameters(order: Order) -> dict[str, object]:
    from campaigns.accuracy.peers import notes
    from campaigns.machinery.machine import machine

    return {
        "works": {name: _described(BY_NAME[name]) for name in order.effort.works},
        "quick": order.quick,
        "rounds": order.effort.rounds,
        "peers": order.peers,
        "peer_notes": notes(order.effort.works, order.quick) if order.peers else {},
        "machine": machine(),
    }


def _described(work: Work) -> dict[str, object]:
    return {
        "title": work.title,
        "measure": work.measure,
        "unit": UNITS[work.measure],
        "period_s": work.period_s,
        "duration_s": work.duration_s,
        "rough": work.rough,
    }


def one_thread() -> None:
    """Linear algebra on one thread, as every other solver that is timed; to be called before NumPy is imported.

    The matrices of scipy's solvers are small: on a busy machine two threads were seen to take a hundred times longer.
    """
    for library in ("OPENBLAS", "OMP", "MKL"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
