"""Arrays as they come: borrowed or copied once, never changed, and refused where they are wrong."""

import mmap
import weakref

import numpy as np
import pytest

import splotchcl
from conftest import in_unit, make_arrays
from splotchcl import Particles, UsageError

SIZE = (48, 48)


def draw(renderer, **arrays):
    return renderer.render(scene_for(arrays), Particles().gas(**arrays), size=SIZE)


def scene_for(arrays):
    plain = make_arrays(500)
    return splotchcl.suggest(Particles().gas(**plain))


@pytest.fixture
def expected(renderer, arrays):
    return draw(renderer, **arrays).linear


def big_endian(a):
    return a.astype(">f4")


def strided(a):
    wide = np.zeros((2 * len(a), *a.shape[1:]), np.float32)
    wide[::2] = a
    return wide[::2]


def fortran(a):
    return np.asfortranarray(a)


def doubles(a):
    return a.astype(np.float64)


def unaligned(a):
    memory = np.zeros(a.nbytes + 1, np.uint8)
    view = memory[1:].view(np.float32).reshape(a.shape)
    view[...] = a
    return view


def listed(a):
    return a.tolist()


def masked_nowhere(a):
    return np.ma.masked_array(a)


def backwards(a):
    return np.ascontiguousarray(a[::-1])[::-1]


@pytest.mark.parametrize(
    "form", [big_endian, strided, fortran, doubles, unaligned, listed, masked_nowhere, backwards]
)
def test_any_form_of_the_same_numbers_draws_the_same_picture(renderer, arrays, expected, form):
    given = {name: form(values) for name, values in arrays.items()}
    assert expected.max() > 0
    assert np.array_equal(draw(renderer, **given).linear, expected)


@pytest.mark.parametrize("form", [big_endian, strided, doubles])
def test_a_copy_is_noted(renderer, arrays, form):
    arrays["temperature"] = form(arrays["temperature"])
    notes = draw(renderer, **arrays).notes
    assert [note for note in notes if "copied" in note] == [
        note for note in notes if note.startswith("field temperature was copied")
    ]
    assert any("copied" in note for note in notes)


def test_a_list_is_noted_as_one(arrays):
    arrays["position"] = arrays["position"].tolist()
    notes = Particles().gas(**arrays).notes
    assert len(notes) == 1
    assert "of the type list, not a numpy array" in notes[0]


def test_half_precision_is_taken(renderer, arrays):
    arrays["temperature"] = (arrays["temperature"] / 100).astype(np.float16)
    particles = Particles().gas(**arrays)
    assert np.array_equal(particles["gas"]["temperature"], arrays["temperature"].astype("f4"))


def test_contiguous_floats_are_borrowed(particles, arrays):
    assert particles.notes == []
    assert np.shares_memory(particles["gas"]["position"], arrays["position"])


def test_new_values_of_a_borrowed_array_are_drawn(renderer, arrays, expected):
    scene, particles = scene_for(arrays), Particles().gas(**arrays)
    renderer.render(scene, particles, size=SIZE)
    arrays["position"] += 0.5
    moved = renderer.render(scene, particles, size=SIZE).linear
    assert not np.array_equal(moved, expected)
    fresh = Particles().gas(**{k: v.copy() for k, v in arrays.items()})
    assert np.array_equal(moved, renderer.render(scene, fresh, size=SIZE).linear)


def test_inputs_do_not_change(renderer, arrays):
    before = {name: values.copy() for name, values in arrays.items()}
    for values in arrays.values():
        values.flags.writeable = False
    draw(renderer, **arrays)
    assert all(np.array_equal(arrays[name], before[name]) for name in arrays)


def test_an_array_that_is_deleted_is_drawn(renderer, arrays, expected):
    scene = scene_for(arrays)
    particles = Particles().gas(**arrays)
    arrays.clear()
    rubbish = [np.full((500, 3), np.nan, np.float32) for _ in range(50)]
    assert np.array_equal(renderer.render(scene, particles, size=SIZE).linear, expected)
    assert len(rubbish) == 50


def test_a_mapped_file_stays_open_while_it_is_drawn(renderer, arrays, expected, tmp_path):
    arrays["position"].tofile(tmp_path / "position")
    with open(tmp_path / "position", "rb") as file:
        mapped = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    arrays["position"] = np.frombuffer(mapped, np.float32).reshape(-1, 3)
    particles = Particles().gas(**arrays)
    del arrays["position"]
    with pytest.raises(BufferError):
        mapped.close()
    picture = renderer.render(scene_for(arrays), particles, size=SIZE)
    assert np.array_equal(picture.linear, expected)


