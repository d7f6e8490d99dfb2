"""The parts of the paper's campaign: which command each is, whether it is there already, and its row in table.csv.

    DIR/breaking_line   section 4.1: eight cases and their companions (figures 2-7)
    DIR/buoy            section 4.2: the paper's two waves, long enough for a verdict (figures 9-19)
    DIR/doubled         section 3: the paper's two waves on the grid as shipped and on twice the elements
    DIR/sweep           section 4.2: wave steepness between and beyond the two (the threshold)
    DIR/dependence      section 4.2 with other depths, treatments and stiffnesses (`campaigns.paper.dependence`)
    DIR/out_of_plane    figure 20
    DIR/oscillator      eq. (33), figure 19(b)

A part that ended is not even begun again while its sources, its command, its tables and its files are what they were;
otherwise its campaign runs, and does what its own folder lacks.
"""

import hashlib
import importlib
import json
import time
from collections import Counter
from pathlib import Path

from campaigns.machinery import (
    CampaignStopped,
    Summary,
    Table,
    cli,
    command_line,
    made_by,
    of_the_page,
    stage,
    trajectory_path,
)
from campaigns.paper import dependence
from campaigns.paper.order import PARTS
from campaigns.study import Order
from engine.atomic import write_atomic
from tables import MESSAGE, RUN_KEY, STATUS, Column, Row, any_rows, names, of_words

COLUMNS = (
    of_words("part", "folder of the part"),
    STATUS,
    of_words("command", "what ran it"),
    Column("runs", "", "runs", "its runs", 0),
    Column("failed", "", "failed", "runs that did not end as asked", 0),
    Column("compile_s", "s", "compiling", "compiling", 0),
    Column("run_s", "s", "computing", "runs with their analysis", 0),
    Column("total_s", "s", "all", "with compiling and the part's report, in the session that finished it", 0),
    RUN_KEY,
    MESSAGE,
)
SOURCES = (
    "analysis",
    "engine",
    "tables",
    "campaigns/machinery",
    "campaigns/explore",
    "campaigns/answers.py",
    "campaigns/figure_data.py",
    "campaigns/judge.py",
    "campaigns/statements.py",
    "campaigns/study.py",
    "campaigns/breaking_line",
    "campaigns/buoy_sweep",
    "campaigns/oscillator",
    "campaigns/out_of_plane",
    "campaigns/paper/dependence.py",
    "campaigns/sweep",
    "reports/breaking_line",
    "reports/buoy_sweep",
    "reports/figures",
    "reports/oscillator",
    "reports/out_of_plane",
    "reports/parts",
    "reports/sweep",
)
_TIMES = ("compile_s", "run_s")
_TWO = ("--steepness", "0.016", "0.13")
_LONG = ("--periods", "8000", "--transient", "200", "--evidence", "full")  # the statements and figure 14 ask for it
_GRIDS = ("--vary", "waves.steepness", "0.016", "0.13", "2", "--vary", "tether.nodes", "41", "81", "2")
_SHORT = ("--periods", "60", "--transient", "10", "--no-accuracy")
CAMPAIGNS = {  # part -> its command; the words of its command line, those of --quick
    "breaking_line": ("campaigns.breaking_line", (), ("--no-companions", "--set", "tether.nodes=201")),
    "buoy": ("campaigns.buoy_sweep", (*_TWO, *_LONG), (*_TWO, *_SHORT)),
    "doubled": ("campaigns.sweep", (*_GRIDS, "--periods", "135"), (*_GRIDS, "--periods", "60")),
    "sweep": ("campaigns.buoy_sweep", ("--no-accuracy",), ("--steepness-range", "0.016", "0.13", "6", *_SHORT)),
    "out_of_plane": ("campaigns.out_of_plane", (), ("--periods", "12")),
    "oscillator": ("campaigns.oscillator", (), ("--effort", "0.02")),
}
assert {*CAMPAIGNS, "dependence"} == set(PARTS)


