"""What a campaign is, as one record, and the command that is made of it.

A `Study` says which runs there are (`cases`), how a run becomes a row (`measures`), and what its command line offers
beside the options that all studies share. docs/howto_campaign.md shows a complete one. A campaign that does not run
variants of one scene has its work in `done`.
"""

import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial

import engine
from campaigns.columns import Column
from campaigns.machinery import cli, session
from campaigns.machinery.cli import Lengths
from campaigns.machinery.folder import made_by
from campaigns.machinery.plan import Job, Plan, Summary
from campaigns.machinery.progress import stage
from campaigns.machinery.runner import run, write_scene


@dataclass(frozen=True)
class Measures:
    """How a run becomes a row: row(trajectory) fills `columns`, all but those of the labels and run_key.

    sources: files and folders of this project that shape a row; where they are given, rows are kept beside their runs
    until one of these or of `settings` (plain values) changes. Without sources a row is made anew each time.
    """

    columns: tuple[Column, ...]
    row: Callable
    sources: tuple[str, ...] = ()
    settings: Mapping[str, object] = field(default_factory=dict)


@dataclass
class Order:
    """What a command line asks of a study: its values, what was found wrong with them, and the cases that follow.

    own: the study's own options, as `Study.read` leaves them. periods, transient: None and 0 without `Study.lengths`.
    looks: whether runs take as long as their regime needs, `periods` at most, with a transient of their own (None).
    simulate: in place of engine.simulate, None for the engine.
    """

    how: cli.Running
    name: str = ""
    changes: dict[str, object] = field(default_factory=dict)
    periods: int | None = None
    transient: int | None = 0
    looks: bool = False
    own: Namespace = field(default_factory=Namespace)
    faults: list[str] = field(default_factory=list)
    cases: list[Job] = field(default_factory=list)
    simulate: Callable | None = None

    def tell(self, faults: Iterable[str]) -> None:
        """Add faults, each once."""
        self.faults.extend(fault for fault in dict.fromkeys(faults) if fault not in self.faults)

    def base(self, changes: Mapping[str, object] | None = None, tell: bool = False) -> "engine.Scene | None":
        """The scene with the changes of --set and these; None for a faulty one. tell: whether its faults are added."""
        try:
            return engine.load_scene(self.name, {**self.changes, **(changes or {})})
        except engine.SceneError as error:
            self.tell(error.faults if tell else ())
            return None

    def scene(self, changes: Mapping[str, object], duration_s: float | None = None) -> "engine.Scene | None":
        """As `base`, and every fault is added, with doubts about the size or the length of such a run.

        duration_s: length of the run where it is not `periods`.
        """
        from campaigns.machinery.plausible import doubts

        scene = self.base(changes, tell=True)
        if scene is not None:
            if duration_s is None and scene.waves is not None:
                duration_s = self.periods * scene.waves.period_s
            self.tell(doubts(scene, duration_s))
        return scene

    def case(self, labels: Mapping[str, object], changes: Mapping[str, object]) -> Job | None:
        """A case of the usual length; None where its scene cannot be."""
        scene = self.scene(changes)
        return None if scene is None else Job(labels, scene, self.periods)


