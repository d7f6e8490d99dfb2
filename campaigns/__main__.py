"""`python -m campaigns` lists the campaigns; `python -m campaigns NAME ...` is `python -m campaigns.NAME ...`."""

import ast
import importlib
import sys
from pathlib import Path

from engine.streams import open_streams, printed


def main(argv: list[str] | None = None) -> int:
    """List the campaigns with their first line (exit code 0), or run the one that is named."""
    argv = sys.argv[1:] if argv is None else argv
    if argv and argv[0] not in ("-h", "--help"):
        name = argv[0].removeprefix("campaigns.")
        if name in _names():
            return importlib.import_module(f"campaigns.{name}").main(argv[1:])
        print(f"python -m campaigns: no campaign {argv[0]!r}; allowed: {', '.join(_names())}", file=sys.stderr)
        return 2
    print("python -m campaigns NAME ..., or python -m campaigns.NAME ...; --help tells the options of each\n")
    for name in _names():
        text = (Path(__file__).parent / name / "__init__.py").read_text(encoding="utf-8")
        print(f"  {name:<14} {(ast.get_docstring(ast.parse(text)) or '').partition(chr(10))[0]}")
    return 0


def _names() -> list[str]:
    return sorted(path.parent.name for path in Path(__file__).parent.glob("*/__main__.py"))


if __name__ == "__main__":
    open_streams()
    sys.exit(printed(main))
