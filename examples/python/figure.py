"""A figure in physical units with matplotlib: figure.py SNAPSHOT [FIGURE]

The snapshot's lengths are taken for comoving kpc/h, its masses for 1e10 Msun/h, as Gadget's are.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import splotchcl

UNITS = {"map.length_unit": "a kpc/h", "map.mass_unit": "1e10 Msun/h"}

density = splotchcl.column(
    sys.argv[1], types="gas", size=(512, 512), unit="Msun/pc^2", settings=UNITS
)
figure, axes = plt.subplots(layout="constrained")
shown = axes.imshow(
    density.values, origin="lower", extent=density.extent, norm="log", cmap="inferno"
)
figure.colorbar(shown, label=f"{density.quantity} [{density.unit}]")
axes.set_xlabel(f"{density.axes[0]} [{density.length_unit}]")
axes.set_ylabel(f"{density.axes[1]} [{density.length_unit}]")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else "figure.png", dpi=150)
