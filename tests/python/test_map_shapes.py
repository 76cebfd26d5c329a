"""Spheres, skies, voxels, profiles and histograms against sums that nothing approximates."""

import math

import numpy as np
import pytest

import exact_cells as exact
import splotchcl
from conftest import make_arrays
from splotchcl import Particles, UsageError

ORIGIN = [0.0, 0.0, 0.0]


def matter(seed, count=60, least=1e-2, most=3.0, half=1.0):
    """Around the origin; positions as single precision has them."""
    random = np.random.default_rng(seed)
    return {
        "position": random.uniform(-half, half, (count, 3)).astype(np.float32),
        "smoothing_length": (10 ** random.uniform(*np.log10([least, most]), count)).astype(np.float32),
        "mass": (10 ** random.uniform(0, 2, count)).astype(np.float32),
        "charge": random.normal(0, 1, count).astype(np.float32),
    }


def drawn(arrays, field=None, box=None, **what):
    what = {"center": ORIGIN, "tolerance": 1e-3, **what}
    settings = {"map.periodic": box is not None, **what.pop("settings", {})}
    gas = Particles(box_size=box).gas(**arrays)
    return splotchcl.column(gas, field, types="gas", settings=settings, **what)


def doubles(arrays):
    return [arrays[name].astype(float) for name in ("position", "smoothing_length", "mass", "charge")]


def worst(found, wanted, floor=1e-3, size=None):
    """Relative to the value, or to a part of the mean of these sizes."""
    size = np.abs(wanted) if size is None else size
    return float((np.abs(found - wanted) / np.maximum(size, floor * size.mean())).max())


# Voxels.


@pytest.mark.parametrize("seed", range(8))
def test_voxels_have_the_integral_of_each_kernel(seed):
    random = np.random.default_rng(seed)
    shape = [int(n) for n in random.integers(3, 12, 3)]
    width = 1.0 + random.random()
    side = np.float32(width) / shape[0]
    arrays = matter(seed, least=1e-3 * side, most=1e2 * side)
    box = [2.0, 2.5, 3.0] if seed % 2 else None
    found = drawn(arrays, voxels=shape, width=width, box=box)
    edges = [width / shape[0] * (np.arange(n + 1) - n / 2) for n in shape]
    position, h, mass, _ = doubles(arrays)
    wanted = exact.in_voxels(position, h, mass, edges, None if box is None else np.array(box))
    assert found.values.shape == tuple(reversed(shape))
    volume = (width / shape[0]) ** 3
    assert worst(found.values * volume, wanted) < 1e-5
    assert [len(e) for e in found.edges] == [n + 1 for n in shape]
    assert found.edges[0] == pytest.approx(edges[0])


def test_voxels_of_a_box_have_all_of_its_mass():
    arrays = matter(3, least=1e-3, most=10.0)
    cube = drawn(arrays, voxels=17, box=[2.0, 2.0, 2.0])
    volume = (2.0 / 17) ** 3
    assert cube.values.sum(dtype=float) * volume == pytest.approx(arrays["mass"].sum(dtype=float), rel=1e-6)


@pytest.mark.parametrize("statistic", ["mean", "dispersion"])
def test_voxels_have_weighted_means_of_fields_of_both_signs(statistic):
    arrays = matter(5, least=0.3)
    found = drawn(arrays, "charge", voxels=6, width=2.0, statistic=statistic).values
    position, h, mass, charge = doubles(arrays)
    edges = [np.linspace(-1, 1, 7)] * 3
    weight, first, second = (exact.in_voxels(position, h, mass * charge**n, edges) for n in range(3))
    mean = first / weight
    wanted = mean if statistic == "mean" else np.sqrt(second / weight - mean**2)
    assert found == pytest.approx(wanted, abs=1e-5)


