"""A first look at a snapshot: first_look.py SNAPSHOT [PICTURE]"""

import sys

import splotchcl

snapshot = splotchcl.Snapshot(sys.argv[1])
for name, particles in snapshot.types.items():
    print(f"{name}: {len(particles)} particles with {', '.join(particles.fields)}")

image = splotchcl.render(snapshot, size=(800, 600))
image.save(sys.argv[2] if len(sys.argv) > 2 else "first_look.png")
for note in image.notes:
    print("note:", note)
