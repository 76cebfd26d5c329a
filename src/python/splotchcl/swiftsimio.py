"""swiftsimio's functions that project, slice and render volumes, drawn by splotchcl.

>>> from splotchcl.swiftsimio import project_gas
>>> project_gas(swiftsimio.load("snapshot.hdf5"), resolution=1024, project="masses")

They take what those of ``swiftsimio.visualisation`` take and return what they return. `backend` and
`parallel` change nothing: there is one way to draw. `tolerance` is the largest error of a pixel,
relative to it or to `map.floor` (docs/maps.md).
"""

from __future__ import annotations

from functools import reduce
from importlib import import_module
from typing import Any

import numpy as np

from ._core import UsageError
from ._objects import reach_of_swift
from ._projection import Grid, sum_of
from ._render import Renderer

__all__ = [
    "project_gas", "project_pixel_grid", "render_gas", "render_voxel_grid", "slice_gas", "slice_pixel_grid",
]  # fmt: skip


def project_gas(
    data: Any,
    resolution: int,
    project: str | None = "masses",
    region: Any = None,
    mask: Any = None,
    rotation_center: Any = None,
    rotation_matrix: Any = None,
    parallel: bool = False,
    backend: str = "fast",
    periodic: bool = True,
    *,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
) -> Any:
    """A field of the gas summed up along z, per area: a cosmo_array, with x as its first index."""
    return project_pixel_grid(
        data.gas, resolution, project, region, mask, rotation_matrix, rotation_center, parallel,
        backend, periodic, tolerance=tolerance, device=device,
    )  # fmt: skip


def project_pixel_grid(
    data: Any,
    resolution: int,
    project: str | None = "masses",
    region: Any = None,
    mask: Any = None,
    rotation_matrix: Any = None,
    rotation_center: Any = None,
    parallel: bool = False,
    backend: str = "fast",
    periodic: bool = True,
    *,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
) -> Any:
    """The same of any group of particles."""
    view = _View(data, project, region, rotation_matrix, rotation_center, periodic)
    if view.has_depth and periodic and view.depth > view.box[2]:
        raise ValueError("Projection depth of more than the box depth is not supported.")
    center = [*view.middle[:2], view.middle[2] if view.has_depth else 0.5 * view.box[2]]
    depth = view.depth if view.has_depth else None
    grid = Grid(center, view.pixel(resolution), view.size(resolution), depth, view.periodic_box)
    return view.draw(grid, mask, tolerance, device, power=2)


def slice_gas(
    data: Any,
    resolution: int,
    z_slice: Any = None,
    project: str | None = "masses",
    parallel: bool = False,
    rotation_matrix: Any = None,
    rotation_center: Any = None,
    region: Any = None,
    backend: str = "sph",
    periodic: bool = True,
    mask: Any = None,
    *,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
) -> Any:
    """A field of the gas in a plane, per volume: a cosmo_array, with x as its first index."""
    return slice_pixel_grid(
        data.gas, resolution, z_slice, project, parallel, rotation_matrix, rotation_center, region,
        backend, periodic, mask, tolerance=tolerance, device=device,
    )  # fmt: skip


def slice_pixel_grid(
    data: Any,
    resolution: int,
    z_slice: Any = None,
    project: str | None = "masses",
    parallel: bool = False,
    rotation_matrix: Any = None,
    rotation_center: Any = None,
    region: Any = None,
    backend: str = "sph",
    periodic: bool = True,
    mask: Any = None,
    *,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
) -> Any:
    """The same of any group of particles."""
    if backend != "sph":
        raise UsageError(f"backend {backend!r}: found a slice without kernels, expected 'sph'")
    view = _View(data, project, region, rotation_matrix, rotation_center, periodic)
    height = 0.0 if z_slice is None else view.number(z_slice)
    if rotation_center is not None:
        height += view.number(rotation_center[2])
    center = [*view.middle[:2], height]
    grid = Grid(
        center, view.pixel(resolution), view.size(resolution), None, view.periodic_box, is_slice=True
    )
    return view.draw(grid, mask, tolerance, device, power=3)


def render_gas(
    data: Any,
    resolution: int,
    project: str | None = "masses",
    parallel: bool = False,
    rotation_matrix: Any = None,
    rotation_center: Any = None,
    region: Any = None,
    periodic: bool = True,
    mask: Any = None,
    backend: str = "scatter",
    *,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
) -> Any:
    """A field of the gas in voxels, per volume: a cosmo_array with the axes x, y and z. Kernels are exact, whatever the tolerance."""
    return render_voxel_grid(
        data.gas, resolution, project, parallel, rotation_matrix, rotation_center, region, periodic, mask,
        backend, tolerance=tolerance, device=device,
    )  # fmt: skip


