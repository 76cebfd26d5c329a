"""Objects of other packages are taken whole: what they hold is what the file holds."""

from pathlib import Path

import numpy as np
import pytest

import splotchcl
from splotchcl import Particles, Snapshot, UsageError

@pytest.fixture
def gadget(real_file) -> Path:
    return real_file("lcdm/fmt2_snapshot_006")


def sorted_values(values):
    return np.sort(np.asarray(values), axis=0)


# Up to single precision of the largest: units and doubles are made floats in other orders.
def assert_same(taken, read, field):
    a, b = sorted_values(taken[field]), sorted_values(read[field])
    assert np.abs(a - b).max() <= 2**-23 * np.abs(b).max()


def assert_all_of_the_file(particles, path):
    file = Snapshot(path)
    assert set(particles.types) == set(file.types)
    for name, kind in particles.types.items():
        for field in ("position", "mass"):
            assert_same(kind, file[name], field)
    assert_same(particles["gas"], file["gas"], "smoothing_length")
    assert particles.box_size == pytest.approx(file.box_size, rel=1e-6)


def test_a_pynbody_snapshot(gadget):
    pynbody = pytest.importorskip("pynbody")
    particles = Particles.of(pynbody.load(str(gadget)))
    assert_all_of_the_file(particles, gadget)
    assert particles.units["length"] == "Mpc a h**-1"


def test_a_part_of_a_pynbody_snapshot(gadget):
    pynbody = pytest.importorskip("pynbody")
    gas = pynbody.load(str(gadget)).gas
    particles = Particles.of(gas[gas["rho"] > np.median(gas["rho"])], fields=["vel"])
    assert set(particles.types) == {"gas"}
    assert 0 < len(particles["gas"]) < len(gas)
    assert particles["gas"]["vel"].shape == (len(particles["gas"]), 3)


def test_smoothing_lengths_that_pynbody_finds_are_half_of_the_kernel():
    pynbody = pytest.importorskip("pynbody")
    snapshot = pynbody.new(gas=100)
    snapshot["pos"] = np.random.default_rng(1).random((100, 3))
    snapshot["mass"], snapshot["smooth"] = np.ones(100), np.full(100, 0.25)
    particles = Particles.of(snapshot)
    assert np.all(particles["gas"]["smoothing_length"] == 0.5)


def test_a_swiftsimio_dataset(real_file):
    swiftsimio = pytest.importorskip("swiftsimio")
    path = real_file("swift/swift_lcdm_0000.hdf5")
    particles = Particles.of(swiftsimio.load(str(path)))
    assert_all_of_the_file(particles, path)
    assert particles.units["length"] == "Mpc (comoving)"


def test_a_yt_dataset(real_file):
    yt = pytest.importorskip("yt")
    path = real_file("lcdm/fmt3_snapshot_006.hdf5")
    yt.set_log_level(50)
    assert_all_of_the_file(Particles.of(yt.load(str(path))), path)


def test_a_sphere_of_yt(real_file):
    yt = pytest.importorskip("yt")
    yt.set_log_level(50)
    dataset = yt.load(str(real_file("lcdm/fmt3_snapshot_006.hdf5")))
    sphere = dataset.sphere("c", (0.2, "unitary"))
    gas = Particles.of(sphere)["gas"]
    center = np.asarray(dataset.domain_center.in_units("code_length"))
    radius = np.linalg.norm(gas["position"] - center, axis=1)
    assert 0 < len(gas) < len(Snapshot(real_file("lcdm/fmt3_snapshot_006.hdf5"))["gas"])
    # yt takes a particle whose kernel reaches in.
    assert np.all(radius - gas["smoothing_length"] < 0.2 * dataset.domain_width[0].value)


def test_a_map_of_yt_is_that_of_its_file(renderer, real_file):
    yt = pytest.importorskip("yt")
    yt.set_log_level(50)
    path = real_file("lcdm/fmt3_snapshot_006.hdf5")
    says = {"map.length_unit": "a kpc/h", "map.mass_unit": "1e10 Msun/h"}
    shown = {"types": "gas", "size": (16, 16), "unit": "Msun/kpc^2"}
    taken = splotchcl.column(Particles.of(yt.load(str(path))), **shown)
    read = splotchcl.column(path, **shown, settings=says)
    assert taken.extent == pytest.approx(read.extent, rel=1e-4)
    assert taken.values == pytest.approx(read.values, rel=1e-3)


def test_an_object_is_drawn_as_its_file(renderer, gadget):
    pynbody = pytest.importorskip("pynbody")
    particles = Particles.of(pynbody.load(str(gadget)))
    scene = splotchcl.suggest(particles, size=(64, 64))
    taken = renderer.render(scene, particles).linear
    assert taken.any()
    assert np.array_equal(taken, renderer.render(scene, Snapshot(gadget)).linear)


def test_a_field_that_one_type_has_is_taken_of_it(gadget):
    pynbody = pytest.importorskip("pynbody")
    particles = Particles.of(pynbody.load(str(gadget)), fields=["u"])
    assert "internal_energy" in particles["gas"].fields  # what u means
    assert "internal_energy" not in particles["halo"].fields


def test_a_field_that_an_object_does_not_have_is_refused(gadget):
    pynbody = pytest.importorskip("pynbody")
    with pytest.raises(UsageError, match="'wings': no type"):
        Particles.of(pynbody.load(str(gadget)), fields=["wings"])


@pytest.mark.parametrize("obj", [None, 3, np.ones((3, 3)), {"position": 1}])
def test_another_object_is_refused(obj):
    with pytest.raises(UsageError, match="expected a snapshot of pynbody"):
        Particles.of(obj)
