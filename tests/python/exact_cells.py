"""What cells of other shapes than pixels have of particles: by numpy alone, in double precision,
with nothing of splotchcl's."""

from __future__ import annotations

import math

import numpy as np

from exact_projection import KERNEL_WIDTH, REACH, gaussian_of_axis, spline

_erfc = np.vectorize(math.erfc)


def in_voxels(
    positions: np.ndarray,
    lengths: np.ndarray,
    amounts: np.ndarray,
    edges: list[np.ndarray],
    box: np.ndarray | None = None,
) -> np.ndarray:
    """Sums in cells between these edges along x, y and z; the first index is z."""
    total = np.zeros([len(e) - 1 for e in reversed(edges)])
    for place, h, amount in zip(positions, lengths, amounts):
        width = KERNEL_WIDTH * float(h)
        parts = []
        for axis, along in enumerate(edges):
            shifts = [0.0]
            if box is not None:
                side = float(box[axis])
                first = math.ceil((along[0] - REACH * width - place[axis]) / side)
                last = math.floor((along[-1] + REACH * width - place[axis]) / side)
                shifts = [n * side for n in range(first, last + 1)]
            parts.append(sum((gaussian_of_axis(along - place[axis] - s, width) for s in shifts),
                             np.zeros(len(along) - 1)))
        total += amount * np.einsum("k,j,i->kji", parts[2], parts[1], parts[0])
    return total


def in_shells(distances: np.ndarray, lengths: np.ndarray, amounts: np.ndarray,
              edges: np.ndarray) -> np.ndarray:
    """By an integral over radii that is fine enough for all of them."""
    nodes, weights = np.polynomial.legendre.leggauss(400)
    total = np.zeros(len(edges) - 1)
    for r, h, amount in zip(distances, lengths, amounts):
        width = KERNEL_WIDTH * float(h)
        for shell, (low, high) in enumerate(zip(edges[:-1], edges[1:])):
            low, high = max(low, r - REACH * width), min(high, r + REACH * width)
            if high <= low:
                continue
            radius = 0.5 * (low + high) + 0.5 * (high - low) * nodes
            # The mean over a sphere of this radius of a Gaussian that lies off its middle.
            off = 4 * r * radius / width**2
            mean = np.exp(-(((radius - r) / width) ** 2)) * np.where(
                off > 1e-9, -np.expm1(-off) / np.maximum(off, 1e-300), 1)
            density = mean / (math.pi**1.5 * width**3)
            total[shell] += amount * (4 * math.pi * radius**2 * density * weights).sum() * 0.5 * (high - low)
    return total


def seen_from_origin(place: np.ndarray, h: float, directions: np.ndarray) -> np.ndarray:
    """Of a particle, per solid angle: its density times the distance squared along each direction."""
    width = KERNEL_WIDTH * h
    along = directions @ place
    beside = np.maximum(place @ place - along**2, 0)
    depth = math.sqrt(math.pi) * width / 2 * (along**2 + width**2 / 2) * _erfc(-along / width)
    depth += width**2 * along / 2 * np.exp(-((along / width) ** 2))
    return np.exp(-beside / width**2) * depth / (math.pi**1.5 * width**3)


def spline_in_shell(distance: float, low: float, high: float, steps: int = 200) -> float:
    """Of a cubic spline that ends at 1: how much lies between two spheres around a place so far away."""
    nodes, weights = np.polynomial.legendre.leggauss(steps)
    radius = 0.5 * (low + high) + 0.5 * (high - low) * nodes
    angle = np.clip(nodes, -1, 1)
    apart = np.sqrt(np.maximum(
        radius[:, None] ** 2 + distance**2 - 2 * radius[:, None] * distance * angle, 0))
    density = (spline(np.minimum(apart, 1.0)) * weights).sum(1) / 2
    return float((4 * math.pi * radius**2 * density * weights).sum() * 0.5 * (high - low))
