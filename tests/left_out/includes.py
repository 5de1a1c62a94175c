"""Checks what each header includes, directly or not, by the preprocessor's own account.

    includes.py <compiler> <include folder>

Rooms see each other one way, and a user who includes one strategy does not get another: what a user may include stands in
the room, what only serves it in the room's detail/.
"""
import pathlib
import re
import subprocess
import sys

compiler, root = sys.argv[1], pathlib.Path(sys.argv[2])

# What a room's headers may reach besides their own room.
SCATTERING = ["core/", "tables/", "directions/", "microfacets/"]
ROOMS = {
    "core": [],
    "tables": ["core/"],
    "directions": ["core/"],
    "microfacets": ["core/"],
    "lights": SCATTERING,
    "combine": [*SCATTERING, "lights/"],
    "batch": [*SCATTERING, "lights/", "combine/"],
    "qmc": ["core/"],
    "statistics": ["core/"],
    "testing": [*SCATTERING, "lights/", "combine/", "batch/", "statistics/"],
    "fwd.hpp": ["core/platform", "core/scalar", "core/detail/isa"],  # no GLM
}
STRATEGIES = ("tables/", "directions/", "microfacets/", "lights/")
# Headers that are built upon a strategy, or upon a surface or shape that users include as well.
BUILT_UPON = [
    (r"microfacets/(detail/)?ggx_\w+", r"microfacets/(ggx|ggx_vndf|reflected)"),
    (r"microfacets/(detail/|ggx_|smooth_)dielectric\w*", r"microfacets/(fresnel|transport_mode|ggx_reflection)"),
    (r"lights/(detail/\w+|area_light\w*|image_light|light_bounds|light_tree|surface\w*|pdf_from_hit)",
     r"lights/(shapes|surface)"),
    (r"lights/(light_tree|detail/(light_\w+|normal_cone))", r"lights/light_bounds"),
    (r"lights/area_light_by_solid_angle", r"lights/area_light"),
    (r"lights/(area_light_by_cosine|surface_light|pdf_from_hit|detail/hit_density)",
     r"lights/area_light(_by_solid_angle)?"),
    (r"lights/surface_area", r"directions/cosine_hemisphere"),
    (r"lights/light_set", r"tables/alias_table"),
    (r"lights/image_light", r"tables/piecewise_constant"),
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
named = re.findall(r'#include "lumis/(.+)"', (root / "lumis/lumis.hpp").read_text())
wrong = [f"lumis.hpp includes {name}: no user may" for name in named if "/detail/" in name]

for name, included in headers.items():
    room = name.split("/")[0]
    for other in sorted(included):
        if not other.startswith((room + "/", *ROOMS[room])):
            wrong.append(f"{name} includes {other}: {room}/ does not see it")
        if (room + "/").startswith((*STRATEGIES, "combine/")) and other.startswith(STRATEGIES) and "/detail/" not in other:
            pair = name.removesuffix(".hpp"), other.removesuffix(".hpp")
            if not any(re.fullmatch(a, pair[0]) and re.fullmatch(b, pair[1]) for a, b in BUILT_UPON):
                wrong.append(f"{name} includes {other}: who wants the one gets the other")
    by_name = room in ("batch", "qmc", "testing")
    if by_name and name in all_of_it:
        wrong.append(f"lumis.hpp includes {name}, which is included by name")
    if not by_name and name not in all_of_it and not any(name in headers[other] for other in headers):
        wrong.append(f"lumis.hpp does not include {name}")

# What fwd.hpp declares is defined somewhere; lumis.hpp, which includes both, would not compile if they did not agree.
declaration = re.compile(r"^(?:class|struct|enum class) (\w+)(?:<.*>)?(?: final)?(;| |$)", re.MULTILINE)
declared = [name for name, end in declaration.findall((root / "lumis/fwd.hpp").read_text()) if end == ";"]
defined = {
    name for header in headers for name, end in declaration.findall((root / "lumis" / header).read_text()) if end != ";"
}
wrong += [f"fwd.hpp declares {name}, which no header defines" for name in declared if name not in defined]

print("\n".join(wrong) or f"{len(headers)} headers include {sum(map(len, headers.values()))} others, all as they may.")
sys.exit(1 if wrong or len(headers) < 40 or len(declared) < 50 else 0)
