"""From what users have to arrays that the library takes."""

from __future__ import annotations

from numbers import Real
from typing import Any

import numpy as np

from ._core import UsageError


def as_values(field: str, values: Any) -> tuple[np.ndarray[Any, Any], str | None]:
    """An array that the library takes, in C order, and a note where that took a copy.

    Parameters
    ----------
    field : str
        The field's name, for messages.
    values : array_like
        Numbers of shape (N,) or (N, 3).

    Raises
    ------
    UsageError
        For masked values, and for what is no array of real numbers.
    """
    try:
        given = values if isinstance(values, np.ndarray) else np.asarray(values)
    except ValueError as error:
        raise UsageError(f"field {field}: {error}, expected an array of numbers") from error
    plain = _unmasked(f"field {field}", given).view(np.ndarray)
    if plain.dtype.kind not in "fiub":
        raise UsageError(
            f"field {field}: values of dtype {plain.dtype}, expected real numbers"
        )
    if plain.ndim not in (1, 2) or (plain.ndim == 2 and plain.shape[1] not in (1, 3)):
        raise UsageError(
            f"field {field}: an array of shape {plain.shape}, expected (N,) or (N, 3) for N particles"
        )
    # What 32 bits cannot hold goes as doubles, from which the library subtracts the origin.
    is_narrow = plain.dtype.kind == "b" or np.can_cast(plain.dtype, np.float32, "safe")
    wanted = np.dtype(np.float32 if is_narrow else np.float64)
    # Nor do doubles hold all identifiers.
    if not is_narrow and plain.dtype.kind in "iu" and plain.shape[1:] in ((), (1,)):
        wanted = np.dtype(np.int64 if plain.dtype.kind == "i" else np.uint64)
    note = _copy_note(field, values, plain, wanted)
    if plain.dtype == wanted and plain.flags.c_contiguous and plain.flags.aligned:
        is_borrowed = wanted == np.float32 and isinstance(values, np.ndarray)
        return plain, None if is_borrowed else note
    return np.require(plain, wanted, ["C", "A"]), note


def is_number(value: Any) -> bool:
    """Whether it is a single number, with or without a unit."""
    return isinstance(value, Real) or (isinstance(value, np.ndarray) and value.ndim == 0)


def as_number(what: str, value: Any) -> float:
    """A single number, without its unit; `what` it is, for messages."""
    if isinstance(value, np.ndarray):
        value = _unmasked(what, value).view(np.ndarray)
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise UsageError(f"{what}: found {value!r}, expected a number") from error


# The values of numpy's and astropy's arrays with a mask, if that hides none of them.
def _unmasked(what: str, given: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    mask = getattr(given, "mask", None)
    # Elsewhere a method, or something else altogether.
    if not isinstance(mask, bool | np.bool_ | np.ndarray):
        return given
    masked = int(np.count_nonzero(mask))
    if masked > 0:
        raise UsageError(
            f"{what}: {masked} values are masked, expected none; leave these particles out of all "
            "fields, or fill the values"
        )
    if isinstance(given, np.ma.MaskedArray):
        return np.asarray(given.data)
    unmasked: np.ndarray[Any, Any] = getattr(given, "unmasked", given)
    return unmasked


def _copy_note(
    field: str, values: Any, given: np.ndarray[Any, Any], wanted: np.dtype[Any]
) -> str:
    reasons = []
    if not isinstance(values, np.ndarray):
        reasons.append(f"it is of the type {type(values).__name__}, not a numpy array")
    if given.dtype != np.float32:
        reasons.append(f"it has dtype {given.dtype.str}")
    if not given.flags.c_contiguous:
        reasons.append("it is not in C order")
    if not given.flags.aligned:
        reasons.append("it is not aligned in memory")
    kind = "whole numbers" if wanted.kind in "iu" else "32-bit floats"
    return f"field {field} was copied as {kind} ({', '.join(reasons)})"
