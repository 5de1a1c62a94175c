#!/usr/bin/env python3
"""Every snippet of the documentation stands in a file that is compiled, and every output in one that is compared.

    snippets.py --pages <page>... --sources <file>...

A block of a page that is fenced as cpp, as cuda, or as text, has to be found in one of the sources: the same lines in a
row, but for their common indentation. A snippet that is changed is therefore changed in both places.
"""

import argparse
import difflib
import re
import sys
import textwrap
from pathlib import Path

BLOCK = re.compile(r"^( *)```(\S*)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
CHECKED = {"cpp": (".cpp", ".hpp"), "cuda": (".cu",), "text": (".txt",)}
UNCHECKED = {"sh", "cmake"}  # commands: .ci/run and tests/consumer run the like


def plain(lines):
    """Lines without their common indentation, and without the blanks at their ends."""
    return [line.rstrip() for line in textwrap.dedent("\n".join(lines)).split("\n")]


def runs(lines, length):
    """All runs of as many lines."""
    return (plain(lines[start:start + length]) for start in range(len(lines) - length + 1))


def nearest(block, sources):
    """What comes closest to a block, as the difference that would make it equal."""
    candidates = (run for lines in sources for run in runs(lines, len(block)))
    best = max(candidates, key=lambda run: difflib.SequenceMatcher(None, block, run).ratio(), default=[])
    return "\n".join(difflib.unified_diff(block, best, "page", "source", lineterm="", n=9))


def problems(page, sources):
    """The blocks of a page that no source has, and those of which it is not known what they are."""
    text = page.read_text()
    for match in BLOCK.finditer(text):
        language, block = match[2], plain(match[3].rstrip("\n").split("\n"))
        where = f"{page}:{text.count(chr(10), 0, match.start()) + 1}"
        if language in CHECKED:
            candidates = [lines for name, lines in sources.items() if name.suffix in CHECKED[language]]
            if not any(block) or not any(block == run for lines in candidates for run in runs(lines, len(block))):
                yield f"{where}: no source has this block; the nearest differs by\n{nearest(block, candidates)}"
        elif language not in UNCHECKED:
            yield f"{where}: a block of {language or 'no language'}, which is none of {[*CHECKED, *UNCHECKED]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--pages", nargs="+", type=Path, required=True)
    parser.add_argument("--sources", nargs="+", type=Path, required=True)
    arguments = parser.parse_args()
    sources = {path: path.read_text().split("\n") for path in arguments.sources}
    found = [problem for page in arguments.pages for problem in problems(page, sources)]
    print("\n\n".join(found) or f"every snippet of {len(arguments.pages)} pages is compiled")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
