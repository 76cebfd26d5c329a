"""Files of odd habits, by generators among the test data; h5py, numpy and astropy say what they hold."""

import importlib.util
import io
import math
import os
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import splotchcl
from splotchcl import DataError, Snapshot, _core

h5py = pytest.importorskip("h5py")

FOLDER = Path(os.environ.get("SPLOTCHCL_TEST_DATA", "nowhere")) / "odd"
SCRIPTS = {path.stem: path for path in sorted(FOLDER.glob("[a-z][0-9][0-9]_*.py"))}
HAS_ASTROPY = importlib.util.find_spec("astropy") is not None
CHECKS = {}

GAMMA_OF_CUBIC_SPLINE = 1.825742  # of its support to its smoothing length in three dimensions
WIDTH_OF_KERNEL = 1 / math.sqrt(20 / 3)  # of the Gaussian to the smoothing length
CM_OF = {"AU": 1.495978707e13, "pc": 3.0856776e18, "kpc": 3.0856776e21, "Mpc": 3.0856776e24}


def of(generator):
    """Says which generator's files a function checks."""

    def add(check):
        CHECKS[generator] = check
        return check

    return add


def can_run(script):
    return HAS_ASTROPY or "astropy" not in script.read_text()


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """The folder of what the generators made."""
    folder = tmp_path_factory.mktemp("odd")
    scripts = [str(script) for script in SCRIPTS.values() if can_run(script)]
    run = "import runpy, sys\nfor script in sys.argv[1:]: runpy.run_path(script)"
    paths = {"OUT": str(folder), "PYTHONPATH": str(FOLDER), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run([sys.executable, "-c", run, *scripts], env=os.environ | paths,
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder


# From memory: where h5py and the module share one HDF5 (Debian's), it refuses to open a file a second
# time with other locks.
def hdf5(path, name):
    with h5py.File(io.BytesIO(path.read_bytes()), "r") as file:
        return file[name][()]


def counts_of(snapshot):
    return {name: len(kind) for name, kind in snapshot.types.items()}


def has_note(source, *words):
    return any(all(word in note for word in words) for note in source.notes)


def assert_reads(kind, **expected):
    for name, wanted in expected.items():
        values = np.asarray(wanted, float)
        nearly_zero = 1e-6 * np.abs(values).max() if name == "position" else 0
        np.testing.assert_allclose(kind[name], values, rtol=1e-6, atol=nearly_zero, err_msg=name)


def assert_units(kind, **expected):
    assert {name: kind.fields[name] for name in expected} == expected


def assert_reads_group(kind, path, group, names):
    assert_reads(kind, **{ours: hdf5(path, f"{group}/{theirs}") for ours, theirs in names.items()})


def column(path, center, width, **options):
    return splotchcl.column(
        path, center=center, width=width, size=(32, 32), tolerance=1e-5, **options
    )


def total_of(drawn):
    return drawn.values.sum(dtype=float) * drawn.pixel**2


def mass_in_map(path, center, width, **options):
    """Of all particles, where the map is wide enough."""
    return pytest.approx(total_of(column(path, center, width, **options)), rel=1e-4)


def periodic_map(x, mass, h, box, center, width, pixels):
    """The surface density of Gaussians with all images that are near, one axis at a time."""
    edges = np.linspace(-width / 2, width / 2, pixels + 1)
    erf = np.vectorize(math.erf)

    def shares(axis):
        shifts = (x[:, axis] - center[axis])[:, None] + box * np.arange(-2, 3)
        places = (edges - shifts[..., None]) / (WIDTH_OF_KERNEL * h)
        return 0.5 * np.diff(erf(places)).sum(axis=1)

    return mass * shares(1).T @ shares(0) / (width / pixels) ** 2


def assert_draws_alone(path, condition, mask, h):
    """The condition selects the particles of the mask: those of mass 1, in a box of 100."""
    x = hdf5(path, "PartType0/Coordinates").astype(float)[mask]
    expected = periodic_map(x, 1.0, h, 100.0, (50, 50, 50), 80, 32)
    drawn = column(path, (50, 50, 50), 80, where=condition)
    np.testing.assert_allclose(drawn.values, expected, rtol=1e-3, atol=1e-4 * expected.mean(),
                               err_msg=condition)


def run(*arguments):
    words = [os.environ["SPLOTCHCL_PROGRAM"], *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def refusal_of(*arguments):
    """What the program says where it must not succeed."""
    done = run(*arguments)
    assert done.returncode in (1, 2) and done.stdout == ""
    return done.stderr


STARS = {"position": "Coordinates", "mass": "Masses", "id": "ParticleIDs"}
GAS = STARS | {"smoothing_length": "SmoothingLength"}


@of("a01_missing_group")
def a_type_without_its_group_is_left_out(files):
    path = files / "a01_missing_group.hdf5"
    snapshot = Snapshot(path)
    assert counts_of(snapshot) == {"gas": 200, "stars": 300}
    assert has_note(snapshot, "PartType1", "1157")
    more = {"density": "Density", "internal_energy": "InternalEnergy"}
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS | more)
    assert_reads_group(snapshot["stars"], path, "PartType4", STARS)
    assert hdf5(path, "PartType0/Masses").sum() == mass_in_map(path, (50, 50, 50), 60, types="gas")


@of("a02_type_without_positions")
def a_type_without_positions_is_left_out(files):
    path = files / "a02_type_without_positions.hdf5"
    snapshot = Snapshot(path)
    assert counts_of(snapshot) == {"gas": 200}
    assert has_note(snapshot, "PartType4", "300", "no positions")
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS)


@of("a04_extra_dataset")
def a_dataset_of_other_length_is_left_out(files):
    path = files / "a04_extra_dataset.hdf5"
    snapshot = Snapshot(path)
    assert counts_of(snapshot) == {"gas": 200}
    assert has_note(snapshot, "Center (3)")
    assert "Center" not in snapshot["gas"]
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS)


