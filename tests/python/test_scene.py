"""Scenes as mappings."""

import copy
import pickle

import numpy as np
import pytest

import splotchcl
from splotchcl import Scene, UnknownKey, UsageError


@pytest.fixture
def scene() -> Scene:
    return Scene(
        {
            "image": {"size": [40, 30]},
            "component": [{"name": "hot.gas", "types": ["gas"], "color": {"field": "temperature"}}],
        }
    )


def test_a_key_that_was_set_is_got(scene):
    scene["component.hot.gas.brightness"] = 2.5
    assert scene["component.hot.gas.brightness"] == 2.5
    assert scene["component.0.brightness"] == 2.5


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("camera.position", [1.0, -2.5, 3e20]),
        ("image.size", [640, 480]),
        ("tolerance", 0.1 + 0.2),
        ("component.0.palette", "magma"),
        ("finish.title.text", 'a "quoted" ü \\ line\nand another'),
        ("kernel.min_radius", 0.25),
    ],
)
def test_values_come_back_as_they_were(scene, key, value):
    camera = {"camera.position": [9, 9, 9], "camera.look_at": [0, 0, 0]}
    scene.update({**camera, key: value})
    assert scene[key] == value


def test_a_formula_that_was_set_is_got(scene):
    scene["component.0.color.formula"] = "density * temperature"
    assert scene["component.0.color.formula"] == "density * temperature"
    assert "component.0.color.formula" in scene
    scene["component.0.color.field"] = "density"
    assert scene["component.0.color.formula"] is None


def test_completions_are_all_that_is_set_and_more(scene):
    completions = scene._ipython_key_completions_()
    assert set(scene) <= set(completions)
    assert {"component.hot.gas.color.formula", "component.0.color.formula"} <= set(completions)


def test_arrays_are_lists_of_numbers(scene):
    scene["image.background"] = np.array([0.5, 0.25, 0], np.float32)
    assert scene["image.background"] == [0.5, 0.25, 0]


def test_an_unknown_key_names_the_nearest(scene):
    with pytest.raises(UnknownKey, match="did you mean image.size") as raised:
        scene["image.sizes"] = [1, 1]
    assert isinstance(raised.value, KeyError) and isinstance(raised.value, ValueError)
    with pytest.raises(UnknownKey, match="did you mean image.size"):
        scene["image.sizes"]
    with pytest.raises(UnknownKey):
        scene["component.cold.brightness"]
    with pytest.raises(UnknownKey):
        scene["component.1.brightness"]


def test_a_key_that_is_not_set_is_none(scene):
    assert scene["camera.position"] is None
    assert "camera.position" not in scene
    assert "image.size" in scene


@pytest.mark.parametrize(
    ("key", "value"),
    [("tolerance", -1), ("tolerance", "x"), ("image.size", [0, 5]), ("tolerance", {1, 2})],
)
def test_a_wrong_value_leaves_the_scene_as_it_was(scene, key, value):
    before = scene.to_toml()
    with pytest.raises(UsageError, match=key.split(".")[0]):
        scene[key] = value
    assert scene.to_toml() == before


def test_none_is_no_value(scene):
    with pytest.raises(UsageError, match="del scene"):
        scene["tolerance"] = None


def test_a_deleted_key_is_at_its_default(scene):
    scene["finish.title.text"] = "x"
    del scene["finish.title.text"]
    assert "finish.title.text" not in scene


def test_what_is_iterated_can_be_got(scene):
    assert len(scene) == len(list(scene)) > 5
    assert all(key in scene for key in scene)


def test_a_scene_is_made_of_keys_joined_by_dots(scene):
    made = Scene(
        {
            "image.size": [40, 30],
            "component.0.name": "hot.gas",
            "component.0.types": ["gas"],
            "component.hot.gas.color.field": "temperature",
        }
    )
    assert made == scene
    assert Scene(dict(scene)) == scene


