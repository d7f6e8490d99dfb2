"""What a campaign is, as one record, and the command that is made of it.

A `Study` says which runs there are (`cases`), how a run becomes a row (`measures`), and what its command line offers
beside the options that all studies share. docs/developing.md shows a complete one. A campaign that does not run
variants of one scene has its work in `perform`.
"""

import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial

import engine
from campaigns.machinery import Job, Jobs, Plan, Summary, cli, made_by, run, session, stage, write_scene
from campaigns.machinery.finished import finished, order_key
from tables import Columns, Rows


@dataclass(frozen=True)
class Measures:
    """How a run becomes a row: row(trajectory) fills `columns`, all but those of the labels and run_key.

    sources: files and folders of this project that shape a row; where they are given, rows are kept beside their runs
    until one of these or of `settings` (plain values) changes. Without sources a row is made anew each time.
    judge: computes what a row reads beside its run (`Plan.judge`); then row(trajectory, judgement).
    """

    columns: Columns
    row: Callable
    sources: tuple[str, ...] = ()
    settings: Mapping[str, object] = field(default_factory=dict)
    judge: Callable | None = None


@dataclass(frozen=True)
class Lengths:
    """The usual length of a run and of its transient, in wave periods.

    share: the transient is at most periods/share where none is given. budget: of a study whose runs take as long as
    their regime needs where no length is given: the most that they may take; 0: `periods` is the length then.
    """

    periods: int
    transient: int
    share: int = 3
    budget: int = 0

    def add_to(self, group: object) -> None:
        """Add --budget, --periods and --transient to a parser."""
        lasting = cli.whole(1, cli.MOST_PERIODS)
        transient = f"(default: {self.transient}, at most 1/{self.share} of --periods)"
        length, usual = "length of every run in wave periods", self.periods
        if self.budget:
            length += " (default: as long as it takes to tell its regime)"
            transient, usual = f"with --periods {transient}", None
            budget = "wave periods after which a run ends undecided; without --periods"
            cli.Option("N", budget, lasting, self.budget).add_to(group, "--budget")
        cli.Option("N", length, lasting, usual).add_to(group, "--periods")
        left_out = f"wave periods left out of the analysis {transient}"
        cli.Option("N", left_out, cli.whole(0)).add_to(group, "--transient")

    def read(self, values: Namespace, order: "Order") -> None:
        """Put the values of these options into an order."""
        periods, transient = values.periods, values.transient
        order.given_transient = transient
        if self.budget and periods is None:
            if transient is not None:
                order.tell(f"--transient: given {transient} without --periods; allowed: with --periods")
            order.look_by_look(values.budget)
            return
        if self.budget and values.budget != self.budget:
            order.tell(f"--budget: given {values.budget} with --periods; allowed: without --periods")
        if transient is None:
            transient = min(self.transient, periods // self.share)
        if transient >= periods:
            order.tell(f"--transient: given {transient} of {periods} periods; allowed: less than --periods")
        order.periods, order.transient = periods, transient


@dataclass
class Order:
    """What a command line asks of a study: its values, what was found wrong with them, and the cases that follow."""

    how: cli.Running
    options: object = None  # the study's own (`Study.options`)
    name: str = ""  # of the scene
    changes: dict = field(default_factory=dict)  # of the scene, by --set
    periods: int | None = None  # of a run, None without `Study.lengths`; at most, where `looks`
    transient: int | None = 0  # wave periods left out of the analysis; None: found by each run
    given_transient: int | None = None  # as the command line says, None: not at all
    looks: bool = False  # whether runs take as long as their regime needs
    faults: list[str] = field(default_factory=list)
    cases: list[Job] = field(default_factory=list)
    simulate: Callable | None = None  # in place of engine.simulate
    key: str = ""  # of everything that the results depend on; "" without cases, or of code that is not known

    @property
    def scenes(self) -> list:
        """The scenes of the cases."""
        return [case.scene for case in self.cases]

    def look_by_look(self, budget: int) -> None:
        """Let runs take as long as their regime needs, but no more wave periods than the budget."""
        self.periods, self.looks, self.transient = budget, True, None

    def tell(self, *faults: str) -> None:
        """Add faults, each once."""
        self.faults.extend(fault for fault in dict.fromkeys(faults) if fault not in self.faults)

    def base(self, changes: Mapping[str, object] | None = None, tell: bool = False) -> "engine.Scene | None":
        """The scene with the changes of --set and these; None for a faulty one. tell: whether its faults are added."""
        try:
            return engine.load_scene(self.name, {**self.changes, **(changes or {})})
        except engine.SceneError as error:
            if tell:
                self.tell(*error.faults)
            return None

    def scene(self, changes: Mapping[str, object], duration_s: float | None = None) -> "engine.Scene | None":
        """As `base`, and every fault is added, with doubts about the size or the length of such a run.

        A sea that is drawn has as many waves as the length needs, unless a key says how many.

        duration_s: length of the run where it is not `periods`.
        """
        from campaigns.machinery.plausible import doubts

        scene = self.base(changes, tell=True)
        if scene is None:
            return None
        if duration_s is None and scene.waves is not None:
            duration_s = self.periods * scene.waves.period_s
        self.tell(*doubts(scene, duration_s))
        if scene.waves is None:
            return scene
        from engine.physics.sea import enough_waves

        more = enough_waves(scene, duration_s)
        return self.base({**changes, **more}) if more else scene

    def case(self, labels: Mapping[str, object], changes: Mapping[str, object]) -> Job | None:
        """A case of the usual length; None where its scene cannot be."""
        scene = self.scene(changes)
        if scene is None:
            return None
        return Job(labels, scene, self.periods)


def no_parameters(order: Order) -> Mapping[str, object]:
    """Nothing beside the scene, its changes and the lengths."""
    return {}


def nothing_after(order: Order) -> Iterable[Callable[[Plan, Summary], float]]:
    """Nothing is done after the runs."""
    return ()


def usual_runs(order: Order, plan: Plan, jobs: Jobs) -> Summary:
    """`runner.run`: every run of the order, as its scene begins."""
    return run(plan, jobs)


@dataclass(frozen=True)
class Study:
    """A campaign: either runs of scenes (`cases` and `measures`), or tasks of its own (`perform`)."""

    name: str  # of its provenance and of its folder in results/
    protocol: str  # the help of its command
    module: str = ""  # its command is python -m MODULE; "" for campaigns.NAME
    options: type[cli.Options] = cli.Options  # that it adds
    places: tuple[str, ...] = tuple(cli.PLACES)  # options that say where its runs are done
    strict: bool = False  # whether a row that is not ok is exit code 1
    counted: str = "runs"  # what its last lines count
    parameters: Callable[[Order], Mapping[str, object]] = no_parameters  # in its provenance, beside those of scenes
    answer: Callable[[Order, Rows], Iterable[str]] | None = None  # the rows of table.csv, in eight sentences

    # tasks
    perform: Callable[[Order], Summary] | None = None  # does them

    # runs of scenes
    scene: str = ""  # it starts from this one
    taken: Mapping[str, str] = field(default_factory=dict)  # keys that it sets itself -> what to use instead of --set
    in_waves: bool = False  # whether it refuses scenes without a buoy in regular waves
    lengths: Lengths | None = None  # None: its cases have lengths of their own
    cases: Callable[[Order], Iterable[Job | None]] | None = None  # None for a run that cannot be
    measures: Callable[[Order], Measures] | None = None
    runs: Callable = usual_runs  # what does the runs, as of `usual_runs`
    together: bool = True  # whether runs may share a worker, side by side in the lanes
    # done after the runs: functions of (plan, summary) that return seconds of analysis
    beside: Callable[[Order], Iterable[Callable[[Plan, Summary], float]]] = nothing_after

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
        group = parser.add_argument_group("what is run")
        cli.add_options(group, self.options)
        if self.lengths is not None:
            self.lengths.add_to(group)
        if self.scene:
            name = cli.Kind(str, "a scene file or the name of a scene")
            cli.Option("FILE_OR_NAME", "scene to start from", name, self.scene).add_to(group, "--scene")
            changes = "change values of the scene, as water.depth_m=22.5 tether.nodes=81"
            cli.Option("KEY=VALUE ...", changes).add_to(group, "--set")
        cli.add_running(parser.add_argument_group("how and where"), self.name, self.places)
        return parser

    def read_order(self, argv: list[str], faults: list[str]) -> Order:
        """The order in the words of the command line; every fault, of options and scenes, is appended to `faults`."""
        values = cli.split(self.parser(), argv, faults)  # `--help` ends here, and has loaded nothing heavy
        how = cli.running(values, self.places, self.name, faults)
        order = Order(how, cli.options_of(self.options, values), faults=faults)
        if self.lengths is not None:
            self.lengths.read(values, order)
        # such a scene has no faults to tell
        as_shipped = not self.scene or (not values.set and values.scene == self.scene)
        if values.mistyped and as_shipped:
            return order  # answered before anything heavy is loaded
        order.options.read(faults)
        if self.cases is None or (faults and as_shipped):
            return order
        order.name = values.scene
        order.changes = cli.assignments(values.set, self.taken, faults)
        scene = None
        if not as_shipped:
            scene = order.base()
        unsound = not as_shipped and scene is None
        if unsound:  # the cases tell why, before the key of the order loads anything heavy
            self._add_cases(order)
        if faults:
            return order
        order.key = self._key(values, scene)
        if not unsound and finished(how.out, order.key) is None:
            self._add_cases(order)
        return order

    def _key(self, values: Namespace, scene: "engine.Scene | None", **further: object) -> str:
        """`Order.key` of the values of options, but for those that say where it is done, and of `further` ones.

        scene: with the changes of --set, because a key of it may name a file (`waves.record`); None: as it is shipped.
        """
        if self.module:
            return ""  # the code of a campaign outside of the project, and what it imports, is not known
        if scene is not None:
            further["of_values"] = scene.key()
        asked = {name: value for name, value in vars(values).items() if name not in (*self.places, "out")}
        return order_key(self.called, asked | further, session.versions())

    def order(self, how: cli.Running, scene: str, changes: dict, /, **options: object) -> Order:
        """The order of a program, in values instead of words; `Order.faults` has what is wrong with it.

        options: of this study by name, as `read` leaves them; the others have their usual values.
        """
        faults = []
        values = cli.split(self.parser(), [], faults)
        vars(values).update(options, out=how.out)
        order = Order(how, cli.options_of(self.options, values), scene, changes, faults=faults)
        if self.lengths is not None:
            self.lengths.read(values, order)
        order.key = self._key(values, order.base(), of_scene=scene, changes=changes)
        self._add_cases(order)
        return order

    def _add_cases(self, order: Order) -> None:
        """Make the cases of an order; none of a scene that the study refuses."""
        from campaigns.machinery.plausible import without_waves

        base = order.base() if self.in_waves else None
        refused = []
        if base is not None:
            refused = list(without_waves(order.name, base))
        order.tell(*refused)
        if not refused:
            order.cases = [case for case in self.cases(order) if case is not None]

    def work(self, order: Order) -> Summary:
        """Do the runs that are not there yet, and what is done beside them; the folder has to be held (`claimed`).

        Raises CampaignStopped, OSError, KeyboardInterrupt.
        """
        if self.perform is not None:
            return self.perform(order)
        plan = self.plan(order)
        write_scene(order.how.out, self.name, order.cases)
        further_steps = list(self.beside(order))
        steps = 1 + len(further_steps)
        began = time.perf_counter()
        with stage(f"step 1 of {steps}"):
            summary = self.runs(order, plan, order.cases)
        for number, step in enumerate(further_steps, 2):
            with stage(f"step {number} of {steps}"):
                summary.times["analysis_s"] += step(plan, summary)
        summary.times["run_s"] = time.perf_counter() - began - summary.times["compile_s"]
        return summary

    def plan(self, order: Order) -> Plan:
        """How the runs of the order are done, and what a row of each says."""
        together = None
        if order.simulate is None:
            order.simulate = engine.simulate
            if self.together:
                together = engine.simulate_each
        measures = self.measures(order)
        maker = ""
        if measures.sources:
            maker = made_by(*measures.sources, **measures.settings)
        return Plan(order.how, order.simulate, measures.row, measures.columns, maker, measures.judge, together)

    def conduct(self, order: Order, argv: list[str], simulate: Callable | None = None) -> int:
        """Do what an order without faults asks for, to the report; argv: its words. Returns the exit code."""
        order.simulate = simulate
        if simulate is not None and not order.cases and self.cases is not None:
            self._add_cases(order)
        parameters = {"scene": order.name, "set": order.changes} if self.scene else {}
        if self.lengths is not None:
            parameters |= {"periods": order.periods, "transient": order.transient}
        parameters |= self.parameters(order)
        for name in self.places:
            parameters[name] = getattr(order.how, name)
        return session.conduct(self, order, argv, parameters)
