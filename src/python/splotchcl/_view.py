"""The live view in a notebook."""

from __future__ import annotations

import importlib
import json
import os
import subprocess
import sys
import tempfile
import weakref
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._core import DataError, UsageError
from ._particles import Particles
from ._process import environment_with_modules
from ._program import PROGRAM
from ._render import keys_of, open_drawable
from ._scene import Scene
from ._shown import Shown
from ._sources import Snapshot

if TYPE_CHECKING:
    from typing_extensions import Unpack

_PAGE = Path(__file__).parent / "_view.js"
# The pipe ends with this process, however that ends.
_GUARD = """
import subprocess, sys, threading
child = subprocess.Popen(sys.argv[1:], stdin=subprocess.DEVNULL)
def end():
    sys.stdin.buffer.read()
    child.terminate()
    try:
        child.wait(5)
    except subprocess.TimeoutExpired:
        child.kill()
threading.Thread(target=end, daemon=True).start()
raise SystemExit(child.wait())
"""
_RUN_PROGRAM = "from splotchcl._program import main; main()"


class View:
    """The live view of `splotchcl view` as a notebook's output.

    What is done in the page is in `scene`, and what is set there is shown. It needs the package
    anywidget, and the program, and ends with the kernel.

    Parameters
    ----------
    scene : Scene, Snapshot or path-like
        As for `splotchcl.render`: a scene file, or a snapshot, for which a scene is chosen.
    size : (int, int) or str, optional
        Of the picture in pixels; 960 x 600 for snapshots.
    settings : mapping, optional
        Scene keys that override the scene's.
    types, where, field, palette, center, width
        As for `splotchcl.render`.

    Raises
    ------
    UsageError, DataError
        As `splotchcl.render`; also for particles that are in no file.
    """

    def __init__(
        self,
        scene: Scene | Snapshot | str | os.PathLike[str],
        *,
        size: tuple[int, int] | str | None = None,
        settings: Mapping[str, Any] | None = None,
        **shown: Unpack[Shown],
    ) -> None:
        if isinstance(scene, Particles):
            raise UsageError(
                "View: found particles in memory, expected a file, which the view opens by itself"
            )
        if size is None and not _is_scene(scene):
            size = (960, 600)
        drawable = open_drawable(scene, None, keys_of(size, None, settings), shown)
        self._scene = drawable.scene.copy()
        self._keys: frozenset[str] = frozenset()  # that the page can change, once it has told
        self._servers: dict[str, ViewServer] = {}
        self._widget: Any = None
        self._folder = tempfile.TemporaryDirectory(prefix="splotchcl-view-")
        self._closing = weakref.finalize(self, _close, self._servers, self._folder)

    @property
    def scene(self) -> Scene:
        """What is shown now: `view.scene["camera.position"] = [1, 2, 3]` changes it.

        Set another scene to show that, of the same components. The page has all keys that it shows
        controls for; UsageError names one that it has not.
        """
        return _SceneOfView(self)

    @scene.setter
    def scene(self, scene: Scene) -> None:
        changes = _differences(self._scene, scene)
        if self._widget is not None and self._servers:
            self._refuse_unknown(changes)
            self._widget.send({"kind": "set", "settings": changes})
        self._scene = scene.copy()

    def close(self) -> None:
        """Ends the program that serves the page."""
        if self._widget is not None:
            self._widget.close()
        self._closing()

    def _refuse_unknown(self, changes: Mapping[str, Any]) -> None:
        for key in changes:
            if self._keys and _without_number(key) not in self._keys:
                raise UsageError(
                    f"key {key}: a view that is shown cannot change it; make another View"
                )

    def _repr_mimebundle_(self, **keywords: Any) -> Any:
        if self._widget is None:
            self._widget = _new_widget(self._take)
        return self._widget._repr_mimebundle_(**keywords)

    # A message of the page.
    def _take(self, widget: Any, content: Mapping[str, Any]) -> None:
        kind = content.get("kind")
        if kind == "shown":
            widget.send(self._open(str(content.get("origin", ""))))
        elif kind == "opened":
            self._keys = frozenset(map(_without_number, content["keys"]))
        elif kind == "scene":
            self._scene = Scene.from_toml(content["toml"])

    # The page's address for whom shows it, or why there is none.
    def _open(self, origin: str) -> dict[str, str]:
        origin = origin if origin.startswith("http") else ""
        server = self._servers.get(origin)
        try:
            if server is None or not server.is_open():
                path = Path(self._folder.name) / "notebook.toml"
                self._scene.save(path)
                server = self._servers[origin] = ViewServer(path, origin)
        except (UsageError, DataError, OSError) as error:
            return {"kind": "problem", "text": str(error)}
        return {"kind": "page", "address": server.address}


