#!/usr/bin/env python3
"""Writes docs/speed.md: what each kernel costs as one call, in a batch, and as textbooks have it.

    bench/speed.py                        builds four variants of the benchmarks, runs them, and writes docs/speed.md
    bench/speed.py --variants gcc-native  only some of them; --output - prints the page instead
    bench/speed.py --filter cosine --no-instructions --repetitions 3 --output -

All kernels of a variant are measured in one process, their repetitions in random order, so that a noisy machine disturbs
all alike; medians are compared. Instructions are counted by valgrind: the difference between two runs of one kernel that
differ in their number of passes, so that what comes before and after cancels.
"""

import argparse
import collections
import datetime
import json
import os
import platform
import re
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BATCH = 1024  # items of a pass, see kernel.hpp

# Instructions are counted in a build of their own where the machine may have many that valgrind does not know, AVX-512.
Variant = collections.namedtuple("Variant", "compiler flags counted_flags targets")
VARIANTS = {
    "gcc-native": Variant("g++", "-O3 -march=native", "-O3 -march=x86-64-v3", True),
    "clang-native": Variant("clang++", "-O3 -march=native", "-O3 -march=x86-64-v3", True),
    "gcc-plain": Variant("g++", "-O2", "-O2", False),
    "clang-plain": Variant("clang++", "-O2", "-O2", False),
}

# Kernel, the form that is slower, the one that is faster, and by how much, at -O3 -march=native ...
TARGETS = [
    ("sample/cosine_hemisphere", "textbook", "single", 2.5),
    ("sample/ggx_reflection", "textbook", "single", 1.2),
    ("sample/environment_8192x4096", "textbook", "single", 4.0),
    ("sample/cosine_hemisphere", "single", "batch", 4.0),
    ("sample/ggx_reflection", "single", "batch", 5.0),
    ("estimate/ggx_square_light", "single", "batch", 5.0),
    ("estimate/cosine_sphere_light", "single", "batch", 5.0),
    ("estimate/ggx_environment_1024x512", "single", "batch", 3.0),
]
# ... and at -O2: no slower. Two times that are equal differ by this much from run to run.
NO_SLOWER = 0.97

# A table so large that valgrind would need minutes to build it.
UNCOUNTED = re.compile("environment_(4096|8192)|(alias|discrete)_table_1000000")
FORMS = ["textbook", "single", "batch"]


def run(command, **options):
    return subprocess.run([str(word) for word in command], check=True, text=True, **options)


def build(compiler, flags, folder):
    options = ["-G", "Ninja", "-D", f"CMAKE_CXX_COMPILER={compiler}", "-D", "CMAKE_BUILD_TYPE=Release",
               "-D", f"CMAKE_CXX_FLAGS_RELEASE={flags} -DNDEBUG", "-D", "LUMIS_BUILD_BENCHMARKS=ON"]
    run(["cmake", "-S", ROOT, "-B", folder, *options], stdout=subprocess.DEVNULL)
    run(["cmake", "--build", folder, "--target", "lumis_bench"], stdout=subprocess.DEVNULL)
    return folder / "bench" / "lumis_bench"


def measure_times(binary, pattern, repetitions, seconds):
    """Median nanoseconds of an item by kernel name; of build/..., milliseconds of the whole."""
    output = binary.parent / "times.json"
    names = run([binary, f"--benchmark_filter={pattern}", "--benchmark_list_tests"], capture_output=True).stdout.split()
    run([binary, f"--benchmark_filter={pattern}", "--benchmark_enable_random_interleaving=true",
         f"--benchmark_repetitions={repetitions}", f"--benchmark_min_time={seconds}",
         "--benchmark_out_format=json", f"--benchmark_out={output}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    times = collections.defaultdict(list)
    for result in json.loads(output.read_text())["benchmarks"]:
        if result["run_type"] == "iteration":
            scale = {"ns": 1, "us": 1e3, "ms": 1e6}[result["time_unit"]]
            unit = 1e6 if result["run_name"].startswith("build/") else BATCH
            times[result["run_name"]].append(result["cpu_time"] * scale / unit)
    return {name: statistics.median(times[name]) for name in names}  # not in their random order


def instructions_of_run(binary, kernel, passes):
    result = subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", str(binary), "--run",
                             kernel, str(passes)], text=True, capture_output=True)
    found = re.search(r"Collected : (\d+)", result.stderr)
    return int(found[1]) if result.returncode == 0 and found else None


