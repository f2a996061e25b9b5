"""Builds the libraries into the package, and the declarations of their headers for cffi. Needs CMake, a C and a C++
compiler and the dependencies of knurl_gltf (tinygltf, nlohmann-json, GLM). Environment: CMAKE_ARGS: more options for
CMake; KNURL_BUILD_FOLDER: the folder to build in (default: build/libraries). A source archive holds the library's
sources beside this file, in sdk-source. SPDX-License-Identifier: MIT"""
import os
import re
import shlex
import shutil
import subprocess

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist
from wheel.bdist_wheel import bdist_wheel

HERE = os.path.dirname(os.path.realpath(__file__))
CARRIED = os.path.join(HERE, "sdk-source")
ROOT = CARRIED if os.path.isdir(CARRIED) else os.path.dirname(os.path.dirname(HERE))
HEADERS = os.path.join(ROOT, "sdk/include")
# The sources and installed files of the libraries.
SOURCES = ("CMakeLists.txt", "cmake", "sdk", "LICENSE", "README.md", "CHANGELOG.md", "SECURITY.md",
           "bindings/godot/addons/knurl/THIRD_PARTY.md")
# Linked statically, because a machine may lack these libraries.
RUNTIME = "-DCMAKE_SHARED_LINKER_FLAGS=-static-libgcc -static-libstdc++"


def version():
    with open(os.path.join(HEADERS, "knurl/base.h"), encoding="utf-8") as header:
        return ".".join(re.findall(r"#define KNURL_VERSION_[A-Z]+ (\d+)", header.read()))


def description():
    """The page of the package: its README, without links to files that are not beside it there."""
    with open(os.path.join(HERE, "README.md"), encoding="utf-8") as readme:
        return re.sub(r"\[([^]]*)\]\((?![a-z]+:)[^)]*\)", r"\1", readme.read())


def interface():
    """The headers as cffi reads them: preprocessed, without declarations of other headers and without attributes; of
    macros only whole numbers."""
    compiler = os.environ.get("CC", "cc")
    text = subprocess.run([compiler, "-E", "-dD", "-I", HEADERS, "-DKNURL_NONBLOCKING=", "-include", "knurl/knurl.h", "-include",
                           os.path.join(HERE, "native/record.h"), "-x", "c", os.devnull], check=True, capture_output=True, text=True).stdout
    ours, kept = False, []
    for line in text.splitlines():
        marker = re.match(r'# \d+ "(.*?)"', line)
        if marker:
            ours = marker.group(1).startswith((HEADERS, HERE))
        elif ours and line.startswith("#define"):
            number = re.match(r"#define (KNURL_\w+) \(?(-?\d+)\)?$", line)
            kept += [f"#define {number[1]} {number[2]}"] if number else []
        elif ours and not line.startswith("#"):
            kept.append(line)
    return re.sub(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)", "", "\n".join(kept))


class Build(build_py):
    editable_mode = False # setuptools sets it for `pip install -e`: the package is then used in its source folder

    def run(self):
        super().run()
        package = os.path.join(HERE, "knurl") if self.editable_mode else os.path.abspath(os.path.join(self.build_lib, "knurl"))
        folder = os.path.abspath(os.environ.get("KNURL_BUILD_FOLDER", os.path.join("build", "libraries")))
        subprocess.run(["cmake", "-S", HERE, "-B", folder, f"-DKNURL_SOURCE={ROOT}", "-DCMAKE_BUILD_TYPE=Release",
                        "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_INSTALL_LIBDIR=lib", "-DCMAKE_BUILD_RPATH_USE_ORIGIN=ON", RUNTIME,
                        *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", folder, "--parallel", "--target", "knurl", "knurl_gltf", "knurl_record"], check=True)
        subprocess.run(["cmake", "--install", folder, "--component", "runtime", "--strip", "--prefix",
                        os.path.join(folder, "installed")], check=True)
        libraries = os.path.join(folder, "installed", "lib")
        for name in os.listdir(libraries):
            if re.search(r"record\.(so|dylib)$|\.so\.\d+\.\d+$|[a-z]\.\d+\.\d+\.dylib$", name): # the file name that is loaded
                shutil.copy(os.path.join(libraries, name), package)
        os.makedirs(os.path.join(package, "licences"), exist_ok=True)
        for name in ("LICENSE", "bindings/godot/addons/knurl/THIRD_PARTY.md"):
            shutil.copy(os.path.join(ROOT, name), os.path.join(package, "licences"))
        with open(os.path.join(package, "interface.h"), "w", encoding="utf-8") as file:
            file.write(interface())


class Archive(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        for name in SOURCES:
            path, to = os.path.join(ROOT, name), os.path.join(base_dir, "sdk-source", name)
            os.makedirs(os.path.dirname(to), exist_ok=True)
            if os.path.isdir(path):
                shutil.copytree(path, to)
            else:
                shutil.copy(path, to)


class Wheel(bdist_wheel):
    def get_tag(self):
        """Any Python 3 on this platform, with the oldest C library that has all needed functions."""
        platform = super().get_tag()[2]
        libraries = b""
        for root, _, names in os.walk(self.bdist_dir or "."):
            for name in names:
                if ".so" in name:
                    with open(os.path.join(root, name), "rb") as file:
                        libraries += file.read()
        glibc = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)", libraries)]
        musl = re.search(rb"\0libc\.(so|musl-\w+\.so\.1)\0", libraries) # its symbols have no versions
        if platform.startswith("linux_") and (glibc or musl):
            oldest = f"manylinux_2_{max(17, *glibc)}" if glibc else "musllinux_1_2"
            platform = oldest + platform[len("linux"):]
        return ("py3", "none", platform)


class WithLibraries(Distribution):
    def has_ext_modules(self):
        return True


setup(version=version(), long_description=description(), long_description_content_type="text/markdown",
      cmdclass={"build_py": Build, "bdist_wheel": Wheel, "sdist": Archive}, distclass=WithLibraries)
