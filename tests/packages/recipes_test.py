#!/usr/bin/env python3
"""The vcpkg port and the Conan recipe, as far as that can be told without either: both are run with
stand-ins for what vcpkg and Conan give them, the options that they set configure this tree, and
every package that this tree looks for is one that they name."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest

sys.dont_write_bytecode = True
import support  # noqa: E402

TREE = pathlib.Path(__file__).resolve().parents[2]
PORT = TREE / "tools/packages/vcpkg/ports/treeform"
CONAN = TREE / "tools/packages/conan"

# What find_package, find_path and find_library look for: names in vcpkg and in Conan.
NAMES = {"hwy": ("highway", "highway"), "TBB": ("tbb", "onetbb"), "Eigen3": ("eigen3", "eigen"),
         "nlohmann_json": ("nlohmann-json", "nlohmann_json"), "pugixml": ("pugixml", "pugixml"),
         "ZLIB": ("zlib", "zlib"), "minizip": ("minizip", "minizip"), "CLI11": ("cli11", "cli11"),
         "OpenSSL": ("openssl", "openssl")}
OF_TOOLS = {"CLI11", "OpenSSL"}
# Fields of a manifest, by vcpkg's reference.
FIELDS = {"builtin-baseline", "default-features", "dependencies", "description", "documentation",
          "features", "homepage", "license", "maintainers", "name", "overrides", "port-version",
          "supports", "version", "version-semver", "version-date", "version-string", "summary"}
FIELDS_OF_FEATURE = {"description", "dependencies", "supports", "license"}
FIELDS_OF_DEPENDENCY = {"name", "default-features", "features", "host", "platform", "version>="}
# Functions that vcpkg gives to a port.
FUNCTIONS = ["vcpkg_check_features", "vcpkg_cmake_configure", "vcpkg_cmake_install",
             "vcpkg_cmake_config_fixup", "vcpkg_fixup_pkgconfig", "vcpkg_copy_tools",
             "vcpkg_install_copyright"]


def version():
    text = (TREE / "libtree/include/treeform/tree/version.hpp").read_text()
    return ".".join(re.findall(r"^#define TREEFORM_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$", text,
                               re.M))


def looked_for(folders):
    """What the lists of these folders look for without which they fail."""
    found = set()
    for folder in folders:
        for path in (TREE / folder).rglob("CMakeLists.txt"):
            text = path.read_text()
            found |= set(re.findall(r"find_package\((\w+)[^)]*REQUIRED", text))
            found |= set(re.findall(r"find_library\(\w+ (\w+) REQUIRED", text))
    return found - {"Threads", "assimp", "Python", "pybind11", "treeform"}


def options_of_tree():
    return set(re.findall(r"option\((TREEFORM_\w+)", (TREE / "CMakeLists.txt").read_text()))


def configure(options):
    """That this tree can be configured so, here, where the packages are Debian's."""
    with tempfile.TemporaryDirectory() as build:
        return subprocess.run(["cmake", "-S", str(TREE), "-B", build, "-G", "Ninja",
                               "-DCMAKE_BUILD_TYPE=Release", *options],
                              capture_output=True, text=True)


