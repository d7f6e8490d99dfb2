"""The package is light until used, needs nothing of ours, and its names mean the same in whatever order one imports."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import analysis

PACKAGE = Path(analysis.__file__).parent


def _run(code):
    return subprocess.run([sys.executable, "-c", code], cwd=PACKAGE.parent, capture_output=True, text=True)


def test_importing_the_package_imports_no_array_library():
    answer = _run("import analysis, sys; print([m for m in ('numpy', 'scipy') if m in sys.modules])")
    assert answer.stdout.strip() == "[]", answer.stderr


def test_every_public_name_is_a_function_or_record_even_after_every_module_was_imported():
    names = [path.stem for path in PACKAGE.glob("*.py") if path.stem != "__init__"]
    code = "\n".join(f"import analysis.{name}" for name in names)
    code += "\nimport analysis\nassert all(callable(getattr(analysis, name)) for name in analysis.__all__)"
    answer = _run(code)
    assert answer.returncode == 0, answer.stderr


def test_no_module_has_the_name_of_a_function():
    assert not {path.stem for path in PACKAGE.glob("*.py")} & set(analysis.__all__)


@pytest.mark.parametrize("name", analysis.__all__)
def test_every_public_name_says_what_it_does(name):
    public = getattr(analysis, name)
    assert len(public.__doc__.split()) >= 12
    assert getattr(import_module(public.__module__), name) is public


def test_the_measures_use_nothing_of_the_other_packages():
    code = "import analysis, sys\n[getattr(analysis, name) for name in analysis.__all__]\n"
    code += "print([m for m in ('engine', 'reports', 'campaigns') if m in sys.modules])"
    assert _run(code).stdout.strip() == "[]"


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="wolf"):
        _ = analysis.wolf
