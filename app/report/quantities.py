"""Numbers and SI units as people read them."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}
# A prefix belongs to the first symbol of a unit, and only where that symbol is not raised to a power.
TAKES_PREFIX = re.compile(r"(Pa|N|J|W|B|m|s)(?=$|[ /*])")
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
THIN_SPACE = "\u2009"


@dataclass(frozen=True)
class Display:
    """How values of a unit are shown: value * factor, followed by `unit`."""

    factor: float
    unit: str


def pretty_unit(unit: str) -> str:
    """`kg/m^3` -> `kg/m³`."""
    return re.sub(r"\^(-?\d+)", lambda m: m[1].translate(SUPERSCRIPT), unit).replace("*", "·")


def display_for(unit: str, largest: float) -> Display:
    """The prefix that brings `largest` (SI) between 1 and 1000, for units that take one."""
    exponent = 0
    if TAKES_PREFIX.match(unit) and largest > 0 and math.isfinite(largest):
        exponent = 3 * math.floor(math.log10(largest * (1 + 1e-12)) / 3)
        highest = 0 if re.match(r"s($|[ /*])", unit) else 12  # kiloseconds are read by nobody
        exponent = min(max(exponent, -12), highest)
    return Display(10.0**-exponent, PREFIXES[exponent] + pretty_unit(unit))


def number(value: float, digits: int = 4) -> str:
    """Plain digits with a true minus sign."""
    return plain_number(value, digits).replace("-", "−")


def plain_number(value: float, digits: int) -> str:
    """`0.000238` -> `2.38 × 10⁻⁴`; ordinary sizes stay ordinary."""
    if isinstance(value, int) and abs(value) < 10**15:
        return f"{value:,}".replace(",", THIN_SPACE)
    text = f"{value:.{digits}g}"
    if value != 0 and abs(value) < 1e-2 and math.isfinite(value):
        text = f"{value:.{digits - 1}e}"
    if "e" not in text:
        return text
    mantissa, exponent = text.split("e")
    if "." in mantissa:
        mantissa = mantissa.rstrip("0").rstrip(".")
    return f"{mantissa} × 10{str(int(exponent)).translate(SUPERSCRIPT)}"


def quantity(value: float | None, unit: str, digits: int = 4) -> str:
    """A value in SI with its unit, prefixed: (0.001, 's') -> `1 ms`. JSON's null is named for what it stands for."""
    if value is None:
        return "not finite"
    shown = display_for(unit, abs(value))
    return f"{number(value * shown.factor if shown.factor != 1 else value, digits)} {shown.unit}".strip()


def described(entry: Any, digits: int = 4) -> str:
    """An entry of summary.json: a bare number (no unit), {"value", "unit"}, or a word."""
    if isinstance(entry, dict):
        return quantity(entry["value"], entry.get("unit", ""), digits)
    if entry is None:
        return "not finite"
    if isinstance(entry, bool) or not isinstance(entry, (int, float)):
        return str(entry)
    return number(entry, digits)


def words(name: str) -> str:
    """`mass_error` -> `mass error`."""
    return name.replace("_", " ")


def sentence(text: str) -> str:
    """With a capital first letter, the others as they are."""
    return text[:1].upper() + text[1:]
