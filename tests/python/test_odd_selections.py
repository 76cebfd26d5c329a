"""Masks, identifiers and wind among stars, which conditions choose."""

import h5py
import numpy as np
import pytest
import splotchcl
from odd import (
    STARS,
    assert_draws_alone,
    assert_reads,
    assert_reads_group,
    column,
    counts_of,
    has_note,
    hdf5,
    mass_in_map,
    of,
    total_of,
)
from splotchcl import DataError, Snapshot

pytestmark = pytest.mark.usefixtures("program", "renderer")


@of("a14_wind_particles")
def test_wind_is_no_star_unless_a_condition_names_it(odd_files):
    path = odd_files / "a14_wind.hdf5"
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


@of("a25_masks")
def test_masks_select_by_conditions(odd_files):
    path = odd_files / "a25_masks.hdf5"
    masks = {"is_bound == 1": hdf5(path, "PartType0/is_bound"),
             "flag8 == 2": hdf5(path, "PartType0/flag8") == 2}
    assert [np.count_nonzero(mask) for mask in masks.values()] == [50, 33]
    for condition, mask in masks.items():
        assert_draws_alone(path, condition, mask, h=3)
    mask = masks["is_bound == 1"]
    np.save(odd_files / "mask.npy", mask)
    np.save(odd_files / "ids.npy", hdf5(path, "PartType0/ParticleIDs")[mask])
    by_list = {"component.0.select.ids": str(odd_files / "ids.npy")}
    assert np.count_nonzero(mask) == mass_in_map(path, (50, 50, 50), 80, settings=by_list)
    with pytest.raises(DataError, match=r"mask\.npy.*true and false.*save ids\[mask\] instead"):
        column(path, (50, 50, 50), 80, settings={"component.0.select.ids": str(odd_files / "mask.npy")})


@of("q01_ids_in_conditions")
def test_identifiers_beyond_floats_select_exactly(odd_files):
    path = odd_files / "q01_ids.hdf5"
    ids = hdf5(path, "PartType0/ParticleIDs")
    np.testing.assert_array_equal(Snapshot(path)["gas"]["id"], ids)
    masks = {"ParticleIDs <= 2000000000": ids <= 2000000000, "ParticleIDs > 2000000000": ids > 2000000000,
             "id == 1999999900": ids == 1999999900}
    assert [np.count_nonzero(mask) for mask in masks.values()] == [200, 200, 1]
    for condition, mask in masks.items():
        assert_draws_alone(path, condition, mask, h=2)


# Whatever their field is called.
@pytest.mark.parametrize("name", ["tracer", "TracerID"])
@pytest.mark.parametrize("first", [-4, 2**60, 2**64 - 9])
def test_whole_numbers_beyond_floats_are_compared_exactly(tmp_path, name, first):
    path = tmp_path / "plain.hdf5"
    with h5py.File(path, "w") as file:
        file["pos"], file["h"] = np.random.default_rng(1).random((9, 3)), np.full(9, 0.1)
        file[name] = np.array(range(first, first + 9), np.int64 if first < 0 else np.uint64)
    for condition, count in ((f"{name} == {first + 5}", 1), (f"{name} != {first}", 8), (f"{name} >= {first + 2}", 7),
                             (f"{name} < 2", 6 if first < 0 else 0)):
        drawn = splotchcl.column(path, "counts", where=condition, center=(0.5, 0.5, 0.5), width=3, size=(16, 16))
        assert drawn.values.sum(dtype=float) == pytest.approx(count, rel=1e-4), condition


# A list of places in the file, in place of ids, finds some of them.
def test_ids_that_no_particle_has_are_counted(odd_files):
    path = odd_files / "a25_masks.hdf5"
    ids = hdf5(path, "PartType0/ParticleIDs")
    for shift, lost in ((0, 0), (len(ids) // 2, len(ids) // 2)):
        np.save(odd_files / "list.npy", ids.astype(">i8") + shift)
        drawn = column(path, (50, 50, 50), 80, settings={"component.0.select.ids": str(odd_files / "list.npy")})
        assert total_of(drawn) == pytest.approx(len(ids) - lost, rel=1e-4)
        assert has_note(drawn, f"{lost} of the {len(ids)} ids", "none of its particles") == (lost > 0)
