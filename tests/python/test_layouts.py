"""Files as other programs write them, by these programs: numbers are those that were written."""

import json
import os
import subprocess

import numpy as np
import pytest


@pytest.fixture(scope="module")
def fields_of(program):
    """The least, greatest and mean value of each field, as the program reads them."""

    def read(path, *options, type_number=0):
        words = [os.environ["SPLOTCHCL_PROGRAM"], "info", str(path), "--json", *options]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        types = {t["type"]: t for t in json.loads(done.stdout)["types"]}
        return {f["name"]: f for f in types[type_number]["fields"]}

    return read


def positions(count=200, seed=3):
    return np.random.default_rng(seed).normal(0, 1, (count, 3)) + [10, 20, 30]


def assert_holds(fields, expected):
    for name, values in expected.items():
        field = fields[name]
        found = [field["minimum"], field["maximum"], field["mean"]]
        wanted = [np.min(values), np.max(values), np.mean(values)]
        np.testing.assert_allclose(found, wanted, rtol=1e-6, err_msg=name)
        assert field["bad"] == np.count_nonzero(~np.isfinite(values))


def axes_of(x):
    return {f"position {axis}": x[:, i] for i, axis in enumerate("xyz")}


def test_compound_records_are_read(fields_of, tmp_path):
    h5py = pytest.importorskip("h5py")
    x = positions()
    records = np.zeros(len(x), [("x", "f4"), ("y", "f4"), ("z", "f4"), ("mass", ">f8"), ("id", "i8")])
    for i, axis in enumerate("xyz"):
        records[axis] = x[:, i]
    records["mass"] = np.arange(len(x))
    for name, options in {"plain": {}, "packed": {"chunks": (64,), "compression": 4}}.items():
        path = tmp_path / f"{name}.h5"
        with h5py.File(path, "w") as file:
            file.create_dataset("particles", data=records, **options)
        expected = {axis: v.astype("f4") for axis, v in axes_of(x).items()}
        assert_holds(fields_of(path), expected | {"mass": records["mass"]})


def test_records_with_arrays_and_records_are_read(fields_of, tmp_path):
    h5py = pytest.importorskip("h5py")
    x = positions()
    records = np.zeros(len(x), [("pos", "f8", 3), ("name", "S8"), ("more", [("q", "i2"), ("t", "f4")])])
    records["pos"], records["more"]["q"] = x, -3
    records["more"]["t"] = np.arange(len(x))
    with h5py.File(tmp_path / "nested.h5", "w") as file:
        file["run/gas"] = records
    fields = fields_of(tmp_path / "nested.h5")
    assert_holds(fields, axes_of(x) | {"more.q": np.full(len(x), -3), "more.t": np.arange(len(x))})


def test_positions_by_axes_are_read(fields_of, tmp_path):
    h5py = pytest.importorskip("h5py")
    x = positions()
    with h5py.File(tmp_path / "axes.h5", "w") as file:
        file.create_dataset("pos", data=x.T.copy(), chunks=(3, 64), compression=4)
        file["vel"] = 2 * x.T
        file["mass"] = np.arange(len(x))
    fields = fields_of(tmp_path / "axes.h5")
    assert_holds(fields, axes_of(x) | {"mass": np.arange(len(x)), "velocity y": 2 * x[:, 1]})


def test_openpmd_is_read(fields_of, tmp_path):
    h5py = pytest.importorskip("h5py")
    x = positions()
    with h5py.File(tmp_path / "plasma.h5", "w") as file:
        file.attrs["openPMD"] = np.bytes_("1.1.0")
        for iteration in (0, 100, 2000):
            group = file.create_group(f"data/{iteration}/particles/e")
            file[f"data/{iteration}"].attrs["time"] = 1e-3 * iteration
            file[f"data/{iteration}/fields/E/x"] = np.zeros((4, 5, 6))
            for i, axis in enumerate("xyz"):
                group["position/" + axis] = (x[:, i] + iteration).astype("f4")
                group["position/" + axis].attrs["unitSI"] = 1e-6
                offset = group.create_group("positionOffset/" + axis)
                offset.attrs.update({"value": 2.0, "shape": np.array([len(x)]), "unitSI": 1e-3})
            group["weighting"] = np.arange(len(x), dtype="f8")
    for options, iteration in {"": 2000, "/data/100": 100, "/data/0": 0}.items():
        fields = fields_of(str(tmp_path / "plasma.h5") + options)
        expected = axes_of((x + iteration).astype("f4") + 2000.0)
        assert_holds(fields, expected | {"weighting": np.arange(len(x))})
        assert fields["position x"]["unit"] == "1e-06 m"


