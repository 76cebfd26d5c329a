"""Types of particles and fields as mappings have keys, and identifiers that are exact."""

import os
import shutil

import numpy as np
import pytest

import splotchcl
from conftest import make_arrays
from splotchcl import DataError, Particles, Snapshot, UsageError, suggest


def write_table(path, **columns):
    count = 100
    kinds = [("x", "f4"), ("y", "f4"), ("z", "f4")]
    table = np.zeros(count, kinds + [(name, v.dtype) for name, v in columns.items()])
    for name in "xyz":
        table[name] = np.random.default_rng(1).random(count)
    for name, values in columns.items():
        table[name] = values
    np.save(path, table)
    return path


def test_a_name_that_is_not_utf8_is_read_or_named(universe, tmp_path):
    name = os.fsdecode(os.path.join(os.fsencode(tmp_path), b"snapshot\xff"))
    with pytest.raises(DataError, match="snapshot\\udcff: no such file"):
        Snapshot(name)
    shutil.copy(universe, name)
    assert len(Snapshot(name)["gas"]["position"]) > 0
    with pytest.raises(UsageError, match="is not UTF-8"):
        suggest(name)


def test_identifiers_of_a_file_are_exact(tmp_path):
    ids = np.arange(100, dtype=np.uint64) + 2**63 + 1
    gas = Snapshot(write_table(tmp_path / "a.npy", id=ids))["gas"]
    assert gas["id"].dtype == np.uint64
    assert np.array_equal(gas["id"], ids)
    assert np.array_equal(gas["ID"], ids)


def test_haloes_are_exact_and_may_be_below_0(tmp_path):
    haloes = np.arange(100, dtype=np.int64) * 2**40 - 1
    gas = Snapshot(write_table(tmp_path / "a.npy", halo_id=haloes))["gas"]
    assert np.array_equal(gas["halo_id"], haloes)


def test_identifiers_that_are_no_whole_numbers_are_refused(tmp_path):
    gas = Snapshot(write_table(tmp_path / "a.npy", id=np.linspace(0, 1, 100)))["gas"]
    with pytest.raises(DataError, match="id"):
        gas["id"]


def test_a_file_without_identifiers_names_its_fields(tmp_path):
    gas = Snapshot(write_table(tmp_path / "a.npy", density=np.ones(100)))["gas"]
    with pytest.raises(UsageError, match="expected one of position, density"):
        gas["id"]


@pytest.mark.parametrize("first", [-5, 2**24, 2**60, 2**64 - 9])
def test_whole_numbers_of_arrays_are_exact(first):
    numbers = np.array(range(first, first + 9), np.int64 if first < 0 else np.uint64)
    particles = Particles().gas(**make_arrays(9), id=numbers[::-1], tracer=numbers)
    assert np.array_equal(particles["gas"]["id"], numbers[::-1].astype(np.uint64))
    for condition, count in ((f"tracer == {first + 4}", 1), (f"tracer > {first + 4}", 4)):
        drawn = splotchcl.column(particles, "counts", where=condition, center=(5, 5, 5), width=40)
        assert drawn.values.sum(dtype=float) == pytest.approx(count, rel=1e-3), condition


def test_a_part_of_a_snapshot_has_its_identifiers(tmp_path):
    ids = np.arange(100, dtype=np.int64) + 2**33
    path = write_table(tmp_path / "a.npy", id=ids)
    assert np.array_equal(Snapshot(path, read={"every": 10})["gas"]["id"], ids[::10])


def test_a_source_has_types_as_a_mapping_has_keys(universe):
    snapshot = Snapshot(universe)
    assert list(snapshot) == list(snapshot.keys()) == ["gas", "stars"]
    assert len(snapshot) == 2
    assert "stars" in snapshot and "halo" not in snapshot and 0 not in snapshot
    assert [len(particles) for particles in dict(snapshot).values()] == [
        len(snapshot["gas"]), len(snapshot["stars"])
    ]


def test_particles_without_any_are_true():
    assert Particles() and len(Particles()) == 0


def test_a_type_has_fields_as_a_mapping_has_keys(universe):
    gas = Snapshot(universe)["gas"]
    assert list(gas) == list(gas.keys()) == list(gas.fields)
    assert "density" in gas and "RHO" in gas
    assert "metallicity" not in gas and 0 not in gas


def test_a_type_has_what_can_be_derived(universe):
    gas = Snapshot(universe)["gas"]
    assert "temperature" in gas and "temperature" in gas.derived and "temperature" not in list(gas)
    assert gas["temperature"].shape == (len(gas),)


@pytest.mark.parametrize("layout", ["plain", "Phantom", "Gadget"])
def test_h5py_may_change_a_file_of_which_a_snapshot_is_kept(tmp_path, layout):
    h5py = pytest.importorskip("h5py")
    path = tmp_path / "a.hdf5"
    group = {"plain": "", "Phantom": "particles/", "Gadget": "PartType0/"}[layout]
    names = {"Gadget": ["Coordinates", "Masses", "SmoothingLength"]}.get(layout, ["xyz", "m", "h"])
    with h5py.File(path, "w") as file:
        for name, values in zip(names, [np.ones((5, 3)), np.ones(5), np.ones(5)]):
            file[group + name] = values
        if layout == "Gadget":
            file.create_group("Header").attrs["NumPart_ThisFile"] = [5, 0, 0, 0, 0, 0]
    snapshot = splotchcl.Snapshot(path)
    snapshot["gas"]["position"]
    with h5py.File(path, "r") as file:
        np.testing.assert_array_equal(snapshot["gas"]["mass"], file[group + names[1]])
    with h5py.File(path, "r+") as file:
        file[group + names[1]][:] = 2
    np.testing.assert_array_equal(splotchcl.Snapshot(path)["gas"]["mass"], 2)


