"""Units that a file does not say, named on the command line, in scenes and in Python, also for conditions."""

import json

import numpy as np
import pytest
import splotchcl
from splotchcl import Snapshot, UsageError


@pytest.fixture(scope="module")
def half(universe):
    """A condition in Mpc that half of the gas fulfils, the same in the file's numbers, and how many do."""
    gas = Snapshot(universe)["gas"]
    x = gas["position"][:, 0].astype(float)
    middle = float(np.median(x))
    described = Snapshot(universe)._describe()
    to_mpc = 1e-3 / described["hubble_parameter"] / (1 + (described["redshift"] or 0))
    return f"x < {middle * to_mpc!r} Mpc", f"x < {middle!r}", np.count_nonzero(x < middle)


def drawn(program, folder, universe, *options):
    """How many particles of gas a picture shows."""
    stats = folder / "stats.json"
    program("render", universe, "--types", "gas", "--size", "32x32", *options,
            "--center", "box", "--stats", stats, "-o", folder / "picture.png")
    return json.loads(stats.read_text())["particles"]


def test_pictures_select_in_units_of_a_system(program, renderer, universe, half, tmp_path):
    in_mpc, in_numbers, count = half
    named = drawn(program, tmp_path, universe, "--units", "gadget", "--where", in_mpc)
    assert named == drawn(program, tmp_path, universe, "--where", in_numbers)
    assert named["total"] == pytest.approx(count, abs=2)


def test_maps_select_in_units_of_a_system(program, renderer, universe, half, tmp_path):
    in_mpc, in_numbers, _ = half
    for name, options in {"named": ["--where", in_mpc], "numbers": ["--where", in_numbers]}.items():
        program("map", universe, "--types", "gas", "--units", "gadget", "--unit", "Msun/pc^2", "--size", "16x16",
                *options, "-o", tmp_path / f"{name}.npy")
    named, numbers = (np.load(tmp_path / f"{name}.npy") for name in ("named", "numbers"))
    np.testing.assert_allclose(named, numbers, rtol=1e-3)
    assert 0 < np.nansum(named)


def test_scenes_and_python_name_a_system(renderer, universe, half, tmp_path):
    in_mpc, in_numbers, _ = half
    place = {"center": "box", "types": "gas", "size": (16, 16)}
    expected = splotchcl.column(universe, where=in_numbers, **place).values
    by_setting = splotchcl.column(universe, where=in_mpc, settings={"read.units": "gadget"}, **place)
    by_snapshot = splotchcl.column(Snapshot(universe, read={"units": "gadget"}), where=in_mpc, **place)
    scene = tmp_path / "scene.toml"
    scene.write_text(f'snapshot = "{universe}"\nimage.size = "16x16"\n[read]\nunits = "gadget"\n'
                     f'[[component]]\ntypes = "gas"\nselect.where = "{in_mpc}"\n')
    by_scene = splotchcl.column(scene, center="box", size=(16, 16))
    for drawn_map in (by_setting, by_snapshot, by_scene):
        np.testing.assert_allclose(drawn_map.values, expected, rtol=1e-5)
        assert drawn_map.length_unit == "Mpc"


def test_formulas_have_the_units_of_a_system(renderer, universe):
    options = {"types": "gas", "size": (8, 8), "settings": {"read.units": "gadget"}}
    velocity = splotchcl.column(universe, field="sqrt(vx * vx)", **options)
    assert velocity.unit == "a^0.5 km/s"
    thermal = splotchcl.column(universe, field="internal_energy", unit="erg/g", **options)
    plain = splotchcl.column(universe, field="internal_energy", types="gas", size=(8, 8))
    np.testing.assert_allclose(thermal.values, 1e10 * plain.values, rtol=1e-5)


def test_units_of_a_system_are_needed_for_conditions_in_units(renderer, universe, half):
    with pytest.raises(UsageError, match="name the units of its fields as read.units"):
        splotchcl.column(universe, where=half[0], types="gas", size=(8, 8))


# An index tells which parts of a file are in sight; one of another step would hide what is there.
def test_an_index_of_one_step_does_not_hide_another(program, renderer, tmp_path):
    h5py = pytest.importorskip("h5py")
    random = np.random.default_rng(1)
    path = tmp_path / "steps.h5"
    with h5py.File(path, "w") as file:
        for step in (0, 1):
            x = random.normal(3 * step, 0.1, (20000, 3)).astype(np.float32)
            for axis in range(3):
                file[f"Step#{step}/{'xyz'[axis]}"] = x[:, axis]
            file[f"Step#{step}/h"] = np.full(len(x), 0.05, np.float32)
    program("index", path / "Step#0")
    drawn_map = splotchcl.column(path / "Step#1", field="counts", center=(3, 3, 3), width=2, size=(8, 8))
    assert drawn_map.values.sum(dtype=float) == pytest.approx(20000, rel=1e-3)
    picture = splotchcl.render(path / "Step#1", size=(8, 8), center=(3, 3, 3), width=0.1)
    assert picture.stats["drawn_particles"] > 0
