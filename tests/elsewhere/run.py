#!/usr/bin/env python3
"""Tries the headers with other compilers, flags and machines than the tests do, as far as these are installed.

    tests/elsewhere/run.py               every place; prints a table
    tests/elsewhere/run.py --list
    tests/elsewhere/run.py NAME...       some of them; exits with 77 if all of those had to be skipped

docs/platforms.md names the packages and keeps the results.
"""
import argparse
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
WARNINGS = ["-Wall", "-Wextra", "-Wconversion", "-Wshadow", "-Werror"]
BASE = ["-std=c++20", f"-I{ROOT / 'include'}"]
HEADERS = sorted(path.relative_to(ROOT / "include").as_posix() for path in (ROOT / "include").rglob("*.hpp"))


class Skipped(Exception):
    pass


class Failed(Exception):
    pass


def run(command, expected=0, **options):
    """What a command prints. Fails unless it exits as expected."""
    if shutil.which(command[0]) is None:
        raise Skipped(f"{command[0]} is not installed")
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", timeout=900, **options)
    if done.returncode != expected:
        raise Failed(f"{' '.join(map(str, command))}\nexits with {done.returncode}, not {expected}\n{done.stdout[:4000]}")
    return done.stdout


def compiles_here(compiler, folder, *flags):
    """Skips where the compiler's own library is missing."""
    source = folder / "hello.cpp"
    source.write_text("#include <vector>\n#include <glm/vec3.hpp>\nint main() {}\n")
    try:
        run([*compiler, *flags, "-std=c++20", *other_packages(folder), "-c", source, "-o", folder / "unused.o"])
    except Failed as failure:
        raise Skipped("its standard library is not installed: " + " ".join(compiler + list(flags))) from failure


def other_packages(folder):
    """GLM and Boost alone, for compilers that do not look into the system's folder."""
    inside = folder / "packages"
    if not inside.exists():
        inside.mkdir()
        for name in ("glm", "boost"):
            for place in (os.environ.get("LUMIS_PACKAGES", ""), "/usr/include", "/usr/local/include"):
                if place and (pathlib.Path(place) / name).is_dir():
                    (inside / name).symlink_to(pathlib.Path(place) / name)
                    break
            else:
                raise Skipped(f"{name} is not installed")
    return ["-isystem", inside]


def every_header(folder, before="", testing=True):
    source = folder / "every_header.cpp"
    headers = [header for header in HEADERS if testing or not header.startswith("lumis/testing/")]
    source.write_text(before + "".join(f"#include <{header}>\n" for header in headers))
    return source


def includes_of_others():
    """What the headers include of others than Lumis."""
    found = set()
    for header in HEADERS:
        found.update(re.findall(r"^#include <[^>]+>", (ROOT / "include" / header).read_text(), re.M))
    return "".join(f"{line}\n" for line in sorted(found))


@dataclasses.dataclass
class Place:
    """A compiler and its flags. With a runner, check.cpp is built and run as well."""
    name: str
    compiler: list
    flags: list = dataclasses.field(default_factory=list)
    runner: list = None
    link: list = dataclasses.field(default_factory=list)
    program: str = "check"
    testing: bool = True  # Boost asks for threads

    def attempt(self, folder):
        compiles_here(self.compiler, folder, *self.flags)
        common = [*self.compiler, *self.flags, *BASE, *other_packages(folder)]
        source = every_header(folder, testing=self.testing)
        run([*common, *WARNINGS, "-c", source, "-o", folder / "unused.o"])  # ziglang has no -fsyntax-only
        if self.runner is None:
            return "compiles"
        program = folder / self.program
        run([*common, "-O1", HERE / "check.cpp", "-o", program, *self.link])
        if self.runner and shutil.which(self.runner[0]) is None:
            return f"compiles; not run: {self.runner[0]} is not installed"
        environment = {**os.environ, "WINEDEBUG": "-all", "WINEPREFIX": str(folder / "wine")}
        return "runs: " + run([*self.runner, program], env=environment).strip().splitlines()[-1]