def test_voxels_for_openvdb_are_those_of_the_array(program, universe, tmp_path):
    openvdb, h5py = pytest.importorskip("pyopenvdb"), pytest.importorskip("h5py")
    cube = ["map", universe, "--types", "gas", "--voxels", "7,6,5"]
    program(*cube, "-o", tmp_path / "cube.npy")
    program(*cube, "-o", tmp_path / "cube.hdf5")
    try:
        program(*cube, "-o", tmp_path / "cube.vdb")
    except AssertionError as missing:
        pytest.skip(str(missing)) if "libsplotchcl_openvdb" in str(missing) else pytest.fail(str(missing))
    grid = openvdb.readAll(str(tmp_path / "cube.vdb"))[0][0]
    found = np.zeros((7, 6, 5), np.float32)
    grid.copyToArray(found)
    assert np.array_equal(found.transpose(2, 1, 0), np.load(tmp_path / "cube.npy"))
    with h5py.File(tmp_path / "cube.hdf5") as file:
        for axis, name in enumerate(("x_edges", "y_edges", "z_edges")):
            edges = file[name][:]
            place = grid.transform.indexToWorld((3, 2, 1))[axis]
            at = (3, 2, 1)[axis]
            assert place == pytest.approx(0.5 * (edges[at] + edges[at + 1]))
        assert grid["unit"] == file["map"].attrs["unit"].decode()


def test_voxels_without_matter_have_no_mean():
    arrays = matter(5, least=1e-3, most=2e-3)
    assert np.isnan(drawn(arrays, "charge", voxels=6, width=2.0).values).any()


# Profiles.


@pytest.mark.parametrize("seed", range(6))
def test_profiles_have_the_kernels_between_spheres(seed):
    arrays = matter(seed, least=1e-3, most=30.0)
    if seed == 0:
        arrays["position"][0] = 0
    found = drawn(arrays, profile=12, shell=(1e-2, 1.5))
    position, h, mass, _ = doubles(arrays)
    edges = np.geomspace(1e-2, 1.5, 13)
    assert found.edges[0] == pytest.approx(edges)
    wanted = exact.in_shells(np.linalg.norm(position, axis=1), h, mass, edges)
    volume = 4 * math.pi / 3 * np.diff(edges**3)
    assert worst(found.values, wanted / volume, floor=1e-9) < 1e-6


def test_profiles_have_all_of_the_mass():
    arrays = matter(9, least=1e-3, most=0.5)
    found = drawn(arrays, "counts", profile=9, shell=(1e-9, 100.0))
    assert found.values.sum(dtype=float) == pytest.approx(len(arrays["mass"]), rel=1e-6)


def test_profiles_have_means_by_weights():
    arrays = matter(2)
    position, h, mass, charge = doubles(arrays)
    edges = np.geomspace(1e-2, 1.5, 6)
    distance = np.linalg.norm(position, axis=1)
    weight, top = (exact.in_shells(distance, h, m, edges) for m in (mass, mass * charge))
    found = drawn(arrays, "charge", profile=5, shell=(1e-2, 1.5)).values
    assert found == pytest.approx(top / weight, abs=1e-5)


def test_a_profile_of_a_periodic_box_sees_images_across_its_faces():
    arrays = matter(4, least=0.05, most=0.2)
    near = drawn(arrays, profile=8, shell=(0.1, 1.8), box=[2.0, 2.0, 2.0]).values
    shifts = [np.array(s) * 2.0 for s in np.ndindex(3, 3, 3)]
    tiled = {name: np.concatenate([values] * 27) for name, values in arrays.items()}
    tiled["position"] = np.concatenate([arrays["position"] + (s - 2).astype(np.float32) for s in shifts])
    assert near == pytest.approx(drawn(tiled, profile=8, shell=(0.1, 1.8)).values, rel=1e-5)


def test_inflow_is_a_profile_of_negative_velocities():
    arrays = matter(1, least=0.01, most=0.02)
    arrays["velocity"] = -arrays["position"]
    found = drawn(arrays, "line_of_sight_velocity", profile=4, shell=(0.3, 1.2))
    middles = np.sqrt(found.edges[0][1:] * found.edges[0][:-1])
    assert (found.values < 0).all()
    assert -found.values == pytest.approx(middles, rel=0.3)


def test_our_gaussian_is_near_a_cubic_spline_of_the_same_reach():
    arrays = {name: values[:1] for name, values in matter(1).items()}
    arrays["position"][:] = [0.4, 0, 0]
    arrays["smoothing_length"][:] = 1
    arrays["mass"][:] = 1
    found = drawn(arrays, "counts", profile=4, shell=(0.1, 1.0))
    edges = found.edges[0]
    wanted = [exact.spline_in_shell(0.4, low, high) for low, high in zip(edges[:-1], edges[1:])]
    assert found.values == pytest.approx(wanted, abs=0.02)


