"""Our map of the gas that yt has read, beside yt's: beside_yt.py SNAPSHOT [FIGURE]

Needs yt and matplotlib, and a snapshot with gas that has densities. Prints how far the maps lie from
each other in means of 8 x 8 pixels, so that the kernels' shapes matter less.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import yt

import splotchcl

PIXELS, SQUARE = 256, 8

yt.set_log_level(40)
dataset = yt.load(sys.argv[1])
center, width = dataset.domain_center, 0.6 * dataset.domain_width[0]

# yt's arrays know their unit, and so does a map of them.
ours = splotchcl.column(
    splotchcl.Particles.of(dataset),
    types="gas",
    center=center.to("code_length"),
    width=width,
    size=(PIXELS, PIXELS),
    unit="Msun/kpc^2",
).values

projected = dataset.proj(("gas", "density"), "z").to_frb(width, PIXELS, center=center)
theirs = np.asarray(projected["gas", "density"].to("Msun/kpc**2"))


def squares(map):
    return map.reshape(PIXELS // SQUARE, SQUARE, PIXELS // SQUARE, SQUARE).mean(axis=(1, 3))


difference = np.linalg.norm(squares(ours) - squares(theirs)) / np.linalg.norm(squares(theirs))
print(f"mass: {np.sum(ours) / np.sum(theirs):.4f} of yt's")
print(f"relative L2 of squares of {SQUARE} pixels: {difference:.4f}")

figure, all_axes = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
for axes, map, name in zip(all_axes, (ours, theirs), ("splotchcl", "yt"), strict=True):
    shown = axes.imshow(map, origin="lower", norm="log", cmap="inferno", vmin=np.percentile(ours, 1))
    axes.set_title(name)
figure.colorbar(shown, ax=all_axes, label="Msun/kpc^2")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "beside_yt.png", dpi=150)
