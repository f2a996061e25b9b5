#!/usr/bin/python3
"""Makes the Python module's source archive, builds its wheel from that alone, installs it into an empty environment, and runs
its tests, example and notebooks; then installs the archive to be edited in place.
usage: run.py SOURCE BUILD FOLDER C_COMPILER CXX_COMPILER C_FLAGS CXX_FLAGS KNURL
BUILD: KNURL's; beside it the libraries are built (see tests/package/installed.py); FOLDER: kept for the next time;
C_FLAGS, CXX_FLAGS: of that build, whose objects ccache then has. Exit 77: a package is missing.
SPDX-License-Identifier: MIT"""
import glob
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import zipfile

SOURCE, BUILD, FOLDER, CC, CXX, C_FLAGS, CXX_FLAGS, KNURL = sys.argv[1:]
PACKAGES = {"cffi": "python3-cffi", "numpy": "python3-numpy", "setuptools": "python3-setuptools",
            "wheel": "python3-wheel", "pip": "python3-pip", "ensurepip": "python3-venv", "mypy": "mypy",
            "pandas": "python3-pandas", "matplotlib": "python3-matplotlib"}


def run(*command, where=FOLDER):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=where,
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


def unpack_archive():
    """Makes the source archive and unpacks it; returns its folder, whose path is the same each time for ccache."""
    made, unpacked = os.path.join(FOLDER, "archive"), os.path.join(FOLDER, "unpacked")
    for path in (made, unpacked):
        shutil.rmtree(path, ignore_errors=True)
    run(sys.executable, "setup.py", "-q", "sdist", "--dist-dir", made, where=link_module(os.path.join(FOLDER, "python")))
    archive, = glob.glob(os.path.join(made, "*.tar.gz"))
    print(f"python: {os.path.basename(archive)}, {os.path.getsize(archive) // 1000} kB")
    shutil.unpack_archive(archive, unpacked)
    folder, = glob.glob(os.path.join(unpacked, "*"))
    return folder


def check_wheel(wheel):
    """Its tag names the C library that it needs, and it has the licences of all linked libraries."""
    name, names = os.path.basename(wheel), zipfile.ZipFile(wheel).namelist()
    licences = {os.path.basename(path) for path in names if "/licences/" in path}
    if not re.search(r"-py3-none-manylinux_2_\d+_\w+\.whl$", name) or licences != {"LICENSE", "THIRD_PARTY.md"}:
        sys.exit(f"python: {name}: expected a tag manylinux_2_N and two files of licences, found {sorted(licences)}")
    page = zipfile.ZipFile(wheel).read(next(path for path in names if path.endswith("/METADATA"))).decode()
    dead = re.findall(r"\]\((?!https:)(.*?)\)", page)
    if "# Knurl" not in page or dead:
        sys.exit(f"python: {name}: expected its README as its page, without links to files of the repository, found {dead}")
    print(f"python: {name}, {os.path.getsize(wheel) // 1000} kB")


def edit_in_place(source, environment):
    """As `pip install -e`: a change of the sources is a change of the module."""
    python = os.path.join(environment, "bin/python")
    run(sys.executable, "-m", "venv", "--clear", "--system-site-packages", environment)
    run(python, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index", "-e", source)
    with open(os.path.join(source, "knurl/metrics.py"), "a", encoding="utf-8") as file:
        file.write("EDITED = 1\n")
    run(python, "-B", "-c", "import knurl; assert knurl.metrics.EDITED; knurl.Scene().close()")
    print("python: an editable installation is edited in place")


def run_shown(python):
    """Runs the pages' examples, with the simulated device."""
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
    source = unpack_archive()
    run(sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "--wheel-dir", wheels, source)
    wheel, = glob.glob(os.path.join(wheels, "*.whl"))
    check_wheel(wheel)
    run(sys.executable, "-m", "venv", "--system-site-packages", environment) # numpy and cffi are the system's
    python = os.path.join(environment, "bin/python")
    run(python, "-m", "pip", "install", "--no-index", wheel)
    print(run(python, "-B", os.path.join(SOURCE, "bindings/python/examples/stroke.py")).strip())
    run_shown(python)
    run(sys.executable, "-m", "mypy", "--config-file", os.path.join(source, "pyproject.toml"), os.path.join(source, "knurl"))
    for test in sorted(glob.glob(os.path.join(SOURCE, "tests/python/test_*.py"))):
        print(run(python, "-B", test, "-v", KNURL, os.path.join(SOURCE, "assets")))
    print(run(python, "-B", os.path.join(SOURCE, "bindings/python/notebooks/execute.py"), "--check", FOLDER).strip())
    edit_in_place(source, environment)


main()
