"""Particles of objects of other packages: pynbody, swiftsimio, yt. Known by what they have, so that
none of these packages is needed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._core import UsageError

# A field of ours, theirs for it, and what theirs is multiplied by.
_Names = dict[str, str]

# What SWIFT's smoothing lengths are multiplied by where its kernel is the cubic spline.
_CUBIC_SPLINE_GAMMA = 1.825742


@dataclass
class Loaded:
    """What an object holds: arrays by our type and our field, with their units."""

    types: dict[str | int, dict[str, Any]] = field(default_factory=dict)
    box_size: Any = None  # a number or three, with a unit where the object's have one
    time: float | None = None
    scale_factor: float | None = None


def load_object(obj: Any, fields: Sequence[str]) -> Loaded:
    """The particles of an object; `fields` are further ones, by the object's own names.

    Raises
    ------
    UsageError
        For an object of no known kind, and for fields that no type of it has.
    """
    for is_kind, load in _KINDS:
        if is_kind(obj):
            loaded: Loaded = load(obj, fields)
            _require(fields, loaded)
            return loaded
    raise UsageError(
        f"found a {type(obj).__module__}.{type(obj).__name__}, expected a snapshot of pynbody, a "
        "dataset of swiftsimio, or data of yt; arrays go one by one: "
        "Particles().gas(position=..., mass=...)"
    )


def _require(fields: Iterable[str], loaded: Loaded) -> None:
    for name in fields:
        if not any(name in arrays for arrays in loaded.types.values()):
            raise UsageError(f"field {name!r}: no type of particles has it")
    if not loaded.types:
        raise UsageError("found no particles with positions, expected some")


# pynbody: families with arrays by name.
_PYNBODY_TYPES: dict[str, str | int] = {"gas": "gas", "dm": "halo", "star": "stars", "bh": 5}
_PYNBODY_FIELDS: _Names = {
    "position": "pos",
    "mass": "mass",
    "density": "rho",
    "smoothing_length": "smooth",
    "temperature": "temp",
    "internal_energy": "u",
}


def _is_pynbody(obj: Any) -> bool:
    return all(hasattr(obj, name) for name in ("families", "loadable_keys", "properties"))


def _load_pynbody(snapshot: Any, fields: Sequence[str]) -> Loaded:
    loaded = Loaded()
    stored = {name for family in snapshot.families() for name in snapshot[family].loadable_keys()}
    for family in snapshot.families():
        kind = _PYNBODY_TYPES.get(family.name)
        if kind is None:
            continue
        particles = snapshot[family]
        there = _pynbody_arrays(particles, bool(stored))
        arrays = {ours: particles[name] for ours, name in _PYNBODY_FIELDS.items() if name in there}
        for name in fields:
            # What one family stores is not derived for another.
            if name in there or (name not in stored and name in particles.derivable_keys()):
                arrays[name] = particles[name]
        if "smoothing_length" in arrays:
            reach = _pynbody_reach(snapshot, "smooth" in particles.loadable_keys())
            arrays["smoothing_length"] = arrays["smoothing_length"] * reach
        loaded.types[kind] = arrays
    loaded.box_size = _pynbody_box(snapshot)
    scale = snapshot.properties.get("a")
    loaded.time = loaded.scale_factor = None if scale is None else float(scale)
    return loaded


# What the file holds, but not what happens to have been derived of it before: else it would matter
# what was looked at. Temperatures follow from internal energies here. Without a file all was set.
def _pynbody_arrays(particles: Any, is_of_file: bool) -> set[str]:
    there = {*particles.keys(), *particles.loadable_keys()}
    if is_of_file:
        there -= {*particles.derivable_keys()} - {*particles.loadable_keys()}
    return there


# How far a kernel reaches, in its smoothing lengths. pynbody's own are half of it; those that it
# reads it leaves as the file has them.
def _pynbody_reach(snapshot: Any, is_read: bool) -> float:
    kinds = " ".join(kind.__name__ for kind in type(snapshot.ancestor).__mro__)
    if is_read and "Swift" in kinds:
        return _CUBIC_SPLINE_GAMMA
    return 1 if is_read and "Gadget" in kinds else 2


def _pynbody_box(snapshot: Any) -> float | None:
    side = snapshot.properties.get("boxsize")
    if side is None:
        return None
    if hasattr(side, "in_units"):  # a unit, as pynbody writes lengths
        side = side.in_units(snapshot["pos"].units, **snapshot.conversion_context())
    return float(side)


# swiftsimio: groups with arrays as attributes. SWIFT's smoothing lengths are the kernel's scale.
_SWIFT_TYPES: dict[str, int] = {
    "gas": 0,
    "dark_matter": 1,
    "background_dark_matter": 2,
    "boundary": 2,
    "sinks": 3,
    "stars": 4,
    "black_holes": 5,
    "neutrinos": 6,
}
_SWIFT_FIELDS: _Names = {
    "position": "coordinates",
    "mass": "masses",
    "density": "densities",
    "smoothing_length": "smoothing_lengths",
    "temperature": "temperatures",
}


def _is_swiftsimio(obj: Any) -> bool:
    return hasattr(getattr(obj, "metadata", None), "present_group_names")


def reach_of_swift(metadata: Any) -> float:
    """Where the kernel of a run of SWIFT ends, in its smoothing lengths."""
    return float(np.ravel(metadata.hydro_scheme.get("Kernel gamma", _CUBIC_SPLINE_GAMMA))[0])


def _load_swiftsimio(data: Any, fields: Sequence[str]) -> Loaded:
    loaded = Loaded()
    metadata = data.metadata
    reach = reach_of_swift(metadata)
    for group in metadata.present_group_names:
        particles = getattr(data, group)
        if group not in _SWIFT_TYPES or not hasattr(particles, "coordinates"):
            continue
        arrays = {ours: _attribute(particles, name) for ours, name in _SWIFT_FIELDS.items()}
        arrays.update({name: _attribute(particles, name) for name in fields})
        if group == "black_holes":
            arrays["mass"] = _attribute(particles, "dynamical_masses")
        arrays = {name: values for name, values in arrays.items() if values is not None}
        if "smoothing_length" in arrays:
            arrays["smoothing_length"] = arrays["smoothing_length"] * reach
        loaded.types[_SWIFT_TYPES[group]] = arrays
    loaded.box_size = _swift_box(metadata, loaded)
    scale = getattr(metadata, "scale_factor", None)
    loaded.time = loaded.scale_factor = None if scale is None else float(scale)
    return loaded


# Comoving, whatever positions have been converted to: Particles makes it theirs. Where it does not
# say that itself, as in early releases, it is made theirs here.
def _swift_box(metadata: Any, loaded: Loaded) -> Any:
    sides = metadata.boxsize
    if getattr(sides, "comoving", None) is not None:
        return sides
    for arrays in loaded.types.values():
        position = arrays["position"]
        is_physical = getattr(position, "comoving", None) is False
        scale = float(metadata.scale_factor) if is_physical else 1.0
        return np.asarray(sides.to(position.units), np.float64) * scale
    return None


# Arrays are read when they are asked for; those that a file does not have raise or are None.
def _attribute(particles: Any, name: str) -> Any:
    try:
        return getattr(particles, name)
    except (AttributeError, KeyError):
        return None


# yt: data containers with arrays by type and name; all come in the units of the code. What it calls
# a smoothing length ends the kernel.
_YT_TYPES: dict[str, int] = {"Gas": 0, "DarkMatter": 1, "Stars": 4, "io": 0}
_YT_FIELDS: dict[str, tuple[tuple[str, ...], str]] = {
    "position": (("particle_position",), "code_length"),
    "mass": (("particle_mass",), "code_mass"),
    "density": (("density", "Density"), "code_mass/code_length**3"),
    "smoothing_length": (("smoothing_length", "SmoothingLength"), "code_length"),
    "temperature": (("temperature", "Temperature"), "K"),
}


def _is_yt(obj: Any) -> bool:
    return hasattr(getattr(obj, "ds", obj), "particle_types_raw")


def _load_yt(obj: Any, fields: Sequence[str]) -> Loaded:
    dataset = getattr(obj, "ds", obj)
    data = obj if hasattr(obj, "ds") else obj.all_data()
    known = {*dataset.field_list, *dataset.derived_field_list}
    loaded = Loaded()
    for kind in dataset.particle_types_raw:
        number = _yt_type(kind)
        if number is None or (kind, "particle_position") not in known:
            continue
        arrays: dict[str, Any] = {}
        for ours, (names, unit) in _YT_FIELDS.items():
            name = next((name for name in names if (kind, name) in known), None)
            if name is not None:
                arrays[ours] = data[kind, name].in_units(unit)
        arrays.update({name: data[kind, name] for name in fields if (kind, name) in known})
        if len(arrays["position"]) > 0:
            loaded.types[number] = arrays
    if all(dataset.periodicity):
        loaded.box_size = np.asarray(dataset.domain_width.in_units("code_length"))
    loaded.time = float(dataset.current_time)
    return loaded


def _yt_type(kind: str) -> int | None:
    if kind.startswith("PartType") and kind[8:].isdecimal():
        return int(kind[8:])
    return _YT_TYPES.get(kind)


_KINDS: tuple[tuple[Callable[[Any], bool], Callable[[Any, Sequence[str]], Loaded]], ...] = (
    (_is_pynbody, _load_pynbody),
    (_is_swiftsimio, _load_swiftsimio),
    (_is_yt, _load_yt),
)
