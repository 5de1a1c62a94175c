"""The overview as one picture: for each estimator, how many times as long as the best it takes, a dot a problem."""

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from figures import INK, LINE, QUIET, picture
from findings import ALONE
from formats import decimals, figure as significant, power_of_ten

WIDTH, ROW, MARGIN = 3.5, 0.42, 0.22  # inches of 96 pixels
LEFT_OUT = ("sobol",)  # other points, and not another estimator: far to the left of all
FIRST = -1  # of the axis, where factors are below 1: what is less stands there too


def summary(overview, totals, names):
    """The columns of the overview but the last, the best on top; a diamond where the geometric mean is. None if no factor
    is known. names: of the columns before the techniques alone."""
    styles = {i["name"]: i["style"] for row in overview for i in row["problem"]["integrators"] if i["style"]}
    names = names + ALONE
    colors = [styles[name]["color"] if name in styles else QUIET for name in names]
    columns = list(zip(names, colors, zip(*(row["cells"] for row in overview)), totals["columns"]))
    columns = sorted((column for column in columns if column[3]["typical"] and column[0] not in LEFT_OUT),
                     key=lambda column: (column[3]["never"] > 0, column[3]["typical"]), reverse=True)
    if not columns:
        return None
    first = FIRST if any(0 < cell["factor"] < 0.9 for column in columns for cell in column[2]
                         if cell and cell["factor"]) else 0
    last = max(1, math.ceil(max(math.log10(column[3]["worst_finite"]) for column in columns) + 0.1))
    never = last + 0.06 * last + 0.35
    height = ROW * len(columns) + 0.42
    drawing, axes = plt.subplots(figsize=(WIDTH, height))
    drawing.subplots_adjust(left=MARGIN / WIDTH, right=1 - MARGIN / WIDTH, bottom=0.4 / height, top=1 - 0.02 / height)
    some_never = any(column[3]["never"] for column in columns)
    for y, (name, color, cells, total) in enumerate(columns):
        factors = [cell["factor"] for cell in cells if cell and cell["factor"]]
        x = np.array([max(math.log10(factor), first) if math.isfinite(factor) else never for factor in factors])
        axes.plot(x, np.full(len(x), y), "o", color=color, alpha=0.45, ms=5, mew=0, clip_on=False)
        axes.plot([max(math.log10(total["typical"]), first)], [y], "D", color=color, ms=7.5, mec=INK, mew=0.8)
        axes.text(first - 0.02 * last, y + 0.22, name, weight="bold", va="bottom", ha="left")
        axes.text(1, y + 0.22, f"typically {significant(total['typical'])} ×", color=QUIET, va="bottom", ha="right",
                  transform=axes.get_yaxis_transform())
    axes.set(xlim=(first - 0.04 * last, never + 0.2 if some_never else last), ylim=(-0.4, len(columns) - 0.2), yticks=[],
             xlabel="times the CPU time of the best, to the same error")
    if some_never:
        axes.axvline((last + never) / 2, color=LINE, lw=1, ls=(0, (3, 3)))
    step = math.ceil((last + 1) / 4)
    ticks = [first] * (first < 0) + list(range(0, last + 1, step))
    if some_never and ticks[-1] == last and never - last < last / 5:
        ticks.pop()
    axes.xaxis.set_major_locator(FixedLocator(ticks + [never] * some_never))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, position: "never" if x > last else factor_label(round(x))))
    axes.tick_params(length=0)
    axes.spines["left"].set_visible(False)
    axes.spines["right"].set_visible(False)
    return picture(drawing)


def factor_label(exponent):
    if exponent == FIRST:
        return "≤ 0.1"
    return decimals(10 ** exponent, 0) if exponent < 4 else power_of_ten(exponent)
