"""Maps as data, snapshots as data, films."""

import numpy as np
import pytest

import splotchcl
from conftest import in_unit, make_arrays
from splotchcl import DataError, Particles, Snapshot, UsageError


@pytest.fixture(autouse=True)
def needs_a_device(renderer):
    pass


def test_a_map_has_the_bits_of_the_command_line(program, universe, tmp_path):
    program(
        "map", universe, "--types", "gas", "--quantity", "temperature", "--size", "64x48",
        "-o", tmp_path / "map.npy",
    )
    drawn = splotchcl.column(universe, "temperature", types="gas", size=(64, 48))
    assert np.array_equal(drawn.values, np.load(tmp_path / "map.npy"), equal_nan=True)


def test_types_are_a_word_with_commas_or_a_list(universe):
    by_word = splotchcl.column(universe, types="gas, stars", size=(16, 16))
    by_list = splotchcl.column(universe, types=["gas", "stars"], size=(16, 16))
    assert np.array_equal(by_word.values, by_list.values)


def test_a_saved_map_is_its_values(universe, tmp_path):
    drawn = splotchcl.column(universe, types="gas", size=(32, 32))
    drawn.save(tmp_path / "map.npy")
    assert np.array_equal(np.load(tmp_path / "map.npy"), np.asarray(drawn))


def test_a_saved_figure_adds_its_notes_once(universe, tmp_path):
    log = {"map.scaling": "log"}
    drawn = splotchcl.column(universe, "line_of_sight_velocity", size=(200, 200), settings=log)
    before = list(drawn.notes)
    drawn.save(tmp_path / "map.npy")
    assert drawn.notes == before
    drawn.save(tmp_path / "map.png")
    drawn.save(tmp_path / "map.pdf")
    assert len(drawn.notes) == len(before) + 1
    assert "below 0, where there is no logarithm" in drawn.notes[-1]


def test_a_surface_density_adds_up_to_the_mass(universe):
    drawn = splotchcl.column(universe, types="gas", size=(64, 64))
    mass = Snapshot(universe)["gas"]["mass"].sum(dtype=float)
    assert drawn.values.sum(dtype=float) * drawn.pixel**2 == pytest.approx(mass, rel=2e-3)


def test_a_mean_of_one_value_is_that_value():
    arrays = make_arrays(500)
    arrays["temperature"][:] = 300
    drawn = splotchcl.column(Particles().gas(**arrays), "temperature", size=(32, 32))
    known = drawn.values[np.isfinite(drawn.values)]
    assert known.size > 100
    assert known == pytest.approx(300, rel=2e-3)


def test_y_grows_with_the_row():
    arrays = make_arrays(500)
    arrays["position"][:, 1] = np.linspace(0, 10, 500)
    arrays["mass"] = np.where(arrays["position"][:, 1] > 5, 2, 1).astype(np.float32)
    drawn = splotchcl.column(Particles(box_size=10).gas(**arrays), size=(32, 32))
    assert drawn.extent == pytest.approx((0, 10, 0, 10))
    assert drawn.values[20:28].sum() > 1.5 * drawn.values[4:12].sum()


def test_a_unit_is_converted(universe):
    says = {"map.length_unit": "kpc", "map.mass_unit": "1e10 Msun"}
    plain = splotchcl.column(universe, types="gas", size=(16, 16), settings=says)
    drawn = splotchcl.column(
        universe, types="gas", size=(16, 16), settings=says, unit="Msun/pc^2"
    )
    assert drawn.unit == "Msun/pc^2"
    assert drawn.values == pytest.approx(plain.values * 1e4, rel=1e-5)


@pytest.mark.parametrize(
    "wrong", [{"field": "temprature"}, {"view": "zx"}, {"unit": "K"}, {"width": -1.0}, {"size": (16.5, 16)}]
)
def test_a_wrong_map_is_refused(universe, wrong):
    with pytest.raises(UsageError):
        splotchcl.column(universe, **{"types": "gas", "size": (16, 16)} | wrong)


def test_fields_of_a_snapshot_are_arrays(universe):
    gas = Snapshot(universe)["gas"]
    assert gas["position"].shape == (len(gas), 3)
    assert gas["position"].dtype == np.float32
    assert gas["temperature"].shape == (len(gas),)  # derived
    assert (gas["temperature"] > 0).all()


def test_an_unknown_field_or_type_is_refused(universe):
    snapshot = Snapshot(universe)
    with pytest.raises(splotchcl.Error, match="colour_of_the_sky"):
        snapshot["gas"]["colour_of_the_sky"]
    with pytest.raises(UsageError, match="gas, stars"):
        snapshot["bulge"]


