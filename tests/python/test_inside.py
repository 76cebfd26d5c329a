"""Functions of other packages, drawn by splotchcl: beside their own."""

import numpy as np
import pytest

import splotchcl
from splotchcl import UsageError


@pytest.fixture(autouse=True)
def needs_a_device(renderer):
    pass


def smooth(image, pixels=4):
    """Means of squares: kernels of two shapes differ below them."""
    image = np.asarray(image, float)
    height, width = (side // pixels * pixels for side in image.shape)
    blocks = image[:height, :width].reshape(height // pixels, pixels, width // pixels, pixels)
    return blocks.mean(axis=(1, 3))


def difference(a, b):
    a, b = smooth(a), smooth(b)
    return np.linalg.norm(a - b) / np.linalg.norm(b)


@pytest.fixture
def swift(real_file):
    swiftsimio = pytest.importorskip("swiftsimio")
    return swiftsimio.load(str(real_file("swift/swift_lcdm_0000.hdf5")))


def both(name):
    from splotchcl import swiftsimio as ours
    from swiftsimio import visualisation as theirs

    return getattr(ours, name), getattr(theirs, name)


def test_a_projection_of_swiftsimio(swift):
    ours, theirs = both("project_gas")
    a, b = ours(swift, 64), theirs(swift, 64)
    assert type(a) is type(b) and a.shape == b.shape
    assert a.units.dimensions == b.units.dimensions and a.comoving == b.comoving
    assert float((a / b.units).sum()) == pytest.approx(float((b / b.units).sum()), rel=1e-3)
    assert difference(a.to_value(b.units), b.to_value(b.units)) < 0.02


def test_a_region_that_is_not_square(swift):
    ours, theirs = both("project_gas")
    side = swift.metadata.boxsize[0]
    from swiftsimio.objects import cosmo_array

    region = cosmo_array([0.1 * side, 0.9 * side, 0.25 * side, 0.65 * side])
    a, b = ours(swift, 64, region=region), theirs(swift, 64, region=region)
    assert a.shape == b.shape == (64, 32)
    # swiftsimio 12.4 divides by the area of the region where it multiplied by that of a square.
    assert difference(2 * a.to_value(b.units), b.to_value(b.units)) < 0.02
    square = ours(swift, 80)
    assert np.allclose(a.to_value(square.units)[0:64, 0:32],
                       square.to_value(a.units)[8:72, 20:52], rtol=5e-3)  # fmt: skip


def test_physical_fields_give_physical_maps(swift):
    ours, theirs = both("project_pixel_grid")
    swift.gas.masses.convert_to_physical()
    swift.gas.coordinates.convert_to_physical()
    swift.gas.smoothing_lengths.convert_to_physical()
    a, b = ours(swift.gas, 32), theirs(swift.gas, 32)
    assert a.comoving is False and b.comoving is False
    assert difference(a.to_value(b.units), b.to_value(b.units)) < 0.02


def test_a_mask_and_a_rotation(swift):
    ours, theirs = both("project_gas")
    turn = np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]])
    chosen = np.arange(len(swift.gas.masses)) % 2 == 0
    what = {"mask": chosen, "rotation_matrix": turn, "periodic": False,
            "rotation_center": swift.metadata.boxsize / 2}  # fmt: skip
    a, b = ours(swift, 32, **what), theirs(swift, 32, **what)
    assert difference(a.to_value(b.units), b.to_value(b.units)) < 0.03


def test_numbers_of_particles(swift):
    ours, theirs = both("project_gas")
    a, b = ours(swift, 32, project=None), theirs(swift, 32, project=None)
    assert a.shape == b.shape
    assert np.asarray(a).sum() == pytest.approx(np.asarray(b, float).sum(), rel=2e-3)


def test_a_slice_of_swiftsimio(swift):
    ours, theirs = both("slice_gas")
    height = 0.4 * swift.metadata.boxsize[2]
    a, b = ours(swift, 64, z_slice=height), theirs(swift, 64, z_slice=height)
    assert a.units.dimensions == b.units.dimensions and a.comoving == b.comoving
    assert np.mean(a.to_value(b.units)) == pytest.approx(np.mean(b.to_value(b.units)), rel=0.05)
    assert difference(a.to_value(b.units), b.to_value(b.units)) < 0.15


