"""Gadget, SWIFT and AREPO of odd habits."""

import struct

import numpy as np
import pytest
from odd import (
    GAMMA_OF_CUBIC_SPLINE,
    GAS,
    STARS,
    assert_reads,
    assert_reads_group,
    assert_units,
    counts_of,
    has_note,
    h5py,
    hdf5,
    mass_in_map,
    of,
)
from splotchcl import DataError, Snapshot

pytestmark = pytest.mark.usefixtures("program", "renderer")


@of("a01_missing_group")
def test_a_type_without_its_group_is_left_out(odd_files):
    path = odd_files / "a01_missing_group.hdf5"
    snapshot = Snapshot(path)
    assert counts_of(snapshot) == {"gas": 200, "stars": 300}
    assert has_note(snapshot, "PartType1", "1157")
    more = {"density": "Density", "internal_energy": "InternalEnergy"}
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS | more)
    assert_reads_group(snapshot["stars"], path, "PartType4", STARS)
    assert hdf5(path, "PartType0/Masses").sum() == mass_in_map(path, (50, 50, 50), 60, types="gas")


@of("a02_type_without_positions")
def test_a_type_without_positions_is_left_out(odd_files):
    path = odd_files / "a02_type_without_positions.hdf5"
    snapshot = Snapshot(path)
    assert counts_of(snapshot) == {"gas": 200}
    assert has_note(snapshot, "PartType4", "300", "no positions")
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS)


@of("a04_extra_dataset")
def test_a_dataset_of_other_length_is_left_out(odd_files):
    path = odd_files / "a04_extra_dataset.hdf5"
    snapshot = Snapshot(path)
    assert counts_of(snapshot) == {"gas": 200}
    assert has_note(snapshot, "Center (3)")
    assert "Center" not in snapshot["gas"]
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS)


@of("a08_swift_subset_without_code")
def test_swift_is_known_by_its_attributes(odd_files):
    path = odd_files / "a08_swift_subset.hdf5"
    snapshot = Snapshot(path)
    gas = snapshot["gas"]
    assert counts_of(snapshot) == {"gas": 200, "stars": 300}
    assert snapshot.box_size == pytest.approx(50.00000002)
    h = hdf5(path, "PartType0/SmoothingLengths") * GAMMA_OF_CUBIC_SPLINE
    assert_reads(gas, smoothing_length=h, density=hdf5(path, "PartType0/Densities"))
    for kind, group in {"gas": "PartType0", "stars": "PartType4"}.items():
        assert_reads_group(snapshot[kind], path, group, STARS)
    assert_units(gas, position="Mpc a", mass="1e10 M_sun", smoothing_length="Mpc a")
    assert has_note(snapshot, "Kernel gamma")
    assert hdf5(path, "PartType0/Masses").sum() == mass_in_map(path, (25, 25, 25), 9, types="gas")


@of("a15_metals_by_element")
def test_metals_are_columns_by_element(odd_files):
    path = odd_files / "a15_metals.hdf5"
    gas = Snapshot(path)["gas"]
    z = hdf5(path, "PartType0/Metallicity")
    elements = ["He", "C", "N", "O", "Ne", "Mg", "Si", "S", "Ca", "Fe"]
    columns = {f"Metallicity.{name}": z[:, i + 1] for i, name in enumerate(elements)}
    assert_reads(gas, metallicity=z[:, 0], **columns)
    for name in ("Oxygen", "Iron"):
        in_file = hdf5(path, f"PartType0/ElementAbundance/{name}")
        assert_reads(gas, **{f"ElementAbundance.{name}": in_file})
    assert_reads_group(gas, path, "PartType0", GAS)
    assert_units(gas, position="kpc h^-1 a", mass="1e10 M_sun h^-1", metallicity="")


def records_of(path, order):
    """The records of a file of Fortran's."""
    data, place, found = path.read_bytes(), 0, []
    while place < len(data):
        (size,) = struct.unpack_from(order + "I", data, place)
        found.append(data[place + 4 : place + 4 + size])
        place += size + 8
    return found


def gadget_vectors(path):
    """Positions and velocities, the second and third block."""
    form, habit = path.name[4:6], path.name[7:]
    order = ">" if habit.endswith("be") else "<"
    records = records_of(path, order)
    blocks = records[1::2] if form == "f2" else records  # each has a record of its own for its label
    is_double = {1: "all_double" in habit or habit == "pos_double", 2: "all_double" in habit}
    return [np.frombuffer(blocks[i], order + ("f8" if is_double[i] else "f4")).reshape(-1, 3)
            for i in (1, 2)]


