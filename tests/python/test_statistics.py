"""Profiles and histograms against closed forms and sums of their own."""

import numpy as np
import pytest

import splotchcl
from splotchcl import Particles, UsageError


def ball(count=20000, seed=1, center=(0.0, 0.0, 0.0), radius=1.0):
    """Evenly filled."""
    random = np.random.default_rng(seed)
    direction = random.normal(size=(count, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    distance = radius * np.cbrt((np.arange(count) + 0.5) / count)
    return np.asarray(center) + distance[:, None] * direction


def gas_of(position, **fields):
    count = len(position)
    arrays = {"mass": np.full(count, 2.0), "density": np.ones(count), **fields}
    return {"position": position, **{name: np.asarray(v, np.float32) for name, v in arrays.items()}}


def test_an_even_ball_has_one_density():
    found = splotchcl.profile(Particles().gas(**gas_of(ball())), center=(0, 0, 0), edges=[0.2, 0.4, 0.8, 1.0])
    even = 2 * 20000 / (4 / 3 * np.pi)
    assert found.values == pytest.approx(even, rel=1e-2)
    assert found.enclosed[-1] == pytest.approx(2 * 20000)
    assert found.inside == pytest.approx(2 * 20000 * 0.2**3, rel=1e-2)


def test_all_shells_hold_all_particles():
    found = splotchcl.profile(Particles().gas(**gas_of(ball())), "counts", center=(0, 0, 0), inner=1e-6)
    assert found.counts.sum() == 20000
    assert (found.values * 4 / 3 * np.pi * np.diff(found.edges**3)).sum() == pytest.approx(20000)


def test_half_of_a_shell_lies_within_its_radius():
    found = splotchcl.profile(Particles().gas(**gas_of(ball())), center=(0, 0, 0), edges=[0, 1])
    assert found.radius == pytest.approx([0.5 ** (1 / 3)])


def test_means_are_weighted_and_their_spread_keeps_its_digits():
    position = ball(1000)
    heat = 1e6 + np.where(np.arange(1000) % 2, 10.0, -10.0)
    weight = np.where(np.arange(1000) % 2, 3.0, 1.0)
    found = splotchcl.profile(
        Particles().gas(**gas_of(position, temperature=heat, w=weight)), "temperature",
        center=(0, 0, 0), edges=[0, 1], weight="w",
    )  # fmt: skip
    assert found.values == pytest.approx([1e6 + 5])
    assert found.spread == pytest.approx([np.sqrt(75)], rel=1e-6)


def test_shells_without_particles_have_no_mean():
    position = ball(100)
    found = splotchcl.profile(
        Particles().gas(**gas_of(position, temperature=np.ones(100))), "temperature", center=(0, 0, 0),
        edges=[0, 1, 2],
    )  # fmt: skip
    assert np.isnan(found.values[1]) and found.values[0] == 1


@pytest.mark.parametrize("center", [(0.1, 9.9, 5.0), "mass", "densest"])
def test_shells_go_on_across_the_faces_of_a_box(center):
    position = ball(5000, center=(0.1, 9.9, 5.0), radius=2)
    density = np.exp(-np.linalg.norm(position - (0.1, 9.9, 5.0), axis=1))
    particles = Particles(box_size=10).gas(**gas_of(position % 10, density=density))
    found = splotchcl.profile(particles, "counts", center=center, edges=[0, 2.3])
    assert found.counts == [5000]
    assert found.center == pytest.approx((0.1, 9.9, 5.0), abs=0.15)


def test_a_box_that_particles_do_not_fit_does_not_count():
    position = ball(1000, radius=30)
    found = splotchcl.profile(Particles(box_size=1).gas(**gas_of(position)), center=(0, 0, 0), edges=[0, 31])
    assert found.counts == [1000]


def test_bad_particles_are_counted():
    position = ball(100)
    mass = np.ones(100)
    mass[:3] = np.nan, -1, np.inf
    found = splotchcl.profile(Particles().gas(**gas_of(position, mass=mass)), center=(0, 0, 0), edges=[0, 1])
    assert found.bad == 3 and found.counts == [97]


def test_a_profile_of_a_file_is_that_of_its_arrays(universe):
    snapshot = splotchcl.Snapshot(universe)
    found = splotchcl.profile(snapshot, types="gas,stars", center="densest", outer=2000)
    assert 0 < found.counts.sum() < 20000
    assert found.weights.sum() > 0 and found.bad == 0


@pytest.mark.parametrize("read", [{"every": 3}, {"max_particles": 1000}])
def test_particles_of_a_part_stand_for_those_left_out(universe, read):
    whole, part = splotchcl.Snapshot(universe), splotchcl.Snapshot(universe, read=read)
    shells = {"types": "gas,stars", "center": (5000, 5000, 5000), "edges": [0, 1e5]}
    count = sum(len(kind) for kind in whole.types.values())
    found = splotchcl.profile(part, "counts", **shells)
    assert found.weights == pytest.approx([count])
    assert found.counts == [sum(len(kind) for kind in part.types.values())]
    gas = splotchcl.histogram(part, "x", "y", weight="constant")
    assert gas.values.sum() == pytest.approx(len(whole["gas"]))
    mass = splotchcl.histogram(part, "x", "y").values.sum()
    assert mass == pytest.approx(whole["gas"]["mass"].sum(dtype=float), rel=0.1)
    assert part["gas"].particles_per_read == pytest.approx(len(whole["gas"]) / len(part["gas"]))


def test_types_in_several_units_are_refused(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.hdf5", "w") as file:
        for kind, unit in (("PartType0", "kpc"), ("PartType1", "Mpc")):
            file[f"{kind}/Coordinates"], file[f"{kind}/Masses"] = ball(10), np.ones(10)
            file[f"{kind}/Coordinates"].attrs["units"] = unit
        file.create_group("Header").attrs["NumPart_ThisFile"] = [10, 10, 0, 0, 0, 0]
    snapshot = splotchcl.Snapshot(tmp_path / "a.hdf5")
    assert splotchcl.profile(snapshot, types="halo", center=(0, 0, 0)).length_unit == "Mpc"
    with pytest.raises(UsageError, match="'Mpc', 'kpc' of gas, halo"):
        splotchcl.profile(snapshot, types="gas,halo", center=(0, 0, 0))


@pytest.mark.parametrize("wrong", [
    {"center": "box"}, {"center": (1, 2)}, {"edges": [1, 0]}, {"edges": [1]}, {"inner": 2, "outer": 1},
    {"types": ()}, {"types": "stars"}, {"field": "nothing"}, {"bins": 2.5}, {"bins": (2, 3)},
])  # fmt: skip
def test_wrong_profiles_are_refused(wrong):
    with pytest.raises(UsageError):
        splotchcl.profile(Particles().gas(**gas_of(ball(10))), **wrong)


def two_fields(count=1000):
    random = np.random.default_rng(3)
    return gas_of(random.random((count, 3)), density=10 ** random.uniform(-3, 3, count),
                  temperature=random.uniform(10, 90, count), mass=random.random(count))  # fmt: skip


def test_a_histogram_holds_all_weights():
    arrays = two_fields()
    found = splotchcl.histogram(Particles().gas(**arrays), "density", "temperature", bins=(16, 8))
    assert found.values.shape == (8, 16)
    assert found.values.sum() == pytest.approx(arrays["mass"].sum(dtype=float))
    assert found.outside == 0 and found.bad == 0


@pytest.mark.parametrize("bins", [2.5, 0, (2, 3, 4), (2,), "4"])
def test_wrong_bins_are_refused(bins):
    with pytest.raises(UsageError, match="bins"):
        splotchcl.histogram(Particles().gas(**two_fields()), "density", "temperature", bins=bins)


def test_bins_may_be_a_number_of_numpy():
    found = splotchcl.histogram(Particles().gas(**two_fields()), "density", "temperature", bins=np.int64(3))
    assert found.values.shape == (3, 3)


def test_bins_are_even_in_what_spans_a_hundredfold():
    found = splotchcl.histogram(Particles().gas(**two_fields()), "density", "temperature", bins=4)
    assert np.diff(np.log(found.x_edges)) == pytest.approx(np.log(found.x_edges[1] / found.x_edges[0]))
    assert np.diff(found.y_edges) == pytest.approx(found.y_edges[1] - found.y_edges[0])


def test_x_lies_to_the_right_and_y_upwards():
    arrays = gas_of(np.zeros((2, 3)), density=[1, 3], temperature=[10, 10], mass=[1, 5])
    found = splotchcl.histogram(
        Particles().gas(**arrays), "density", "temperature", bins=2, x_range=(0, 4), y_range=(0, 40)
    )
    assert np.array_equal(found.values, [[1, 5], [0, 0]])
    assert found.extent == (0, 4, 0, 40)


def test_what_lies_outside_is_told():
    arrays = two_fields()
    found = splotchcl.histogram(Particles().gas(**arrays), "density", "temperature", x_range=(1, 1000))
    left_out = arrays["mass"][arrays["density"] < 1].sum(dtype=float)
    assert found.outside == pytest.approx(left_out, rel=1e-9)


def test_a_third_field_has_its_mean():
    arrays = gas_of(np.zeros((3, 3)), density=[1, 1, 3], temperature=[1, 1, 1], mass=[1, 3, 1], z=[2, 6, 7])
    found = splotchcl.histogram(
        Particles().gas(**arrays), "density", "temperature", "z", bins=(2, 1), x_range=(0, 4), y_range=(0, 2)
    )
    assert found.values == pytest.approx(np.array([[5, 7]]))


def test_a_logarithm_of_nothing_is_refused():
    arrays = two_fields()
    arrays["temperature"][0] = 0
    with pytest.raises(UsageError, match="temperature"):
        splotchcl.histogram(Particles().gas(**arrays), "density", "temperature", y_log=True)
