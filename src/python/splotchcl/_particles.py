"""Particles of one's own arrays, and the units that these carry."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from ._arrays import as_number, as_values, is_number
from ._core import UsageError
from ._sources import ParticleType, Source
from ._units import CarriedUnit, scale_factor_of, unit_of

_STANDARD_TYPES = ("gas", "halo", "disk", "bulge", "stars", "boundary")
# Where the unit of what all types share is kept, among those of types and fields.
_ORIGIN = (-1, "origin")


class Particles(Source):
    """One's own arrays.

    Contiguous float32 arrays are borrowed: they are kept, never changed, and read anew for each
    picture. Others are copied once, which `notes` tells. Lengths, masses and other values may have
    any units, the same for all; a scene's camera has the unit of positions.

    Parameters
    ----------
    box_size : float or sequence of 3 floats, optional
        Side of the periodic box, or one for each axis, in the unit of positions; a value with a unit
        of its own is converted to theirs. None: there is none.
    time : float, optional
        In the simulation's unit, for texts in pictures.
    scale_factor, redshift : float, optional
        One of them: comoving arrays that carry their unit (swiftsimio's) are then mapped in
        physical units, as physical ones are. Given arrays of swiftsimio know it themselves.
    origin : sequence of 3 floats, optional
        What positions are relative to: float32 positions are taken as offsets from it, from
        float64 positions it is subtracted before they become floats.

    Examples
    --------
    >>> particles = splotchcl.Particles(box_size=100)
    >>> particles.gas(position=x, mass=m, temperature=t)
    """

    def __init__(
        self,
        *,
        box_size: Any = None,
        time: float | None = None,
        scale_factor: float | None = None,
        redshift: float | None = None,
        origin: Any = None,
    ) -> None:
        self._arrays = _core.ParticleArrays()
        self._source = self._arrays
        # By type and field.
        self._units: dict[tuple[int, str], CarriedUnit] = {}
        self._notes: dict[tuple[int, str], str] = {}
        # Numbers for all masses of a type that are to be arrays, until its particles are known.
        self._masses_to_spread: dict[int, tuple[float, CarriedUnit | None]] = {}
        self._box_unit = unit_of(box_size)
        self._given_box = (0.0, 0.0, 0.0) if box_size is None else _sides("box_size", box_size)
        if box_size is not None:
            self._arrays.set_box_size(self._given_box)
        if time is not None:
            self._arrays.set_time(as_number("time", time))
        self._scale_factor = _scale_factor(scale_factor, redshift)
        if self._scale_factor is not None:
            self._arrays.set_scale_factor(self._scale_factor)
        if origin is not None:
            self._arrays.set_origin([as_number("origin", x) for x in origin])
            unit = unit_of(origin)
            if unit is not None:
                self._units[_ORIGIN] = unit

    @classmethod
    def of(cls, obj: Any, *, fields: Sequence[str] = ()) -> Particles:
        """The particles of a pynbody snapshot, a swiftsimio dataset, or yt data of particles.

        Taken are position, mass, and where there are any, density, smoothing length and temperature,
        with the side of the periodic box. Lengths and masses keep the object's units.

        Parameters
        ----------
        obj : pynbody.snapshot.SimSnap, swiftsimio.SWIFTDataset, yt dataset or data container
            Cut out of a periodic box, it still has the box.
        fields : sequence of str
            Further fields, by the object's names for them, which they keep.

        Raises
        ------
        UsageError
            For another object, and a field that no type has.
        """
        from ._objects import load_object

        loaded = load_object(obj, fields)
        particles = cls(
            box_size=loaded.box_size, time=loaded.time, scale_factor=loaded.scale_factor
        )
        for kind, arrays in loaded.types.items():
            particles.add(kind, **arrays)
        return particles

    @property
    def units(self) -> dict[str, str]:
        """The units that arrays carried, as text: "length" and names of fields."""
        return {what: unit.text for what, unit in self._carried_units().items()}

    @property
    def notes(self) -> list[str]:
        """Which arrays were copied, a line each."""
        return list(self._notes.values())

    def add(self, type: str | int, /, **fields: Any) -> Particles:
        """Sets fields of one type; a field that is set again replaces the earlier one.

        Parameters
        ----------
        type : str or int
            "gas", "halo", "disk", "bulge", "stars", "boundary", or a number from 0 to 31.
        **fields : array_like of shape (N,) or (N, 3), or a number for ``mass``
            ``position`` (needed), ``mass``, ``density``, ``smoothing_length``, or any other name
            that a scene asks for. Smoothing lengths end the kernel, and are found where they are
            missing.

        Returns
        -------
        Particles
            Itself.

        Raises
        ------
        UsageError
            For shapes, dtypes, lengths or units that do not fit; fields before the wrong one are
            set.
        """
        number = self._number(type)
        for field, values in fields.items():
            self._check_scale_factor(field, values)
        units = {(number, field): unit_of(values) for field, values in fields.items()}
        self._check_units(units)
        for field, values in fields.items():
            self._set(number, field, values, units[number, field])
        self._spread_mass(number)
        return self

    def _set(self, number: int, field: str, values: Any, unit: CarriedUnit | None) -> None:
        key = number, field
        if _shared_kind(field) == "mass":
            self._masses_to_spread.pop(number, None)
        if field == "mass" and is_number(values):
            mass = as_number("field mass", values)
            self._arrays.set_mass(number, mass)
            if unit is not None or self._has_array_of_masses(number):
                self._masses_to_spread[number] = mass, unit
        else:
            array, note = as_values(field, values)
            self._arrays.set_field(number, field, array, "" if unit is None else unit.name)
            self._notes.pop(key, None)
            if note is not None:
                self._notes[key] = note
        self._units.pop(key, None)
        if unit is not None:
            self._units[key] = unit
            if _shared_kind(field) == "length" and self._box_unit is not None:
                self._arrays.set_box_size(self._box_in(unit))

    # An array has a unit, which that of densities is compared with, and a number for all has none;
    # an array of masses counts before the number, which is to take its place.
    def _spread_mass(self, number: int) -> None:
        kind = self._kind(number)
        if number not in self._masses_to_spread or kind is None or len(kind) == 0:
            return
        mass, unit = self._masses_to_spread.pop(number)
        array = np.full(len(kind), mass, np.float32)
        self._arrays.set_field(number, "mass", array, "" if unit is None else unit.name)
        self._notes.pop((number, "mass"), None)

    def _has_array_of_masses(self, number: int) -> bool:
        kind = self._kind(number)
        return kind is not None and "mass" in kind.fields

    def _kind(self, number: int) -> ParticleType | None:
        return next((kind for kind in self.types.values() if kind._number == number), None)

    def gas(self, **fields: Any) -> Particles:
        """`add` for gas."""
        return self.add("gas", **fields)

    def stars(self, **fields: Any) -> Particles:
        """`add` for stars."""
        return self.add("stars", **fields)

    def dark_matter(self, **fields: Any) -> Particles:
        """`add` for the type "halo", which is dark matter."""
        return self.add("halo", **fields)

    def clear(self, type: str | int) -> None:
        """Forgets a type's fields. Needed before its number of particles changes."""
        number = self._number(type)
        self._arrays.clear(number)
        self._notes = {key: note for key, note in self._notes.items() if key[0] != number}
        self._units = {key: unit for key, unit in self._units.items() if key[0] != number}
        self._masses_to_spread.pop(number, None)

    def _number(self, type: str | int) -> int:
        if not isinstance(type, str):
            return int(type)
        number = _core.find_particle_type(type)
        if number is None:
            raise UsageError(
                f"particle type {type!r}: expected one of {', '.join(_STANDARD_TYPES)} or a number "
                "from 0 to 31"
            )
        return number

    def _carried_units(self) -> dict[str, CarriedUnit]:
        return {_shared_kind(field): unit for (_, field), unit in self._units.items()}

    # All that has a meaning together must have one unit. `given` are those of fields that are about
    # to take the place of others.
    def _check_units(self, given: Mapping[tuple[int, str], CarriedUnit | None]) -> None:
        known = {
            _shared_kind(key[1]): unit for key, unit in self._units.items() if key not in given
        }
        for (_, field), unit in given.items():
            if unit is None:
                continue
            expected = known.setdefault(_shared_kind(field), unit)
            if unit.text != expected.text:
                raise UsageError(
                    f"field {field}: the unit {unit.text}, expected {expected.text} as for other "
                    "particles; convert one of them"
                )
        if "length" in known:
            self._box_in(known["length"])

    # Arrays of swiftsimio say at which scale factor they are: it is that of all.
    def _check_scale_factor(self, field: str, values: Any) -> None:
        found = scale_factor_of(values)
        if found is None:
            return
        if self._scale_factor is None:
            self._scale_factor = found
            self._arrays.set_scale_factor(found)
        elif abs(found - self._scale_factor) > 1e-6 * self._scale_factor:
            raise UsageError(
                f"field {field}: at the scale factor {found:.8g}, expected {self._scale_factor:.8g} "
                "as of the other particles"
            )

    # The sides of the box in a unit of positions.
    def _box_in(self, length: CarriedUnit) -> tuple[float, float, float]:
        if self._box_unit is None:
            return self._given_box
        if length.is_comoving and self._box_unit.is_comoving is None:
            raise UsageError(
                f"box_size: the unit {self._box_unit.text}, which does not say whether it is comoving "
                f"as positions are; expected a number in {length.text}, or a comoving value"
            )
        ratio = _core.ratio_of_units(self._box_unit.name, length.name, self._source)
        if ratio is None:
            raise UsageError(
                f"box_size: the unit {self._box_unit.text}, expected one that can be converted to "
                f"{length.text}, that of positions; give it in that unit"
            )
        x, y, z = self._given_box
        return x * ratio, y * ratio, z * ratio


# Positions, smoothing lengths and the origin are lengths; other fields are themselves, whatever
# they are called.
def _shared_kind(field: str) -> str:
    name = _core.canonical_field_name(field) or field
    return "length" if name in ("position", "smoothing_length", "origin") else name


def _sides(what: str, values: Any) -> tuple[float, float, float]:
    if is_number(values):
        side = as_number(what, values)
        return side, side, side
    try:
        x, y, z = (as_number(what, value) for value in values)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{what}: found {values!r}, expected a number, or three") from error
    return x, y, z


def _scale_factor(scale_factor: float | None, redshift: float | None) -> float | None:
    if redshift is None:
        return None if scale_factor is None else as_number("scale_factor", scale_factor)
    if scale_factor is not None:
        raise UsageError("scale_factor and redshift: found both, expected one of them")
    of_redshift = as_number("redshift", redshift)
    if not of_redshift > -1:
        raise UsageError(f"redshift: found {of_redshift}, expected a number > -1")
    return 1 / (1 + of_redshift)