# Spheres.


def on_sphere(arrays, nside, fine=16):
    """Means of what is seen over pixels, by many smaller ones."""
    healpy = pytest.importorskip("healpy")
    position, h, mass, _ = doubles(arrays)
    small = nside * fine
    directions = np.array(healpy.pix2vec(small, np.arange(12 * small**2), nest=True)).T
    nested = np.zeros(12 * nside**2)
    for place, length, m in zip(position, h, mass):
        nested += m * exact.seen_from_origin(place, float(length), directions).reshape(-1, fine**2).mean(1)
    return healpy.reorder(nested, n2r=True)


@pytest.mark.parametrize("seed", range(3))
def test_pixels_of_a_sphere_have_what_is_seen_of_kernels(seed):
    arrays = matter(seed, count=12, least=0.8, most=8.0)
    arrays["position"] += np.sign(arrays["position"]) * np.float32(0.3)
    found = drawn(arrays, healpix=4)
    assert found.unit == "code_mass/sr"
    assert worst(found.values, on_sphere(arrays, 4)) < 1e-3


def test_a_sphere_has_weighted_means_of_fields_of_both_signs():
    arrays = matter(4, count=12, least=0.8, most=8.0)
    arrays["position"] += np.sign(arrays["position"]) * np.float32(0.3)
    weight, top, size = (
        on_sphere(arrays | {"mass": arrays["mass"] * factor}, 4)
        for factor in (np.float32(1), arrays["charge"], np.abs(arrays["charge"]))
    )
    found = drawn(arrays, "charge", healpix=4).values
    assert worst(found * weight, top, size=size) < 3e-3


def test_the_origin_may_lie_within_a_kernel():
    arrays = matter(8, count=3, least=3.0, most=9.0, half=0.5)
    assert worst(drawn(arrays, healpix=4).values, on_sphere(arrays, 4)) < 1e-3


@pytest.mark.parametrize(("field", "statistic"), [(None, None), ("charge", "mean")])
@pytest.mark.parametrize("shape", [{"healpix": 8}, {"view": "sky", "size": (36, 18)}])
def test_wide_particles_are_summed_up_at_points_within_the_tolerance(shape, field, statistic):
    arrays = matter(7, count=500, least=0.5, most=5.0)
    exactly, *quickly = (drawn(arrays, field, statistic=statistic, tolerance=t, **shape).values
                         for t in (0, 1e-2, 1e-3))
    size = np.ones(1) if field else exactly
    for found, tolerance in zip(quickly, (1e-2, 1e-3)):
        assert (found != exactly).any()
        assert worst(found, exactly, size=size) < tolerance


@pytest.mark.parametrize("order", ["ring", "nested"])
def test_a_small_particle_is_in_the_pixel_of_its_direction(order):
    healpy = pytest.importorskip("healpy")
    arrays = matter(2, count=5000, least=1e-6, most=1e-5)
    found = drawn(arrays, "counts", healpix=64, order=order).values
    pixels = healpy.vec2pix(64, *arrays["position"].astype(float).T, nest=order == "nested")
    counts = np.bincount(pixels, minlength=12 * 64**2)
    # Few lie so near to an edge that both pixels have some.
    assert (np.abs(found - counts) > 1e-6).sum() < 60
    assert found.sum(dtype=float) == pytest.approx(5000, rel=1e-6)


@pytest.mark.parametrize("nside", [1, 8, 32])
@pytest.mark.parametrize("box", [None, [2.0, 2.0, 2.0]])
def test_a_sphere_has_all_of_the_mass(nside, box):
    arrays = matter(nside, least=1e-3, most=3.0)
    found = drawn(arrays, healpix=nside, box=box)
    total = found.values.sum(dtype=float) * 4 * math.pi / (12 * nside**2)
    assert total == pytest.approx(arrays["mass"].sum(dtype=float), rel=1e-6)


def test_a_shell_has_the_particles_between_its_radii():
    arrays = matter(6)
    distance = np.linalg.norm(arrays["position"].astype(float), axis=1)
    inside = (distance >= 0.5) & (distance < 1.0)
    found = drawn(arrays, "counts", healpix=4, shell=(0.5, 1.0))
    assert found.values.sum(dtype=float) == pytest.approx(inside.sum(), rel=1e-6)