def test_a_volume_of_swiftsimio(swift):
    from splotchcl import swiftsimio as ours
    from swiftsimio.visualisation import volume_render as theirs

    a, b = ours.render_gas(swift, 32), theirs.render_gas(swift, 32)
    assert type(a) is type(b) and a.shape == b.shape == (32, 32, 32)
    assert a.units.dimensions == b.units.dimensions and a.comoving == b.comoving
    a, b = (np.asarray(cube.to_value(b.units), float) for cube in (a, b))
    assert a.sum() == pytest.approx(b.sum(), rel=1e-2)
    coarse = [cube.reshape(8, 4, 8, 4, 8, 4).mean(axis=(1, 3, 5)) for cube in (a, b)]
    assert np.linalg.norm(coarse[0] - coarse[1]) < 0.1 * np.linalg.norm(coarse[1])


def test_a_volume_that_is_no_cube_is_refused(swift):
    from splotchcl.swiftsimio import render_gas
    from swiftsimio.objects import cosmo_array

    side = swift.metadata.boxsize[0]
    with pytest.raises(ValueError, match="cubic"):
        render_gas(swift, 8, region=cosmo_array([0 * side, side, 0 * side, side, 0 * side, 0.5 * side]))


def test_a_slice_without_kernels_is_refused(swift):
    ours, _ = both("slice_gas")
    with pytest.raises(UsageError, match="nearest_neighbours"):
        ours(swift, 16, backend="nearest_neighbours")


@pytest.fixture
def pynbody():
    package = pytest.importorskip("pynbody")
    pytest.importorskip("matplotlib").use("Agg")
    return package


@pytest.fixture
def gadget(pynbody, real_file):
    snapshot = pynbody.load(str(real_file("lcdm/fmt2_snapshot_006")))
    side = snapshot.properties["boxsize"].in_units(
        snapshot["pos"].units, **snapshot.conversion_context()
    )
    snapshot["pos"] -= side / 2
    return snapshot.gas


def images(pynbody, gas, **what):
    options = {"width": "20 Mpc a h^-1", "resolution": 64, "noplot": True, **what}
    theirs = pynbody.plot.sph.image(gas, **options)
    with splotchcl.inside(pynbody):
        ours = pynbody.plot.sph.image(gas, **options)
    return ours, theirs


def test_a_projection_of_pynbody(pynbody, gadget):
    ours, theirs = images(pynbody, gadget, units="Msol kpc^-2")
    assert ours.units == theirs.units
    assert difference(ours, theirs) < 0.03
    assert np.abs(np.asarray(ours) - np.asarray(theirs)).max() > 0, "the kernels differ"


def test_a_slice_of_pynbody(pynbody, gadget):
    ours, theirs = images(pynbody, gadget, units="Msol kpc^-3")
    assert np.mean(ours) == pytest.approx(np.mean(theirs), rel=0.05)
    assert difference(ours, theirs) < 0.15


def test_a_weighted_mean_of_pynbody(pynbody, gadget):
    ours, theirs = images(pynbody, gadget, qty="vz", weight="rho", fill_nan=False)
    known = np.isfinite(ours) & np.isfinite(theirs)
    assert difference(np.where(known, ours, 0), np.where(known, theirs, 0)) < 0.1


def test_pynbody_draws_as_before_when_the_block_ends(pynbody, gadget):
    _, before = images(pynbody, gadget)
    with pytest.raises(RuntimeError), splotchcl.inside(pynbody):
        raise RuntimeError
    after = pynbody.plot.sph.image(gadget, width="20 Mpc a h^-1", resolution=64, noplot=True)
    assert np.array_equal(np.asarray(before), np.asarray(after))


def test_another_package_is_refused():
    with pytest.raises(UsageError, match="numpy"), splotchcl.inside(np):
        pass
