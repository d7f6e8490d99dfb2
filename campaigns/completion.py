"""Words that the command `tether` may go on with, where a shell asks for them: by the library argcomplete.

eval "$(register-python-argcomplete tether)"      in ~/.bashrc or ~/.zshrc
"""

import argparse
import os
from collections.abc import Callable, Iterable

import argcomplete

NAMED = "2"  # by argcomplete's variable of this name the words begin with the second: `tether sweep ...` as `sweep ...`


def complete(names: Iterable[str], parser_of: Callable) -> None:
    """Tell the shell the names of commands, or of a named one its options, scenes and keys; ends the process."""
    line = os.environ["COMP_LINE"][: int(os.environ["COMP_POINT"])]
    _, *words = f"{line}|".split()
    if len(words) > 1 and words[0] in names:
        os.environ["_ARGCOMPLETE"] = NAMED
        parser = parser_of(words[0])
        for action in parser._actions:
            if action.dest == "scene":
                action.completer = _scenes
            elif str(action.metavar).startswith("KEY"):
                action.completer = _assigned if action.dest == "set" else _keys
    else:
        parser = argparse.ArgumentParser()
        parser.add_argument("command", choices=names)
    argcomplete.autocomplete(parser)


def _scenes(prefix: str, **_: object) -> list[str]:
    from engine import list_scenes

    return [*list_scenes(), *argcomplete.FilesCompleter(("toml",))(prefix)]


def _keys(**_: object) -> list[str]:
    from engine.scene.reference import keys

    return list(keys())


def _assigned(**_: object) -> list[str]:
    return [f"{key}=" for key in _keys()]
