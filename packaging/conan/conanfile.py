# SPDX-License-Identifier: MIT
# libgrisaille, its effects and the tools for authors of effects, from this checkout:
#   conan create packaging/conan --build=missing
import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.gnu import PkgConfigDeps

required_conan_version = ">=2.0"


class Grisaille(ConanFile):
    name = "grisaille"
    version = "0.1.0"
    description = "Screen-space effects for renderers on Vulkan 1.3 or OpenGL 4.5"
    license = "MIT"
    topics = ("rendering", "ambient-occlusion", "vulkan", "opengl")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {
        "shared": True,
        "fPIC": True,
        "fmt/*:header_only": True,
        "libepoxy/*:shared": True,
        "spirv-cross/*:shared": True,
    }

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")

    def validate(self):
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("Grisaille runs on Linux")

    def requirements(self):
        self.requires("libepoxy/[>=1.5.10 <2]")
        # Headers alone, which are compiled into the library.
        self.requires("fmt/[>=9 <12]", visible=False)
        self.requires("glm/[>=0.9.9]", visible=False)
        self.requires("nlohmann_json/[>=3.11 <4]", visible=False)
        self.requires("volk/[>=1.3.239]", visible=False)
        # For the shader compiler, which is installed for authors of effects.
        self.requires("spirv-cross/[>=1.3.239]", visible=False, run=True)

    def build_requirements(self):
        self.tool_requires("shaderc/[>=2023]")
        self.tool_requires("cmake/[>=3.25]")

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "*.md", "app/*", "backends/*", "cmake/*", "core/*",
                        "docs/*", "effects/*", "examples/*", "host/*", "shaders/*", "tools/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.variables["GRISAILLE_PROGRAMS"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # The installed package file has the components and functions; CMakeDeps writes none.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "Grisaille")]
        self.cpp_info.set_property("pkg_config_name", "grisaille")
        self.cpp_info.libs = ["grisaille"]
        if not self.options.shared:
            self.cpp_info.system_libs = ["stdc++", "m", "dl"]
