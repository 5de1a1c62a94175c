"""Images of a run as data within the page, their errors in false colors, and the regions worth a closer look."""

import io

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from PIL import Image

from figures import data_uri, picture

CMAP = "inferno"
REGION = 24  # pixels along the edge of what is looked at closely


class Pictures:
    """Reads images beside the results, pixel by pixel; with `names`, those of these integrators alone."""

    def __init__(self, folder, decades, names=()):
        self.folder, self.decades, self.names = folder, decades, names

    def shown(self, problem):
        """The integrators whose images the page has."""
        pictured = [integrator for integrator in problem["integrators"] if integrator["image"]]
        return [integrator for integrator in pictured if not self.names or integrator["name"] in self.names]

    def left_out(self, problem):
        """The names of those whose images it has not."""
        return [integrator["name"] for integrator in problem["integrators"]
                if integrator["image"] and self.names and integrator["name"] not in self.names]

    def image(self, name):
        with Image.open(self.folder / name) as image:
            return self.encode(image.convert("RGB"))

    def error(self, name):
        """Levels of grey as false colors."""
        with Image.open(self.folder / name) as image:
            grey = image.convert("L")
        grey.putpalette(matplotlib.colormaps[CMAP](np.arange(256), bytes=True)[:, :3].tobytes())
        return self.encode(grey)

    @staticmethod
    def encode(image):
        out = io.BytesIO()
        image.save(out, "webp", lossless=True, quality=30, method=4)  # quality: of the compression
        return data_uri(out.getvalue(), "webp")

    def hard_regions(self, problem):
        """Where `power` and each technique alone err most: (name, center x, center y) as fractions of the image."""
        regions = []
        for integrator in sorted(problem["integrators"], key=lambda integrator: integrator["name"] != "power"):
            if integrator["error_image"] and (integrator["model"] == "alone" or integrator["name"] == "power"):
                with Image.open(self.folder / integrator["error_image"]) as image:
                    errors = 10 ** (self.decades * np.asarray(image.convert("L"), dtype=float) / 255)
                place = worst_region(errors)
                if all(max(abs(place[0] - x), abs(place[1] - y)) > REGION / 2 for _, x, y in regions):
                    regions.append((integrator["name"], *place))
        size = problem["width"], problem["height"]
        return [(name, x / size[0], y / size[1]) for name, x, y in regions]


def worst_region(errors):
    """The center (x, y) of the square whose mean squared error is the largest."""
    edge = min(REGION, *errors.shape)
    sums = np.pad(errors ** 2, ((1, 0), (1, 0))).cumsum(0).cumsum(1)
    squares = sums[edge:, edge:] - sums[:-edge, edge:] - sums[edge:, :-edge] + sums[:-edge, :-edge]
    y, x = np.unravel_index(np.argmax(squares), squares.shape)
    return x + edge / 2, y + edge / 2


def color_bar(scale):
    """What the false colors mean."""
    figure, axes = plt.subplots(figsize=(3, 0.42))
    figure.subplots_adjust(left=0.08, right=0.9, bottom=0.6, top=1)
    norm = LogNorm(scale["low"], scale["high"])
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, CMAP), cax=axes, orientation="horizontal")
    bar.ax.xaxis.set_major_formatter(lambda error, position: f"{100 * error:,g} %")
    bar.ax.minorticks_off()
    bar.outline.set_visible(False)
    return picture(figure)
