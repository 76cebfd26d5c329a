"""What the tests of the module share: the program, particles, and a renderer."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import splotchcl


@pytest.fixture(scope="session")
def program():
    """Runs the command line of the same build; it must succeed."""
    path = os.environ.get("SPLOTCHCL_PROGRAM")
    if path is None:
        pytest.skip("SPLOTCHCL_PROGRAM does not name the program")

    def run(*arguments):
        words = [path, *map(str, arguments)]
        done = subprocess.run(words, capture_output=True, text=True, timeout=600, check=False)
        assert done.returncode == 0, done.stderr

    return run


def run_python(*words, environment=None, folder=None, timeout=600) -> subprocess.CompletedProcess:
    """Runs a Python of its own, with these words behind its name; it may fail."""
    return subprocess.run(
        [sys.executable, *map(str, words)], env={**os.environ, **(environment or {})}, cwd=folder,
        capture_output=True, text=True, timeout=timeout, check=False,
    )  # fmt: skip


@pytest.fixture(scope="session")
def universe(program, tmp_path_factory) -> Path:
    """A snapshot of 20000 particles of gas and stars."""
    path = tmp_path_factory.mktemp("universe") / "universe.gadget"
    program("generate", "universe", "--particles", 20000, "-o", path)
    return path


@pytest.fixture(scope="session")
def real_file():
    """Finds a real snapshot by its name below the folder of them."""
    folder = Path(os.environ.get("SPLOTCHCL_TEST_DATA", "nowhere"))

    def find(name):
        if not (folder / name).is_file():
            pytest.skip(f"no snapshot {name} in the folder SPLOTCHCL_TEST_DATA")
        return folder / name

    return find


@pytest.fixture(scope="session")
def odd_files(tmp_path_factory) -> Path:
    """The folder of what all generators of odd files made."""
    from odd import make_all

    folder = tmp_path_factory.mktemp("odd")
    make_all(folder)
    return folder


@pytest.fixture(scope="session")
def renderer():
    if not splotchcl.devices():
        pytest.skip("no OpenCL device")
    return splotchcl.Renderer()


def make_arrays(count: int, seed: int = 1) -> dict[str, np.ndarray]:
    """Gas in a cube of side 10, as arrays that need no copy."""
    random = np.random.default_rng(seed)
    return {
        "position": random.normal(5, 1, (count, 3)).astype(np.float32),
        "smoothing_length": random.uniform(0.1, 0.5, count).astype(np.float32),
        "mass": random.uniform(0.5, 1.5, count).astype(np.float32),
        "temperature": random.uniform(1e4, 1e6, count).astype(np.float32),
    }


@pytest.fixture
def arrays() -> dict[str, np.ndarray]:
    return make_arrays(500)


@pytest.fixture
def particles(arrays) -> splotchcl.Particles:
    return splotchcl.Particles().gas(**arrays)


class WithUnit(np.ndarray):
    """As unyt, swiftsimio and pynbody have them."""

    units: str


def in_unit(values, unit):
    array = np.asarray(values).view(WithUnit)
    array.units = unit
    return array
