"""Dust lanes in front of stars, seen by three observers: dust.py [PICTURE]

Gas absorbs more than it emits, and blue light more than red: what lies behind it is dim and red.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import splotchcl

random = np.random.default_rng(2)
count = 40000
radius = random.exponential(2.5, count)
angle = 2.2 * np.log1p(radius) + random.integers(2, size=count) * np.pi
angle += random.normal(0, 0.3, count)
lanes = [radius * np.cos(angle), radius * np.sin(angle), random.normal(0, 0.05, count)]

particles = splotchcl.Particles()
particles.gas(position=np.stack(lanes, axis=1).astype(np.float32), mass=1.0)
particles.stars(position=random.normal(0, (2.5, 2.5, 0.6), (count, 3)), mass=1.0)

scene = splotchcl.suggest(particles, size=(400, 300))
scene.update(
    {
        "component.gas.palette": "dust",
        "component.gas.absorption": 1.5,
        "component.gas.brightness": 0.3,
        "component.stars.palette": "stars",
        "component.stars.absorption": "none",
        "component.stars.brightness": 0.4,
        "camera.look_at": [0, 0, 0],
        "camera.sky": [0, 0, 1],
    }
)
renderer = splotchcl.Renderer()
figure, all_axes = plt.subplots(1, 3, figsize=(12, 3.2), layout="constrained")
for axes, degrees in zip(all_axes, (80, 35, 3), strict=True):
    up = np.radians(degrees)
    scene["camera.position"] = [0, -22 * np.cos(up), 22 * np.sin(up)]
    axes.imshow(renderer.render(scene, particles).display())
    axes.set_title(f"{degrees} degrees above the disk")
    axes.set_axis_off()
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "dust.png", dpi=150)
