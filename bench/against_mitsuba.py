#!/usr/bin/env python3
"""Renders the tracer's scenes in Mitsuba 3 and in the tracer, in turns, and prints CPU time x relative MSE of both.

    sudo apt-get install -y libllvm19 python3-venv  # any LLVM that Dr.Jit finds, or that DRJIT_LIBLLVM_PATH names
    python3 -m venv build/mitsuba && build/mitsuba/bin/pip install mitsuba numpy
    cmake --preset demo && cmake --build build/demo --target tracer
    build/mitsuba/bin/python bench/against_mitsuba.py                                    # half an hour
    build/mitsuba/bin/python bench/against_mitsuba.py --scenes sky --bounces 1 --quick   # half a minute, numbers are rough

Both renderers have the same camera, box filter, depth, materials and lights, and both are compiled for this processor.
Mitsuba's path tracer with independent samples is in the table, and what does best in a trial of its integrators and
samplers. First two references, of many samples, must agree: their means, and every block of 16 x 16 pixels. Errors are
relative to the mean of the two. CPU time is that of rendering, without loading and compiling. The product does not depend on
the time where samples are independent; where they are stratified, it falls with time.

Does nothing, with a message, where Mitsuba or LLVM are missing.
"""

import argparse
import collections
import functools
import math
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import drjit
    import mitsuba
    import numpy
except ImportError as error:
    print(f"skipped: {error}. To install it: pip install mitsuba numpy")
    sys.exit(0)
if not drjit.has_backend(drjit.JitBackend.LLVM):
    print("skipped: Dr.Jit finds no LLVM. To install it: apt-get install libllvm19; or name one in DRJIT_LIBLLVM_PATH")
    sys.exit(0)
mitsuba.set_variant("llvm_ad_rgb")
mitsuba.set_log_level(mitsuba.LogLevel.Error)

from mitsuba_scenes import SCENES, as_the_tracer_has_it  # noqa: E402: needs a variant

ROOT = Path(__file__).resolve().parent.parent
BLOCK = 16  # pixels; of an image's blocks, each must agree
SYSTEMATIC = 1e-3  # of a block: Mitsuba forms 1 - cos of a small light's angle in float, which loses that much of Veach's
SIGNIFICANCE = 1e-4  # probability that two references of one image disagree
LARGEST_CALL = 256  # samples a pixel that Mitsuba holds at once
KEPT = {"all pixels": 1.0, "without the worst 2 %": 0.98, "without the worst 10 %": 0.9}

# What a trial chooses from, by bounces: "direct 5+1" takes five samples of lights and one of the BSDF.
ESTIMATORS = {1: ["path", "direct 1+1", "direct 3+1", "direct 5+1"], 5: ["path", "path, roulette"]}
SAMPLERS = ["independent", "stratified", "multijitter", "orthogonal", "ldsampler"]

Run = collections.namedtuple("Run", "samples cpu errors")  # errors: relative MSE for each of KEPT


def integrator(name, bounces):
    if name.startswith("direct"):
        lights, bsdf = map(int, re.findall(r"\d+", name))
        return {"type": "direct", "emitter_samples": lights, "bsdf_samples": bsdf}
    return {"type": "path", "max_depth": bounces + 1, "rr_depth": 3 if name.endswith("roulette") else bounces + 1}


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


