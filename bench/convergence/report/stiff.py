"""The near-mirror study as figures: for each integrator its relative error over roughness and size of the light."""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

from figures import picture
from formats import percent

SIZE = (3.7, 2.4)  # inches of 96 pixels
SCALE = LogNorm(1e-5, 1)


def heat_maps(stiff):
    """One for each integrator, the best first, all on one scale, with the errors written into the cells."""
    maps = []
    for integrator in stiff["integrators"]:
        errors = np.array(integrator["relative_error"], dtype=float)
        worst = max(errors[np.isfinite(errors)], default=None)
        maps.append({"name": integrator["name"], "worst": worst, "picture": heat_map(errors, stiff)})
    return sorted(maps, key=lambda one: (one["worst"] is None, one["worst"]))


def heat_map(errors, stiff):
    figure, axes = plt.subplots(figsize=SIZE)
    figure.subplots_adjust(left=0.62 / SIZE[0], right=1 - 0.04 / SIZE[0], bottom=0.46 / SIZE[1], top=1 - 0.04 / SIZE[1])
    axes.imshow(np.clip(errors, SCALE.vmin, SCALE.vmax), norm=SCALE, cmap="YlOrRd", aspect="auto")
    for (row, column), error in np.ndenumerate(errors):
        axes.text(column, row, percent(None if math.isnan(error) else error), ha="center", va="center", size=8,
                  color="white" if error > 0.03 else "black")
    axes.set_xticks(range(errors.shape[1]), [size(s) for s in stiff["solid_angles"]])
    axes.set_yticks(range(errors.shape[0]), [f"{alpha:g}" for alpha in stiff["alphas"]])
    axes.set(xlabel="light (sr)", ylabel="roughness α")
    axes.grid(False)
    axes.tick_params(length=0)
    return picture(figure)


def size(solid_angle):
    return "2π" if math.isclose(solid_angle, 2 * math.pi) else f"{solid_angle:g}"
