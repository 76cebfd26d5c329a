"""Files of odd habits, by generators among the test data; h5py, numpy and astropy say what they hold."""

import importlib.util
import io
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import splotchcl

h5py = pytest.importorskip("h5py")

FOLDER = Path(os.environ.get("SPLOTCHCL_TEST_DATA", "nowhere")) / "odd"
SCRIPTS = {path.stem: path for path in sorted(FOLDER.glob("[a-z][0-9][0-9]_*.py"))}
HAS_ASTROPY = importlib.util.find_spec("astropy") is not None

GAMMA_OF_CUBIC_SPLINE = 1.825742  # of its support to its smoothing length in three dimensions
WIDTH_OF_KERNEL = 1 / math.sqrt(20 / 3)  # of the Gaussian to the smoothing length

STARS = {"position": "Coordinates", "mass": "Masses", "id": "ParticleIDs"}
GAS = STARS | {"smoothing_length": "SmoothingLength"}


def of(generator):
    """Says which generator's files a test reads."""
    reason = f"no generator {generator} in the folder SPLOTCHCL_TEST_DATA/odd"
    return pytest.mark.skipif(generator not in SCRIPTS, reason=reason)


def make_all(folder):
    """What the generators make, each of them run once."""
    scripts = [str(script) for script in SCRIPTS.values() if _can_run(script)]
    run_all = "import runpy, sys\nfor script in sys.argv[1:]: runpy.run_path(script)"
    paths = {"OUT": str(folder), "PYTHONPATH": str(FOLDER), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run([sys.executable, "-c", run_all, *scripts], env=os.environ | paths,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def _can_run(script):
    return HAS_ASTROPY or "astropy" not in script.read_text()


# From memory: where h5py and the module share one HDF5 (Debian's), it refuses to open a file a second
# time with other locks.
def hdf5(path, name):
    with h5py.File(io.BytesIO(path.read_bytes()), "r") as file:
        return file[name][()]


def counts_of(snapshot):
    return {name: len(kind) for name, kind in snapshot.types.items()}


def has_note(source, *words):
    return any(all(word in note for word in words) for note in source.notes)


def assert_reads(kind, **expected):
    for name, wanted in expected.items():
        values = np.asarray(wanted, float)
        nearly_zero = 1e-6 * np.abs(values).max() if name == "position" else 0
        np.testing.assert_allclose(kind[name], values, rtol=1e-6, atol=nearly_zero, err_msg=name)


def assert_units(kind, **expected):
    assert {name: kind.fields[name] for name in expected} == expected


def assert_reads_group(kind, path, group, names):
    assert_reads(kind, **{ours: hdf5(path, f"{group}/{theirs}") for ours, theirs in names.items()})


def column(path, center, width, **options):
    return splotchcl.column(
        path, center=center, width=width, size=(32, 32), tolerance=1e-5, **options
    )


def total_of(drawn):
    return drawn.values.sum(dtype=float) * drawn.pixel**2


def mass_in_map(path, center, width, **options):
    """Of all particles, where the map is wide enough."""
    return pytest.approx(total_of(column(path, center, width, **options)), rel=1e-4)


def periodic_map(x, mass, h, box, center, width, pixels):
    """The surface density of Gaussians with all images that are near, one axis at a time."""
    edges = np.linspace(-width / 2, width / 2, pixels + 1)
    erf = np.vectorize(math.erf)

    def shares(axis):
        shifts = (x[:, axis] - center[axis])[:, None] + box * np.arange(-2, 3)
        places = (edges - shifts[..., None]) / (WIDTH_OF_KERNEL * h)
        return 0.5 * np.diff(erf(places)).sum(axis=1)

    return mass * shares(1).T @ shares(0) / (width / pixels) ** 2


def assert_draws_alone(path, condition, mask, h):
    """The condition selects the particles of the mask: those of mass 1, in a box of 100."""
    x = hdf5(path, "PartType0/Coordinates").astype(float)[mask]
    expected = periodic_map(x, 1.0, h, 100.0, (50, 50, 50), 80, 32)
    drawn = column(path, (50, 50, 50), 80, where=condition)
    np.testing.assert_allclose(drawn.values, expected, rtol=1e-3, atol=1e-4 * expected.mean(),
                               err_msg=condition)


def run(*arguments):
    words = [os.environ["SPLOTCHCL_PROGRAM"], *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def refusal_of(*arguments):
    """What the program says where it must not succeed."""
    done = run(*arguments)
    assert done.returncode in (1, 2) and done.stdout == ""
    return done.stderr