@dataclasses.dataclass
class WindowsNames:
    name: str
    compiler: list

    def attempt(self, folder):
        before = includes_of_others() + f'#include "{HERE / "windows_names.hpp"}"\n'
        run([*self.compiler, *BASE, *WARNINGS, "-fsyntax-only", every_header(folder, before)])
        return "compiles"


@dataclasses.dataclass
class HostMacros:
    """Macros that hosts have, defined before everything else: they mean the same afterwards."""
    name: str
    compiler: list

    def attempt(self, folder):
        header = folder / "one" / "lumis" / "lumis.hpp"
        run([sys.executable, ROOT / "cmake" / "single_header.py", header])
        for include in (ROOT / "include", header.parent.parent):
            batch = ["-DBATCH"] if (include / "lumis" / "batch").exists() else []
            for macros in ("OBJECTS", "FUNCTIONS"):
                run([*self.compiler, BASE[0], f"-I{include}", *batch, f"-D{macros}", "-fsyntax-only", HERE / "host_macros.cpp"])
        return "compiles"


@dataclasses.dataclass
class FirstEstimate:
    """The first example prints what it should with each of these lists of flags."""
    name: str
    compiler: list
    variants: list

    def attempt(self, folder):
        for flags in self.variants:
            compiles_here(self.compiler, folder, *flags)
            program = folder / "first_estimate"
            run([*self.compiler, *BASE, *flags, ROOT / "examples" / "01_first_estimate.cpp", "-o", program])
            printed = run([program])
            if printed != (ROOT / "examples" / "01_first_estimate.txt").read_text():
                raise Failed(f"With {' '.join(flags)} it prints {printed}")
        return f"runs with {len(self.variants)} sets of flags"


@dataclasses.dataclass
class WithoutExceptions:
    name: str
    compiler: list

    def attempt(self, folder):
        flags = ["-fno-exceptions", "-fno-rtti"]
        run([*self.compiler, *flags, *BASE, *WARNINGS, "-fsyntax-only", every_header(folder)])
        aborts, handles = folder / "aborts", folder / "handles"
        run([*self.compiler, *flags, *BASE, *WARNINGS, HERE / "refusal.cpp", "-o", aborts])
        printed = run([aborts], expected=-6)
        if "weight 2 is -3" not in printed:
            raise Failed(f"The message says nothing of the weight: {printed}")
        for own in ([], flags):
            run([*self.compiler, *own, *BASE, *WARNINGS, "-DOWN_HANDLER", HERE / "refusal.cpp", "-o", handles])
            printed = run([handles], expected=3)
            if "handled: lumis: weight 2 is -3" not in printed:
                raise Failed(f"The host's own handler did not get the message: {printed}")
        return "aborts with the message; a host's handler gets it"


