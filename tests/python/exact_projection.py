"""Sums over particles that nothing approximates: by the formulas of docs/maps.md, in double
precision, with numpy alone and nothing of splotchcl's."""

from __future__ import annotations

import itertools
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


def gaussian_of_axis(edges: np.ndarray, width: float) -> np.ndarray:
    """How much of a Gaussian of this width around 0 lies between each two edges."""
    # What lies outside of each edge, on its own side: so little keeps all its digits.
    outside = _erfc(np.abs(edges / width)).astype(float)
    left, right = edges[:-1], edges[1:]
    one_side = np.abs(np.diff(outside))
    across = 2 - outside[:-1] - outside[1:]
    return np.where((left < 0) & (right > 0), across, one_side) / 2


def gaussian_profile(distance: float, width: float) -> float:
    """Of a Gaussian along one axis, its whole being 1."""
    return math.exp(-((distance / width) ** 2)) / (math.sqrt(math.pi) * width)


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


def images(offset: np.ndarray, reach: float, view: View) -> list[np.ndarray]:
    """Of a particle all that may be seen."""
    half = np.array([view.width * view.pixel / 2 + reach, view.height * view.pixel / 2 + reach, np.inf])
    if view.is_slice:
        half[2] = reach
    elif view.depth is not None:
        half[2] = view.depth / 2
    sides = view.sides()
    if sides is None:
        shifts = [np.zeros(3)]
    else:
        counts = [range(math.ceil((-h - x) / s), math.floor((h - x) / s) + 1)
                  for x, h, s in zip(offset, half, sides)]
        shifts = [np.array(n) * sides for n in itertools.product(*counts)]
    places = [offset + shift for shift in shifts]
    return [p for p in places if abs(p[0]) <= half[0] and abs(p[1]) <= half[1]
            and -half[2] <= p[2] < half[2]]


@dataclass
class Sums:
    """Means per area (of slices: per volume) in pixels, and the most that one particle gives a pixel."""

    values: np.ndarray
    brightest: float = 0

    def floor(self, part: float) -> float:
        """A part of the mean; single precision has no digits beyond 2^-50 of the brightest."""
        return max(part * float(np.abs(self.values).mean()), 2.0**-50 * self.brightest)


def project(matter: Matter, view: View, amounts: list[np.ndarray]) -> list[Sums]:
    """Of each of these, one number a particle."""
    x_edges, y_edges = view.edges()
    area = view.pixel**2
    sums = [Sums(np.zeros((view.height, view.width))) for _ in amounts]
    offsets = view.offsets(matter.positions)
    for i, h in enumerate(matter.smoothing_lengths):
        width = KERNEL_WIDTH * float(h)
        for place in images(offsets[i], REACH * width, view):
            of_plane = gaussian_profile(place[2], width) if view.is_slice else 1.0
            shape = of_plane * np.outer(gaussian_of_axis(y_edges - place[1], width),
                                        gaussian_of_axis(x_edges - place[0], width))
            peak = of_plane / max(area, math.pi * width**2)
            for total, amount in zip(sums, amounts):
                total.values += float(amount[i]) * shape / area
                total.brightest = max(total.brightest, abs(float(amount[i])) * peak)
    return sums


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
