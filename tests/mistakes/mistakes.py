"""Compiles programs that are wrong, and checks that the compiler's first lines name the mistake.

    mistakes.py <compiler> <include folders...>

A mistake is what stands under `#ifdef NAME  // says: TEXT` (or `#ifndef`) in a program beside this script. The program
compiles without a warning as it is; with -D NAME it does not, and TEXT, a regular expression, is found in the first lines
printed. Under `clang++ says:` a mistake is one that only clang++ finds.
"""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

# g++ prints a candidate and why it was tried before it names the constraint that is not satisfied.
FIRST_LINES = 20
AT_LEAST = 20

compiler, *folders = sys.argv[1:]
is_clang = "clang" in subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout
programs = sorted(pathlib.Path(__file__).parent.glob("*.cpp"))


def compiled(program, *options):
    command = [compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", *options,
               *(f"-I{folder}" for folder in folders), str(program)]
    environment = os.environ | {"LC_ALL": "C"}
    return subprocess.run(command, capture_output=True, text=True, env=environment)


def check_right(program):
    run = compiled(program)
    return None if run.returncode == 0 else f"{program.name} does not compile as it is:\n{run.stderr}"


def check_wrong(program, name, text):
    run = compiled(program, f"-D{name}")
    if not re.search(text, run.stderr):
        run = compiled(program, f"-D{name}")  # g++ 12 was seen to forget a specialisation, once in hundreds of times
    first = "\n".join(run.stderr.splitlines()[:FIRST_LINES])
    if run.returncode == 0:
        return f"{program.name}: {name} compiles"
    if not re.search(text, first):
        return f"{program.name}: {name} is not told by '{text}' but by\n{first}"
    return None


with concurrent.futures.ThreadPoolExecutor(2) as pool:
    checks = [pool.submit(check_right, program) for program in programs]
    for program in programs:
        mistakes = re.findall(r"^#ifn?def (\w+)  // (clang\+\+ )?says: (.+)$", program.read_text(), re.MULTILINE)
        checks += [pool.submit(check_wrong, program, name, text) for name, only_clang, text in mistakes
                   if is_clang or not only_clang]
    failures = [failure for check in checks if (failure := check.result())]

number = len(checks) - len(programs)
print("\n\n".join(failures) or f"{compiler} names all of {number} mistakes.")
sys.exit(1 if failures or number < AT_LEAST else 0)
