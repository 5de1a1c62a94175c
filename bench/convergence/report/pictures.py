"""Images of a run as data within the page, their errors in false colors, and the regions worth a closer look."""

import io

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm
from PIL import Image

from figures import data_uri, picture
from formats import percent

CMAP = "inferno"
REGION = 24  # pixels along the edge of what is looked at closely


class Pictures:
    """Reads images beside the results; with `width`, smaller and lossily compressed."""

    def __init__(self, folder, decades, width=None):
        self.folder, self.decades, self.width = folder, decades, width

    def image(self, name):
        with Image.open(self.folder / name) as image:
            return self.encode(image.convert("RGB"), lossless=not self.width)

    def error(self, name):
        """Levels of grey as false colors."""
        colors = matplotlib.colormaps[CMAP](np.arange(256), bytes=True)[:, :3]
        with Image.open(self.folder / name) as image:
            grey = image.convert("L")
        if self.width:
            return self.encode(Image.fromarray(colors[np.asarray(grey)]), lossless=False)
        grey.putpalette(colors.tobytes())
        return self.encode(grey, lossless=True)

    def encode(self, image, lossless):
        out = io.BytesIO()
        if lossless:
            image.save(out, "png", optimize=True)
            return data_uri(out.getvalue(), "png")
        if image.width > self.width:
            image = image.resize((self.width, round(image.height * self.width / image.width)), Image.Resampling.BOX)
        image.save(out, "webp", quality=80, method=6)
        return data_uri(out.getvalue(), "webp")

    def hard_regions(self, problem):
        """Where each technique alone and `power` err most: (name, center x, center y) as fractions of the image."""
        regions = []
        for integrator in problem["integrators"]:
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
    figure, axes = plt.subplots(figsize=(3.4, 0.5))
    figure.subplots_adjust(left=0.07, right=0.93, bottom=0.6, top=1)
    norm = LogNorm(scale["low"], scale["high"])
    bar = figure.colorbar(matplotlib.cm.ScalarMappable(norm, CMAP), cax=axes, orientation="horizontal")
    bar.ax.xaxis.set_major_formatter(lambda error, position: percent(error))
    bar.ax.minorticks_off()
    bar.outline.set_visible(False)
    return picture(figure)