@of("g01_gadget_binary")
def test_gadget_of_other_habits_is_read(odd_files):
    counts = {"gas": 300, "halo": 500, "stars": 100}
    paths = sorted(odd_files.glob("g01_f*"))
    assert len(paths) == 8
    for path in paths:
        x, v = gadget_vectors(path)
        snapshot = Snapshot(path)
        assert counts_of(snapshot) == counts
        first = 0
        for name, count in counts.items():
            own = slice(first, first + count)
            # The block counts before the header's table, which one file has in its place.
            mass = 1.04 if path.name.endswith("f1_table") and name == "halo" else 2
            ids = np.arange(first, first + count) + 1
            assert_reads(snapshot[name], position=x[own], velocity=v[own], mass=mass, id=ids)
            first += count
        assert_reads(snapshot["gas"], internal_energy=100, density=1e-3, smoothing_length=3)
    more = Snapshot(odd_files / "g01_f2_metals_half")
    assert_reads(more["gas"], temperature=1e4)
    assert_reads(more["stars"], stellar_age=0.5, iM=0.5)
    assert has_note(more, "block Zs left out") and has_note(more, "block CLDX left out")
    for member in (0, 1):
        both = Snapshot(odd_files / "g01_one_of_one" / f"snap_005.{member}")
        assert counts_of(both) == {name: 2 * count for name, count in counts.items()}
        assert has_note(both, "read together")
    assert 600 * 2 == mass_in_map(odd_files / "g01_one_of_one" / "snap_005.0", (50, 50, 50), 60, types="gas")


@of("z01_headers")
def test_headers_of_other_habits_are_understood(odd_files):
    notes = {"overflow": "NumPart_Total", "total_small": "total number of particles (400)",
             "files_8": "8 files"}
    lower = odd_files / "z01_lower_case.hdf5"
    paths = set(odd_files.glob("z01_*.hdf5")) - {lower}
    assert len(paths) == 11
    for path in paths:
        habit = path.stem[4:]
        snapshot = Snapshot(path)
        assert counts_of(snapshot) == {"gas": 200, "stars": 300}
        assert_reads_group(snapshot["gas"], path, "PartType0", GAS)
        assert_reads_group(snapshot["stars"], path, "PartType4", STARS)
        assert snapshot.box_size == (None if habit == "no_time_box" else 100)
        assert snapshot.time == (0 if habit == "no_time_box" else 1)
        assert len(snapshot.notes) == (habit in notes)
        assert has_note(snapshot, notes.get(habit, "")) == (habit in notes)
    names = {"position": "coordinates", "mass": "masses"}
    assert_reads_group(Snapshot(lower)["gas"], lower, "parttype0", names)


def write_gadget_hdf5(path, header, particles):
    counts = [len(particles["Coordinates"]), 0, 0, 0, 0, 0]
    known = {"NumPart_ThisFile": counts, "NumPart_Total": counts, "MassTable": [0.0] * 6, "NumFilesPerSnapshot": 1,
             "Time": 1.0, "Redshift": 0.0, "BoxSize": 100.0, "HubbleParam": 0.7, "Omega0": 0.3, "OmegaLambda": 0.7}
    with h5py.File(path, "w") as file:
        file.create_group("Header").attrs.update(known | header)
        for name, values in particles.items():
            file[f"PartType0/{name}"] = values


POSITIONS = {"Coordinates": np.arange(60.0).reshape(20, 3)}


@pytest.mark.parametrize("header, scale_factor, is_said", [
    ({"Time": 0.5, "Redshift": 1.0}, 0.5, False),
    ({"Time": np.array([0.5]), "Redshift": "1.0"}, 0.5, False),
    ({"Time": 0.5, "Redshift": 3.0}, 0.25, True),
    ({"Time": 0.0, "Redshift": 0.0}, 1, False),
], ids=["alike", "as an array and text", "apart", "without a cosmology"])
def test_scale_factors_that_disagree_are_said(tmp_path, header, scale_factor, is_said):
    path = tmp_path / "snapshot.hdf5"
    write_gadget_hdf5(path, header, POSITIONS)
    snapshot = Snapshot(path)
    assert 1 / (1 + snapshot.redshift) == scale_factor
    assert has_note(snapshot, "no scale factor of its redshift") == is_said


@pytest.mark.parametrize("difference", [{"Redshift": 0.2}, {"BoxSize": 50.0}, {"Time": 0.9}], ids=lambda d: next(iter(d)))
def test_files_of_a_set_that_disagree_are_refused(tmp_path, difference):
    for number, header in enumerate([{}, difference]):
        of_set = {"NumFilesPerSnapshot": 2, "NumPart_Total": [40, 0, 0, 0, 0, 0]}
        write_gadget_hdf5(tmp_path / f"snap.{number}.hdf5", of_set | header, POSITIONS)
    with pytest.raises(DataError, match="its header has another"):
        Snapshot(tmp_path / "snap.0.hdf5")


@pytest.mark.parametrize("haloes", [np.repeat([3, -1], 10), np.repeat([3.0, -1.0], 10)], ids=["integers", "floats"])
def test_haloes_may_be_floats_and_below_zero(tmp_path, haloes):
    path = tmp_path / "snapshot.hdf5"
    write_gadget_hdf5(path, {}, POSITIONS | {"HaloID": haloes})
    np.testing.assert_array_equal(Snapshot(path)["gas"]["halo_id"], haloes)