@of("a07_custom_floats")
def floats_of_few_bits_are_read(files):
    gas = Snapshot(files / "a07_custom_floats.hdf5")["gas"]
    truth = np.load(files / "a07_truth.npz")
    assert_reads(gas, position=truth["x"], smoothing_length=2)
    # Half of what the last bit of the mantissa is worth.
    for name, values, bits in [("mass", truth["m"], 7), ("density", truth["d"], 13),
                               ("internal_energy", truth["d"] * 1e3, 7)]:
        np.testing.assert_allclose(gas[name], values, rtol=0.5**(bits + 1), err_msg=name)
        assert np.any(gas[name] != values.astype(np.float32))
    assert_reads(gas, temperature=(truth["d"] * 100).astype(np.float16))
    assert_reads(Snapshot(files / "a07_truth.npz")["gas"], position=truth["x"], mass=truth["m"], d=truth["d"])


@of("a08_swift_subset_without_code")
def swift_is_known_by_its_attributes(files):
    path = files / "a08_swift_subset.hdf5"
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


@of("a14_wind_particles")
def wind_is_no_star_unless_a_condition_names_it(files):
    path = files / "a14_wind.hdf5"
    snapshot = Snapshot(path)
    born = hdf5(path, "PartType4/GFM_StellarFormationTime")
    assert counts_of(snapshot) == {"gas": 100, "stars": 400}
    assert_reads_group(snapshot["stars"], path, "PartType4", STARS | {"smoothing_length": "StellarHsml"})
    # AREPO's gas has no smoothing lengths: of a sphere with 64 particles.
    of_sphere = (3 * 64 / 1e-2 / (4 * np.pi)) ** (1 / 3)
    assert_reads(snapshot["gas"], smoothing_length=of_sphere)
    stars = {"center": (50, 50, 50), "width": 40, "types": "stars"}
    assert np.count_nonzero(born > 0) == mass_in_map(path, **stars)
    assert has_note(column(path, **stars), "wind")
    wind = "GFM_StellarFormationTime <= 0"
    assert np.count_nonzero(born <= 0) == mass_in_map(path, **stars, where=wind)


@of("a15_metals_by_element")
def metals_are_columns_by_element(files):
    path = files / "a15_metals.hdf5"
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


