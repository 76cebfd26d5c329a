"""What is drawn: types of particles by name, whose fields are arrays, of a snapshot's files."""

from __future__ import annotations

import os
from collections.abc import Iterator, KeysView, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._core import UsageError

# Some files say by a number below 0 that a particle is in no halo.
_IDENTIFIERS: dict[str, type[np.generic]] = {"id": np.uint64, "halo_id": np.int64}


class ParticleType:
    """The particles of one type of a snapshot; ``particles["density"]`` reads a field.

    Iterating gives the names of the fields, but for `derived` ones; ``len(particles)`` is the
    number of particles.
    """

    def __init__(self, source: _core.Source, name: str, described: dict[str, Any]) -> None:
        self._source = source
        self._described = described
        self.name = name

    def __len__(self) -> int:
        return int(self._described["count"])

    @property
    def particles_per_read(self) -> float:
        """How many particles of the file each stands for: more than 1 where a part of them is read."""
        return float(self._described["particles_per_read"])

    @property
    def fields(self) -> dict[str, str]:
        """Names of the fields, and their units ("" where the file does not say)."""
        return {name: field[2] for name, field in self._described["fields"].items()}

    @property
    def derived(self) -> list[str]:
        """Names of what follows from the fields and can be read as they are ("temperature")."""
        return list(self._described["derived"])

    def keys(self) -> KeysView[str]:
        """Names of the fields."""
        return self.fields.keys()

    def __iter__(self) -> Iterator[str]:
        return iter(self.fields)

    def _ipython_key_completions_(self) -> list[str]:
        return [*self.fields, *self.derived]

    def __contains__(self, field: object) -> bool:
        """Whether there is such a field, by its name here or in the file, or it can be derived."""
        if not isinstance(field, str):
            return False
        return self._canonical_name(field) in self.fields or field in self.derived

    def __getitem__(self, field: str) -> np.ndarray[Any, Any]:
        """A field, stored or derived ("temperature"), in the snapshot's unit; or a formula of fields.

        Returns
        -------
        numpy.ndarray
            float32 of shape (N,), or (N, 3) for vectors, read-only and without a copy where the
            file allows it. Positions that the file holds in double precision are float64.
            Identifiers are exact: "id" is uint64, "halo_id" int64.

        Raises
        ------
        UsageError, DataError
            For a field that the type does not have, naming those that it has, and for identifiers
            that are no whole numbers.
        """
        if not isinstance(field, str):
            raise UsageError(f"field {field!r}: expected a name, one of {', '.join(self.fields)}")
        name = self._canonical_name(field)
        if name in _IDENTIFIERS and name in self.fields:
            exact: np.ndarray[Any, Any] = np.asarray(
                self._source.read_integers(self._number, field)
            )
            return exact.view(_IDENTIFIERS[name])
        is_of_arrays = isinstance(self._source, _core.ParticleArrays)
        if name == "mass" and name not in self and self._described["mass"] is None:
            raise UsageError(
                f"field {field!r}: {self.name} has no masses, expected one of "
                f"{', '.join([*self.fields, *self.derived])}"
                + ("; set mass=..., an array or a number for all" if is_of_arrays else "")
            )
        values: np.ndarray[Any, Any] = np.asarray(self._source.read(self._number, field))
        origin = np.array(self._source.position_origin())
        if origin.any() and name == "position":
            absolute: np.ndarray[Any, Any] = values + origin
            return absolute
        return values

    @property
    def _number(self) -> int:
        return int(self._described["type"])

    def _canonical_name(self, field: str) -> str:
        return self._source.canonical_name(self._number, field)

    def __repr__(self) -> str:
        return f"<splotchcl {self.name}: {len(self)} particles, {', '.join(self.fields)}>"


class Source:
    """What Snapshot and Particles have in common: types of particles by name."""

    _source: _core.Source

    def _describe(self) -> dict[str, Any]:
        return self._source.describe()

    @property
    def types(self) -> dict[str, ParticleType]:
        """The types that have particles, by name ("gas", "halo", ..., "type_6")."""
        types = self._describe()["types"]
        return {name: ParticleType(self._source, name, types[name]) for name in types}

    def keys(self) -> KeysView[str]:
        """Names of the types that have particles."""
        return self.types.keys()

    def __iter__(self) -> Iterator[str]:
        return iter(self.types)

    def __len__(self) -> int:
        return len(self.types)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self.types)

    # Of no types it is particles all the same, to which some may be added.
    def __bool__(self) -> bool:
        return True

    def __contains__(self, name: object) -> bool:
        """Whether a type of this name, or another word for it, has particles."""
        return isinstance(name, str) and _type_name(name) in self.types

    def __getitem__(self, name: str) -> ParticleType:
        types = self.types
        if isinstance(name, str):
            name = _type_name(name)
        if name not in types:
            raise UsageError(f"particle type {name!r}: expected a name, one of {', '.join(types)}")
        return types[name]

    @property
    def box_size(self) -> float | tuple[float, float, float] | None:
        """Side of the periodic box in the unit of positions, or three; None: there is none."""
        size: float | tuple[float, float, float] | None = self._describe()["box_size"]
        return size

    def __repr__(self) -> str:
        described = self._describe()
        types = ", ".join(f"{name} {t['count']}" for name, t in described["types"].items())
        return f"<splotchcl {described['format']}: {types or 'no particles'}>"


class Snapshot(Source):
    """A snapshot file, opened; particles are read when they are asked for.

    Parameters
    ----------
    path : path-like
        Any member or the base name of a snapshot (docs/formats.md).
    read : mapping, optional
        Keys of a scene's ``[read]``: ``{"every": 10}``, ``{"max_particles": 100000}``.

    Raises
    ------
    DataError
        For a file that cannot be read or has no known format.
    """

    def __init__(
        self, path: str | os.PathLike[str], *, read: Mapping[str, Any] | None = None
    ) -> None:
        from ._toml import setting

        settings = [setting(f"read.{key}", value) for key, value in (read or {}).items()]
        self._source = _core.open_snapshot(Path(path), settings)

    @property
    def format(self) -> str:
        """What the file was found to be."""
        return str(self._describe()["format"])

    @property
    def files(self) -> list[Path]:
        """The files that it is read from."""
        return [Path(file) for file in self._describe()["files"]]

    @property
    def time(self) -> float:
        """The time, or scale factor, as the file has it."""
        return float(self._describe()["time"])

    @property
    def redshift(self) -> float | None:
        """The redshift, where the file has one."""
        redshift: float | None = self._describe()["redshift"]
        return redshift

    @property
    def notes(self) -> list[str]:
        """Oddities of the file, a line each."""
        return list(self._describe()["notes"])


def _type_name(word: str) -> str:
    number = _core.find_particle_type(word)
    return word if number is None else _core.particle_type_name(number)