def count_instructions(binary, kernel):
    """Instructions of an item; None if the kernel is not counted, or has an instruction that valgrind does not know."""
    if kernel.startswith("build/") or UNCOUNTED.search(kernel):
        return None
    few, many = 2, 34
    low, high = (instructions_of_run(binary, kernel, passes) for passes in (few, many))
    return (high - low) / ((many - few) * BATCH) if low and high else None


def by_kernel(figures):
    """{'sample/x': {'single': figure, ...}} from {'sample/x/single/float': figure, ...}; lanes of points are a batch of them."""
    table = collections.defaultdict(dict)
    for name, figure in figures.items():
        kernel, form, _ = name.rsplit("/", 2)
        table[kernel]["batch" if form == "lanes" else form] = figure
    return table


def number(x, digits=3):
    """Three digits, never as a power of ten."""
    if x is None:
        return ""
    return f"{x:.0f}" if x >= 100 else f"{x:.{digits}g}"


def ratio(figures, slower, faster):
    return figures[slower] / figures[faster] if figures.get(slower) and figures.get(faster) else None


def table_of(times, instructions):
    lines = ["| kernel | textbook, ns | single, ns | batch, ns | textbook / single | single / batch "
             "| instructions: textbook | single | batch |", "| --- |" + " ---: |" * 8]
    for kernel in times:
        if kernel.startswith("build/"):
            continue
        t, n = times[kernel], instructions.get(kernel, {})
        cells = [number(t.get(form)) for form in FORMS]
        cells += [number(ratio(t, "textbook", "single"), 2), number(ratio(t, "single", "batch"), 2)]
        cells += [number(n.get(form)) for form in FORMS]
        lines.append(f"| `{kernel}` | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def build_table(times):
    kernels = [kernel for kernel in times if kernel.startswith("build/")]
    if not kernels:
        return ""
    forms = list(dict.fromkeys(form for kernel in kernels for form in times[kernel]))
    lines = ["| table | " + " | ".join(f"{form}, ms" for form in forms) + " |", "| --- |" + " ---: |" * len(forms)]
    lines += [f"| `{k}` | " + " | ".join(number(times[k].get(form)) for form in forms) + " |" for k in kernels]
    return "\n" + "\n".join(lines) + "\n"


def judged(variant, times):
    """(kernel, what is compared, ratio, target) for all targets that were measured."""
    found = []
    if variant.targets:
        for kernel, slower, faster, least in TARGETS:
            found.append((kernel, f"{slower} / {faster}", ratio(times.get(kernel, {}), slower, faster), least))
    else:
        for kernel, figures in times.items():
            found.append((kernel, "single / batch", ratio(figures, "single", "batch"), NO_SLOWER))
    return [row for row in found if row[2] is not None]


def verdicts(results):
    lines = ["| compiler, flags | kernel | compared | times faster | target | |", "| --- | --- | --- | ---: | ---: | --- |"]
    all_met = True
    for name, (times, _) in results.items():
        variant = VARIANTS[name]
        title = f"{variant.compiler} `{variant.flags}`"
        rows = judged(variant, times)
        failed = [row for row in rows if not row[2] >= row[3]]
        all_met = all_met and not failed
        # Many kernels are only to be no slower: the exceptions and the sum stand for them.
        for kernel, compared, value, least in rows if variant.targets else failed:
            met = "met" if value >= least else "**not met**"
            lines.append(f"| {title} | `{kernel}` | {compared} | {value:.2f} | {least:g} | {met} |")
        if not variant.targets and rows:
            worst = min(rows, key=lambda row: row[2])
            lines.append(f"| {title} | all {len(rows)} with a batch | single / batch, least | {worst[2]:.2f} | "
                         f"{NO_SLOWER:g} | {'**not met**' if failed else 'met'} |")
    return "\n".join(lines), all_met


def machine():
    for line in Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []:
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def version(compiler):
    return run([compiler, "--version"], capture_output=True).stdout.splitlines()[0]


PAGE = """\
# Speed, as measured

What a sample, a density or a weight costs: as one call of Lumis (`single`), in `lumis/batch` (`batch`), and the way books
and well-known renderers write it (`textbook`: plain code, compiled in the same file with the same flags, tested to draw the
same; [bench/textbook](../bench/textbook)). Nanoseconds of processor time, in float. This page is written by

```sh
bench/speed.py
```

which builds the benchmarks with each compiler and set of flags, and needs g++, clang++ and valgrind. By hand:

```sh
cmake --preset bench -D CMAKE_CXX_FLAGS=-march=native && cmake --build --preset bench
build/bench/bench/lumis_bench --benchmark_filter='cosine.*float'
```

{date}; {machine}; {load}. {repetitions} repetitions of each kernel in random order, medians; ratios are of one run.
{versions}

## Targets

{verdicts}

Batches are compared with single calls at `-O2` as well: there they are to be no slower (0.97, for what two equal times differ by).

## How to read the tables

- Random numbers and directions are made beforehand, in arrays; results go to arrays, one for each component. Single calls and
  textbook code take one item after the other, as a renderer does: the compiler may not work on several at once.
- Kernels without a table go over the same 1024 items, in the first cache; tables are asked a million different questions, so that
  one that outgrows the caches pays for it. The sky has a sun that gives as much light as the rest.
- `sample/...` is a sample with its density; of `ggx_reflection` also its weight, reflectance times cosine over density. `pdf/...` is
  a density, half of the directions being samples and half anywhere. `once/...` makes the strategy for a new point, or
  direction, and draws one sample (without a weight), as at each vertex of a path; its `batch` makes one strategy of lanes for as
  many points. `estimate/...` is a whole estimate by two techniques and the power heuristic, integrand included.
- `textbook` of `cosine_hemisphere` is Malley's method in polar coordinates, the faster one; `textbook_concentric` in the program's output is Shirley
  and Chiu's map. Of `ggx_reflection` it draws by spherical caps as published in 2023, the fastest there is.
- Some textbook forms are quicker for doing less: a sphere's `1 - cos`, or a triangle's arc cosines, have no digits left for a small
  light ([numbers.md](numbers.md)), and edges do not give way by the rounding of a direction.
- Instructions are those of an item, counted by valgrind; they repeat exactly. Instead of `-march=native` they are of a build for
  `x86-64-v3`, which has vectors of the same width: valgrind does not know AVX-512. Large tables are not counted, nor what valgrind cannot run.
{tables}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variants", nargs="+", choices=VARIANTS, default=list(VARIANTS))
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "speed", help="folder to build in")
    parser.add_argument("--filter", default="", help="only kernels whose names have this in them, a regular expression")
    parser.add_argument("--repetitions", type=int, default=15)
    parser.add_argument("--seconds", type=float, default=0.02, help="of a repetition")
    parser.add_argument("--no-instructions", action="store_true")
    parser.add_argument("--output", default=ROOT / "docs" / "speed.md", help="- is the standard output")
    arguments = parser.parse_args()

    load = f"load average {os.getloadavg()[0]:.1f} before"
    pattern = rf"^(sample|pdf|once|weight|estimate|build)/.*({arguments.filter}).*/(single|batch|lanes|textbook|alias)/float"
    variants = {name: VARIANTS[name] for name in arguments.variants}
    binaries = {name: build(v.compiler, v.flags, arguments.build / name) for name, v in variants.items()}
    times = {}
    for name, binary in binaries.items():  # first, all of them: the machine is as quiet as it was
        print(f"measuring {name}", file=sys.stderr)
        times[name] = measure_times(binary, pattern, arguments.repetitions, arguments.seconds)
    results = {}
    for name, binary in binaries.items():
        counted, v = {}, variants[name]
        if not arguments.no_instructions:
            print(f"counting {name}", file=sys.stderr)
            if v.counted_flags != v.flags:
                binary = build(v.compiler, v.counted_flags, arguments.build / f"{name}-counted")
            counted = {kernel: count_instructions(binary, kernel) for kernel in times[name]}
        results[name] = (by_kernel(times[name]), by_kernel(counted))

    tables = ""
    for name, (times, instructions) in results.items():
        tables += f"\n## {VARIANTS[name].compiler}, `{VARIANTS[name].flags}`\n\n{table_of(times, instructions)}\n"
        tables += build_table(times)
    text, all_met = verdicts(results)
    compilers = dict.fromkeys(VARIANTS[name].compiler for name in results)
    page = PAGE.format(date=datetime.date.today().isoformat(), machine=machine(), load=load,
                       repetitions=arguments.repetitions, versions="; ".join(version(c) for c in compilers) + ".",
                       verdicts=text, tables=tables)
    if str(arguments.output) == "-":
        print(page)
    else:
        Path(arguments.output).write_text(page)
    print("all targets met" if all_met else "some targets are not met", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
