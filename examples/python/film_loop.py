"""Frames of a film of particles in memory: film_loop.py [FOLDER [FRAMES]]

A disk of gas is drawn from all around; what is decided for the first frame holds for all.
"""

import sys
from pathlib import Path

import numpy as np

import splotchcl

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
frames = int(sys.argv[2]) if len(sys.argv) > 2 else 100

random = np.random.default_rng(1)
count = 50000
radius = random.exponential(3, count)
angle = random.uniform(0, 2 * np.pi, count) + 0.8 * radius
position = np.stack(
    [radius * np.cos(angle), radius * np.sin(angle), random.normal(0, 0.2, count)], axis=1
).astype(np.float32)

particles = splotchcl.Particles()
particles.gas(position=position, mass=1.0, temperature=1e6 * np.exp(-radius / 3))

scene = splotchcl.suggest(particles, size=(400, 300)).decide(particles)
renderer = splotchcl.Renderer()
scene = renderer.render(scene, particles).scene  # with the exposure that the first frame finds
for number, frame in enumerate(scene.orbit(frames)):
    renderer.render(frame, particles).save(folder / f"frame_{number:04}.png")
