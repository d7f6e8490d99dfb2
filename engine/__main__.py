"""One scene, run and shown: what the motion did in a few lines, and a figure of it.

    python -m engine                                           lists the scenes
    python -m engine tethered_buoy --set waves.steepness=0.1   runs one, prints what it did, shows a figure
    python -m engine tethered_buoy --start-from RUN.nc         goes on from the end of a saved run
    python -m engine --new my.toml                             asks for your own mooring, writes a commented scene

A buoy in regular waves carries a perturbation along, unless `--set output.tangent_vectors=0` says otherwise: its growth
is the exponent that tells chaos from other motions.
"""

import argparse
import sys
from itertools import pairwise
from pathlib import Path

import engine.scene
from engine import views
from engine.atomic import can_be_written, is_netcdf
from engine.streams import Parser, open_streams, printed, refused

MOST_PERIODS, PERIODS = 1575, 205  # until a verdict; without perturbations
KINDS = (".png", ".svg", ".pdf")
TANGENTS = "output.tangent_vectors"
EXITS = "exit codes: 0 done, 1 the run ended early, 2 bad input, 130 Ctrl-C"


def parser() -> Parser:
    """The options of the command."""
    words = {"description": __doc__, "epilog": EXITS, "formatter_class": argparse.RawDescriptionHelpFormatter}
    options = Parser(prog="python -m engine", allow_abbrev=False, **words)
    options.add_argument("scene", metavar="SCENE", help="a scene file or the name of a scene")
    several = {"metavar": "KEY=VALUE", "nargs": "+", "action": "extend", "default": []}
    options.add_argument("--set", **several, help="change values of the scene, as water.depth_m=22.5 tether.nodes=81")
    goes = "file of a run (`Trajectory.save`, or trajectories/ of a campaign) from whose end this one goes on"
    options.add_argument("--start-from", metavar="FILE", type=Path, help=f"{goes} (default: from rest)")
    length = options.add_mutually_exclusive_group()
    until = (
        f"length in wave periods (default: until the verdict, {MOST_PERIODS} at most; without perturbations {PERIODS})"
    )
    length.add_argument("--periods", metavar="N", help=until)
    length.add_argument("--duration", metavar="S", help="length in seconds; needed without waves")
    shown = "file of the figure, .png, .svg or .pdf (default: a window, or results/engine/NAME.png without a display)"
    options.add_argument("--out", metavar="FILE", type=Path, help=shown)
    return options


def read_order(argv: list[str], faults: list[str]) -> argparse.Namespace | None:
    """The options of the command line, `scene` a Scene and `start` its state; every fault is appended to `faults`.

    Without a length, `periods` or `duration`, the scene runs until its verdict.
    """
    try:
        options, unknown = parser().parse_known_args(argv)
    except ValueError as error:
        faults.append(str(error))
        return None
    for before, word in pairwise(["", *unknown]):
        if word.startswith("-") or not before.startswith("-"):  # else the value of an unknown option
            faults.append(f"{word}: no such option{_hint(word)}")
    name, options.scene, options.start = options.scene, None, None
    changes = {}
    for word in options.set:
        try:
            changes |= [engine.scene.parse_assignment(word)]
        except engine.SceneError as error:
            faults += error.faults
    try:
        options.scene = engine.load_scene(name, changes)
        if TANGENTS not in changes and views.in_regular_waves(options.scene) and views.carries_tangents(options.scene):
            options.scene = engine.load_scene(name, {**changes, TANGENTS: 1})
    except engine.SceneError as error:
        faults += error.faults
    scene = options.scene
    if scene is not None and scene.waves is None and options.duration is None:
        faults.append(f"--duration: not given for {name!r}, a scene without waves; allowed: seconds, above 0")
    elif scene is not None and options.periods is options.duration is None:
        if not (views.in_regular_waves(scene) and scene.output.tangent_vectors):
            options.periods = PERIODS
    for option in ("periods", "duration"):
        setattr(options, option, _length(option, getattr(options, option), faults))
    if options.out is not None:
        faults += _faults_of(options.out)
    if options.start_from is not None and not is_netcdf(options.start_from):
        allowed = "the file of a run, of trajectories/ or of Trajectory.save"
        faults.append(f"--start-from: given {str(options.start_from)!r}; allowed: {allowed}")
    if not faults and scene.waves is not None and options.start_from is None:  # else the sea of the earlier run goes on
        from engine.physics.sea import enough_waves

        more = enough_waves(scene, options.duration or (options.periods or MOST_PERIODS) * scene.waves.period_s)
        if more:
            options.scene = engine.load_scene(name, {**changes, **more})
    if not faults:
        faults += _faults_of_run(options)
    return options


