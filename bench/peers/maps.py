"""Our map of a column density beside those of other programs, on the same particles.

    bench/peers/run SNAPSHOT            makes what is needed, and calls this file for each program

One program a call, because they want different versions of NumPy:

    python maps.py prepare SNAPSHOT WORK_FOLDER
    python maps.py draw PROGRAM WORK_FOLDER PIXELS     draws, and writes what it took and how exact it is
    python maps.py table WORK_FOLDER                   the table, of medians over all calls

PEERS_ONLY="swiftsimio, nested" draws one of a program's ways.

All programs get arrays in memory and draw the same square with every particle of the box in it; kernels that
leave the square are cut by its edges in all of them. What their kernels look like is their own
choice; all end at the same radius, but ours, a Gaussian of the cubic spline's second moment. So each is held to exact
means over pixels of its own kernel.
"""

import json
import math
import os
import platform
import struct
import sys
import time

import numpy as np

RUNS = 2
PATIENCE = 20  # seconds: of what takes longer the first run is the only one
SAMPLED = 300  # pixels that are compared with exact means
FLOOR = 1e-3  # of the mean: errors of less than that are parts of it


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


def best(function):
    """Processor seconds, of all threads, of the best of some runs after one that may compile."""
    seconds = []
    for _ in range(1 + RUNS):
        start = time.process_time()
        picture = function()
        seconds.append(time.process_time() - start)
        if seconds[0] > PATIENCE:
            break
    return min(seconds[1:] or seconds), np.asarray(picture, dtype=np.float64)


# Columns of kernels that end at 1 and have a whole of 1, at these distances from the middle.
def column_of(kernel):
    half, weights = np.polynomial.legendre.leggauss(64)
    distance = np.linspace(0, 1, 20001)
    if kernel is wendland_c2:
        column = kernel(distance)
    else:
        reach = np.sqrt(1 - distance**2)
        column = reach * (kernel(np.hypot(distance[:, None], reach[:, None] * half)) @ weights)
    return distance, column / trapezoid(2 * np.pi * distance * column, distance)


def trapezoid(values, places):
    return float(((values[1:] + values[:-1]) * np.diff(places)).sum() / 2)


def cubic_spline(q):
    return np.where(q < 0.5, 1 - 6 * q**2 + 6 * q**3, 2 * np.clip(1 - q, 0, None) ** 3)


# In two dimensions: swiftsimio takes no column of that in three.
def wendland_c2(q):
    return np.clip(1 - q, 0, None) ** 4 * (1 + 4 * q)


def parabola(q):
    return np.clip(1 - q**2, 0, None)


# Of panels along each axis of what a kernel and a pixel share, each of four points of Gauss.
PANELS = 12


def points_between(low, high):
    """Places and weights from each low to each high."""
    nodes, weights = np.polynomial.legendre.leggauss(4)
    places = ((np.arange(PANELS)[:, None] + (nodes + 1) / 2) / PANELS).ravel()
    weights = np.tile(weights / 2 / PANELS, PANELS)
    return low[:, None] + (high - low)[:, None] * places, (high - low)[:, None] * weights


def means_of_column(column, dx, dy, reach, pixel):
    """Over the pixel around 0, of kernels at dx, dy."""
    half = pixel / 2
    x, of_x = points_between(np.maximum(dx - reach, -half), np.maximum(np.minimum(dx + reach, half), -half))
    y, of_y = points_between(np.maximum(dy - reach, -half), np.maximum(np.minimum(dy + reach, half), -half))
    distance = np.hypot((x - dx[:, None])[:, :, None], (y - dy[:, None])[:, None, :]) / reach[:, None, None]
    values = np.interp(distance, *column, right=0) / reach[:, None, None] ** 2
    return np.einsum("px,py,pxy->p", np.clip(of_x, 0, None), np.clip(of_y, 0, None), values) / pixel**2


