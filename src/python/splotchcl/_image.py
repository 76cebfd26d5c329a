"""Pictures that were drawn."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._core import UsageError
from ._scene import Scene
from ._sources import Source
from ._untrusted import check_picture

_WIDE_ANGLES = ("fisheye", "equirectangular", "cube")


@dataclass(frozen=True)
class Difference:
    """How far a picture lies from its reference, in linear light (docs/accuracy.md)."""

    worst: float
    """The largest abs(a - b) / max(1, abs(b)) of any pixel and channel; b is the reference."""
    worst_pixel: tuple[int, int]
    worst_channel: int
    maximum: float
    rms: float
    psnr: float
    relative_l2: float
    pixels_beyond: int
    """Pixels with a channel beyond the limit."""
    pixels_not_finite: int


@dataclass
class Image:
    """A picture, with what is to be told of it.

    In a notebook it shows itself. ``numpy.asarray(image)`` is `linear`.
    """

    _picture: _core.Picture = field(repr=False)
    scene: Scene | None = field(default=None, repr=False)
    """What was drawn, with the numbers that stand for "auto" in `finish`: frames of a film that are
    drawn with the scene of one of them do not flicker."""
    notes: list[str] = field(default_factory=list)
    """What the user should know, a line each."""
    stats: dict[str, Any] = field(default_factory=dict, repr=False)
    """Device, particles, seconds by stage."""
    _source: Source | None = field(default=None, repr=False)

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Image:
        """Reads a picture file; values of 8 bits become value / 255, without a gamma.

        Raises
        ------
        DataError
            For a file that cannot be read.
        """
        check_picture(path)
        return cls(_core.read_image(Path(path)))

    @property
    def linear(self) -> np.ndarray[Any, np.dtype[np.float32]]:
        """Scene-linear light: float32 of shape (height, width, 4), read-only, without a copy.

        As it was drawn, without exposure, tone and whatever else `finish` does; `display` has
        that. Row 0 is the top. Red, green and blue have 1 for the display's white, and larger values
        are kept; alpha is the opacity from 0 to 1. Color is premultiplied.
        """
        return np.asarray(self._picture)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray[Any, Any]:
        linear = self.linear
        if dtype is not None and np.dtype(dtype) != linear.dtype:
            if copy is False:
                raise ValueError(f"linear light is float32; as {np.dtype(dtype)} it is a copy")
            return linear.astype(dtype)
        return linear.copy() if copy else linear

    @property
    def width(self) -> int:
        """In pixels."""
        return self._picture.width

    @property
    def height(self) -> int:
        """In pixels."""
        return self._picture.height

    def display(self) -> np.ndarray[Any, np.dtype[np.uint8]]:
        """As screens show it, and PNG files have it: uint8 of shape (height, width, 3), a copy.

        Raises
        ------
        DataError
            For light that is not a number.
        """
        values = np.frombuffer(self._picture.display(), np.uint8)
        return values.reshape(self.height, self.width, 3).copy()

    def save(self, path: str | os.PathLike[str], *, display: bool = False) -> None:
        """Writes a file whose ending chooses the format (png, exr, tif, jpg, ...).

        EXR, HDR and TIFF hold `linear`; EXR has the scene as text, too. The file appears under its
        name when it is complete.

        Parameters
        ----------
        path : str or Path
        display : bool
            Files of floats hold what a display shows instead.

        Raises
        ------
        UsageError
            For an ending that names no format.
        DataError
            For a file that cannot be written.
        """
        self._picture.save(Path(path), display)

    def compare(self, reference: Image, limit: float = 0) -> Difference:
        """Holds this picture against another of its size.

        Parameters
        ----------
        reference : Image
        limit : float
            What `Difference.pixels_beyond` counts against, as a scene's tolerance.

        Raises
        ------
        UsageError
            For pictures of different sizes.
        """
        return Difference(**self._picture.compare(reference._picture, limit))

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom, top for matplotlib, from the middle, at the look-at distance.

        In the snapshot's unit of length. Perspective shows more of what lies farther away.

        Raises
        ------
        UsageError
            For wide angles, which have no such width, and for pictures from files.
        """
        scene = self._decided()
        if scene["camera.projection"] in _WIDE_ANGLES:
            raise UsageError(
                f"a picture in {scene['camera.projection']} projection has no extent in lengths, "
                "expected a perspective or orthographic one"
            )
        half = _half_width(scene)
        up = half * self.height / self.width
        return (-half, half, -up, up)

    def colorbar(self, ax: Any, component: str | int = 0, **options: Any) -> Any:
        """Draws the color bar of a component beside a matplotlib axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes
        component : str or int
            Its name or number.
        **options
            For ``Figure.colorbar``; `label` is the field unless it is given.

        Returns
        -------
        matplotlib.colorbar.Colorbar

        Raises
        ------
        UsageError
            For a component that has no field for its color.
        ModuleNotFoundError
            Without matplotlib.
        """
        from matplotlib.cm import ScalarMappable
        from matplotlib.colors import ListedColormap

        scene = self._decided()
        at = f"component.{component}"
        name = scene[f"{at}.color.field"]
        if not name:
            raise UsageError(f"{at} is not colored by a field, so it has no color bar")
        colors = _core.palette_colors(scene[f"{at}.palette"], scene["image.gamma"])
        mappable = ScalarMappable(_norm(scene, at), ListedColormap(colors))
        options.setdefault("label", name)
        return ax.figure.colorbar(mappable, ax=ax, **options)

    def _repr_png_(self) -> bytes:
        return self._picture.png()

    # With a camera and ranges.
    def _decided(self) -> Scene:
        if self.scene is None:
            raise UsageError("a picture from a file has no scene; draw it")
        return self.scene.decide(self._source)


def _half_width(scene: Scene) -> float:
    width = scene["camera.width"]
    if width is not None:
        return float(width) / 2
    distance = math.dist(scene["camera.position"], scene["camera.look_at"])
    angle = scene["camera.field_of_view"]
    return distance * math.tan(math.radians(45 if angle is None else angle) / 2)


def _norm(scene: Scene, component: str) -> Any:
    from matplotlib import colors

    limits = {"vmin": scene[f"{component}.color.min"], "vmax": scene[f"{component}.color.max"]}
    scaling = scene[f"{component}.color.scaling"] or scene[f"{component}.color.scale"]
    if scaling == "log":
        return colors.LogNorm(**limits)
    if scaling == "asinh":
        return colors.AsinhNorm(linear_width=1, **limits)
    return colors.Normalize(**limits)
