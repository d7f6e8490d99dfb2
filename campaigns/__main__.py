"""`python -m campaigns` lists the campaigns. `python -m campaigns NAME` runs one, as `python -m campaigns.NAME` does.

The command `tether` is one name for all commands: `tether NAME ...` runs a campaign or one of COMMANDS.
"""

import argparse
import ast
import importlib
import os
import sys
from pathlib import Path
from types import ModuleType

from engine.streams import close_to, open_streams, printed

COMMANDS = {  # of `tether`, beside the campaigns: the module of each, and what it does
    "new": ("engine.own_mooring.command", "Your own mooring: asks for buoy, rope, water and wave, writes a scene."),
    "run": ("engine.__main__", "Run one scene until its motion is known, and draw a figure."),
    "analysis": ("campaigns.time_series", "Is a measured column regular or chaotic?"),
    "report": ("reports.__main__", "Make the report of a finished campaign again."),
}


def main(argv: list[str] | None = None) -> int:
    """List the campaigns, or run the one that the first word names. Returns the exit code."""
    return _run("python -m campaigns", {}, argv)


def tether(argv: list[str] | None = None) -> int:
    """The command `tether`: list COMMANDS and the campaigns, or run one of these. Returns the exit code."""
    return _run("tether", COMMANDS, argv)


def _run(program: str, commands: dict[str, tuple], argv: list[str] | None) -> int:
    """List these commands and all campaigns with what they do, or run the one that the first word names.

    program: its name in messages.
    """
    if argv is None:
        argv = sys.argv[1:]
    purposes = {name: purpose for name, (_, purpose) in commands.items()}
    if not argv or argv[0] in ("-h", "--help"):
        for name in _campaigns():
            source = (Path(__file__).parent / name / "__init__.py").read_text(encoding="utf-8")
            purposes[name] = (ast.get_docstring(ast.parse(source)) or "").partition("\n")[0]
        print(f"{program} NAME ...; --help tells the options of each\n")
        for name, purpose in purposes.items():
            print(f"  {name:<14} {purpose}")
        return 0
    name, *words = argv
    name = name.removeprefix("campaigns.")
    names = [*commands, *_campaigns()]
    if name in names:
        return _module_of(name).main(words)
    kind = "command" if commands else "campaign"
    print(f"{program}: no {kind} {argv[0]!r}{close_to(name, names)}; allowed: {', '.join(names)}", file=sys.stderr)
    return 2


def _campaigns() -> list[str]:
    """The names of all campaigns."""
    return sorted(path.parent.name for path in Path(__file__).parent.glob("*/__main__.py"))


def _module_of(name: str) -> ModuleType:
    """The module of one of COMMANDS, or of a campaign."""
    path = f"campaigns.{name}"
    if name in COMMANDS:
        path, _ = COMMANDS[name]
    return importlib.import_module(path)


def _parser_of(name: str) -> argparse.ArgumentParser:
    """The options of one of COMMANDS, or of a campaign."""
    module = _module_of(name)
    return getattr(module, "STUDY", module).parser()


def installed() -> int:
    """The entry point of `tether` (pyproject.toml). Returns the exit code."""
    if "_ARGCOMPLETE" in os.environ:  # a shell asks what may follow, because its Tab key was hit
        from campaigns.completion import complete

        complete([*COMMANDS, *_campaigns()], _parser_of)
    open_streams()
    return printed(tether)


if __name__ == "__main__":
    open_streams()
    sys.exit(printed(main))