def test_keys_joined_by_dots_come_after_tables():
    scene = Scene({"image": {"size": [4, 4]}, "image.width": 8, "component": [{"types": ["gas"]}]})
    assert scene.size == (8, 4)


def test_a_sequence_is_named_by_a_key_joined_by_dots():
    assert "snapshot" not in Scene({"time.snapshots": "s_%d", "component.0.types": ["gas"]})


def test_a_scene_of_an_unknown_key_names_the_nearest():
    for keys in ({"image.sizes": [1, 1]}, {"image": {"sizes": [1, 1]}}):
        with pytest.raises(UnknownKey, match="did you mean image.size"):
            Scene(keys)
    with pytest.raises(UsageError, match="component.1"):
        Scene({"component.1.types": ["gas"]})


def test_a_copy_is_a_scene_of_its_own(scene):
    for other in (scene.copy(), copy.copy(scene), copy.deepcopy(scene), Scene.from_toml(str(scene))):
        assert other == scene
        other["tolerance"] = 0.5
        assert other != scene


def test_a_scene_is_pickled(scene):
    again = pickle.loads(pickle.dumps(scene))
    assert again["component.0.color.field"] == "temperature"


def test_a_saved_scene_is_read_from_any_folder(universe, tmp_path, monkeypatch):
    monkeypatch.chdir(universe.parent)
    scene = Scene({"snapshot": universe.name, "component": [{"types": ["gas"]}]})
    scene.save(tmp_path / "scene.toml")
    monkeypatch.chdir("/")
    assert Scene.from_file(tmp_path / "scene.toml")["snapshot"] == str(universe)


@pytest.mark.parametrize("size", ["64x48", (64, 48), [64.0, 48]])
def test_a_size_is_two_numbers_or_a_word(particles, size):
    assert splotchcl.suggest(particles, size=size)["image.size"] == [64, 48]


@pytest.mark.parametrize("size", ["64", "64x", 64, (64,), ("a", "b")])
def test_another_size_is_refused(particles, size):
    with pytest.raises(UsageError, match="size: found .* expected width and height"):
        splotchcl.suggest(particles, size=size)


def test_an_orbit_comes_round(particles):
    scene = splotchcl.suggest(particles)
    frames = scene.orbit(4)
    assert len(frames) == 4
    start, center = (np.array(scene[f"camera.{key}"]) for key in ("position", "look_at"))
    opposite = np.array(frames[2]["camera.position"])
    distance = np.linalg.norm(start - center)
    assert np.linalg.norm(opposite - center) == pytest.approx(distance)
    sky = np.array(scene["camera.sky"]) / np.linalg.norm(scene["camera.sky"])
    both = start + opposite - 2 * center  # what is left lies along the axis
    assert both - sky * (both @ sky) == pytest.approx(np.zeros(3), abs=1e-3 * distance)


@pytest.mark.parametrize("text", ["component = 3", "x = [", "[image]\nsize = 'a'"])
def test_text_that_is_no_scene_is_a_usage_error(text):
    with pytest.raises(UsageError):
        Scene.from_toml(text)


def test_a_missing_file_is_an_oserror(tmp_path):
    with pytest.raises(OSError, match="missing.toml"):
        Scene.from_file(tmp_path / "missing.toml")
    with pytest.raises(OSError, match="missing"):
        splotchcl.render(tmp_path / "missing")


@pytest.mark.parametrize("wrong", [3, None, [1], object()])
def test_what_is_no_scene_is_a_usage_error(wrong):
    with pytest.raises(UsageError, match="expected a Scene"):
        splotchcl.render(wrong, device="reference")


def test_an_unknown_device_is_a_usage_error(renderer):
    with pytest.raises(UsageError, match="no such thing"):
        splotchcl.Renderer("no such thing")



@pytest.fixture(params=["a snapshot", "its path"])
def suggested(request, universe) -> Scene:
    what = splotchcl.Snapshot(universe) if request.param == "a snapshot" else universe
    return splotchcl.suggest(what, size=(32, 32))


