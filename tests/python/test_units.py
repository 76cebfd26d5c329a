"""Arrays keep their units, and units that do not agree are refused: with the packages themselves,
where they are installed, and with an array that has a unit as theirs have it."""

import numpy as np
import pytest

import splotchcl
from conftest import in_unit
from splotchcl import Particles, UsageError


def in_unyt(values, unit):
    return pytest.importorskip("unyt").unyt_array(values, unit)


def in_astropy(values, unit):
    units = pytest.importorskip("astropy.units")
    return units.Quantity(values, unit)


def in_pynbody(values, unit):
    return pytest.importorskip("pynbody.array").SimArray(values, unit)


PACKAGES = [in_unyt, in_astropy, in_pynbody]
KINDS = [in_unit, *PACKAGES]


@pytest.mark.parametrize("kind", KINDS)
def test_a_unit_is_kept_and_the_values_are_the_same(arrays, kind):
    particles = Particles().gas(position=kind(arrays["position"], "kpc"))
    assert particles.units == {"length": "kpc"}
    assert np.array_equal(particles["gas"]["position"], arrays["position"])


@pytest.mark.parametrize("kind", KINDS)
def test_floats_with_a_unit_are_borrowed(arrays, kind):
    given = kind(arrays["position"], "kpc")
    particles = Particles().gas(position=given)
    assert particles.notes == []
    assert np.shares_memory(particles["gas"]["position"], np.asarray(given))


@pytest.mark.parametrize("kind", KINDS)
def test_mixed_units_of_length_are_refused(arrays, kind):
    particles = Particles().gas(position=kind(arrays["position"], "kpc"))
    with pytest.raises(UsageError, match="the unit Mpc, expected kpc"):
        particles.gas(smoothing_length=kind(arrays["smoothing_length"], "Mpc"))
    with pytest.raises(UsageError, match="the unit Mpc, expected kpc"):
        particles.stars(position=kind(arrays["position"], "Mpc"))


@pytest.mark.parametrize("kind", KINDS)
def test_one_field_has_one_unit_over_all_types(arrays, kind):
    particles = Particles().gas(position=arrays["position"], Masses=kind(arrays["mass"], "g"))
    with pytest.raises(UsageError, match="field mass: the unit kg, expected g"):
        particles.stars(position=arrays["position"], mass=kind(arrays["mass"], "kg"))


@pytest.mark.parametrize("kind", PACKAGES)
def test_what_has_no_dimension_has_no_unit(arrays, kind):
    ratio = kind(arrays["mass"], "kpc") / kind(arrays["mass"], "kpc")
    particles = Particles().gas(position=arrays["position"], ratio=ratio)
    assert particles.units == {}


def test_comoving_and_physical_lengths_are_not_mixed(arrays):
    objects = pytest.importorskip("swiftsimio.objects")

    def length(values, comoving):
        return objects.cosmo_array(
            values, "Mpc", comoving=comoving, scale_factor=0.5, scale_exponent=1
        )

    particles = Particles().gas(position=length(arrays["position"], True))
    with pytest.raises(UsageError, match=r"physical.*comoving"):
        particles.gas(smoothing_length=length(arrays["smoothing_length"], False))


@pytest.mark.parametrize("kind", KINDS)
def test_a_refused_array_leaves_no_unit(arrays, kind):
    particles = Particles()
    with pytest.raises(UsageError):
        particles.gas(position=kind(arrays["position"].T, "Mpc"))
    assert particles.units == {}
    particles.gas(position=kind(arrays["position"], "kpc"))
    assert particles.units == {"length": "kpc"}


@pytest.mark.parametrize("kind", KINDS)
def test_a_number_keeps_its_unit(arrays, kind):
    particles = Particles().gas(position=arrays["position"], mass=kind(arrays["mass"], "g"))
    with pytest.raises(UsageError, match="the unit kg, expected g"):
        particles.stars(position=arrays["position"], mass=kind(2.0, "kg"))
    particles.stars(position=arrays["position"], mass=kind(2.0, "g"))
    assert particles.units == {"mass": "g"}


@pytest.mark.parametrize("kind", PACKAGES)
def test_the_unit_of_a_density_is_that_of_its_map(renderer, arrays, kind):
    unit = "Msun * kpc**-3" if kind is in_unyt else "Msun kpc**-3"
    if kind is in_pynbody:
        unit = "Msol kpc**-3"
    density = kind(np.full(500, 1000, np.float32), unit)
    particles = Particles().gas(
        position=kind(arrays["position"], "kpc"), mass=arrays["mass"], density=density
    )
    drawn = splotchcl.column(particles, "density", size=(8, 8), unit="g/cm^3")
    assert np.nanmax(drawn.values) == pytest.approx(6.76790e-29, rel=1e-4)


@pytest.mark.parametrize("kind", KINDS)
def test_lengths_with_units_are_converted(renderer, arrays, kind):
    particles = Particles(box_size=kind(10e3, "pc"))
    particles.gas(position=kind(arrays["position"], "kpc"), mass=arrays["mass"])
    assert particles.box_size == pytest.approx(10)
    settings = {"size": (8, 8), "depth": kind(2000.0, "pc"), "width": kind(4000.0, "pc")}
    drawn = splotchcl.column(particles, center=kind([5000.0, 5000.0, 5000.0], "pc"), **settings)
    plain = splotchcl.column(particles, size=(8, 8), center=[5, 5, 5], depth=2, width=4)
    assert drawn.extent == pytest.approx(plain.extent)
    assert drawn.values == pytest.approx(plain.values, rel=1e-4)


