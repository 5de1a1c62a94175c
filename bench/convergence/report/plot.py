"""Error against CPU time: one line for each estimator, with its confidence band."""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from figures import QUIET, picture
from formats import decimals, figure as significant, power_of_ten

KEYS = ("cpu_seconds", "relative_rmse", "relative_rmse_low", "relative_rmse_high")
SIZE = (3.5, 3.1)  # inches of 96 pixels


def plot(problem):
    """The figure of the estimators that it has room for; their names stand beside it on the page."""
    figure, axes = plt.subplots(figsize=SIZE)
    figure.subplots_adjust(left=0.68 / SIZE[0], right=1 - 0.62 / SIZE[0], bottom=0.5 / SIZE[1], top=1 - 0.32 / SIZE[1])
    axes.set(xscale="log", yscale="log", xlabel="CPU time")
    axes.text(0, 1.02, "relative RMSE", color=QUIET, transform=axes.transAxes, ha="left", va="bottom")
    axes.text(1, 1.02, "relative MSE", color=QUIET, transform=axes.transAxes, ha="right", va="bottom")
    drawn = [draw(axes, integrator) for integrator in problem["integrators"] if integrator["headline"]]
    if points := [line for line in drawn if line is not None]:
        guide(axes, np.concatenate(points), problem["reference"])
    else:
        axes.text(0.5, 0.5, "no error is known", color=QUIET, transform=axes.transAxes, ha="center", va="center")
    format_axes(axes)
    return picture(figure)


def draw(axes, integrator):
    """Its line and band; the points, or None if none can be drawn."""
    points = np.array([[point[key] for key in KEYS] for point in integrator["points"]], dtype=float)
    points = points[(points[:, 0] > 0) & (points[:, 1] > 0)]
    if not len(points):
        return None
    time, error, low, high = points.T
    color = integrator["style"]["color"]
    axes.fill_between(time, np.where(low > 0, low, error), np.where(high > 0, high, error), color=color, alpha=0.17, lw=0)
    axes.plot(time, error, color=color, marker=integrator["style"]["marker"],
              ls="-" if integrator["unbiased"] else (0, (4, 2)))
    return points


def guide(axes, points, reference):
    """The slope that every unbiased estimator of finite variance follows, and the limits that leave room for it."""
    time, error = points[:, 0], points[:, 1]
    wider = max(1.3, math.sqrt(7 * time.min() / time.max()))  # room for two labels of time at least
    span = np.array([time.min() / wider, time.max() * wider])
    below = 0.6 * np.min(error * np.sqrt(time)) / np.sqrt(span)
    bottom = max(min(error.min(), below[1]) / 1.5, error.max() / 1e9)
    axes.plot(span, below, color=QUIET, ls=":", lw=1.3)
    axes.set(xlim=span, ylim=(bottom, min(1.3 * np.nanmax(points[:, [1, 3]]), 20 * error.max())))
    own_error = math.sqrt(max(reference["relative_mse"] or 0, 0))
    if axes.get_ylim()[0] < own_error < axes.get_ylim()[1]:
        axes.axhline(own_error, color=QUIET, lw=0.8, ls=(0, (6, 3)))
        axes.annotate("the reference’s own error", (0.02, own_error), (0, 3), color=QUIET, va="bottom",
                      xycoords=("axes fraction", "data"), textcoords="offset points")


def format_axes(axes):
    """Time below, relative RMSE on the left, and its square on the right."""
    squared = axes.secondary_yaxis("right", functions=(np.square, np.sqrt))
    squared.tick_params(length=2)
    squared.grid(False)
    axes.spines["right"].set_visible(False)
    for axis, write in ((axes.xaxis, time_label), (axes.yaxis, percentage), (squared.yaxis, square)):
        low, high = axis.get_view_interval()
        if axis is squared.yaxis:
            low, high = np.square(axes.get_ylim())
        span = math.log10(high / low)
        axis.set_major_locator(LogLocator(subs=subdivisions(span, axis is axes.xaxis), numticks=8))
        axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99 if span < 5 else 1))
        axis.set_major_formatter(FuncFormatter(write))
        axis.set_minor_formatter(NullFormatter())


def subdivisions(decades, has_wide_labels):
    """Which multiples of a power of ten are labelled, so that there are two labels at least, and room for each."""
    if decades > 1.6:
        return (1,)
    return (1, 3) if has_wide_labels and decades > 1 else (1, 2, 5)


def time_label(seconds, position=None):
    unit, size = next((pair for pair in (("s", 1), ("ms", 1e-3), ("µs", 1e-6)) if seconds > 0.99 * pair[1]), ("ns", 1e-9))
    return f"{seconds / size:,.6g} {unit}"


def percentage(error, position=None):
    return f"{100 * error:,.6g} %" if 9e-6 < error < 90 else square(error)


def square(error, position=None):
    exponent = round(math.log10(error))
    if math.isclose(error, 10.0 ** exponent):
        return power_of_ten(exponent)
    return significant(error) if error > 0.009 else f"{decimals(error / 10.0 ** math.floor(math.log10(error)), 0)}·" \
        + power_of_ten(math.floor(math.log10(error)))
