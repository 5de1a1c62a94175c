#!/usr/bin/env python3
"""Which lines of include/ the library's tests run: builds them with clang++'s counters, runs them, prints a table.

    tests/coverage.py                  all headers, and the lines that no test has run
    tests/coverage.py --least 95       fails where less than 95 % of the lines are run
    tests/coverage.py --jobs 1

A line counts as run if any instantiation of it has run. Templates that no test instantiates are not counted, nor what is
evaluated by the compiler alone. Needs clang++ and its llvm-cov (Debian: clang, llvm).
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def tool(name, compiler):
    """The tool of the compiler's own version, for no other reads its counters."""
    version = re.search(r"version (\d+)", subprocess.run([compiler, "--version"], capture_output=True, text=True).stdout)[1]
    found = shutil.which(f"{name}-{version}") or shutil.which(name)
    return found or sys.exit(f"{name} is missing: apt-get install llvm-{version}")


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, text=True, **options)


def build(folder, compiler, jobs):
    counters = "-fprofile-instr-generate -fcoverage-mapping"
    run("cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-D", f"CMAKE_CXX_COMPILER={compiler}", "-D", "CMAKE_BUILD_TYPE=Release",
        "-D", "CMAKE_CXX_FLAGS_RELEASE=-O0", "-D", f"CMAKE_CXX_FLAGS={counters}", "-D", "LUMIS_BUILD_TESTS=ON", stdout=subprocess.DEVNULL)
    run("cmake", "--build", folder, "--target", "lumis_tests", "--parallel", jobs, stdout=subprocess.DEVNULL)
    return folder / "tests" / "lumis_tests"


def covered(binary, compiler):
    """{header: (lines, lines run, the others' numbers)}"""
    raw, merged = binary.parent / "coverage.profraw", binary.parent / "coverage.profdata"
    run(binary, stdout=subprocess.DEVNULL, env={**os.environ, "LLVM_PROFILE_FILE": str(raw)})
    run(tool("llvm-profdata", compiler), "merge", "-sparse", raw, "-o", merged)
    exported = run(tool("llvm-cov", compiler), "export", "-format=lcov", f"-instr-profile={merged}", binary,
                   ROOT / "include", capture_output=True).stdout
    found, header, counts = {}, None, {}
    for line in exported.splitlines():
        if line.startswith("SF:"):
            header, counts = Path(line[3:]).relative_to(ROOT / "include"), {}
        elif line.startswith("DA:"):
            number, count = line[3:].split(",")[:2]
            counts[int(number)] = counts.get(int(number), 0) + int(count)
        elif line == "end_of_record":
            missed = sorted(number for number, count in counts.items() if count == 0)
            found[header] = (len(counts), len(counts) - len(missed), missed)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--least", type=float, default=0, help="per cent of all lines")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--compiler", default="clang++")
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "coverage", help="folder to build in")
    arguments = parser.parse_args()

    headers = covered(build(arguments.build, arguments.compiler, arguments.jobs), arguments.compiler)
    for header, (lines, ran, missed) in sorted(headers.items()):
        if lines:
            print(f"{100 * ran / lines:6.1f} %  {header}  {', '.join(map(str, missed))}")
    lines, ran = (sum(figures[i] for figures in headers.values()) for i in (0, 1))
    share = 100 * ran / lines
    print(f"{share:6.1f} % of {lines} lines in {len(headers)} headers")
    return 0 if share >= arguments.least else 1


if __name__ == "__main__":
    sys.exit(main())
