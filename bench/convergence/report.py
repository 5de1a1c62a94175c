"""Turn the results of `convergence` into a page: python3 report.py <folder>/results.json

Writes <folder>/error_<problem>.svg, <folder>/stiff.svg and <folder>/index.html; SCHEMA.md describes the input.
"""

import argparse
import json
import math
import re
import sys
from pathlib import Path

import jinja2
import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.markers import MarkerStyle
from matplotlib.ticker import FuncFormatter, LogFormatterSciNotation, LogLocator, NullFormatter

from stiff import STIFF, plot_stiff, worst_errors

SHOWN_GROUPS = ("scenes", "one-dimensional")
SINGLE_STRATEGIES = ("bsdf", "light")
COLORS = ("#0072b2", "#d55e00", "#009e73", "#222222", "#cc79a7", "#e69f00", "#56b4e9")  # Okabe and Ito (2008)
MARKERS = "osD^vPX*<>ph"
SIZES = {"": (7.4, 4.7), "_narrow": (3.7, 4.3)}  # inches of 96 pixels: for a desk and for a phone
STYLE = {
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "axes.grid": True, "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6, "axes.axisbelow": True, "axes.edgecolor": "#999999", "axes.linewidth": 0.8,
    "axes.spines.top": False, "axes.spines.right": False, "xtick.color": "#444444", "ytick.color": "#444444",
    "lines.linewidth": 1.6, "lines.markersize": 5, "svg.fonttype": "path", "svg.hashsalt": "lumis"}
Z95 = 1.96

TEXT, COUNT, NUMBER, NAME = (str,), (int,), (int, float, type(None)), (str, type(None))
POINT = {"samples": COUNT} | dict.fromkeys((
    "cpu_seconds", "cpu_seconds_standard_error", "wall_seconds", "rmse", "rmse_standard_error", "relative_mse",
    "relative_mse_standard_error"), NUMBER)
INTEGRATOR = {"name": TEXT, "unbiased": (bool,), "headline": (bool,), "points": [POINT], "slope": NUMBER, "slope_standard_error": NUMBER,
              "efficiency_relative_to_power": NUMBER, "efficiency_standard_error": NUMBER, "image?": NAME,
              "error_image?": NAME, "image_spp?": NUMBER, "image_seconds?": NUMBER, "fireflies?": NUMBER}
PROBLEM = {"name": TEXT, "group": TEXT, "title": TEXT, "kind": TEXT, "description": TEXT, "strategies": (list,), "width?": COUNT,
           "height?": COUNT, "integrators": [INTEGRATOR],
           "runs": COUNT,
           "reference": {"source": TEXT, "value?": NUMBER, "rmse": NUMBER, "relative_mse": NUMBER, "image?": NAME}}
RESULTS = {"machine": dict.fromkeys(("cpu", "threads", "compiler", "flags", "date"), (str, int)),
           "settings": {"seeds": [COUNT]}, "problems": [PROBLEM], "stiff": STIFF}

STABILITY_ROW = {"kernel": TEXT, "case": TEXT, "scalar": TEXT, "reference": TEXT, "evaluations": COUNT,
                 "misbehaved": COUNT, "has_error": (bool,), "has_usual": (bool,), "has_z": (bool,), "passed": (bool,)} | dict.fromkeys((
                     "worst_error", "error_limit", "usual_error", "worst_z", "z_limit", "standard_error"), NUMBER)


# Load

def load(path):
    """The results in `path`, which have every key and every image that the page needs, or a ValueError."""
    results = json.loads(path.read_text(encoding="utf-8"), parse_constant=lambda not_finite: None)
    if not isinstance(results, dict) or results.get("schema") != 1:
        raise ValueError("not convergence results of schema 1")
    check(results, RESULTS)
    # So far the page has room for these; the figures of all are in the file.
    results["problems"] = [problem for problem in results["problems"] if problem["group"] in SHOWN_GROUPS]
    for problem in results["problems"]:
        problem["integrators"] = [integrator for integrator in problem["integrators"] if integrator["headline"]]
    names = [problem["name"] for problem in results["problems"]]
    for problem in results["problems"]:
        name, kind = problem["name"], problem["kind"]
        if not re.fullmatch(r"[\w-]+", name) or names.count(name) > 1:
            raise ValueError(f"the problem name '{name}' is used twice or is not a name for a file")
        if kind != "integral" and (kind != "render" or not problem.get("width") or not problem.get("height")):
            raise ValueError(f"problem {name} is neither an 'integral' nor a 'render' of known width and height")
        for owner in (problem["reference"], *problem["integrators"]):
            for image in filter(None, (owner.get("image"), owner.get("error_image"))):
                if Path(image).is_absolute() or not (path.parent / image).is_file():
                    raise ValueError(f"problem {name}: the image '{image}' is not in the folder of the results")
    results["stability"] = load_stability(path.with_name("stability.json"))
    return results


