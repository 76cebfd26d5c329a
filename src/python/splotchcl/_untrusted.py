"""Pictures that may make a library crash are read by another process first."""

from __future__ import annotations

import functools
import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _core, _toml
from ._core import DataError
from ._process import run_python

_READ = "import sys; from splotchcl import _core; _core.read_image(sys.argv[1])"


def check_picture(path: str | os.PathLike[str]) -> None:
    """Raises DataError for a picture that a process has crashed by.

    What else is wrong with it says who reads it then.
    """
    try:
        found = os.stat(path)
    except OSError:
        return
    crashed = _crashes(os.path.abspath(path), found.st_ino, found.st_size, found.st_mtime_ns)
    if crashed:
        raise DataError(
            f"{Path(path)}: cannot be read safely: a child process that read it crashed; the file "
            "is damaged: copy or write it again"
        )


def check_pictures_of(scene: _core.Scene) -> None:
    """The same of the picture behind the particles, and of that of the scene that is faded to."""
    text = scene.to_toml()
    if "background_image" not in text and "cross_fade" not in text:
        return
    tables = _toml.parse(text)
    _check_behind(tables)
    other = tables.get("finish", {}).get("cross_fade", {}).get("scene")
    if other:
        try:
            faded_to = _core.read_scene(Path(other), [])
        except _core.Error:
            return  # who draws it says what is wrong
        _check_behind(_toml.parse(faded_to.to_toml()))


def _check_behind(tables: Mapping[str, Any]) -> None:
    picture = tables.get("image", {}).get("background_image")
    if picture:
        check_picture(picture)


# The numbers tell a file that was written anew.
@functools.lru_cache(maxsize=256)
def _crashes(path: str, node: int, size: int, time: int) -> bool:
    if not sys.executable:
        return False
    return run_python(_READ, path) < 0
