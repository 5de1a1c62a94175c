#!/usr/bin/env python3
"""Makes the polynomials of lumis/core/elementary.hpp, and checks that the header has them.

Each is minimax in relative error: of all polynomials of its degree, the one whose largest |polynomial / function - 1| over
the range is least. Remez's exchange algorithm (1934) finds it in 60 digits.

    remez.py             prints the coefficients, as the header has them, and their errors
    remez.py HEADER      compares those in the header; fails if one differs by more than a unit in its last digit

Needs mpmath (python3-mpmath).
"""

import re
import sys

from mpmath import asin, atan, cos, lu_solve, matrix, mp, mpf, pi, sin, sqrt, tan

mp.dps = 60


# The functions of x, the square of the argument; each has its limit at 0.


def sine(x):
    """sin(2 pi a) / a"""
    a = sqrt(x)
    return sin(2 * pi * a) / a if a else 2 * pi


def cosine(x):
    """cos(2 pi a) / (1 - 16 a^2), whose zeros at a = 1/4 cancel"""
    rest = 1 - 16 * x
    return cos(2 * pi * sqrt(x)) / rest if rest else pi / 4


def arc_tangent(x):
    """atan(t) / (2 pi t)"""
    t = sqrt(x)
    return atan(t) / (2 * pi * t) if t else 1 / (2 * pi)


def arc_sine(x):
    """asin(t) / t"""
    t = sqrt(x)
    return asin(t) / t if t else mpf(1)


# Name, function, the largest argument in float and in double.
POLYNOMIALS = [
    ("sine", sine, mpf(1) / 4, mpf(1) / 4),
    ("cosine", cosine, mpf(1) / 4, mpf(1) / 4),
    ("arc_tangent", arc_tangent, mpf(1), tan(pi / 8)),
    ("arc_sine", arc_sine, mpf(1) / 2, mpf(1) / 2),
]


def value(coefficients, x):
    result = mpf(0)
    for c in reversed(coefficients):
        result = result * x + c
    return result


def relative_error(coefficients, f, x):
    return value(coefficients, x) / f(x) - 1


def extremum(g, a, b):
    """The place between a and b where |g|, which has one maximum there, is largest: golden section."""
    golden = (sqrt(mpf(5)) - 1) / 2
    c, d = b - golden * (b - a), a + golden * (b - a)
    gc, gd = abs(g(c)), abs(g(d))
    for _ in range(60):
        if gc > gd:
            b, d, gd = d, c, gc
            c = b - golden * (b - a)
            gc = abs(g(c))
        else:
            a, c, gc = c, d, gd
            d = a + golden * (b - a)
            gd = abs(g(d))
    return (a + b) / 2


def remez(f, end, number):
    """`number` coefficients over [0, end], and the error that they reach at number + 1 points with alternating signs."""
    points = [end * (1 - cos(pi * i / number)) / 2 for i in range(number + 1)]
    for _ in range(30):
        # Coefficients and error e with polynomial(x) - f(x) = (-1)^i e f(x) at the points.
        rows = [[x**k for k in range(number)] + [-((-1) ** i) * f(x)] for i, x in enumerate(points)]
        solution = lu_solve(matrix(rows), matrix([f(x) for x in points]))
        coefficients, levelled = list(solution)[:number], abs(solution[number])
        g = lambda x: relative_error(coefficients, f, x)
        # The error's extrema lie between its zeros, one between two points each; the ends of the range are extrema.
        inner = [extremum(g, points[i - 1], points[i + 1]) for i in range(1, number)]
        points = [mpf(0)] + inner + [end]
        largest = max(abs(g(x)) for x in points)
        if largest <= levelled * (1 + mpf(10) ** -6):
            break
    return coefficients, largest


def largest_error(coefficients, f, end, steps=2000):
    """Over a grid that is dense at both ends, where minimax errors have their extrema."""
    return max(abs(relative_error(coefficients, f, end * (1 - cos(pi * i / steps)) / 2)) for i in range(steps + 1))


def coefficients_in(header, scalar, name):
    text = header[header.index(f"struct Minimax<{scalar}>"):]
    listed = re.search(rf"std::array {name}\{{([^}}]*)\}}", text).group(1)
    return [mpf(number.strip().rstrip("f")) for number in listed.split(",")]


def main():
    header = open(sys.argv[1]).read() if len(sys.argv) > 1 else None
    numbers = {"float": (5, 5, 10, 6), "double": (9, 9, 13, 14)}
    failed = False
    for scalar, digits in (("float", 12), ("double", 20)):
        for (name, f, *ends), number in zip(POLYNOMIALS, numbers[scalar]):
            end = ends[scalar == "double"] ** 2
            best, error = remez(f, end, number)
            if header is None:
                suffix = "f" if scalar == "float" else ""
                listed = ", ".join(mp.nstr(c, digits) + suffix for c in best)
                print(f"// {f.__doc__}, for {scalar}: {mp.nstr(error, 2)}")
                print(f"static constexpr std::array {name}{{{listed}}};")
                continue
            listed = coefficients_in(header, scalar, name)
            unit = mpf(10) ** (1 - digits)
            same = len(listed) == number and all(abs(a / b - 1) <= unit for a, b in zip(listed, best))
            failed = failed or not same
            reached = mp.nstr(largest_error(listed, f, end), 3)
            print(f"{scalar} {name}: {'the same' if same else 'OTHERS'}, error {reached}, of all digits {mp.nstr(error, 3)}")
    return failed


if __name__ == "__main__":
    sys.exit(main())
