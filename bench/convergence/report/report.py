"""Turn the results of `convergence` into a page: python3 report.py <folder>/results.json

Writes <folder>/index.html, which holds all that it shows; SCHEMA.md describes the input.
"""

import argparse
import math
import sys
from pathlib import Path

import jinja2

import figures
import findings
import formats
from load import load
from pictures import REGION, Pictures, color_bar
from plot import plot
from stiff import LIMITS, heat_maps, size
from summary import summary

GROUPS = {  # the order and the titles of groups; a user's own come behind, under their names
    "scenes": "Scenes", "one-dimensional": "In one dimension", "irradiance": "Irradiance", "lights": "Lights",
    "furnace": "Furnaces", "environment": "Environment maps", "near-mirror": "Near-mirrors"}


def grouped(problems):
    """(title, problems) of each group."""
    names = dict.fromkeys([*GROUPS, *(problem["group"] for problem in problems)])
    groups = [(GROUPS.get(name, name), [p for p in problems if p["group"] == name]) for name in names]
    return [group for group in groups if group[1]]


def render(template, results, folder, results_name, image_names):
    overview, names = findings.find(results)
    totals = findings.totals(overview, names)
    scale = results["error_scale"]
    pictures = Pictures(folder, math.log10(scale["high"] / scale["low"]) if scale else 0, image_names)
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape="html" in template, trim_blocks=True,
        lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    filters = (formats.figure, formats.with_error, formats.duration, formats.percent, formats.sortable, formats.listed,
               formats.count, formats.compact, formats.spread_place, figures.marker_points, figures.variable, findings.level, size)
    environment.filters |= {function.__name__: function for function in filters}
    environment.tests["endless"] = math.isinf
    known = {name: results[name] for name in (
        "machine", "build", "arguments", "settings", "rules", "problems", "stiff", "stability")}
    return environment.get_template(template).render(
        **known, groups=grouped(results["problems"]), overview=overview, totals=totals,
        summary=summary(overview, totals, names) if overview else None, combined=names, levels=findings.LEVELS,
        palette=figures.palette(), pictures=pictures, plot=plot, region=REGION, results_name=results_name,
        color_bar=color_bar(scale) if scale else None, error_levels=LIMITS,
        heat_maps=heat_maps(results["stiff"]) if results["stiff"] else [])


def main():
    parser = argparse.ArgumentParser(description="Write the page of a convergence run.")
    parser.add_argument("results", type=Path, help="results.json; index.html is written beside it")
    parser.add_argument("--images", metavar="NAME,...", type=lambda names: names.split(","), default=(),
                        help="show the images of these integrators alone: a smaller file")
    parser.add_argument("--markdown", action="store_true", help="print the overview as a table, and write no page")
    arguments = parser.parse_args()
    path = arguments.results
    try:
        results = load(path)
    except ValueError as error:
        sys.exit(f"report: {path}: {error}")
    content = render("overview.md.jinja" if arguments.markdown else "page.html.jinja", results, path.parent, path.name,
                     arguments.images)
    if arguments.markdown:
        print(content, end="")
        return
    out = path.with_name("index.html")
    out.write_text(content, encoding="utf-8")
    print(out)


if __name__ == "__main__":
    try:
        main()
    except OSError as error:  # of images that are none, too
        sys.exit(f"report: {error}")
