"""Maps: pictures whose numbers are a quantity in a unit."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._arrays import as_number, is_number
from ._core import UsageError
from ._render import Progress, Renderer, draw_map, keys_of, open_drawable
from ._scene import Scene
from ._particles import Particles
from ._sources import Source
from ._units import CarriedUnit, unit_of


@dataclass
class Map:
    """A map (docs/maps.md). In a notebook it shows itself as a figure. ``numpy.asarray(map)`` is `values`."""

    _map: _core.Map = field(repr=False)
    notes: list[str]
    """What the user should know, a line each."""
    scene: Scene = field(repr=False)
    _source: Source = field(repr=False)

    @property
    def values(self) -> np.ndarray[Any, np.dtype[np.float32]]:
        """float32 of shape (height, width) in `unit`, read-only; row 0 is the lowest. Of a cube (channels, height, width),
        of voxels (z, y, x), of a sphere or a profile one axis.

        Not a number where a mean has too little matter to be known.
        """
        return np.asarray(self._map)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray[Any, Any]:
        values = self.values
        if dtype is not None and np.dtype(dtype) != values.dtype:
            if copy is False:
                raise ValueError(f"a map is float32; as {np.dtype(dtype)} it is a copy")
            return values.astype(dtype)
        return values.copy() if copy else values

    @property
    def effective_particles(self) -> np.ndarray[Any, np.dtype[np.float32]] | None:
        """How many particles of equal weight would make each pixel; None unless asked for."""
        return None if self._map.noise is None else np.asarray(self._map.noise)

    @property
    def unit(self) -> str:
        """Of the values, such as "Msun/pc^2"."""
        return self._map.unit

    @property
    def quantity(self) -> str:
        """What is shown: "mean of temperature, weighted by mass"."""
        return self._map.quantity

    @property
    def length_unit(self) -> str:
        """Of `extent` and `pixel`."""
        return self._map.length_unit

    @property
    def axes(self) -> tuple[str, ...]:
        """What points to the right and upwards: ("x", "y"). Of voxels ("x", "y", "z"), of a profile ("radius",), of a histogram its fields."""
        if self._map.axes:
            return tuple(name for name, _, _ in self._map.axes)
        return self._map.right_name, self._map.up_name

    @property
    def edges(self) -> tuple[np.ndarray[Any, Any], ...]:
        """Of the cells along each of the `axes` of voxels, a profile or a histogram; else none."""
        return tuple(np.array(edges) for _, _, edges in self._map.axes)

    @property
    def axis_units(self) -> tuple[str, ...]:
        """Of `edges`."""
        return tuple(unit for _, unit, _ in self._map.axes)

    @property
    def velocities(self) -> np.ndarray[Any, Any] | None:
        """The middles of a cube's channels in `velocity_unit`, positive away from who looks; else None."""
        if self._map.velocity is None:
            return None
        channels, first, step, _ = self._map.velocity
        return first + step * np.arange(channels)

    @property
    def velocity_unit(self) -> str | None:
        """Of `velocities`: "km/s", or "code_velocity" where it is not known."""
        return None if self._map.velocity is None else self._map.velocity[3]

    @property
    def pixel(self) -> float:
        """The side of a pixel or a voxel, in `length_unit`. Other cells have none: UsageError."""
        self._require_squares("pixel")
        return self._map.pixel

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Left, right, bottom, top in `length_unit`, for ``imshow(..., origin="lower")``.

        Of a histogram in the units of its fields, or of their decimal logarithms where bins have equal
        ratios. Spheres, skies and profiles have none: UsageError.
        """
        if self._map.shape == "histogram":
            ends = [_ends(edges) for edges in self.edges]
            return *ends[0], *ends[1]
        self._require_squares("extent")
        half = self._map.pixel * self._map.width / 2, self._map.pixel * self._map.height / 2
        right, up = self._map.center_right, self._map.center_up
        return right - half[0], right + half[0], up - half[1], up + half[1]

    def _require_squares(self, what: str) -> None:
        if self._map.shape not in ("plane", "velocities", "voxels"):
            raise UsageError(f"{what}: a map of the shape {self._map.shape} has none, expected a plane, a cube or voxels")

    # A cube has no figure.
    def _repr_png_(self) -> bytes | None:
        if self._map.shape in ("velocities", "voxels"):
            return None
        with tempfile.TemporaryDirectory() as folder:
            figure = Path(folder, "map.png")
            self._map.save(figure, self.scene._scene, self._source._source)
            return figure.read_bytes()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .fits, .hdf5, .npy or .exr with the numbers, .pdf or a picture as a figure.

        What a figure does not show, since it lies below its range or has no logarithm, `notes`
        tell afterwards.

        Raises
        ------
        UsageError
            For an ending that no map can be written as.
        DataError
            For a file that cannot be written.
        """
        told = self._map.save(Path(path), self.scene._scene, self._source._source)
        self.notes.extend(note for note in told if note not in self.notes)