@dataclasses.dataclass
class Dispatch:
    """Two files for two kinds of processors share no function of Lumis, and the narrow one runs on an old processor."""
    name: str
    compiler: list

    def attempt(self, folder):
        for header in HEADERS:
            if header == "lumis/core/detail/isa.hpp":  # which makes the name
                continue
            text = (ROOT / "include" / header).read_text()
            outside = re.findall(r"^namespace lumis(?!::LUMIS_ISA).*", text, re.M)
            if outside or ("LUMIS_ISA" in text and "platform.hpp" not in text + header):
                raise Failed(f"{header} is not in the inline namespace, or includes no platform.hpp: {outside}")
        sources = HERE / "dispatch"
        results = []
        for level in ("-O0", "-O2"):
            objects = {}
            for function, flags in (("narrow", []), ("wide", ["-mavx2", "-mfma"])):
                objects[function] = folder / f"{function}.o"
                run([*self.compiler, *flags, level, *BASE, *WARNINGS, f"-DFUNCTION={function}", "-c",
                     sources / "kernels.cpp", "-o", objects[function]])
            shared = self.defined(objects["narrow"]) & self.defined(objects["wide"])
            if not shared:
                raise Failed("The two files share no symbol at all: nm is not understood")
            names = run(["c++filt", *sorted(shared)]).splitlines()
            ours = [name for name in names if "lumis" in name]
            if ours:
                raise Failed(f"{len(ours)} symbols are shared:\n" + "\n".join(ours[:20]))
            program = folder / "dispatch"
            # The file for the oldest processor comes first: of a function that both have, the first one is linked.
            run([*self.compiler, level, sources / "main.cpp", objects["narrow"], objects["wide"], "-o", program])
            results.append(run([program]).split()[0])
            results.append(run([program, "narrow"]).split()[0])
            if shutil.which("qemu-x86_64"):
                printed = run(["qemu-x86_64", "-cpu", "Nehalem", program])
                if not printed.startswith("narrow"):
                    raise Failed(f"An old processor runs the wrong kernels: {printed}")
                results.append("narrow on Nehalem")
        return ", ".join(results) + ("" if shutil.which("qemu-x86_64") else "; qemu-x86_64 is not installed")

    @staticmethod
    def defined(object_file):
        """Names of functions and variables that other files see."""
        lines = run(["nm", "--defined-only", "--extern-only", object_file]).splitlines()
        return {line.split()[2] for line in lines if len(line.split()) == 3}


@dataclasses.dataclass
class SingleHeader:
    name: str
    compiler: list

    def attempt(self, folder):
        header = folder / "one" / "lumis" / "lumis.hpp"
        run([sys.executable, ROOT / "cmake" / "single_header.py", header])
        source = folder / "single.cpp"
        source.write_text("#include <lumis/lumis.hpp>\n#include <lumis/lumis.hpp>\nlumis::NativeLanes<float> lanes;\n")
        run([*self.compiler, "-std=c++20", f"-I{header.parent.parent}", *WARNINGS, "-fsyntax-only", source])
        return "compiles"


@dataclasses.dataclass
class OlderStandard:
    """Below C++20 one error says so and another one ends the compilation, whichever header comes first."""
    name: str
    compiler: list
    every: bool  # each header, or those that most hosts include

    def attempt(self, folder):
        anything = {"lumis/core/assert.hpp", "lumis/core/detail/isa.hpp", "lumis/version.hpp"}  # C++17 will do
        parsed = {"lumis/lumis.hpp", "lumis/batch/batch.hpp", "lumis/core/platform.hpp", "lumis/testing/laws.hpp"}
        headers = sorted(set(HEADERS) - anything) if self.every else sorted(parsed)
        for header in headers:
            source = folder / "older.cpp"
            source.write_text(f"#include <{header}>\n")
            # What comes before the error is other packages' headers: the preprocessor finds it as well, and sooner.
            flags = ["-fsyntax-only"] if header in parsed else ["-E", "-o", os.devnull]
            printed = run([*self.compiler, "-std=c++17", BASE[1], *flags, source], expected=1)
            errors = [line for line in printed.splitlines() if "error: " in line]
            if len(errors) != 2 or "Lumis is written in C++20" not in errors[0]:
                raise Failed(f"<{header}> in C++17 has {len(errors)} errors, the first {errors[:1]}")
        return f"says so in {len(headers)} headers"


def glm_forced(*names):
    return [f"-DGLM_FORCE_{name}" for name in names]


# XYZW_ONLY leaves no room for SWIZZLE.
GLM_TOGETHER = [glm_forced("XYZW_ONLY", "EXPLICIT_CTOR", "DEFAULT_ALIGNED_GENTYPES", "INTRINSICS", "SIZE_T_LENGTH", "CTOR_INIT"),
                glm_forced("SWIZZLE")]
GLM_ALONE = [glm_forced(name) for name in ("XYZW_ONLY", "EXPLICIT_CTOR", "DEFAULT_ALIGNED_GENTYPES", "INTRINSICS", "SWIZZLE",
                                           "SIZE_T_LENGTH", "CTOR_INIT")]