def test_a_tiled_shell_has_images_beyond_the_box():
    arrays = matter(6, count=20, least=0.01, most=0.1)
    box = [2.0, 2.0, 2.0]
    places = [arrays["position"].astype(float) + 2.0 * (np.array(s) - 4) for s in np.ndindex(9, 9, 9)]
    distance = np.linalg.norm(np.concatenate(places), axis=1)
    found = drawn(arrays, "counts", healpix=4, shell=(3.0, 6.0), tile=True, box=box)
    assert found.values.sum(dtype=float) == pytest.approx(((distance >= 3) & (distance < 6)).sum(), rel=1e-6)


def test_healpy_reads_a_sphere(tmp_path):
    healpy = pytest.importorskip("healpy")
    found = drawn(matter(1), healpix=32, order="nested")
    found.save(tmp_path / "sky.fits")
    found.save(tmp_path / "sky.npy")
    read, header = healpy.read_map(tmp_path / "sky.fits", nest=True, h=True)
    assert np.array_equal(read, found.values)
    assert dict(header)["ORDERING"] == "NESTED" and dict(header)["TUNIT1"] == "code_mass/sr"
    assert np.array_equal(np.load(tmp_path / "sky.npy"), found.values)


# Skies.


@pytest.mark.parametrize(("projection", "width", "size"), [("TAN", "60deg", (15, 9)), ("CAR", 360.0, (24, 12))])
def test_a_sky_has_what_is_seen_of_kernels(tmp_path, projection, width, size):
    fits = pytest.importorskip("astropy.io.fits")
    wcs = pytest.importorskip("astropy.wcs")
    arrays = matter(3, count=5, least=2.0, most=6.0)
    arrays["position"] += np.sign(arrays["position"]) * np.float32(0.3)
    place = {"map.sky": [40.0, 20.0 if projection == "TAN" else 0.0]}
    found = drawn(arrays, view="sky", width=width, size=size, settings=place)
    found.save(tmp_path / "sky.fits")
    hdu = fits.open(tmp_path / "sky.fits")[0]
    axes = wcs.WCS(hdu.header)
    assert list(axes.wcs.ctype) == [f"RA---{projection}", f"DEC--{projection}"]
    position, h, mass, _ = doubles(arrays)
    parts = (np.arange(24) + 0.5) / 24 - 0.5
    for x, y in [(0, 0), (7, 4), (14, 8), (3, 6)]:
        fine_x, fine_y = (p.ravel() for p in np.meshgrid(x + parts, y + parts))
        longitude, latitude = np.radians(axes.pixel_to_world_values(fine_x, fine_y))
        directions = np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude),
                               np.sin(latitude)], axis=1)
        areas = np.cos(latitude)
        if projection == "TAN":
            middle = np.radians(place["map.sky"])
            axis = [math.cos(middle[1]) * math.cos(middle[0]), math.cos(middle[1]) * math.sin(middle[0]),
                    math.sin(middle[1])]
            areas = (directions @ axis) ** 3
        seen = sum(m * exact.seen_from_origin(p, float(s), directions) for p, s, m in zip(position, h, mass))
        assert hdu.data[y, x] == pytest.approx((seen * areas).sum() / areas.sum(), rel=2e-3)


def test_an_angle_is_what_is_seen_under_it_from_a_distance(program, universe, tmp_path):
    fits = pytest.importorskip("astropy.io.fits")
    program("map", universe, "--types", "gas", "--units", "gadget", "--distance", "10Mpc", "--width", "2deg",
            "--size", "8x8", "-o", tmp_path / "map.fits")  # fmt: skip
    header = fits.getheader(tmp_path / "map.fits")
    assert 8 * header["CDELT2"] == pytest.approx(np.degrees(2 * math.tan(math.radians(1))), rel=1e-6)


# Histograms.