def column(
    scene: Scene | Source | str | os.PathLike[str],
    field: str | None = None,
    weight: str | None = None,
    *,
    particles: Source | None = None,
    types: Sequence[str | int] | str | None = None,
    where: Sequence[str] | str | None = None,
    statistic: str | None = None,
    slice: bool = False,
    view: str = "xy",
    center: Sequence[float | str] | str | None = None,
    width: float | str | None = None,
    depth: float | str | None = None,
    size: tuple[int, int] | str | None = None,
    unit: str | None = None,
    palette: str | None = None,
    noise: bool = False,
    channels: int | None = None,
    velocity_range: tuple[float, float] | None = None,
    line_mass: float | None = None,
    healpix: int | None = None,
    order: str | None = None,
    shell: tuple[float, float] | str | None = None,
    tile: bool = False,
    voxels: int | Sequence[int] | None = None,
    profile: int | None = None,
    histogram: tuple[str, str] | None = None,
    bins: int | tuple[int, int] | None = None,
    tolerance: float | None = None,
    device: str | Renderer | None = None,
    settings: Mapping[str, Any] | None = None,
    progress: Progress | None = None,
) -> Map:
    """A quantity along lines of sight, in its unit (docs/maps.md).

    Parameters
    ----------
    scene, particles, size, tolerance, device, settings, progress
        As for `render`. The map shows one component: the first, or ``map.component``. ``device`` may be
        a `Renderer`, which many small maps are drawn by in less time.
    field : str, optional
        None: the surface density. "counts", "line_of_sight_velocity", or a field or a formula of
        fields, "log10(density * temperature)", of which the weighted mean is shown.
    weight : str, optional
        Of means: "mass" (None says the same; of slices "volume"), "volume", "constant" (all particles
        alike), or a field.
    types : str or sequence, optional
        Particle types, such as "gas" or "gas,stars", that the first component has in place of its own.
    where : str or sequence of str, optional
        Only particles that fulfil this, such as "temperature > 1e6 && ParticleIDs < 500000".
    statistic : {"mean", "dispersion", "integral"}, optional
    slice : bool
        In the plane through the center, instead of along the line.
    view : {"xy", "xz", "yz", "camera", "sky"}
        The first axis points to the right, the second upwards. "sky" looks all around from `center`; the
        width is an angle then.
    center : 3 floats or {"box", "mass", "densest"}, optional
        The middle, in the snapshot's unit of length; values with a unit of their own, such as
        "25 Mpc", are converted.
    width, depth : float or str, optional
        In the snapshot's unit of length; a value with a unit of its own, such as "4 Mpc", is
        converted. The map's `length_unit` is that of the width, or of the center.
    unit : str, optional
        Of the map, such as "Msun/pc^2"; None: what the snapshot's units give, or those that arrays
        carry, without a and h. What they do not say is said by ``settings={"read.units": "gadget"}``, or by ``{"read.units": {"mass": "Msun"}}``.
    palette : str, optional
        Of figures.
    noise : bool
        Also the effective number of particles.
    channels : int, optional
        A cube: the surface density or the counts in so many channels of velocity along the line of sight.
    velocity_range : 2 floats, optional
        Of the channels, in the snapshot's unit; None: all velocities.
    line_mass : float, optional
        Lines of a cube have the thermal width of particles of so many proton masses.

    healpix : int, optional
        A map of the sphere around `center`, with this NSIDE: the values of its pixels, as healpy has them.
    order : {"ring", "nested"}, optional
    shell : 2 floats or str, optional
        Between these distances from `center`, such as "10,20Mpc"; of a profile its first and last radius.
    tile : bool
        A sphere or a sky has every periodic image in `shell`, not only the nearest.
    voxels : int or 3 ints, optional
        A cube of voxels along x, y and z.
    profile : int, optional
        Means, or densities, in so many shells around `center`.
    histogram : 2 str, optional
        The mass, or a field's mean, in bins of two fields.
    bins : int or 2 ints, optional
        Of the histogram.

    Returns
    -------
    Map

    Raises
    ------
    UsageError, DataError, DeviceError
    """
    keys = keys_of(size, tolerance, settings)
    keys |= _map_keys(field, weight, statistic, view, unit)
    if palette is not None:
        keys["map.palette"] = palette
    if isinstance(center, str):
        keys["map.center_at"], center = center, None
    lengths = {"map.center": center, "map.width": width, "map.depth": depth}
    lengths = {key: value for key, value in lengths.items() if value is not None}
    written = {key for key, value in lengths.items() if _is_written(value)}
    with_units = {key for key, value in lengths.items() if _carries_unit(value)} - written
    keys |= {key: _numbers(key, lengths[key]) for key in lengths.keys() - with_units - written}
    # In a scene 0 says that there is no such shape.
    for name, count in {"channels": channels, "healpix": healpix, "profile": profile, "voxels": voxels}.items():
        if count is not None and not np.any(count):
            raise UsageError(f"{name}: found {count}, expected at least 1")
    cube = {"map.channels": channels, "map.velocity_range": velocity_range, "map.line_mass": line_mass}
    keys |= {key: value for key, value in cube.items() if value is not None}
    if velocity_range is not None:
        keys["map.velocity_range"] = [float(v) for v in velocity_range]
    shapes = {"map.healpix": healpix, "map.healpix_order": order, "map.profile": profile}
    keys |= {key: value for key, value in shapes.items() if value is not None}
    lists = {"map.shell": shell, "map.voxels": voxels, "map.histogram": histogram, "map.bins": bins}
    for key, value in lists.items():
        if value is not None:
            keys[key] = value if np.ndim(value) == 0 else list(value)
    if tile:
        keys["map.tile"] = True
    if slice:
        keys["map.slice"] = True
    if noise:
        keys["map.noise"] = True
    if types is not None:
        names = [word.strip() for word in types.split(",")] if isinstance(types, str) else list(types)
        keys[f"component.{keys.get('map.component', 0)}.types"] = names
    what = open_drawable(scene, particles, keys)
    if where is not None:
        key = f"component.{keys.get('map.component', 0)}.select.where"
        given = [where] if isinstance(where, str) else list(where)
        what.scene[key] = [*(what.scene[key] or []), *given]
    what.notes.extend(_use_carried_units(what.scene, what.source))
    # Only now it is known what the snapshot's lengths are in.
    what.scene.update(
        {key: _converted(key, lengths[key], what.scene, what.source) for key in with_units}
    )
    for key in ("map.width", "map.center", "map.depth"):
        if key in written and isinstance(lengths[key], str):
            what.scene[key] = lengths[key]
        elif key in written:
            what.scene[key] = _read_lengths(key, lengths[key], what.scene, what.source)
            if not what.scene["map.axis_unit"] and "map.width" not in written:
                what.scene["map.axis_unit"] = _written_unit(lengths[key])
    drawn, more = draw_map(what, device, progress)
    # A map is of one component, whatever else there is.
    not_drawn = _core.tell_not_drawn(what.scene._scene, what.source._source)
    notes = [note for note in what.notes if note != not_drawn]
    notes += [note for note in more if note not in notes]
    return Map(drawn, notes, what.scene, what.source)


