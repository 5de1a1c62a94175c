"""The near-mirror study as a figure: for each integrator its relative error over roughness and size of the light."""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm

STIFF = {"alphas": (list,), "solid_angles": (list,), "seconds": (int, float), "runs": (int,),
         "integrators": [{"name": (str,), "relative_error": (list,), "bias_z": (list,)}]}


def percent(error):
    """Two significant digits of a fraction as a percentage, without an exponent unless it is tiny."""
    if error is None:
        return "–"
    value = 100 * error
    if value < 1e-3:
        return f"{value:.0e}".replace("e-0", "e−")
    return f"{float(f'{value:.2g}'):g}"


def size(solid_angle):
    return "2π" if math.isclose(solid_angle, 2 * math.pi) else f"{solid_angle:g}"


def worst_errors(stiff):
    """Each integrator's name and its largest error in percent, the best first."""
    worst = {i["name"]: np.nanmax(np.array(i["relative_error"], dtype=float)) for i in stiff["integrators"]}
    return [(name, percent(error)) for name, error in sorted(worst.items(), key=lambda item: item[1])]


def plot_stiff(stiff, path, columns):
    """One heat map an integrator, all on one scale, with the errors in percent written into the cells."""
    integrators = stiff["integrators"]
    rows = math.ceil(len(integrators) / columns)
    figure, grid = plt.subplots(rows, columns, figsize=(3.7 * columns, 2.5 * rows), squeeze=False, layout="constrained")
    norm = LogNorm(1e-5, 1)
    for axes, integrator in zip(grid.flat, integrators):
        errors = np.array(integrator["relative_error"], dtype=float)
        axes.imshow(np.clip(errors, norm.vmin, norm.vmax), norm=norm, cmap="YlOrRd", aspect="auto")
        for (row, column), error in np.ndenumerate(errors):
            dark = error > 0.03
            axes.text(column, row, percent(error), ha="center", va="center", size=8, color="white" if dark else "#222222")
        worst = percent(np.nanmax(errors))
        axes.set_title(f"{integrator['name']}: worst {worst} %", loc="left")
        axes.set_xticks(range(errors.shape[1]), [size(s) for s in stiff["solid_angles"]])
        axes.set_yticks(range(errors.shape[0]), [f"{alpha:g}" for alpha in stiff["alphas"]])
        axes.set(xlabel="light (sr)", ylabel="roughness α")
        axes.grid(False)
        axes.tick_params(length=0)
    for axes in grid.flat[len(integrators):]:
        axes.remove()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)

