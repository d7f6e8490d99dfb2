"""`python -m campaigns`: which campaigns there are, for whoever leaves out the name."""

import sys
from pathlib import Path


def main() -> int:
    """List the campaigns with their first line; exit code 2, because nothing was asked for."""
    import ast

    print("python -m campaigns: a name is missing; allowed:", file=sys.stderr)
    for path in sorted(Path(__file__).parent.glob("*/__main__.py")):
        text = (path.parent / "__init__.py").read_text(encoding="utf-8")
        first = (ast.get_docstring(ast.parse(text)) or "").partition("\n")[0]
        print(f"  python -m campaigns.{path.parent.name:<14} {first}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
