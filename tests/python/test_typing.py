"""The module is typed: mypy finds nothing, and every public name says what it does."""

import inspect
from pathlib import Path

import pytest

import splotchcl
from conftest import run_python
from splotchcl._shown import Shown

SOURCES = Path(__file__).parents[2] / "src" / "python" / "splotchcl"
USE = """
import numpy as np
import splotchcl

particles = splotchcl.Particles(box_size=1).gas(position=np.zeros((3, 3)), mass=1.0)
scene = splotchcl.suggest(particles, size=(8, 8))
image: splotchcl.Image = splotchcl.render(scene, particles, progress=lambda what, part: None)
width: int = image.width
sigma = splotchcl.column(particles).values.max()
"""


def run_mypy(*arguments):
    pytest.importorskip("mypy")
    words = ["-m", "mypy", "--strict", "--cache-dir=/dev/null", *arguments]
    done = run_python(*words, folder=SOURCES.parent)
    assert done.returncode == 0, done.stdout + done.stderr


def test_mypy_finds_nothing_in_the_module_and_its_use(tmp_path):
    (tmp_path / "use.py").write_text(USE)
    run_mypy("splotchcl", str(tmp_path / "use.py"))


def is_documented(item):
    return bool(inspect.getdoc(item))


def test_every_public_name_has_a_docstring():
    documented = [name for name in splotchcl.__all__ if name != "__version__"]
    assert [name for name in documented if not is_documented(getattr(splotchcl, name))] == []


def public_functions():
    for name in splotchcl.__all__:
        item = getattr(splotchcl, name)
        if inspect.isfunction(item):
            yield name, item
        elif inspect.isclass(item) and item.__module__ != "splotchcl._core":
            for method, function in inspect.getmembers(item, inspect.isfunction):
                if not method.startswith("_") and function.__module__.startswith("splotchcl"):
                    yield f"{name}.{method}", function


def test_every_public_function_has_a_docstring_and_types():
    for name, function in public_functions():
        assert is_documented(function), name
        parameters = list(inspect.signature(function).parameters.values())
        named = [p for p in parameters if p.name not in ("self", "cls")]
        assert all(p.annotation is not inspect.Parameter.empty for p in named), name


@pytest.mark.parametrize("name", ["render", "suggest", "column", "movie", "galaxy"])
def test_docstrings_name_every_parameter(name):
    """In numpydoc's form, or as another function's."""
    function = getattr(splotchcl, name)
    text = inspect.getdoc(function)
    assert "Parameters\n----------" in text
    for parameter in inspect.signature(function).parameters.values():
        is_group = parameter.name == "shown"
        for name in Shown.__annotations__ if is_group else [parameter.name]:
            assert name in text, name
