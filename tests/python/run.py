#!/usr/bin/python3
"""Builds the Python module's wheel as pip does, installs it into an empty environment, and runs its tests and example.
usage: run.py SOURCE BUILD FOLDER C_COMPILER CXX_COMPILER C_FLAGS CXX_FLAGS KNURL
BUILD: KNURL's; beside it the libraries are built (see tests/package/installed.py); FOLDER: kept for the next time;
C_FLAGS, CXX_FLAGS: of that build, whose objects ccache then has. Exit 77: a package is missing.
SPDX-License-Identifier: MIT"""
import glob
import importlib.util
import os
import shutil
import subprocess
import sys

SOURCE, BUILD, FOLDER, CC, CXX, C_FLAGS, CXX_FLAGS, KNURL = sys.argv[1:]
PACKAGES = {"cffi": "python3-cffi", "numpy": "python3-numpy", "setuptools": "python3-setuptools",
            "wheel": "python3-wheel", "pip": "python3-pip", "ensurepip": "python3-venv"}


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=FOLDER,
                          env={**os.environ, "CC": CC, "CXX": CXX, "CMAKE_GENERATOR": "Ninja",
                               "KNURL_BUILD_FOLDER": f"{BUILD}-python", "CMAKE_ARGS":
                               f"-DCMAKE_C_FLAGS_RELEASE='{C_FLAGS}' -DCMAKE_CXX_FLAGS_RELEASE='{CXX_FLAGS}' "
                               f"-DKNURL_WARNINGS_AS_ERRORS={os.environ['KNURL_WARNINGS_AS_ERRORS']}"})
    if done.returncode:
        sys.exit(f"python: {' '.join(command)}: exit {done.returncode}\n{done.stdout[-4000:]}")
    return done.stdout


def link_module(folder):
    """The module by links: pip and setuptools write beside setup.py."""
    module = os.path.join(SOURCE, "bindings/python")
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(module):
        link = os.path.join(folder, name)
        if name != "build" and not name.endswith(".egg-info") and not os.path.lexists(link):
            os.symlink(os.path.join(module, name), link)
    return folder


def run_shown(python):
    """Runs what the pages show, with the simulated device."""
    shutil.copy(os.path.join(SOURCE, "assets/plate_1d.glb"), FOLDER)
    for path in run(sys.executable, "-B", os.path.join(SOURCE, "tests/docs/snippets.py"), "write", "python", FOLDER).split():
        with open(path, encoding="utf-8") as file:
            code = file.read().replace('Device("touch")', 'Device("fake")')
        run(python, "-B", "-c", code)
        print(f"python: {os.path.basename(path)} runs")


def main():
    missing = [package for name, package in PACKAGES.items() if importlib.util.find_spec(name) is None]
    if missing:
        print(f"skipped: apt-get install {' '.join(missing)}; ./run test python does it")
        sys.exit(77)
    os.makedirs(FOLDER, exist_ok=True)
    wheels, environment = os.path.join(FOLDER, "wheels"), os.path.join(FOLDER, "environment")
    for path in (wheels, environment):
        shutil.rmtree(path, ignore_errors=True)
    run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "--wheel-dir", wheels,
        link_module(os.path.join(FOLDER, "python")))
    wheel, = glob.glob(os.path.join(wheels, "*.whl"))
    print(f"python: {os.path.basename(wheel)}, {os.path.getsize(wheel) // 1000} kB")
    run(sys.executable, "-m", "venv", "--system-site-packages", environment) # numpy and cffi are the system's
    python = os.path.join(environment, "bin/python")
    run(python, "-m", "pip", "install", "--no-index", wheel)
    print(run(python, "-B", os.path.join(SOURCE, "bindings/python/examples/stroke.py")).strip())
    run_shown(python)
    print(run(python, "-B", os.path.join(SOURCE, "tests/python/test_knurl.py"), "-v", KNURL, os.path.join(SOURCE, "assets")))


main()
