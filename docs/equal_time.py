#!/usr/bin/env python3
"""Draws docs/equal_time.jpg: Veach's plates by three integrators of the tracer, at equal CPU time.

    cmake --preset demo && cmake --build build/demo --target tracer
    /usr/bin/python3 docs/equal_time.py [--seconds 1]

A first short run of each tells what a sample costs, so that the picture is of equal time on a busy machine as well.
"""

import argparse
import re
import subprocess
import tempfile
from pathlib import Path

from matplotlib.font_manager import findfont
from PIL import Image, ImageDraw, ImageFont

ROOT = Path(__file__).resolve().parent.parent
INTEGRATORS = {"bsdf": "BSDF sampling alone", "light": "light sampling alone", "power": "both, power heuristic"}
WIDTH, HEIGHT = 432, 324  # of each picture; at its full size, for a smaller copy would hide the noise
STRIP, GAP = 26, 6
PACKET = 16  # samples a pixel that the tracer takes at once
PILOT = 4 * PACKET  # samples a pixel of the short run


def render(tracer, integrator, samples, output):
    """CPU seconds that the tracer says it took."""
    command = [tracer, "--scene", "veach", "--integrator", integrator, "--bounces", "1", "--sampler", "random",
               "--spp", str(samples), "--width", str(WIDTH), "--height", str(HEIGHT), "--output", str(output)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return float(re.search(r"([\d.]+) s of CPU", printed)[1])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=1, help="CPU time of each picture")
    parser.add_argument("--tracer", default=ROOT / "build/demo/examples/tracer/tracer")
    parser.add_argument("--output", default=ROOT / "docs/equal_time.jpg")
    arguments = parser.parse_args()

    picture = Image.new("RGB", (3 * WIDTH + 2 * GAP, HEIGHT + STRIP), "white")
    draw = ImageDraw.Draw(picture)
    font = ImageFont.truetype(findfont("DejaVu Sans"), 17)
    with tempfile.TemporaryDirectory() as folder:
        for column, (integrator, words) in enumerate(INTEGRATORS.items()):
            output = Path(folder) / "image.png"
            cost = render(arguments.tracer, integrator, PILOT, output) / PILOT
            samples = PACKET * max(1, round(arguments.seconds / cost / PACKET))
            seconds = render(arguments.tracer, integrator, samples, output)
            print(f"{integrator}: {samples} samples a pixel in {seconds:.2f} s of CPU time")
            x = column * (WIDTH + GAP)
            picture.paste(Image.open(output), (x, STRIP))
            draw.text((x + WIDTH / 2, STRIP / 2), words, fill="black", font=font, anchor="mm")
    picture.save(arguments.output, quality=85, optimize=True)


if __name__ == "__main__":
    main()
