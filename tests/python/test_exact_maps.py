"""Maps against projections that nothing approximates (exact_projection.py), over random set-ups."""

import math
import os
from dataclasses import dataclass

import numpy as np
import pytest

import exact_projection as exact
import splotchcl
from splotchcl import Particles

SEEDS = range(3000 if "SPLOTCHCL_LONG_TESTS" in os.environ else 300)
TOLERANCES = (1e-2, 1e-3, 1e-4)
MSUN_IN_G, KPC_IN_CM = 1.988410e33, 3.0856776e21
# Of a surface density or a density in Msun and kpc.
UNITS = {None: 1.0, "g/cm^2": MSUN_IN_G / KPC_IN_CM**2, "Msun/pc^3": 1e-9}


@dataclass
class SetUp:
    matter: exact.Matter
    view: exact.View
    quantity: str | None
    weight: str | None = None
    statistic: str | None = None
    floor: float = 1e-3
    unit: str | None = None

    def particles(self) -> Particles:
        box = None if self.view.box is None else tuple(map(float, self.view.box))
        fields = {"position": self.matter.positions, "smoothing_length": self.matter.smoothing_lengths,
                  "mass": self.matter.masses, "density": self.matter.densities, **self.matter.fields}
        return Particles(box_size=box).gas(
            **{name: values.astype(np.float32) for name, values in fields.items()}
        )

    def map(self, tolerance: float, renderer: splotchcl.Renderer) -> np.ndarray:
        view = self.view
        settings = {"map.floor": self.floor, "map.periodic": view.box is not None}
        if view.box is not None:
            settings["periodic.box"] = list(map(float, view.box))
        if self.unit is not None:
            settings |= {"map.length_unit": "kpc", "map.mass_unit": "Msun"}
        drawn = splotchcl.column(
            self.particles(), self.quantity, self.weight, types="gas", statistic=self.statistic,
            slice=view.is_slice, unit=self.unit, view=view.axes, center=list(map(float, view.center)),
            width=view.width * view.pixel, depth=view.depth, size=(view.width, view.height),
            tolerance=tolerance, settings=settings, device=renderer,
        )
        return drawn.values.astype(float) / UNITS[self.unit]


def as_stored(values: np.ndarray) -> np.ndarray:
    """As single precision has them."""
    return np.asarray(values).astype(np.float32).astype(float)


# Places are whole parts of pixels, so that a map has them to the last digit.
def random_places(random: np.random.Generator, count: int, half: np.ndarray, pixel: float) -> np.ndarray:
    parts = 4096
    kind = random.integers(3)
    if kind == 0:
        places = random.uniform(-1, 1, (count, 3)) * half
    elif kind == 1:
        places = random.normal(0, 0.2, (count, 3)) * half
    else:
        middles = random.uniform(-0.8, 0.8, (4, 3)) * half
        places = middles[random.integers(4, size=count)] + random.normal(0, 0.02, (count, 3)) * half
    return np.round(places / pixel * parts) / parts * pixel


def random_matter(random: np.random.Generator, view: exact.View, longest: float) -> exact.Matter:
    count = int(10 ** random.uniform(0, random.choice([1, 2, 3])))
    pixel, widest = view.pixel, max(view.width, view.height) * view.pixel
    half = view.box / 2 if view.box is not None else np.full(3, 0.7 * widest)
    places = random_places(random, count, half, pixel)
    if view.box is not None:
        places = np.clip(places, -half, half - pixel / 4096)
    low, high = np.sort(random.uniform(-3, 3, 2))
    sizes = np.minimum(10 ** random.uniform(low, high, count) * pixel, longest)
    def spread() -> np.ndarray:
        return 10 ** random.uniform(0, random.choice([0, 1, 6]), count)
    fields = {
        "temperature": as_stored(10 ** random.uniform(0, random.choice([0.1, 4, 20]), count)),
        "charge": as_stored(random.normal(random.choice([0, 0, 3]), 1, count)),
        "velocity": as_stored(random.normal(0, 10, (count, 3)) + random.choice([0, 1e3, 1e6])),
    }
    return exact.Matter(as_stored(places + view.center), as_stored(sizes), as_stored(spread()),
                        as_stored(10 ** random.uniform(-2, 2) * spread()), fields)


