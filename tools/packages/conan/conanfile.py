"""The Conan recipe: conan create tools/packages/conan, at the top of the tree, which it packs."""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"


class Treeform(ConanFile):
    name = "treeform"
    description = ("Exact, fast tools for triangle meshes: self-intersections, solids, welding, "
                   "placement")
    license = "Apache-2.0"
    topics = ("mesh", "geometry", "boolean", "self-intersection", "3d")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "tools": [True, False]}
    default_options = {"shared": False, "fPIC": True, "tools": False}

    @property
    def _tree(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        header = load(self, os.path.join(self._tree, "libtree/include/treeform/tree/version.hpp"))
        self.version = ".".join(re.findall(
            r"^#define TREEFORM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", header, re.MULTILINE))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "libtree/*", "libmesh/*", "tools/*"):
            copy(self, pattern, self._tree, self.export_sources_folder,
                 excludes=("*/__pycache__/*", "tools/python/build/*", "tools/python/dist/*"))

    def configure(self):
        if self.options.shared:
            self.options.rm_safe("fPIC")

    def validate(self):
        check_min_cppstd(self, 20)

    def requirements(self):
        # None of them is in a public header.
        for reference in ("eigen/3.4.0", "highway/1.2.0", "minizip/1.3.1", "nlohmann_json/3.11.3",
                          "onetbb/2021.12.0", "pugixml/1.14", "zlib/[>=1.2.11 <2]"):
            self.requires(reference)
        if self.options.tools:
            self.requires("cli11/2.4.2")
            self.requires("openssl/[>=3 <4]")

    def layout(self):
        self.folders.source = "."
        self.folders.build = os.path.join("build", str(self.settings.build_type))
        self.folders.generators = os.path.join(self.folders.build, "generators")

    def generate(self):
        dependencies = CMakeDeps(self)
        # Named as in Highway's own config file.
        dependencies.set_property("highway", "cmake_file_name", "hwy")
        dependencies.set_property("highway::hwy", "cmake_target_name", "hwy::hwy")
        dependencies.generate()
        toolchain = CMakeToolchain(self)
        values = toolchain.cache_variables
        values["TREEFORM_BUILD_TOOLS"] = bool(self.options.tools)
        values["TREEFORM_BUILD_C"] = bool(self.options.shared)  # it is always a shared library
        values["TREEFORM_BUILD_PYTHON"] = False
        values["TREEFORM_BUILD_TESTS"] = False
        values["TREEFORM_INSTALL"] = True
        # A static assimp needs libraries that its users would have to name.
        values["TREEFORM_WITH_ASSIMP"] = False
        values["CMAKE_DISABLE_FIND_PACKAGE_MPI"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        # CMakeDeps and PkgConfigDeps write their own.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "treeform")
        self.cpp_info.set_property("pkg_config_name", "treeform")
        tree = self.cpp_info.components["tree"]
        tree.set_property("cmake_target_name", "treeform::tree")
        tree.libs = ["treeform_tree"]
        tree.requires = ["highway::highway", "onetbb::onetbb"]
        mesh = self.cpp_info.components["mesh"]
        mesh.set_property("cmake_target_name", "treeform::mesh")
        mesh.libs = ["treeform_mesh"]
        mesh.requires = ["tree", "eigen::eigen", "highway::highway", "minizip::minizip",
                         "nlohmann_json::nlohmann_json", "pugixml::pugixml", "zlib::zlib"]
        if self.options.shared:
            c = self.cpp_info.components["c"]
            c.set_property("cmake_target_name", "treeform::c")
            c.libs = ["treeform_c"]
            c.requires = ["mesh"]
        if self.options.tools:
            # What only the tools need.
            self.cpp_info.components["tools"].requires = ["cli11::cli11", "openssl::crypto"]
        for component in (tree, mesh):
            if self.settings.os == "Linux":
                component.system_libs = ["pthread"]