def load_stability(path):
    """The table of extreme cases, or None if the program `stability` has not written it."""
    if not path.is_file():
        return None
    stability = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(stability, dict) or stability.get("schema") != 1:
        raise ValueError(f"{path.name} is not a table of extreme cases of schema 1")
    check(stability, {"quick": (bool,), "rows": [STABILITY_ROW]}, path.name)
    return stability


def check(value, shape, where=""):
    """A dict is an object whose keys are needed unless they end in ?, a list a non-empty array, a tuple the types."""
    kinds = shape if isinstance(shape, tuple) else (type(shape),)
    if not isinstance(value, kinds):
        expected = " or ".join("null" if kind is type(None) else kind.__name__ for kind in kinds)
        raise ValueError(f"{where} is {json.dumps(value)[:40]}, expected {expected}")
    if value == [] and isinstance(shape, list):
        raise ValueError(f"{where} is empty")
    for index, item in enumerate(value if isinstance(shape, list) else ()):
        check(item, shape[0], f"{where}[{index}]")
    for key, inner in shape.items() if isinstance(shape, dict) else ():
        name = key.rstrip("?")
        if name in value:
            check(value[name], inner, f"{where}.{name}".lstrip("."))
        elif name == key:
            raise ValueError(f"{where}.{name} is missing".lstrip("."))


# Derive

def derive(results):
    """Add to each problem what the page says about it; return what it says about all scenes."""
    styles = choose_styles(results["problems"])
    for problem in results["problems"]:
        integrators = problem["integrators"]
        for integrator in integrators:
            integrator["style"] = styles[integrator["name"]]
            integrator["efficiency"] = integrator["efficiency_relative_to_power"]
            integrator.update(integrator["points"][-1])  # the table shows the longest run, the plot shows all
        ones = [i["name"] for i in integrators if i["name"] == "power"] + [
            i["name"] for i in integrators if i["efficiency"] == 1]
        problem["baseline"] = ones[0] if ones else None  # whose efficiency is 1 by definition
        problem["ranking"] = sorted(integrators, key=lambda i: (not i["unbiased"], -(i["efficiency"] or 0)))
        best = problem["ranking"][0]["efficiency"] or math.inf
        for integrator in integrators:
            integrator["bar"] = min(max((integrator["efficiency"] or 0) / best, 0), 1)
        problem["leaders"] = find_leaders(problem["ranking"])
        problem["comparisons"] = compare(problem)
    return summarize([problem for problem in results["problems"] if problem["kind"] == "render"])


def choose_styles(problems):
    """One marker for each integrator, and a color that no other integrator of the same problem has."""
    styles = {}
    companies = [[integrator["name"] for integrator in problem["integrators"]] for problem in problems]
    for name in dict.fromkeys(sum(companies, [])):
        companions = {other for company in companies if name in company for other in company}
        near = [style["color"] for other, style in styles.items() if other in companions]
        used = [style["color"] for style in styles.values()]
        color = min(COLORS, key=lambda color: (near.count(color), used.count(color)))
        styles[name] = {"color": color, "marker": MARKERS[len(styles) % len(MARKERS)]}
    return styles


def find_leaders(ranking):
    """The most efficient unbiased integrator, and those that are not significantly less efficient."""
    able = [i for i in ranking if i["unbiased"] and (i["efficiency"] or 0) > 0]
    error = {i["name"]: i["efficiency_standard_error"] or 0 for i in able}
    return [i["name"] for i in able if able[0]["efficiency"] - i["efficiency"]
            <= Z95 * math.hypot(error[i["name"]], error[able[0]["name"]])]


