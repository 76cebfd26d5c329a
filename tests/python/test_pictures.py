"""Pictures have the bits of the command line's, and keep their tolerance."""

import base64
import os
import sys
from pathlib import Path

import numpy as np
import pytest

import splotchcl
from conftest import run_python
from splotchcl import Image, Scene, Snapshot, UsageError

SIZE = (96, 64)


def test_a_snapshot_has_the_bits_of_the_command_line(renderer, program, universe, tmp_path):
    program("render", universe, "--size", "96x64", "-o", tmp_path / "program.exr")
    image = renderer.render(universe, size=SIZE)
    assert np.array_equal(image.linear, Image.open(tmp_path / "program.exr").linear)


def test_a_saved_picture_has_the_bytes_of_the_command_line(renderer, program, universe, tmp_path):
    program("render", universe, "--size", "96x64", "-o", tmp_path / "program.png")
    renderer.render(universe, size=SIZE).save(tmp_path / "python.png")
    assert (tmp_path / "python.png").read_bytes() == (tmp_path / "program.png").read_bytes()


def test_a_notebook_shows_the_bytes_of_a_saved_picture(renderer, particles, tmp_path):
    image = renderer.render(particles, size=SIZE)
    image.save(tmp_path / "a.png")
    assert image._repr_png_() == (tmp_path / "a.png").read_bytes()


def test_display_values_are_those_of_a_saved_picture(renderer, particles, tmp_path):
    image = renderer.render(particles, size=SIZE, settings={"image.gamma": 2.2})
    image.save(tmp_path / "a.png")
    stored = np.rint(Image.open(tmp_path / "a.png").linear[..., :3] * 255).astype(np.uint8)
    assert image.display().any()
    assert np.array_equal(image.display(), stored)


def test_a_scene_and_its_snapshot_draw_what_the_path_draws(renderer, universe):
    snapshot = Snapshot(universe)
    scene = splotchcl.suggest(snapshot, size=SIZE)
    by_scene = renderer.render(scene, snapshot)
    assert np.array_equal(by_scene.linear, renderer.render(universe, size=SIZE).linear)


def test_arrays_of_a_file_draw_what_the_file_draws(renderer, universe):
    snapshot = Snapshot(universe)
    scene = splotchcl.suggest(snapshot, size=SIZE, settings={"tolerance": 1e-3})
    particles = splotchcl.Particles(box_size=snapshot.box_size)
    for name, matter in snapshot.types.items():
        fields = {field: matter[field] for field in matter.fields if field != "id"}
        particles.add(name, **fields)
    assert np.array_equal(
        renderer.render(scene, particles).linear, renderer.render(scene, snapshot).linear
    )


@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
def test_a_picture_keeps_its_tolerance(renderer, particles, tolerance):
    as_drawn = {"finish.tone": "linear", "finish.exposure": 0, "finish.white": 1}
    image = renderer.render(particles, size=SIZE, tolerance=tolerance, settings=as_drawn)
    exact = splotchcl.reference(image.scene, particles)
    difference = image.compare(exact, limit=tolerance)
    assert exact.linear[..., :3].max() > 0.1
    assert difference.worst <= tolerance
    assert difference.pixels_beyond == 0


def test_pictures_of_different_sizes_are_not_compared(renderer, particles):
    image = renderer.render(particles, size=SIZE)
    with pytest.raises(UsageError, match="96x64"):
        image.compare(renderer.render(particles, size=(32, 32)))


def test_linear_light_is_a_view_that_outlives_its_picture(renderer, particles):
    image = renderer.render(particles, size=SIZE)
    linear = image.linear
    assert np.shares_memory(linear, image.linear)
    assert linear.shape == (64, 96, 4) and linear.dtype == np.float32
    kept = linear.copy()
    del image
    assert np.array_equal(linear, kept)
    with pytest.raises(ValueError):
        linear[0, 0, 0] = 1


