"""Other packages' pictures, drawn by splotchcl while a block of code runs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from ._core import UsageError
from ._projection import Grid, sum_of
from ._render import Renderer


@contextmanager
def inside(package: Any, *, tolerance: float | None = None, device: str | Renderer | None = None) -> Iterator[None]:
    """``with inside(pynbody):`` lets ``pynbody.plot.sph.image`` draw with splotchcl.

    What pynbody decides stays its own: quantities, weights, units, sizes, colors. Its kernel gives way to a
    Gaussian of the same reach and second moment. Perspective, pixels that are not square, and grids
    other than pictures are drawn by pynbody as ever.

    Parameters
    ----------
    package : module
        pynbody.
    tolerance : float, optional
        As for `column`.
    device : str or Renderer, optional
        A part of an OpenCL device's name, "reference", or what draws, which pictures after the first one
        take less time by.

    Raises
    ------
    UsageError
        For another package.
    """
    renderers = getattr(getattr(package, "sph", None), "renderers", None)
    if renderers is None or not hasattr(renderers, "ImageRenderer"):
        name = getattr(package, "__name__", type(package).__name__)
        raise UsageError(f"found {name}, expected pynbody 2.3 or later, whose pictures can be drawn here")
    base, picture = renderers.ImageRendererBase, renderers.ImageRenderer
    own = picture._call_c_renderer

    def draw(self: Any, array: Any, geometry: Any, kernel: Any, mass: Any, rho: Any, smooth: Any,
             x: Any, y: Any, z: Any) -> Any:  # fmt: skip
        if not _can_draw(geometry):
            return own(self, array, geometry, kernel, mass, rho, smooth, x, y, z)
        reach = kernel.max_d * np.maximum(np.asarray(smooth, np.float64), self._smooth_floor)
        position = np.stack([np.asarray(along, np.float64) for along in (x, y, z)], axis=1)
        amount = np.asarray(array, np.float64) * np.asarray(mass) / np.asarray(rho)
        grid = _grid_of(geometry, self._is_projected, _box_of(self._snapshot, position))
        return sum_of(position, reach, amount, grid, tolerance, device)

    # One drawing has all threads and all sizes of kernels.
    changes = (
        (picture, "_call_c_renderer", draw),
        (base, "with_threading", lambda self, num_threads=None: self),
        (base, "with_approximate", lambda self, levels=None, factor=8: self),
    )
    kept = [(owner, name, owner.__dict__[name]) for owner, name, _ in changes]
    for owner, name, change in changes:
        setattr(owner, name, change)
    try:
        yield
    finally:
        for owner, name, before in kept:
            setattr(owner, name, before)


def _can_draw(geometry: Any) -> bool:
    sides = (geometry.x2 - geometry.x1) / geometry.nx, (geometry.y2 - geometry.y1) / geometry.ny
    return not geometry.z_camera and bool(np.isclose(*sides, rtol=1e-9))


def _grid_of(geometry: Any, is_projected: bool, box: list[float] | None) -> Grid:
    x, y = 0.5 * (geometry.x1 + geometry.x2), 0.5 * (geometry.y1 + geometry.y2)
    z, depth = geometry.z_plane, None
    if is_projected and np.isfinite(geometry.z2 - geometry.z1):
        z, depth = 0.5 * (geometry.z1 + geometry.z2), geometry.z2 - geometry.z1
    pixel = (geometry.x2 - geometry.x1) / geometry.nx
    return Grid((x, y, z), pixel, (geometry.nx, geometry.ny), depth, box, not is_projected)


# Of particles that lie in one period of it.
def _box_of(snapshot: Any, position: np.ndarray[Any, Any]) -> list[float] | None:
    side = snapshot.properties.get("boxsize")
    if side is None or len(position) == 0:
        return None
    if hasattr(side, "in_units"):
        side = side.in_units(snapshot["pos"].units, **snapshot.conversion_context())
    return [float(side)] * 3 if np.ptp(position, axis=0).max() <= side else None
