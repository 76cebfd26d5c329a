"""Scenes: what to draw and how."""

from __future__ import annotations

import copy
import os
from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from . import _core, _toml
from ._core import UsageError
from ._sources import Source
from ._untrusted import check_pictures_of

_FROM_ARRAYS = 'snapshot="arrays"'


class UnknownKey(UsageError, KeyError):
    """A key that scenes do not have; the message names the nearest."""

    __str__ = UsageError.__str__


class Scene(MutableMapping[str, Any]):
    """What to draw and how: a mapping with the keys of docs/scene.md, joined by dots.

    ``scene["camera.position"]``, ``scene["component.gas.color.field"]``,
    ``scene["component.0.brightness"]``. A key that is not set has the value None or its default.
    Iterating gives the keys that are set.

    Parameters
    ----------
    keys : mapping, optional
        Tables as in a scene file, ``{"component": [{"types": ["gas"]}], ...}``, and keys joined by
        dots, ``{"image.size": [640, 480], "component.0.types": ["gas"]}``, which come after them.

    Raises
    ------
    UsageError
        For keys that do not exist (`UnknownKey`, a KeyError as well), values of a wrong type or
        out of range. On an error a scene stays as it was.
    """

    def __init__(self, keys: Mapping[str, Any] | None = None) -> None:
        tables = {key: value for key, value in (keys or {}).items() if "." not in key}
        joined = {key: value for key, value in (keys or {}).items() if "." in key}
        _add_numbered_components(tables, joined)
        settings = [_toml.setting(key, value) for key, value in joined.items()]
        with _unknown_keys():
            self._scene = _core.parse_scene(
                _toml.document(tables), _settings_for_arrays({**tables, **joined}) + settings
            )
        self._suggested: _core.Scene | None = None

    # `suggested`: as what the scene began, of which another field or projection has no use.
    @classmethod
    def _of(cls, scene: _core.Scene, suggested: _core.Scene | None = None) -> Scene:
        made = cls.__new__(cls)
        made._scene = scene
        made._suggested = suggested
        return made

    @classmethod
    def from_file(
        cls, path: str | os.PathLike[str], settings: Mapping[str, Any] | None = None
    ) -> Scene:
        """Reads a scene file; paths in it are relative to its folder. Raises also DataError."""
        pairs = [_toml.setting(key, value) for key, value in (settings or {}).items()]
        return cls._of(_core.read_scene(Path(path), pairs))

    @classmethod
    def from_toml(cls, text: str) -> Scene:
        """Reads the text of a scene file; paths in it are relative to the current folder."""
        return cls._of(_core.parse_scene(text, _settings_for_arrays(_toml_or_empty(text))))

    def to_toml(self) -> str:
        """The text of a scene file; ``Scene.from_toml`` of it is the same scene."""
        return self._scene.to_toml()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a scene file that can be read from any folder: its paths are absolute."""
        Path(path).write_text(self._scene.with_absolute_names().to_toml(), encoding="utf-8")

    def copy(self) -> Scene:
        """A scene of its own with the same keys."""
        return Scene._of(self._scene, self._suggested)

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Scene:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return Scene.from_toml, (self._scene.with_absolute_names().to_toml(),)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of a view of the scene, in pixels."""
        return self._scene.size

    def decide(self, source: Source | None = None) -> Scene:
        """The scene with all that it leaves to the data (camera, ranges, brightness) as numbers.

        The frames of a film are drawn with what one of them decided, or they would flicker.

        Parameters
        ----------
        source : Snapshot or Particles, optional
            None: the scene's own snapshot.
        """
        check_pictures_of(self._scene)
        data = _core.snapshot_of(self._scene) if source is None else source._source
        return Scene._of(_core.decide(self._scene, data, None)[0], self._suggested)

    def frames(self) -> list[Scene]:
        """The scene at every frame of its path (docs/movies.md)."""
        return [Scene._of(scene) for scene in self._scene.frames()]

    def orbit(self, frames: int, degrees: float = 360) -> list[Scene]:
        """Scenes whose camera circles what it looks at.

        The scene needs a camera, as `suggest` and `decide` give it.
        """
        turning = self.copy()
        turning.update({"path.orbit.degrees": degrees, "movie.frames": frames})
        return turning.frames()

    def update(self, *others: Any, **keywords: Any) -> None:
        """Sets several keys at once: what excludes each other in between may be set together."""
        pairs: dict[str, Any] = dict(*others, **keywords)
        settings = [_toml.setting(key, value) for key, value in pairs.items()]
        self._change(settings)

    def __setitem__(self, key: str, value: Any) -> None:
        if value is None:
            raise UsageError(f"key {key}: found None, expected a value; `del scene[key]` unsets it")
        self._change([_toml.setting(key, value)])

    def __getitem__(self, key: str) -> Any:
        found = self._find(key)
        if found is None:
            self._require_known(key)
            return None
        table, name = found
        return copy.deepcopy(table[name])

    def __delitem__(self, key: str) -> None:
        tables = _toml.parse(self.to_toml())
        found = self._find(key, tables)
        if found is None:
            self._require_known(key)
            return
        table, name = found
        del table[name]
        settings = _settings_for_arrays(tables)
        self._scene = _core.parse_scene(_toml.document(tables), settings)

    def __iter__(self) -> Iterator[str]:
        return iter(_flat(_toml.parse(self.to_toml())))

    def __len__(self) -> int:
        return len(_flat(_toml.parse(self.to_toml())))

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and self._find(key) is not None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.to_toml() == other.to_toml()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"Scene.from_toml({self.to_toml()!r})"

    def __str__(self) -> str:
        return self.to_toml()

    # Each component's keys by its name and its number.
    def _ipython_key_completions_(self) -> list[str]:
        own = self._scene.component_names()
        names = [*filter(None, own), *(str(i) for i in range(len(own)))]
        keys = []
        for key in _core.scene_keys():
            table, _, rest = key.partition(".")
            of_components = [f"component.{name}.{rest}" for name in names]
            keys += of_components if table == "component" else [key]
        return keys

    # What it shows of the data, by words of settings that are no keys.
    def _showing(self, source: Source, settings: list[str]) -> tuple[Scene, list[str]]:
        with _unknown_keys():
            scene, notes, suggested = _core.show_scene(
                self._scene, self._suggested, source._source, settings
            )
        return Scene._of(scene, suggested), notes

    def _change(self, settings: list[str]) -> None:
        with _unknown_keys():
            self._scene = self._scene.with_settings(settings, self._suggested)

    # The table that holds the key, and its name there; tables of components by number or name.
    def _find(
        self, key: str, tables: dict[str, Any] | None = None
    ) -> tuple[Any, Any] | None:
        place: Any = _toml.parse(self.to_toml()) if tables is None else tables
        names = key.split(".")
        if names[0] == "component" and len(names) > 1:
            number, used = self._component(names[1:])
            place = place.get("component", [])
            names = [*names[1 + used :]] if number is not None else []
            if number is None or number >= len(place):
                return None
            if not names:
                return place, number
            place = place[number]
        for name in names[:-1]:
            place = place.get(name) if isinstance(place, dict) else None
            if place is None:
                return None
        return None if not isinstance(place, dict) else _named(place, names[-1])

    # Names of components may hold dots.
    def _component(self, words: list[str]) -> tuple[int | None, int]:
        known = self._scene.component_names()
        for used in range(len(words), 0, -1):
            name = ".".join(words[:used])
            if name in known:
                return known.index(name), used
        if words[0].isdecimal():
            return int(words[0]), 1
        return None, 1

    # Raises what setting the key raises where it does not exist, whatever its value.
    def _require_known(self, key: str) -> None:
        has_component = True
        if key.startswith("component."):
            number, _ = self._component(key.split(".")[1:])
            has_component = number is not None and number < len(self._scene.component_names())
        try:
            self._scene.with_settings([f"{key}=0"], None)
        except UsageError as error:
            if "an unknown key" in str(error) or not has_component:
                raise UnknownKey(str(error)) from None


