"""Imports go one way: machine_code < engine, analysis < reports < campaigns, and importing the surface stays cheap."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MAY_IMPORT = {  # docs/design.md
    "machine_code": {"machine_code"},
    "engine": {"engine", "machine_code"},
    "analysis": {"analysis", "machine_code"},
    "reports": {"reports", "engine", "analysis"},
    "campaigns": {"campaigns", "reports", "engine", "analysis"},
}
OURS = {*MAY_IMPORT, "tests", "benchmarks"}


def imported(source: str, package: tuple[str, ...]) -> set[str]:
    """Full names of the modules that a source imports anywhere, lazily included; package resolves relative imports."""
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            names.add(".".join([*base, *([node.module] if node.module else [])]))
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", getattr(node.func, "id", "")) in (
            "import_module",
            "__import__",
        ):
            names |= {arg.value for arg in node.args if isinstance(arg, ast.Constant) and isinstance(arg.value, str)}
    return names


def forbidden(package: str, names: set[str]) -> set[str]:
    return {name for name in names if name.partition(".")[0] in OURS - MAY_IMPORT[package]}


@pytest.mark.parametrize("package", sorted(MAY_IMPORT))
def test_no_import_against_the_flow(package):
    files = sorted((ROOT / package).rglob("*.py"))
    assert files
    against = {
        str(path.relative_to(ROOT)): found
        for path in files
        if (found := forbidden(package, imported(path.read_text(), path.relative_to(ROOT).parts[:-1])))
    }
    assert not against


@pytest.mark.parametrize(
    ("package", "source"),
    [
        ("engine", "def f():\n    from analysis import spectrum"),
        ("engine", "import campaigns.machinery.runner as r"),
        ("analysis", "from engine.scene import Scene"),
        ("machine_code", "from engine.compiled import kernel"),
        ("reports", "from campaigns import cli"),
        ("campaigns", "import benchmarks"),
        ("engine", "def f():\n    import analysis.spectra, math"),
        ("analysis", "importlib.import_module('engine')"),
    ],
)
def test_the_rule_sees_every_form_of_import(package, source):
    assert forbidden(package, imported(source, (package, "inner")))


def test_every_campaign_can_be_run_and_has_a_report():
    from reports import CONTENTS

    folders = {path.parent.name for path in (ROOT / "campaigns").glob("*/__init__.py")} - {"machinery"}
    assert folders | {"time_series"} == set(CONTENTS)  # python -m analysis: a folder, and no campaign
    for name in folders:
        assert (ROOT / "campaigns" / name / "__main__.py").exists() and (ROOT / "reports" / name / "report.py").exists()


def test_benchmarks_and_tests_are_not_installed():
    import tomllib

    find = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]["packages"]["find"]
    assert {name.rstrip("*") for name in find["include"]} == set(MAY_IMPORT)
    assert find["namespaces"] is False


@pytest.mark.parametrize(
    ("statement", "absent"),
    [
        ("import engine", ("pydantic", "numpy", "numba", "pandas")),
        ("from engine import load_scene; load_scene('tethered_buoy')", ("numba", "pandas", "scipy", "matplotlib")),
        ("from engine import Trajectory", ("numba", "pandas", "xarray", "matplotlib")),
    ],
)
def test_what_is_not_needed_is_not_imported(statement, absent):
    code = f"import sys; {statement}; print([name for name in {absent!r} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize(
    "statement",
    [
        "from engine.simulate import simulate_batch; from engine import simulate",
        "from engine import simulate; import engine.simulate",
        "import engine; simulate = engine.simulate; import engine.simulate",
    ],
)
def test_the_public_names_do_not_depend_on_the_order_of_imports(statement):
    code = f"{statement}; import engine, inspect; print(inspect.isfunction(simulate), simulate is engine.simulate)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "True"]
