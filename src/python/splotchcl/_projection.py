"""Sums of arrays in pixels, for modules that draw in place of other packages."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ._maps import column
from ._particles import Particles
from ._render import Renderer

_Array = np.ndarray[Any, Any]


@dataclass
class Grid:
    """The pixels of a map, in the lengths of the positions."""

    center: Sequence[float]
    pixel: float
    size: tuple[int, int]
    depth: float | None = None  # of centers along the line of sight; None: no limit
    box: Sequence[float] | None = None  # sides of a periodic box
    is_slice: bool = False
    voxels: int = 0  # along each side of a cube, in place of pixels


def sum_of(
    position: _Array,
    reach: _Array,
    amount: _Array,
    grid: Grid,
    tolerance: float | None,
    device: str | Renderer | None,
) -> _Array:
    """Of amounts of either sign, per area of a map seen from above (of a slice or voxels per volume).

    `reach` is where kernels end. The first index is the row, from the lowest on.
    """
    amount = np.asarray(amount, np.float64)
    # Single precision may not hold them in the units that they come in.
    largest = float(np.abs(amount).max(initial=0)) or 1.0
    offset = (np.asarray(position, np.float64) - np.asarray(grid.center, np.float64)).astype(np.float32)
    total = np.zeros([grid.voxels] * 3 if grid.voxels else grid.size[::-1])
    for sign in (1, -1):
        mass = (np.clip(sign * amount, 0, None) / largest).astype(np.float32)
        if not mass.any():
            continue
        counts = mass > 0
        particles = Particles(box_size=grid.box).gas(
            position=offset[counts],
            smoothing_length=np.asarray(reach, np.float32)[counts],
            mass=mass[counts],
        )
        settings: dict[str, Any] = {"map.periodic": grid.box is not None}
        drawn = column(
            particles,
            types="gas",
            slice=grid.is_slice,
            center=[0.0, 0.0, 0.0],
            width=grid.pixel * grid.size[0],
            depth=grid.depth,
            size=None if grid.voxels else grid.size,
            voxels=grid.voxels or None,
            tolerance=tolerance,
            device=device,
            settings=settings,
        )
        total += sign * largest * drawn.values.astype(np.float64)
    return total