@pytest.mark.parametrize("quantity", [None, "counts", "charge"])
def test_a_histogram_has_each_particle_in_one_bin(quantity):
    arrays = make_arrays(500) | {"charge": np.arange(500, dtype=np.float32)}
    found = drawn(arrays, quantity, histogram=("x", "temperature"), bins=(7, 5))
    x, t = arrays["position"][:, 0].astype(float), np.log(arrays["temperature"].astype(float))
    edges = found.edges[0], np.log(found.edges[1])
    edges[1][[0, -1]] += [-1e-9, 1e-9]

    def bins(weights):
        inside = np.clip(np.searchsorted(edges[0], x, side="right") - 1, 0, 6)
        rows = np.clip(np.searchsorted(edges[1], t, side="right") - 1, 0, 4)
        return np.bincount(rows * 7 + inside, weights, minlength=35).reshape(5, 7)

    mass = arrays["mass"].astype(float)
    with np.errstate(invalid="ignore"):
        wanted = {None: bins(mass), "counts": bins(np.ones(500)),
                  "charge": bins(mass * arrays["charge"]) / bins(mass)}[quantity]
    assert found.values == pytest.approx(wanted, rel=1e-6, nan_ok=True)
    assert found.axes == ("x", "temperature") and found.axis_units == ("code_length", "code_temperature")


def test_a_histogram_has_the_extent_of_its_bins():
    arrays = make_arrays(100) | {"charge": np.linspace(-1, 1, 100, dtype=np.float32)}
    found = drawn(arrays, "counts", histogram=("charge", "temperature"), bins=4)
    temperature = np.log10(arrays["temperature"][[arrays["temperature"].argmin(), arrays["temperature"].argmax()]])
    assert found.extent == pytest.approx([-1, 1, *temperature], rel=1e-6)


@pytest.mark.parametrize("what", [{"healpix": 2}, {"profile": 2}, {"view": "sky", "size": (16, 8)}])
def test_shapes_without_squares_have_no_extent(what):
    found = drawn(matter(1), **what)
    for name in ("extent", "pixel"):
        with pytest.raises(UsageError, match="has none"):
            getattr(found, name)


def test_particles_outside_of_a_histogram_are_noted():
    settings = {"map.x_range": [5.0, 100.0]}
    found = drawn(make_arrays(100), "counts", histogram=("x", "temperature"), bins=4, settings=settings)
    outside = 100 - int(found.values.sum())
    assert outside > 0
    assert any(f"{outside} of 100" in note for note in found.notes)


# Files.


def test_files_of_voxels_have_axes(tmp_path):
    h5py = pytest.importorskip("h5py")
    fits = pytest.importorskip("astropy.io.fits")
    wcs = pytest.importorskip("astropy.wcs")
    cube = drawn(matter(1), voxels=[4, 5, 6], width=2.0)
    for ending in ("h5", "fits", "npy"):
        cube.save(tmp_path / f"cube.{ending}")
    stored = h5py.File(tmp_path / "cube.h5")
    assert np.array_equal(stored["map"][:], cube.values)
    assert stored["z_edges"][:] == pytest.approx(cube.edges[2])
    hdu = fits.open(tmp_path / "cube.fits")[0]
    assert np.array_equal(hdu.data, cube.values)
    first = wcs.WCS(hdu.header).pixel_to_world_values(0, 0, 0)
    assert [float(x) for x in first] == pytest.approx([0.5 * (e[0] + e[1]) for e in cube.edges])
    assert np.array_equal(np.load(tmp_path / "cube.npy"), cube.values)


def test_a_profile_is_a_table(tmp_path):
    found = drawn(matter(1), profile=5, shell=(0.1, 1.0))
    found.save(tmp_path / "p.csv")
    found.save(tmp_path / "p.npy")
    table = np.loadtxt(tmp_path / "p.csv", delimiter=",", skiprows=1)
    assert table[:, 2] == pytest.approx(found.values)
    assert np.load(tmp_path / "p.npy")[:, 1] == pytest.approx(found.edges[0][1:])


def test_astropy_reads_the_table_of_a_profile(tmp_path):
    pytest.importorskip("yaml")
    table = pytest.importorskip("astropy.table")
    found = drawn(matter(1), profile=5, shell=(0.1, 1.0))
    found.save(tmp_path / "p.ecsv")
    read = table.Table.read(tmp_path / "p.ecsv")
    assert list(read["value"]) == pytest.approx(found.values)
    assert read.meta["splotchcl:scene"].startswith("[") or "map" in read.meta["splotchcl:scene"]


@pytest.mark.parametrize("what", [{"healpix": 8}, {"profile": 9, "shell": (0.1, 1.0)},
                                  {"histogram": ("x", "charge"), "bins": 16}])
