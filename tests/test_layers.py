"""Imports go one way, no two modules import each other, and importing the surface stays cheap.

    machine_code < engine < tables < reports            analysis stands on machine_code, campaigns on all but reports

A campaign calls the reports in one place, by name; `python -m analysis` hands its words over to a campaign; what a
Trajectory says of itself by the measures of `analysis` is one module, which imports them when it is asked. The rooms of
the engine stand on FLOORS: a module imports its own floor and those below.
"""

import ast
import tomllib
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

from tests.pages import ROOT
from tests.processes import python

BELOW = {
    "machine_code": set(),
    "engine": {"machine_code"},
    "analysis": {"machine_code"},
    "tables": {"machine_code", "engine"},
    "reports": {"machine_code", "engine", "analysis", "tables"},
    "campaigns": {"machine_code", "engine", "analysis", "tables"},
}
OURS = {*BELOW, "tests", "benchmarks"}
DOORS = {  # the only imports against the flow: module -> what it may import
    "campaigns.machinery.session": "reports.build",
    "campaigns.regime_map.maps": "reports.regime_map.draw",
    "analysis.__main__": "campaigns.time_series",
    "engine.views": "analysis",
}
FLOORS = (  # rooms and modules of the engine, from the ground up; of two that hold a module the inner one counts
    {"atomic", "streams", "digits", "record", "arrays", "compiled", "simd", "time.integrators"},
    {"planar.columns", "spatial.columns", "spatial.vectors", "scene.values", "scene.faults"},
    {"physics.laws", "physics.law_choice", "physics.tension", "physics.drag", "physics.strains"},
    {"scene"},
    {"physics", "natural_frequencies"},
    {"planar", "spatial"},
    {"dimensions", "parameters"},
    {"trajectory"},
    {"time"},
    {"perturbations", "paper_box", "massless"},
    {"lanes"},
    {"run"},
    {"animation"},
    {"views", "own_mooring"},
    {"__main__"},
)
FORWARDED = ("engine.trajectory", "engine.views")  # the methods of a Trajectory that look at it by `analysis`
LAZILY = {"import_module", "__import__", "run_module"}


def _name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


FILES = {_name(path): path for package in BELOW for path in sorted((ROOT / package).rglob("*.py"))}


def imported(source: str, package: str) -> set[str]:
    """Full names that a source imports anywhere, lazily too, but for `if TYPE_CHECKING`; package: of the module."""
    names: set[str] = set()
    todo: list[ast.AST] = [ast.parse(source)]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            todo += node.orelse
            continue
        todo += ast.iter_child_nodes(node)
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: package.count(".") + 2 - node.level] if node.level else []
            base = [*above, *([node.module] if node.module else [])]
            names |= {".".join([*base, alias.name]) for alias in node.names}
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in LAZILY:
            names |= {arg.value for arg in node.args if isinstance(arg, ast.Constant) and isinstance(arg.value, str)}
    return names


@cache
def imports_of(name: str) -> set[str]:
    package = name if FILES[name].name == "__init__.py" else name.rpartition(".")[0]
    return imported(FILES[name].read_text(encoding="utf-8"), package)


def against(name: str, names: set[str]) -> set[str]:
    """What a module must not import: of ours, but neither of its own package nor of one below, nor by its door."""
    package = name.partition(".")[0]
    forbidden = OURS - BELOW[package] - {package}
    door = DOORS.get(name, "no door") + "."
    return {other for other in names if other.partition(".")[0] in forbidden and not f"{other}.".startswith(door)}


@pytest.mark.parametrize("package", sorted(BELOW))
def test_no_import_against_the_flow(package):
    found = {name: against(name, imports_of(name)) for name in FILES if name.partition(".")[0] == package}
    wrong = {name: names for name, names in found.items() if names}
    assert found and not wrong


def test_every_module_that_is_imported_exists():
    """Within functions too, where an import that is out of date shows only when it is called."""
    missing = {}
    for name in FILES:
        ours = {full for full in imports_of(name) if full.partition(".")[0] in BELOW}
        missing[name] = {full for full in ours if not {full, full.rpartition(".")[0]} & FILES.keys()}
    assert not {name: modules for name, modules in missing.items() if modules}


def floor_of(name: str) -> int:
    """The floor of a module of the engine."""
    parts = name.split(".")[1:]
    inner = [".".join(parts[:count]) for count in range(len(parts), 0, -1)]
    return next(floor for room in inner for floor, rooms in enumerate(FLOORS) if room in rooms)


def test_the_rooms_of_the_engine_import_those_below():
    up = []
    for name in (name for name in FILES if name.startswith("engine.")):
        for full in imports_of(name):
            target = full if full in FILES else full.rpartition(".")[0]
            if target.startswith("engine.") and floor_of(target) > floor_of(name) and (name, target) != FORWARDED:
                up.append(f"{name} -> {target}")
    assert not up


def test_no_ring_of_imports():
    """A ring is a CycleError, which names the modules on it."""
    graph = {}
    for name in FILES:
        whole = {other if other in FILES else other.rpartition(".")[0] for other in imports_of(name)}
        graph[name] = (whole & FILES.keys()) - {name}
    TopologicalSorter(graph).prepare()


@pytest.mark.parametrize(
    ("name", "source"),
    [
        ("engine.run", "def f():\n    import analysis.spectra, math"),
        ("engine.views", "def f():\n    import reports.figures.curves"),
        ("engine.time.steps", "import campaigns.machinery.runner as r"),
        ("analysis.spectra", "from engine.scene import Scene"),
        ("analysis.spectra", "importlib.import_module('engine')"),
        ("analysis.__main__", "runpy.run_module('campaigns.buoy_sweep')"),
        ("campaigns.machinery.session", "from reports.parts import html"),
        ("reports.parts.html", "if TYPE_CHECKING:\n    import math\nelse:\n    import campaigns"),
        ("reports.parts.html", "from ...campaigns import cli"),
        ("tables.columns", "from campaigns.explore import rows"),
        ("tables.files", "import analysis"),
    ],
)
def test_the_rule_sees_every_form_of_import(name, source):
    assert against(name, imported(source, name.rpartition(".")[0]))


def test_only_the_packages_are_installed():
    find = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["packages"]["find"]
    assert {name.rstrip("*") for name in find["include"]} == set(BELOW) and find["namespaces"] is False


@pytest.mark.parametrize(
    ("statement", "absent"),
    [
        ("import engine", ("pydantic", "numpy", "numba", "pandas")),
        ("from engine import load_scene; load_scene('tethered_buoy')", ("numba", "pandas", "scipy", "matplotlib")),
        ("import tables.columns, tables.files, tables.words", ("numpy", "pandas", "pydantic")),
        ("from engine import Trajectory", ("numba", "pandas", "xarray", "matplotlib", "analysis", "scipy")),
    ],
)
def test_what_is_not_needed_is_not_imported(statement, absent):
    code = f"import sys; {statement}; print([name for name in {absent!r} if name in sys.modules])"
    assert python("-c", code).stdout == "[]\n"


@pytest.mark.slow
@pytest.mark.parametrize(
    "statement",
    [
        "from engine.run.simulation import simulate_batch; from engine import simulate",
        "import engine; simulate = engine.simulate; import engine.run.simulation",
    ],
)
def test_the_public_names_do_not_depend_on_the_order_of_imports(statement):
    code = f"{statement}; import engine, inspect; print(inspect.isfunction(simulate), simulate is engine.simulate)"
    assert python("-c", code).stdout == "True True\n"
