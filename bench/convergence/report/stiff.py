"""The near-mirror study as tables of colors: each integrator's relative error over roughness and size of the light."""

import math

from formats import figure, power_of_ten

LIMITS = (1e-3, 1e-2, 1e-1, 1)  # relative errors beyond which a cell has the next color
LEAST = 1e-5  # and the least that is told apart


def heat_maps(stiff):
    """One for each integrator, the best first."""
    maps = []
    for integrator in stiff["integrators"]:
        counts = integrator["not_finite"] or [[0] * len(row) for row in integrator["relative_error"]]
        rows = [[cell(*both) for both in zip(*row)] for row in zip(integrator["relative_error"], counts)]
        errors = [error for row in integrator["relative_error"] for error in row]
        maps.append({"name": integrator["name"], "rows": list(zip((f"{alpha:g}" for alpha in stiff["alphas"]), rows)),
                     "worst": None if None in errors else max(errors), "not_finite": sum(map(sum, counts))})
    return sorted(maps, key=lambda one: (one["worst"] is None, one["worst"]))


def cell(error, not_finite):
    """Its text in percent, and its color: from 0 (none) to 4."""
    if error is None:
        return {"text": "not finite" if not_finite else "–", "level": 4 if not_finite else 0}
    return {"text": figure(100 * error) if error >= LEAST else f"<{figure(100 * LEAST, 1)}",
            "level": sum(error > limit for limit in LIMITS)}


def size(solid_angle):
    """Of a light, in steradians."""
    if math.isclose(solid_angle, 2 * math.pi):
        return "2π"
    exponent = round(math.log10(solid_angle))
    return power_of_ten(exponent) if exponent < -2 and math.isclose(solid_angle, 10.0 ** exponent) else f"{solid_angle:g}"