def compare(problem):
    """How many times as efficient as the others the baseline is; in a render, as each strategy alone."""
    render, comparisons = problem["kind"] == "render", []
    for other in problem["integrators"]:
        efficiency, wanted = other["efficiency"] or 0, not render or other["name"] in SINGLE_STRATEGIES
        if wanted and other["unbiased"] and other["name"] != problem["baseline"] and efficiency > 0:
            relative_error = (other["efficiency_standard_error"] or 0) / efficiency
            comparisons.append({"name": other["name"], "alone": render, "factor": 1 / efficiency,
                                "significant": abs(math.log(efficiency)) > Z95 * relative_error})
    return comparisons


def summarize(scenes):
    scenes = [scene for scene in scenes if scene["baseline"] == "power" and scene["comparisons"]]
    fireflies = {}
    for integrator in (i for scene in scenes for i in scene["integrators"] if i.get("fireflies") is not None):
        fireflies[integrator["name"]] = fireflies.get(integrator["name"], 0) + integrator["fireflies"]
    return {"factors": [min(other["factor"] for other in scene["comparisons"]) for scene in scenes],
            "fireflies": fireflies}


# Plot

def plot(problem, path, size):
    """Relative error against CPU seconds with 95 % bands; every line is named at its right end."""
    figure, axes = plt.subplots(figsize=size)
    figure.subplots_adjust(left=0.68 / size[0], right=1 - 1.18 / size[0], bottom=0.55 / size[1], top=1 - 0.34 / size[1])
    axes.set(xscale="log", yscale="log", xlabel="CPU seconds")
    axes.set_title("Relative error (root of the relative mean square error)", loc="left")
    ends, curves, constants = [], [], []
    for integrator in problem["integrators"]:
        time, mse, error = (np.array([point[key] for point in integrator["points"]], dtype=float)
                            for key in ("cpu_seconds", "relative_mse", "relative_mse_standard_error"))
        shown = (time > 0) & (mse > 0)
        if not shown.any():
            continue
        time, rmse = time[shown], np.sqrt(mse[shown])
        error = Z95 * np.nan_to_num(error[shown]) / (2 * rmse)
        color, unbiased = integrator["style"]["color"], integrator["unbiased"]
        axes.fill_between(time, np.maximum(rmse - error, 1e-3 * rmse), rmse + error, color=color, alpha=0.16, lw=0)
        axes.plot(time, rmse, color=color, marker=integrator["style"]["marker"], ls="-" if unbiased else (0, (4, 2)))
        ends.append((time[-1], rmse[-1], color, integrator["name"] + ("" if unbiased else "\n(biased)")))
        curves.append((time, rmse, np.minimum(error, rmse)))
        constants += [np.min(rmse * np.sqrt(time))] if unbiased else []
    if curves:
        time, rmse, error = (np.concatenate(parts) for parts in zip(*curves))
        span = np.array([time.min() / 1.25, time.max() * 1.25])
        guide = 0.6 * min(constants, default=np.min(rmse * np.sqrt(time))) / np.sqrt(span)
        axes.plot(span, guide, color="#777777", ls=":", lw=1.2)
        ends.append((span[1], guide[1], "#777777", "slope −1/2"))
        axes.set(xlim=span, ylim=(min(rmse.min(), guide[1]) / 1.6, 1.5 * np.max(rmse + error)))
    reference_error = math.sqrt(max(problem["reference"]["relative_mse"] or 0, 0))
    if axes.get_ylim()[0] < reference_error < axes.get_ylim()[1]:
        axes.axhline(reference_error, color="#777777", lw=0.8, ls=(0, (6, 3)))
        axes.annotate("the reference’s own error", (0.02, reference_error), (0, -3), color="#555555",
                      size=8, va="top", xycoords=("axes fraction", "data"), textcoords="offset points")
    for axis in (axes.xaxis, axes.yaxis):
        format_axis(axis)
    name_lines(axes, ends, gap=0.18 / size[1])
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


def format_axis(axis):
    """Ticks at decades, or at 1, 2 and 5 on a short axis; plain decimals unless one of them would be long."""
    low, high = axis.get_view_interval()
    decades = math.log10(high / low)
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if decades < 1.6 else (1,), numticks=9))
    axis.set_minor_locator(LogLocator(subs=range(2, 10), numticks=99 if decades < 7 else 1))
    axis.set_minor_formatter(NullFormatter())
    if low > 9e-5 and high < 2e4:
        axis.set_major_formatter(FuncFormatter(lambda x, position: f"{x:.10g}"))
    else:
        axis.set_major_formatter(LogFormatterSciNotation(labelOnlyBase=False, minor_thresholds=(9, 9)))


