"""Position-position-velocity cubes."""

import math

import numpy as np
import pytest

import splotchcl
from conftest import make_arrays
from splotchcl import Particles, UsageError


@pytest.fixture(autouse=True)
def needs_a_device(renderer):
    pass


def moving(count=400):
    arrays = make_arrays(count)
    random = np.random.default_rng(5)
    arrays["velocity"] = random.normal(0, 100, (count, 3)).astype(np.float32)
    return arrays


PLACE = {"center": [5.0, 5.0, 5.0], "width": 8.0, "size": (24, 20)}
SAYS = {"map.velocity_unit": "km/s"}


def cube_of(arrays, **what):
    what = {"settings": SAYS, "channels": 16, **PLACE, **what}
    return splotchcl.column(Particles().gas(**arrays), types="gas", **what)


@pytest.mark.parametrize("line_mass", [None, 1])
def test_the_sum_over_velocity_is_the_column(line_mass):
    arrays = moving()
    cube = cube_of(arrays, line_mass=line_mass, tolerance=1e-5)
    assert cube.values.shape == (16, 20, 24)
    column = splotchcl.column(Particles().gas(**arrays), types="gas", tolerance=1e-5, **PLACE).values
    sums = cube.values.sum(axis=0, dtype=float)
    assert sums.sum() == pytest.approx(column.sum(dtype=float), rel=1e-6)
    assert np.abs(sums - column).max() <= 1e-6 * column.max()


def test_a_channel_holds_the_particles_of_its_velocities():
    arrays = moving()
    cube = cube_of(arrays, velocity_range=(-300, 300), channels=6, view="yz")
    # From the side, x grows towards who looks.
    away = -arrays["velocity"][:, 0].astype(float)
    for channel, middle in enumerate(cube.velocities):
        inside = (away >= middle - 50) & (away < middle + 50)
        chosen = {name: values[inside] for name, values in arrays.items()}
        alone = splotchcl.column(Particles().gas(**chosen), types="gas", view="yz", **PLACE).values
        assert cube.values[channel] == pytest.approx(alone, rel=3e-3, abs=1e-5 * float(alone.max()))


def test_lines_are_as_wide_as_thermal_motion():
    arrays = moving(1)
    arrays["position"][:] = 5
    arrays["velocity"][:] = 30
    arrays["temperature"][:] = 1e6
    cube = cube_of(arrays, line_mass=1, channels=40, velocity_range=(-330, 270))
    width = math.sqrt(2 * 1.380649e-16 * 1e6 / 1.67262192369e-24) / 1e5
    spectrum = cube.values.sum(axis=(1, 2), dtype=float)
    edges = -330 + 15.0 * np.arange(41)
    # Seen from above z points to who looks: -30.
    lines = np.diff([math.erf((edge + 30) / width) for edge in edges]) / 2
    assert spectrum / spectrum.sum() == pytest.approx(lines / lines.sum(), abs=1e-5)


def test_velocities_are_told_in_kilometers_per_second():
    cube = cube_of(moving(), settings={"map.velocity_unit": "1e-3 km/s"}, velocity_range=(-100, 300), channels=4)
    assert cube.velocity_unit == "km/s"
    assert cube.velocities == pytest.approx([-0.05, 0.05, 0.15, 0.25])


def test_a_map_has_no_velocities(arrays):
    drawn = splotchcl.column(Particles().gas(**arrays), types="gas", **PLACE)
    assert drawn.velocities is None and drawn.velocity_unit is None


def test_velocities_outside_of_the_range_are_noted():
    notes = cube_of(moving(), velocity_range=(0, 100)).notes
    assert any("outside" in note for note in notes)


def test_astropy_reads_a_cube(tmp_path):
    fits = pytest.importorskip("astropy.io.fits")
    wcs = pytest.importorskip("astropy.wcs")
    cube = cube_of(moving(), velocity_range=(-300, 300), channels=6)
    cube.save(tmp_path / "cube.fits")
    hdu = fits.open(tmp_path / "cube.fits")[0]
    assert np.array_equal(hdu.data, cube.values)
    axes = wcs.WCS(hdu.header)
    speed = axes.pixel_to_world_values(0, 0, np.arange(6))[2]
    assert speed == pytest.approx(1e3 * cube.velocities), "in m/s"


def test_files_of_numbers_hold_a_cube(tmp_path):
    h5py = pytest.importorskip("h5py")
    cube = cube_of(moving())
    cube.save(tmp_path / "cube.npy")
    cube.save(tmp_path / "cube.hdf5")
    assert np.array_equal(np.load(tmp_path / "cube.npy"), cube.values)
    stored = h5py.File(tmp_path / "cube.hdf5")["map"]
    assert np.array_equal(stored[:], cube.values)
    assert stored.attrs["velocity_first"] == pytest.approx(cube.velocities[0])


def test_a_cube_is_no_figure(tmp_path):
    with pytest.raises(UsageError, match="channels"):
        cube_of(moving()).save(tmp_path / "cube.png")


def test_the_command_line_makes_a_cube(program, universe, tmp_path):
    program("map", universe, "--types", "gas", "--size", "16x16", "--channels", 5, "--velocity-range=-500,500",
            "-o", tmp_path / "cube.npy")  # fmt: skip
    assert np.load(tmp_path / "cube.npy").shape == (5, 16, 16)


@pytest.mark.parametrize("wrong", [
    {"field": "temperature"}, {"slice": True}, {"noise": True}, {"velocity_range": (3, 1)},
    {"channels": 0}, {"channels": None, "velocity_range": (0, 1)}, {"channels": None, "line_mass": 1},
    {"line_mass": 1, "settings": {}},
])  # fmt: skip
def test_wrong_cubes_are_refused(wrong):
    with pytest.raises(UsageError, match="map|channels"):
        cube_of(moving(), **wrong)
