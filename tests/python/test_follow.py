"""What films follow, found anew: particles chosen, traced and centered by numpy and h5py alone, and
shown by a camera of their own, stand in the middle of every frame."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from splotchcl import Scene

h5py = pytest.importorskip("h5py")

# Of the picture's shorter side.
MOST = 0.02


def gadget2_blocks(path: Path, names: set[str]) -> dict[str, np.ndarray]:
    """Blocks of a file of format 2 with single precision and ids of 32 bits."""
    data = path.read_bytes()
    blocks, at = {}, 0
    while at < len(data):
        name = data[at + 4 : at + 8].decode().strip()
        at += 16
        size = int(np.frombuffer(data, "<u4", 1, at)[0])
        kind = "<u4" if name == "ID" else "<f4"
        if name in names:
            blocks[name] = np.frombuffer(data, kind, size // 4, at + 4)
        at += size + 8
    return blocks


def of_gadget(path: Path) -> tuple[np.ndarray, np.ndarray]:
    blocks = gadget2_blocks(path, {"POS", "ID"})
    return blocks["POS"].reshape(-1, 3).astype(float), blocks["ID"].astype(np.int64)


def of_hdf5(path: Path) -> tuple[np.ndarray, np.ndarray]:
    with h5py.File(path) as file:
        types = [file[name] for name in file if name.startswith("PartType")]
        return (np.concatenate([np.asarray(t["Coordinates"], float) for t in types]),
                np.concatenate([np.asarray(t["ParticleIDs"], np.int64) for t in types]))


def nearest_image(offset: np.ndarray, box: float) -> np.ndarray:
    return offset - box * np.round(offset / box) if box else offset


def shrinking_sphere(points: np.ndarray, start: np.ndarray, radius: float, box: float) -> np.ndarray:
    """Where most of them are: the mean of ever smaller spheres around it, down to a tenth."""
    center = start
    inside = nearest_image(points - center, box)
    while True:
        within = np.linalg.norm(inside, axis=1) < radius
        if within.sum() < max(20, len(points) // 10):
            return center
        center = center + inside[within].mean(axis=0)
        inside = nearest_image(points - center, box)
        radius *= 0.9


def densest(points: np.ndarray, cell: float) -> np.ndarray:
    places, counts = np.unique(np.floor(points / cell).astype(int), axis=0, return_counts=True)
    return (places[counts.argmax()] + 0.5) * cell


def miss(frame: Scene, center: np.ndarray, box: float) -> float:
    """How far from the middle of a perspective picture a point is, over its shorter side."""
    position, look_at, sky = (np.asarray(frame[f"camera.{key}"], float)
                              for key in ("position", "look_at", "sky"))
    forward = (look_at - position) / np.linalg.norm(look_at - position)
    right = np.cross(forward, sky)
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    offset = nearest_image(center - look_at, box) + look_at - position
    width, height = frame.size
    focal = 0.5 * width / math.tan(0.5 * math.radians(frame["camera.field_of_view"]))
    across = focal * np.array([offset @ right, offset @ up]) / (offset @ forward)
    return float(np.linalg.norm(across)) / min(width, height)


def assert_followed(names: dict[int, Path], read, pattern: Path, types: list[int],
                    chosen: int, radius: float, cell: float, box: float) -> None:
    snapshots = {index: read(path) for index, path in names.items()}
    points, ids = snapshots[chosen]
    middle = shrinking_sphere(points, densest(points, cell), 2 * cell, box)
    for _ in range(3):  # the sphere's own
        near = np.linalg.norm(nearest_image(points - middle, box), axis=1) < radius
        middle = shrinking_sphere(points[near], middle, radius, box)
    followed = ids[np.linalg.norm(nearest_image(points - middle, box), axis=1) < radius]
    assert len(followed) > 100

    scene = Scene.from_toml(f"""
[time]
snapshots = "{pattern}"
[image]
size = [320, 240]
[camera]
position = [0, {-10 * radius}, {3 * radius}]
look_at = [0, 0, 0]
sky = [0, 0, 1]
field_of_view = 30
[path.follow]
sphere = {{ center = {middle.tolist()}, radius = {radius} }}
snapshot = {chosen}
[[path.keyframes]]
frame = 0
time.index = {min(names)}
[[path.keyframes]]
frame = {max(names) - min(names)}
time.index = {max(names)}
[[component]]
name = "matter"
types = {types}
""")
    frames = scene.frames()
    for index, (points, ids) in snapshots.items():
        mine = points[np.isin(ids, followed)]
        frame = frames[index - min(names)]
        # From where they are in the mean, about any one of them.
        start = mine[0] + nearest_image(mine - mine[0], box).mean(axis=0)
        reach = np.linalg.norm(nearest_image(mine - start, box), axis=1).max()
        center = shrinking_sphere(mine, start, reach, box)
        assert miss(frame, center, box) < MOST, f"in snapshot {index}"


def test_a_cluster_of_a_universe_stays_in_the_middle(real_file):
    names = {i: real_file(f"lcdm/fmt2_snapshot_{i:03d}") for i in (2, 4, 5, 6)}
    assert_followed(names, of_gadget, names[2].with_name("fmt2_snapshot_%03d"), [0, 1],
                    chosen=6, radius=2000, cell=1000, box=50000)


def test_a_galaxy_of_a_collision_stays_in_the_middle(real_file):
    names = {i: real_file(f"galaxy_collision/snapshot_{i:03d}.hdf5") for i in (0, 5, 10)}
    assert_followed(names, of_hdf5, names[0].with_name("snapshot_%03d.hdf5"), [1, 2],
                    chosen=0, radius=15, cell=2, box=0)