ZIG = ["python3", "-m", "ziglang", "c++"]
PLACES = [
    WindowsNames("windows-names", ["g++"]),
    WithoutExceptions("without-exceptions/g++", ["g++"]),
    WithoutExceptions("without-exceptions/clang++", ["clang++"]),
    Dispatch("dispatch/g++", ["g++"]),
    Dispatch("dispatch/clang++", ["clang++"]),
    SingleHeader("single-header/g++", ["g++"]),
    SingleHeader("single-header/clang++", ["clang++"]),
    OlderStandard("older-standard/g++", ["g++"], True),
    OlderStandard("older-standard/clang++", ["clang++"], False),
    HostMacros("host-macros/g++", ["g++"]),
    HostMacros("host-macros/clang++", ["clang++"]),
    FirstEstimate("glm-macros/g++", ["g++"], GLM_TOGETHER),
    FirstEstimate("glm-macros/clang++", ["clang++"], GLM_TOGETHER),
    FirstEstimate("glm-macros/alone/g++", ["g++"], GLM_ALONE),
    FirstEstimate("glm-macros/alone/clang++", ["clang++"], GLM_ALONE),
    FirstEstimate("newer-standard/g++", ["g++"], [["-std=c++23"]]),
    FirstEstimate("newer-standard/libc++", ["clang++"], [["-std=c++2b", "-stdlib=libc++"]]),
    Place("no-vectors", ["g++"], ["-DLUMIS_NO_VECTORS"], []),
    Place("avx512/g++", ["g++"], ["-march=x86-64-v4"],
          [] if "avx512bw" in pathlib.Path("/proc/cpuinfo").read_text() else None),
    Place("avx512/clang++", ["clang++"], ["-march=x86-64-v4"],
          [] if "avx512bw" in pathlib.Path("/proc/cpuinfo").read_text() else None),
    Place("ms-compatibility", ["clang++"], ["-fms-compatibility", "-fms-extensions",
                                            "-fms-compatibility-version=19.35", "-stdlib=libc++"]),
    Place("libc++", ["clang++"], ["-stdlib=libc++"], []),
    Place("clang++-19", ["clang++-19"], ["-Wno-deprecated-declarations"], []),
    Place("mingw", ["x86_64-w64-mingw32-g++-posix"], ["-static"], ["/usr/lib/wine/wine64"], program="check.exe"),
    Place("aarch64", ["aarch64-linux-gnu-g++"], ["-static"], ["qemu-aarch64"]),
    Place("i686", ["i686-linux-gnu-g++"], ["-msse2", "-mfpmath=sse", "-static"], ["qemu-i386"]),
    # From the PyPI package ziglang: a newer clang++ with its own libc++, and libraries for many systems.
    Place("ziglang", [*ZIG, "-target", "x86_64-linux-gnu.2.31"], ["-fno-sanitize=all"], []),
    Place("ziglang/wasm", [*ZIG, "-target", "wasm32-wasi"], ["-msimd128", "-fno-exceptions"], testing=False),
    Place("ziglang/riscv64", [*ZIG, "-target", "riscv64-linux-musl"]),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--list", action="store_true")
    arguments = parser.parse_args()
    if arguments.list:
        print("\n".join(place.name for place in PLACES))
        return 0
    unknown = set(arguments.names) - {place.name for place in PLACES}
    if unknown:
        parser.error(f"no such place: {', '.join(sorted(unknown))}")
    outcomes = []
    for place in PLACES:
        if arguments.names and place.name not in arguments.names:
            continue
        start = time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            try:
                kind, what = "ok", place.attempt(pathlib.Path(folder))
            except Skipped as reason:
                kind, what = "skipped", str(reason)
            except (Failed, subprocess.TimeoutExpired) as failure:
                kind, what = "FAILED", str(failure)
        outcomes.append(kind)
        print(f"{place.name:28} {kind:8} {time.monotonic() - start:5.0f} s   {what}", flush=True)
    if "FAILED" in outcomes:
        return 1
    return 77 if set(outcomes) == {"skipped"} else 0


if __name__ == "__main__":
    sys.exit(main())