def run(order: Order) -> Summary:
    """Do every part of the order; keep table.csv up to date. Returns the summary, its rows those of parts.

    Raises CampaignStopped where a part stopped, KeyboardInterrupt where it was interrupted.
    """
    from engine import load_scene

    out = order.how.out
    keys = {part: _key(part, order) for part in PARTS}
    head = "# the scene of section 4.2 at its large wave; every part has the scene it ran in its own folder\n"
    write_atomic(out / "scene.toml", (head + load_scene(dependence.SCENE).to_toml()).encode())
    table = Table(out / "table.csv", COLUMNS, list(PARTS))
    known = {*names(COLUMNS)}
    for row in any_rows(out / "table.csv"):
        if row.keys() == known and row["part"] in PARTS:
            table.rows[row["part"]] = row
    times = Counter()
    todo = []
    for part in order.options.parts:
        if not _is_there(table.rows.get(part), keys[part], out / part, order):
            todo.append(part)
    for number, part in enumerate(todo, 1):
        with stage(f"part {number} of {len(todo)}"):
            row = _run_part(part, order)
        table.add(part, {**row, "run_key": _ended(keys[part], out / part)})
        table.write()
        for name in _TIMES:
            times[name] += row[name]
    table.write()
    return Summary(table.in_order(), len(order.options.parts) - len(todo), len(todo), times)


def _key(part: str, order: Order) -> str:
    if part == "dependence":
        settings = dependence.parameters(order.options.quick)
    else:
        settings = CAMPAIGNS[part][1 + order.options.quick]
    return made_by(*SOURCES, *of_the_page(), part=part, told=settings)


def _ended(key: str, out: Path) -> str:
    """The key of a part that ended, by what it is made of and the tables that it left."""
    # A part that is begun again writes its tables anew, row by row: killed then, they are sound and too short.
    digest = hashlib.sha256(key.encode())
    for path in sorted(out.rglob("table.csv")):
        digest.update(path.relative_to(out).as_posix().encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()


def _is_there(row: Row | None, key: str, out: Path, order: Order) -> bool:
    """Whether a part ended as it is asked for, and its folder still holds all that its table names, and its report."""
    if row is None or row["run_key"] != _ended(key, out):
        return False
    good = [run for run in any_rows(out / "table.csv") if run["status"] == "ok"]
    for run in good:
        if not trajectory_path(out, run["run_key"]).exists():
            return False
    reported = out.name == "dependence" or order.options.quick or not order.how.report or (out / "report.html").exists()
    return bool(good) and reported


def _run_part(part: str, order: Order) -> Row:
    out, how = order.how.out / part, order.how
    begun = time.perf_counter()
    if part == "dependence":
        summary = dependence.run(out, how.jobs, order.options.quick)
        timing, command = summary.times, ""
        runs, failed = len(summary.rows), sum(row["status"] != "ok" for row in summary.rows)
    else:
        module, *chosen = CAMPAIGNS[part]
        words = [*chosen[order.options.quick], "--out", str(out)]
        if part != "oscillator":
            words += ["--jobs", str(how.jobs)]
        if order.options.quick or not how.report:
            words.append("--no-report")
        _run_campaign(part, module, words)
        provenance = json.loads((out / "provenance.json").read_text(encoding="utf-8"))
        timing, command = provenance["timing"], " ".join(command_line(module, words))
        runs, failed = provenance["runs"]["total"], provenance["runs"]["failed"]
    row = {"part": part, "status": "ok", "command": command, "runs": runs, "failed": failed, "message": ""}
    for name in _TIMES:
        row[name] = round(float(timing[name]), 3)
    return row | {"total_s": round(time.perf_counter() - begun, 3)}


def _run_campaign(part: str, module: str, words: list[str]) -> None:
    """Run a campaign in this process. What it has to say it has said itself."""
    code = importlib.import_module(module).main(words)
    if code == cli.EXIT_INTERRUPTED:
        raise KeyboardInterrupt
    if code != cli.EXIT_OK:
        raise CampaignStopped(f"its part {part} stopped (above); what is finished is kept, run the same command again")
