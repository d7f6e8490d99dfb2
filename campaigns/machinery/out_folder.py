"""The folder that a command is given for its results: whether it can be one, and whose it is. Nothing is written."""

import os
from pathlib import Path

ALLOWED = "allowed: a folder, new or of this campaign"


def folder_name(text: str) -> Path:
    """Convert the text of --out; an empty one, as of a shell variable that is not set, would be the current folder."""
    if not text.strip():
        raise ValueError(text)
    return Path(text)


def fault_of(out: Path, campaign: str) -> str | None:
    """Why results of this campaign must not go there, as a fault line; None where they may."""
    given = f"--out: given {str(out)!r}"
    parent = next((path for path in (out, *out.absolute().parents) if path.exists()), out)
    if not parent.is_dir():
        return f"{given}, but {parent} is a file; {ALLOWED}"
    if not os.access(parent, os.W_OK):
        return f"{given}, but {parent} cannot be written to; allowed: a folder that can"
    if (held := _held(out)) not in ("", campaign):
        return f"{given}, which holds {held}; {ALLOWED}"
    return None


def _held(out: Path) -> str:
    """The campaign whose folder it is, or what else is there that would be written over; "" where nothing is."""
    import json

    try:
        return str(json.loads((out / "provenance.json").read_text(encoding="utf-8"))["campaign"])
    except FileNotFoundError:
        # A campaign that ended before it could write its provenance has left its lock.
        mine = ("scene.toml", "report.html", "report.pdf", "trajectories") if not (out / ".lock").exists() else ()
        foreign = next((name for name in ("table.csv", *mine) if (out / name).exists()), None)
        return "" if foreign is None else f"a {foreign} that no campaign wrote"
    except (OSError, ValueError, KeyError, TypeError):
        return "a provenance.json that no campaign wrote"