@of("a17_box_of_three_sides")
def a_box_of_three_sides_is_periodic(files):
    path = files / "a17_tube.hdf5"
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
def matter_in_a_plane_is_read(files):
    path = files / "a18_flat.hdf5"
    snapshot = Snapshot(path)
    assert_reads_group(snapshot["gas"], path, "PartType0", GAS | {"density": "Density"})
    assert snapshot["gas"]["position"][:, 2].max() == 0
    assert 1 == mass_in_map(path, (0.5, 0.5, 0), 1)
    table = np.genfromtxt(files / "a18_flat.csv", delimiter=",", names=True)
    flat = Snapshot(files / "a18_flat.csv")
    assert has_note(flat, "z is 0")
    x = np.column_stack([table["x"], table["y"], np.zeros(len(table))])
    assert_reads(flat["gas"], position=x, density=table["rho"], smoothing_length=table["h"])
    counted = column(files / "a18_flat.csv", (0.5, 0.5, 0), 2, field="counts")
    assert counted.values.sum(dtype=float) == pytest.approx(len(table), rel=1e-4)


@of("a20_corner_map")
def a_map_about_a_corner_has_the_images(files):
    path, center, width = files / "a20_corner.hdf5", (2.8, 2.8, 2.8), 1.5
    assert Snapshot(path).box_size == 3
    done = run("map", path, "--center", "2.8,2.8,2.8", "--width", width, "--size", "32x32",
               "--tolerance", 1e-5, "-o", files / "corner.npy")
    assert done.returncode == 0, done.stderr
    x = hdf5(path, "PartType0/Coordinates").astype(float)
    expected = periodic_map(x, 1.0, 0.5, 3.0, center, width, 32)
    drawn = np.load(files / "corner.npy")
    np.testing.assert_allclose(drawn, expected, rtol=1e-3, atol=1e-4 * expected.mean())


@of("a21_cgs")
def numbers_of_cgs_are_no_infinities(files):
    for name in ("disc", "cloud", "galaxy", "box"):
        path = files / f"a21_{name}.txt"
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
    path = files / "a21b_disc.txt"
    energy = np.loadtxt(path, usecols=5)
    assert_reads(Snapshot(path)["gas"], internal_energy=energy)
    assert_are_all(column(path, (0, 0, 0), 1e15, field="internal_energy", slice=True), energy[0])


def assert_are_all(drawn, value):
    """Means of what is the same everywhere; not a number where there is no matter."""
    known = drawn.values[np.isfinite(drawn.values)]
    assert known.size > drawn.values.size / 2
    np.testing.assert_allclose(known, value, rtol=1e-4)


@of("a22_box_of_no_meaning")
def a_box_that_particles_leave_is_not_periodic(files):
    path = files / "a22_box_1.hdf5"
    x = hdf5(path, "PartType0/Coordinates")
    assert np.ptp(x, axis=0).max() > 50
    assert_reads_group(Snapshot(path)["gas"], path, "PartType0", GAS | {"density": "Density"})
    drawn = column(path, (0, 0, 0), 80)
    assert has_note(drawn, "the box of 1", "not used")
    assert total_of(drawn) == pytest.approx(len(x), rel=1e-4)
    left, right, low, high = splotchcl.column(path, size=(8, 8)).extent
    assert left <= x[:, 0].min() and right >= x[:, 0].max()
    assert low <= x[:, 1].min() and high >= x[:, 1].max()


@of("a25_masks")
def masks_select_by_conditions(files):
    path = files / "a25_masks.hdf5"
    masks = {"is_bound == 1": hdf5(path, "PartType0/is_bound"),
             "flag8 == 2": hdf5(path, "PartType0/flag8") == 2}
    assert [np.count_nonzero(mask) for mask in masks.values()] == [50, 33]
    for condition, mask in masks.items():
        assert_draws_alone(path, condition, mask, h=3)
    mask = masks["is_bound == 1"]
    np.save(files / "mask.npy", mask)
    np.save(files / "ids.npy", hdf5(path, "PartType0/ParticleIDs")[mask])
    by_list = {"component.0.select.ids": str(files / "ids.npy")}
    assert np.count_nonzero(mask) == mass_in_map(path, (50, 50, 50), 80, settings=by_list)
    with pytest.raises(DataError, match=r"mask\.npy.*true and false.*save ids\[mask\] instead"):
        column(path, (50, 50, 50), 80, settings={"component.0.select.ids": str(files / "mask.npy")})