def _length(name: str, text: str | None, faults: list[str]) -> float | None:
    """The number of --periods or --duration; None where it was not given or is at fault."""
    if text is None:
        return None
    try:
        length = float(text)
    except ValueError:
        length = float("nan")
    if not 0.0 < length < float("inf"):
        faults.append(f"--{name}: given {text}; allowed: a finite number above 0")
        return None
    return length


def _hint(word: str) -> str:
    """What may have been meant by a word that is no option."""
    if close := parser().close_to(word, "--new"):
        return close
    if "=" in word and not word.startswith("-"):
        return f"; did you mean --set {word}?"
    return "" if word.startswith("-") else "; keys of the scene are given as --set KEY=VALUE"


def _faults_of_run(options: argparse.Namespace) -> list[str]:
    """What lets no run of these options begin; sets the state that it begins in."""
    from engine.parameters.limits import check_room
    from engine.run.start import checked_start

    scene, file = options.scene, options.start_from
    try:
        check_room(scene, options.duration or (options.periods or MOST_PERIODS) * scene.waves.period_s)
        options.start = checked_start(scene, file)
    except ValueError as error:
        return [f"--start-from: {error}" if file is not None else str(error)]
    return []


def _faults_of(out: Path) -> list[str]:
    folder = out.parent
    if out.suffix not in KINDS:
        return [f"--out: given {str(out)!r}; allowed: a file whose name ends in {', '.join(KINDS)}"]
    if out.is_dir() or not can_be_written(folder):
        return [f"--out: given {str(out)!r}; allowed: a file in a folder that is there and can be written to"]
    return []


def main(argv: list[str] | None = None) -> int:
    """The command: run, print, show or save; without an argument list the scenes. Returns the exit code."""
    argv = sys.argv[1:] if argv is None else argv
    if not argv:
        print("python -m engine SCENE ...; --help tells the options\n")
        for name in engine.list_scenes():
            print(f"  {name:<14} {engine.load_scene(name).title}")
        return 0
    if "--new" in argv:
        from engine.own_mooring import command

        return command.main([word for word in argv if word != "--new"])
    faults: list[str] = []
    order = read_order(argv, faults)
    if faults:
        return refused("python -m engine", faults, "nothing was run or written")
    print(f"{order.scene.name}: a first run compiles for up to a minute", file=sys.stderr)
    try:
        if order.periods is None and order.duration is None:
            run = _until_verdict(order.scene, order.start)
        else:
            length = order.periods, order.duration
            run = engine.simulate(order.scene, *length, lambda share: _show_progress(f"{share:.0%}"), order.start)
        _show_progress("")
        for name, text in views.facts(run).items():
            print(f"{name:<9} {text}", flush=True)
        _show_progress("on a finer grid")
        doubt = views.doubt_of_verdict(run)
        _show_progress("")
    except KeyboardInterrupt:
        print("\ninterrupted; nothing was written", file=sys.stderr)
        return 130
    if doubt:
        print(f"{'CHECK':<9} {doubt}", flush=True)
    if len(run.columns["time_s"]) > 1:
        _show(run, order.out)
    return 0 if run.status == "ok" else 1


def _until_verdict(scene, start):
    """The run of a buoy in regular waves, as long as its verdict needs, and MOST_PERIODS at most."""
    run, periods = None, 0
    while periods < MOST_PERIODS:
        _show_progress(f"{periods} waves")
        look = min(views.look_after(periods), MOST_PERIODS)
        later = engine.simulate(scene, look - periods, start=run or start)
        run, periods = later if run is None else run.followed_by(later), look
        if run.status != "ok" or not views.longer_decides(run):
            break
    return run


def _show_progress(text: str) -> None:
    if sys.stderr.isatty():
        print(f"\r{text:<24}\r", end="", file=sys.stderr, flush=True)


def _show(run, out: Path | None) -> None:
    """Save the figure, or show it in a window; without a display it is saved too."""
    if out is None:
        from matplotlib import pyplot

        if pyplot.get_backend().lower() != "agg":  # which matplotlib takes where there is no display
            run.plot()
            pyplot.show()
            return
        out = Path("results", "engine", f"{run.scene.name}.png")
        out.parent.mkdir(parents=True, exist_ok=True)
    run.plot(out)
    print(f"figure    {out}")


if __name__ == "__main__":
    open_streams()
    sys.exit(printed(main))