def test_the_particles_outlive_a_field_that_was_read(arrays):
    field = Particles().gas(**arrays)["gas"]["mass"]
    assert np.array_equal(field, arrays["mass"])


@pytest.mark.parametrize(
    "take_away",
    [
        lambda particles: particles.gas(mass=np.zeros(500, np.float32)),
        lambda particles: particles.clear("gas"),
        lambda particles: None,
    ],
    ids=["another in its place", "clear", "del"],
)
def test_a_field_that_was_read_outlives_its_array(take_away):
    mass = np.arange(500, dtype=np.float32)
    array = mass.copy()
    kept = weakref.ref(array)
    particles = Particles().gas(mass=array)
    field = particles["gas"]["mass"]
    del array
    take_away(particles)
    del particles
    assert kept() is not None
    assert np.array_equal(field, mass)
    del field
    assert kept() is None


def test_double_positions_keep_their_digits_by_an_origin(renderer, arrays, expected):
    far = np.array([1e9, -1e9, 5e8])
    position = arrays["position"].astype(np.float64) + far
    particles = Particles(origin=far).gas(**{**arrays, "position": position})
    scene = scene_for(arrays)
    for key in ("camera.position", "camera.look_at"):
        scene[key] = np.array(scene[key]) + far
    picture = renderer.render(scene, particles, size=SIZE).linear
    assert picture == pytest.approx(expected, abs=2e-3)
    assert particles["gas"]["position"] == pytest.approx(position)