@of("a27_initial_conditions")
def one_smoothing_length_for_all_is_kept_by_maps(files):
    path = files / "a27_ics.hdf5"
    assert_reads_group(Snapshot(path)["gas"], path, "PartType0", GAS | {"internal_energy": "InternalEnergy"})
    x = hdf5(path, "PartType0/Coordinates").astype(float)
    expected = periodic_map(x, 1.0, 12.0, 100.0, (50, 50, 50), 100.0, 32)
    drawn = column(path, (50, 50, 50), 100)
    assert total_of(drawn) == pytest.approx(len(x), rel=1e-4)
    np.testing.assert_allclose(drawn.values, expected, rtol=1e-3)


@of("b01_rockstar_ascii")
def names_in_the_first_of_many_comments_are_the_columns(files):
    path = files / "b01_halos_0.0.ascii"
    halos = Snapshot(path)["gas"]
    table = np.loadtxt(path)
    assert len(halos) == 50
    named = dict(zip(["DescID", "Mvir", "Vmax", "Rvir", "Np"], table.T[1:6]))
    assert_reads(halos, position=table[:, 6:9], velocity=table[:, 9:], **named)
    np.testing.assert_array_equal(halos["id"], table[:, 0])


@of("b02_ahf_halos")
def names_with_numbers_of_columns_are_names(files):
    path = files / "b02_AHF_halos"
    halos = Snapshot(path)["gas"]
    table = np.loadtxt(path)
    names = ["hostHalo", "numSubStruct", "Mhalo", "npart"]
    assert_reads(halos, position=table[:, 5:8], Rhalo=table[:, 8], **dict(zip(names, table.T[1:5])))
    assert set(halos.fields.values()) == {""}
    for command in (["info"], ["map", "-o", files / "no.npy"], ["render", "-o", files / "no.png"]):
        says = refusal_of(*command, files / "b02_AHF_particles")
        assert "no table with three or more numbers in each line" in says


@of("b03_splash_ascii")
def the_tables_of_splash_are_read(files):
    for name in ("b03_splash.ascii", "b03_splash_one_type.ascii", "b03_splash.csv"):
        lines = (files / name).read_text().replace(",", " ").split("\n")
        rows = np.loadtxt([line for line in lines if "x" not in line])
        gas = Snapshot(files / name)["gas"]
        names = ("mass", "smoothing_length", "density")
        assert_reads(gas, position=rows[:, :3], **dict(zip(names, rows.T[3:6])))
    with_units = Snapshot(files / "b03_splash.ascii")["gas"]
    assert_units(with_units, position="au", smoothing_length="au", velocity="km/s", internal_energy="erg/g")
    assert_reads(with_units, velocity=np.tile([0, 1, 0], (200, 1)), internal_energy=1e9)


@of("b06_dualsphysics_csv")
def semicolons_counts_and_decimal_commas_are_read(files):
    for name in ("b06_dual.csv", "b06_dual_counts.csv", "b06_decimal_commas.csv"):
        lines = (files / name).read_text().replace(",", ".").split("\n")
        first = next(i for i, line in enumerate(lines) if line.startswith("Pos.x")) + 1
        rows = np.loadtxt(lines[first:], delimiter=";")
        assert rows.shape == (100, 8)
        gas = Snapshot(files / name)["gas"]
        assert_reads(gas, position=rows[:, :3], velocity=rows[:, 4:7], Idp=rows[:, 3], Rhop=rows[:, 7])
        assert_units(gas, position="m", velocity="m/s", Rhop="kg/m^3")


@of("b07_counts_first")
def lines_of_counts_are_no_particles(files):
    points = np.loadtxt(files / "b07_points.xyz", skiprows=2, usecols=(1, 2, 3))
    assert_reads(Snapshot(files / "b07_points.xyz")["gas"], position=points)

    three = files / "b07_three_numbers_first.txt"
    with pytest.raises(DataError, match=r"without a header.*read\.columns"):
        Snapshot(three)
    for read in ({"columns": list("xyz")}, {"columns": list("xyz"), "skip_lines": 1}):
        assert_reads(Snapshot(three, read=read)["gas"], position=np.loadtxt(three, skiprows=1))

    fortran = files / "b07_gradsph.dat"
    rows = np.loadtxt(fortran, skiprows=4)
    names = ["x", "y", "z", *"----", "h", "mass", "-", "-"]
    gas = Snapshot(fortran, read={"columns": names})["gas"]
    assert_reads(gas, position=rows[:, :3], smoothing_length=rows[:, 7], mass=rows[:, 8])
    with pytest.raises(DataError, match=r"line 2: found 2 values, expected 3.*read\.skip_lines"):
        Snapshot(fortran, read={"columns": list("xyz")})["gas"]["position"]


