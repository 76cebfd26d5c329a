"""Sums over particles that nothing approximates: by the formulas of docs/maps.md, in double
precision, with numpy alone and nothing of splotchcl's."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

# Of h, so that a Gaussian has the second moment of a cubic spline that ends at h.
KERNEL_WIDTH = math.sqrt(3 / 20)
# In widths: maps end kernels where 2e-16 of them are left.
REACH = 6

_erfc = np.frompyfunc(math.erfc, 1, 1)

# To the right, upwards, and away from who looks.
AXES = {"xy": ((0, 1), (1, 1), (2, -1)), "xz": ((0, 1), (2, 1), (1, 1)), "yz": ((1, 1), (2, 1), (0, -1))}


def gaussian_of_axis(edges: np.ndarray, width: np.ndarray) -> np.ndarray:
    """How much of Gaussians of these widths around 0 lies between each two edges, along the last axis."""
    # What lies outside of each edge, on its own side: so little keeps all its digits.
    outside = _erfc(np.abs(edges / width)).astype(float)
    left, right = edges[..., :-1], edges[..., 1:]
    one_side = np.abs(np.diff(outside))
    across = 2 - outside[..., :-1] - outside[..., 1:]
    return np.where((left < 0) & (right > 0), across, one_side) / 2


def spline(q: np.ndarray) -> np.ndarray:
    """The cubic spline that ends at q = 1, in three dimensions; its whole is 1."""
    inner = 1 - 6 * q**2 + 6 * q**3
    outer = 2 * np.clip(1 - q, 0, None) ** 3
    return 8 / math.pi * np.where(q < 0.5, inner, outer)


def spline_column(distance: np.ndarray, steps: int = 400) -> np.ndarray:
    """The same integrated along a line at these distances from the middle, for h = 1."""
    nodes, weights = np.polynomial.legendre.leggauss(steps)
    half = np.sqrt(np.clip(1 - distance**2, 0, None))
    z = half[..., None] * nodes
    return (spline(np.sqrt(distance[..., None] ** 2 + z**2)) * weights).sum(-1) * half


@dataclass
class View:
    """Where a map lies: lengths as those of the particles."""

    center: np.ndarray
    pixel: float
    width: int
    height: int
    axes: str = "xy"
    depth: float | None = None
    box: np.ndarray | None = None
    is_slice: bool = False

    def edges(self) -> tuple[np.ndarray, np.ndarray]:
        """Of pixels, from the map's middle; rows from the lowest on."""
        return (
            (np.arange(self.width + 1) - self.width / 2) * self.pixel,
            (np.arange(self.height + 1) - self.height / 2) * self.pixel,
        )

    def offsets(self, positions: np.ndarray) -> np.ndarray:
        """To the right, upwards and away, from the middle."""
        from_center = positions - self.center
        return np.stack([sign * from_center[:, axis] for axis, sign in AXES[self.axes]], axis=1)

    def sides(self) -> np.ndarray | None:
        return None if self.box is None else self.box[[axis for axis, _ in AXES[self.axes]]]


@dataclass
class Matter:
    positions: np.ndarray
    smoothing_lengths: np.ndarray
    masses: np.ndarray
    densities: np.ndarray
    fields: dict[str, np.ndarray] = field(default_factory=dict)


def shifts_along(place: np.ndarray, half: np.ndarray, side: float | None) -> tuple[np.ndarray, np.ndarray]:
    """Of periodic images within so far of the middle: which particle's each is, and where it lies."""
    if side is None:
        near = np.flatnonzero(np.abs(place) <= half)
        return near, place[near]
    first, last = np.ceil((-half - place) / side), np.floor((half - place) / side)
    counts = np.maximum(last - first + 1, 0).astype(int)
    which = np.repeat(np.arange(len(place)), counts)
    in_order = np.arange(len(which)) - np.repeat(np.cumsum(counts) - counts, counts)
    return which, place[which] + (first[which] + in_order) * side


def in_pixels(place: np.ndarray, width: np.ndarray, edges: np.ndarray, side: float | None) -> np.ndarray:
    """How much of each particle lies between each two edges along one axis, with all of its images."""
    which, at = shifts_along(place, edges[-1] + REACH * width, side)
    shares = np.zeros((len(place), len(edges) - 1))
    np.add.at(shares, which, gaussian_of_axis(edges - at[:, None], width[which, None]))
    return shares


