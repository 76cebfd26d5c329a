"""Boxes, planes and units that maps must not be misled by."""

import numpy as np
import pytest
from odd import (
    GAMMA_OF_CUBIC_SPLINE,
    GAS,
    STARS,
    assert_reads,
    assert_reads_group,
    assert_units,
    column,
    has_note,
    hdf5,
    mass_in_map,
    of,
    periodic_map,
    run,
    total_of,
)
from splotchcl import Snapshot
import splotchcl

pytestmark = pytest.mark.usefixtures("program", "renderer")

CM_OF = {"AU": 1.495978707e13, "pc": 3.0856776e18, "kpc": 3.0856776e21, "Mpc": 3.0856776e24}


@of("a17_box_of_three_sides")
def test_a_box_of_three_sides_is_periodic(odd_files):
    path = odd_files / "a17_tube.hdf5"
    snapshot = Snapshot(path)
    assert snapshot.box_size == (4, 1, 1)
    assert snapshot.time == pytest.approx(0.1)
    assert_reads_group(snapshot["gas"], path, "PartType0", STARS | {"density": "Densities"})
    h = hdf5(path, "PartType0/SmoothingLengths") * GAMMA_OF_CUBIC_SPLINE
    assert_reads(snapshot["gas"], smoothing_length=h)
    # An even mass of 1 in four squares, of which the map about a corner has a quarter of each end.
    assert 1 / 4 == mass_in_map(path, (0, 0, 0), 1)
    # A square of the tube's length has its width four times.
    assert 4 == mass_in_map(path, (2, 0.5, 0.5), 4)


@of("a18_two_dimensions")
def test_matter_in_a_plane_is_read(odd_files):
    path = odd_files / "a18_flat.hdf5"
    snapshot = Snapshot(path)
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS | {"density": "Density"})
    assert snapshot["gas"]["position"][:, 2].max() == 0
    assert 1 == mass_in_map(path, (0.5, 0.5, 0), 1)
    table = np.genfromtxt(odd_files / "a18_flat.csv", delimiter=",", names=True)
    flat = Snapshot(odd_files / "a18_flat.csv")
    assert has_note(flat, "z is 0")
    x = np.column_stack([table["x"], table["y"], np.zeros(len(table))])
    assert_reads(flat["gas"], position=x, density=table["rho"], smoothing_length=table["h"])
    counted = column(odd_files / "a18_flat.csv", (0.5, 0.5, 0), 2, field="counts")
    assert counted.values.sum(dtype=float) == pytest.approx(len(table), rel=1e-4)


@of("a20_corner_map")
def test_a_map_about_a_corner_has_the_images(odd_files):
    path, center, width = odd_files / "a20_corner.hdf5", (2.8, 2.8, 2.8), 1.5
    assert Snapshot(path).box_size == 3
    done = run("map", path, "--center", "2.8,2.8,2.8", "--width", width, "--size", "32x32",
               "--tolerance", 1e-5, "-o", odd_files / "corner.npy")
    assert done.returncode == 0, done.stderr
    x = hdf5(path, "PartType0/Coordinates").astype(float)
    expected = periodic_map(x, 1.0, 0.5, 3.0, center, width, 32)
    drawn = np.load(odd_files / "corner.npy")
    np.testing.assert_allclose(drawn, expected, rtol=1e-3, atol=1e-4 * expected.mean())


@of("a21_cgs")
def test_numbers_of_cgs_are_no_infinities(odd_files):
    for name in ("disc", "cloud", "galaxy", "box"):
        path = odd_files / f"a21_{name}.txt"
        x, y, z, mass, h, density = np.loadtxt(path, unpack=True)
        gas = Snapshot(path)["gas"]
        position = np.column_stack([x, y, z])
        assert_reads(gas, position=position, mass=mass, smoothing_length=h, density=density)
        assert_units(gas, position="cm", mass="g", smoothing_length="cm", density="g/cm^3")
        reach = 2 * (np.abs(position).max() + 2 * h.max())
        drawn = column(path, (0, 0, 0), reach)
        assert total_of(drawn) * CM_OF[drawn.length_unit] ** 2 == pytest.approx(mass.sum(), rel=1e-4)
        assert_are_all(column(path, (0, 0, 0), reach / 4, field="density", slice=True), density[0])
        assert_are_all(column(path, (0, 0, 0), reach / 4, field="density", weight="volume"), density[0])
    path = odd_files / "a21b_disc.txt"
    energy = np.loadtxt(path, usecols=5)
    assert_reads(Snapshot(path)["gas"], internal_energy=energy)
    assert_are_all(column(path, (0, 0, 0), 1e15, field="internal_energy", slice=True), energy[0])


def assert_are_all(drawn, value):
    """Means of what is the same everywhere; not a number where there is no matter."""
    known = drawn.values[np.isfinite(drawn.values)]
    assert known.size > drawn.values.size / 2
    np.testing.assert_allclose(known, value, rtol=1e-4)


@of("a22_box_of_no_meaning")
def test_a_box_that_particles_leave_is_not_periodic(odd_files):
    path = odd_files / "a22_box_1.hdf5"
    x = hdf5(path, "PartType0/Coordinates")
    assert np.ptp(x, axis=0).max() > 50
    assert_reads_group(Snapshot(path)["gas"], path, "PartType0", GAS | {"density": "Density"})
    drawn = column(path, (0, 0, 0), 80)
    assert has_note(drawn, "the box of 1", "not used")
    assert total_of(drawn) == pytest.approx(len(x), rel=1e-4)
    left, right, low, high = splotchcl.column(path, size=(8, 8)).extent
    assert left <= x[:, 0].min() and right >= x[:, 0].max()
    assert low <= x[:, 1].min() and high >= x[:, 1].max()


@of("a27_initial_conditions")
def test_one_smoothing_length_for_all_is_kept_by_maps(odd_files):
    path = odd_files / "a27_ics.hdf5"
    assert_reads_group(Snapshot(path)["gas"], path, "PartType0", GAS | {"internal_energy": "InternalEnergy"})
    x = hdf5(path, "PartType0/Coordinates").astype(float)
    expected = periodic_map(x, 1.0, 12.0, 100.0, (50, 50, 50), 100.0, 32)
    drawn = column(path, (50, 50, 50), 100)
    assert total_of(drawn) == pytest.approx(len(x), rel=1e-4)
    np.testing.assert_allclose(drawn.values, expected, rtol=1e-3)
