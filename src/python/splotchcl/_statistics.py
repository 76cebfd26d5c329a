"""Numbers of particles without pixels: profiles around a center, histograms of two fields."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from operator import index
from typing import Any

import numpy as np

from ._core import UsageError
from ._sources import ParticleType, Source

_Array = np.ndarray[Any, Any]


@dataclass(frozen=True)
class Profile:
    """What lies in shells around a center. Shell i reaches from ``edges[i]`` to ``edges[i + 1]``."""

    edges: _Array
    values: _Array
    """Density, number density, or the weighted mean of the field; of a mean NaN in shells without."""
    spread: _Array
    """Of a mean: the standard deviation of the field in the shell, by the same weights; else NaN."""
    weights: _Array
    """The sum of the weights in each shell: of a density the mass."""
    counts: _Array
    """Particles that were read, whatever each stands for."""
    center: tuple[float, float, float]
    inside: float
    """The sum of the weights within the innermost edge."""
    bad: int
    """Particles that are left out: with a place, weight or value that is not finite, or a weight below 0."""
    length_unit: str
    unit: str

    @property
    def radius(self) -> _Array:
        """The middle of each shell: half of its volume lies within."""
        cubes = self.edges**3
        return np.asarray(np.cbrt((cubes[1:] + cubes[:-1]) / 2))

    @property
    def enclosed(self) -> _Array:
        """The sum of the weights within each outer edge."""
        return np.asarray(self.inside + np.cumsum(self.weights))


@dataclass(frozen=True)
class Histogram:
    """Weights in bins of two fields, or means of a third. The first index is y's, from the lowest on."""

    values: _Array
    x_edges: _Array
    y_edges: _Array
    outside: float
    """The sum of the weights that lie in no bin."""
    bad: int
    """Particles with a field or a weight that is not finite, or a weight below 0."""

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """For ``imshow(..., origin="lower")`` of even bins, or for axes of ``pcolormesh``."""
        x, y = self.x_edges, self.y_edges
        return float(x[0]), float(x[-1]), float(y[0]), float(y[-1])


def profile(
    source: Source,
    field: str | None = None,
    *,
    types: Sequence[str] | str = "gas",
    center: Sequence[float] | str = "densest",
    bins: int = 32,
    inner: float | None = None,
    outer: float | None = None,
    edges: Sequence[float] | None = None,
    weight: str = "mass",
) -> Profile:
    """A quantity in spherical shells: of particles as points, each in the shell of its center.

    Parameters
    ----------
    source : Snapshot or Particles
    field : str, optional
        None: mass over volume; "counts": particles over volume; else a field, of which the weighted mean is
        taken; of a vector its length.
    types : str or sequence
        Such as "gas" or "gas,stars".
    center : 3 floats or {"densest", "mass"}
        In the source's lengths. "densest" is the particle of the largest density (without densities, of mass over
        the cube of the smoothing length), "mass" the center of mass.
    bins : int
        Shells, even in the logarithm of the radius, from `inner` to `outer`.
    inner, outer : float, optional
        In the source's lengths; `outer` reaches to the farthest particle, or half of a periodic box,
        and `inner` is a thousandth of it.
    edges : sequence of float, optional
        In place of bins, inner and outer; rising, from 0 or more on.
    weight : str
        Of means: "mass", "constant", or a field.

    Raises
    ------
    UsageError, DataError
    """
    kinds = _kinds_of(source, types)
    position = _joined(kinds, "position").astype(np.float64)
    box = _box_of(source, position)
    is_density = field in (None, "counts")
    weights = _weights_of(kinds, "constant" if field == "counts" else "mass" if field is None else weight)
    values = np.ones(len(position)) if is_density else _scalars(kinds, str(field))
    good = np.isfinite(position).all(axis=1) & np.isfinite(weights) & (weights >= 0) & np.isfinite(values)
    if not good.any():
        raise UsageError("found no particle with a finite place, weight and value, expected some")
    middle = _center_of(center, kinds, position, good, box)
    offset = position[good] - middle
    if box is not None:
        offset -= box * np.round(offset / box)
    distance = np.sqrt((offset**2).sum(axis=1))
    limits = _edges_of(edges, *_counts_of(bins, 1), inner, outer, distance, box)
    weights, values = weights[good], values[good]
    total, _ = np.histogram(distance, limits, weights=weights)
    counts, _ = np.histogram(distance, limits)
    spread = np.full(len(total), np.nan)
    if is_density:
        result = total / (4 / 3 * np.pi * np.diff(limits**3))
    else:
        result, spread = _means(distance, limits, weights, values)
    length, mass = kinds[0].fields.get("position", ""), kinds[0].fields.get("mass", "")
    unit = kinds[0].fields.get(str(field), "")
    if field is None and length and mass:
        unit = f"{mass} ({length})^-3"
    return Profile(
        limits, result, spread, total, counts, (float(middle[0]), float(middle[1]), float(middle[2])),
        float(weights[distance < limits[0]].sum()), int((~good).sum()), length, unit,
    )  # fmt: skip


