#!/usr/bin/env python3
"""Every source is an error if another build system compiles it without IEEE arithmetic.

usage: refused.py SOURCE C_COMPILER CXX_COMPILER

Nor does one use isfinite(), which -ffinite-math-only takes away. Preprocesses only: sources for another system, or whose
libraries are not there, count too. SPDX-License-Identifier: MIT
"""
import glob
import os
import platform
import subprocess
import sys

SENTENCE = "Knurl must be compiled with"
X86 = platform.machine().lower() in ("x86_64", "amd64")
REFUSED = ["-ffast-math", "-Ofast", "-ffinite-math-only"] + (["-mfpmath=387"] if X86 else [])
# Not every compiler defines macros for these.
PARTS = ["-funsafe-math-optimizations", "-freciprocal-math", "-fassociative-math -fno-signed-zeros -fno-trapping-math"]
ALLOWED = ["", "-O3 -march=native", "-ffast-math -fno-fast-math"] + (["-mfpmath=387 -mfpmath=sse"] if X86 else [])


def messages(compiler, source, path, flags):
    standard = "-std=c99" if path.endswith(".c") else "-std=c++17"
    command = [compiler, *flags.split(), standard, "-E", "-o", os.devnull, f"-I{source}/sdk/include",
               f"-I{source}/sdk/src", path]
    return subprocess.run(command, capture_output=True, text=True).stderr


def main():
    source, c, cxx = sys.argv[1:]
    paths = sorted(glob.glob(f"{source}/sdk/src/**/*.c", recursive=True) +
                   glob.glob(f"{source}/sdk/src/**/*.cpp", recursive=True))
    failures = []
    for path in paths:
        if SENTENCE not in messages(c if path.endswith(".c") else cxx, source, path, "-ffast-math"):
            failures.append(f"{path}: expected a refusal of -ffast-math, found none (include base/finite.h)")
        with open(path, encoding="utf-8") as file:
            if "isfinite(" in file.read():
                failures.append(f"{path}: expected knurl_is_finite(), found isfinite()")
    tick = f"{source}/sdk/src/scene/tick.c"
    macros = subprocess.run([c, "-ffast-math", "-dM", "-E", "-x", "c", os.devnull], capture_output=True, text=True).stdout
    for flags in REFUSED + (PARTS if "__ASSOCIATIVE_MATH__" in macros else []):
        if SENTENCE not in messages(c, source, tick, flags):
            failures.append(f"{tick}: expected a refusal of {flags}, found none")
    for flags in ALLOWED:
        if SENTENCE in messages(c, source, tick, flags):
            failures.append(f"{tick}: expected no refusal of '{flags}', found one")
    print(f"refused: {len(paths)} sources", *failures, sep="\n")
    sys.exit(bool(failures or not paths))


if __name__ == "__main__":
    main()
