"""Every script in examples/python runs and draws."""

import json
from pathlib import Path

import numpy as np
import pytest

from conftest import run_python
from splotchcl import Image

EXAMPLES = Path(__file__).parents[2] / "examples" / "python"


def run(name, *arguments):
    done = run_python(EXAMPLES / name, *arguments)
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


def test_stars_by_age(renderer, tmp_path):
    run("stars_by_age.py", tmp_path / "a.png")
    assert is_picture(tmp_path / "a.png")


def test_dust(renderer, tmp_path):
    pytest.importorskip("matplotlib")
    run("dust.py", tmp_path / "dust.png")
    assert is_picture(tmp_path / "dust.png")


def test_two_runs(renderer, tmp_path, real_file):
    pytest.importorskip("matplotlib")
    swift, gadget = real_file("swift/swift_lcdm_0000.hdf5"), real_file("lcdm/fmt2_snapshot_006")
    run("two_runs.py", swift, gadget, tmp_path / "figure.png")
    assert is_picture(tmp_path / "figure.png")


def test_beside_pynbody(renderer, tmp_path, real_file):
    """Kernels differ in shape, and what leaves the square is cut by pixels of other sizes."""
    pytest.importorskip("pynbody")
    pytest.importorskip("scipy")
    told = run("beside_pynbody.py", real_file("lcdm/fmt2_snapshot_006"), tmp_path / "a.png")
    mass, difference = (line.split(": ")[1] for line in told.splitlines())
    assert float(mass.split()[0]) == pytest.approx(1, abs=0.02)
    assert float(difference) < 0.02
    assert is_picture(tmp_path / "a.png")


def test_beside_yt(renderer, tmp_path, real_file):
    pytest.importorskip("yt")
    pytest.importorskip("matplotlib")
    told = run("beside_yt.py", real_file("lcdm/fmt3_snapshot_006.hdf5"), tmp_path / "a.png")
    mass, difference = (line.split(": ")[1] for line in told.splitlines())
    assert float(mass.split()[0]) == pytest.approx(1, abs=0.005)
    assert float(difference) < 0.01
    assert is_picture(tmp_path / "a.png")


def test_the_notebook(renderer, universe, tmp_path):
    cells = json.loads((EXAMPLES / "first_look.ipynb").read_text())["cells"]
    script = tmp_path / "notebook.py"
    script.write_text("\n\n".join("".join(c["source"]) for c in cells if c["cell_type"] == "code"))
    done = run_python(script, environment={"SNAPSHOT": str(universe)})
    assert done.returncode == 0, done.stderr
    assert "the brightest pixel" in done.stdout


def test_each_example_is_run():
    names = {path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".ipynb")}
    source = Path(__file__).read_text()
    assert {name for name in names if f'"{name}"' not in source} == set()
