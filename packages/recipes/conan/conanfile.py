"""Knurl's libraries for Conan 2: `conan create packages/recipes/conan`, in a checkout or an unpacked source archive.
Drivers that need libusb, hidapi or libwebsockets are left out. SPDX-License-Identifier: MIT"""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

SOURCES = ("CMakeLists.txt", "cmake/*", "sdk/*", "bindings/common/*", "bindings/godot/addons/knurl/THIRD_PARTY.md", "samples/*",
           "LICENSE", "CHANGELOG.md")


class Knurl(ConanFile):
    name = "knurl"
    description = "Haptic gratings on force-feedback devices"
    license = "MIT"
    homepage = "https://doi.org/10.1109/TOH.2021.3072588"
    topics = ("haptics", "force-feedback", "gltf")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "gltf": [True, False]}
    default_options = {"shared": False, "gltf": True}

    def _sources(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        numbers = re.findall(r"#define KNURL_VERSION_[A-Z]+ (\d+)", load(self, os.path.join(self._sources(), "sdk/include/knurl/base.h")))
        self.version = ".".join(numbers)

    def export_sources(self):
        for name in SOURCES:
            copy(self, name, self._sources(), self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        if self.options.gltf: # compiled in
            self.requires("tinygltf/2.9.7", visible=False)
            self.requires("nlohmann_json/3.12.0", visible=False)
            self.requires("glm/1.0.1", visible=False)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({"BUILD_TESTING": False, "KNURL_GLTF": bool(self.options.gltf), "KNURL_GODOT": False,
                                          "KNURL_UNITY": False, "KNURL_FALCON": False, "KNURL_RAWHID": False,
                                          "KNURL_INVERSE3": False})
        for require, package in self.dependencies.items():
            if require.ref.name == "tinygltf" and package.package_folder: # otherwise the system has it
                toolchain.cache_variables["TINYGLTF_INCLUDE_DIR"] = package.cpp_info.includedirs[0]
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build(target="knurl_gltf" if self.options.gltf else "knurl")

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        for folder in ("lib/cmake", "lib/pkgconfig", "lib/udev", "share"): # Conan writes its own
            rmdir(self, os.path.join(self.package_folder, folder))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "knurl")
        core = self.cpp_info.components["knurl"]
        core.set_property("cmake_target_name", "knurl::knurl")
        core.set_property("pkg_config_name", "knurl")
        core.libs = ["knurl"]
        if self.settings.os == "Windows":
            core.system_libs = ["winmm"]
            core.defines = [] if self.options.shared else ["KNURL_STATIC"]
        else:
            core.system_libs = ["m", "pthread", "dl"] if self.settings.os == "Linux" else []
        if self.options.gltf:
            gltf = self.cpp_info.components["gltf"]
            gltf.set_property("cmake_target_name", "knurl::gltf")
            gltf.set_property("pkg_config_name", "knurl_gltf")
            gltf.libs = ["knurl_gltf"]
            gltf.requires = ["knurl"]
            if self.settings.os == "Linux" and not self.options.shared:
                gltf.system_libs = ["stdc++"]