def test_a_part_of_a_snapshot_is_read(universe):
    assert len(Snapshot(universe, read={"every": 10})["gas"]) == pytest.approx(
        len(Snapshot(universe)["gas"]) / 10, abs=1
    )


# Neighbours that were read are as many times as many particles. Sums of 8 scatter by a third.
def test_densities_of_a_part_are_those_of_all(tmp_path):
    position = np.random.default_rng(1).random((8000, 3))
    np.savez(tmp_path / "even.npz", pos=position, mass=np.full(8000, 1 / 8000))
    medians = [
        np.median(splotchcl.Snapshot(tmp_path / "even.npz", read={"every": every})["gas"]["density"])
        for every in (1, 10)
    ]
    assert medians == pytest.approx([1, 1], rel=0.35)
    part = splotchcl.column(
        tmp_path / "even.npz", "density", weight="volume", center=(0.5, 0.5, 0.5), width=0.5, size=(8, 8),
        settings={"read.every": 10},
    )  # fmt: skip
    assert part.values.mean() == pytest.approx(1, rel=0.35)


def test_what_is_no_snapshot_is_a_data_error(tmp_path):
    (tmp_path / "rubbish").write_bytes(b"\0\1\2\3" * 100)
    with pytest.raises(DataError, match="rubbish"):
        Snapshot(tmp_path / "rubbish")


def test_a_film_has_the_pictures_of_its_frames(renderer, universe, tmp_path):
    scene = splotchcl.suggest(universe, size=(32, 32))
    scene.update({"path.orbit.degrees": 360, "movie.frames": 3})
    # A film finds these once, from its first frame.
    scene.update({"finish.exposure": -2, "finish.white": 1.5})
    told = []
    film = splotchcl.movie(
        scene, tmp_path / "f_%02d.png", progress=lambda what, fraction: told.append(fraction)
    )
    assert (film.state, film.frames) == ("complete", 3)
    assert told == pytest.approx([0, 1 / 3, 2 / 3])
    decided = scene.decide()
    for i, frame in enumerate(decided.frames()):
        renderer.render(frame).save(tmp_path / "one.png")
        expected = (tmp_path / f"f_{i:02}.png").read_bytes()
        assert (tmp_path / "one.png").read_bytes() == expected


def test_what_progress_raises_ends_a_film_and_keeps_its_frames(universe, tmp_path):
    scene = splotchcl.suggest(universe, size=(32, 32))
    scene.update({"path.orbit.degrees": 360, "movie.frames": 3})
    # A film finds these once, from its first frame.
    scene.update({"finish.exposure": -2, "finish.white": 1.5})

    def stop(what, fraction):
        if fraction > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        splotchcl.movie(scene, tmp_path / "f_%02d.png", progress=stop)
    assert sorted(path.name for path in tmp_path.glob("f_*.png")) == ["f_00.png", "f_01.png"]
    assert splotchcl.movie(scene, tmp_path / "f_%02d.png").state == "complete"


def map_of(arrays, length, mass, **settings):
    particles = Particles().gas(
        position=in_unit(arrays["position"], length),
        mass=in_unit(arrays["mass"], mass),
        smoothing_length=arrays["smoothing_length"],
    )
    return splotchcl.column(particles, size=(8, 8), **settings)


def test_a_map_is_in_the_units_that_arrays_carry(renderer, arrays):
    drawn = map_of(arrays, "kpc", "1e10*Msun", unit="Msun/pc^2")
    assert drawn.length_unit == "kpc"
    plain = splotchcl.column(
        Particles().gas(**{k: arrays[k] for k in ("position", "mass", "smoothing_length")}),
        size=(8, 8),
    )
    assert drawn.values == pytest.approx(plain.values * 1e10 / 1e6, rel=1e-5)


@pytest.mark.parametrize(
    ("unit", "wanted", "factor"),
    [("g/cm**3", "kg/cm^3", 1e-3), ("g / cm3", "kg cm^-3", 1e-3), ("1e3*keV", "eV", 1e6)],
)
def test_a_map_of_a_field_is_in_the_unit_that_it_carries(renderer, arrays, unit, wanted, factor):
    density = np.full(500, 7, np.float32)
    particles = Particles().gas(
        **{name: arrays[name] for name in ("position", "mass", "smoothing_length")},
        density=in_unit(density, unit),
    )
    drawn = splotchcl.column(particles, "density", size=(8, 8), unit=wanted)
    assert drawn.values[np.isfinite(drawn.values)] == pytest.approx(7 * factor, rel=1e-4)