@of("b08_ecsv_and_friends")
def the_tables_of_astropy_are_read(files):
    table = pytest.importorskip("astropy.table").QTable.read(files / "b08_table.ecsv")
    position = np.column_stack([table[axis].to_value("kpc") for axis in "xyz"])
    mass, h = table["mass"].to_value("Msun"), table["hsml"]
    for name in ("table.ecsv", "ipac.txt", "mrt.txt", "table.hdf5"):
        gas = Snapshot(files / f"b08_{name}")["gas"]
        assert_reads(gas, position=position, mass=mass, smoothing_length=h.to_value("kpc"))
        assert_units(gas, position="kpc", mass="solMass", smoothing_length="kpc")
    for name in ("commented_header", "csv", "fixed_width", "rst", "tab"):
        gas = Snapshot(files / f"b08_{name}.txt")["gas"]
        assert_reads(gas, position=position, mass=mass, smoothing_length=h.to_value("pc"))
        assert set(gas.fields.values()) == {""}
    assert_reads(Snapshot(files / "b08_savetxt.txt")["gas"], position=position, mass=1)
    assert mass.sum() == mass_in_map(files / "b08_table.ecsv", (0, 0, 0), 8)


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
def test_tables_that_are_not_read_are_refused_with_advice(files, program, command, name, advice):
    endings = {"map": "npy", "render": "png", "movie": "mp4"}
    output = ["-o", files / f"no.{endings[command]}"] if command in endings else []
    says = refusal_of(command, files / f"b08_{name}", *output)
    assert advice in says
    assert "scene file" not in says


@of("b10_other_hdf5")
def hdf5_of_other_programs_is_read(files):
    steps = files / "b10_h5part.h5"
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

    records = hdf5(files / "b10_compound.hdf5", "particles")
    gas = Snapshot(files / "b10_compound.hdf5")["gas"]
    x = np.column_stack([records[axis] for axis in "xyz"])
    assert_reads(gas, position=x, mass=records["mass"], id=records["id"])

    plasma = files / "b10_openpmd.h5"
    electrons = Snapshot(plasma)["gas"]
    x = np.column_stack([hdf5(plasma, f"data/100/particles/e/position/{axis}") for axis in "xyz"])
    assert_reads(electrons, position=x)
    assert_units(electrons, position="1e-06 m")

    columns = files / "b10_three_by_n.hdf5"
    assert_reads(Snapshot(columns)["gas"], position=hdf5(columns, "pos").T, mass=hdf5(columns, "mass"))


def tipsy_rows(path, order, position, *further):
    """After a header of 32 bytes, or of 28 where it has no pad."""
    vectors = [("mass", order + "f4"), ("pos", order + position, 3), ("vel", order + "f4", 3)]
    layout = np.dtype(vectors + [(name, order + "f4") for name in further])
    return np.fromfile(path, layout, offset=28 if "nopad" in path.name else 32)


@of("b11_tipsy")
def tipsy_of_other_habits_is_read(files):
    of_stars, of_halo = ("metals", "tform", "eps", "phi"), ("eps", "phi")
    layouts = {"stars.std": (">", "f4", *of_stars), "stars.nat": ("<", "f4", *of_stars),
               "double.std": (">", "f8", *of_halo), "nopad.std": (">", "f4", *of_halo),
               "aux.std": (">", "f4", *of_halo)}
    for name, layout in layouts.items():
        path = files / f"b11_{name}"
        rows = tipsy_rows(path, *layout)
        snapshot = Snapshot(path)
        kind = "stars" if name.startswith("stars") else "halo"
        assert counts_of(snapshot) == {kind: 300}
        assert snapshot.time == 0.5
        assert_reads(snapshot[kind], position=rows["pos"], mass=rows["mass"], velocity=rows["vel"])
    lengths = np.loadtxt(files / "b11_aux.std.smooth", skiprows=1)
    auxiliary = Snapshot(files / "b11_aux.std")
    assert_reads(auxiliary["halo"], smoothing_length=2 * lengths)
    assert has_note(auxiliary, "b11_aux.std.den left out", "2404 bytes, expected 1204")
    assert 1 == mass_in_map(files / "b11_aux.std", (0, 0, 0), 1.5)