def random_view(random: np.random.Generator, unit: float) -> exact.View:
    width, height = (int(n) for n in random.integers(6, 49, 2))
    center = np.round(random.uniform(-100, 100, 3)) * unit
    view = exact.View(center, unit, width, height, str(random.choice(["xy", "xz", "yz"])))
    view.is_slice = bool(random.integers(4) == 0)
    if random.integers(2):
        view.box = random.integers(max(width, height) // 2, 2 * max(width, height), 3) * unit
        view.depth = float(view.sides()[2])
    elif random.integers(2):
        view.depth = float(random.integers(1, 30)) * unit
    return view


QUANTITIES = [(None, None, None), ("counts", None, None), ("temperature", "mass", None),
              ("temperature", "volume", None), ("temperature", "constant", None), ("charge", "mass", None),
              ("charge", "temperature", None), ("temperature", None, "integral"), ("charge", None, "integral"),
              ("line_of_sight_velocity", "mass", None), ("temperature", "mass", "dispersion"),
              ("line_of_sight_velocity", "mass", "dispersion"), ("charge", "mass", "dispersion")]


def set_up(seed: int) -> SetUp:
    random = np.random.default_rng(seed)
    view = random_view(random, 2.0 ** random.integers(-20, 21))
    # The program draws kernels over up to 64 boxes, which take the exact sum very long.
    boxes = 0.5 if view.is_slice else 2
    longest = math.inf if view.box is None else boxes * float(view.box.min())
    matter = random_matter(random, view, longest)
    quantity, weight, statistic = QUANTITIES[seed % len(QUANTITIES)]
    if view.is_slice and quantity == "counts":
        quantity = None
    if view.is_slice and statistic == "integral":
        statistic, weight = None, "volume"
    unit = None
    if quantity is None and seed % 2:
        unit = "Msun/pc^3" if view.is_slice else "g/cm^2"
    floor = float(random.choice([1e-2, 1e-3, 1e-6]))
    return SetUp(matter, view, quantity, weight, statistic, floor, unit)


def value_of(one: SetUp) -> np.ndarray:
    if one.quantity == "line_of_sight_velocity":
        axis, sign = exact.AXES[one.view.axes][2]
        return sign * one.matter.fields["velocity"][:, axis]
    return one.matter.fields[one.quantity]


def weight_of(one: SetUp) -> np.ndarray:
    matter = one.matter
    if one.weight in (None, "mass"):
        return matter.masses
    if one.weight == "volume":
        return matter.masses / matter.densities
    return np.ones(len(matter.masses)) if one.weight == "constant" else matter.fields[one.weight]


def expected(one: SetUp, tolerance: float) -> exact.Expected:
    matter, view, floor = one.matter, one.view, one.floor
    if one.quantity is None:
        return exact.expected_sum(matter, view, matter.masses, floor, tolerance)
    if one.quantity == "counts":
        found = exact.expected_sum(matter, view, np.ones(len(matter.masses)), floor, tolerance)
        area = view.pixel**2
        return exact.Expected(found.values * area, found.allowed * area)
    value, weight = value_of(one), weight_of(one)
    if one.statistic == "integral":
        amount = value * matter.masses / matter.densities
        return exact.expected_sum(matter, view, amount, floor, tolerance)
    if one.statistic == "dispersion":
        return exact.expected_square_of_dispersion(matter, view, weight, value, floor, tolerance)
    return exact.expected_mean(matter, view, weight, value, floor, tolerance)


def worst_error(drawn: np.ndarray, wanted: exact.Expected) -> float:
    """Over what is allowed; 1e-6 of the value beside it is for the map's own single precision."""
    is_known = np.isfinite(wanted.values) & (wanted.allowed < np.inf)
    must_be_nan = np.isnan(wanted.values) & (wanted.allowed < np.inf)
    assert np.isnan(drawn[must_be_nan]).all()
    assert np.isfinite(drawn[is_known]).all()
    allowed = wanted.allowed[is_known] + 1e-6 * np.abs(wanted.values[is_known]) + 1e-300
    return float((np.abs(drawn - wanted.values)[is_known] / allowed).max(initial=0))


@pytest.mark.parametrize("seed", SEEDS)
def test_maps_keep_their_tolerance(renderer, seed):
    one = set_up(seed)
    for tolerance in TOLERANCES:
        drawn = one.map(tolerance, renderer)
        if one.statistic == "dispersion":
            drawn = drawn**2
        error = worst_error(drawn, expected(one, tolerance))
        assert error < 1, (tolerance, error, one.quantity, one.weight, one.statistic, one.view)


@pytest.mark.parametrize("size", [64, 500])
def test_a_map_of_a_whole_box_has_all_of_its_particles(renderer, universe, size):
    """Kernels go on across the faces, and what ends of splats leave out is put back on average."""
    drawn = splotchcl.column(universe, "counts", types="gas", size=(size, size), tolerance=1e-4,
                             device=renderer)
    assert drawn.values.sum(dtype=float) == pytest.approx(17000, rel=1e-6)


def test_the_exact_projection_of_one_particle_is_a_difference_of_error_functions():
    matter = exact.Matter(np.array([[0.25, 0, 0]]), np.array([2.0]), np.array([3.0]), np.ones(1))
    view = exact.View(np.zeros(3), 1.0, 3, 1)
    (drawn,) = exact.project(matter, view, [matter.masses])
    width = 2 * math.sqrt(3 / 20)
    across = [math.erf((x + 0.25) / width) - math.erf((x - 0.75) / width) for x in (-1.0 + 0, 0.0, 1.0)]
    up = 2 * math.erf(0.5 / width)
    assert drawn.values[0] == pytest.approx([3 * a * up / 4 for a in across], rel=1e-12)


def test_the_exact_spline_has_all_of_a_particle_and_the_moment_of_our_gaussian():
    distance = (np.arange(2000) + 0.5) / 2000
    column = exact.spline_column(distance)
    ring = 2 * math.pi * distance / 2000
    assert (column * ring).sum() == pytest.approx(1, rel=1e-4)
    assert (column * ring * distance**2).sum() == pytest.approx(exact.KERNEL_WIDTH**2, rel=1e-3)


def test_a_particle_on_a_face_of_the_box_is_seen_from_both_sides():
    matter = exact.Matter(np.array([[0.0, 4, 4]]), np.array([2.0]), np.array([1.0]), np.ones(1))
    view = exact.View(np.full(3, 4.0), 1.0, 8, 8, depth=8.0, box=np.full(3, 8.0))
    (drawn,) = exact.project(matter, view, [matter.masses])
    assert drawn.values == pytest.approx(drawn.values[:, ::-1], rel=1e-12)
    assert drawn.values.sum() == pytest.approx(1, rel=1e-12)
