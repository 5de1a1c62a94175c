#!/usr/bin/env python3
"""How much faster two ranks of MPI render than one, a thread each, in turns: medians over pairs of runs.

Needs the tracer built with -D LUMIS_TRACER_MPI=ON, two cores, and nothing else that runs on them.
"""
import argparse
import os
import re
import statistics
import subprocess
import tempfile
import time

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("tracer", help="path of the program")
parser.add_argument("--pairs", type=int, default=7)
arguments, options = parser.parse_known_args()  # all others are the tracer's
options = options or ["--scene", "veach", "--width", "192", "--height", "128", "--spp", "512"]

# As root, in a container, mpirun starts nothing unless told.
environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def run(ranks):
    """Seconds of rendering, of the whole run, and of CPU."""
    with tempfile.TemporaryDirectory() as folder:
        start = time.monotonic()
        done = subprocess.run(
            ["mpirun", "--bind-to", "core", "-n", str(ranks), os.path.abspath(arguments.tracer), "--threads", "1",
             *options],
            cwd=folder, env=environment, check=True, capture_output=True, text=True)
        whole = time.monotonic() - start
    rendering, cpu = re.search(r"a pixel in ([\d.]+) s, ([\d.]+) s of CPU", done.stdout).groups()
    return float(rendering), whole, float(cpu)


pairs = [(run(1), run(2)) for _ in range(arguments.pairs)]
for k, name in enumerate(["rendering", "whole run", "CPU"]):
    of_one, of_two = (statistics.median(pair[i][k] for pair in pairs) for i in (0, 1))
    ratios = sorted(pair[0][k] / pair[1][k] for pair in pairs)
    print(f"{name}: 1 rank {of_one:.2f} s, 2 ranks {of_two:.2f} s, ratio {statistics.median(ratios):.2f} "
          f"({ratios[0]:.2f} to {ratios[-1]:.2f})")