def _ends(edges: np.ndarray[Any, Any]) -> tuple[float, float]:
    are_equal = np.allclose(np.diff(edges), edges[1] - edges[0], rtol=1e-6)
    first, last = (edges if are_equal else np.log10(edges))[[0, -1]]
    return float(first), float(last)


# What maps of arrays are in, unless the scene says so: also those of types whose own arrays carry
# no unit. Notes on units that cannot be converted.
def _use_carried_units(scene: Scene, source: Source) -> list[str]:
    notes = []
    carried = source._carried_units() if isinstance(source, Particles) else {}
    for kind, key, like in (("length", "map.length_unit", "cm"), ("mass", "map.mass_unit", "g")):
        unit = carried.get(kind)
        if unit is None or scene[key]:
            continue
        if _core.is_unit(unit.name, like):
            scene[key] = unit.name
        else:
            notes.append(
                f"arrays carry {kind} in {unit.text}, which maps cannot convert; name its unit as "
                f"settings['{key}']"
            )
    return notes


def _carries_unit(length: Any) -> bool:
    return unit_of(length) is not None or (
        isinstance(length, list | tuple) and any(unit_of(x) is not None for x in length)
    )


# As "4 Mpc" has its unit; of a center each may.
def _is_written(length: Any) -> bool:
    return isinstance(length, str) or (
        isinstance(length, list | tuple) and any(isinstance(x, str) for x in length)
    )


