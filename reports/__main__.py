"""`python -m reports DIR`: build the report of a folder of a campaign, or of `python -m analysis --out`, again."""

import argparse
import sys
from pathlib import Path

from engine.streams import open_streams, printed


def parser() -> argparse.ArgumentParser:
    """The options of the command."""
    options = argparse.ArgumentParser(
        prog="python -m reports",
        description="Build report.html and report.pdf of a campaign's folder again, from what the folder holds.",
    )
    folders = "folder of a finished campaign, or of python -m analysis (its --out)"
    options.add_argument("directory", metavar="DIR", help=folders)
    return options


def main(arguments: list[str] | None = None) -> int:
    """Build and print the two paths.

    Exit code 2 with one message for a folder that is no finished campaign, 1 for a disk that does not take the files,
    130 for Ctrl-C.
    """
    directory = parser().parse_args(arguments).directory

    if not Path(directory).is_dir():  # answered before anything heavy is loaded
        found = "it is a file" if Path(directory).exists() else "there is no such folder"
        give = "give the folder that a campaign wrote (its --out), for instance results/buoy_sweep"
        print(f"no report can be made of {directory}:\n  - {found}; {give}", file=sys.stderr)
        return 2

    from . import build
    from .parts.folder import FolderError
    from .parts.unchanged import is_unchanged

    message = f"drawing the report of {directory} ..."
    if is_unchanged(directory):
        message = f"{directory} has not changed since its report was drawn"
    print(message, file=sys.stderr)
    try:
        for path in build(directory):
            print(path)
    except FolderError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\ninterrupted; an earlier report is as it was", file=sys.stderr)
        return 130
    except BrokenPipeError:  # of stdout
        raise
    except OSError as error:
        print(f"the report could not be written: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    open_streams()
    sys.exit(printed(main))