class Mitsuba:
    def __init__(self, variant, scene, bounces, estimator, sampler):
        self.variant, self.name = variant, f"Mitsuba {variant.split('_')[0]}, {estimator}, {sampler}"
        mitsuba.set_variant(variant)
        make, self.width, self.height = SCENES[scene]
        description = make()
        description["type"] = "scene"
        description["integrator"] = integrator(estimator, bounces)
        description["camera"]["film"] = {"type": "hdrfilm", "width": self.width, "height": self.height,
                                         "rfilter": {"type": "box"}, "pixel_format": "rgb", "component_format": "float32"}
        description["camera"]["sampler"] = {"type": sampler}
        self.timed = mitsuba.load_dict(description, parallel=False)
        self.exact = self.timed
        if scene == "sky" and variant.startswith("llvm"):
            self.exact = mitsuba.load_dict(as_the_tracer_has_it(description), parallel=False)
        self.compiled = set() if variant.startswith("llvm") else None  # for these numbers of samples

    def possible(self, samples):
        """The number of samples nearest to this one that the sampler can have."""
        sampler = self.timed.sensors()[0].sampler().clone()
        sampler.set_sample_count(samples)
        return sampler.sample_count()

    def call(self, scene, samples, seed):
        start = cpu_seconds()
        image = numpy.array(mitsuba.render(scene, spp=samples, seed=seed), dtype=float)
        return image, cpu_seconds() - start

    def render(self, samples, seed):
        """The image, and the CPU seconds. These are of Mitsuba's own models; making them the tracer's costs 10 % more."""
        mitsuba.set_variant(self.variant)
        calls = max(1, samples // LARGEST_CALL)
        each, image, seconds = samples // calls, 0, 0
        if self.compiled is not None and each not in self.compiled:
            self.compiled.add(each)
            self.call(self.timed, each, 0)  # samplers that stratify are compiled for their number of samples
        for call in range(calls):
            part, cost = self.call(self.timed, each, seed * 1000 + call)
            if self.exact is not self.timed:
                part, _ = self.call(self.exact, each, seed * 1000 + call)
            image, seconds = image + part / calls, seconds + cost
        return image, seconds


class Tracer:
    def __init__(self, program, scene, bounces, sampler, threads):
        self.name = f"tracer, power, {sampler}"
        _, self.width, self.height = SCENES[scene]
        self.command = [str(program), "--scene", scene, "--integrator", "power", "--bounces", str(bounces),
                        "--filter", "box", "--sampler", sampler, "--width", str(self.width), "--height", str(self.height),
                        "--threads", str(threads)]

    @staticmethod
    def possible(samples):
        return samples

    def render(self, samples, seed):
        """The image, and the CPU seconds that the tracer says it took."""
        with tempfile.TemporaryDirectory() as folder:
            output = Path(folder) / "image.exr"
            command = [*self.command, "--spp", str(samples), "--seed", str(seed), "--output", str(output)]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(f"{' '.join(command)}\n{done.stderr}")
            return read_rgb(output), float(re.search(r"([\d.]+) s of CPU", done.stdout)[1])


def read_rgb(file):
    """Red, green and blue, whatever other channels the file has."""
    threads = drjit.thread_count()
    drjit.set_thread_count(2)  # Mitsuba reads in a second thread, and waits forever for one that is not there
    bitmap = mitsuba.Bitmap(str(file))
    drjit.set_thread_count(threads)
    names = [field.name for field in bitmap.struct_()]
    return numpy.array(bitmap, dtype=float)[..., [names.index(name) for name in "RGB"]]


def affordable(renderer, seconds):
    """Samples a pixel that take about so many CPU seconds: a power of two, which most samplers want."""
    pilot, cost = 8, 0  # the tracer fills packets of sixteen, and takes as long for fewer
    while cost < seconds / 8:
        pilot *= 2
        _, cost = renderer.render(renderer.possible(pilot), 0)
    return renderer.possible(max(1, 2 ** round(math.log2(seconds * pilot / cost))))


class Reference:
    """The mean of passes, and its variance pixel by pixel."""

    def __init__(self, renderer, seconds, passes=8):
        samples = affordable(renderer, seconds / passes)
        images = numpy.array([renderer.render(samples, 1000 + i)[0] for i in range(passes)])
        self.name, self.samples = renderer.name, samples * passes
        self.mean, self.variance = images.mean(axis=0), images.var(axis=0, ddof=1) / passes


def agree(a, b):
    """Prints how far two references differ, in units of their errors; returns whether it may be chance.

    Where the differences of pixels are independent and as likely positive as negative, their sum over the root of their sum
    of squares passes t with a probability of at most 2 exp(-t^2 / 2), however heavy their tails (Hoeffding 1963). Blocks may
    differ by SYSTEMATIC besides.
    """
    def z(values, systematic=0):
        squares = (values * values).sum()
        return 0.0 if squares == 0 else max(abs(values.sum()) - systematic, 0) / math.sqrt(squares)

    luminance = numpy.array([0.2126, 0.7152, 0.0722])
    for reference in (a, b):
        error = math.sqrt((reference.variance @ (luminance * luminance)).sum()) / reference.variance[..., 0].size
        print(f"reference: {reference.name}, {reference.samples} samples: mean {(reference.mean @ luminance).mean():.6f} "
              f"± {error:.6f}")
    difference = (a.mean - b.mean) @ luminance
    difference[abs(difference) < 1e-5 * (a.mean @ luminance)] = 0  # rounding, where nothing is random
    height, width = difference.shape
    places = [numpy.s_[y:y + BLOCK, x:x + BLOCK] for y in range(0, height, BLOCK) for x in range(0, width, BLOCK)]
    blocks = numpy.array([z(difference[place], SYSTEMATIC * (a.mean[place] @ luminance).sum()) for place in places])
    limit = math.sqrt(2 * math.log(2 * (blocks.size + 1) / SIGNIFICANCE))
    worst = blocks.max()
    print(f"their difference: z {z(difference):.2f}; largest of {blocks.size} blocks, beyond {SYSTEMATIC:.1%}, {worst:.2f}; "
          f"the limit is {limit:.2f}")
    return z(difference) <= limit and worst <= limit


class Truth:
    def __init__(self, a, b):
        self.mean = (a.mean + b.mean) / 2
        self.scale = numpy.maximum(abs(self.mean), 0.1 * self.mean.mean())  # as the convergence report has it
        self.own = ((a.variance + b.variance) / 4 / self.scale ** 2).mean(axis=2)

    def errors(self, image):
        """Relative MSE of the best pixels, as many as KEPT says, the truth's own subtracted."""
        pixels = numpy.sort((((image - self.mean) / self.scale) ** 2).mean(axis=2) - self.own, axis=None)
        return [pixels[:round(share * pixels.size)].mean() for share in KEPT.values()]


def measure(renderer, samples, seed, truth):
    image, seconds = renderer.render(samples, seed)
    return Run(samples, seconds, truth.errors(image))


def products(runs):
    return numpy.array([[run.cpu * error for error in run.errors] for run in runs])


def best_of_mitsuba(scene, bounces, seconds, truth):
    """(estimator, sampler) of the least product in a trial; samplers are tried with the best integrator.

    The worst 2 % of pixels are left out: a few fireflies would choose at random.
    """
    @functools.cache
    def product(estimator, sampler):
        renderer = Mitsuba("llvm_ad_rgb", scene, bounces, estimator, sampler)
        samples = affordable(renderer, seconds)
        result = products([measure(renderer, samples, seed, truth) for seed in (501, 502, 503)])[:, 1].mean()
        print(f"trial: {renderer.name}, {samples} samples: {result:.5f}", flush=True)
        return result

    estimator = min(ESTIMATORS[bounces], key=lambda name: product(name, "independent"))
    return estimator, min(SAMPLERS, key=lambda name: product(estimator, name))


def with_error(values):
    mean, error = values.mean(), values.std(ddof=1) / math.sqrt(len(values)) if len(values) > 1 else math.nan
    return f"{mean:.2g} ± {error:.1g}"


def print_table(runs, pixels):
    print("| | samples | CPU, s | a sample, ns | relative MSE | CPU s x relative MSE: " + " | ".join(KEPT) + " |")
    print("| --- " * (5 + len(KEPT)) + "|")
    for name, own in runs.items():
        samples, cpu = own[0].samples, numpy.mean([run.cpu for run in own])
        cells = [f"{samples}", f"{cpu:.2f}", f"{cpu / (samples * pixels) * 1e9:.0f}",
                 f"{numpy.mean([run.errors[0] for run in own]):.2g}", *map(with_error, products(own).T)]
        print(f"| {name} | " + " | ".join(cells) + " |")
    of = {name: products(own).mean(axis=0) for name, own in runs.items()}
    ours = min((name for name in of if name.startswith("tracer")), key=lambda name: of[name][0])
    theirs = min((name for name in of if name.startswith("Mitsuba")), key=lambda name: of[name][0])
    ratios = ", ".join(f"{ratio:.2f} {kept}" for ratio, kept in zip(of[ours] / of[theirs], KEPT))
    print(f"{ours} / {theirs}: {ratios}")


def compare(scene, bounces, arguments):
    """Whether the references agree."""
    print(f"\n{scene}, {'direct light' if bounces == 1 else f'{bounces} bounces'}", flush=True)

    def tracer(sampler):
        return Tracer(arguments.tracer, scene, bounces, sampler, arguments.threads)

    estimator = {1: "direct 3+1", 5: "path, roulette"}[bounces]
    references = [Reference(renderer, arguments.reference_seconds) for renderer in
                  (Mitsuba("llvm_ad_rgb", scene, bounces, estimator, "multijitter"), tracer("sobol"))]
    is_good = agree(*references)
    truth = Truth(*references)
    best = best_of_mitsuba(scene, bounces, arguments.seconds / 2, truth)
    estimators = dict.fromkeys([("path", "independent"), best])  # may be one
    renderers = [*(Mitsuba("scalar_rgb", scene, bounces, *estimator) for estimator in estimators),
                 *(Mitsuba("llvm_ad_rgb", scene, bounces, *estimator) for estimator in estimators),
                 tracer("random"), tracer("sobol")]
    samples = [affordable(renderer, arguments.seconds) for renderer in renderers]
    runs = {renderer.name: [] for renderer in renderers}
    for seed in range(1, arguments.seeds + 1):
        for renderer, count in zip(renderers, samples):
            runs[renderer.name].append(measure(renderer, count, seed, truth))
    print_table(runs, renderers[0].width * renderers[0].height)
    least = min(numpy.mean([run.errors[0] for run in own]) for own in runs.values())
    print(f"The truth's own error is {truth.own.mean() / least:.2%} of the least of these; it has been subtracted.",
          flush=True)
    return is_good


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--bounces", nargs="+", type=int, choices=ESTIMATORS, default=list(ESTIMATORS))
    parser.add_argument("--seconds", type=float, default=2, help="CPU time of a run, about")
    parser.add_argument("--seeds", type=int, default=6, help="runs of each")
    parser.add_argument("--reference-seconds", type=float, default=90, help="CPU time of each reference, about")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--tracer", type=Path, default=ROOT / "build/demo/examples/tracer/tracer")
    parser.add_argument("--quick", action="store_true", help="a tenth of the time: to see that all works")
    arguments = parser.parse_args()
    if not arguments.tracer.exists():
        sys.exit(f"there is no {arguments.tracer}: cmake --preset demo && cmake --build build/demo --target tracer")
    if arguments.quick:
        arguments.seconds, arguments.seeds, arguments.reference_seconds = 0.25, 2, 4
    drjit.set_thread_count(arguments.threads)
    print(f"Mitsuba {mitsuba.__version__}, {arguments.threads} thread{'s' * (arguments.threads > 1)}")
    agreed = [compare(scene, bounces, arguments) for scene in arguments.scenes for bounces in arguments.bounces]
    if not all(agreed):
        sys.exit("The references disagree: see above.")


if __name__ == "__main__":
    main()
