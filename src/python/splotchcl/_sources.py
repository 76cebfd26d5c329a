"""What is drawn: types of particles by name, of a snapshot's files."""

from __future__ import annotations

import os
from collections.abc import Iterator, KeysView, Mapping
from pathlib import Path
from typing import Any

from . import _core
from ._core import UsageError
from ._particle_type import ParticleType


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
