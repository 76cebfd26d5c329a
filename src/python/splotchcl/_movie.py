"""Films."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import _core, _toml
from ._opencl import using_opencl
from ._render import Progress, keys_of
from ._scene import Scene
from ._untrusted import check_pictures_of


@dataclass(frozen=True)
class Film:
    """What there is of a film."""

    path: Path
    state: str
    """"complete", "complete before", "part is drawn" or "joined by another"."""
    frames: int
    notes: list[str]


def movie(
    scene: Scene | str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    size: tuple[int, int] | str | None = None,
    tolerance: float | None = None,
    device: str | None = None,
    frames: str = "",
    part: str = "",
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Film:
    """Draws a film along a scene's path, as ``splotchcl movie`` does (docs/movies.md).

    A film that was interrupted goes on where it stopped. Particles in memory are drawn frame by
    frame instead: ``for scene in scene.orbit(250): renderer.render(scene, particles)``.

    Parameters
    ----------
    scene : Scene or path-like
        With a ``[path]`` and a snapshot.
    path : path-like
        A film (.mp4, .mov, .mkv, .webm), which needs ffmpeg, or numbered images "frame_%04d.png".
    frames : str
        "FIRST:END:STEP"; empty: all of the path.
    part : str
        "2/3" draws the second of three runs of frames, for several processes.
    size, tolerance, device, settings
        As for `render`.
    progress : callable, optional
        Called with what is being done and the fraction done before each frame. What it raises ends
        the film; the frames that were drawn are kept.

    Raises
    ------
    UsageError, DataError, DeviceError
    KeyboardInterrupt
        Between two frames.
    """
    pairs = [_toml.setting(k, v) for k, v in keys_of(size, tolerance, settings).items()]
    by_reference = device == "reference"
    name = "" if device is None or by_reference else device
    with tempfile.TemporaryDirectory() as folder:
        file = Path(scene) if not isinstance(scene, Scene) else Path(folder, "scene.toml")
        if isinstance(scene, Scene):
            scene.save(file)
        _check_pictures(file, pairs)
        with nullcontext() if by_reference else using_opencl():
            state, count, notes = _core.make_film(
                file, Path(path), pairs, name, by_reference, frames, part, progress
            )
    return Film(Path(path), state, count, notes)


def _check_pictures(file: Path, settings: list[str]) -> None:
    try:
        scene = _core.read_scene(file, settings)
    except _core.Error:
        return  # a snapshot, or who makes the film says what is wrong
    check_pictures_of(scene)
