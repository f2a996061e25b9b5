#!/usr/bin/python3
"""The memory that a tick touches: instructions, and the cache lines and pages of its code and data. A tick that runs a
millisecond after the previous one is slowed by cache misses, not by its instructions. Needs valgrind (lackey traces
every instruction, load and store) and nm. A line counts if at least half of the ticks touch it; data include the stack.

SPDX-License-Identifier: MIT
"""
import argparse
import collections
import json
import os
import re
import shutil
import subprocess
import sys

LINE, PAGE = 64, 4096
TICKS = 320  # the first ones, in which contact starts, do not count
BEGIN = 64


def symbols(tool):
    """(address, size) of the tick, and of the bench's function that calls it."""
    listed = subprocess.run(["nm", "-S", tool], capture_output=True, text=True, check=True).stdout
    found = {name: (int(at, 16), int(size, 16))
             for at, size, name in re.findall(r"^(\S+) (\S+) [tT] (knurl_scene_tick|tick_scene)$", listed, re.M)}
    if len(found) != 2:
        sys.exit(f"lines.py: {tool}: expected the symbols knurl_scene_tick and tick_scene, found {sorted(found)}")
    return found["knurl_scene_tick"], found["tick_scene"]


def ticks_of(tool, case):
    """For each tick: the number of instructions, and the lines of code and data that they touch, from a trace."""
    (entry, _), (caller, size) = symbols(tool)
    command = ["valgrind", "--tool=lackey", "--trace-mem=yes", "--basic-counts=no", "-v", "-v", tool, "bench", "--json",
               "--ticks", str(TICKS), "--case", case]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        first, is_tool, tick = "I  unknown", False, None
        for line in process.stderr:
            if tick is None and not line.startswith(first):
                if line.startswith("--"):  # the tool's load address
                    found = re.search(r"svma 0x([0-9a-f]+), avma 0x([0-9a-f]+)", line)
                    if found and is_tool:
                        bias = int(found[2], 16) - int(found[1], 16)
                        first, caller, is_tool = f"I  {entry + bias:08x},", caller + bias, False
                    is_tool = is_tool or line.endswith(f"Reading syms from {tool}\n")
                continue
            found = re.match(r" ?([ILSM]) +([0-9a-f]+),(\d+)$", line)
            if not found:
                continue
            address, length = int(found[2], 16), int(found[3])
            if tick is None:
                tick = {"instructions": 0, "code": set(), "data": set()}
            elif found[1] == "I" and caller <= address < caller + size:
                yield tick
                tick = None
                continue
            tick["instructions"] += found[1] == "I"
            tick["code" if found[1] == "I" else "data"].update({address // LINE, (address + length - 1) // LINE})
        if process.wait():
            sys.exit(f"lines.py: {case}: valgrind failed; run without this script: {' '.join(command)}")


def measure(tool, case):
    ticks = list(ticks_of(tool, case))[BEGIN:TICKS]  # batches follow
    if not ticks:
        sys.exit(f"lines.py: {case}: expected a case that ticks a scene, found no tick")
    row = {"case": case, "instructions": sorted(tick["instructions"] for tick in ticks)[len(ticks) // 2]}
    for kind in ("code", "data"):
        counts = collections.Counter(line for tick in ticks for line in tick[kind])
        usual = [line for line, count in counts.items() if 2 * count >= len(ticks)]
        row[f"{kind}_lines"] = len(usual)
        row[f"{kind}_pages"] = len({line * LINE // PAGE for line in usual})
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("tool", help="the knurl tool")
    parser.add_argument("case", nargs="+", help="cases of `knurl bench` that tick a scene warm, with one HIP")
    arguments = parser.parse_args()
    for needed in ("valgrind", "nm"):
        if not shutil.which(needed):
            sys.exit(f"lines.py: {needed} is missing: nothing was counted (Debian: apt install valgrind binutils)")
    for case in arguments.case:
        print(json.dumps(measure(os.path.realpath(arguments.tool), case)), flush=True)


if __name__ == "__main__":
    main()