def test_smoothing_lengths_follow_from_densities_in_a_unit_of_their_own(arrays):
    density = np.full(500, 7e9, np.float32)
    in_kpc = {
        "position": in_unit(arrays["position"], "kpc"),
        "mass": in_unit(arrays["mass"], "Msun"),
    }
    one = Particles().gas(**in_kpc, density=in_unit(density, "Msun/kpc^3"))
    other = Particles().gas(**in_kpc, density=in_unit(density * 1e-9, "Msun/pc^3"))
    assert other["gas"]["smoothing_length"] == pytest.approx(
        one["gas"]["smoothing_length"], rel=1e-5
    )


def test_units_that_maps_do_not_know_do_no_harm(renderer, arrays):
    drawn = map_of(arrays, "furlong", "stone")
    assert drawn.unit == "stone/furlong^2"
    assert sum("maps cannot convert" in note for note in drawn.notes) == 2


def test_lengths_in_another_unit_are_converted(renderer, arrays):
    center = in_unit(np.array([5e6, 5e6, 5e6]), "pc")
    drawn = map_of(arrays, "Mpc", "Msun", center=center, width=in_unit(np.array(4e3), "kpc"))
    plain = map_of(arrays, "Mpc", "Msun", center=[5, 5, 5], width=4)
    assert drawn.extent == pytest.approx(plain.extent, rel=1e-6)
    mixed = [5, in_unit(np.array(5e3), "kpc"), in_unit(np.array(5.0), "Mpc")]
    assert map_of(arrays, "Mpc", "Msun", center=mixed, width=4).extent == plain.extent


def test_a_length_in_a_unit_is_converted_for_a_file(renderer, universe):
    says = {"map.length_unit": "kpc"}
    plain = splotchcl.column(universe, size=(8, 8), settings=says, width=4)
    given = in_unit(np.array(4e3), "pc")
    drawn = splotchcl.column(universe, size=(8, 8), settings=says, width=given)
    assert drawn.extent == pytest.approx(plain.extent, rel=1e-6)


@pytest.mark.parametrize("unit", ["Msun", "furlong"])
def test_a_length_that_cannot_be_converted_is_refused(renderer, arrays, unit):
    with pytest.raises(UsageError, match=f"map.width: found the unit {unit}, expected one that"):
        map_of(arrays, "kpc", "Msun", width=in_unit(np.array(4.0), unit))
    plain = Particles().gas(position=arrays["position"])
    with pytest.raises(UsageError, match="which it does not say; give a number without"):
        splotchcl.column(plain, size=(8, 8), width=in_unit(np.array(4.0), "kpc"))


def test_units_that_need_a_scale_factor_are_noted(renderer, arrays):
    notes = map_of(arrays, "Mpc a h**-1", "Msol h**-1").notes
    assert sum("maps cannot convert" in note for note in notes) == 2


def test_units_of_the_scene_come_before_those_of_arrays(renderer, arrays):
    settings = {"map.length_unit": "Mpc", "map.mass_unit": "g"}
    assert map_of(arrays, "kpc", "Msun", settings=settings).length_unit == "Mpc"


def test_a_renderer_draws_the_same_maps_as_a_new_device(renderer, particles):
    drawn = [splotchcl.column(particles, "temperature", size=(16, 16), device=device)
             for device in (None, renderer, renderer)]
    assert np.array_equal(drawn[0].values, drawn[1].values, equal_nan=True)
    assert np.array_equal(drawn[0].values, drawn[2].values, equal_nan=True)


@pytest.mark.parametrize(("middle", "is_noted"), [(1e9, True), (1e4, False)])
def test_places_that_single_precision_does_not_have_are_noted(renderer, middle, is_noted):
    places = np.random.default_rng(1).uniform(-1, 1, (50, 3)) + middle
    gas = Particles().gas(position=places, smoothing_length=np.full(50, 0.1), mass=np.ones(50))
    drawn = splotchcl.column(gas, types="gas", center=[middle] * 3, width=2, size=(8, 8), device=renderer)
    assert any("50 of 50 particles lie so far" in note for note in drawn.notes) == is_noted


def test_values_that_single_precision_has_few_digits_for_are_noted(renderer, particles):
    settings = {"map.length_unit": "cm", "map.mass_unit": "g", "map.unit": "5e37 g/cm^2"}
    drawn = splotchcl.column(particles, types="gas", size=(8, 8), device=renderer, settings=settings)
    assert any("single precision has fewer digits" in note for note in drawn.notes)
    settings["map.unit"] = "1e20 g/cm^2"
    drawn = splotchcl.column(particles, types="gas", size=(8, 8), device=renderer, settings=settings)
    assert drawn.notes == []
