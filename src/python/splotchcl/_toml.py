"""Python's values as TOML, and back."""

from __future__ import annotations

import json
import math
import os
import sys
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._core import UsageError

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib


def parse(text: str) -> dict[str, Any]:
    """The tables of a TOML document."""
    return tomllib.loads(text)


def value(of: Any, key: str = "value") -> str:
    """A value as TOML writes it.

    Raises
    ------
    UsageError
        For what TOML has no word for.
    """
    if isinstance(of, np.ndarray | np.generic):
        of = of.tolist()
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, int):
        return str(of)
    if isinstance(of, float):
        if math.isfinite(of):
            return repr(of)
        return "nan" if math.isnan(of) else ("inf" if of > 0 else "-inf")
    if isinstance(of, os.PathLike):
        of = os.fspath(of)
    if isinstance(of, str):
        return json.dumps(of, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(of, Mapping):
        return "{" + ", ".join(f"{json.dumps(str(k))} = {value(v, key)}" for k, v in of.items()) + "}"
    if isinstance(of, Sequence):
        return "[" + ", ".join(value(v, key) for v in of) + "]"
    raise UsageError(
        f"key {key}: found {of!r}, expected a number, text, truth value, list or mapping"
    )


def setting(key: str, of: Any) -> str:
    """A scene key and its value, as settings are written."""
    return f"{key}={value(of, key)}"


def document(tables: Mapping[str, Any]) -> str:
    """A whole document; tables are written inline."""
    return "".join(f"{json.dumps(key)} = {value(of, key)}\n" for key, of in tables.items())
