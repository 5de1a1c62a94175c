#!/usr/bin/env python3
"""A newcomer's walk, by what the documentation prints: its blocks become files, and its commands are run in their order.

    walk.py <folder to work in> [--compiler <g++>]

README.md: a first estimate in a project of one's own, with its printed output; then the library installed. docs/testing.md:
an own BSDF, light and estimator under the laws, what failing laws print, and an own kernel in the benchmarks.
"""
import argparse
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NAME = re.compile(r"`(\w+\.(?:cpp|hpp|txt))`")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def blocks(page):
    """(language, text before the block, the block) of all blocks."""
    text, end = page.read_text(), 0
    for match in BLOCK.finditer(text):
        yield match[1], text[end:match.start()], match[2]
        end = match.end()


def run(commands, folder):
    """What a block of commands prints. The walk ends at the first that fails."""
    print("$ " + commands.strip().replace("\n", "\n$ "), flush=True)
    start = time.monotonic()
    done = subprocess.run(["sh", "-e", "-c", commands], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    lines = done.stdout.strip().split("\n")
    shown = lines if done.returncode else lines[-12:]
    print("\n".join(shown) + f"\n({time.monotonic() - start:.1f} s)\n", flush=True)
    if done.returncode:
        sys.exit(f"this exits with {done.returncode}")
    return done.stdout


def check_output(printed, documented):
    """The same words, and nine in ten numbers the same to 1 %: compilers round apart, and so choose among cells that are equally bad."""
    words, sought = NUMBER.sub("#", printed), NUMBER.sub("#", documented.strip())
    if sought not in words:
        sys.exit(f"the documentation has another output:\n{documented}")
    first = words[:words.index(sought)].count("#")
    pairs = list(zip(NUMBER.findall(printed)[first:], NUMBER.findall(documented)))
    same = sum(math.isclose(float(a), float(b), rel_tol=0.01, abs_tol=1e-6) for a, b in pairs)
    if same < 0.9 * len(pairs):
        sys.exit(f"the documentation has other numbers:\n{documented}")


def first_estimate(folder):
    """README.md: a program, its project, how to build it, and what it prints."""
    page = list(blocks(ROOT / "README.md"))
    program = next(block for language, _, block in page if language == "cpp" and "int main" in block)
    project = next(block for language, _, block in page if language == "cmake")
    commands = next(block for language, _, block in page if language == "sh" and "in your project" in block)
    output = next(block for language, _, block in page if language == "text")
    source = re.search(r"\w+\.cpp", project)[0]
    (folder / source).write_text(program)
    (folder / "CMakeLists.txt").write_text(project)
    in_project, in_lumis = commands.split("# in this folder", 1)
    check_output(run(in_project, folder), output)
    # The same commands, from and to folders that need no administrator.
    install = in_lumis.split("\n", 1)[1].replace("sudo ", "").replace("-S . -B build", "-S lumis -B installing")
    run(install.replace("--install build", "--install installing --prefix installed"), folder)


def own_tests(folder):
    """docs/testing.md, from its first block to its last."""
    name, printed = None, ""
    for language, before, block in blocks(ROOT / "docs/testing.md"):
        if language == "cmake":
            (folder / "CMakeLists.txt").write_text(block)
        elif language == "cpp":
            named = NAME.findall(before)
            name = named[-1] if named else name
            with open(folder / name, "a") as source:
                source.write(block + "\n")
        elif language == "sh":
            printed = run(block, folder)
        elif language == "text":
            check_output(printed, block)
    if "time_each" not in printed:
        sys.exit("no benchmark was run")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--compiler", default="g++")
    arguments = parser.parse_args()
    work = arguments.folder.resolve()
    shutil.rmtree(work, ignore_errors=True)
    for name, steps in ("first_estimate", first_estimate), ("test_your_own", own_tests):
        project = work / name
        project.mkdir(parents=True)
        (project / "lumis").symlink_to(ROOT, target_is_directory=True)
        os.environ |= {"CXX": arguments.compiler, "CMAKE_PREFIX_PATH": str(work / "first_estimate/installed")}
        steps(project)
    print("The walk ends well.")


if __name__ == "__main__":
    main()