@pytest.mark.parametrize("ending", ["png", "pdf"])
def test_shapes_have_figures(tmp_path, what, ending):
    found = drawn(matter(1), size=(300, 200), **what)
    found.save(tmp_path / f"figure.{ending}")
    assert (tmp_path / f"figure.{ending}").stat().st_size > 1000


# Refusals.


@pytest.mark.parametrize(("wrong", "words"), [
    ({"healpix": 12}, "power of two"),
    ({"healpix": 4, "voxels": 4}, "found both"),
    ({"healpix": 4, "tile": True}, "map.shell"),
    ({"voxels": 4, "shell": (0, 1)}, "map.shell"),
    ({"profile": 4, "shell": (0, 1)}, "more than 0"),
    ({"healpix": 4, "shell": (2, 1)}, "rising"),
    ({"healpix": 4, "slice": True}, "map.slice"),
    ({"voxels": 4, "noise": True}, "map.noise"),
    ({"voxels": 4, "field": "charge", "statistic": "integral"}, "integral"),
    ({"voxels": 4, "depth": 1.0}, "map.depth"),
    ({"voxels": 8192}, "GB of memory"),
    ({"voxels": [4, 0, 4]}, "map.voxels"),
    ({"voxels": 0}, "voxels: found 0, expected at least 1"),
    ({"voxels": 3.5}, "map.voxels: found floating-point 3.5"),
    ({"histogram": ("x", "y"), "bins": 2.5}, "map.bins: found floating-point 2.5"),
    ({"profile": 0}, "profile: found 0, expected at least 1"),
    ({"center": [1.0, 2.0]}, "map.center"),
    ({"histogram": ("x",)}, "expected two"),
    ({"histogram": ("x", "nothing")}, "nothing"),
    ({"width": "2deg"}, "an angle"),
    ({"view": "sky", "width": "2Mpc"}, "expected an angle"),
    ({"view": "sky", "width": 400.0}, "at most 360"),
])  # fmt: skip
def test_wrong_shapes_are_refused(wrong, words):
    with pytest.raises(UsageError, match=words):
        drawn(matter(1), **wrong)


@pytest.mark.parametrize("what", [
    {"voxels": 4}, {"healpix": 4}, {"profile": 4}, {"histogram": ("x", "y"), "bins": 4},
], ids=lambda what: next(iter(what)))  # fmt: skip
def test_whole_numbers_may_be_those_of_numpy(what):
    of_numpy = {name: np.int64(value) if value == 4 else value for name, value in what.items()}
    assert np.array_equal(drawn(matter(1), **of_numpy).values, drawn(matter(1), **what).values, equal_nan=True)


def test_a_profile_is_told_in_the_unit_that_its_radii_have():
    found = drawn(matter(1), profile=4, settings={"map.length_unit": "Mpc"})
    assert found.axis_units == ("Mpc",)


def test_voxels_are_no_picture(tmp_path):
    assert drawn(matter(1), voxels=4)._repr_png_() is None
    with pytest.raises(UsageError, match="planes of map.voxels"):
        drawn(matter(1), voxels=4).save(tmp_path / "cube.png")


def test_the_command_line_makes_each_shape(program, universe, tmp_path):
    for words, shape in [(["--healpix", 4], (192,)), (["--voxels", "4,5,6"], (6, 5, 4)),
                         (["--profile", 7], (7, 3)), (["--histogram", "density,temperature", "--bins", 9], (9, 9)),
                         (["--view", "sky", "--size", "16x8"], (8, 16))]:  # fmt: skip
        program("map", universe, "--types", "gas", *words, "-o", tmp_path / "map.npy")
        assert np.load(tmp_path / "map.npy").shape == shape


def test_scene_files_have_lengths_with_units(program, universe, tmp_path):
    h5py = pytest.importorskip("h5py")
    (tmp_path / "scene.toml").write_text(
        f"snapshot = '{universe}'\n[[component]]\ntypes = 'gas'\n[image]\nsize = [8, 8]\n"
        "[map]\nlength_unit = 'kpc'\nwidth = '2Mpc'\ncenter = '1,1,1Mpc'\n"
    )
    program("map", tmp_path / "scene.toml", "-o", tmp_path / "map.h5")
    attributes = h5py.File(tmp_path / "map.h5")["map"].attrs
    assert attributes["extent"] == pytest.approx([0, 2, 0, 2])
    assert attributes["length_unit"] in (b"Mpc", "Mpc")