@pytest.mark.parametrize(
    ("kind", "unit", "in_pc"),
    [
        (in_astropy, "lyr", 0.306601),
        (in_astropy, "1e3 pc", 1000),
        (in_unyt, "ly", 0.306601),
        (in_unyt, "1e3*pc", 1000),
        (in_pynbody, "3.085678e18 cm", 1),
    ],
)
def test_a_unit_that_maps_do_not_know_is_converted_by_its_package(
    renderer, arrays, kind, unit, in_pc
):
    mass = np.ones(500, np.float32)
    given = Particles().gas(position=kind(arrays["position"], unit), mass=kind(mass, "g"))
    plain = Particles().gas(position=arrays["position"], mass=mass)
    drawn = splotchcl.column(given, size=(8, 8), unit="g/pc^2")
    expected = splotchcl.column(plain, size=(8, 8)).values / in_pc**2
    assert drawn.values == pytest.approx(expected, rel=1e-4)  # packages differ in their constants


def test_units_of_pynbody_keep_their_digits(arrays):
    particles = Particles().gas(position=in_pynbody(arrays["position"], "3.085678e+21 cm"))
    assert particles.units == {"length": "3.085678e21 cm"}


@pytest.mark.parametrize("has_unit", [False, True])
def test_values_that_astropy_masks_are_refused(arrays, has_unit):
    masked = pytest.importorskip("astropy.utils.masked").Masked
    mass = in_astropy(arrays["mass"], "g") if has_unit else arrays["mass"]
    particles = Particles().gas(position=arrays["position"])
    with pytest.raises(UsageError, match="field mass: 7 values are masked"):
        particles.gas(mass=masked(mass, mask=np.arange(500) < 7))
    particles.gas(mass=masked(mass, mask=np.zeros(500, bool)))
    assert np.array_equal(particles["gas"]["mass"], arrays["mass"])


def comoving_gas(scale_factor, comoving, box):
    objects = pytest.importorskip("swiftsimio.objects")
    rng = np.random.default_rng(5)

    def of(values, unit, power):
        made = objects.cosmo_array(
            values, unit, comoving=True, scale_factor=scale_factor, scale_exponent=power
        )
        return made if comoving else made.to_physical()

    arrays = {
        "position": of(rng.random((2000, 3)) * 10, "Mpc", 1),
        "smoothing_length": of(np.full(2000, 1.5), "Mpc", 1),
        "mass": of(np.full(2000, 1e10), "Msun", 0),
    }
    side = objects.cosmo_quantity(
        10.0, "Mpc", comoving=True, scale_factor=scale_factor, scale_exponent=1
    )
    return Particles(box_size=side if box else None).gas(**arrays)


@pytest.mark.parametrize("scale_factor", [0.98, 1 / 3])
@pytest.mark.parametrize("box", [True, False])
def test_comoving_and_physical_arrays_make_one_map(renderer, scale_factor, box):
    settings = {"size": (16, 16), "unit": "Msun/kpc^2", "tolerance": 1e-5}
    comoving = splotchcl.column(comoving_gas(scale_factor, True, box), **settings)
    physical = splotchcl.column(comoving_gas(scale_factor, False, box), **settings)
    assert physical.values == pytest.approx(comoving.values, rel=1e-3)
    assert physical.extent == pytest.approx(comoving.extent, rel=1e-6, abs=1e-6)
    if box:
        area = (10e3 * scale_factor) ** 2
        assert physical.values.mean(dtype=float) == pytest.approx(2000e10 / area, rel=1e-4)


def test_a_box_follows_physical_positions():
    particles = comoving_gas(1 / 3, False, True)
    assert particles.box_size == pytest.approx(10 / 3)
    assert comoving_gas(1 / 3, True, True).box_size == pytest.approx(10)


def test_a_box_that_may_be_comoving_or_not_is_refused_beside_comoving_positions():
    unyt = pytest.importorskip("unyt")
    objects = pytest.importorskip("swiftsimio.objects")
    x = objects.cosmo_array(
        np.zeros((4, 3)), "Mpc", comoving=True, scale_factor=0.5, scale_exponent=1
    )
    with pytest.raises(UsageError, match="does not say whether it is comoving"):
        Particles(box_size=unyt.unyt_quantity(10, "Mpc")).gas(position=x)


def test_arrays_of_two_scale_factors_are_refused():
    objects = pytest.importorskip("swiftsimio.objects")

    def at(scale_factor):
        return objects.cosmo_array(
            np.zeros((4, 3)), "Mpc", comoving=True, scale_factor=scale_factor, scale_exponent=1
        )

    particles = Particles().gas(position=at(0.5))
    with pytest.raises(UsageError, match="at the scale factor 0.25, expected 0.5"):
        particles.stars(position=at(0.25))
    with pytest.raises(UsageError, match="found both, expected one"):
        Particles(scale_factor=0.5, redshift=1)


def test_a_box_may_have_three_sides():
    particles = Particles(box_size=(4, 1, 2)).gas(position=np.zeros((4, 3)))
    assert particles.box_size == (4, 1, 2)
    with pytest.raises(UsageError, match="expected a number, or three"):
        Particles(box_size=(4, 1))
