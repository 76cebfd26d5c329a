"""Every script in examples/python runs and draws."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from splotchcl import Image

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"


def run(name, *arguments):
    done = subprocess.run(
        [sys.executable, EXAMPLES / name, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def is_picture(path):
    values = Image.open(path).linear[..., :3]
    return np.unique(values).size > 50


def test_a_first_look(renderer, universe, tmp_path):
    told = run("first_look.py", universe, tmp_path / "a.png")
    assert "gas: 17000 particles" in told
    assert is_picture(tmp_path / "a.png")


def test_a_figure(renderer, universe, tmp_path):
    pytest.importorskip("matplotlib")
    run("figure.py", universe, tmp_path / "figure.png")
    assert is_picture(tmp_path / "figure.png")


def test_a_film_loop(renderer, tmp_path):
    run("film_loop.py", tmp_path, 3)
    assert len(list(tmp_path.glob("frame_*.png"))) == 3
    assert is_picture(tmp_path / "frame_0002.png")


def test_each_example_is_run():
    tested = {"first_look.py", "figure.py", "film_loop.py"}
    assert {path.name for path in EXAMPLES.glob("*.py")} == tested