def test_a_scene_of_two_eyes_has_two_pictures(renderer, particles):
    scene = splotchcl.suggest(particles, size=SIZE, settings={"stereo.angle": 2})
    assert sorted(renderer.render_all(scene, particles)) == ["_left", "_right"]
    with pytest.raises(UsageError, match="2 pictures"):
        renderer.render(scene, particles)


def test_notes_tell_of_bad_particles(renderer, arrays):
    arrays["position"][:3] = np.nan
    image = renderer.render(splotchcl.Particles().gas(**arrays), size=SIZE)
    assert any("3 of 500 particles are left out" in note for note in image.notes)
    assert image.stats["bad_particles"] == 3


def test_the_extent_is_the_width_at_the_look_at_point(renderer, particles):
    scene = splotchcl.suggest(particles, size=(100, 50))
    scene.update(
        {
            "camera.position": [5, 5, 0],
            "camera.look_at": [5, 5, 5],
            "camera.sky": [0, 1, 0],
            "camera.field_of_view": 90,
        }
    )
    assert renderer.render(scene, particles).extent == pytest.approx((-5, 5, -2.5, 2.5))


def test_a_wide_angle_has_no_extent(renderer, particles):
    scene = splotchcl.suggest(particles, size=SIZE)
    del scene["camera.field_of_view"]
    scene["camera.projection"] = "fisheye"
    with pytest.raises(UsageError, match="fisheye"):
        _ = renderer.render(scene, particles).extent


def test_a_color_bar_has_the_scene_s_range(renderer, particles):
    figure = pytest.importorskip("matplotlib.figure").Figure()
    axes = figure.add_subplot()
    image = renderer.render(particles, size=SIZE)
    bar = image.colorbar(axes, 0)
    low, high = image.scene["component.0.color.min"], image.scene["component.0.color.max"]
    assert (bar.vmin, bar.vmax) == pytest.approx((low, high))
    assert bar.ax.get_ylabel() == image.scene["component.0.color.field"]


def test_a_decided_scene_draws_what_it_drew_before(renderer, particles):
    scene = Scene({"image": {"size": SIZE}, "component": [{"types": ["gas"]}]})
    decided = scene.decide(particles)
    assert decided["camera.position"] is not None
    assert np.array_equal(
        renderer.render(scene, particles).linear, renderer.render(decided, particles).linear
    )


def test_an_unknown_ending_is_a_usage_error(renderer, particles, tmp_path):
    image = renderer.render(particles, size=SIZE)
    with pytest.raises(ValueError, match=r"\.gem"):
        image.save(tmp_path / "a.gem")
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_missing_is_an_oserror(renderer, particles, tmp_path):
    image = renderer.render(particles, size=SIZE)
    with pytest.raises(OSError, match="missing"):
        image.save(tmp_path / "missing" / "a.png")


# A PNG file that ends early, with a color profile that says it has a text of more bytes than are
# there, at which OpenImageIO 2.4 crashes.
DAMAGED_PROFILE = """
iVBORw0KGgoAAAANSUhEUgAAAFAAAAA8CAIAAAB+RarbAAABdmlDQ1BJQ0MgUHJvZmlsZQAAeJx1kb1LQmEUhx+1KNJwqCHC4A4WDQpREI1lg4
uEmEFWi16/Aj8u9yohrUFLg9AQtfQ19B/UGrQWBEERRDQ39rWE3M5VQQk9l/eeh997fodzzwV7KKfmjZ55yBdKeiQYUFZja0rfO07GsOHDE1cN
bSEcDtE1fh6lUuLBb/XqXtcxnMmUoYKtX3hW1fSSsExDaKukWbwnPKxm40nhE2GfLgMK31p6osFvFmca/GWxHo0sgt3qqWTaONHGalbPC08Ke/
O5stqcx/oSV6qwsix5VI4HgwhBAigkKLNJjhJ+yQXZWWffVN0BAAAAAAAAAOjiyJAVr0/UsnRNSU6LnpInR8Xa+/99GumZ6UZ3VwB6X03zcxz6
9qFWNc3fU9OsnYHjBa4LLX9R9jT3LXq1pXmPwb0DlzctLXEAV7sw8qzF9Xhdcsixp9PwcQGDMRi6h4H1xq6a95w/QXRbftEdHB7BhNS7N/4AL1
VoH7FNFP8AAA6bSURBVHicnZtJcyQ5coXfc0Rkkr1oTGaaq/7/79JVJ9n0TJEZAX86uDuAyGRV9XRUGgu5MBIfnm9YSLT/AgkQ4Nrg9SlA0ACS
9QoJ2Hwav/X0FARRN4nG9y5BABQNQVC0BUh6eQqH1qeCfHwgGro+jQ==
"""


