"""The same figure of a SWIFT and of a Gadget run: two_runs.py SWIFT_SNAPSHOT GADGET_SNAPSHOT [FIGURE]

SWIFT's files say their units, Gadget's do not: they are taken for comoving kpc/h and 1e10 Msun/h.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import splotchcl

UNITS_OF_GADGET = {"map.length_unit": "a kpc/h", "map.mass_unit": "1e10 Msun/h"}
swift, gadget = sys.argv[1:3]

figure, all_axes = plt.subplots(1, 2, figsize=(11, 5), layout="constrained")
for axes, path, units in zip(all_axes, (swift, gadget), ({}, UNITS_OF_GADGET), strict=True):
    snapshot = splotchcl.Snapshot(path)
    density = splotchcl.column(
        snapshot, types="gas", size=(400, 400), unit="Msun/pc^2", settings=units
    )
    shown = axes.imshow(
        density.values, origin="lower", extent=density.extent, norm="log", cmap="magma"
    )
    figure.colorbar(shown, label=f"{density.quantity} [{density.unit}]")
    redshift = snapshot.redshift
    axes.set_title(snapshot.format + ("" if redshift is None else f", z = {redshift:.2f}"))
    axes.set_xlabel(f"{density.axes[0]} [{density.length_unit}]")
figure.savefig(sys.argv[3] if len(sys.argv) > 3 else "two_runs.png", dpi=150)
