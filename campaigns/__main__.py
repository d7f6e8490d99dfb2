"""`python -m campaigns` lists the campaigns; `python -m campaigns NAME ...` is `python -m campaigns.NAME ...`.

The command `tether` is one name for all commands: `tether NAME ...` runs a campaign, and COMMANDS lists the others.
"""

import ast
import difflib
import importlib
import sys
from collections.abc import Iterable
from functools import partial
from pathlib import Path

from engine.streams import open_streams, printed

COMMANDS = {  # of `tether`, beside the campaigns: module, words put before those of the user, what it does
    "new": ("engine.__main__", ["--new"], "Your own mooring: asks for buoy, rope, water and wave, writes a scene."),
    "run": ("engine.__main__", [], "One scene until its motion is told, with a figure."),
    "analysis": ("campaigns.time_series", [], "Is a measured column regular or chaotic?"),
    "report": ("reports.__main__", [], "Make the report of a finished campaign again."),
}


def main(argv: list[str] | None = None) -> int:
    """List the campaigns with their first line (exit code 0), or run the one that is named."""
    argv = sys.argv[1:] if argv is None else argv
    if argv and argv[0] not in ("-h", "--help"):
        name = argv[0].removeprefix("campaigns.")
        if name in _names():
            return importlib.import_module(f"campaigns.{name}").main(argv[1:])
        return _refused("python -m campaigns", "campaign", argv[0], _names())
    print("python -m campaigns NAME ..., or python -m campaigns.NAME ...; --help tells the options of each\n")
    _list(_names())
    return 0


def tether(argv: list[str] | None = None) -> int:
    """The command `tether`: list what there is, or run a campaign or one of COMMANDS. Returns the exit code."""
    argv = sys.argv[1:] if argv is None else argv
    names = [*COMMANDS, *_names()]
    if not argv or argv[0] in ("-h", "--help"):
        print("tether NAME ...; --help tells the options of each\n")
        _list(names)
        return 0
    name, *words = argv
    if name in COMMANDS:
        module, before, _ = COMMANDS[name]
        return importlib.import_module(module).main([*before, *words])
    if name in names:
        return importlib.import_module(f"campaigns.{name}").main(words)
    return _refused("tether", "command", name, names)


def installed() -> int:
    """The entry point of `tether` (pyproject.toml)."""
    open_streams()
    return printed(partial(tether, sys.argv[1:]))


def _refused(command: str, kind: str, given: str, names: list[str]) -> int:
    close = difflib.get_close_matches(given.removeprefix("campaigns."), names, n=1)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    print(f"{command}: no {kind} {given!r}{hint}; allowed: {', '.join(names)}", file=sys.stderr)
    return 2


def _list(names: Iterable[str]) -> None:
    for name in names:
        if name in COMMANDS:
            line = COMMANDS[name][2]
        else:
            text = (Path(__file__).parent / name / "__init__.py").read_text(encoding="utf-8")
            line = (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
        print(f"  {name:<14} {line}")


def _names() -> list[str]:
    return sorted(path.parent.name for path in Path(__file__).parent.glob("*/__main__.py"))


if __name__ == "__main__":
    open_streams()
    sys.exit(printed(main))