def sum_of_columns(column, mass, dx, dy, reach, pixel):
    """What lies in the pixel whole needs no integral."""
    is_whole = np.maximum(np.abs(dx), np.abs(dy)) + reach <= pixel / 2
    total = mass[is_whole].sum() / pixel**2
    parts = np.flatnonzero(~is_whole)
    for some in np.array_split(parts, len(parts) // 256 + 1):
        total += (mass[some] * means_of_column(column, dx[some], dy[some], reach[some], pixel)).sum()
    return total


def mean_of_gaussian(dx, dy, reach, pixel):
    from scipy.special import erf

    width = math.sqrt(3 / 20) * reach
    x, y = ((erf((d + pixel / 2) / width) - erf((d - pixel / 2) / width)) / 2 for d in (dx, dy))
    return x * y / pixel**2


class Nearby:
    """Finds particles by their rows: those of usual reach among few, the others among all of them."""

    def __init__(self, y, far):
        self.most = np.quantile(far, 0.98)
        order = np.argsort(y)
        is_usual = far[order] <= self.most
        self.usual, self.others = order[is_usual], order[~is_usual]
        self.sorted = y[self.usual]

    def to(self, y):
        first, last = np.searchsorted(self.sorted, [y - self.most, y + self.most])
        return np.concatenate([self.usual[first:last], self.others])


def exact_values(p, kernel, pixels, chosen):
    """Of these pixels (row, column), in double precision."""
    pixel = p["side"] / pixels
    low = p["center"] - p["side"] / 2
    x, y, reach, mass = p["position"][:, 0] - low, p["position"][:, 1] - low, p["support"], p["mass"]
    column = None if kernel is None else column_of(kernel)
    far = (2.5 if kernel is None else 1) * reach + pixel / 2
    nearby = Nearby(y, far)
    values = []
    for row, at in chosen:
        some = nearby.to((row + 0.5) * pixel)
        dx, dy = x[some] - (at + 0.5) * pixel, y[some] - (row + 0.5) * pixel
        is_near = (np.abs(dx) < far[some]) & (np.abs(dy) < far[some])
        some, dx, dy = some[is_near], dx[is_near], dy[is_near]
        if kernel is None:
            values.append((mass[some] * mean_of_gaussian(dx, dy, reach[some], pixel)).sum())
        else:
            values.append(sum_of_columns(column, mass[some], dx, dy, reach[some], pixel))
    return np.array(values)


def errors(p, kernel, picture, folder):
    """Root of the mean square and the largest, over max(value, FLOOR * mean)."""
    pixels = len(picture)
    chosen = np.random.default_rng(1).integers(0, pixels, (SAMPLED, 2))
    known = f"{folder}/exact-{kernel.__name__ if kernel else 'gaussian'}-{pixels}.npy"
    if not os.path.exists(known):
        np.save(known, exact_values(p, kernel, pixels, chosen))
    exact = np.load(known)
    drawn = picture[chosen[:, 0], chosen[:, 1]]
    error = np.abs(drawn - exact) / np.maximum(exact, FLOOR * picture.mean())
    return float(np.sqrt((error**2).mean())), float(error.max())


def splotchcl(p, pixels, tolerance):
    import splotchcl as library

    particles = library.Particles().gas(
        position=p["position"].astype(np.float32), mass=p["mass"].astype(np.float32),
        smoothing_length=p["support"].astype(np.float32))
    renderer = library.Renderer()  # which others compile before they are called, too
    draw = lambda: library.column(
        particles, types="gas", center=[p["center"]] * 3, width=p["side"], size=(pixels, pixels), tolerance=tolerance,
        device=renderer, settings={"map.periodic": False}).values
    return best(draw)


def swiftsimio(p, pixels, backend):
    from swiftsimio.visualisation.projection_backends import backends_parallel
    from swiftsimio.visualisation.projection_backends.kernels import kernel_gamma

    low = p["center"] - p["side"] / 2
    x, y = ((p["position"][:, k] - low) / p["side"] for k in (0, 1))
    h = p["support"] / p["side"] / kernel_gamma
    # A box side of 0: not periodic. Their first axis is x.
    arrays = {"x": x, "y": y, "m": p["mass"].astype(np.float32), "h": h.astype(np.float32)}
    draw = lambda few=None: backends_parallel[backend](
        **{name: values[:few] for name, values in arrays.items()}, res=pixels, box_x=0.0, box_y=0.0)
    draw(100)  # compiles
    seconds, picture = best(draw)
    return seconds, picture.T / p["side"] ** 2


def pynbody(p, pixels, fast):
    import pynbody
    from pynbody.sph import renderers

    snapshot = pynbody.new(gas=len(p["mass"]))
    snapshot["pos"] = p["position"] - p["center"]
    snapshot["mass"], snapshot["smooth"], snapshot["rho"] = p["mass"], p["support"] / 2, p["density"]
    for field, unit in (("pos", "kpc"), ("smooth", "kpc"), ("mass", "Msol"), ("rho", "Msol kpc**-3")):
        snapshot[field].units = unit
    draw = lambda: renderers.make_render_pipeline(
        snapshot.gas, quantity="rho", width=float(p["side"]), resolution=pixels, out_units="Msol kpc**-2",
        approximate_fast=fast, threaded=True).render()
    return best(draw)


def sarracen(p, pixels):
    import sarracen as library

    frame = library.SarracenDataFrame(
        {"x": p["position"][:, 0], "y": p["position"][:, 1], "z": p["position"][:, 2], "m": p["mass"],
         "h": p["support"] / 2, "rho": p["density"]}, params={"mass": p["mass"][0], "hfact": 1.2})
    frame.kernel = library.kernels.CubicSplineKernel()
    low, high = p["center"] - p["side"] / 2, p["center"] + p["side"] / 2
    draw = lambda: library.interpolate.interpolate_3d_proj(
        frame, "rho", x_pixels=pixels, y_pixels=pixels, xlim=(low, high), ylim=(low, high), normalize=False)
    return best(draw)


def sphviewer(p, pixels):
    import sphviewer as library

    half = p["side"] / 2
    particles = library.Particles(p["position"], p["mass"], p["support"])
    camera = library.Camera(x=p["center"], y=p["center"], z=p["center"], r="infinity", t=0, p=0, roll=0,
                            extent=[-half, half, -half, half], xsize=pixels, ysize=pixels)
    seconds, picture = best(lambda: library.Render(library.Scene(particles, camera)).get_image())
    return seconds, picture


def sphviewer2(p, pixels):
    import sphviewer2 as library

    levels = int(round(math.log2(pixels)))
    if 2**levels != pixels:
        raise SystemExit(f"found {pixels} pixels, expected a power of 2")
    x, y, z = p["position"].T
    particles = library.Particles(x, y, z, p["support"], p["mass"])
    camera = library.Camera(
        Lbox=p["side"] / 0.6, extent=p["side"], xc=p["center"], yc=p["center"], zc=p["center"], periodic=False, r_max=levels)

    def draw():
        projector = library.Projector(camera)
        projector.project(particles, num_threads=os.cpu_count())
        return projector.collapse()

    return best(draw)


# How each draws, and its kernel; None: a Gaussian.
PROGRAMS = {
    "splotchcl": {
        "splotchcl, tolerance 1e-3": (lambda p, n: splotchcl(p, n, 1e-3), None),
        "splotchcl, tolerance 1e-2": (lambda p, n: splotchcl(p, n, 1e-2), None)},
    "swiftsimio": {
        f"swiftsimio, {backend}": ((lambda p, n, b=backend: swiftsimio(p, n, b)), wendland_c2)
        for backend in ("histogram", "fast", "renormalised", "nested", "subsampled", "reference")},
    "pynbody": {
        "pynbody": (lambda p, n: pynbody(p, n, False), cubic_spline),
        "pynbody, approximate": (lambda p, n: pynbody(p, n, True), cubic_spline)},
    "sarracen": {"sarracen": (sarracen, cubic_spline)},
    "py-sphviewer": {"py-sphviewer": (sphviewer, cubic_spline)},
    "py-sphviewer2": {"py-sphviewer2": (sphviewer2, parabola)},
}


def draw(program, folder, pixels):
    p = dict(np.load(f"{folder}/particles.npz"))
    p["side"], p["center"] = float(p["side"]), float(p["center"])
    version = __import__("importlib.metadata").metadata.version(program) if program != "splotchcl" else "this"
    for name, (function, kernel) in PROGRAMS[program].items():
        if os.environ.get("PEERS_ONLY", name) != name:
            continue
        try:
            seconds, picture = function(p, int(pixels))
        except (KeyError, TypeError):  # a backend that this version does not have
            continue
        known = f"{folder}/{name}-{pixels}.json"
        row = json.load(open(known)) if os.path.exists(known) else None
        if row is None:
            rms, worst = errors(p, kernel, picture, folder)
            row = {"name": f"{name} ({version})", "pixels": int(pixels), "seconds": [], "rms": rms, "worst": worst,
                   "mass": picture.sum() * (p["side"] / int(pixels)) ** 2}
        row["seconds"].append(seconds)
        json.dump(row, open(known, "w"))


def table(folder):
    rows = [json.load(open(f"{folder}/{name}")) for name in os.listdir(folder) if name.endswith(".json")]
    for pixels in sorted({row["pixels"] for row in rows}):
        of_size = [row for row in rows if row["pixels"] == pixels]
        ours = next(row for row in of_size if row["name"].startswith("splotchcl, tolerance 1e-3"))
        print(f"\n{pixels} x {pixels} pixels, {platform.processor() or platform.machine()}, {os.cpu_count()} cores:\n")
        print("| program | processor seconds | over ours | mass over ours | error, root of the mean square | largest |")
        print("|---|--:|--:|--:|--:|--:|")
        for row in sorted(of_size, key=lambda row: np.median(row["seconds"])):
            seconds = np.median(row["seconds"])
            print(f"| {row['name']} | {seconds:.2f} | {seconds / np.median(ours['seconds']):.1f} "
                  f"| {row['mass'] / ours['mass']:.5f} | {row['rms']:.1e} | {row['worst']:.1e} |")


if __name__ == "__main__":
    {"prepare": prepare, "draw": draw, "table": table}[sys.argv[1]](*sys.argv[2:])