def test_another_field_of_a_suggested_scene_has_a_range_of_its_own(suggested):
    assert suggested["component.gas.color.max"] is not None
    suggested["component.gas.color.field"] = "mass"
    assert suggested["component.gas.color.min"] is None
    assert suggested["component.gas.color.max"] is None


def test_another_field_of_a_suggested_scene_keeps_limits_that_were_set(suggested):
    suggested["component.gas.color.min"] = 3.0
    suggested["component.gas.color.field"] = "mass"
    assert suggested["component.gas.color.min"] == 3.0
    assert suggested["component.gas.color.max"] is None


def test_a_suggested_scene_takes_the_field_of_view_of_a_projection_of_wide_angles(suggested):
    suggested["camera.projection"] = "cube"
    assert suggested["camera.field_of_view"] is None


@pytest.fixture
def snapshot(tmp_path):
    """Particles of two types in a file, of which half have a density above 1."""
    path = tmp_path / "two.npz"
    x = np.random.default_rng(5).uniform(0, 10, (200, 3))
    np.savez(path, pos=x, density=np.repeat([0.5, 2.0], 100), hsml=np.full(200, 1.0))
    return splotchcl.Snapshot(path)


SHOWN = {"types": "gas", "where": ["density > 1", "x < 9"], "field": "log10(density)",
         "palette": "viridis", "center": (1, 2, 3), "width": 4}


def what_is_shown(scene):
    component = {key: scene[f"component.0.{key}"]
                 for key in ("types", "select.where", "color.formula", "palette")}
    return component, scene["camera.look_at"], scene["camera.position"]


def test_keywords_show_what_options_show(snapshot):
    path = snapshot.files[0]
    component, look_at, _ = what_is_shown(splotchcl.suggest(path, **SHOWN))
    assert component == {"types": ["gas"], "select.where": ["density > 1", "x < 9"],
                         "color.formula": "log10(density)", "palette": "viridis"}
    assert look_at == [1, 2, 3]


def test_keywords_show_the_same_of_paths_snapshots_and_scenes(snapshot):
    expected = what_is_shown(splotchcl.suggest(snapshot.files[0], **SHOWN))
    assert what_is_shown(splotchcl.suggest(snapshot, **SHOWN)) == expected
    image = splotchcl.reference(splotchcl.suggest(snapshot), snapshot, size=(4, 4), **SHOWN)
    assert what_is_shown(image.scene) == expected


def test_lengths_with_units_are_converted():
    astropy_units = pytest.importorskip("astropy.units")
    x = np.random.default_rng(5).uniform(0, 10, (50, 3)) * astropy_units.kpc
    particles = splotchcl.Particles().add("gas", position=x, smoothing_length=1 * np.ones(50) * astropy_units.kpc)
    scene = splotchcl.suggest(particles, center="0.001,0.002,0.003 Mpc", width=4000 * astropy_units.pc)
    assert scene["camera.look_at"] == pytest.approx([1, 2, 3])
    assert scene["camera.position"] == pytest.approx(
        splotchcl.suggest(particles, center=(1, 2, 3), width=4)["camera.position"])


@pytest.mark.parametrize(
    ("shown", "error"),
    [({"types": "stars"}, "types: found stars"), ({"center": "1,2"}, "center: found \"1,2\""),
     ({"width": -1}, "width: found"), ({"width": [1]}, r"width: found \[1\], expected a length"),
     ({"where": 3}, "where: found 3"), ({"field": 3}, "field: found 3")],
)
def test_what_cannot_be_shown_is_a_usage_error(snapshot, shown, error):
    with pytest.raises(UsageError, match=error):
        splotchcl.suggest(snapshot, **shown)


def test_another_keyword_is_a_type_error(snapshot):
    with pytest.raises(TypeError, match="'centre', expected one of types, where"):
        splotchcl.render(snapshot, centre="densest")
