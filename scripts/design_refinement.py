#!/usr/bin/env python3
"""Designs the ten weights by which coarse grids of slabs are refined, and checks those in use.

A refinement interpolates a grid to half its pixel size. A new pixel lies a quarter of an old
pixel beside an old one, and takes ten old pixels, -4 to 5, with ten weights that add up to 1
(refinement_filter.cpp). The grid holds sums of Gaussians exp(-(x - c)^2 / sigma^2),
whose centres c lie anywhere and whose sigma is at least 2 old pixels. The criterion:

    minimize    the largest |error| over all c at sigma = 2
    such that   the weights add up to 1, so that even light stays even, and
                |error| <= 4e-5 over all c at sigma = 4: the next refinement

Wider Gaussians than that err by less: nothing is asked of them. Both sets of conditions are
linear in the weights. So this is a linear program with a condition for each c and sign; it is
solved by exchange, as Remez' and Stiefel's algorithms do, and c is taken as a continuous number.

What it reproduces: the largest error of the weights that are used (1.7319e-4 of the peak) to
four digits, and each weight to 2.1e-5. The optimum is that flat: weights that differ by 2e-5 in
this way change the largest error by 4e-9. The last digits of the weights that are used depend on
the sampling of c with which they were once found, which is not recorded. They are kept, so that
pictures keep their bits.

Needs numpy (Debian: python3-numpy).
usage: scripts/design_refinement.py [FILE WITH minimax_weights]
Exits with 1 if the weights in the file do not hold the errors that are stated for them.
"""
import pathlib
import re
import sys

import numpy as np

PIXELS = np.arange(-4, 6)
NEW_PIXEL = 0.25
LIMIT_AT_4 = 4e-5

# What docs/dev/accuracy.md states, of the peak and for one axis: the largest error of one refinement
# for splats that are at least so many old pixels wide, ...
STATED_ERRORS = {2: 1.74e-4, 4: 4.01e-5, 8: 3.06e-5, 16: 1.30e-5}
# ... and the sum of the errors of all refinements after the first.
STATED_FURTHER = 1.0e-4


def gaussians(sigma, centers):
    """Gaussians at the old pixels, a row for each center, and at the new pixel."""
    rows = np.exp(-((PIXELS[None, :] - centers[:, None]) ** 2) / sigma**2)
    return rows, np.exp(-((NEW_PIXEL - centers) ** 2) / sigma**2)


def errors(weights, sigma, centers):
    rows, wanted = gaussians(sigma, centers)
    return rows @ weights - wanted


def extremes(weights, sigma):
    """The centers at which the error is locally largest, to 1e-6 of a pixel, and the errors."""
    step = 0.01 * sigma
    centers = np.arange(-5 - 4 * sigma, 6 + 4 * sigma, step)
    size = np.abs(errors(weights, sigma, centers))
    top = np.nonzero((size[1:-1] >= size[:-2]) & (size[1:-1] >= size[2:]))[0] + 1
    found = centers[top]
    for fine in (step / 20, step / 400, step / 8000):
        offsets = fine * np.arange(-25, 26)
        near = found[:, None] + offsets[None, :]
        values = np.abs(errors(weights, sigma, near.ravel())).reshape(near.shape)
        found = found + offsets[np.argmax(values, axis=1)]
    return found, errors(weights, sigma, found)


def largest_error(weights, sigma):
    return np.abs(extremes(weights, sigma)[1]).max()


class Exchange:
    """Minimizes the largest error t at sigma 2 by exchanging one condition after the other.

    The unknowns are nine coordinates of the weights and t. `conditions` holds ten inequalities
    (row, bound): row @ unknowns <= bound, which hold with equality at the present point. The
    point is the optimum for these ten, so the one that is violated the most comes in, and the
    one goes out without which the point is the optimum again: a dual simplex.
    """

    def __init__(self):
        # Coordinates in which the errors of sigma 2 are orthogonal: weights themselves would
        # lose five digits, since what is narrower than two pixels hardly changes the errors.
        centers = np.arange(-9, 10, 0.05)
        rows, _ = gaussians(2, centers)
        free = np.vstack([np.eye(9), -np.ones(9)])  # weights that add up to 0
        _, triangle = np.linalg.qr(rows @ free)
        self.basis = free @ np.linalg.inv(triangle)
        self.start = np.full(10, 0.1)
        self.conditions = self.first_conditions()

    def condition(self, sigma, center, sign):
        rows, wanted = gaussians(sigma, np.array([center]))
        row = sign * (rows[0] @ self.basis)
        bound = sign * (wanted[0] - rows[0] @ self.start)
        if sigma == 2:
            return np.append(row, -1.0), bound  # error <= t
        return np.append(row, 0.0), bound + LIMIT_AT_4

    def first_conditions(self):
        """Any ten centers, with the signs for which t is bounded from below."""
        centers = np.linspace(-6.5, 7.5, 10)
        rows, _ = gaussians(2, centers)
        _, _, right = np.linalg.svd((rows @ self.basis).T)
        return [self.condition(2, c, np.sign(s)) for c, s in zip(centers, right[-1])]

    def solve(self):
        matrix = np.array([row for row, _ in self.conditions])
        point = np.linalg.solve(matrix, np.array([bound for _, bound in self.conditions]))
        return self.start + self.basis @ point[:9], point[9], matrix

    def most_violated(self, weights, t):
        worst = (1e-14, None)
        for sigma, limit in ((2, t), (4, LIMIT_AT_4)):
            centers, found = extremes(weights, sigma)
            excess = np.abs(found) - limit
            k = int(np.argmax(excess))
            if excess[k] > worst[0]:
                worst = (excess[k], (sigma, centers[k], np.sign(found[k])))
        return worst[1]

    def run(self):
        for _ in range(500):
            weights, t, matrix = self.solve()
            violated = self.most_violated(weights, t)
            if violated is None:
                return weights, t
            new = self.condition(*violated)
            objective = np.append(np.zeros(9), -1.0)
            multipliers = np.linalg.solve(matrix.T, objective)
            step = np.linalg.solve(matrix.T, new[0])
            ratios = np.where(step > 1e-12, np.maximum(multipliers, 0) / np.maximum(step, 1e-12),
                              np.inf)
            self.conditions[int(np.argmin(ratios))] = new
        raise RuntimeError("no optimum after 500 exchanges")


