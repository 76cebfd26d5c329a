"""Our map of a column density beside those of other programs, on the same particles.

    bench/peers/run SNAPSHOT            makes what is needed, and calls this file for each program

One program a call, because they want different versions of NumPy:

    python maps.py PROGRAM WORK_FOLDER OURS...

WORK_FOLDER holds particles.npz (what run wrote with `prepare`) and ours.npy, our map. Prints a row of
the table: correlation, relative L2 after smoothing both maps to 8 pixels, mass in the map over the
mass in ours, seconds. All programs get arrays in memory and draw the same square, 512 x 512 pixels,
with every particle of the box in it; kernels that leave the square are cut by its edges in all of
them. What their kernels look like is their own choice; all end at the same radius, but ours, a
Gaussian of the same second moment.
"""

import struct
import sys
import time

import numpy as np

PIXELS = 512
RUNS = 3


def gadget_blocks(path):
    """The blocks of a Gadget format 2 file, label to bytes."""
    found = {}
    with open(path, "rb") as file:
        while head := file.read(16):
            label, following = struct.unpack("<4x4si4x", head)
            found[label.decode().strip()] = file.read(following)[4:-4]
    return found


def prepare(snapshot, folder):
    """Gas as arrays, and the square that is drawn: 0.6 of the box around its middle."""
    blocks = gadget_blocks(snapshot)
    header = blocks["HEAD"]
    count = struct.unpack("<6i", header[:24])[0]
    table_mass = struct.unpack("<6d", header[24:72])[0]
    box = struct.unpack("<d", header[128:136])[0]
    position = np.frombuffer(blocks["POS"], np.float32).reshape(-1, 3)[:count]
    mass = np.full(count, table_mass) if table_mass > 0 else np.frombuffer(blocks["MASS"], np.float32)[:count]
    np.savez(
        f"{folder}/particles.npz",
        position=position.astype(np.float64),
        mass=mass.astype(np.float64),
        support=np.frombuffer(blocks["HSML"], np.float32).astype(np.float64),
        density=np.frombuffer(blocks["RHO"], np.float32).astype(np.float64),
        side=0.6 * box,
        center=0.5 * box,
    )
    print(0.5 * box, 0.6 * box)


def best(function):
    """Seconds of the best of some runs after one that may compile, and the picture."""
    picture = function()
    seconds = []
    for _ in range(RUNS):
        start = time.perf_counter()
        picture = function()
        seconds.append(time.perf_counter() - start)
    return min(seconds), np.asarray(picture, dtype=np.float64)


def swiftsimio(p, backend):
    from swiftsimio.visualisation.projection_backends import backends_parallel
    from swiftsimio.visualisation.projection_backends.kernels import kernel_gamma

    low = p["center"] - p["side"] / 2
    x, y = ((p["position"][:, k] - low) / p["side"] for k in (0, 1))
    h = p["support"] / p["side"] / kernel_gamma
    # A box side of 0: not periodic. Their first axis is x.
    draw = lambda: backends_parallel[backend](x=x, y=y, m=p["mass"].astype(np.float32), h=h.astype(np.float32),
                                              res=PIXELS, box_x=0.0, box_y=0.0)
    seconds, picture = best(draw)
    return seconds, picture.T / p["side"] ** 2


def pynbody(p, fast):
    import pynbody
    from pynbody.sph import renderers

    snapshot = pynbody.new(gas=len(p["mass"]))
    snapshot["pos"] = p["position"] - p["center"]
    snapshot["mass"], snapshot["smooth"], snapshot["rho"] = p["mass"], p["support"] / 2, p["density"]
    for field, unit in (("pos", "kpc"), ("smooth", "kpc"), ("mass", "Msol"), ("rho", "Msol kpc**-3")):
        snapshot[field].units = unit
    draw = lambda: renderers.make_render_pipeline(
        snapshot.gas, quantity="rho", width=float(p["side"]), resolution=PIXELS, out_units="Msol kpc**-2",
        approximate_fast=fast, threaded=True).render()
    return best(draw)


def sarracen(p):
    import sarracen as library

    frame = library.SarracenDataFrame(
        {"x": p["position"][:, 0], "y": p["position"][:, 1], "z": p["position"][:, 2], "m": p["mass"],
         "h": p["support"] / 2, "rho": p["density"]}, params={"mass": p["mass"][0], "hfact": 1.2})
    frame.kernel = library.kernels.CubicSplineKernel()
    low, high = p["center"] - p["side"] / 2, p["center"] + p["side"] / 2
    draw = lambda: library.interpolate.interpolate_3d_proj(
        frame, "rho", x_pixels=PIXELS, y_pixels=PIXELS, xlim=(low, high), ylim=(low, high), normalize=False)
    return best(draw)


def sphviewer(p):
    import sphviewer as library

    half = p["side"] / 2
    particles = library.Particles(p["position"], p["mass"], p["support"])
    camera = library.Camera(x=p["center"], y=p["center"], z=p["center"], r="infinity", t=0, p=0, roll=0,
                            extent=[-half, half, -half, half], xsize=PIXELS, ysize=PIXELS)
    seconds, picture = best(lambda: library.Render(library.Scene(particles, camera)).get_image())
    return seconds, picture


PROGRAMS = {
    "swiftsimio": {"swiftsimio, fast": lambda p: swiftsimio(p, "fast"),
                   "swiftsimio, subsampled": lambda p: swiftsimio(p, "subsampled")},
    "pynbody": {"pynbody": lambda p: pynbody(p, False), "pynbody, approximate": lambda p: pynbody(p, True)},
    "sarracen": {"sarracen": sarracen},
    "py-sphviewer": {"py-sphviewer": sphviewer},
}


def main(program, folder, our_seconds):
    from scipy.ndimage import gaussian_filter

    p = dict(np.load(f"{folder}/particles.npz"))
    p["side"], p["center"] = float(p["side"]), float(p["center"])
    ours = np.load(f"{folder}/ours.npy").astype(np.float64)
    for name, draw in PROGRAMS[program].items():
        seconds, theirs = draw(p)
        smooth = [gaussian_filter(picture, 8) for picture in (ours, theirs)]
        l2 = np.sqrt(np.sum((smooth[0] - smooth[1]) ** 2) / np.sum(smooth[0] ** 2))
        correlation = np.corrcoef(ours.ravel(), theirs.ravel())[0, 1]
        version = __import__("importlib.metadata").metadata.version(program)
        print(f"| {name} ({version}) | {correlation:.5f} | {l2:.4f} | {theirs.sum() / ours.sum():.4f} "
              f"| {seconds:.2f} | {seconds / float(our_seconds):.1f} |", flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "prepare":
        prepare(*sys.argv[2:])
    else:
        main(*sys.argv[1:])
