"""Stars colored by their age on top of gas: stars_by_age.py [PICTURE]

Young stars lie in the arms of a made-up spiral galaxy, old ones in its bulge.
"""

import sys

import numpy as np

import splotchcl

random = np.random.default_rng(1)


def disk(count, length, height):
    """Places of a spiral galaxy's arms, around the origin."""
    radius = random.exponential(length, count)
    arm = random.integers(2, size=count) * np.pi
    angle = arm + 1.6 * np.log1p(radius) * 2 + random.normal(0, 0.25, count)
    place = [radius * np.cos(angle), radius * np.sin(angle), random.normal(0, height, count)]
    return np.stack(place, axis=1).astype(np.float32)


young, old = disk(20000, 3.0, 0.05), random.normal(0, 0.8, (20000, 3)).astype(np.float32)
age = np.concatenate([random.uniform(0.01, 1, len(young)), random.uniform(8, 13, len(old))])

particles = splotchcl.Particles()
particles.gas(position=disk(60000, 4.0, 0.08), mass=1.0)
particles.stars(
    position=np.concatenate([young, old]), mass=0.01, age=age.astype(np.float32)
)  # Gyr

scene = splotchcl.suggest(particles, size=(800, 600))
scene.update(
    {
        "component.gas.palette": "Purples_r",
        "component.gas.brightness": 0.1,
        "component.stars.color.field": "age",
        "component.stars.color.scaling": "linear",
        "component.stars.palette": "RdYlBu_r",
        "component.stars.absorption": "none",
    }
)
splotchcl.render(scene, particles).save(sys.argv[1] if len(sys.argv) > 1 else "stars_by_age.png")
