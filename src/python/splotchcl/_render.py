"""Drawing."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _core
from ._core import UsageError
from ._image import Image
from ._opencl import using_opencl
from ._scene import Scene
from ._shown import Shown, settings_of
from ._particles import Particles
from ._sources import Snapshot, Source
from ._untrusted import check_pictures_of

if TYPE_CHECKING:
    from typing_extensions import Unpack

Progress = Callable[[str, float], object]


@dataclass(frozen=True)
class Drawable:
    """What arguments come to: a scene, its data, and notes on both."""

    scene: Scene
    source: Source
    notes: list[str]


def suggest(
    source: Source | str | os.PathLike[str],
    *,
    size: tuple[int, int] | str | None = None,
    settings: Mapping[str, Any] | None = None,
    **shown: Unpack[Shown],
) -> Scene:
    """A scene that suits the data: camera, components, fields and palettes, all as numbers.

    Parameters
    ----------
    source : Snapshot, Particles or path-like
    size : (int, int) or str, optional
        Width and height in pixels, ``(640, 480)`` or ``"640x480"``; 1024 x 1024 otherwise.
    settings : mapping, optional
        Scene keys that override what was chosen. ``look``, "press", "classic" or "paper", says
        what it is to look like.
    types, where, field, palette, center, width
        As for `render`.

    Raises
    ------
    UsageError, DataError
    """
    return open_drawable(source, None, keys_of(size, None, settings), shown).scene


def keys_of(
    size: tuple[int, int] | str | None, tolerance: float | None, settings: Mapping[str, Any] | None
) -> dict[str, Any]:
    """What arguments say as scene keys."""
    keys = dict(settings or {})
    if size is not None:
        keys["image.size"] = _sides(size)
    if tolerance is not None:
        keys["tolerance"] = float(tolerance)
    return keys


def _sides(size: Any) -> list[int]:
    try:
        sides = size.split("x") if isinstance(size, str) else list(size)
        width, height = (int(side) for side in sides)
        if [width, height] != [float(side) for side in sides]:
            raise ValueError
        return [width, height]
    except (TypeError, ValueError, OverflowError):
        raise UsageError(
            f"size: found {size!r}, expected width and height in pixels, such as (640, 480) or "
            "'640x480'"
        ) from None


def open_drawable(
    what: Scene | Source | str | os.PathLike[str],
    particles: Source | None,
    keys: dict[str, Any],
    shown: Shown | None = None,
) -> Drawable:
    """Whatever may be drawn, opened; with these scene keys, and showing this."""
    settings = settings_of(keys, shown or {})
    if isinstance(what, str | os.PathLike) and particles is None:
        opened, data, notes, suggested = _core.open_scene(Path(what), settings)
        return Drawable(
            Scene._of(opened, suggested), _snapshot_of(data), notes + data.describe()["notes"]
        )
    if isinstance(what, str | os.PathLike):
        what = Scene.from_file(what)
    if isinstance(what, Source):
        if particles is not None:
            raise UsageError("two sources of particles, expected a scene and particles, or one")
        scene, notes, suggested = _core.show_snapshot(what._source, settings)
        return Drawable(Scene._of(scene, suggested), what, _notes_of(what) + notes)
    if not isinstance(what, Scene):
        raise UsageError(
            f"found a {type(what).__name__}, expected a Scene, Snapshot, Particles or path"
        )
    changed = what.copy()
    changed.update(keys)
    if particles is None:
        particles = _snapshot_of(_core.snapshot_of(changed._scene))
    elif not isinstance(particles, Source):
        raise UsageError(
            f"found a {type(particles).__name__}, expected Particles or a Snapshot"
        )
    notes = []
    if shown:
        changed, notes = changed._showing(particles, settings)
    return Drawable(changed, particles, _notes_of(particles) + notes)


def _snapshot_of(data: _core.Source) -> Snapshot:
    snapshot = Snapshot.__new__(Snapshot)
    snapshot._source = data
    return snapshot


def _notes_of(source: Source) -> list[str]:
    return source.notes if isinstance(source, Snapshot | Particles) else []


class Renderer:
    """A device that draws; keeps compiled kernels and buffers from picture to picture.

    `column` takes it as ``device``, and keeps them from map to map.

    Python's lock is free while it draws. Threads take turns at one renderer; two renderers draw at
    the same time.

    Parameters
    ----------
    device : str, optional
        A part of a device's name, in any case (`devices`). None: a GPU, else the processor.
        "reference": the renderer in double precision on the processor, which takes long.
    certify : bool
        Draw until a bound, not an estimate, says that the tolerance is kept.

    Raises
    ------
    DeviceError
        Where there is no device, and in a process that was forked after OpenCL had been used.
    UsageError
        Where no device has such a name.
    """

    def __init__(self, device: str | None = None, *, certify: bool = False) -> None:
        self._by_reference = device == "reference"
        with nullcontext() if self._by_reference else using_opencl():
            name = "" if device is None or self._by_reference else device
            self._drawer = _core.Drawer(name, self._by_reference, certify)
            self._map_drawer = _core.MapDrawer(name, self._by_reference, certify)

    def render(
        self,
        scene: Scene | Source | str | os.PathLike[str],
        particles: Source | None = None,
        *,
        size: tuple[int, int] | str | None = None,
        tolerance: float | None = None,
        settings: Mapping[str, Any] | None = None,
        progress: Progress | None = None,
        **shown: Unpack[Shown],
    ) -> Image:
        """Draws one picture; arguments as those of `splotchcl.render`."""
        drawable = open_drawable(scene, particles, keys_of(size, tolerance, settings), shown)
        return self._draw_one(drawable, progress)

    def render_all(
        self,
        scene: Scene | Source | str | os.PathLike[str],
        particles: Source | None = None,
        *,
        size: tuple[int, int] | str | None = None,
        tolerance: float | None = None,
        settings: Mapping[str, Any] | None = None,
        progress: Progress | None = None,
        **shown: Unpack[Shown],
    ) -> dict[str, Image]:
        """Draws every picture of a scene (eyes, faces), by what is added to their files' names."""
        drawable = open_drawable(scene, particles, keys_of(size, tolerance, settings), shown)
        return self._draw(drawable, progress)

    def _draw_one(self, what: Drawable, progress: Progress | None) -> Image:
        pictures = self._draw(what, progress)
        if len(pictures) != 1:
            raise UsageError(
                f"the scene has {len(pictures)} pictures ({', '.join(pictures)}), expected one; "
                "render_all draws them"
            )
        return next(iter(pictures.values()))

    def _draw_map(self, what: Drawable, progress: Progress | None) -> tuple[_core.Map, list[str]]:
        with nullcontext() if self._by_reference else using_opencl():
            return self._map_drawer.draw(what.scene._scene, what.source._source, progress)

    def _draw(self, what: Drawable, progress: Progress | None) -> dict[str, Image]:
        check_pictures_of(what.scene._scene)
        with nullcontext() if self._by_reference else using_opencl():
            drawn = self._drawer.draw(what.scene._scene, what.source._source, progress)
        pictures, notes, stats, decided = drawn
        scene = what.scene if decided is None else Scene._of(decided)
        return {
            suffix: Image(picture, scene, what.notes + notes, stats, what.source)
            for suffix, picture in pictures.items()
        }


