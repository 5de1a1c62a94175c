#!/usr/bin/env python3
"""What including a header costs: processor seconds it adds to a translation unit that has <glm/glm.hpp> already.

    bench/header_cost.py                       lumis.hpp and each single header, with g++ and clang++
    bench/header_cost.py --limit 0.5           lumis.hpp alone; ends with 1 if it adds more than that
    bench/header_cost.py --standard            the standard headers that ours include: alone, and over the others
    bench/header_cost.py --against a.hpp b.hpp these headers only

The compiler is asked for -fsyntax-only: that is all that including costs, as templates no one instantiates yield no
code. Compilations of all headers take turns, so that a noisy machine disturbs all alike, and medians are compared. Time
is the processor's, not the wall's.
"""

import argparse
import os
import random
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

INCLUDE = Path(__file__).resolve().parent.parent / "include"
BASE = "#include <glm/glm.hpp>\n"


def processor_seconds(command):
    """User and system time of one run."""
    process = subprocess.Popen(command)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}")
    return usage.ru_utime + usage.ru_stime


def measure(compiler, sources, repetitions):
    """Median seconds for each name of `sources`, a dictionary of source texts; in a new random order each time."""
    seconds = {name: [] for name in sources}
    with tempfile.TemporaryDirectory() as folder:
        files = {}
        for number, (name, text) in enumerate(sources.items()):
            files[name] = Path(folder) / f"{number}.cpp"
            files[name].write_text(text)
        for _ in range(repetitions):
            for name in random.sample(list(sources), len(sources)):
                seconds[name].append(
                    processor_seconds([compiler, "-std=c++20", "-fsyntax-only", f"-I{INCLUDE}", files[name]]))
    return {name: statistics.median(times) for name, times in seconds.items()}


def own_headers(folders):
    paths = [INCLUDE / "lumis" / "lumis.hpp"]
    for folder in folders:
        paths += sorted((INCLUDE / "lumis" / folder).glob("*.hpp"))
    return [str(path.relative_to(INCLUDE)) for path in paths if path.exists()]


def standard_headers():
    """Those that lumis.hpp brings in directly, through headers of ours."""
    found, queue, seen = set(), ["lumis/lumis.hpp"], set()
    while queue:
        header = queue.pop()
        if header in seen:
            continue
        seen.add(header)
        text = (INCLUDE / header).read_text()
        queue += re.findall(r'#include "(lumis/[^"]+)"', text)
        found |= set(re.findall(r"#include <([a-z_]+)>", text))
    return sorted(found)


def includes(headers):
    return "".join(f"#include <{header}>\n" for header in headers)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compilers", nargs="+", default=[c for c in ("g++", "clang++") if shutil.which(c)])
    parser.add_argument("--repetitions", type=int, default=9)
    parser.add_argument("--limit", type=float, help="seconds that lumis.hpp may add")
    parser.add_argument("--standard", action="store_true", help="the standard headers that ours include")
    parser.add_argument("--against", nargs="+", metavar="HEADER", help="measure these headers")
    arguments = parser.parse_args()

    if arguments.standard:
        headers = standard_headers()
        sources = {"base": BASE, "all": BASE + includes(headers)}
        for header in headers:
            sources["alone " + header] = BASE + includes([header])
            sources["without " + header] = BASE + includes(h for h in headers if h != header)
        columns = {"alone": lambda t, h: t["alone " + h] - t["base"],
                   "over the others": lambda t, h: t["all"] - t["without " + h]}
    else:
        limited = ["lumis/lumis.hpp"] if arguments.limit is not None else None
        headers = arguments.against or limited or own_headers(["core", "strategies", "combine", "statistics", "batch"])
        sources = {"base": BASE} | {header: BASE + includes([header]) for header in headers}
        columns = {"adds": lambda t, h: t[h] - t["base"]}

    times = {compiler: measure(compiler, sources, arguments.repetitions) for compiler in arguments.compilers}
    titles = [f"{compiler}, {column}" for compiler in times for column in columns]
    rows = {h: [of(times[c], h) for c in times for of in columns.values()] for h in headers}
    print("Seconds over <glm/glm.hpp>, which takes "
          + " and ".join(f"{t['base']:.2f} ({c})" for c, t in times.items()) + "\n")
    print("| header | " + " | ".join(titles) + " |")
    print("| --- |" + " ---: |" * len(titles))
    for header, row in sorted(rows.items(), key=lambda item: -max(item[1])):
        print(f"| {header} | " + " | ".join(f"{seconds:.3f}" for seconds in row) + " |")
    if arguments.standard:
        every = [f"{t['all'] - t['base']:.3f}" for t in times.values() for _ in columns]
        print("| all of these | " + " | ".join(every) + " |")

    if arguments.limit is not None:
        worst = max(rows["lumis/lumis.hpp"])
        print(f"\nlumis/lumis.hpp adds at most {worst:.2f} s; the limit is {arguments.limit:g} s")
        return 0 if worst <= arguments.limit else 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
