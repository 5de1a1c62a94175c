"""Numbers as text, with the digits that mean something."""

import math
import re

UNITS = (("ns", 1e-9), ("µs", 1e-6), ("ms", 1e-3), ("s", 1), ("min", 60), ("h", 3600), ("days", 86400),
         ("years", 365.25 * 86400))
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def power_of_ten(exponent):
    return "10" + str(exponent).translate(SUPERSCRIPTS)


def magnitude(value):
    """The exponent of ten of `value`, which is 0 for 0."""
    return math.floor(math.log10(abs(value))) if value else 0


def decimals(value, places):
    return f"{value:,.{max(0, places)}f}".replace("-", "−")


def figure(value, digits=2):
    """With so many significant digits, a power of ten only where plain decimals would be long: 0.83, 140, 3.2 × 10⁻⁷."""
    if value is None:
        return "–"
    value = float(f"{value:.{digits}g}") + 0.0  # no -0
    scale = magnitude(value)
    if -4 <= scale < 7:
        return decimals(value, digits - 1 - scale if value else 0)
    return f"{decimals(value / 10.0 ** scale, digits - 1)} × {power_of_ten(scale)}"


def with_error(value, error):
    """`value` and "± error": the error to one digit, or two if it begins with 1, and the value as far."""
    if value is None or not error:
        return figure(value), ""
    scale = max(magnitude(value), magnitude(error)) if value else magnitude(error)
    plain = -4 <= scale < 7
    factor = 1 if plain else 10.0 ** scale
    value, error = value / factor, error / factor
    digit, exponent = f"{error:.0e}".split("e")
    places = (1 if digit == "1" else 0) - int(exponent)
    parts = decimals(round(value, places), places), f"± {decimals(round(error, places), places)}"
    return parts if plain else (f"({parts[0]}", f"{parts[1]}) × {power_of_ten(scale)}")


def duration(seconds):
    """Two significant digits in the largest unit of which there is at least one: 51 ns, 6.1 h."""
    if seconds is None:
        return "–"
    rounded = float(f"{seconds:.2g}")
    unit, size = max((unit for unit in UNITS if unit[1] <= rounded), key=lambda unit: unit[1], default=UNITS[0])
    return f"{figure(seconds / size)}\u00a0{unit}"


def percent(fraction):
    """Two significant digits of a fraction as a percentage."""
    return figure(fraction if fraction is None else 100 * fraction) + ("" if fraction is None else "\u00a0%")


def spread_place(ratio):
    """Where a ratio stands on a line 80 long, logarithmic from 1/4 to 4."""
    return round(40 + 40 * max(-1, min(1, math.log(ratio, 4))), 1) if ratio > 0 else 0


def count(number):
    return "–" if number is None else f"{number:,}"


def sortable(value):
    """What a column is sorted by; empty if there is no value."""
    return "" if value is None else f"{value:.6g}" if isinstance(value, float) else str(value)


def listed(items):
    """The items as a phrase: a, b and c."""
    items = list(items)
    return " and ".join(filter(None, (", ".join(items[:-1]), *items[-1:])))


def compact(type_name):
    """Equal arguments of a type in a row as a number of them: A<5 × B>."""
    return re.sub(r"(\w+(?:<[^<>]*>)?)((?:, \1)+)(?=[,>])",
                  lambda run: f"{1 + run[2].count(', ' + run[1])} × {run[1]}", type_name)
