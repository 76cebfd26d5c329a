"""Formulas and conditions, against numpy."""

import numpy as np
import pytest

import splotchcl
from splotchcl import Particles, Snapshot, UsageError

COUNT = 400
# Neighbours in double precision, and none.
LARGE = 9007199254740993


def test_formulas_are_fields_of_snapshots_and_maps(renderer, universe):
    gas = Snapshot(universe)["gas"]
    expected = np.log10(gas["density"].astype(float) * gas["mass"])
    assert np.allclose(gas["log10(density * mass)"], expected, rtol=1e-6)
    drawn = splotchcl.column(universe, "2 * mass", types="gas", size=(32, 32))
    plain = splotchcl.column(universe, "mass", types="gas", size=(32, 32))
    assert np.allclose(drawn.values, 2 * plain.values, rtol=2e-3, equal_nan=True)


def test_a_map_takes_only_what_fulfils_conditions(renderer, universe):
    gas = Snapshot(universe)["gas"]
    wanted = (gas["density"] > np.median(gas["density"])) & (gas["id"] < 5000)
    drawn = splotchcl.column(
        universe, types="gas", size=(32, 32),
        where=f"density > {float(np.median(gas['density']))!r} && ParticleIDs < 5000",
    )
    mass = gas["mass"][wanted].sum(dtype=float)
    assert drawn.values.sum(dtype=float) * drawn.pixel**2 == pytest.approx(mass, rel=5e-3)


@pytest.fixture
def numbered(tmp_path):
    """Gas of SWIFT's kind with large identifiers and haloes."""
    h5py = pytest.importorskip("h5py")
    random = np.random.default_rng(1)
    fields = {
        "Coordinates": random.random((COUNT, 3)),
        "Velocities": random.normal(size=(COUNT, 3)).astype(np.float32),
        "Masses": random.uniform(1, 2, COUNT).astype(np.float32),
        "Density": random.uniform(1, 9, COUNT).astype(np.float32),
        "SmoothingLength": np.full(COUNT, 0.1, np.float32),
        "ParticleIDs": (LARGE - 1 + np.arange(COUNT)).astype(np.uint64),
        "GroupNr": np.resize(np.array([-1, LARGE, LARGE - 1, 3]), COUNT).astype(np.int64),
    }
    path = tmp_path / "snapshot.hdf5"
    with h5py.File(path, "w") as file:
        header = file.create_group("Header").attrs
        counts = np.array([COUNT, 0, 0, 0, 0, 0])
        for name in ("NumPart_ThisFile", "NumPart_Total"):
            header[name] = counts
        header.update(MassTable=np.zeros(6), Time=1.0, NumFilesPerSnapshot=1, BoxSize=1.0)
        for name, values in fields.items():
            file[f"PartType0/{name}"] = values
    return path, fields


def selected(path, where):
    settings = {"component.0.select.where": where}
    return splotchcl.column(path, "counts", size=(8, 8), settings=settings)


@pytest.mark.parametrize(
    ("where", "holds"),
    [
        (f"ParticleIDs <= {LARGE}", lambda f: f["ParticleIDs"] <= np.uint64(LARGE)),
        (f"id == {LARGE} or id == {LARGE + 3}", lambda f: np.isin(f["ParticleIDs"], [LARGE, LARGE + 3])),
        (f"Density > 5 && ParticleIDs != {LARGE}", lambda f: (f["Density"] > 5) & (f["ParticleIDs"] != LARGE)),
        (f"halo_id == {LARGE}", lambda f: f["GroupNr"] == LARGE),
        (f"GroupNr == {LARGE} || GroupNr == 3", lambda f: np.isin(f["GroupNr"], [LARGE, 3])),
        ("halo_id >= 0", lambda f: f["GroupNr"] >= 0),
        ("halo_id == -1", lambda f: f["GroupNr"] == -1),
        ("!(halo_id < 3) && density < 5", lambda f: (f["GroupNr"] >= 3) & (f["Density"] < 5)),
        ("x + y > 1", lambda f: f["Coordinates"][:, 0] + f["Coordinates"][:, 1] > 1),
        ("vx > 0 and vz < 0", lambda f: (f["Velocities"][:, 0] > 0) & (f["Velocities"][:, 2] < 0)),
        ("mass * density^2 > 30", lambda f: f["Masses"] * f["Density"].astype(float) ** 2 > 30),
    ],
)
def test_conditions_hold_for_what_numpy_says(renderer, numbered, where, holds):
    path, fields = numbered
    expected = int(np.count_nonzero(holds(fields)))
    assert 0 < expected < COUNT
    drawn = selected(path, where)
    assert drawn.values.sum(dtype=float) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize(
    ("formula", "value"),
    [
        ("log10(density * mass)", lambda f: np.log10(f["Density"] * f["Masses"].astype(float))),
        ("hypot(vx, vy) / (1 + x)", lambda f: np.hypot(f["Velocities"][:, 0], f["Velocities"][:, 1])
                                              / (1 + f["Coordinates"][:, 0])),
        ("density > 5 ? mass : -mass", lambda f: np.where(f["Density"] > 5, f["Masses"], -f["Masses"])),
        ("mass * (density > 5)", lambda f: f["Masses"] * (f["Density"] > 5)),
        ("-density^2 + 2**3", lambda f: 8 - f["Density"].astype(float) ** 2),
    ],
)
def test_formulas_are_what_numpy_says(numbered, formula, value):
    path, fields = numbered
    found = Snapshot(path)["gas"][formula]
    assert np.allclose(found, value(fields), rtol=1e-6, atol=1e-6)


def test_arrays_have_identifiers_too(renderer):
    random = np.random.default_rng(1)
    particles = Particles().gas(
        position=random.random((COUNT, 3)).astype(np.float32),
        mass=np.ones(COUNT, np.float32),
        smoothing_length=np.full(COUNT, 0.1, np.float32),
        id=np.arange(COUNT),
    )
    drawn = splotchcl.column(particles, "counts", where=f"id < 100 || id / 2 >= {COUNT // 2 - 5}", size=(64, 64))
    around = splotchcl.column(particles, "counts", size=(64, 64))
    share = drawn.values.sum(dtype=float) / around.values.sum(dtype=float)
    assert share == pytest.approx(110 / COUNT, rel=0.2)
    assert any("id was copied" in note for note in drawn.notes)


def test_large_identifiers_are_no_numbers_of_formulas(renderer, numbered):
    with pytest.raises(splotchcl.DataError, match=r"at most 2\^53"):
        selected(numbered[0], "id / 2 > mass")


def test_a_misspelled_field_of_a_formula_is_told(numbered):
    with pytest.raises(UsageError, match="did you mean density"):
        Snapshot(numbered[0])["gas"]["2 * densty"]


def test_fields_in_different_units_are_not_added():
    unyt = pytest.importorskip("unyt")
    gas = Particles().gas(
        position=np.zeros((3, 3), np.float32),
        mass=unyt.unyt_array(np.ones(3, np.float32), "Msun"),
        temperature=unyt.unyt_array(np.ones(3, np.float32), "K"),
    )["gas"]
    assert np.array_equal(gas["mass * temperature"], np.ones(3))
    with pytest.raises(UsageError, match="mass in Msun beside temperature in K"):
        gas["mass + temperature"]