def render_voxel_grid(
    data: Any,
    resolution: int,
    project: str | None = "masses",
    parallel: bool = False,
    rotation_matrix: Any = None,
    rotation_center: Any = None,
    region: Any = None,
    periodic: bool = True,
    mask: Any = None,
    backend: str = "scatter",
    *,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
) -> Any:
    """The same of any group of particles."""
    view = _View(data, project, region, rotation_matrix, rotation_center, periodic)
    if not view.is_cube:
        raise ValueError("Projection region must be cubic")
    grid = Grid(
        view.middle, view.pixel(resolution), view.size(resolution), None, view.periodic_box, voxels=resolution
    )
    return view.draw(grid, mask, tolerance, device, power=3)


class _View:
    """A region of a dataset in numbers: all lengths in the unit of its coordinates, comoving where
    the projected field is."""

    def __init__(
        self,
        data: Any,
        project: str | None,
        region: Any,
        rotation_matrix: Any,
        rotation_center: Any,
        periodic: bool,
    ) -> None:
        if rotation_center is not None and periodic:
            raise ValueError("Rotation and periodic boundaries in visualisation are incompatible.")
        self.field = (
            np.ones_like(data.particle_ids)
            if project is None
            else reduce(getattr, project.split("."), data)
        )
        self.comoving = getattr(self.field, "comoving", None)
        coordinates = self._alike(data.coordinates)
        self.unit = coordinates.units
        self._length = coordinates[:1, 0]
        self.positions = np.asarray(coordinates.to_value(self.unit), np.float64)
        self.reach = reach_of_swift(data.metadata) * np.asarray(
            self._alike(data.smoothing_lengths).to_value(self.unit), np.float64
        )
        self.box = [self.number(side) for side in data.metadata.boxsize]
        self.periodic_box = self.box if periodic else None
        if rotation_center is not None:
            middle = np.array([self.number(x) for x in rotation_center])
            self.positions = (self.positions - middle) @ np.asarray(rotation_matrix).T + middle
        edges = [(0.0, side) for side in self.box]
        self.has_depth = region is not None and len(region) == 6
        if region is not None:
            numbers = [self.number(edge) for edge in region]
            edges[: len(numbers) // 2] = list(zip(numbers[::2], numbers[1::2], strict=True))
        self._ranges = [high - low for low, high in edges]
        self.depth = self._ranges[2]
        self._edges = edges
        self.middle = [0.5 * (low + high) for low, high in edges]

    @property
    def is_cube(self) -> bool:
        return bool(np.allclose(self._ranges, self._ranges[0], rtol=1e-9))

    # As the field is, comoving or physical; a field that says neither takes lengths as they are.
    def _alike(self, lengths: Any) -> Any:
        if self.comoving is None or getattr(lengths, "comoving", None) is None:
            return lengths
        return lengths.to_comoving() if self.comoving else lengths.to_physical()

    def number(self, length: Any) -> float:
        return float(self._alike(length).to_value(self.unit))

    def pixel(self, resolution: int) -> float:
        return max(self._ranges[:2]) / resolution

    # Pixels are square, and the last ones may reach beyond the region.
    def size(self, resolution: int) -> tuple[int, int]:
        pixel = self.pixel(resolution)
        width, height = (int(np.ceil(side / pixel - 1e-9)) for side in self._ranges[:2])
        self.middle[0] = self._edges[0][0] + 0.5 * width * pixel
        self.middle[1] = self._edges[1][0] + 0.5 * height * pixel
        return width, height

    def draw(
        self, grid: Grid, mask: Any, tolerance: float | None, device: str | Renderer | None, power: int
    ) -> Any:
        chosen = np.s_[...] if mask is None else mask
        grid.center = [*self.middle[:2], grid.center[2]]
        amount = np.asarray(self.field)
        sums = sum_of(
            self.positions[chosen], self.reach[chosen], amount[chosen], grid, tolerance, device
        ).T
        objects = import_module("swiftsimio.objects")
        like = {"comoving": self.comoving, "cosmo_factor": self.field.cosmo_factor}
        length = objects.cosmo_quantity(
            1.0, self.unit, comoving=self._length.comoving, cosmo_factor=self._length.cosmo_factor
        )
        return objects.cosmo_array(sums, self.field.units, **like) / length**power