# A formula is kept as the field that it stands for.
def _named(table: dict[str, Any], name: str) -> tuple[dict[str, Any], str] | None:
    if name == "formula" and _core.may_be_formula(str(table.get("field", ""))):
        name = "field"
    return (table, name) if name in table else None


def _toml_or_empty(text: str) -> dict[str, Any]:
    try:
        return _toml.parse(text)
    except ValueError:
        return {}  # the library says what is wrong


# A scene whose particles are the caller's needs no file of them.
def _settings_for_arrays(tables: Mapping[str, Any]) -> list[str]:
    time = tables.get("time")
    has_sequence = "time.snapshots" in tables or (isinstance(time, Mapping) and "snapshots" in time)
    return [] if "snapshot" in tables or has_sequence else [_FROM_ARRAYS]


# Settings change components; those that keys number after the given ones are to be there before.
def _add_numbered_components(tables: dict[str, Any], keys: Mapping[str, Any]) -> None:
    words = [key.split(".") for key in keys]
    numbers = {int(w[1]) for w in words if w[0] == "component" and w[1].isdecimal()}
    given = tables.get("component", [])
    added = 0
    while isinstance(given, Sequence) and len(given) + added in numbers:
        added += 1
    if added:
        tables["component"] = [*given, *({} for _ in range(added))]


@contextmanager
def _unknown_keys() -> Iterator[None]:
    try:
        yield
    except UsageError as error:
        if "an unknown key" in str(error):
            raise UnknownKey(str(error)) from None
        raise


def _flat(tables: Mapping[str, Any], before: str = "") -> list[str]:
    keys: list[str] = []
    for name, value in tables.items():
        if before == "" and name == "component":
            for number, component in enumerate(value):
                keys += _flat(component, f"component.{number}.")
        elif isinstance(value, Mapping):
            keys += _flat(value, f"{before}{name}.")
        else:
            keys.append(before + name)
    return keys
