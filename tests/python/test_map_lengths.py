"""Lengths with units in what is asked for and in what is written."""

import numpy as np
import pytest

import splotchcl
from conftest import make_arrays
from splotchcl import Particles, UsageError


@pytest.fixture(autouse=True)
def needs_a_device(renderer):
    pass


@pytest.fixture
def header(program, universe, tmp_path):
    fits = pytest.importorskip("astropy.io.fits")

    def of(*options, name="map.fits"):
        program("map", universe, "--types", "gas", "--size", "32x32", *options, "-o", tmp_path / name)
        return fits.open(tmp_path / name)[0]

    return of


def test_a_width_in_megaparsecs_is_that_of_the_file(header):
    hdu = header("--units", "gadget", "--width", "20Mpc", "--center", "30,30,30Mpc")
    assert hdu.header["CUNIT1"] == "Mpc"
    assert hdu.header["CDELT1"] * 32 == pytest.approx(20)
    assert (hdu.header["CRVAL1"], hdu.header["CRVAL2"]) == pytest.approx((30, 30))


def test_a_width_in_another_unit_gives_axes_in_it(header):
    hdu = header("--units", "gadget", "--width", "20000kpc")
    assert hdu.header["CUNIT1"] == "kpc"
    assert hdu.header["CDELT1"] * 32 == pytest.approx(20000)


def test_axes_are_in_multiples_that_people_write(header):
    assert header("--units", "gadget").header["CUNIT1"] == "Mpc"
    assert header("--units", "gadget", "--width", "100").header["CUNIT1"] == "kpc"


def test_coordinates_can_be_typed_back(header):
    first = header("--units", "gadget", "--width", "20Mpc", "--center", "densest")
    place = header(
        "--units", "gadget", "--width", "20Mpc", "--view", "xz", "--center", "densest"
    ).header
    x, y, z = first.header["CRVAL1"], first.header["CRVAL2"], place["CRVAL2"]
    again = header("--units", "gadget", "--width", "20Mpc", "--center", f"{x!r},{y!r},{z!r}Mpc")
    assert np.allclose(again.data, first.data, rtol=2e-3)


@pytest.mark.parametrize("unit", ["Msun/pc^2", "g/cm^2", "40 g/cm^2", "1e10 Msun/kpc^2"])
def test_astropy_reads_the_unit(header, unit):
    units = pytest.importorskip("astropy.units")
    options = ("--units", "gadget", "--width", "30Mpc", "--center", "35,35,35Mpc")
    plain, asked = header(*options, "--unit", "Msun/kpc^2"), header(*options, "--unit", unit)
    ratio = units.Unit(asked.header["BUNIT"], format="fits").to("solMass/kpc**2")
    assert asked.data * ratio == pytest.approx(plain.data, rel=1e-5)


def test_fits_files_tell_the_time(header):
    head = header("--units", "gadget").header
    assert head["REDSHIFT"] == 0 and head["TIME"] == 1


def test_hdf5_files_tell_the_time(program, universe, tmp_path):
    h5py = pytest.importorskip("h5py")
    program("map", universe, "--size", "16x16", "-o", tmp_path / "map.hdf5")
    attributes = h5py.File(tmp_path / "map.hdf5")["map"].attrs
    assert attributes["redshift"] == 0 and attributes["time"] == 1


def test_lengths_are_texts_in_python_too(universe):
    says = {"map.length_unit": "a kpc/h"}
    drawn = splotchcl.column(
        universe, types="gas", size=(16, 16), settings=says, width="20 Mpc",
        center=["30 Mpc", "30Mpc", "30000 kpc"],
    )  # fmt: skip
    assert drawn.length_unit == "Mpc"
    assert drawn.extent == pytest.approx((20, 40, 20, 40))


@pytest.mark.parametrize("width", ["4 Msun", "4 parsecs", "wide"])
def test_what_is_no_length_is_refused(universe, width):
    says = {"map.length_unit": "kpc"}
    with pytest.raises(UsageError, match="map.width"):
        splotchcl.column(universe, size=(16, 16), settings=says, width=width)


def test_lengths_need_a_unit_of_the_snapshot(universe):
    with pytest.raises(UsageError, match="map.length_unit"):
        splotchcl.column(universe, size=(16, 16), width="4 Mpc")


@pytest.mark.parametrize("what", [
    {"field": "temperature", "slice": True}, {"field": "temperature", "statistic": "integral"},
    {"field": "temperature", "weight": "volume"},
])  # fmt: skip
def test_volumes_in_cubic_centimeters_fit(what):
    plain = make_arrays(300)
    plain["density"] = np.full(300, 1e-3, np.float32)
    cgs = {**plain, "position": plain["position"] * np.float32(1e21),
           "smoothing_length": plain["smoothing_length"] * np.float32(1e21),
           "mass": plain["mass"] * np.float32(1e35),
           "density": plain["density"] * np.float32(1e-28)}  # fmt: skip
    small = splotchcl.column(Particles().gas(**plain), size=(16, 16), **what).values
    large = splotchcl.column(Particles().gas(**cgs), size=(16, 16), **what).values
    # An integral is that of the value times the volume, over an area.
    scale = 1e35 / 1e-28 / 1e42 if what.get("statistic") == "integral" else 1
    assert np.isfinite(small).sum() > 50
    assert large / scale == pytest.approx(small, rel=4e-3, nan_ok=True)
