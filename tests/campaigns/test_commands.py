"""What every command promises: help at once, sound defaults, and an answer to each mistake that says what to do.

A mistake (mistakes.toml) gets exit code 2, no traceback, and nothing is written.
"""

import importlib
import tomllib
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from campaigns import buoy_sweep
from campaigns.__main__ import COMMANDS, tether
from campaigns.__main__ import main as every_campaign
from campaigns.buoy_sweep import STEEPNESS, STUDY
from campaigns.machinery.cli import evenly, fault_of
from campaigns.machinery.plausible import doubts
from engine import load_scene
from engine.physics.waves import breaking_steepness, wave_number
from tests.campaigns.conftest import order_of
from tests.pages import ROOT
from tests.processes import python

HEAVY = {"numpy", "numba", "pandas", "scipy", "pydantic", "joblib", "matplotlib", "dask", "hypothesis", "typst"}
ASKED = """
import contextlib, runpy, sys
for name in sys.argv[1:]:
    sys.argv = [name, "--help"]
    with contextlib.suppress(SystemExit):
        runpy.run_module(name, run_name="__main__")
    print("loaded:", *sys.modules, end="\f")
"""
MISTAKEN = """
import io, runpy, sys
for words in sys.argv[1:]:
    name, *options = words.split()
    sys.argv, sys.stderr = [name, *options], io.StringIO()
    try:
        runpy.run_module(name, run_name="__main__")
    except SystemExit as end:
        print(end.code, "loaded:", *sys.modules, end="\f")
"""
MISTAKES = tomllib.loads(Path(__file__).with_name("mistakes.toml").read_text(encoding="utf-8"))
TABLES = tomllib.loads(Path(__file__).with_name("commands.toml").read_text(encoding="utf-8"))
HELPS = TABLES["helps"]
ROWS = [f"{0.1 * k:.3f},{np.sin(k):.6f}" for k in range(300)]


def table(rows):
    return "\n".join(["t,x", *rows])


def changed(row, text):
    return table([*ROWS[:row], text, *ROWS[row + 1 :]])


BREAK = (ROOT / "engine" / "scenes" / "breaking_line.toml").read_text(encoding="utf-8")
FILES = TABLES["files"] | {
    "utf16.toml": 'name = "mine"\n'.encode("utf-16"),
    "latin1.toml": '# Schäkel\nname = "mine"\n'.encode("latin-1"),
    "break.toml": BREAK.replace("force_N = [450000.0", "force_N = [2e5").replace("decay_s = 0.005", "decay_s = 0.02"),
    "nan.csv": changed(7, "0.700,nan"),
    "gap.csv": changed(7, "0.700,"),
    "word.csv": changed(7, "0.700,broken"),
    "comma.csv": changed(7, "0.700,1,5"),
    "jump.csv": table(ROWS[:100] + ROWS[150:]),
    "back.csv": changed(7, "0.650,0.3").replace("0.600,", "0.800,"),
    "creep.csv": table(f"{k * (1 + 1e-3 * k)},{np.sin(k)}" for k in range(300)),
    "short.csv": table(ROWS[:99]),
    "flat.csv": table(f"{k},3.5" for k in range(300)),
    "twice.csv": "\n".join(["x,x", *ROWS]),
    "empty.csv": "\n",
    "good.csv": table(ROWS),
    "both.csv": table(row.replace(".", ",") for row in ROWS),
    "units.csv": table(["s,m", *ROWS]),
    "dates.csv": table(f"2026-11-21 13:{k // 60:02d}:{k % 60:02d},{k % 7}" for k in range(300)),
    "rounded.csv": table(f"{k / 30:.2f},{np.sin(k)}" for k in range(300)),
    "huge.csv": table(f"{k},{np.sin(k)}e300" for k in range(300)),
    "title.csv": "\n".join(["Tank 3", "", "t,x", *ROWS]),
    "blank.csv": "t x\n" + "\0" * 500,
    "kept/series.csv": table(ROWS),
    "whole/series.csv": table(ROWS),
    "image.csv": bytes(range(128, 256)),
    "latin1.csv": "t,höhe\n".encode("latin-1"),
    "table.xlsx": b"PK\x03\x04 and more",
    "packed.csv.gz": b"\x1f\x8b\x08 and more",
    "run.nc": b"CDF\x01 and more",
}