# Which has a size of its own.
def _is_scene(what: Scene | Snapshot | str | os.PathLike[str]) -> bool:
    if isinstance(what, str | os.PathLike):
        return Path(what).suffix in (".toml", ".par")
    return isinstance(what, Scene)


# What is set in it is set in the view.
class _SceneOfView(Scene):
    def __init__(self, view: View) -> None:
        self._scene, self._suggested = view._scene._scene, view._scene._suggested
        self._view = view

    def _change(self, settings: list[str]) -> None:
        with self._showing_change():
            super()._change(settings)

    def __delitem__(self, key: str) -> None:
        with self._showing_change():
            super().__delitem__(key)

    # What the view refuses is as it was here, too.
    @contextmanager
    def _showing_change(self) -> Iterator[None]:
        before = self._scene
        yield
        try:
            self._view.scene = self
        except UsageError:
            self._scene = before
            raise


# By key, what the page is to set: None is left to the data.
def _differences(old: Scene, new: Scene) -> dict[str, Any]:
    before, after = (_values(scene) for scene in (old, new))
    changes = {}
    for key in sorted(before.keys() | after.keys()):
        value = after.get(key)
        if value != before.get(key):
            changes[key] = None if value == "auto" else value
    return changes


def _values(scene: Scene) -> dict[str, Any]:
    return {key: json.loads(json.dumps(scene[key])) for key in scene}


def _without_number(key: str) -> str:
    words = key.split(".")
    return ".".join(word for i, word in enumerate(words) if i != 1 or words[0] != "component")


def _close(servers: dict[str, ViewServer], folder: Any) -> None:
    for server in servers.values():
        server.close()
    folder.cleanup()


def _new_widget(take: Callable[[Any, Mapping[str, Any]], None]) -> Any:
    try:
        anywidget = importlib.import_module("anywidget")
    except ImportError as error:
        raise ImportError(
            "View needs the package anywidget: pip install anywidget, and restart the kernel"
        ) from error
    widget = anywidget.AnyWidget(_esm=_PAGE.read_text(encoding="utf-8"))
    widget.on_msg(lambda _, content, __: take(widget, content))
    return widget


class ViewServer:
    """Serves the page of a scene file until it is closed.

    Parameters
    ----------
    scene
        The scene file.
    origin
        Of the page that shows it in a frame; empty: none does.

    Raises
    ------
    UsageError, DataError
        With what the program says.
    """

    def __init__(self, scene: Path, origin: str = "") -> None:
        words = [*_program(), "view", str(scene), "--quiet"]
        if origin:
            words += ["--frame-in", origin]
        with tempfile.TemporaryFile() as errors:
            self._process = subprocess.Popen(
                [*_python(_GUARD), *words],
                env=environment_with_modules(),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
            )
            assert self._process.stdout is not None
            self.address = self._process.stdout.readline().decode().strip()
            if not self.address:
                code = self._process.wait()
                errors.seek(0)
                message = errors.read().decode(errors="replace").strip().removeprefix("splotchcl: ")
                self.close()
                raise UsageError(message) if code == 2 else DataError(message)

    def close(self) -> None:
        """Ends the program."""
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()
        self._process.wait()

    def is_open(self) -> bool:
        return self._process.poll() is None


# What a wheel brings along needs its own OpenCL chosen first.
def _program() -> list[str]:
    if PROGRAM.exists():
        return _python(_RUN_PROGRAM)
    for folder in os.get_exec_path():
        program = Path(folder) / "splotchcl"
        if program.is_absolute() and os.access(program, os.X_OK) and program.is_file():
            return [str(program)]
    raise UsageError(
        "no program splotchcl in PATH, and none in this package; expected one, which a view is "
        "served by: install it (docs/packages.md)"
    )


# What lies in the current folder, where the view writes its files, is no module (-P from 3.11 on).
def _python(code: str) -> list[str]:
    return [sys.executable, "-c", f"import sys; sys.path[:] = [p for p in sys.path if p]\n{code}"]