def read_weights(path):
    text = path.read_text()
    found = re.search(r"minimax_weights\s*=\s*\{([^}]*)\}", text)
    if not found:
        sys.exit(f"{path}: found no minimax_weights = {{...}}, expected the ten weights")
    weights = np.array([float(word) for word in found.group(1).split(",") if float(word) != 0])
    if len(weights) != 10:
        sys.exit(f"{path}: found {len(weights)} minimax_weights, expected 10")
    return weights


def refine(values, weights):
    """One axis: two new pixels for each old one, left and right of its center."""
    count = len(values)
    padded = np.pad(values, 5)
    new = np.zeros(2 * count)
    for k, weight in zip(PIXELS, weights):
        new[1::2] += weight * padded[5 + k:5 + k + count]
        new[0::2] += weight * padded[5 - k:5 - k + count]
    return new


def accumulated_errors(weights, sigma, refinements):
    """The largest errors on one axis and on both after each of several refinements in a row, in
    which the errors of the earlier ones are interpolated, too."""
    samples = [[] for _ in range(refinements)]
    for center in np.linspace(0, 1, 65):
        places = np.arange(-30.0, 31.0)
        values = np.exp(-((places - center) ** 2) / sigma**2)
        for pairs in samples:
            quarter = 0.25 * (places[1] - places[0])
            places = np.column_stack([places - quarter, places + quarter]).ravel()
            values = refine(values, weights)
            exact = np.exp(-((places - center) ** 2) / sigma**2)
            pairs.append((exact, values - exact))
    one_axis, both_axes = [], []
    for pairs in samples:
        value, error = (np.concatenate(column) for column in zip(*pairs))
        one_axis.append(np.abs(error).max())
        # Of all places where the Gaussian has nearly one value, the worst of either sign.
        of_both = 0
        bins = np.minimum((400 * value).astype(int), 399)
        for take in (np.maximum, np.minimum):
            worst = np.zeros(400)
            take.at(worst, bins, error)
            height = (np.arange(400) + 0.5) / 400
            product = np.outer(worst, height)
            of_both = max(of_both, np.abs(product + product.T + np.outer(worst, worst)).max())
        both_axes.append(of_both)
    return one_axis, both_axes


def main():
    folder = pathlib.Path(__file__).resolve().parent.parent
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else \
        next((folder / "src").rglob("refinement_filter.cpp"))
    used = read_weights(path)
    designed, t = Exchange().run()

    print("weights of pixels -4 .. 5")
    print("             used         designed here   difference")
    for k, a, b in zip(PIXELS, used, designed):
        print(f"  {k:3d}  {a:15.11f}  {b:15.11f}  {a - b:11.1e}")
    print(f"their sums less 1: {used.sum() - 1:.1e}, {designed.sum() - 1:.1e}\n")

    print("largest error of one refinement on one axis, of the peak")
    print("  sigma       used   designed     stated")
    is_held = True
    for sigma in (2, 2.25, 2.5, 3, 4, 6, 8, 12, 16, 32, 64):
        error = largest_error(used, sigma)
        stated = STATED_ERRORS.get(sigma)
        is_held &= stated is None or error <= stated
        print(f"  {sigma:5}  {error:9.3e}  {largest_error(designed, sigma):9.3e}"
              + ("" if stated is None else f"  {stated:9.3e}"))
    further = sum(largest_error(used, 2.0**n) for n in range(2, 12))
    is_held &= further <= STATED_FURTHER
    print(f"sum over all refinements after the first: {further:.2e}, stated {STATED_FURTHER:.1e}\n")

    print("largest error after 1, 2, ... refinements, with the earlier errors interpolated")
    for sigma in (2, 2.11):
        for name, row in zip(("one axis", "both axes"), accumulated_errors(used, sigma, 6)):
            print(f"  sigma {sigma:4}, {name + ':':10} " + " ".join(f"{e:.2e}" for e in row))

    if not is_held:
        sys.exit(f"{path}: the weights err by more than is stated")
    print("\nThe weights that are used hold the stated errors.")


if __name__ == "__main__":
    main()
