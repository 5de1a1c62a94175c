"""Matplotlib's figures as images within the page: small, and legible on light and on dark paper."""

import base64
import io
import re
import urllib.parse

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from markupsafe import Markup
from matplotlib.markers import MarkerStyle

# Each color of a figure, on light paper and on dark.
INK, QUIET, LINE = "#1d1f23", "#5d626b", "#dcdad5"
SERIES = {  # Okabe and Ito (2008), and two more; on dark paper lighter
    "#0072b2": "#4aa8e0", "#d55e00": "#ff8a3c", "#009e73": "#2fc79c", "#222222": "#e4e4e2", "#cc79a7": "#e39cc4",
    "#c98600": "#f0b43c", "#3d9fd6": "#93d3f7", "#6b57b8": "#b3a3f0", "#8a5a2c": "#cf9d6e"}
COLORS, MARKERS = tuple(SERIES), "osD^vPX*<>ph"
ON_DARK = {INK: "#e7e6e3", QUIET: "#a2a7b0", LINE: "#3a3e45"} | SERIES
STYLE = {
    "font.size": 9, "font.sans-serif": ["DejaVu Sans"], "text.color": INK, "axes.titlesize": 9, "axes.labelsize": 9,
    "axes.labelcolor": QUIET, "axes.grid": True, "grid.color": LINE, "grid.linewidth": 0.6, "axes.axisbelow": True,
    "axes.edgecolor": QUIET, "axes.linewidth": 0.7, "axes.facecolor": "none", "figure.facecolor": "none",
    "axes.spines.top": False, "xtick.color": QUIET, "ytick.color": QUIET, "lines.linewidth": 1.6, "lines.markersize": 5,
    "svg.fonttype": "none", "svg.hashsalt": "lumis"}
plt.rcParams.update(STYLE)


def data_uri(content, kind):
    return f"data:image/{kind};base64,{base64.b64encode(content).decode()}"


def variable(color):
    return "--c" + color[1:]


def palette():
    """The colors as variables of a style sheet, for what stands beside a figure: on light paper, and on dark."""
    return [Markup("".join(f"{variable(pair[0])}:{pair[i]};" for pair in ON_DARK.items())) for i in (0, 1)]


def svg(figure):
    """The figure, closed, as SVG whose colors follow the reader's choice of light or dark."""
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    plt.close(figure)
    text = out.getvalue()
    text = text[text.index("<svg"):]
    text = re.sub(r"<!--.*?-->|<metadata>.*?</metadata>", "", text, flags=re.DOTALL)
    text = re.sub(r"(?<=[ \"(,ML-])(\d+\.\d)\d+", r"\1", text)  # a tenth of a pixel is fine enough
    text = text.replace("font: 9px 'DejaVu Sans'", "font: 9px var(--font)").replace("'DejaVu Sans'", "var(--font)")
    text = re.sub(r' id="(?![mp][0-9a-f]{10}")[^"]*"', "", text)  # names that nothing refers to
    for color in ON_DARK:
        text = text.replace(color, f"var({variable(color)})")
    text = re.sub(r"\s*\n\s*", "\n", text)
    light, dark = palette()
    style = (f"<style>svg{{--font:system-ui,'DejaVu Sans',sans-serif;{light}}}"
             f"@media(prefers-color-scheme:dark){{svg{{{dark}}}}}</style>")
    return re.sub(r"(<svg[^>]*>)", lambda head: head[1] + style, text, count=1)


def picture(figure):
    """The figure as the page shows it: where it is, and its size in pixels of the page."""
    width, height = (round(96 * inches) for inches in figure.get_size_inches())
    text = urllib.parse.quote(svg(figure).replace('"', "'"), safe=" '<>/:;=,()[]{}!$*+@?\n")
    return {"uri": Markup("data:image/svg+xml," + text), "width": width, "height": height}


def marker_points(marker):
    """The marker of a line as the points of an SVG polygon in [-1, 1]²."""
    style = MarkerStyle(marker)
    polygon = style.get_path().transformed(style.get_transform()).to_polygons()[0]
    return " ".join(f"{x:.2f},{-y:.2f}" for x, y in polygon / np.abs(polygon).max())
