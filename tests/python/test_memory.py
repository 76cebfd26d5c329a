"""Arrays of a hundred million particles are drawn where they lie."""

import os

import pytest

import splotchcl
from conftest import run_python

DRAW = """
import resource
import numpy as np, splotchcl

def arrays(count):
    return {
        "position": np.random.default_rng(1).random((count, 3), np.float32),
        "smoothing_length": np.full(count, 0.002, np.float32),
        "density": np.arange(count, dtype=np.float32),
        "mass": 1.0,
    }

def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024

few = splotchcl.Particles().gas(**arrays(1000))
scene = splotchcl.suggest(few, size=(400, 300))
scene["component.0.absorption"] = "none"
renderer = splotchcl.Renderer()
renderer.render(scene, few)
given = arrays(COUNT)
before = peak()
image = renderer.render(scene, splotchcl.Particles().gas(**given))
assert image.linear[..., :3].max() > 0
print((peak() - before) / COUNT)
"""


@pytest.mark.skipif(
    "SPLOTCHCL_LONG_TESTS" not in os.environ, reason="takes 2 GB and a minute: scripts/test --long"
)
def test_a_hundred_million_particles_are_drawn_without_a_second_copy(renderer):
    """The smallest array has 4 bytes a particle."""
    if any(device["is_gpu"] for device in splotchcl.devices() if device["is_default"]):
        pytest.skip("a GPU's driver keeps copies of its own")
    done = run_python("-c", DRAW.replace("COUNT", "100_000_000"), timeout=3000)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < 2
