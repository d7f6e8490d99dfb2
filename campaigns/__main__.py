"""`python -m campaigns` lists the campaigns; `python -m campaigns NAME ...` is `python -m campaigns.NAME ...`.

The command `tether` is one name for all commands: `tether NAME ...` runs a campaign, and COMMANDS lists the others.
"""

import argparse
import ast
import importlib
import os
import sys
from pathlib import Path

from engine.streams import close_to, open_streams, printed

COMMANDS = {  # of `tether`, beside the campaigns: module, what it does
    "new": ("engine.own_mooring.command", "Your own mooring: asks for buoy, rope, water and wave, writes a scene."),
    "run": ("engine.__main__", "One scene until its motion is told, with a figure."),
    "analysis": ("campaigns.time_series", "Is a measured column regular or chaotic?"),
    "report": ("reports.__main__", "Make the report of a finished campaign again."),
}


def main(argv: list[str] | None = None) -> int:
    """List the campaigns with their first line (exit code 0), or run the one that is named."""
    return _run("python -m campaigns", {}, argv)


def tether(argv: list[str] | None = None) -> int:
    """The command `tether`: list what there is, or run a campaign or one of COMMANDS. Returns the exit code."""
    return _run("tether", COMMANDS, argv)


def _run(called: str, commands: dict[str, tuple], argv: list[str] | None) -> int:
    argv = sys.argv[1:] if argv is None else argv
    campaigns = _campaigns()
    if not argv or argv[0] in ("-h", "--help"):
        print(f"{called} NAME ...; --help tells the options of each\n")
        for name, (_, line) in commands.items():
            print(f"  {name:<14} {line}")
        for name in campaigns:
            text = (Path(__file__).parent / name / "__init__.py").read_text(encoding="utf-8")
            print(f"  {name:<14} {(ast.get_docstring(ast.parse(text)) or '').partition(chr(10))[0]}")
        return 0
    name, *words = argv
    name = name.removeprefix("campaigns.")
    if name in commands:
        return importlib.import_module(commands[name][0]).main(words)
    if name in campaigns:
        return importlib.import_module(f"campaigns.{name}").main(words)
    names = [*commands, *campaigns]
    kind = "command" if commands else "campaign"
    print(f"{called}: no {kind} {argv[0]!r}{close_to(name, names)}; allowed: {', '.join(names)}", file=sys.stderr)
    return 2


def _campaigns() -> list[str]:
    return sorted(path.parent.name for path in Path(__file__).parent.glob("*/__main__.py"))


def _parser_of(name: str) -> argparse.ArgumentParser:
    """The options of a command of `tether`."""
    path = COMMANDS[name][0] if name in COMMANDS else f"campaigns.{name}"
    module = importlib.import_module(path)
    return getattr(module, "STUDY", module).parser()


def installed() -> int:
    """The entry point of `tether` (pyproject.toml)."""
    if "_ARGCOMPLETE" in os.environ:  # the Tab key of a shell
        from campaigns.completion import complete

        complete([*COMMANDS, *_campaigns()], _parser_of)
    open_streams()
    return printed(tether)


if __name__ == "__main__":
    open_streams()
    sys.exit(printed(main))
