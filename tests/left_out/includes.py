"""Checks what each header includes, directly or not, by the preprocessor's own account.

    includes.py <compiler> <include folder>

Folders see each other one way, and a user who includes one strategy does not get another: what lumis.hpp names is included
by users, what it does not name in strategies/ is a part that several share.
"""
import pathlib
import re
import subprocess
import sys

compiler, root = sys.argv[1], pathlib.Path(sys.argv[2])

# What a folder's headers may reach besides their own folder.
FOLDERS = {
    "core": [],
    "strategies": ["core/"],
    "combine": ["core/", "strategies/"],
    "batch": ["core/", "strategies/", "combine/"],
    "statistics": ["core/"],
    "testing": ["core/", "strategies/", "combine/", "batch/", "statistics/"],
}
# Headers that are built upon a strategy, or upon a surface or shape that users include as well.
BUILT_UPON = [
    (r"strategies/ggx_\w+", r"strategies/ggx"),
    (r"combine/ggx_\w+", r"strategies/ggx(_vndf)?"),
    (r"strategies/area_light_by_solid_angle", r"strategies/area_light"),
    (r"combine/light_set", r"strategies/alias_table"),
]


def reached(header):
    """Every header of ours that this one includes. The rest is not looked for, which takes no time."""
    command = [compiler, "-std=c++20", "-x", "c++", "-MM", "-MG", "-nostdinc", "-nostdinc++", f"-I{root}", str(header)]
    rule = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    prefix = f"{root}/lumis/"
    return {word.removeprefix(prefix) for word in rule.split() if word.startswith(prefix)} - {name_of(header)}


def name_of(header):
    return header.relative_to(root / "lumis").as_posix()


headers = {name_of(path): reached(path) for path in sorted((root / "lumis").rglob("*.hpp"))}
all_of_it = headers.pop("lumis.hpp")
named = set(re.findall(r'#include "lumis/(.+)"', (root / "lumis/lumis.hpp").read_text()))
wrong = []

for name, included in headers.items():
    folder = name.split("/")[0]
    for other in sorted(included):
        if not other.startswith((folder + "/", *FOLDERS[folder])):
            wrong.append(f"{name} includes {other}: {folder}/ does not see it")
        if folder in ("strategies", "combine") and other in named and other.startswith("strategies/"):
            pair = name.removesuffix(".hpp"), other.removesuffix(".hpp")
            if not any(re.fullmatch(a, pair[0]) and re.fullmatch(b, pair[1]) for a, b in BUILT_UPON):
                wrong.append(f"{name} includes {other}: who wants the one gets the other")
    by_name = folder in ("batch", "testing")
    if by_name and name in all_of_it:
        wrong.append(f"lumis.hpp includes {name}, which is included by name")
    if not by_name and name not in all_of_it and not any(name in headers[other] for other in headers):
        wrong.append(f"lumis.hpp does not include {name}")

print("\n".join(wrong) or f"{len(headers)} headers include {sum(map(len, headers.values()))} others, all as they may.")
sys.exit(1 if wrong or len(headers) < 40 else 0)
