"""Which particles are shown, by which field, and where: what render, suggest and movie take alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

from . import _toml
from ._arrays import as_number, is_number
from ._core import UsageError
from ._units import unit_of

if TYPE_CHECKING:
    from typing_extensions import Unpack


class Shown(TypedDict, total=False):
    """What may be shown of a scene or of particles, as the command line's options of these names say."""

    types: Sequence[str | int] | str | None
    where: Sequence[str] | str | None
    field: str | None
    palette: str | None
    center: Sequence[float | str] | str | None
    width: float | str | None


def shown_settings(**shown: Unpack[Shown]) -> list[str]:
    """These keywords as settings."""
    unknown = shown.keys() - Shown.__annotations__.keys()
    if unknown:
        raise TypeError(
            f"found the argument {min(unknown)!r}, expected one of {', '.join(Shown.__annotations__)}"
        )
    settings = []
    for name, value in shown.items():
        if name == "where" and isinstance(value, Sequence) and not isinstance(value, str):
            settings += [_setting(name, _text(name, one)) for one in value]
        elif value is not None:
            settings.append(_setting(name, _text(name, value)))
    return settings


def settings_of(keys: Mapping[str, Any], shown: Shown) -> list[str]:
    """Scene keys, and what is shown, as settings."""
    return [_toml.setting(key, value) for key, value in keys.items()] + shown_settings(**shown)


# In quotes nothing of it is taken for the end of a value.
def _setting(name: str, text: str) -> str:
    return f'{name}="{text}"'


def _text(name: str, value: Any) -> str:
    if isinstance(value, str):
        return value
    if name in ("center", "width") and is_number(value):
        return _length(name, value)
    is_list = hasattr(value, "__iter__") and name in ("types", "center")
    if not is_list and not (name == "types" and isinstance(value, int)):
        raise UsageError(f"{name}: found {value!r}, expected {_EXPECTED[name]}")
    if name == "types":
        return ",".join(map(str, value)) if is_list else str(value)
    return ",".join(one if isinstance(one, str) else _length(name, one) for one in value)


_EXPECTED = {
    "types": "names of particle types",
    "where": "a condition or several",
    "field": "the name of a field, or a formula",
    "palette": "the name of a palette, or of its file",
    "center": "three lengths, or text such as 'densest'",
    "width": "a length",
}


def _length(name: str, value: Any) -> str:
    unit = unit_of(value)
    return f"{as_number(name, value)!r} {'' if unit is None else unit.name}".strip()
