"""Films."""

from __future__ import annotations

import base64
import html
import os
import tempfile
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._opencl import using_opencl
from ._render import Progress, keys_of
from ._scene import Scene
from ._shown import Shown, settings_of
from ._untrusted import check_pictures_of

if TYPE_CHECKING:
    from typing_extensions import Unpack


@dataclass(frozen=True)
class Film:
    """What there is of a film. In a notebook it shows itself, up to 20 MB of .mp4 and .webm."""

    path: Path
    state: str
    """"complete", "complete before", "part is drawn" or "joined by another"."""
    frames: int
    notes: list[str]

    def _repr_html_(self) -> str | None:
        kind = _SHOWN_KINDS.get(self.path.suffix.lower())
        if kind is None or not self.state.startswith("complete") or not self.path.is_file():
            return None
        size = self.path.stat().st_size
        if size > _MOST_SHOWN_BYTES:
            name = html.escape(str(self.path))
            return f"<p>{name}: {size / 1e6:.0f} MB, too large to be shown here</p>"
        data = base64.b64encode(self.path.read_bytes()).decode("ascii")
        return (
            f'<video controls loop style="max-width: 100%" src="data:{kind};base64,{data}"></video>'
        )


# What browsers play. A film is copied into the notebook: larger ones would make it slow.
_SHOWN_KINDS = {".mp4": "video/mp4", ".webm": "video/webm"}
_MOST_SHOWN_BYTES = 20_000_000


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
    **shown: Unpack[Shown],
) -> Film:
    """Draws a film along a scene's path, as ``splotchcl movie`` does (docs/movies.md).

    A film that was interrupted goes on where it stopped. Particles in memory are drawn frame by
    frame instead: ``for scene in scene.orbit(250): renderer.render(scene, particles)``.

    Parameters
    ----------
    scene : Scene or path-like
        With a ``[path]`` and a snapshot; without a path it turns once around the snapshot, or goes
        through those of its ``[time]``.
    path : path-like
        A film (.mp4, .mov, .mkv, .webm), which needs ffmpeg, or numbered images "frame_%04d.png".
    frames : str
        "FIRST:END:STEP"; empty: all of the path.
    part : str
        "2/3" draws the second of three runs of frames, for several processes.
    size, tolerance, device, settings, types, where, field, palette, center, width
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
    pairs = settings_of(keys_of(size, tolerance, settings), shown)
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