def test_help_tells_every_option_and_loads_nothing_heavy():
    """All in one process: what is loaded stays so."""
    pages = python("-c", ASKED, *HELPS).stdout.split("\f")[:-1]
    for page, parts in zip(pages, HELPS.values(), strict=True):
        statement, loaded = page.split("loaded:")
        assert all(part in statement for part in parts.split()) and "[N ...]" not in statement
        assert not HEAVY & set(loaded.split())


def test_a_mistake_is_answered_before_a_library_of_numbers_is_loaded():
    """That of a scene needs pydantic only, and the others not even that."""
    campaigns = [name for name in HELPS if name.startswith("campaigns.")]
    others = ["analysis missing.csv", "campaigns.validation --only nothing", "campaigns.orbits --motion q"]
    others += [f"{name} --bogus" for name in campaigns]
    scenes = ["engine tethered_buoy", "campaigns.sweep --vary buoy.mass_kg 800 900 2", "campaigns.buoy_sweep"]
    scenes += [f"campaigns.{name}" for name in ("sea", "orbits", "basins", "regime_map", "breaking_line")]
    lines = [*others, *(f"{words} --set tether.nodez=9" for words in scenes)]
    pages = python("-c", MISTAKEN, *lines).stdout.split("\f")[:-1]
    for number, (line, page) in enumerate(zip(lines, pages, strict=True)):
        code, loaded = page.split("loaded:")
        needed = {"pydantic"} if number >= len(others) else set()
        assert code.strip() == "2" and HEAVY & set(loaded.split()) <= needed, line


def test_tether_is_one_name_for_all_commands(capsys):
    assert tether([]) == 0
    listed = capsys.readouterr().out
    assert all(f"  {name} " in listed for name in (*COMMANDS, "sweep", "buoy_sweep"))
    for words in (["sweep"], ["new"], ["run"], ["analysis"], ["report"]):
        with pytest.raises(SystemExit) as ended:
            tether([*words, "--help"])
        assert ended.value.code == 0 and "usage: python -m" in capsys.readouterr().out
    assert tether(["bouy_sweep"]) == 2
    assert "did you mean 'buoy_sweep'?" in capsys.readouterr().err
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["scripts"]
    module, _, function = declared["tether"].partition(":")
    assert callable(getattr(importlib.import_module(module), function))


@pytest.mark.parametrize(
    ("line", "word"),
    [
        ("tether swe", "sweep"),
        ("tether sweep --va", "--vary"),
        ("tether new --rope-", "--rope-mm"),
        ("tether run teth", "tethered_buoy"),
        ("tether validation --qu", "--quick"),
        ("tether sweep --vary tether.grid_s", "tether.grid_stretching"),
        ("tether run tethered_buoy --set tether.grid_s", "tether.grid_stretching="),
        ("tether report --he", "--help"),
    ],
)
def test_the_tab_key_completes_a_line(tmp_path, line, word):
    """The variables are those of the shell function of argcomplete."""
    requested = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_STDOUT_FILENAME": str(tmp_path / "words"), "COMP_LINE": line}
    requested["COMP_POINT"] = str(len(line))
    program = "from campaigns.__main__ import installed; installed()"
    python("-c", program, **requested)
    assert word in (tmp_path / "words").read_text().replace("\013", " ").split()


def test_no_argument_is_a_complete_order_that_meets_the_papers_two_values():
    assert {0.016, 0.13} <= set(STEEPNESS) and sorted(set(STEEPNESS)) == list(STEEPNESS)
    order = order_of(STUDY)
    assert [case.labels["steepness"] for case in order.cases] == list(STEEPNESS)
    assert all(case.scene.waves.steepness == case.labels["steepness"] for case in order.cases)
    assert order.looks and order.transient is None
    assert order.how.out.as_posix() == "results/buoy_sweep"