def test_hdf5_datasets_are_read(renderer, arrays, expected, tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.hdf5", "w") as file:
        for name, values in arrays.items():
            file[name] = values
        particles = Particles().gas(**{name: file[name] for name in arrays})
    picture = renderer.render(scene_for(arrays), particles, size=SIZE)
    assert np.array_equal(picture.linear, expected)


@pytest.mark.parametrize(
    ("field", "values", "message"),
    [
        ("position", np.zeros((3, 500), np.float32), r"\(3, 500\).*expected \(N,\) or \(N, 3\)"),
        ("position", np.zeros(500, np.float32), "expected x, y and z"),
        ("mass", np.zeros((2, 2, 2), np.float32), r"\(2, 2, 2\)"),
        ("mass", np.ones(499, np.float32), "499 particles, expected 500"),
        ("mass", np.ones(500, complex), "complex128, expected real numbers"),
        ("mass", np.array(["a"] * 500), "expected real numbers"),
        ("mass", np.array([None] * 500), "object, expected real numbers"),
        ("mass", [[1, 2], [3]], "mass"),
        ("mass", -1.0, "expected a number >= 0"),
        ("mass", np.ma.masked_less(np.arange(500.0), 7), "7 values are masked"),
        ("", np.ones(500, np.float32), "without a name"),
    ],
)
def test_a_wrong_array_is_refused(particles, field, values, message):
    with pytest.raises(ValueError, match=message):
        particles.gas(**{field: values})


@pytest.mark.parametrize("name", ["gass", 32, -1])
def test_a_wrong_type_is_refused(name, arrays):
    with pytest.raises(UsageError, match="type"):
        Particles().add(name, **arrays)


@pytest.mark.parametrize("name", [0, 1.5, None, ("gas",), "stars"])
def test_what_is_no_type_of_a_snapshot_is_refused_with_those_that_it_has(name, particles):
    with pytest.raises(UsageError, match="expected a name, one of gas"):
        particles[name]


@pytest.mark.parametrize("name", [0, None])
def test_what_is_no_name_of_a_field_is_refused_with_those_that_there_are(name, particles):
    with pytest.raises(UsageError, match="expected a name, one of .*temperature"):
        particles["gas"][name]


def test_a_refused_array_leaves_the_particles_as_they_were(renderer, arrays, particles, expected):
    with pytest.raises(UsageError):
        particles.gas(mass=np.ones(3, np.float32))
    assert np.array_equal(
        renderer.render(scene_for(arrays), particles, size=SIZE).linear, expected
    )


def test_masses_below_0_are_left_out_and_counted(renderer, arrays):
    mass = arrays["mass"].copy()
    mass[:7] = -1
    notes = draw(renderer, **{**arrays, "mass": mass}).notes
    assert any("7 " in note and "left out" in note for note in notes), notes


def test_particles_without_any_are_refused(renderer):
    with pytest.raises(splotchcl.Error):
        renderer.render(Particles(), size=SIZE)


def test_no_particles_at_all_in_an_array_are_refused(renderer):
    empty = Particles().gas(position=np.zeros((0, 3), np.float32))
    with pytest.raises(splotchcl.Error):
        renderer.render(empty, size=SIZE)


def test_only_bad_particles_are_refused(renderer, arrays):
    arrays["position"][:] = np.nan
    with pytest.raises(splotchcl.Error):
        renderer.render(Particles().gas(**arrays), size=SIZE)


def test_another_number_of_particles_needs_clear(arrays):
    particles = Particles().gas(**arrays)
    particles.clear("gas")
    particles.gas(**make_arrays(7))
    assert len(particles["gas"]) == 7


def test_units_go_with_their_arrays(arrays):
    particles = Particles().gas(position=in_unit(arrays["position"], "kpc"))
    particles.gas(position=in_unit(arrays["position"], "Mpc"))
    assert particles.units == {"length": "Mpc"}
    particles.clear("gas")
    assert particles.units == {}
    particles.gas(position=in_unit(arrays["position"], "pc"))
    particles.gas(position=arrays["position"])
    assert particles.units == {}


def test_lengths_that_are_replaced_together_may_change_their_unit(arrays):
    particles = Particles()
    for unit in ("kpc", "Mpc"):
        particles.gas(
            position=in_unit(arrays["position"], unit),
            smoothing_length=in_unit(arrays["smoothing_length"], unit),
        )
    assert particles.units == {"length": "Mpc"}


def test_a_field_has_the_unit_of_its_array(arrays):
    particles = Particles().gas(
        position=arrays["position"], temperature=in_unit(arrays["temperature"], "keV")
    )
    assert particles["gas"].fields == {"position": "", "temperature": "keV"}


def test_a_number_for_all_masses_with_a_unit_becomes_masses_of_that_unit(arrays):
    at_once = Particles().gas(mass=in_unit(np.array(2.0), "kg"), position=arrays["position"])
    later = Particles().gas(mass=in_unit(np.array(2.0), "kg")).gas(position=arrays["position"])
    for particles in (at_once, later):
        assert particles["gas"].fields["mass"] == "kg"
        assert np.all(particles["gas"]["mass"] == 2)


def test_an_array_of_masses_takes_the_place_of_an_earlier_number(arrays):
    particles = Particles().gas(mass=in_unit(np.array(2.0), "kg"))
    particles.gas(position=arrays["position"], mass=in_unit(arrays["mass"], "g"))
    assert particles["gas"].fields["mass"] == "g"
    assert np.array_equal(particles["gas"]["mass"], arrays["mass"])


def test_a_number_for_all_masses_takes_the_place_of_an_array(arrays):
    particles = Particles().gas(position=arrays["position"], mass=in_unit(arrays["mass"], "g"))
    particles.gas(mass=in_unit(np.array(2.0), "kg"))
    assert particles.units == {"mass": "kg"}
    assert particles["gas"].fields["mass"] == "kg"
    assert np.all(particles["gas"]["mass"] == 2)


def test_a_box_in_another_unit_is_converted_to_that_of_positions(arrays):
    particles = Particles(box_size=in_unit(np.array(10e3), "kpc"))
    assert particles.box_size == 10e3
    particles.gas(position=in_unit(arrays["position"], "Mpc"))
    assert particles.box_size == pytest.approx(10)
    with pytest.raises(UsageError, match="box_size: the unit g, expected one that"):
        Particles(box_size=in_unit(np.array(1.0), "g")).gas(
            position=in_unit(arrays["position"], "Mpc")
        )


def test_an_origin_in_another_unit_than_positions_is_refused(arrays):
    particles = Particles(origin=in_unit(np.ones(3), "kpc"))
    with pytest.raises(UsageError, match="the unit Mpc, expected kpc"):
        particles.gas(position=in_unit(arrays["position"], "Mpc"))


def test_masses_that_there_are_not_are_told_of_in_words_of_python(arrays):
    particles = Particles().gas(position=arrays["position"])
    with pytest.raises(UsageError, match="gas has no masses, expected one of .*; set mass="):
        particles["gas"]["mass"]
