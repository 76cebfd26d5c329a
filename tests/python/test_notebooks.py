"""What a notebook shows and completes."""

import base64
from pathlib import Path

import numpy as np
import pytest

import splotchcl
from splotchcl import Film, Particles, Scene, Snapshot


def test_a_map_shows_itself_as_a_figure(renderer, universe):
    drawn = splotchcl.column(universe, types="gas", size=(32, 32))
    before = list(drawn.notes)
    assert drawn._repr_png_().startswith(b"\x89PNG")
    assert drawn.notes == before


def film_of(tmp_path, name, data, state="complete") -> Film:
    path = Path(tmp_path, name)
    path.write_bytes(data)
    return Film(path, state, 1, [])


def test_a_film_shows_itself_with_its_data(tmp_path):
    shown = film_of(tmp_path, "a.mp4", b"film")._repr_html_()
    assert shown.startswith("<video")
    assert f"data:video/mp4;base64,{base64.b64encode(b'film').decode()}" in shown


def test_a_large_film_says_so_instead(tmp_path):
    shown = film_of(tmp_path, "a<b.webm", bytes(20_000_001))._repr_html_()
    assert "too large to be shown here" in shown
    assert "a&lt;b.webm" in shown and "<video" not in shown


@pytest.mark.parametrize(
    ("name", "state"), [("frame_%04d.png", "complete"), ("a.mp4", "part is drawn")]
)
def test_what_is_no_film_yet_shows_nothing(tmp_path, name, state):
    assert film_of(tmp_path, name, b"", state)._repr_html_() is None


def test_a_scene_completes_its_keys():
    scene = Scene({"component": [{"types": ["gas"], "name": "hot"}, {"types": ["stars"]}]})
    keys = scene._ipython_key_completions_()
    for key in ("image.width", "camera.position", "component.hot.palette", "component.1.color.formula"):
        assert key in keys
        scene[key]  # all that is offered exists
    assert not any(key.startswith("component.palette") for key in keys)


def test_a_snapshot_completes_types_and_fields(universe):
    snapshot = Snapshot(universe)
    assert snapshot._ipython_key_completions_() == ["gas", "stars"]
    offered = snapshot["gas"]._ipython_key_completions_()
    assert {"position", "mass", "temperature"} <= set(offered)


def without_lengths(count: int = 3000) -> tuple[np.ndarray, Particles]:
    position = np.random.default_rng(1).normal(5, 1, (count, 3)).astype(np.float32)
    return position, Particles().gas(position=position, mass=np.ones(count, np.float32))


def search_of(particles) -> list[str]:
    told = []

    def progress(what, fraction):
        if "finding smoothing lengths" in what:
            told.append(what)

    splotchcl.render(particles, size=(16, 16), progress=progress, device="reference")
    return told


def test_smoothing_lengths_are_searched_once_for_positions_that_stay():
    _, particles = without_lengths()
    assert search_of(particles)
    assert not search_of(particles)


def test_smoothing_lengths_are_searched_anew_for_positions_that_move():
    position, particles = without_lengths()
    before = np.array(particles["gas"]["smoothing_length"])
    assert search_of(particles) == [] or before.size
    position *= 2
    assert search_of(particles)
    assert np.allclose(particles["gas"]["smoothing_length"], 2 * before, rtol=1e-4)


def test_objects_of_pynbody_are_taken_alike_whatever_was_derived_before(real_file):
    pynbody = pytest.importorskip("pynbody")
    path = str(real_file("lcdm/fmt2_snapshot_006"))
    fresh = Particles.of(pynbody.load(path))
    used = pynbody.load(path)
    used.gas["temp"], used.dm["smooth"], used.dm["rho"]
    again = Particles.of(used)
    for name, kind in fresh.types.items():
        assert kind.fields.keys() == again[name].fields.keys()
    temperature = Snapshot(path)["gas"]["temperature"]
    for particles in (fresh, again):
        assert np.allclose(particles["gas"]["temperature"], temperature, rtol=1e-5)
