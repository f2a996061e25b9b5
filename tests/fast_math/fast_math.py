#!/usr/bin/env python3
"""Builds Knurl as a part of a host whose flags undo IEEE arithmetic, and holds its results against a plain build's.

usage: fast_math.py SOURCE BUILD PLAIN_HOST C_COMPILER CXX_COMPILER GENERATOR

SOURCE: Knurl's; BUILD: a folder for the host, kept for the next time; PLAIN_HOST: host/host.c, built without such flags.
Exit 0, or 1 with the differences. SPDX-License-Identifier: MIT
"""
import os
import platform
import subprocess
import sys

X86 = platform.machine().lower() in ("x86_64", "amd64", "i686", "i386")
# One build holds all of them: x87's registers are wider than a double (FLT_EVAL_METHOD 2).
FLAGS = "-Ofast -ffast-math" + (" -mfpmath=387" if X86 else "")
SHOWN = 5


def call(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"fast_math: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")


def build(source, folder, c, cxx, generator):
    call(["cmake", "-S", os.path.join(source, "tests/fast_math/host"), "-B", folder, "-G", generator,
          f"-DKNURL_SOURCE={source}", f"-DCMAKE_C_COMPILER={c}", f"-DCMAKE_CXX_COMPILER={cxx}",
          f"-DCMAKE_C_FLAGS={FLAGS}", f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DCMAKE_BUILD_TYPE="])
    call(["cmake", "--build", folder, "--target", "host"])


def results(host):
    done = subprocess.run([host], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"fast_math: {host}: exit {done.returncode}: {done.stderr}")
    return done.stdout.splitlines(), done.stderr


def not_finite(lines):
    """How many force components are no finite numbers, and of how many."""
    words = [word for line in lines if line.startswith("force") for word in line.split(": ")[1].split()[1:4]]
    return sum(int(word, 16) >> 52 & 0x7ff == 0x7ff for word in words), len(words)


def main():
    source, folder, plain_host, c, cxx, generator = sys.argv[1:]
    build(source, folder, c, cxx, generator)
    plain, plain_notes = results(plain_host)
    fast, fast_notes = results(os.path.join(folder, "host"))
    bad, count = not_finite(fast)
    differing = [(a, b) for a, b in zip(plain, fast) if a != b]
    print(f"fast_math: {FLAGS}: {len(differing)} of {len(plain)} results differ; {bad} of {count} force components are "
          f"not finite (plain: {not_finite(plain)[0]}); {fast_notes.strip()} (plain: {plain_notes.strip()})")
    for a, b in differing[:SHOWN]:
        print(f"  plain: {a}\n  host:  {b}")
    if X86 and "flushed" not in fast_notes:
        sys.exit("fast_math: expected a host that flushes subnormal numbers to 0, which is part of what is held here")
    if len(plain) != len(fast) or differing or bad or not_finite(plain)[0]:
        sys.exit(1)


if __name__ == "__main__":
    main()