@dataclass(frozen=True)
class Study:
    """A campaign.

    name: of its provenance and of its folder in results/. protocol: its help. scene: it starts from this one, "" where
    `done` is given. cases(order) -> its runs (`Job`), None for one that cannot be; measures(order) -> Measures.
    done(order) -> times and summary, in place of these two; `Order.own` then has the whole order, `how` among it.
    lengths: None for a study whose cases have lengths of their own. in_waves: whether it refuses scenes without a buoy
    in regular waves. taken: keys that it sets itself -> what to use instead of --set.
    options(group): adds options of its own; read(options, faults) judges and amends their values (`Order.own`).
    parameters(order) -> what its provenance says beside scene, set, periods and transient.
    runs(order) -> in place of `runner.run`; beside(order) -> what is done after the runs: functions of (plan, summary)
    that return seconds of analysis. together: whether runs may share a worker, side by side in the lanes.
    answer(order, rows of table.csv) -> what was found, in at most eight sentences, for the terminal and answer.txt.
    jobs, backends: whether there is a choice of these. strict: whether a row that is not ok is exit code 1.
    module: its command is python -m MODULE; "" for campaigns.NAME.
    """

    name: str
    protocol: str
    scene: str = ""
    cases: Callable[[Order], Iterable[Job | None]] | None = None
    measures: Callable[[Order], Measures] | None = None
    done: Callable[[Order], tuple[dict[str, float], Summary]] | None = None
    lengths: Lengths | None = None
    in_waves: bool = False
    taken: Mapping[str, str] = field(default_factory=dict)
    options: Callable[[object], None] | None = None
    read: Callable[[Namespace, list[str]], None] | None = None
    parameters: Callable[[Order], Mapping[str, object]] | None = None
    runs: Callable[[Order], Callable] | None = None
    beside: Callable[[Order], Iterable[Callable[[Plan, Summary], float]]] | None = None
    answer: Callable[[Order, list[dict]], Iterable[str]] | None = None
    together: bool = True
    jobs: bool = True
    backends: bool = True
    strict: bool = False
    module: str = ""

    def main(self, argv: list[str] | None = None, simulate: Callable | None = None) -> int:
        """The command. simulate: in place of engine.simulate, same signature. Returns the exit code (0, 1, 2, 130)."""
        return session.command(self.called, argv, self.read_order, partial(self.conduct, simulate=simulate))

    @property
    def called(self) -> str:
        """MODULE of python -m MODULE."""
        return self.module or f"campaigns.{self.name}"

    def parser(self) -> ArgumentParser:
        """The options of the command."""
        parser = cli.parser(self.called, self.protocol)
        what = parser.add_argument_group("what is run")
        if self.options is not None:
            self.options(what)
        if self.lengths is not None:
            usual, whole = self.lengths, cli.whole
            most = f"(default: {usual.transient}, at most 1/{usual.share} of --periods)"
            lasting = whole(1, cli.MOST_PERIODS)
            length, default = "length of every run in wave periods", usual.periods
            if usual.budget:
                length += " (default: as long as it takes to tell its regime)"
                most, default = f"with --periods {most}", None
                budget = "wave periods after which a run ends undecided; without --periods"
                cli.add(what, "--budget", "N", budget, lasting, usual.budget)
            cli.add(what, "--periods", "N", length, lasting, default)
            cli.add(what, "--transient", "N", f"wave periods left out of the analysis {most}", whole(0))
        if self.scene:
            name = cli.Kind(str, "a scene file or the name of a scene")
            cli.add(what, "--scene", "FILE_OR_NAME", "scene to start from", name, self.scene)
            cli.add(what, "--set", "KEY=VALUE ...", "change values of the scene, as water.depth_m=22.5 tether.nodes=81")
        cli.add_running(parser.add_argument_group("how and where"), self.name, self.jobs, self.backends)
        return parser

    def read_order(self, argv: list[str], faults: list[str]) -> Order:
        """The order in the words of the command line; every fault, of options and scenes, is appended to `faults`."""
        options = cli.split(self.parser(), argv, faults)  # `--help` ends here, and has loaded nothing heavy
        periods, transient, looks = None, 0, False
        if (usual := self.lengths) is not None:
            periods, transient = options.periods, options.transient
            looks = usual.budget > 0 and periods is None
            if looks and transient is not None:
                faults.append(f"--transient: given {transient} without --periods; allowed: with --periods")
            if looks:
                periods, transient = options.budget, None
            elif transient is None:
                transient = min(usual.transient, periods // usual.share)
            if transient is not None and transient >= periods:
                faults.append(f"--transient: given {transient} of {periods} periods; allowed: less than --periods")
        if self.read is not None:
            self.read(options, faults)
        how = options.how = cli.running(options, self.name, faults)
        if self.cases is None:
            return Order(how, own=options, faults=faults)
        from campaigns.machinery.plausible import without_waves

        changes = cli.assignments(options.set, self.taken, faults)
        order = Order(how, options.scene, changes, periods, transient, looks, options, faults)
        base = order.base() if self.in_waves else None
        refused = [] if base is None else list(without_waves(order.name, base))
        order.tell(refused)
        order.cases = [case for case in self.cases(order) if case is not None] if not refused else []
        return order

    def work(self, order: Order) -> tuple[dict[str, float], Summary]:
        """Do the runs that are not there yet, and what is done beside them; the folder has to be held (`claimed`).

        Returns times, with compile_s, run_s and analysis_s among them, and summary. Raises CampaignStopped, OSError,
        KeyboardInterrupt.
        """
        if self.done is not None:
            return self.done(order)
        together = engine.simulate_each if self.together and order.simulate is None else None
        order.simulate = order.simulate or engine.simulate
        measures = self.measures(order)
        maker = made_by(dict(measures.settings), *measures.sources) if measures.sources else ""
        plan = Plan(order.how, order.simulate, measures.row, measures.columns, maker, together)
        write_scene(order.how.out, self.name, order.cases)
        further_steps = list(self.beside(order)) if self.beside else []
        steps = 1 + len(further_steps)
        with stage(f"step 1 of {steps}"):
            timing, summary = (self.runs(order) if self.runs else run)(plan, order.cases)
        began = time.perf_counter()
        for number, step in enumerate(further_steps, 2):
            with stage(f"step {number} of {steps}"):
                timing["analysis_s"] += step(plan, summary)
        timing["run_s"] += time.perf_counter() - began
        return timing, summary

    def conduct(self, order: Order, argv: list[str], simulate: Callable | None = None) -> int:
        """Do what an order without faults asks for, to the report; argv: its words. Returns the exit code."""
        order.simulate = simulate
        parameters = {"scene": order.name, "set": order.changes} if self.scene else {}
        parameters |= {} if self.lengths is None else {"periods": order.periods, "transient": order.transient}
        parameters |= self.parameters(order) if self.parameters else {}
        where = ("backend", "jobs", "dask_address")
        parameters |= {name: getattr(order.own, name) for name in where if hasattr(order.own, name)}
        return session.conduct(self, order, argv, parameters)