def histogram(
    source: Source,
    x: str,
    y: str,
    mean_of: str | None = None,
    *,
    types: Sequence[str] | str = "gas",
    weight: str = "mass",
    bins: int | tuple[int, int] = 128,
    x_range: tuple[float, float] | None = None,
    y_range: tuple[float, float] | None = None,
    x_log: bool | None = None,
    y_log: bool | None = None,
) -> Histogram:
    """How much lies where in the plane of two fields, such as density and temperature.

    Parameters
    ----------
    source : Snapshot or Particles
    x, y : str
        Fields; of a vector its length.
    mean_of : str, optional
        The weighted mean of this field in each bin (NaN where there is none) in place of the sum of the weights.
    types : str or sequence
    weight : str
        "mass", "constant" (particles are counted), or a field.
    bins : int or (int, int)
        Of x and y.
    x_range, y_range : 2 floats, optional
        From the least to the largest value. What lies outside is told as `outside`.
    x_log, y_log : bool, optional
        Whether bins are even in the logarithm; where all values are above 0 and span a hundredfold, unless
        said.

    Raises
    ------
    UsageError, DataError
    """
    kinds = _kinds_of(source, types)
    fields, weights = [_scalars(kinds, x), _scalars(kinds, y)], _weights_of(kinds, weight)
    values = np.ones(len(weights)) if mean_of is None else _scalars(kinds, mean_of)
    good = np.isfinite(weights) & (weights >= 0) & np.isfinite(values)
    for name, of_field, is_log in ((x, fields[0], x_log), (y, fields[1], y_log)):
        good &= np.isfinite(of_field)
        if is_log and (of_field[good] <= 0).any():
            raise UsageError(f"field {name!r}: found values of 0 and below, expected others for a logarithm")
    if not good.any():
        raise UsageError("found no particle with finite fields and weight, expected some")
    numbers = _counts_of(bins, 2)
    limits = [
        _bins_of(name, of_field[good], count, span, is_log)
        for name, of_field, count, span, is_log in zip(
            (x, y), fields, numbers, (x_range, y_range), (x_log, y_log), strict=True
        )
    ]
    places = [of_field[good] for of_field in fields]
    total, *_ = np.histogram2d(places[0], places[1], limits, weights=weights[good])
    result = total
    if mean_of is not None:
        sums, *_ = np.histogram2d(places[0], places[1], limits, weights=(weights * values)[good])
        with np.errstate(invalid="ignore", divide="ignore"):
            result = sums / total
    outside = float(weights[good].sum() - total.sum())
    return Histogram(result.T, limits[0], limits[1], max(0.0, outside), int((~good).sum()))


def _kinds_of(source: Source, types: Sequence[str] | str) -> list[ParticleType]:
    names = [name.strip() for name in types.split(",")] if isinstance(types, str) else list(types)
    if not names:
        raise UsageError("types: found none, expected one or more, such as 'gas'")
    return [source[name] for name in names]


def _joined(kinds: list[ParticleType], field: str) -> _Array:
    units = {kind.fields.get(kind._canonical_name(field), "") for kind in kinds}
    if len(units) > 1:
        found = ", ".join(map(repr, sorted(units)))
        raise UsageError(
            f"field {field!r}: found the units {found} of {', '.join(kind.name for kind in kinds)}, expected "
            "one; take these types one by one"
        )
    return np.concatenate([np.asarray(kind[field]) for kind in kinds])


def _scalars(kinds: list[ParticleType], field: str) -> _Array:
    values = _joined(kinds, field).astype(np.float64)
    return values if values.ndim == 1 else np.sqrt((values**2).sum(axis=1))


# Of a part of the particles each stands for several.
def _weights_of(kinds: list[ParticleType], weight: str) -> _Array:
    stands_for = np.concatenate([np.full(len(kind), kind.particles_per_read) for kind in kinds])
    return stands_for if weight == "constant" else stands_for * _scalars(kinds, weight)


