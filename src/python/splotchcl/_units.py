"""Units that arrays and numbers carry with them (unyt, swiftsimio, yt, pynbody, astropy). Known by
what they have, so that none of these packages is needed."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from types import MethodType
from typing import Any

from . import _core

# By which array libraries call the unit of an array.
_UNIT_ATTRIBUTES = ("units", "unit")
_NO_UNITS = ("", "NoUnit()", "dimensionless", "1.00e+00")
_CGS_BASES = ("cm", "g", "s", "K")
# The number that a unit begins with, "1000 kpc", and what joins it to the rest.
_FACTOR = re.compile(r"(\d[\d.]*(?:e[+-]?\d+)?)[ *]+(?=\S)")
# "kpc3", as astropy writes a power.
_POWER = re.compile(r"\b([A-Za-z_]+)(\d+)\b")


@dataclass(frozen=True)
class CarriedUnit:
    """A unit that came with values.

    Attributes
    ----------
    text : str
        As its package writes it, but with all digits, and comoving or physical where it says so.
    name : str
        As snapshots name units, so that maps can read it (docs/maps.md#units): where they do not
        know what it is called, in cgs. Where that is not known either, close to `text`.
    is_comoving : bool, optional
        None: it does not say.
    """

    text: str
    name: str
    is_comoving: bool | None = None


def unit_of(values: Any) -> CarriedUnit | None:
    """The unit that an array or a number carries; None where it has none."""
    for attribute in _UNIT_ATTRIBUTES:
        unit = getattr(values, attribute, None)
        # Units may be called, too: what is called to get one is a method.
        if unit is None or isinstance(unit, MethodType) or str(unit) in _NO_UNITS:
            continue
        text, name = _text_of(unit), _name_of(unit)
        is_comoving = getattr(values, "comoving", None)
        if is_comoving is None:
            return CarriedUnit(text, name)
        if not is_comoving:
            return CarriedUnit(f"{text} (physical)", name, False)
        return CarriedUnit(f"{text} (comoving)", name + _comoving_factor(values), True)
    return None


# As the text of the unit, but pynbody writes "3.09e+21 cm", and astropy 6 digits.
def _text_of(unit: Any) -> str:
    text = str(unit)
    factor = _FACTOR.match(text)
    convert = getattr(unit, "ratio", None) or getattr(unit, "to", None)
    if factor is None or convert is None:
        return text
    rest = text[factor.end() :]
    number = _or_none(lambda: float(convert(rest)))
    return text if number is None else f"{_shortest(number)} {rest}"


def _name_of(unit: Any) -> str:
    name = _snapshots_spelling(_text_of(unit))
    if _core.is_unit(name, ""):
        return name
    in_cgs = _or_none(lambda: _in_cgs(unit))
    return in_cgs if in_cgs is not None and _core.is_unit(in_cgs, "") else name


def _snapshots_spelling(text: str) -> str:
    text = text.replace("**", "^").replace("*", " ").replace("Msol", "Msun")
    text = _POWER.sub(r"\1^\2", text)
    factor = _FACTOR.match(text)
    return text if factor is None else f"{_shortest(float(factor[1]))} {text[factor.end() :]}"


# "1e10" for 10000000000.0, which is a part of what maps call their units.
def _shortest(number: float) -> str:
    plain = f"{number:.15g}"
    mantissa, exponent = f"{number:.14e}".split("e")
    scientific = f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"
    return plain if len(plain) <= 6 else min(plain, scientific, key=len)


# A number and powers of cm, g, s and K, by the unit's own conversion.
def _in_cgs(unit: Any) -> str | None:
    if hasattr(unit, "get_cgs_equivalent"):  # unyt, yt, swiftsimio
        base = unit.get_cgs_equivalent()
        if unit.base_offset != 0:
            return None
        factor, name = unit.base_value / base.base_value, _snapshots_spelling(str(base))
    elif hasattr(unit, "dimensional_project"):  # pynbody
        name = _product(_CGS_BASES, unit.dimensional_project(_CGS_BASES))
        factor = unit.ratio(name.replace("^", "**"))
    else:  # astropy
        base = unit.cgs
        factor, name = base.scale, _product(base.bases, base.powers)
    return name if factor == 1 else f"{_shortest(float(factor))} {name}"


def _product(bases: Iterable[Any], powers: Iterable[Any]) -> str:
    factors = [(base, float(power)) for base, power in zip(bases, powers) if power != 0]
    return " ".join(f"{base}" if power == 1 else f"{base}^{power:g}" for base, power in factors)


# " a^-3" for a comoving density of swiftsimio: files say so, too.
def _comoving_factor(values: Any) -> str:
    def find() -> str:
        expression = values.cosmo_factor.expr
        if not expression.free_symbols:
            return ""  # as masses are
        (scale_factor,) = expression.free_symbols
        power = float(expression.as_coeff_exponent(scale_factor)[1])
        return "" if power == 0 else " a" if power == 1 else f" a^{power:g}"

    found = _or_none(find)
    return " (comoving)" if found is None else found


def scale_factor_of(values: Any) -> float | None:
    """The scale factor of values of swiftsimio, which carry it; None of others."""
    factor = getattr(getattr(values, "cosmo_factor", None), "scale_factor", None)
    found = None if factor is None else _or_none(lambda: float(factor))
    return found if found is not None and found > 0 else None


# Each package has its own errors for a unit that it cannot convert.
def _or_none(find: Callable[[], Any]) -> Any:
    try:
        return find()
    except Exception:
        return None
