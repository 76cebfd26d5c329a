"""Tables as text, of many programs."""

import numpy as np
import pytest
from odd import HAS_ASTROPY, SCRIPTS, assert_reads, assert_units, mass_in_map, of, refusal_of
from splotchcl import DataError, Snapshot

pytestmark = pytest.mark.usefixtures("program", "renderer")


@of("b01_rockstar_ascii")
def test_names_in_the_first_of_many_comments_are_the_columns(odd_files):
    path = odd_files / "b01_halos_0.0.ascii"
    halos = Snapshot(path)["gas"]
    table = np.loadtxt(path)
    assert len(halos) == 50
    named = dict(zip(["DescID", "Mvir", "Vmax", "Rvir", "Np"], table.T[1:6]))
    assert_reads(halos, position=table[:, 6:9], velocity=table[:, 9:], **named)
    np.testing.assert_array_equal(halos["id"], table[:, 0])


@of("b02_ahf_halos")
def test_names_with_numbers_of_columns_are_names(odd_files):
    path = odd_files / "b02_AHF_halos"
    halos = Snapshot(path)["gas"]
    table = np.loadtxt(path)
    names = ["hostHalo", "numSubStruct", "Mhalo", "npart"]
    assert_reads(halos, position=table[:, 5:8], Rhalo=table[:, 8], **dict(zip(names, table.T[1:5])))
    assert set(halos.fields.values()) == {""}
    for command in (["info"], ["map", "-o", odd_files / "no.npy"], ["render", "-o", odd_files / "no.png"]):
        says = refusal_of(*command, odd_files / "b02_AHF_particles")
        assert "no table with three or more numbers in each line" in says


@of("b03_splash_ascii")
def test_the_tables_of_splash_are_read(odd_files):
    for name in ("b03_splash.ascii", "b03_splash_one_type.ascii", "b03_splash.csv"):
        lines = (odd_files / name).read_text().replace(",", " ").split("\n")
        rows = np.loadtxt([line for line in lines if "x" not in line])
        gas = Snapshot(odd_files / name)["gas"]
        names = ("mass", "smoothing_length", "density")
        assert_reads(gas, position=rows[:, :3], **dict(zip(names, rows.T[3:6])))
    with_units = Snapshot(odd_files / "b03_splash.ascii")["gas"]
    assert_units(with_units, position="au", smoothing_length="au", velocity="km/s", internal_energy="erg/g")
    assert_reads(with_units, velocity=np.tile([0, 1, 0], (200, 1)), internal_energy=1e9)


@of("b06_dualsphysics_csv")
def test_semicolons_counts_and_decimal_commas_are_read(odd_files):
    for name in ("b06_dual.csv", "b06_dual_counts.csv", "b06_decimal_commas.csv"):
        lines = (odd_files / name).read_text().replace(",", ".").split("\n")
        first = next(i for i, line in enumerate(lines) if line.startswith("Pos.x")) + 1
        rows = np.loadtxt(lines[first:], delimiter=";")
        assert rows.shape == (100, 8)
        gas = Snapshot(odd_files / name)["gas"]
        assert_reads(gas, position=rows[:, :3], velocity=rows[:, 4:7], Idp=rows[:, 3], Rhop=rows[:, 7])
        assert_units(gas, position="m", velocity="m/s", Rhop="kg/m^3")


@of("b07_counts_first")
def test_lines_of_counts_are_no_particles(odd_files):
    points = np.loadtxt(odd_files / "b07_points.xyz", skiprows=2, usecols=(1, 2, 3))
    assert_reads(Snapshot(odd_files / "b07_points.xyz")["gas"], position=points)

    three = odd_files / "b07_three_numbers_first.txt"
    with pytest.raises(DataError, match=r"without a header.*read\.columns"):
        Snapshot(three)
    for read in ({"columns": list("xyz")}, {"columns": list("xyz"), "skip_lines": 1}):
        assert_reads(Snapshot(three, read=read)["gas"], position=np.loadtxt(three, skiprows=1))

    fortran = odd_files / "b07_gradsph.dat"
    rows = np.loadtxt(fortran, skiprows=4)
    names = ["x", "y", "z", *"----", "h", "mass", "-", "-"]
    gas = Snapshot(fortran, read={"columns": names})["gas"]
    assert_reads(gas, position=rows[:, :3], smoothing_length=rows[:, 7], mass=rows[:, 8])
    with pytest.raises(DataError, match=r"line 2: found 2 values, expected 3.*read\.skip_lines"):
        Snapshot(fortran, read={"columns": list("xyz")})["gas"]["position"]


@of("b08_ecsv_and_friends")
def test_the_tables_of_astropy_are_read(odd_files):
    table = pytest.importorskip("astropy.table").QTable.read(odd_files / "b08_table.ecsv")
    position = np.column_stack([table[axis].to_value("kpc") for axis in "xyz"])
    mass, h = table["mass"].to_value("Msun"), table["hsml"]
    for name in ("table.ecsv", "ipac.txt", "mrt.txt", "table.hdf5"):
        gas = Snapshot(odd_files / f"b08_{name}")["gas"]
        assert_reads(gas, position=position, mass=mass, smoothing_length=h.to_value("kpc"))
        assert_units(gas, position="kpc", mass="solMass", smoothing_length="kpc")
    for name in ("commented_header", "csv", "fixed_width", "rst", "tab"):
        gas = Snapshot(odd_files / f"b08_{name}.txt")["gas"]
        assert_reads(gas, position=position, mass=mass, smoothing_length=h.to_value("pc"))
        assert set(gas.fields.values()) == {""}
    assert_reads(Snapshot(odd_files / "b08_savetxt.txt")["gas"], position=position, mass=1)
    assert mass.sum() == mass_in_map(odd_files / "b08_table.ecsv", (0, 0, 0), 8)


@pytest.mark.skipif(not HAS_ASTROPY, reason="astropy makes the files")
@pytest.mark.skipif("b08_ecsv_and_friends" not in SCRIPTS, reason="no generator of the files")
@pytest.mark.parametrize("command", ["info", "map", "render", "movie"])
@pytest.mark.parametrize(
    "name, advice",
    [("table.fits", "it is a FITS file; convert it to HDF5 or to a NumPy array"),
     ("table.vot", "it is a VOTable; write it as ECSV or HDF5"),
     ("latex.txt", "it is a LaTeX table; write it as CSV or ECSV")],
    ids=["FITS", "VOTable", "LaTeX"],
)
def test_tables_that_are_not_read_are_refused_with_advice(odd_files, program, command, name, advice):
    endings = {"map": "npy", "render": "png", "movie": "mp4"}
    output = ["-o", odd_files / f"no.{endings[command]}"] if command in endings else []
    says = refusal_of(command, odd_files / f"b08_{name}", *output)
    assert advice in says
    assert "scene file" not in says
