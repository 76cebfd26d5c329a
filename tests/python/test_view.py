"""The live view as a notebook's output, without a notebook."""

from __future__ import annotations

import os
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path
from types import SimpleNamespace

import pytest
from conftest import make_arrays

import splotchcl
from splotchcl import Particles, Scene, UsageError, View

NOTEBOOK = "http://localhost:8888"
PATIENCE = 180


class Widget:
    """What anywidget makes, as far as a view uses it."""

    def __init__(self, _esm):
        self.script = _esm
        self.sent = []

    def on_msg(self, take):
        self.take = take

    def send(self, content):
        self.sent.append(content)

    def close(self):
        pass

    def _repr_mimebundle_(self, **_):
        return {"application/vnd.jupyter.widget-view+json": {}}


@pytest.fixture
def notebook(monkeypatch):
    """Where widgets are those above, and the program of this build is found."""
    monkeypatch.setitem(sys.modules, "anywidget", SimpleNamespace(AnyWidget=Widget))
    if "SPLOTCHCL_PROGRAM" not in os.environ:
        pytest.skip("SPLOTCHCL_PROGRAM does not name the program")
    folder = Path(os.environ["SPLOTCHCL_PROGRAM"]).parent
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")


@pytest.fixture
def shown(notebook, renderer, universe):
    """A view, and its widget once a notebook has shown it."""
    view = View(universe, size=(64, 48))
    assert "application/vnd.jupyter.widget-view+json" in view._repr_mimebundle_()
    widget = view._widget
    widget.take(widget, {"kind": "shown", "origin": NOTEBOOK}, [])
    yield view, widget
    view.close()


def get(address):
    with urllib.request.urlopen(address, timeout=PATIENCE) as answer:
        return answer.read().decode(), answer.headers


def is_served(address):
    try:
        get(address)
    except (urllib.error.URLError, ConnectionError):
        return False
    return True


def test_serves_the_page_for_the_notebook_alone_until_it_is_closed(shown):
    view, widget = shown
    (told,) = widget.sent
    assert told["kind"] == "page"
    text, headers = get(told["address"])
    assert "<!doctype html>" in text
    assert headers["Content-Security-Policy"].endswith(f"frame-ancestors {NOTEBOOK}")
    view.close()
    assert not is_served(told["address"])


def test_what_is_set_is_shown_and_nothing_else(shown):
    view, widget = shown
    position = list(view.scene["camera.position"])
    view.scene["camera.position"] = [1, 2, 3]
    view.scene.update({"component.gas.palette": "fire", "finish.exposure": "auto"})
    told = [message["settings"] for message in widget.sent if message["kind"] == "set"]
    assert told[0] == {"camera.position": [1, 2, 3]}
    assert told[1]["component.0.palette"] == "fire" and "camera.position" not in told[1]
    assert told[1].get("finish.exposure") is None
    assert position != view.scene["camera.position"] == [1, 2, 3]


def test_what_the_page_does_is_in_the_scene(shown):
    view, widget = shown
    there = view.scene.copy()
    there["camera.position"] = [4, 5, 6]
    widget.take(widget, {"kind": "scene", "toml": there.to_toml()}, [])
    assert view.scene == there


def test_keys_that_the_page_has_not_are_refused(shown):
    view, widget = shown
    widget.take(widget, {"kind": "opened", "keys": ["camera.position", "component.0.palette"]}, [])
    sent = len(widget.sent)
    scene = view.scene
    with pytest.raises(UsageError, match=r"key image\.gamma: a view that is shown cannot"):
        scene["image.gamma"] = 1.5
    assert len(widget.sent) == sent
    assert scene["image.gamma"] == view.scene["image.gamma"] != 1.5
    view.scene["component.1.palette"] = "fire"
    assert len(widget.sent) == sent + 1


def test_what_cannot_be_served_is_said_in_the_notebook(notebook, universe, tmp_path):
    scene = splotchcl.suggest(universe)
    view = View(scene)
    view._repr_mimebundle_()
    universe_was = scene["snapshot"]
    view._scene = Scene.from_toml(scene.to_toml().replace(universe_was, str(tmp_path / "gone")))
    view._take(view._widget, {"kind": "shown", "origin": NOTEBOOK})
    (told,) = view._widget.sent
    assert told["kind"] == "problem" and "gone" in told["text"]
    view.close()


def test_particles_in_memory_are_refused():
    with pytest.raises(UsageError, match="found particles in memory, expected a file"):
        View(Particles().gas(**make_arrays(10)))


def test_says_what_to_install(monkeypatch, universe):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(ImportError, match="pip install anywidget"):
        View(universe)._repr_mimebundle_()


KERNEL = """
import sys, time
from pathlib import Path
from splotchcl import suggest
from splotchcl._view import ViewServer
suggest(sys.argv[1], size=(64, 48)).save(sys.argv[2])
print(ViewServer(Path(sys.argv[2])).address, flush=True)
time.sleep(1000)
"""


def test_ends_with_a_kernel_that_is_killed(shown, universe, tmp_path):
    words = [sys.executable, "-c", KERNEL, str(universe), str(tmp_path / "scene.toml")]
    kernel = subprocess.Popen(words, stdout=subprocess.PIPE, text=True)
    address = kernel.stdout.readline().strip()
    assert is_served(address)
    kernel.kill()
    kernel.communicate()
    deadline = time.monotonic() + PATIENCE
    while is_served(address):
        assert time.monotonic() < deadline, "the page is still served"
        time.sleep(0.1)
