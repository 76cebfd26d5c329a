"""Our map beside pynbody's of the same particles: beside_pynbody.py SNAPSHOT [FIGURE]

Needs pynbody and scipy, and a snapshot with gas that has smoothing lengths and a periodic box. Prints
how far the maps lie from each other when both are smoothed, so that the kernels' shapes matter less.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pynbody
from scipy.ndimage import gaussian_filter

import splotchcl

PIXELS, SMOOTHED = 256, 8

snapshot = pynbody.load(sys.argv[1])
snapshot.physical_units(distance="kpc", mass="Msol")
particles = splotchcl.Particles.of(snapshot.gas)
half = particles.box_size / 2
ours = splotchcl.column(
    particles,
    center=[half, half, half],
    width=1.2 * half,
    size=(PIXELS, PIXELS),
    settings={"map.length_unit": "kpc", "map.mass_unit": "Msun", "map.periodic": False},
    unit="Msun/kpc^2",
).values

# pynbody takes smoothing lengths of files as they are, and its kernel for twice as wide.
snapshot.gas["smooth"] /= 2
snapshot.gas["pos"] -= pynbody.array.SimArray([half] * 3, "kpc")
theirs = pynbody.plot.sph.image(
    snapshot.gas, qty="rho", width=1.2 * half, resolution=PIXELS, units="Msol kpc^-2", noplot=True
)

smooth = [gaussian_filter(np.asarray(map, float), SMOOTHED) for map in (ours, theirs)]
difference = np.sqrt(np.sum((smooth[0] - smooth[1]) ** 2) / np.sum(smooth[1] ** 2))
print(f"mass: {np.sum(ours) / np.sum(theirs):.4f} of pynbody's")
print(f"relative L2 at {SMOOTHED} pixels: {difference:.4f}")

figure, all_axes = plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained")
for axes, map, name in zip(all_axes, (ours, theirs), ("splotchcl", "pynbody"), strict=True):
    shown = axes.imshow(map, origin="lower", norm="log", cmap="inferno", vmin=np.percentile(ours, 1))
    axes.set_title(name)
figure.colorbar(shown, ax=all_axes, label="Msun/kpc^2")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "beside_pynbody.png", dpi=150)
