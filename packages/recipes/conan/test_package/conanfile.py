"""The installed package, used by tests/package/consumer. SPDX-License-Identifier: MIT"""
import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout


class Consumer(ConanFile):
    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps"

    def layout(self):
        cmake_layout(self, src_folder="../../../../tests/package/consumer")

    def requirements(self):
        self.requires(self.tested_reference_str)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False # it would be written into the sources
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure({"WANTED": str(self.dependencies["knurl"].ref.version),
                         "GLTF_FROM_C": str(self.dependencies["knurl"].options.gltf)})
        cmake.build()

    def test(self):
        if can_run(self):
            self.run(os.path.join(self.cpp.build.bindir, "plate"), env="conanrun")
