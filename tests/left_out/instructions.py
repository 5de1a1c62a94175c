"""Counts the instructions of estimates under callgrind: the library's against the same written by hand.

    instructions.py <valgrind> <program of estimators.cpp>
    instructions.py --skip <reason>
"""
import pathlib
import re
import subprocess
import sys
import tempfile

SKIPPED = 77
SAMPLES = 2000  # as in estimators.cpp

# By how much ours may exceed what is written by hand. Where counts and the exponent are known only at run time, ours
# asks whether a count is 0 and the exponent 2, which what is written by hand does not.
LIMITS = {"one": 0.02, "two": 0.05, "one_n": 0.02, "two_n": 0.10}

if sys.argv[1] == "--skip":
    print("Skipped:", sys.argv[2])
    sys.exit(SKIPPED)
valgrind, program = sys.argv[1:]

with tempfile.TemporaryDirectory() as folder:
    command = [valgrind, "--tool=callgrind", f"--callgrind-out-file={folder}/dump", program]
    run = subprocess.run(command, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(run.stdout + run.stderr)
    counts = {}
    for dump in pathlib.Path(folder).iterdir():
        text = dump.read_text()
        request = re.search(r"^desc: Trigger: Client Request: (\w+) (.+)$", text, re.MULTILINE)
        if request:
            total = int(re.search(r"^summary: (\d+)$", text, re.MULTILINE)[1])
            counts.setdefault(request[2], {})[request[1]] = total / SAMPLES

times = dict(line.split() for line in subprocess.run([program], capture_output=True, text=True, check=True).stdout.splitlines())

print(f"{'instructions a sample':50}    ours by hand    ratio  limit  (time)")
failed = len(counts) < 30
for name, count in sorted(counts.items()):
    ratio, limit = count["ours"] / count["by_hand"], 1 + LIMITS[name.split("/")[0]]
    fine = 0 < ratio <= limit
    failed |= not fine
    print(f"{name:50}{count['ours']:8.1f}{count['by_hand']:8.1f}{ratio:9.3f}{limit:7.2f}  ({times[name]})"
          + ("" if fine else "  TOO MANY"))
sys.exit(1 if failed else 0)
