#!/usr/bin/python3
"""Builds the library by other compilers, at other levels and for other machines, and compares hashes of its results
(hashes.c) with those of the first build. A compiler or an emulator that is missing is named and left out.
usage: same_numbers.py SOURCE FOLDER C_COMPILER [NAME...]     NAME: these builds alone; FOLDER is kept for the next time
SPDX-License-Identifier: MIT"""
import os
import shutil
import subprocess
import sys

SOURCE, FOLDER, CC, *NAMES = sys.argv[1:]

# Name: compiler, options, and further settings: CMake's processor, and its emulator.
BUILDS = {
    "O3": (CC, "-O3"),
    "O0": (CC, "-O0"),
    "O2": (CC, "-O2"),
    "v3": (CC, "-O3 -march=x86-64-v3"),
    "lto": (CC, "-O2 -flto"),
    "clang": ("clang", "-O2"),
    "aarch64": ("aarch64-linux-gnu-gcc", "-O2", "aarch64", "qemu-aarch64"),
    "armhf": ("arm-linux-gnueabihf-gcc", "-O2", "arm", "qemu-arm"),
}

# A surface that rotates calls the C library's sin() and cos(), whose last bit differs on a CPU without FMA. The first
# build, with FMA disabled by glibc's tunables, gives the same results as these.
WITHOUT_FMA = ("armhf",)
NO_FMA = {"GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}


def run(*command, env=None):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          env={**os.environ, **(env or {})})
    if done.returncode != 0:
        sys.exit(f"same_numbers: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def hashes(name, compiler, options, machine=None, emulator=None):
    """Builds and runs; returns the lines, and those without FMA (the same under an emulator)."""
    build = os.path.join(FOLDER, name)
    target = ["-DCMAKE_SYSTEM_NAME=Linux", f"-DCMAKE_SYSTEM_PROCESSOR={machine}"] if machine else []
    run("cmake", "-G", "Ninja", "-S", SOURCE, "-B", build, f"-DCMAKE_C_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_C_FLAGS_RELEASE={options}", "-DBUILD_TESTING=OFF", "-DKNURL_GLTF=OFF", "-DKNURL_GODOT=OFF",
        "-DKNURL_UNITY=OFF", *target, env={"PKG_CONFIG_LIBDIR": "/nonexistent"}) # this machine's libraries
    run("cmake", "--build", build, "--target", "knurl")
    program = os.path.join(build, "hashes")
    static = ["-static"] if machine else [] # or the emulator would have to find the machine's C library
    run(compiler, "-std=c99", *options.split(), "-ffp-contract=off", "-I", os.path.join(SOURCE, "sdk/include"),
        os.path.join(SOURCE, "tests/fidelity/hashes.c"), os.path.join(build, "sdk/libknurl.a"), "-o", program, *static,
        "-lm", "-lpthread", "-ldl")
    command = [emulator, program] if emulator else [program]
    return run(*command).splitlines(), run(*command, env=NO_FMA if not emulator else {}).splitlines()


def runs_here(name):
    flags = ""
    if name == "v3" and os.path.exists("/proc/cpuinfo"):
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            flags = file.read()
        return " avx2 " in flags and " fma " in flags
    return True


def main():
    os.makedirs(FOLDER, exist_ok=True)
    first, first_without, differ, skipped = None, None, False, []
    for name, build in BUILDS.items():
        if NAMES and name not in NAMES:
            continue
        missing = [tool for tool in (build[0], *build[3:]) if not shutil.which(tool)]
        if missing or not runs_here(name):
            skipped.append(f"{name} ({', '.join(missing) or 'this CPU lacks AVX2'})")
            continue
        found, without = hashes(name, *build)
        first, first_without = first or found, first_without or without
        expected = first_without if name in WITHOUT_FMA else first
        wrong = [f"{a} | {b}" for a, b in zip(expected, found) if a != b]
        print(f"same_numbers: {name}: {len(found) - len(wrong)} of {len(expected)} lines as "
              f"{next(iter(NAMES or BUILDS))}'s" + (" without FMA" if name in WITHOUT_FMA else ""))
        for line in wrong:
            print("  " + line)
        differ = differ or bool(wrong) or len(found) != len(expected)
    if skipped:
        print("SKIPPED: same_numbers: " + "; ".join(skipped))
    sys.exit(1 if differ or not first else 0)


main()