def test_columns_of_vaex_are_read(fields_of, tmp_path):
    h5py = pytest.importorskip("h5py")
    x = positions()
    with h5py.File(tmp_path / "vaex.hdf5", "w") as file:
        for i, axis in enumerate("xyz"):
            file[f"table/columns/{axis}/data"] = x[:, i]
            file[f"table/columns/{axis}"].attrs["unit"] = "kpc"
        file["table/columns/mass/data"] = np.arange(len(x))
    fields = fields_of(tmp_path / "vaex.hdf5")
    assert_holds(fields, axes_of(x) | {"mass": np.arange(len(x))})
    assert fields["position z"]["unit"] == "kpc"


def test_columns_of_any_layout_are_named(fields_of, tmp_path):
    h5py = pytest.importorskip("h5py")
    x = positions()
    with h5py.File(tmp_path / "any.h5", "w") as file:
        file["a/table"] = np.column_stack([np.arange(len(x)), x])
        records = np.zeros(len(x), [("w", "f8")])
        records["w"] = 3 * np.arange(len(x))
        file["b"] = records
    columns = "x=a/table:2,y=a/table:3,z=a/table:4,mass=b:w"
    fields = fields_of(tmp_path / "any.h5", "--columns", columns)
    assert_holds(fields, axes_of(x) | {"mass": 3 * np.arange(len(x))})


def quantities(x):
    table = pytest.importorskip("astropy.table")
    units = pytest.importorskip("astropy.units")
    columns = {axis: x[:, i] * units.kpc for i, axis in enumerate("xyz")}
    columns["mass"] = np.full(len(x), 2.0) * units.Msun
    columns["hsml"] = np.full(len(x), 300.0) * units.pc
    return table.QTable(columns)


@pytest.mark.parametrize("form", ["ecsv", "ipac", "mrt", "fixed_width", "rst", "tab", "csv"])
def test_tables_of_astropy_are_read(fields_of, tmp_path, form):
    x = positions()
    quantities(x).write(tmp_path / "table.txt", format=f"ascii.{form}")
    fields = fields_of(tmp_path / "table.txt")
    assert_holds(fields, axes_of(x) | {"mass": np.full(len(x), 2.0)})
    has_units = form in ("ecsv", "ipac", "mrt")
    assert_holds(fields, {"smoothing_length": np.full(len(x), 0.3 if has_units else 300.0)})
    assert fields["position x"]["unit"] == ("kpc" if has_units else "")


def test_hdf5_of_astropy_is_read_with_its_units(fields_of, tmp_path):
    pytest.importorskip("h5py")
    x = positions()
    quantities(x).write(tmp_path / "table.h5", path="galaxy", serialize_meta=True)
    fields = fields_of(tmp_path / "table.h5")
    assert_holds(fields, axes_of(x) | {"smoothing_length": np.full(len(x), 0.3)})
    assert fields["mass"]["unit"] == "solMass"


def test_decimal_commas_and_counts_are_read(fields_of, tmp_path):
    x = positions()
    rows = "".join(";".join(f"{v:.9f}" for v in row).replace(".", ",") + ";7\n" for row in x)
    names = "Pos.x [m];Pos.y [m];Pos.z [m];Idp\n"
    path = tmp_path / "dual.csv"
    path.write_text(f"Np;Nbound;TimeStep [s]\n{len(x)};0;0,5\n" + names + rows)
    assert_holds(fields_of(path), axes_of(x) | {"Idp": np.full(len(x), 7)})


def test_fortran_rows_after_others_are_named(fields_of, tmp_path):
    x = positions()
    path = tmp_path / "gradsph.dat"
    rows = np.column_stack([x, np.zeros((len(x), 2)), np.arange(len(x))])
    with path.open("w") as file:
        file.write(f"{len(x):9d}{0:9d}{2:9d}\n{0.5:25.15E}{1.6667:25.15E}\n")
        for sink in range(2):
            file.write("".join(f"{v:25.15E}" for v in (sink, 0, 0, 0)) + "\n")
        for row in rows:
            file.write("".join(f"{v:25.15E}" for v in row).replace("E", "D") + "\n")
    expected = axes_of(x) | {"mass": np.arange(len(x))}
    assert_holds(fields_of(path, "--columns", "x,y,z,-,-,mass"), expected)
    assert_holds(fields_of(path, "--columns", "x=1,y=2,z=3,mass=6", "--skip-lines", "4"), expected)


def test_xyz_is_read(fields_of, tmp_path):
    x = positions()
    path = tmp_path / "points.xyz"
    rows = "".join("H {:.9f} {:.9f} {:.9f}\n".format(*row) for row in x)
    path.write_text(f"{len(x)}\nt = 0.5\n" + rows)
    assert_holds(fields_of(path), axes_of(x))