@pytest.mark.parametrize("words", [[], ["--help"]])
def test_the_list_of_campaigns_is_no_mistake(capsys, words):
    assert every_campaign(words) == 0
    printed = capsys.readouterr().out
    assert "buoy_sweep     Sweep of wave steepness" in printed and "sweep          Sweep of any number" in printed


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The folder of FILES, to which no mistake adds anything."""
    folder = tmp_path_factory.mktemp("files")
    for name, text in FILES.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return folder


@pytest.fixture
def place(files, monkeypatch):
    monkeypatch.chdir(files)
    return files


def listing(place):
    return sorted((str(path), path.stat().st_mtime_ns) for path in place.rglob("*"))


@pytest.mark.parametrize(("module", "words"), [(module, words) for module in MISTAKES for words in MISTAKES[module]])
def test_the_answer_says_what_to_do(place, capsys, module, words):
    before, parts = listing(place), MISTAKES[module][words]
    assert importlib.import_module(module).main(words.split()) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    parts = [parts] if isinstance(parts, str) else parts
    counts = {part: printed.err.count(part) for part in parts}
    assert all(counts.values()) and (len(parts) > 1 or sum(counts.values()) == 1), counts
    assert listing(place) == before


@pytest.mark.parametrize("words", [["buoy_sweep", "--steepness", "0.1"], ["time_series", "good.csv", "--column", "x"]])
def test_an_empty_name_is_not_the_current_folder(place, capsys, words):
    """As from --out "$RESULTS" with a variable that is not set."""
    assert every_campaign([*words, "--out", ""]) == 2
    assert "--out: given ''" in capsys.readouterr().err


def test_a_campaign_killed_before_its_provenance_goes_on_in_its_folder(tmp_path):
    (tmp_path / "scene.toml").write_text("as run")
    assert "scene.toml" in fault_of(tmp_path, "buoy_sweep")
    (tmp_path / ".lock").touch()
    assert fault_of(tmp_path, "buoy_sweep") is None


def test_a_folder_that_is_gone(tmp_path, monkeypatch, capsys):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert buoy_sweep.main(["--steepness", "0.1"]) == 2
    assert "the folder that this is run in has been removed" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("requested", "answer", "code", "part"),
    [
        # root may write anywhere, so the answer of the system is put in its mouth
        ("os.access", False, 2, "cannot be written to; allowed: a folder that can"),
        ("engine.load_scene", ModuleNotFoundError("", name="pydantic"), 1, "no package 'pydantic'"),
        ("engine.load_scene", ModuleNotFoundError("", name="any"), 1, "pip install -c constraints.txt -e ."),
        ("engine.load_scene", KeyboardInterrupt(), 130, "interrupted; nothing was run or written"),
    ],
)
def test_what_the_system_does_not_give_is_one_line(place, capsys, monkeypatch, requested, answer, code, part):
    def answered(*_):
        if isinstance(answer, BaseException):
            raise answer
        return answer

    monkeypatch.setattr(requested, answered, raising=False)
    assert buoy_sweep.main(["--out", "new"]) == code
    assert part in capsys.readouterr().err


@pytest.mark.parametrize("package", ["engine", "analysis", "campaigns"])
def test_an_old_python_is_named_with_what_is_needed(package):
    done = python("-c", f"import sys; sys.version_info = (3, 9, 2, 'final', 0); import {package}")
    assert done.returncode == 1
    assert "needs Python 3.11 or newer, and this is 3.9.2" in done.stderr.splitlines()[-1]


def test_waves_up_to_the_limit_are_run():
    limit = breaking_steepness(wave_number(5.0, 21.0), 21.0)
    assert limit == pytest.approx(0.446, abs=2e-3)  # deep water: 0.142 pi
    highest = limit / wave_number(5.0, 21.0)  # amplitude; the significant height of a sea is twice as high
    heights = {"steepness": limit, "amplitude_m": highest, "jonswap.significant_height_m": 2.0 * highest}
    for (key, most), (share, count) in product(heights.items(), ((0.999, 0), (1.001, 1))):
        lines = [*doubts(load_scene("tethered_buoy", {f"waves.{key}": share * most}))]
        assert len(lines) == count and all(line.startswith(f"waves.{key}") for line in lines)


def test_a_wave_is_linear_up_to_an_ursell_number_of_40():
    """In shallow water the length is T sqrt(g H), so that 2 A g T^2/H^2 = 40 gives the highest amplitude."""
    period_s, depth_m = 200.0, 21.0
    highest_m = 20.0 * depth_m**2 / (9.81 * period_s**2)
    for share, count in ((0.97, 0), (1.03, 1)):
        changes = {"waves.period_s": period_s, "waves.amplitude_m": share * highest_m}
        lines = [*doubts(load_scene("tethered_buoy", changes))]
        assert len(lines) == count and all(line.startswith("waves.period_s") for line in lines)


def test_a_value_of_a_range_is_the_one_that_one_would_type():
    typed = [0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.11, 0.12, 0.13, 0.14, 0.15, 0.16]
    assert evenly(["0.01", "0.16", "16"], "--steepness-range", []) == typed
