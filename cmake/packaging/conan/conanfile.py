# SPDX-License-Identifier: MIT
"""Builds the sources around it with Conan 2: conan create cmake/packaging/conan"""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd, stdcpp_library
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir

PROJECT = os.path.join("..", "..", "..")  # from the folder of this file


class Shaftcull(ConanFile):
    name = "shaftcull"
    description = "Culls millions of bounding boxes and spheres with shafts"
    license = "MIT"
    topics = ("culling", "visibility", "collision-detection", "simd")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "with_tbb": [True, False], "with_c": [True, False]}
    default_options = {"shared": False, "with_tbb": True, "with_c": True}

    def set_version(self):
        header = load(self, os.path.join(self.recipe_folder, PROJECT, "include", "shaftcull", "version.hpp"))
        self.version = ".".join(re.findall(r"^#define SHAFTCULL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.M))

    def export_sources(self):
        project = os.path.join(self.recipe_folder, PROJECT)
        for pattern in ("CMakeLists.txt", "LICENSE", "include/*", "kernel/*", "bindings/c/*", "cmake/*"):
            copy(self, pattern, src=project, dst=self.export_sources_folder)

    def validate(self):
        check_min_cppstd(self, 20)

    def requirements(self):
        if self.settings.arch == "x86_64":
            self.requires("xsimd/[>=8.1 <15]", visible=False)  # headers, for building alone
        if self.options.with_tbb:
            self.requires("onetbb/[>=2021.5 <2023]")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SHAFTCULL_WITH_TBB"] = bool(self.options.with_tbb)
        toolchain.cache_variables["SHAFTCULL_BUILD_C"] = bool(self.options.with_c)
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan writes these itself.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "shaftcull")
        self.cpp_info.set_property("cmake_target_name", "shaftcull::all")  # a component has the name of the package

        cpp = self.cpp_info.components["cpp"]
        cpp.set_property("cmake_target_name", "shaftcull::shaftcull")
        cpp.set_property("pkg_config_name", "shaftcull")
        cpp.libs = ["shaftcull"]
        if self.options.shared:
            cpp.defines = ["SHAFTCULL_SHARED"]
        if self.options.with_tbb:
            cpp.requires = ["onetbb::onetbb"]
        if self.settings.os in ("Linux", "FreeBSD"):
            cpp.system_libs = ["m"]

        if self.options.with_c:
            c = self.cpp_info.components["c"]
            c.set_property("cmake_target_name", "shaftcull::c")
            c.set_property("pkg_config_name", "shaftcull_c")
            c.libs = ["shaftcull_c"]
            c.requires = ["cpp"]
            if not self.options.shared and stdcpp_library(self):
                c.system_libs = [stdcpp_library(self)]
