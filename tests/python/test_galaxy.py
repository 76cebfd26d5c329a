"""A galaxy from a picture is what the command makes."""

import numpy as np
import pytest

import splotchcl
from splotchcl import DataError, Image, UsageError


@pytest.fixture(scope="module")
def picture(renderer, tmp_path_factory):
    """A round spot of light, as a picture of a galaxy."""
    random = np.random.default_rng(1)
    stars = random.normal(0, (1, 1, 0.1), (5000, 3)).astype(np.float32)
    particles = splotchcl.Particles().stars(position=stars, mass=1.0)
    scene = splotchcl.suggest(particles, size=(96, 96))
    path = tmp_path_factory.mktemp("galaxy") / "picture.png"
    renderer.render(scene, particles).save(path)
    assert Image.open(path).linear[..., :3].max() > 0.1
    return path


FEW = {"disk_stars": 500, "bulge_stars": 300, "clusters": 2, "cluster_stars": 20}


def test_a_galaxy_is_that_of_the_command(program, picture, tmp_path):
    made = splotchcl.galaxy(picture, tmp_path / "a.hdf5", size=20, clockwise=True, **FEW)
    few = [word for name, n in FEW.items() for word in ("--" + name.replace("_", "-"), n)]
    program("galaxy", picture, "-o", tmp_path / "b.hdf5", "--size", 20, "--clockwise", *few)
    expected = splotchcl.Snapshot(tmp_path / "b.hdf5")
    assert set(made.types) == set(expected.types) == {"gas", "disk", "bulge", "stars", "boundary"}
    for name, kind in made.types.items():
        for field in ("position", "mass", "velocity"):
            assert np.array_equal(kind[field], expected[name][field])


def test_a_galaxy_is_drawn(renderer, picture, tmp_path):
    made = splotchcl.galaxy(picture, tmp_path / "a.hdf5", **FEW)
    assert renderer.render(made, size=(48, 48)).linear[..., :3].max() > 0


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"wings": 2}, "there is no wings"),
        ({"inclination": 85}, "inclination"),
        ({"inclination": "steep"}, "inclination: found 'steep'"),
        ({"center": [1.0]}, "center"),
    ],
)
def test_wrong_settings_are_refused(picture, tmp_path, settings, message):
    with pytest.raises(UsageError, match=message):
        splotchcl.galaxy(picture, tmp_path / "a.hdf5", **settings)
    assert not (tmp_path / "a.hdf5").exists()


def test_the_picture_is_not_written_over(picture):
    with pytest.raises(UsageError, match="path"):
        splotchcl.galaxy(picture, picture)


def test_a_picture_that_is_not_there_is_refused(tmp_path):
    with pytest.raises(DataError):
        splotchcl.galaxy(tmp_path / "none.png", tmp_path / "a.hdf5")