# Where all particles lie in one period of it.
def _box_of(source: Source, position: _Array) -> _Array | None:
    if source.box_size is None or len(position) == 0:
        return None
    sides = np.broadcast_to(np.asarray(source.box_size, np.float64), 3)
    return sides if (np.nanmax(position, 0) - np.nanmin(position, 0) <= sides).all() else None


def _center_of(
    center: Sequence[float] | str,
    kinds: list[ParticleType],
    position: _Array,
    good: _Array,
    box: _Array | None,
) -> _Array:
    if not isinstance(center, str):
        middle = np.asarray(center, np.float64)
        if middle.shape != (3,) or not np.isfinite(middle).all():
            raise UsageError(f"center: found {center!r}, expected three numbers, 'densest' or 'mass'")
        return middle
    if center == "densest":
        if all("density" in kind for kind in kinds):
            density = _scalars(kinds, "density")
        else:
            density = _scalars(kinds, "mass") / _scalars(kinds, "smoothing_length") ** 3
        return np.asarray(position[np.argmax(np.where(good & np.isfinite(density), density, -np.inf))])
    if center != "mass":
        raise UsageError(f"center: found {center!r}, expected three numbers, 'densest' or 'mass'")
    mass, inside = _weights_of(kinds, "mass")[good], position[good]
    first = inside[0]
    if box is not None:  # around the mean of the coordinates' angles
        turns = np.exp(2j * np.pi * inside / box)
        first = np.angle((mass[:, None] * turns).sum(axis=0)) / (2 * np.pi) * box
    offset = inside - first
    if box is not None:
        offset -= box * np.round(offset / box)
    middle = first + (mass[:, None] * offset).sum(axis=0) / mass.sum()
    return np.asarray(middle if box is None else middle % box)


def _counts_of(bins: int | Sequence[int], axes: int) -> list[int]:
    """One whole number for all axes, or one for each, of numpy's too."""
    try:
        counts = [index(number) for number in ([bins] * axes if np.ndim(bins) == 0 else bins)]
    except TypeError:
        counts = []
    if len(counts) != axes:
        raise UsageError(f"bins: found {bins!r}, expected a whole number" + " or two" * (axes == 2))
    return counts


def _edges_of(
    edges: Sequence[float] | None,
    bins: int,
    inner: float | None,
    outer: float | None,
    distance: _Array,
    box: _Array | None,
) -> _Array:
    if edges is not None:
        limits = np.asarray(edges, np.float64)
        if limits.ndim != 1 or len(limits) < 2 or limits[0] < 0 or not (np.diff(limits) > 0).all():
            raise UsageError("edges: expected two numbers or more, rising, from 0 or more on")
        return limits
    if outer is None:
        outer = float(distance.max()) * (1 + 1e-12) if box is None else float(box.min()) / 2
    if inner is None:
        inner = 1e-3 * outer
    if bins < 1 or not 0 < inner < outer:
        raise UsageError(
            f"shells: found {bins} from {inner:g} to {outer:g}, expected one or more from above 0 to more"
        )
    return np.geomspace(inner, outer, bins + 1)


def _means(places: _Array, limits: _Array, weights: _Array, values: _Array) -> tuple[_Array, _Array]:
    shell = np.searchsorted(limits, places, side="right") - 1
    shell[places == limits[-1]] = len(limits) - 2
    inside = (shell >= 0) & (shell < len(limits) - 1)
    shell, weights, values = shell[inside], weights[inside], values[inside]
    length = len(limits) - 1
    total = np.bincount(shell, weights, length)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.bincount(shell, weights * values, length) / total
        # About each shell's own mean: large means cost no digits.
        square = np.bincount(shell, weights * (values - mean[shell]) ** 2, length) / total
    return mean, np.sqrt(square)


def _bins_of(
    name: str, values: _Array, count: int, span: tuple[float, float] | None, is_log: bool | None
) -> _Array:
    low, high = (float(values.min()), float(values.max())) if span is None else span
    if is_log is None:
        is_log = low > 0 and high > 100 * low
    if count < 1 or not low <= high or (is_log and not low > 0):
        raise UsageError(
            f"bins of {name!r}: found {count} from {low:g} to {high:g}, expected one or more, a rising range, and "
            "of a logarithm one above 0"
        )
    if low == high:
        half = abs(low) / 2 or 0.5
        low, high, is_log = low - half, high + half, False
    edges = np.geomspace(low, high, count + 1) if is_log else np.linspace(low, high, count + 1)
    edges[0], edges[-1] = low, high
    return np.asarray(edges)
