"""Error against run time: every method of the engine, solvers of scipy and other codes on seven works, and a report.

    python -m campaigns.accuracy                          all works, about ten minutes on two cores
    python -m campaigns.accuracy --quick                  three works, few settings, in half a minute
    python -m campaigns.accuracy --works snap violent     some of them

Protocol: refined runs, series of halved steps and of doubled grids first, side by side. Then what is timed, one run at
a time: all settings in turns, round by round, each round with another tolerance or step near the one named; medians are
reported. Run time is that of stepping alone, without compilation, statics, input and output. Other codes are held
against their own refined runs and against ours; what is not installed is a row that says so. Nothing is random.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import isfinite
from statistics import median

import engine
from campaigns.accuracy.plan import BEST, BY_NAME, FACTORS, FULL, QUICK, UNITS, Effort
from campaigns.machinery import Plan, Summary, cli, machine, made_by, run, stage, write_scene
from campaigns.study import Order, Study
from tables import Rows, number_of, write_table

TOLD = ("title", "measure", "period_s", "duration_s", "rough")  # of every work, in the provenance
SHIPPED = {"nodes": 41, "control": "rtol", "setting": 0.03}  # of the scene tethered_buoy


@dataclass
class Options(cli.Options):
    """The options of this campaign. effort: what they ask for."""

    works: list[str] | None = cli.option(
        "A B ...", f"works (default: {' '.join(FULL.works)})", cli.one_of(FULL.works), many=True
    )
    rounds: int | None = cli.option(
        "N", f"turns of every timed setting (default: {FULL.rounds})", cli.whole(1, len(FACTORS))
    )
    quick: bool = cli.flag(f"{' and '.join(QUICK.works)} alone, few settings, one round")
    no_peers: bool = cli.flag("leave out scipy and other codes")
    effort: Effort = FULL

    def read(self, faults: list[str]) -> None:
        """The effort."""
        effort = QUICK if self.quick else FULL
        chosen = self.works or effort.works
        works = tuple(name for name in FULL.works if name in chosen)
        self.effort = replace(effort, works=works, rounds=self.rounds or effort.rounds)


def perform(order: Order):
    """References, what is not timed, and what is: the last one run at a time. Then the tables that follow from them."""
    from campaigns.accuracy import jobs
    from campaigns.accuracy.rows import COLUMNS, ORDER_COLUMNS, orders, point_row

    options, out, of_engine = order.options, order.how.out, order.simulate is None
    sources = (f"campaigns/accuracy/{name}" for name in ("rows.py", "plan.py", "works.toml"))
    maker = made_by("campaigns/breaking_line/theory", "engine", *sources)
    plan = Plan(order.how, order.simulate or engine.simulate, point_row, COLUMNS, maker)
    one_at_a_time = replace(plan, how=replace(order.how, backend="threading", jobs=1))
    plans = plan, plan, plan, one_at_a_time
    phases = jobs.phases(out, options.effort, options.quick, of_engine and not options.no_peers)
    summary, jobs_so_far = Summary([], 0, 0), []
    for number, (phase_plan, phase) in enumerate(zip(plans, phases, strict=True), 1):
        if phase and not jobs_so_far:
            write_scene(out, STUDY.name, phase)
        jobs_so_far += phase
        with stage(f"step {number} of {len(plans)}"):
            summary = run(phase_plan, jobs_so_far).joined_to(summary)
    write_table(out / "orders.csv", ORDER_COLUMNS, orders(out, summary.rows))
    return summary


def parameters(order: Order) -> dict:
    from campaigns.accuracy.jobs import taking_part, version

    options = order.options
    works, notes = {}, {}
    for name in options.effort.works:
        work = BY_NAME[name]
        works[name] = {entry: getattr(work, entry) for entry in TOLD} | {"unit": UNITS[work.measure]}
    if not options.no_peers:
        for peer, _, _ in taking_part(options.effort.works, options.quick):
            notes[f"{peer.name} {version(peer) or '(not installed)'}"] = peer.notes
    return {
        "works": works,
        "quick": options.quick,
        "rounds": options.effort.rounds,
        "peers": not options.no_peers,
        "peer_notes": notes,
        "machine": machine(),
    }


def answer(order: Order, rows: Rows) -> Iterator[str]:
    """The error of the shipped setting on every work where it is timed, its median time, and what ended early."""
    shipped = {"kind": "point", "method": BEST, "status": "ok"} | SHIPPED
    for name in order.options.effort.works:
        work, errors, times_s = BY_NAME[name], [], []
        for row in rows:
            if row["work"] == name and shipped.items() <= row.items():
                times_s.append(row["wall_s"])
                error = number_of(row, "error")
                if isfinite(error):
                    errors.append(error)
        if errors:
            wall_ms = 1e3 * median(times_s) * work.period_s / work.duration_s
            error = f"{median(errors):.2g} {UNITS[work.measure]}"
            yield f"{work.title}: the shipped setting errs by {error} and takes {wall_ms:.2g} ms a wave period."
    early = sum(row["status"] != "ok" for row in rows if row["kind"] == "point")
    if early:
        yield f"{early} of our timed runs ended early, so their errors are not known."


STUDY = Study(name="accuracy", protocol=__doc__, options=Options, parameters=parameters, perform=perform, answer=answer)
main, read_order = STUDY.main, STUDY.read_order
