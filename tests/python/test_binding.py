"""The module between Python and C++: one file for every Python, and nothing lost or kept on the way."""

import gc
import sys

import numpy as np
import pytest
import splotchcl
from conftest import run_python
from splotchcl import _core


def some_particles():
    places = np.random.default_rng(3).random((50, 3), np.float32)
    return splotchcl.Particles(box_size=1).gas(position=places, mass=1.0)


def test_one_file_fits_every_python():
    assert _core.__file__.endswith(".abi3.so")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: _core.open_snapshot(3, []), "open_snapshot: argument 1: found 3, expected a path"),
        (lambda: _core.read_scene("a", "b"), "read_scene: argument 2: found 'b', expected a list"),
        (lambda: _core.parse_scene("a"), "parse_scene: found 1 arguments, expected 2"),
        (lambda: _core.particle_type_name(2**40), "expected a whole number between"),
        (lambda: _core.is_unit("\ud800", ""), "is_unit: argument 1: .* expected text"),
        (lambda: _core.snapshot_of(_core.ParticleArrays()), "expected a Scene"),
        (lambda: _core.ParticleArrays().set_mass(0, "much"), "found 'much', expected a number"),
    ],
)
def test_wrong_arguments_are_told(call, message):
    with pytest.raises(TypeError, match=message):
        call()


def test_objects_are_made_once_and_by_functions_of_the_module():
    with pytest.raises(TypeError, match="made by functions"):
        _core.Scene()
    arrays = _core.ParticleArrays()
    with pytest.raises(TypeError, match="made already"):
        arrays.__init__()


def test_objects_that_hold_nothing_are_refused():
    empty = _core.ParticleArrays.__new__(_core.ParticleArrays)
    with pytest.raises(TypeError, match="expected a ParticleArrays"):
        empty.set_mass(0, 1.0)


def test_arrays_in_python_are_those_in_cpp_and_outlive_what_gave_them():
    particles = some_particles()
    image = splotchcl.render(particles, size=(32, 32))
    picture = image._picture
    linear = np.asarray(picture)
    assert linear.__array_interface__["data"] == picture.__array_interface__["data"]
    before = linear.copy()
    del image, picture
    gc.collect()
    assert (linear == before).all()
    with pytest.raises(ValueError, match="read-only"):
        linear[0, 0, 0] = 1


def test_an_array_is_kept_while_it_is_used_and_no_longer():
    values = np.ones((10, 3), np.float32)
    arrays = _core.ParticleArrays()
    before = sys.getrefcount(values)
    arrays.set_field(0, "position", values, "")
    assert sys.getrefcount(values) == before + 1
    arrays.clear(0)
    assert sys.getrefcount(values) == before


@pytest.mark.parametrize("kind", [np.int32, ">f4", np.float16])
def test_arrays_of_another_kind_are_refused(kind):
    with pytest.raises(TypeError, match="expected a numpy array of floats or doubles"):
        _core.ParticleArrays().set_field(0, "mass", np.ones(3, kind), "")


def test_what_a_progress_callable_raises_comes_back_itself_and_is_let_go():
    class Stop(Exception):
        pass

    raised = Stop("enough")

    def stop(what, part):
        raise raised

    with pytest.raises(Stop) as caught:
        splotchcl.render(some_particles(), size=(32, 32), progress=stop)
    assert caught.value is raised
    assert caught.traceback[-1].name == "stop"
    del caught
    raised.__traceback__ = None
    gc.collect()
    assert sys.getrefcount(raised) == 2  # here and as the argument


def test_calls_keep_nothing():
    scene = splotchcl.Scene({})._scene
    settings = ["image.size=[8, 8]"]

    def call_all():
        scene.with_settings(settings, None).to_toml()
        assert scene.size
        with pytest.raises(TypeError):
            scene.with_settings(3, None)

    call_all()
    counts = [sys.getrefcount(item) for item in (scene, settings, settings[0], type(scene), None)]
    for _ in range(1000):
        call_all()
    after = [sys.getrefcount(item) for item in (scene, settings, settings[0], type(scene), None)]
    # None never changes from 3.12 on; before, others count it as well.
    assert after[:4] == counts[:4]
    assert abs(after[4] - counts[4]) < 500


def test_python_ends_well_with_objects_alive():
    code = "from splotchcl import _core; a = _core.ParticleArrays(); b = _core.parse_scene('', [])"
    done = run_python("-c", code)
    assert (done.returncode, done.stderr) == (0, "")