def name_lines(axes, ends, gap):
    """Write each name beside the end of its line, moved just far enough that no two overlap."""
    ends.sort(key=lambda end: end[1])
    to_axes = (axes.transData + axes.transAxes.inverted()).transform
    lines = np.array([1 + end[3].count("\n") for end in ends])
    stacked = gap * (np.cumsum(lines) - lines / 2)  # their heights if they stood on each other without a hole
    free = np.array([to_axes(end[:2])[1] for end in ends]) - stacked
    heights = stacked + (np.maximum.accumulate(free) + np.minimum.accumulate(free[::-1])[::-1]) / 2
    for (x, y, color, name), height in zip(ends, heights + max(0, -min(heights, default=0))):
        axes.annotate(name, (x, y), (1.06, height), va="center", color="#222222", textcoords="axes fraction",
                      annotation_clip=False, arrowprops={"arrowstyle": "-", "color": color, "lw": 0.8, "shrinkA": 1})


# Render

def column_power(values):
    """The power of ten, a multiple of 3, that a column of very small or very large numbers is written in."""
    logs = [math.log10(abs(value)) for value in values if value]
    power = 3 * round(sum(logs) / len(logs) / 3) if logs else 0
    return power if power < 0 or power > 6 else 0


def quantity(value, error=None, power=0):
    """`value / 10^power` and its error, as text with the digits that the error leaves sensible."""
    value, error = value / 10.0 ** power, error and error / 10.0 ** power
    scale = math.floor(math.log10(abs(value))) if value else 0
    digits = min(3, max(1, 1 + scale - math.floor(math.log10(error)))) if error else 2
    texts = (None if x is None else f"{x:,.{max(0, digits - scale)}f}" if x else "0" for x in (value, error))
    return [text and text.replace("-", "−") for text in texts]


def factor(value):
    """Two significant figures without an exponent: 0.83, 3.1, 140."""
    return f"{float(f'{value:.2g}'):,.10g}"


def tiny(value):
    """An error as text, as short as it gets: 0, 0.036, 3.2e−7, 5.1e10."""
    text = "not finite" if value is None else f"{value:.2g}"
    return re.sub("e([+-])0?", lambda sign: "e" + sign[1].strip("+"), text).replace("-", "−")


def marker_points(marker):
    """The marker of the plot as the points of an SVG polygon in [-1, 1]²."""
    style = MarkerStyle(marker)
    polygon = style.get_path().transformed(style.get_transform()).to_polygons()[0]
    return " ".join(f"{x:.2f},{-y:.2f}" for x, y in polygon / np.abs(polygon).max())


def render(results, summary, results_name):
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True,
                                     trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    filters = (column_power, quantity, factor, tiny, marker_points)
    environment.filters |= {function.__name__: function for function in filters}
    pixels = {suffix: [round(96 * inches) for inches in size] for suffix, size in SIZES.items()}
    return environment.get_template("report.html.jinja").render(
        **results, summary=summary, stiff_worst=worst_errors(results["stiff"]), results_name=results_name, plot_size=pixels)


def main():
    parser = argparse.ArgumentParser(description="Write the plots and the page of a convergence run.")
    parser.add_argument("results", type=Path, help="results.json; plots and index.html are written beside it")
    path = parser.parse_args().results
    plt.rcParams.update(STYLE)
    try:
        results = load(path)
    except ValueError as error:
        sys.exit(f"report: {path}: {error}")
    summary = derive(results)
    for problem in results["problems"]:
        for suffix, size in SIZES.items():
            plot(problem, path.parent / f"error_{problem['name']}{suffix}.svg", size)
    for suffix, columns in {"": 3, "_narrow": 1}.items():
        plot_stiff(results["stiff"], path.parent / f"stiff{suffix}.svg", columns)
    page = path.parent / "index.html"
    page.write_text(render(results, summary, path.name), encoding="utf-8")
    print(page)


if __name__ == "__main__":
    try:
        main()
    except OSError as error:
        sys.exit(f"report: {error.filename}: {error.strerror}")
