#!/usr/bin/python3
"""How much code a tick runs: instructions, and the cache lines and pages that they stand on.

What a tick costs that comes a millisecond after the latest one is not its instructions but what the caches have lost of
it by then. Needs valgrind (callgrind counts every instruction). A line counts where it is run in at least half of the
ticks.

SPDX-License-Identifier: MIT
"""
import argparse
import collections
import json
import os
import re
import subprocess
import sys
import tempfile

LINE, PAGE = 64, 4096
TICKS = 2000


def trace(tool, case, out):
    command = ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--compress-pos=no", "--compress-strings=no",
               "--toggle-collect=knurl_scene_tick", f"--callgrind-out-file={out}", tool, "bench", "--json", "--ticks",
               str(TICKS), "--case", case]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"lines.py: {case}: {(done.stderr.splitlines() or ['valgrind failed'])[-1]}")


def runs_of(out):
    """How often each instruction was run, by its address; what a call costs is its callee's."""
    runs = collections.Counter()
    is_call = False
    with open(out, encoding="utf-8") as file:
        for line in file:
            found = re.match(r"0x([0-9a-f]+) \S+ (\d+)$", line)
            if found and not is_call:
                runs[int(found[1], 16)] += int(found[2])
            is_call = line.startswith("calls=")
    return runs


def measure(tool, case):
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out")
        trace(tool, case, out)
        runs = runs_of(out)
    if not runs:
        sys.exit(f"lines.py: {case}: expected a case that ticks a scene, found no tick")
    ticks = collections.Counter(runs.values()).most_common(1)[0][0]  # most of a tick is run once in it
    usual = [address for address, count in runs.items() if 2 * count >= ticks]
    return {"case": case, "instructions": round(sum(runs.values()) / ticks),
            "code_lines": len({address // LINE for address in usual}),
            "code_pages": len({address // PAGE for address in usual})}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("tool", help="the knurl tool")
    parser.add_argument("case", nargs="+", help="cases of `knurl bench` that tick a scene warm, with one HIP")
    arguments = parser.parse_args()
    for case in arguments.case:
        print(json.dumps(measure(arguments.tool, case)), flush=True)


if __name__ == "__main__":
    main()
