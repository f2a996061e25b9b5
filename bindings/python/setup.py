"""Builds the libraries into the package, and what cffi reads of their headers. Needs CMake, a C and a C++ compiler and
what knurl_gltf is built with (tinygltf, nlohmann-json, GLM). The environment variable CMAKE_ARGS may hold more options for
CMake; KNURL_BUILD_FOLDER, where they are built (default: build/libraries). SPDX-License-Identifier: MIT"""
import os
import re
import shlex
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.realpath(__file__))))
HEADERS = os.path.join(ROOT, "sdk/include")
# What every machine need not have is linked in.
RUNTIME = "-DCMAKE_SHARED_LINKER_FLAGS=-static-libgcc -static-libstdc++"


def version():
    with open(os.path.join(HEADERS, "knurl/base.h"), encoding="utf-8") as header:
        return ".".join(re.findall(r"#define KNURL_VERSION_[A-Z]+ (\d+)", header.read()))


def interface():
    """The headers as cffi reads them: preprocessed, without what other headers declare, and without attributes."""
    compiler = os.environ.get("CC", "cc")
    text = subprocess.run([compiler, "-E", "-I", HEADERS, "-DKNURL_NONBLOCKING=", "-include", "knurl/knurl.h", "-x", "c",
                           os.devnull], check=True, capture_output=True, text=True).stdout
    ours, kept = False, []
    for line in text.splitlines():
        marker = re.match(r'# \d+ "(.*?)"', line)
        if marker:
            ours = marker.group(1).startswith(HEADERS)
        elif ours:
            kept.append(line)
    return re.sub(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)", "", "\n".join(kept))


class Build(build_py):
    def run(self):
        super().run()
        package = os.path.abspath(os.path.join(self.build_lib, "knurl"))
        folder = os.path.abspath(os.environ.get("KNURL_BUILD_FOLDER", os.path.join("build", "libraries")))
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_SHARED_LIBS=ON",
                        "-DBUILD_TESTING=OFF", "-DKNURL_GODOT=OFF", "-DKNURL_UNITY=OFF", "-DCMAKE_INSTALL_LIBDIR=lib",
                        "-DCMAKE_BUILD_RPATH_USE_ORIGIN=ON", RUNTIME, *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
                       check=True)
        subprocess.run(["cmake", "--build", folder, "--parallel", "--target", "knurl", "knurl_gltf"], check=True)
        subprocess.run(["cmake", "--install", folder, "--component", "runtime", "--strip", "--prefix",
                        os.path.join(folder, "installed")], check=True)
        libraries = os.path.join(folder, "installed", "lib")
        for name in os.listdir(libraries):
            if re.search(r"\.so\.\d+\.\d+$", name): # the name that it is loaded by
                shutil.copy(os.path.join(libraries, name), package)
        with open(os.path.join(package, "interface.h"), "w", encoding="utf-8") as file:
            file.write(interface())


class Wheel(bdist_wheel):
    def get_tag(self):
        return ("py3", "none", super().get_tag()[2]) # any Python 3, but this machine's kind


class WithLibraries(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), cmdclass={"build_py": Build, "bdist_wheel": Wheel}, distclass=WithLibraries)
