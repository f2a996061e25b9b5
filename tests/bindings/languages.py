#!/usr/bin/python3
"""The plate of samples/languages in C++, Rust and Node, each if its tools are there: it answers with 0.4 N.
usage: languages.py SOURCE FOLDER CC CXX LIBKNURL.a VERSION     Exit 77: not all were tried.  SPDX-License-Identifier: MIT"""
import os
import shutil
import subprocess
import sys

SOURCE, FOLDER, CC, CXX, LIBRARY, VERSION = sys.argv[1:]
SAMPLES = os.path.join(SOURCE, "samples/languages")
API = os.path.join(FOLDER, "api.json")
LIBCLANG = os.path.join(SOURCE, "build/mirror-venv/bin/python")
skipped = []


def output(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd=FOLDER)
    if done.returncode:
        sys.exit(f"languages: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def answers(language, *command):
    said = output(*command)
    if said != f"0.400000 N, knurl {VERSION}\n":
        sys.exit(f"languages: {language}: expected 0.400000 N, knurl {VERSION}, found {said}")
    print(f"languages: {language}: {said.strip()}")


def in_cpp():
    output(CXX, "-std=c++17", "-Wall", "-Wextra", "-Werror", "-I", os.path.join(SOURCE, "sdk/include"),
           os.path.join(SAMPLES, "plate.cpp"), LIBRARY, "-lm", "-ldl", "-pthread", "-o", "plate_cpp")
    answers("C++", os.path.join(FOLDER, "plate_cpp"))


def in_rust():
    shutil.copy(os.path.join(SAMPLES, "plate.rs"), FOLDER)
    output(sys.executable, "-B", os.path.join(SAMPLES, "rust.py"), API, "knurl.rs")
    output("rustc", "--edition", "2021", "-D", "warnings", "-L", os.path.dirname(LIBRARY), "-l", "static=knurl", "-l", "m", "-l",
           "dl", "plate.rs", "-o", "plate_rust")
    answers("Rust", os.path.join(FOLDER, "plate_rust"))


def in_node():
    for name in ("knurl.mjs", "plate.mjs"):
        shutil.copy(os.path.join(SAMPLES, name), FOLDER)
    output(CC, "-shared", "-Wl,--whole-archive", LIBRARY, "-Wl,--no-whole-archive", "-lm", "-ldl", "-pthread", "-o", "libknurl.so")
    answers("Node", "node", "plate.mjs", API, os.path.join(FOLDER, "libknurl.so"))


def needs(language, tools, run):
    missing = [name for name, there in tools.items() if not there]
    if missing:
        print(f"skipped: {language}: there is no {', '.join(missing)}")
        skipped.append(language)
    else:
        run()


os.makedirs(FOLDER, exist_ok=True)
in_cpp()
libclang = os.path.exists(LIBCLANG) and subprocess.run([LIBCLANG, "-c", "import clang.cindex"], check=False,
                                                       stderr=subprocess.DEVNULL).returncode == 0
if libclang:
    output(LIBCLANG, "-B", os.path.join(SOURCE, "scripts/api.py"), API)
needs("Rust", {"libclang (./run mirror)": libclang, "rustc": shutil.which("rustc")}, in_rust)
koffi = shutil.which("node") and subprocess.run(["node", "-e", 'require.resolve("koffi")'], cwd=FOLDER, check=False,
                                                stderr=subprocess.DEVNULL).returncode == 0
needs("Node", {"libclang (./run mirror)": libclang, "koffi (npm install koffi, in build/)": koffi}, in_node)
sys.exit(77 if skipped else 0)
