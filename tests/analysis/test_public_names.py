"""The package is light until used, and its names mean the same in whatever order one imports."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import analysis

PACKAGE = Path(analysis.__file__).parent
MODULES = {path.stem for path in PACKAGE.glob("*.py")} - {"__init__", "__main__"}


def test_importing_the_package_imports_no_array_library_and_no_module_hides_a_function():
    code = "import analysis, sys; print([m for m in ('numpy', 'scipy') if m in sys.modules])"
    answer = subprocess.run([sys.executable, "-c", code], cwd=PACKAGE.parent, capture_output=True, text=True)
    assert answer.stdout.strip() == "[]", answer.stderr
    assert not MODULES & set(analysis.__all__)
    with pytest.raises(AttributeError, match="wolf"):
        _ = analysis.wolf


@pytest.mark.parametrize("name", analysis.__all__)
def test_every_public_name_says_what_it_does(name):
    public = getattr(analysis, name)
    assert callable(public) and len(public.__doc__.split()) >= 12
    assert getattr(import_module(public.__module__), name) is public