def draw_map(
    what: Drawable, device: str | Renderer | None, progress: Progress | None
) -> tuple[_core.Map, list[str]]:
    """A map by a device, and notes."""
    if isinstance(device, Renderer):
        return device._draw_map(what, progress)
    by_reference = device == "reference"
    with nullcontext() if by_reference else using_opencl():
        drawer = _core.MapDrawer("" if device is None or by_reference else device, by_reference, False)
        return drawer.draw(what.scene._scene, what.source._source, progress)


def render(
    scene: Scene | Source | str | os.PathLike[str],
    particles: Source | None = None,
    *,
    size: tuple[int, int] | str | None = None,
    tolerance: float | None = None,
    device: str | None = None,
    certify: bool = False,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    **shown: Unpack[Shown],
) -> Image:
    """Draws a picture.

    Parameters
    ----------
    scene : Scene, Snapshot, Particles or path-like
        What to draw; a path is that of a scene file or of a snapshot. For a snapshot or particles a
        scene is chosen from the data.
    particles : Particles or Snapshot, optional
        What a scene shows; None: the snapshot that it names.
    size : (int, int) or str, optional
        Width and height in pixels, ``(640, 480)`` or ``"640x480"``.
    tolerance : float, optional
        Of every pixel and channel, as the scene's key: 1e-3 of the display's white unless said
        otherwise; 0 is the most exact.
    device, certify
        As for `Renderer`.
    settings : mapping, optional
        Scene keys that override the scene's.
    types : str or sequence, optional
        Only these particle types, such as "gas,stars".
    where : str or sequence of str, optional
        Only particles that fulfil this, such as "temperature > 1e6".
    field, palette : str, optional
        What colors show, also a formula of fields; and the palette.
    center : 3 floats, or "densest", "mass", "box", "halo=12", optional
    width : float or str, optional
        The middle, and the width that is shown there, in the unit of positions or one of their own,
        "4 Mpc".
    progress : callable, optional
        Called with what is being done and the fraction done, from 0 to 1, where reading, the search
        for neighbors or drawing take long. What it raises ends the work.

    Returns
    -------
    Image

    Raises
    ------
    UsageError
        For a scene, a setting or an array that is wrong.
    DataError
        For files that cannot be read, and particles of which none can be drawn.
    DeviceError
        Where there is no device, or it fails.
    KeyboardInterrupt
        While it reads or draws, when the device is done with a part of the particles.
    """
    drawable = open_drawable(scene, particles, keys_of(size, tolerance, settings), shown)
    return Renderer(device, certify=certify)._draw_one(drawable, progress)


def reference(
    scene: Scene | Source | str | os.PathLike[str],
    particles: Source | None = None,
    *,
    size: tuple[int, int] | str | None = None,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
    **shown: Unpack[Shown],
) -> Image:
    """Draws a picture by the reference renderer: in double precision, and slowly.

    Arguments as those of `render`. ``render(...).compare(reference(...))`` says how exact a picture
    is.
    """
    drawable = open_drawable(scene, particles, keys_of(size, None, settings), shown)
    return Renderer("reference")._draw_one(drawable, progress)


def devices() -> list[dict[str, Any]]:
    """The OpenCL devices: name, platform, driver, is_gpu, compute_units, memory_bytes, is_default.

    Empty where there is none.
    """
    with using_opencl():
        return _core.devices()
