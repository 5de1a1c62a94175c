#!/usr/bin/env python3
"""Writes all of Lumis but testing/ as one header: what <lumis/lumis.hpp>, <lumis/batch/batch.hpp> and <lumis/qmc/sobol.hpp>
include.

    cmake/single_header.py FOLDER/lumis/lumis.hpp
"""
import argparse
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'#include "(lumis/[^"]+)"')


def lines_of(header, seen):
    """The header's lines, those that it includes of Lumis put in their place, the first time."""
    if header in seen:
        return
    seen.add(header)
    yield f"// ---- {header}"
    for line in (ROOT / "include" / header).read_text().splitlines():
        included = INCLUDE.match(line)
        if included:
            yield from lines_of(included[1], seen)
        elif line != "#pragma once":
            yield line


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("output", type=pathlib.Path)
    output = parser.parse_args().output
    seen = set()
    text = ["// Lumis in one header, written by cmake/single_header.py. Its licence:", "//"]
    text += [f"// {line}".rstrip() for line in (ROOT / "LICENSE").read_text().splitlines()]
    text += ["#pragma once", ""]
    for header in ("lumis/lumis.hpp", "lumis/batch/batch.hpp", "lumis/qmc/sobol.hpp"):
        text += lines_of(header, seen)
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text("\n".join(text) + "\n")
    print(f"{output}: {len(seen)} headers, {len(text)} lines")


if __name__ == "__main__":
    main()
