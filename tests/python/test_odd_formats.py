"""HDF5 of other programs, floats of few bits, and Tipsy."""

import numpy as np
import pytest
from odd import assert_reads, assert_reads_group, assert_units, counts_of, has_note, h5py, hdf5, mass_in_map, of
from splotchcl import DataError, Snapshot, _core

pytestmark = pytest.mark.usefixtures("program", "renderer")


@of("a07_custom_floats")
def test_floats_of_few_bits_are_read(odd_files):
    gas = Snapshot(odd_files / "a07_custom_floats.hdf5")["gas"]
    truth = np.load(odd_files / "a07_truth.npz")
    assert_reads(gas, position=truth["x"], smoothing_length=2)
    # Half of what the last bit of the mantissa is worth.
    for name, values, bits in [("mass", truth["m"], 7), ("density", truth["d"], 13),
                               ("internal_energy", truth["d"] * 1e3, 7)]:
        np.testing.assert_allclose(gas[name], values, rtol=0.5**(bits + 1), err_msg=name)
        assert np.any(gas[name] != values.astype(np.float32))
    assert_reads(gas, temperature=(truth["d"] * 100).astype(np.float16))
    assert_reads(Snapshot(odd_files / "a07_truth.npz")["gas"], position=truth["x"], mass=truth["m"], d=truth["d"])


@of("b10_other_hdf5")
def test_hdf5_of_other_programs_is_read(odd_files):
    steps = odd_files / "b10_h5part.h5"
    last = Snapshot(steps)
    assert has_note(last, "12 steps", "the last is read")
    for snapshot, step in ((last, 11), (Snapshot(steps / "Step#3"), 3)):
        assert snapshot.time == pytest.approx(0.1 * step)
        x = np.column_stack([hdf5(steps, f"Step#{step}/{axis}") for axis in "xyz"])
        assert_reads(snapshot["gas"], position=x)
        names = {"smoothing_length": "h", "mass": "m", "density": "rho", "temperature": "temp"}
        assert_reads_group(snapshot["gas"], steps, f"Step#{step}", names)
    assert 1 == mass_in_map(steps, (55, 0, 0), 12)
    with pytest.raises(DataError, match="no particles in a group Step#12.*/Step#0 to /Step#11"):
        Snapshot(steps / "Step#12")

    records = hdf5(odd_files / "b10_compound.hdf5", "particles")
    gas = Snapshot(odd_files / "b10_compound.hdf5")["gas"]
    x = np.column_stack([records[axis] for axis in "xyz"])
    assert_reads(gas, position=x, mass=records["mass"], id=records["id"])

    plasma = odd_files / "b10_openpmd.h5"
    electrons = Snapshot(plasma)["gas"]
    x = np.column_stack([hdf5(plasma, f"data/100/particles/e/position/{axis}") for axis in "xyz"])
    assert_reads(electrons, position=x)
    assert_units(electrons, position="1e-06 m")

    columns = odd_files / "b10_three_by_n.hdf5"
    assert_reads(Snapshot(columns)["gas"], position=hdf5(columns, "pos").T, mass=hdf5(columns, "mass"))


def tipsy_rows(path, order, position, *further):
    """After a header of 32 bytes, or of 28 where it has no pad."""
    vectors = [("mass", order + "f4"), ("pos", order + position, 3), ("vel", order + "f4", 3)]
    layout = np.dtype(vectors + [(name, order + "f4") for name in further])
    return np.fromfile(path, layout, offset=28 if "nopad" in path.name else 32)


@of("b11_tipsy")
def test_tipsy_of_other_habits_is_read(odd_files):
    of_stars, of_halo = ("metals", "tform", "eps", "phi"), ("eps", "phi")
    layouts = {"stars.std": (">", "f4", *of_stars), "stars.nat": ("<", "f4", *of_stars),
               "double.std": (">", "f8", *of_halo), "nopad.std": (">", "f4", *of_halo),
               "aux.std": (">", "f4", *of_halo)}
    for name, layout in layouts.items():
        path = odd_files / f"b11_{name}"
        rows = tipsy_rows(path, *layout)
        snapshot = Snapshot(path)
        kind = "stars" if name.startswith("stars") else "halo"
        assert counts_of(snapshot) == {kind: 300}
        assert snapshot.time == 0.5
        assert_reads(snapshot[kind], position=rows["pos"], mass=rows["mass"], velocity=rows["vel"])
    lengths = np.loadtxt(odd_files / "b11_aux.std.smooth", skiprows=1)
    auxiliary = Snapshot(odd_files / "b11_aux.std")
    assert_reads(auxiliary["halo"], smoothing_length=2 * lengths)
    assert has_note(auxiliary, "b11_aux.std.den left out", "2404 bytes, expected 1204")
    assert 1 == mass_in_map(odd_files / "b11_aux.std", (0, 0, 0), 1.5)


def test_steps_in_records_of_numpy_are_apart(tmp_path):
    rows = np.zeros(6, [("step", ">i4"), ("x", "f8"), ("y", "f8"), ("z", "f8")])
    rows["step"], rows["x"] = [0, 0, 1, 1, 10, 10], range(6)
    path = tmp_path / "steps.npy"
    np.save(path, rows)
    last = Snapshot(path)
    assert has_note(last, "3 steps in time, step=0 to step=10", "the last is read")
    for snapshot, x in ((last, [4, 5]), (Snapshot(path / "step=1"), [2, 3])):
        np.testing.assert_array_equal(snapshot["gas"]["position"][:, 0], x)


@pytest.mark.parametrize("rows, is_said", [
    (np.linspace(0, 1, 768).reshape(256, 3), True),
    (np.arange(768, dtype=np.uint8).reshape(256, 3), True),
    (np.linspace(0, 1, 750).reshape(250, 3), False),
    (np.linspace(-1, 1, 768).reshape(256, 3), False),
], ids=["parts of 1", "bytes", "another number of rows", "below 0"])
def test_rows_that_may_be_colors_are_said(tmp_path, rows, is_said):
    path = tmp_path / "rows.npy"
    np.save(path, rows)
    snapshot = Snapshot(path)
    assert has_note(snapshot, "if they are colors") == is_said
    assert_reads(snapshot["gas"], position=rows)
    if is_said:
        colors = _core.palette_colors(str(path), 1)
        np.testing.assert_allclose(colors, rows / max(1, rows.max()), rtol=1e-6)


def test_names_of_any_bytes_are_shown(tmp_path):
    path = tmp_path / "names.h5"
    with h5py.File(path, "w") as file:
        file["pos"] = np.eye(3)
        file[b"gr\xf6\xdfe"] = np.arange(3.0)
    gas = Snapshot(path)["gas"]
    assert list(gas) == ["gr\N{LATIN SMALL LETTER O WITH DIAERESIS}\N{LATIN SMALL LETTER SHARP S}e", "position"]
    assert_reads(gas, position=np.eye(3))