def colors_between(places, colors):
    """256 colors between knots."""
    at = np.linspace(0, 1, 256)
    return np.column_stack([np.interp(at, places, channel) for channel in np.transpose(colors)])


def palettes_of(colors):
    """What each form of the same color map is, by the names of files."""
    even = np.linspace(0, 1, len(colors))
    in_bytes = np.round(colors * 255) / 255
    exact, rounded = colors_between(even, colors), colors_between(even, in_bytes)
    of_floats = ("01.txt", "alpha.txt", "commas.txt", "ds9.lut", "map.npy", "names.csv", "paraview.json",
                 "paraview.xml")
    of_bytes = ("255.txt", "gimp.gpl", "gmt.cpt", "hex.txt", "ncl.rgb")
    palettes = dict.fromkeys(of_floats, exact) | dict.fromkeys(of_bytes, rounded)
    palettes |= dict.fromkeys(("imagej.lut", "photoshop.act"), np.repeat(in_bytes, 16, axis=0))
    # The first column of one is a place for each color; the other has red and green alike.
    palettes["positions.txt"] = colors_between(even**2, colors)
    palettes["ds9.sao"] = colors_between([0, 1], [[0, 0, 1], [1, 1, 0]])
    return palettes


@of("d01_palettes")
def color_maps_of_all_forms_are_read(files):
    palettes = palettes_of(np.load(files / "d01_map.npy"))
    names = {path.name for path in files.glob("d01_*")}
    assert names == {f"d01_{name}" for name in palettes}
    for name, wanted in palettes.items():
        # Colors of uneven places become 1024 of even ones.
        nearly = 3e-3 if name == "positions.txt" else 2e-5
        read = np.array(_core.palette_colors(str(files / f"d01_{name}"), 1))
        np.testing.assert_allclose(read, wanted, atol=nearly, err_msg=name)


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
def gadget_of_other_habits_is_read(files):
    counts = {"gas": 300, "halo": 500, "stars": 100}
    paths = sorted(files.glob("g01_f*"))
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
    more = Snapshot(files / "g01_f2_metals_half")
    assert_reads(more["gas"], temperature=1e4)
    assert_reads(more["stars"], stellar_age=0.5, iM=0.5)
    assert has_note(more, "block Zs left out") and has_note(more, "block CLDX left out")
    for member in (0, 1):
        both = Snapshot(files / "g01_one_of_one" / f"snap_005.{member}")
        assert counts_of(both) == {name: 2 * count for name, count in counts.items()}
        assert has_note(both, "read together")
    assert 600 * 2 == mass_in_map(files / "g01_one_of_one" / "snap_005.0", (50, 50, 50), 60, types="gas")


@of("q01_ids_in_conditions")
def identifiers_beyond_floats_select_exactly(files):
    path = files / "q01_ids.hdf5"
    ids = hdf5(path, "PartType0/ParticleIDs")
    np.testing.assert_array_equal(Snapshot(path)["gas"]["id"], ids)
    masks = {"ParticleIDs <= 2000000000": ids <= 2000000000, "ParticleIDs > 2000000000": ids > 2000000000,
             "id == 1999999900": ids == 1999999900}
    assert [np.count_nonzero(mask) for mask in masks.values()] == [200, 200, 1]
    for condition, mask in masks.items():
        assert_draws_alone(path, condition, mask, h=2)


@of("z01_headers")
def headers_of_other_habits_are_understood(files):
    notes = {"overflow": "NumPart_Total", "total_small": "total number of particles (400)",
             "files_8": "8 files"}
    lower = files / "z01_lower_case.hdf5"
    paths = set(files.glob("z01_*.hdf5")) - {lower}
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


@pytest.mark.parametrize("generator", sorted(CHECKS.keys() | SCRIPTS.keys()))
def test_what_a_generator_made_is_read_as_it_is(generator, files, program, renderer):
    if generator not in SCRIPTS:
        pytest.skip(f"no generator {generator} in the folder SPLOTCHCL_TEST_DATA/odd")
    CHECKS[generator](files)