def _read_lengths(key: str, length: Any, scene: Scene, source: Source) -> list[float]:
    def read(one: Any) -> float:
        return float(_core.read_map_length(str(one), scene._scene, source._source, f"key {key}"))

    return [read(one) for one in length]


def _written_unit(length: Any) -> str:
    texts = [x for x in length if isinstance(x, str)]
    return texts[-1].strip().lstrip("+-.0123456789eE").strip()


# A width or a center, without its units.
def _numbers(key: str, length: Any) -> float | list[float]:
    if is_number(length):
        return as_number(f"key {key}", length)
    return [as_number(f"key {key}", x) for x in length]


# A width or a center in the snapshot's unit of length. Of a list each number may have its own unit.
def _converted(key: str, length: Any, scene: Scene, source: Source) -> float | list[float]:
    unit = unit_of(length)
    if unit is not None:
        ratio = _ratio_to_lengths(key, unit, scene, source)
        values = np.asarray(_numbers(key, length)) * ratio
        converted: float | list[float] = values.tolist()
        return converted
    numbers = []
    for value in length:
        unit = unit_of(value)
        ratio = 1 if unit is None else _ratio_to_lengths(key, unit, scene, source)
        numbers.append(as_number(f"key {key}", value) * ratio)
    return numbers


def _ratio_to_lengths(key: str, unit: CarriedUnit, scene: Scene, source: Source) -> float:
    units = (kind.fields.get("position", "") for kind in source.types.values())
    wanted = scene["map.length_unit"] or next(filter(None, units), "")
    ratio = _core.ratio_of_units(unit.name, wanted, source._source)
    if ratio is None:
        raise UsageError(
            f"key {key}: found the unit {unit.text}, expected one that can be converted to the "
            f"snapshot's of length, {wanted or 'which it does not say'}; give a number without a "
            "unit, or name the snapshot's as settings['map.length_unit']"
        )
    return ratio


def _map_keys(
    quantity: str | None,
    weight: str | None,
    statistic: str | None,
    view: str,
    unit: str | None,
) -> dict[str, Any]:
    keys: dict[str, Any] = {
        "map.quantity": quantity,
        "map.weight": weight,
        "map.statistic": statistic,
        "map.view": view,
        "map.unit": unit,
    }
    return {key: value for key, value in keys.items() if value is not None}