READERS = [
    "splotchcl.Image.open(path)",
    "splotchcl.galaxy(path, path + '.hdf5')",
    "splotchcl.reference(scene.copy(), few)",
    "scene.decide(few)",
    "splotchcl.movie(scene, path + '.mp4', device='reference')",
    "splotchcl.reference(fading, few)",
]


def error_of(call, folder, environment=None):
    """What Python says of the damaged picture; it must not end otherwise."""
    path = folder / "a.png"
    path.write_bytes(base64.b64decode(DAMAGED_PROFILE))
    script = f"""
import splotchcl, sys
import numpy as np
path = sys.argv[1]
few = splotchcl.Particles().add("gas", position=np.random.default_rng(0).random((10, 3)))
scene = splotchcl.suggest(few, size=(16, 12))
scene.copy().save(path + ".toml")
scene["image.background_image"] = path
scene.save(path + ".toml")
fading = splotchcl.suggest(few, size=(16, 12))
fading["finish.cross_fade.scene"] = path + ".toml"
fading["finish.cross_fade.amount"] = 0.5
try:
    {call}
except splotchcl.DataError as error:
    sys.exit(str(error))
"""
    ended = run_python("-c", script, path, environment=environment, timeout=120)
    assert ended.returncode == 1, ended.stderr
    return ended.stderr


@pytest.mark.parametrize("call", READERS[:3])  # the others fail by what else is not there
def test_a_picture_with_a_damaged_color_profile_does_not_end_python(tmp_path, call):
    assert "is damaged" in error_of(call, tmp_path)


@pytest.mark.parametrize("call", READERS)
def test_a_picture_that_crashes_a_library_does_not_end_python(tmp_path, call):
    build = Path(os.environ.get("SPLOTCHCL_PROGRAM", "nowhere")).parent
    crashing_calls = build / "tests" / "faults" / "libcrashing_calls.so"
    if not crashing_calls.is_file():
        pytest.skip("SPLOTCHCL_PROGRAM names no program with the tests' libraries beside it")
    environment = {
        "LD_PRELOAD": str(crashing_calls),
        "SPLOTCHCL_CRASH": "png_create_read_struct",
        "SPLOTCHCL_CRASH_IN": Path(sys.executable).name,
    }
    assert "crashed" in error_of(call, tmp_path, environment)


def test_who_reads_a_picture_first_runs_no_code_of_the_current_folder(tmp_path):
    for name in ("splotchcl.py", "numpy.py", "os.py"):
        (tmp_path / name).write_text("open('code_ran', 'w')\n")
    script = tmp_path / "elsewhere" / "script.py"
    script.parent.mkdir()
    script.write_text(
        "import splotchcl, sys\n"
        "try:\n    splotchcl.Image.open(sys.argv[1])\n"
        "except splotchcl.DataError:\n    sys.exit(3)\n"
    )
    (tmp_path / "a.png").write_bytes(base64.b64decode(DAMAGED_PROFILE))
    folders = os.pathsep.join(os.path.abspath(folder) for folder in sys.path if folder)
    ended = run_python(script, "a.png", environment={"PYTHONPATH": folders}, folder=tmp_path,
                       timeout=120)
    assert ended.returncode == 3
    assert not (tmp_path / "code_ran").exists()
