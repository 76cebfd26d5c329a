"""Films of the command line, by their frames."""

from __future__ import annotations

import numpy as np
import pytest

from splotchcl import Image

h5py = pytest.importorskip("h5py")

STEPS = 5


@pytest.fixture
def moving_ball(tmp_path):
    """One file with a group for each moment, in which a ball goes to the right between two that
    stay."""
    random = np.random.default_rng(3)
    ball = random.normal(0, 1, (400, 3))
    stays = np.concatenate([ball + [-30, 0, 0], ball + [30, 0, 0]])
    path = tmp_path / "run.h5"
    with h5py.File(path, "w") as file:
        for step in range(STEPS):
            points = np.concatenate([stays, ball + [10 * (step - 2), 15, 0]])
            group = file.create_group(f"Step#{step}")
            group.attrs["TimeValue"] = float(step)
            for axis, name in enumerate("xyz"):
                group[name] = points[:, axis].astype(np.float32)
            group["h"] = np.full(len(points), 2, np.float32)
            group["m"] = np.ones(len(points), np.float32)
            group["id"] = np.arange(len(points))
    return path


def place_of_light(image: np.ndarray) -> float:
    """Along x, of the upper part, in which nothing stays, from 0 to 1."""
    light = image[: 2 * len(image) // 5, :, :3].sum(axis=(0, 2), dtype=float)
    return float((light * (np.arange(len(light)) + 0.5)).sum() / light.sum() / len(light))


def test_a_film_of_steps_of_one_file_goes_through_them(program, renderer, moving_ball, tmp_path):
    through_time = f'[{{frame = 0, "time.index" = 0}}, {{frame = 8, "time.index" = {STEPS - 1}}}]'
    settings = ["camera.position=[0,0,200]", "camera.look_at=[0,0,0]", "camera.width=100",
                f"path.keyframes={through_time}"]
    words = [word for setting in settings for word in ("--set", setting)]
    program("movie", f"{moving_ball}/Step#%d", "-o", tmp_path / "f_%d.exr",
            "--size", "96x96", *words)
    places = [place_of_light(Image.open(tmp_path / f"f_{i}.exr").linear) for i in range(9)]
    # From 20 to the left to 20 to the right of the middle, seen from behind, of 100 across.
    steps = np.linspace(-20, 20, 9) / 100
    assert np.abs(places - (0.5 + steps)).max() < 0.02 or np.abs(places - (0.5 - steps)).max() < 0.02


@pytest.mark.parametrize("words", [["--dive", "densest"], ["--follow", "densest"]])
def test_the_light_of_suggested_films_never_jumps(program, renderer, tmp_path, words):
    frames = 24
    program("generate", "universe", "--particles", 2000, "-o", tmp_path / "universe.gadget")
    program("movie", tmp_path / "universe.gadget", "-o", tmp_path / "f_%02d.png",
            "--size", "36x24", "--set", f"movie.frames={frames}", *words)
    means = [Image.open(tmp_path / f"f_{i:02d}.png").linear[..., :3].mean() for i in range(frames)]
    steps = np.abs(np.diff(means))
    assert steps.max() < 0.15 * np.mean(means)
    assert steps[0] < 0.02 * np.mean(means) and steps[-1] < 0.02 * np.mean(means), "it is eased"