def test_units_by_key_are_those_of_maps(tmp_path):
    x = np.random.default_rng(3).uniform(0, 1, (100, 3))
    np.savez(tmp_path / "a.npz", pos=x, mass=np.full(100, 2.0), hsml=np.full(100, 0.1))
    read = {"units": {"position": "kpc", "mass": "1e4 Msun"}}
    drawn = splotchcl.column(splotchcl.Snapshot(tmp_path / "a.npz", read=read), center=(0.5, 0.5, 0.5),
                             width=2, size=(32, 32), device="reference")
    assert (drawn.unit, drawn.length_unit) == ("1e4 Msun/kpc^2", "kpc")
    assert drawn.values.sum(dtype=float) * drawn.pixel**2 == pytest.approx(200, rel=1e-3)


def test_a_map_has_the_palette_of_its_keyword(universe):
    drawn = splotchcl.column(universe, palette="magma", size=(8, 8), device="reference")
    assert drawn.scene["map.palette"] == "magma"


def test_conditions_may_have_units(tmp_path):
    x = np.random.default_rng(3).uniform(0, 1, (100, 3))
    temperature = np.linspace(1e6, 3e7, 100)
    np.savez(tmp_path / "a.npz", pos=x, mass=np.ones(100), hsml=np.full(100, 0.1), temperature=temperature)
    snapshot = splotchcl.Snapshot(tmp_path / "a.npz", read={"units": {"temperature": "K"}})
    kelvin_per_kev = 1.602176634e-9 / 1.380649e-16
    drawn = splotchcl.column(snapshot, where="temperature > 1 keV", center=(0.5, 0.5, 0.5), width=2,
                             size=(32, 32), device="reference")
    hot = np.count_nonzero(temperature > kelvin_per_kev)
    assert drawn.values.sum(dtype=float) * drawn.pixel**2 == pytest.approx(hot, rel=1e-3)


def test_halves_are_read(tmp_path):
    x = np.random.default_rng(3).uniform(0, 1, (100, 3)).astype(np.float16)
    np.save(tmp_path / "a.npy", x)
    np.testing.assert_array_equal(splotchcl.Snapshot(tmp_path / "a.npy")["gas"]["position"], x)


def write_halo(folder, **more):
    """A thousand particles, and beside them a list of haloes with one whose identifier is long."""
    x = np.random.default_rng(3).uniform(0, 10000, (1000, 3))
    np.savez(folder / "snap_003.npz", pos=x, mass=1.0, hsml=100.0, **more)
    (folder / "out_3.list").write_text("#ID Mvir Rvir X Y Z\n18446744073709551615 1e12 2500 4 5 6\n")
    return np.count_nonzero(np.linalg.norm(x - [4000, 5000, 6000], axis=1) <= 2500)


def particles_of_halo(path, number, **read):
    drawn = splotchcl.column(splotchcl.Snapshot(path, read=read), size=(8, 8), device="reference",
                             settings={"component.0.select.halo": number})
    return drawn._map.particles


def test_a_halo_of_a_rockstar_list_is_a_sphere(tmp_path):
    count = write_halo(tmp_path)
    units = {"position": "kpc/h a"}
    assert particles_of_halo(tmp_path / "snap_003.npz", str(2**64 - 1), units=units) == count
    with pytest.raises(DataError, match="no halo 5"):
        particles_of_halo(tmp_path / "snap_003.npz", 5, units=units)


def test_a_halo_of_a_rockstar_list_needs_a_unit_of_lengths(tmp_path):
    write_halo(tmp_path)
    with pytest.raises(UsageError, match=r"sphere in Mpc/h a, but .*name it as read\.units"):
        particles_of_halo(tmp_path / "snap_003.npz", str(2**64 - 1))


def test_files_of_a_set_in_different_units_are_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    for member, unit in enumerate(["Msun", "kg"]):
        with h5py.File(tmp_path / f"s.{member}.hdf5", "w") as file:
            header = {"NumPart_ThisFile": [5, 0, 0, 0, 0, 0], "NumPart_Total": [10, 0, 0, 0, 0, 0],
                      "NumFilesPerSnapshot": 2}
            file.create_group("Header").attrs.update(header)
            file["PartType0/Coordinates"] = np.ones((5, 3))
            file["PartType0/Masses"] = np.ones(5)
            file["PartType0/Masses"].attrs["units"] = unit
    gas = Snapshot(tmp_path / "s.0.hdf5")["gas"]
    assert gas["position"].shape == (10, 3)
    with pytest.raises(DataError, match=r's\.1\.hdf5: .*Masses is in "kg", but in "Msun" in s\.0\.hdf5'):
        gas["mass"]


def test_complex_numbers_are_refused(tmp_path):
    np.save(tmp_path / "a.npy", np.ones((5, 3), complex))
    with pytest.raises(DataError, match=r"no real numbers.*array\.real"):
        Snapshot(tmp_path / "a.npy")
