"""First pictures of real snapshots, and films of real runs, are lit as pictures are.

The limits are wide: they tell a black, clipped, gray or lost picture, not a dull one.
"""

import numpy as np
import pytest

import splotchcl

SNAPSHOTS = [
    "lcdm/fmt2_snapshot_002",
    "lcdm/fmt2_snapshot_006",
    "gadget_minimal/snap_002.0",
    "gassphere_id64/fmt2_snapshot_001",
    "galaxy_collision/snapshot_000.hdf5",
    "tipsy/tiny.000640",
    "tipsy/shocktube.std",
]


def light_of(path):
    """Red, green and blue as they are shown, 1 for white."""
    return splotchcl.Image.open(path).linear[..., :3].astype(float)


def assert_lit(shown):
    brightest, darkest = shown.max(axis=2), shown.min(axis=2)
    assert (darkest >= 1).mean() <= 0.01, "clipped"
    assert (brightest > 0.02).mean() >= 0.25, "dark"


@pytest.mark.parametrize("name", SNAPSHOTS)
def test_first_picture(program, real_file, tmp_path, name):
    program("render", real_file(name), "--size", "320x200", "-o", tmp_path / "first.png")
    shown = light_of(tmp_path / "first.png")
    assert_lit(shown)
    brightest, darkest = shown.max(axis=2), shown.min(axis=2)
    assert np.median(brightest) < 0.9, "no ground"
    seen = brightest > 0.1
    saturation = ((brightest - darkest) / np.maximum(brightest, 1e-9))[seen].mean()
    assert 0.2 < saturation < 0.9
    # What is seen fills the frame along an axis at least, and lies within it along both.
    rows, columns = np.nonzero(seen)
    height = np.subtract(*np.percentile(rows, [98, 2])) / shown.shape[0]
    width = np.subtract(*np.percentile(columns, [98, 2])) / shown.shape[1]
    assert max(width, height) > 0.5
    assert min(width, height) > 0.2


def hue(shown):
    """The mean hue, weighted by chroma, as an angle in turns."""
    red, green, blue = np.moveaxis(shown, 2, 0)
    turn = np.arctan2(np.sqrt(3) * (green - blue), 2 * red - green - blue)
    chroma = shown.max(axis=2) - shown.min(axis=2)
    return np.angle((chroma * np.exp(1j * turn)).sum()) / (2 * np.pi)


def test_gas_of_a_universe_has_cold_and_hot_colors(program, real_file, tmp_path):
    program("render", real_file("lcdm/fmt2_snapshot_006"), "--size", "320x200", "-o", tmp_path / "a.png")
    shown = light_of(tmp_path / "a.png")
    brightest = shown.max(axis=2)
    faint = shown[brightest < np.percentile(brightest, 50)]
    bright = shown[brightest > np.percentile(brightest, 97)]
    apart = abs(hue(faint[None]) - hue(bright[None]))
    assert min(apart, 1 - apart) > 0.15


@pytest.mark.parametrize("first", ["lcdm/fmt2_snapshot_002", "galaxy_collision/snapshot_000.hdf5"])
def test_films_are_lit_from_beginning_to_end(program, real_file, tmp_path, first):
    series = str(real_file(first)).replace("002", "%03d").replace("000", "%03d")
    program("movie", series, "--size", "96x60", "--frames", "0:250:62", "-o", tmp_path / "frame_%03d.png")
    shown = [light_of(path) for path in sorted(tmp_path.glob("frame_*.png"))]
    assert len(shown) == 5
    for picture in shown:
        assert_lit(picture)