class Vcpkg(unittest.TestCase):
    def setUp(self):
        self.manifest = json.loads((PORT / "vcpkg.json").read_text())

    def dependencies(self, of):
        names = set()
        for one in of["dependencies"]:
            if isinstance(one, dict):
                self.assertLessEqual(set(one), FIELDS_OF_DEPENDENCY)
                if one.get("host"):
                    continue
                one = one["name"]
            names.add(one)
        return names

    def test_every_field_is_one_of_vcpkg(self):
        self.assertLessEqual(set(self.manifest), FIELDS)
        for feature in self.manifest["features"].values():
            self.assertLessEqual(set(feature), FIELDS_OF_FEATURE)
        for name in [self.manifest["name"], *self.dependencies(self.manifest)]:
            self.assertRegex(name, r"^[a-z0-9]+(-[a-z0-9]+)*$")

    def test_the_version_is_that_of_the_header(self):
        self.assertEqual(self.manifest["version"], version())

    def test_what_the_tree_looks_for_is_named(self):
        libraries = {NAMES[name][0] for name in looked_for(["libtree", "libmesh"])}
        self.assertEqual(self.dependencies(self.manifest), libraries)
        tools = {NAMES[name][0] for name in looked_for(["tools"])}
        self.assertEqual(self.dependencies(self.manifest["features"]["tools"]), tools - libraries)
        self.assertEqual(tools - libraries, {NAMES[name][0] for name in OF_TOOLS})

    def run_port(self, linkage, features):
        """The calls that the port makes, each a list: the function, then its arguments."""
        with tempfile.TemporaryDirectory() as folder:
            stand_ins = "".join(f'''
function({name})
    string(JOIN "|" arguments ${{ARGV}})
    file(APPEND "{folder}/calls" "{name}|${{arguments}}\\n")
    {"set(FEATURE_OPTIONS -DTREEFORM_BUILD_TOOLS=" + ("ON" if "tools" in features else "OFF")
     + " PARENT_SCOPE)" if name == "vcpkg_check_features" else ""}
endfunction()''' for name in FUNCTIONS)
            script = pathlib.Path(folder, "run.cmake")
            script.write_text(f'''cmake_minimum_required(VERSION 3.25)
{stand_ins}
set(VCPKG_LIBRARY_LINKAGE {linkage})
set(FEATURES "core;{";".join(features)}")
set(PORT treeform)
set(CURRENT_PACKAGES_DIR "{folder}/packages")
include("{PORT}/portfile.cmake")
''')
            done = subprocess.run(["cmake", "-P", str(script)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(pathlib.Path(folder, "packages/share/treeform/usage").is_file())
            lines = pathlib.Path(folder, "calls").read_text().splitlines()
        return [line.split("|") for line in lines]

    def test_the_port_configures_this_tree(self):
        for linkage, features in (("static", []), ("dynamic", ["tools"])):
            calls = self.run_port(linkage, features)
            names = [call[0] for call in calls]
            self.assertEqual(names, [name for name in FUNCTIONS if name != "vcpkg_copy_tools"
                                     or features])
            arguments = calls[1]
            self.assertEqual(pathlib.Path(arguments[arguments.index("SOURCE_PATH") + 1]), TREE)
            options = arguments[arguments.index("OPTIONS") + 1:]
            for option in options:
                name = re.match(r"-D(\w+)=", option)[1]
                if name.startswith("TREEFORM_"):
                    self.assertIn(name, options_of_tree())
            self.assertIn("-DTREEFORM_BUILD_C=" + ("1" if linkage == "dynamic" else "0"), options)
            done = configure([*options, f"-DBUILD_SHARED_LIBS={linkage == 'dynamic'}"])
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_tools_are_those_of_the_tree(self):
        call = next(call for call in self.run_port("static", ["tools"])
                    if call[0] == "vcpkg_copy_tools")
        tools = sorted(path.parent.name for path in (TREE / "tools").glob("*/main.cpp"))
        self.assertEqual(call[call.index("TOOL_NAMES") + 1:call.index("AUTO_CLEAN")], tools)


class Any:
    """Takes any call, and keeps what is asked of it."""

    def __init__(self, *arguments, **named):
        self.calls = []
        self.cache_variables = {}

    def __getattr__(self, name):
        def call(*arguments, **named):
            self.calls.append((name, arguments, named))
        return call


class Component(types.SimpleNamespace):
    def __init__(self):
        super().__init__(libs=[], requires=[], system_libs=[], properties={})

    def set_property(self, name, value):
        self.properties[name] = value


class Info(Component):
    def __init__(self):
        super().__init__()
        self.components = {}
        components = self.components

        class Made(dict):
            def __missing__(self, key):
                self[key] = Component()
                return self[key]
        self.components = Made(components)


def stand_ins(made):
    """Modules under the names that the recipe imports."""
    class ConanFile:
        def __init__(self):
            self.required = []
            self.recipe_folder = str(CONAN)
            self.folders = types.SimpleNamespace()
            self.settings = types.SimpleNamespace(os="Linux", build_type="Release")
            self.cpp_info = Info()
            self.package_folder = self.source_folder = self.export_sources_folder = "/none"

        def requires(self, reference, **named):
            self.required.append(reference)

    def remember(name):
        def make(*arguments, **named):
            made[name] = made.get(name) or Any()
            return made[name]
        return make

    copied = made.setdefault("copied", [])
    modules = {
        "conan": {"ConanFile": ConanFile},
        "conan.tools": {},
        "conan.tools.build": {"check_min_cppstd": lambda recipe, least: made.update(least=least),
                              "can_run": lambda recipe: False},
        "conan.tools.cmake": {"CMake": remember("CMake"), "CMakeDeps": remember("CMakeDeps"),
                              "CMakeToolchain": remember("CMakeToolchain"),
                              "cmake_layout": lambda recipe: None},
        "conan.tools.files": {"copy": lambda recipe, pattern, *rest,
                              **named: copied.append(pattern),
                              "load": lambda recipe, path: pathlib.Path(path).read_text(),
                              "rmdir": lambda recipe, path: None}}
    for name, content in modules.items():
        module = types.ModuleType(name)
        vars(module).update(content)
        sys.modules[name] = module


class Conan(unittest.TestCase):
    def load(self, path):
        self.made = {}
        stand_ins(self.made)
        names = {"__name__": "recipe"}
        exec(compile(path.read_text(), str(path), "exec"), names)
        return names

    def recipe(self, **options):
        made = self.load(CONAN / "conanfile.py")["Treeform"]()

        class Options(types.SimpleNamespace):
            def rm_safe(self, name):
                vars(self).pop(name, None)
        made.options = Options(**{**made.default_options, **options})
        made.set_version()
        for step in ("export_sources", "configure", "validate", "requirements", "layout",
                     "generate",
                     "build", "package", "package_info"):
            getattr(made, step)()
        return made

    def test_the_version_is_that_of_the_header(self):
        self.assertEqual(self.recipe().version, version())

    def test_what_the_tree_looks_for_is_required(self):
        libraries = {NAMES[name][1] for name in looked_for(["libtree", "libmesh"])}
        tools = {NAMES[name][1] for name in OF_TOOLS}
        for options, expected in (({}, libraries), ({"tools": True}, libraries | tools)):
            recipe = self.recipe(**options)
            self.assertEqual({one.split("/")[0] for one in recipe.required}, expected)
            # Conan refuses a recipe whose components leave out a package that it requires.
            components = recipe.cpp_info.components.values()
            used = {need.split("::")[0] for one in components for need in one.requires
                    if "::" in need}
            self.assertEqual(used, expected)

    def test_the_options_configure_this_tree(self):
        for options in ({}, {"shared": True, "tools": True}):
            self.recipe(**options)
            values = self.made["CMakeToolchain"].cache_variables
            for name in values:
                if name.startswith("TREEFORM_"):
                    self.assertIn(name, options_of_tree())
            done = configure([f"-D{name}={'ON' if value else 'OFF'}" for name,
                              value in values.items()]
                             + [f"-DBUILD_SHARED_LIBS={options.get('shared', False)}"])
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_component_is_a_library_of_the_tree(self):
        text = "".join((TREE / name).read_text() for name in
                       ("libtree/CMakeLists.txt", "libmesh/CMakeLists.txt",
                        "tools/c/CMakeLists.txt"))
        libraries = set(re.findall(r"^add_library\((treeform_\w+)\b", text, re.M))
        recipe = self.recipe(shared=True)
        self.assertEqual({name for one in recipe.cpp_info.components.values() for name in one.libs},
                         libraries)
        self.assertEqual(self.made["least"], 20)

    def test_what_is_packed_is_there(self):
        self.recipe()
        for pattern in self.made["copied"]:
            self.assertTrue(list(TREE.glob(pattern)), pattern)

    def test_the_program_of_the_test_compiles(self):
        self.assertIn("TreeformTest", self.load(CONAN / "test_package/conanfile.py"))
        done = subprocess.run([os.environ.get("CXX", "g++"), "-std=c++20", "-fsyntax-only", "-Wall",
                               "-Werror", f"-I{TREE}/libtree/include", f"-I{TREE}/libmesh/include",
                               str(CONAN / "test_package/main.cpp")], capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    support.main("the vcpkg port and the Conan recipe, run with stand-ins for vcpkg and Conan")
