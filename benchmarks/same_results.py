"""Does a change of the code leave every result as it was? Digests of all that the commands leave on disk.

    python -m benchmarks.same_results make DIR                 run the commands into DIR and write DIR/digests.json
    python -m benchmarks.same_results compare OLD NEW          what differs between two digests.json; exit 1
    options of make: --only WORD ...                           commands with one of these words

A digest is made of each column of a table but times and keys, of each array of a run, and of the text of each page
without times, keys and dates. Runs are told apart by their content, because their names are keys of the sources.
The default sweep and every --quick command take a quarter of an hour on two cores.
"""

import argparse
import csv
import hashlib
import json
import re
import subprocess
import sys
from collections import Counter
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import xarray

COMMANDS = {
    "sweep": "campaigns.buoy_sweep",
    "depths": "campaigns.sweep --vary water.depth_m 21 22 3",
    "basins": "campaigns.basins --grid 3 --set tether.nodes=11 water.depth_m=25",
    "map": "campaigns.regime_map --vary waves.steepness .05 .15 4 --vary water.depth_m 21 25 4 --budget 300",
    "orbits": "campaigns.orbits --set water.depth_m=25 --vary waves.steepness .1 .17 --values 3",
    "breaking": "campaigns.breaking_line --cases 1 --no-companions --set tether.nodes=201",
    "oscillator": "campaigns.oscillator --effort .05",
    "plane": "campaigns.out_of_plane --periods 60",
    "accuracy": "campaigns.accuracy --quick",
    "validation": "campaigns.validation --quick",
    "stability": "campaigns.stability --quick",
    "paper": "campaigns.paper --quick",
}
UNSTEADY = re.compile(r"wall|time_s$|cost|seconds|run_key|_key$|timing|host|started|finished|made_by|hash")
KEY = re.compile(r"\b[0-9a-f]{8,}\b")
DURATION = re.compile(r"\d[\d.,:]*(e[-+]?\d+)? ?(s|ms|us|µs|min|minutes?|hours?|h)\b|\d{4}-\d\d-\d\d[T ]?[\d:.]*Z?")


class PageText(HTMLParser):
    """The words of a page, without its scripts and styles."""

    def __init__(self):
        super().__init__()
        self.words: list[str] = []
        self.hidden = 0

    def handle_starttag(self, tag, attrs):
        self.hidden += tag in ("script", "style", "svg")

    def handle_endtag(self, tag):
        self.hidden -= tag in ("script", "style", "svg")

    def handle_data(self, data):
        if not self.hidden:
            self.words += data.split()


def digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:16]


def steady(text: str) -> str:
    """A text without keys, times and dates."""
    return DURATION.sub("TIME", KEY.sub("KEY", text))


def of_table(path: Path) -> dict[str, str]:
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    columns = zip(*rows, strict=True) if rows else []
    return {name: digest(steady("\n".join(cells)).encode()) for name, *cells in columns if not UNSTEADY.search(name)}


def of_arrays(path: Path) -> str:
    data = xarray.load_dataset(path, engine="scipy")
    parts = []
    for name in sorted(data.variables):
        if not UNSTEADY.search(name) or name.endswith("time_s"):
            values = np.ascontiguousarray(data[name].values)
            parts.append(f"{name} {values.dtype} {values.shape} {digest(values.tobytes())}")
    return digest("\n".join(parts).encode())


def of_page(path: Path) -> str:
    page = PageText()
    page.feed(path.read_text(encoding="utf-8"))
    return digest(steady(" ".join(page.words)).encode())


def of_folder(folder: Path) -> dict[str, object]:
    """Path within the folder, or the folder of runs -> digest of what stands there."""
    digests: dict[str, object] = {}
    runs: Counter = Counter()
    for path in sorted(folder.rglob("*")):
        name = path.relative_to(folder).as_posix()
        if path.suffix == ".csv":
            digests |= {f"{name}:{column}": column_digest for column, column_digest in of_table(path).items()}
        elif path.suffix == ".nc" and path.parent.name == "trajectories":
            runs[f"{Path(name).parent.as_posix()} {of_arrays(path)}"] += 1
        elif path.suffix in (".txt", ".toml"):
            digests[name] = digest(steady(path.read_text(encoding="utf-8")).encode())
        elif path.suffix == ".html":
            digests[name] = of_page(path)
    return digests | dict(runs)


def make(out: Path, only: list[str]) -> None:
    digests = {}
    for name, command in COMMANDS.items():
        if only and not any(word in name for word in only):
            continue
        folder = out / name
        ended = subprocess.run([sys.executable, "-m", *command.split(), "--out", str(folder)], stdin=subprocess.DEVNULL)
        digests[name] = {"exit": ended.returncode} | of_folder(folder)
        (out / "digests.json").write_text(json.dumps(digests, indent=1, sort_keys=True))


def compare(old: dict, new: dict) -> int:
    """Print what differs; the number of differences."""
    count = 0
    for command in sorted(old.keys() | new.keys()):
        old_digests, new_digests = old.get(command, {}), new.get(command, {})
        for name in sorted(old_digests.keys() | new_digests.keys()):
            if old_digests.get(name) != new_digests.get(name):
                kind = "gone" if name not in new_digests else "new" if name not in old_digests else "changed"
                print(f"{command}: {kind}: {name}")
                count += 1
    return count


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("action", choices=("make", "compare"))
    parser.add_argument("paths", type=Path, nargs="+")
    parser.add_argument("--only", nargs="*", default=[])
    options = parser.parse_args()
    if options.action == "make":
        make(options.paths[0], options.only)
    else:
        old, new = (json.loads(path.read_text()) for path in options.paths)
        sys.exit(bool(compare(old, new)))


if __name__ == "__main__":
    main()
