#!/usr/bin/env python3
"""Compiles the kernels beside this script for CUDA devices, without a warning, and runs them where there is a device.

    compile.py --folder <for results> --include <folders...> [--install]

The compiler is the nvcc on the PATH, the one named by NVCC, or, with --install, one from PyPI in a virtual environment in
the folder (200 MB). Exits with 77 where there is none. Code is made for the architectures below, as far as nvcc knows them,
and for the least that it knows: CUDA 12 was the last with sm_70.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
import venv
from pathlib import Path

SKIPPED = 77
ARCHITECTURES = {70, 90}
PACKAGES = ["nvidia-cuda-nvcc", "nvidia-cuda-runtime", "nvidia-cuda-cccl"]  # and what they need

# --expt-relaxed-constexpr: kernels use what is constexpr in the standard library (std::array, std::span, numeric_limits).
# -fmad=false: products are not fused into sums, so that results can be compared with the host's.
FLAGS = ["-std=c++20", "--expt-relaxed-constexpr", "-fmad=false", "-Werror", "all-warnings", "-Xcompiler", "-Wall,-Wextra"]


def find_nvcc(folder, install):
    """The path of nvcc and the options that it needs, or None."""
    found = os.environ.get("NVCC") or shutil.which("nvcc")
    if found:
        return found, []
    environment = folder / "cuda"
    if install:
        if not environment.exists():
            venv.create(environment, with_pip=True)
        pip = [environment / "bin" / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        if subprocess.run([*pip, *PACKAGES]).returncode != 0:
            return None
    # nvidia/cu13/bin/nvcc beside include, lib and nvvm
    for candidate in sorted(environment.glob("lib/python3*/site-packages/nvidia/*/bin/nvcc")):
        return candidate, ["-L", candidate.parent.parent / "lib"]
    return None


def architectures(nvcc):
    """The wanted architectures that nvcc has, with its least one."""
    listed = subprocess.run([nvcc, "--list-gpu-arch"], capture_output=True, text=True, check=True).stdout
    known = {int(number) for number in re.findall(r"compute_(\d+)$", listed, re.MULTILINE)}
    missing = ARCHITECTURES - known
    if missing:
        print(f"This nvcc does not know sm_{', sm_'.join(map(str, sorted(missing)))}: its least is sm_{min(known)}.")
    return sorted((ARCHITECTURES & known) | {min(known)})


def check(nvcc, options, source, arguments, targets):
    """Compiles a program, runs it, and says whether both succeeded."""
    program = arguments.folder / source.stem
    code = [f"-gencode=arch=compute_{target},code=compute_{target}" for target in targets]
    folders = [option for folder in arguments.include for option in ("-I", folder)]
    start = time.monotonic()
    if subprocess.run([nvcc, *FLAGS, *options, *code, *folders, source, "-o", program]).returncode != 0:
        print(f"{source.name} does not compile without warnings.")
        return False
    print(f"{source.name}: compiled for {', '.join(f'sm_{target}' for target in targets)} "
          f"in {time.monotonic() - start:.0f} s", flush=True)
    status = subprocess.run([program]).returncode
    if status not in (0, SKIPPED):
        print(f"{source.name} fails ({status}).")
    return status in (0, SKIPPED)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--include", type=Path, nargs="+", required=True)
    parser.add_argument("--install", action="store_true")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    found = find_nvcc(arguments.folder, arguments.install)
    if not found:
        print(f"There is no nvcc: kernels are not compiled. --install takes it from PyPI ({', '.join(PACKAGES)}).")
        return SKIPPED
    nvcc, options = found
    targets = architectures(nvcc)
    sources = sorted(Path(__file__).parent.glob("*.cu"))
    good = [check(nvcc, options, source, arguments, targets) for source in sources]
    return 0 if good and all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
