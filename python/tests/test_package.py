"""The package itself: documentation that runs, types, and what is imported when."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import subprocess
import sys

import pytest

import holdfast

MODULES = [m.name for m in pkgutil.iter_modules(holdfast.__path__) if m.name not in ("__main__", "_core")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings(name):
    module = importlib.import_module(f"holdfast.{name}")
    assert doctest.testmod(module).failed == 0


def test_everything_public_has_a_docstring():
    for name in holdfast.__all__:
        thing = getattr(holdfast, name)
        if name != "__version__":
            assert inspect.getdoc(thing), name


def test_only_numpy_is_imported():
    code = ("import sys, holdfast; print(sorted(m for m in ('meshio', 'vtkmodules', 'pyvista', 'trimesh', 'tqdm', 'distributed') "
            "if m in sys.modules))")
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"


def test_stubs():
    pytest.importorskip("mypy")
    run = subprocess.run([sys.executable, "-m", "mypy.stubtest", "holdfast"], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr


def test_types_of_the_sources():
    pytest.importorskip("mypy")
    run = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "-p", "holdfast"],
                         capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