def along_the_line(place: np.ndarray, width: np.ndarray, view: View) -> np.ndarray:
    """How often each particle counts; of slices, with what its kernel has in the plane."""
    sides = view.sides()
    side = None if sides is None else float(sides[2])
    if view.is_slice:
        which, at = shifts_along(place, REACH * width, side)
        parts = np.exp(-((at / width[which]) ** 2)) / (math.sqrt(math.pi) * width[which])
    else:
        half = math.inf if view.depth is None else view.depth / 2
        which, at = shifts_along(place, np.full(len(place), half), side)
        parts = np.where(at < half, 1.0, 0.0)
    return np.bincount(which, parts, minlength=len(place))


@dataclass
class Sums:
    """Means per area (of slices: per volume) in pixels, and the most that one particle gives a pixel."""

    values: np.ndarray
    brightest: float = 0

    def floor(self, part: float) -> float:
        """A part of the mean; single precision has no digits beyond 2^-50 of the brightest."""
        return max(part * float(np.abs(self.values).mean()), 2.0**-50 * self.brightest)


def project(matter: Matter, view: View, amounts: list[np.ndarray]) -> list[Sums]:
    """Of each of these, one number a particle. Kernels are products along three axes, and so are
    their periodic images."""
    right, up, away = view.offsets(matter.positions).T
    width = KERNEL_WIDTH * matter.smoothing_lengths
    sides = view.sides() if view.box is not None else (None, None, None)
    x_edges, y_edges = view.edges()
    columns = in_pixels(right, width, x_edges, sides[0])
    rows = in_pixels(up, width, y_edges, sides[1])
    counted = along_the_line(away, width, view)
    area = view.pixel**2
    peak = counted / np.maximum(area, math.pi * width**2)
    is_seen = (columns.max(axis=1, initial=0) > 0) & (rows.max(axis=1, initial=0) > 0)
    return [Sums(np.einsum("p,py,px->yx", amount * counted, rows, columns, optimize=True) / area,
                 float((np.abs(amount) * peak)[is_seen].max(initial=0))) for amount in amounts]


@dataclass
class Expected:
    """A map, and by how much another one may differ from it."""

    values: np.ndarray
    allowed: np.ndarray


def expected_sum(matter: Matter, view: View, amount: np.ndarray, floor: float, tolerance: float) -> Expected:
    """Of amounts of one sign or both: what lies above 0 and below it has the promise of both together."""
    above, below = project(matter, view, [np.maximum(amount, 0), np.maximum(-amount, 0)])
    both = Sums(above.values + below.values, max(above.brightest, below.brightest))
    parts = 2 if above.values.any() and below.values.any() else 1
    allowed = parts * tolerance * np.maximum(both.values, both.floor(floor))
    return Expected(above.values - below.values, allowed)


def expected_mean(matter: Matter, view: View, weight: np.ndarray, value: np.ndarray, floor: float,
                  tolerance: float) -> Expected:
    """Not a number where there is too little of the weight."""
    (sums,) = project(matter, view, [weight])
    total, least = sums.values, sums.floor(floor)
    top = expected_sum(matter, view, weight * value, floor, tolerance)
    error = tolerance * np.maximum(total, least)
    with np.errstate(all="ignore"):
        mean = top.values / total
        allowed = (top.allowed + np.abs(mean) * error) / (total - error)
    mean[total < least] = np.nan
    # So near to the least that either may be.
    allowed[np.abs(total - least) < 2 * tolerance * least] = np.inf
    return Expected(mean, allowed)


def expected_square_of_dispersion(matter: Matter, view: View, weight: np.ndarray, value: np.ndarray,
                                  floor: float, tolerance: float) -> Expected:
    """By sums of deviations from the mean of all."""
    top, total = project(matter, view, [weight * value, weight])
    whole = total.values.sum()
    deviation = value - (top.values.sum() / whole if whole > 0 else 0)
    first = expected_mean(matter, view, weight, deviation, floor, tolerance)
    second = expected_mean(matter, view, weight, deviation**2, floor, tolerance)
    with np.errstate(all="ignore"):
        allowed = second.allowed + (2 * np.abs(first.values) + first.allowed) * first.allowed
        return Expected(second.values - first.values**2, allowed)
