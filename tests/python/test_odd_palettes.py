"""Color maps of other programs."""

import numpy as np
import pytest
from odd import of
from splotchcl import _core

pytestmark = pytest.mark.usefixtures("program", "renderer")


def colors_between(places, colors):
    """256 colors between knots."""
    at = np.linspace(0, 1, 256)
    return np.column_stack([np.interp(at, places, channel) for channel in np.transpose(colors)])


def palettes_of(colors):
    """What each form of the same color map is, by the names of files."""
    even = np.linspace(0, 1, len(colors))
    in_bytes = np.round(colors * 255) / 255
    exact, rounded = colors_between(even, colors), colors_between(even, in_bytes)
    of_floats = ("01.txt", "alpha.txt", "commas.txt", "ds9.lut", "map.npy", "names.csv", "paraview.json",
                 "paraview.xml")
    of_bytes = ("255.txt", "gimp.gpl", "gmt.cpt", "hex.txt", "ncl.rgb")
    palettes = dict.fromkeys(of_floats, exact) | dict.fromkeys(of_bytes, rounded)
    palettes |= dict.fromkeys(("imagej.lut", "photoshop.act"), np.repeat(in_bytes, 16, axis=0))
    # The first column of one is a place for each color; the other has red and green alike.
    palettes["positions.txt"] = colors_between(even**2, colors)
    palettes["ds9.sao"] = colors_between([0, 1], [[0, 0, 1], [1, 1, 0]])
    return palettes


@of("d01_palettes")
def test_color_maps_of_all_forms_are_read(odd_files):
    palettes = palettes_of(np.load(odd_files / "d01_map.npy"))
    names = {path.name for path in odd_files.glob("d01_*")}
    assert names == {f"d01_{name}" for name in palettes}
    for name, wanted in palettes.items():
        # Colors of uneven places become 1024 of even ones.
        nearly = 3e-3 if name == "positions.txt" else 2e-5
        read = np.array(_core.palette_colors(str(odd_files / f"d01_{name}"), 1))
        np.testing.assert_allclose(read, wanted, atol=nearly, err_msg=name)
