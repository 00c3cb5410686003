# SPDX-License-Identifier: MIT
"""Checks the recipe of Conan as far as that is possible without Conan: it runs with stand-ins for what it imports,
exports its sources into an empty folder, and configures them there with the options that it passes.

    conan_recipe.py PROJECT VERSION DESCRIPTION WORK GENERATOR      all from CMake; WORK is a folder to be made anew
"""

import fnmatch
import importlib.util
import itertools
import os
import re
import shutil
import subprocess
import sys
import types

project, version, description, work, generator = sys.argv[1:]
recipes = os.path.join(project, "cmake", "packaging", "conan")


def text_of(*path):
    with open(os.path.join(project, *path), encoding="utf-8") as file:
        return file.read()


def copied(_, pattern, src, dst):
    """Conan's copy(): a * stands for folders, too."""
    count = 0
    for folder, _, names in os.walk(src):
        for name in names:
            path = os.path.relpath(os.path.join(folder, name), src)
            if fnmatch.fnmatch(path, pattern):
                os.makedirs(os.path.dirname(os.path.join(dst, path)), exist_ok=True)
                shutil.copy(os.path.join(src, path), os.path.join(dst, path))
                count += 1
    assert count, f"{src} has nothing like {pattern}"


class Attributes(types.SimpleNamespace):
    """What a recipe may set: settings, or what a component of the package needs."""

    def set_property(self, name, value):
        setattr(self, name, value)


class Components(dict):
    def __missing__(self, name):
        self[name] = Attributes(libs=[], requires=[], defines=[], system_libs=[])
        return self[name]


class Recipe:
    def __init__(self, folder, **options):
        self.recipe_folder = folder
        self.options = types.SimpleNamespace(**{**getattr(type(self), "default_options", {}), **options})
        self.settings = types.SimpleNamespace(os="Linux", arch="x86_64", compiler="gcc", build_type="Release")
        self.required = []
        self.cpp_info = Attributes(components=Components())
        self.tested_reference_str = f"shaftcull/{version}"
        self.cpp = types.SimpleNamespace(build=types.SimpleNamespace(bindir="."))
        self.ran = []

    def requires(self, reference, **_):
        self.required.append(reference)

    def run(self, command, **_):
        self.ran.append(command)


class CMake:
    """Conan's CMake helper: configures, and does not build."""

    def __init__(self, recipe):
        self.recipe = recipe

    def configure(self, build_script_folder=None):
        if build_script_folder:
            self.recipe.configured = build_script_folder
            return
        build = os.path.join(work, "build")
        shutil.rmtree(build, ignore_errors=True)
        values = {"BUILD_SHARED_LIBS": self.recipe.options.shared, **self.recipe.cache_variables}
        self.recipe.passed = [f"-D{name}={'ON' if value else 'OFF'}" for name, value in values.items()]
        output = subprocess.run(
            ["cmake", "-G", generator, "-S", self.recipe.export_sources_folder, "-B", build,
             "-DCMAKE_BUILD_TYPE=Release", *self.recipe.passed],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        assert output.returncode == 0 and "CMake Warning" not in output.stdout, f"{self.recipe.passed}\n{output.stdout}"

    def build(self):
        pass


class Toolchain:
    def __init__(self, recipe):
        self.recipe = recipe
        self.cache_variables = {}

    def generate(self):
        self.recipe.cache_variables = self.cache_variables


def module(name, **members):
    sys.modules[name] = types.ModuleType(name)
    vars(sys.modules[name]).update(members)


module("conan", ConanFile=Recipe)
module("conan.tools")
module("conan.tools.build", check_min_cppstd=lambda _, least: None, stdcpp_library=lambda _: "stdc++",
       can_run=lambda _: True)
module("conan.tools.cmake", CMake=CMake, CMakeToolchain=Toolchain, cmake_layout=lambda _: None,
       CMakeDeps=lambda recipe: types.SimpleNamespace(generate=lambda: None))
module("conan.tools.files", copy=copied, rmdir=lambda *_: None,
       load=lambda _, path: open(path, encoding="utf-8").read())


def recipe_class(*path):
    spec = importlib.util.spec_from_file_location("recipe", os.path.join(recipes, *path))
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return next(value for value in vars(loaded).values()
                if isinstance(value, type) and issubclass(value, Recipe) and value != Recipe)


Shaftcull = recipe_class("conanfile.py")
assert Shaftcull.name == "shaftcull" and Shaftcull.description == description, Shaftcull.description
assert text_of("LICENSE").startswith(f"{Shaftcull.license} License\n"), Shaftcull.license
assert Shaftcull.options.keys() == Shaftcull.default_options.keys()
for name, value in Shaftcull.default_options.items():
    assert value in Shaftcull.options[name], name

cmake = text_of("kernel", "CMakeLists.txt") + text_of("bindings", "c", "CMakeLists.txt")
shutil.rmtree(work, ignore_errors=True)
for shared, with_tbb, with_c in itertools.product([False, True], repeat=3):
    recipe = Shaftcull(recipes, shared=shared, with_tbb=with_tbb, with_c=with_c)
    recipe.set_version()
    assert recipe.version == version, recipe.version
    recipe.validate()
    recipe.requirements()
    packages = [reference.split("/")[0] for reference in recipe.required]
    assert packages == ["xsimd"] + ["onetbb"] * with_tbb, packages
    recipe.layout()
    recipe.generate()
    assert recipe.cache_variables["SHAFTCULL_WITH_TBB"] == with_tbb
    assert recipe.cache_variables["SHAFTCULL_BUILD_C"] == with_c
    if shared == with_c != with_tbb:  # two of the eight, each value of each option once: this takes seconds
        recipe.export_sources_folder = os.path.join(work, "sources")
        shutil.rmtree(recipe.export_sources_folder, ignore_errors=True)
        recipe.export_sources()
        recipe.build()
    recipe.package_info()
    components = recipe.cpp_info.components
    assert list(components) == ["cpp"] + ["c"] * with_c
    assert ("onetbb::onetbb" in components["cpp"].requires) == with_tbb
    assert ("SHAFTCULL_SHARED" in components["cpp"].defines) == shared
    for component in components.values():
        assert f"add_library({component.cmake_target_name} ALIAS {component.libs[0]})" in cmake, component
        assert os.path.exists(os.path.join(project, "cmake", f"{component.pkg_config_name}.pc.in")), component
        for other in component.requires:
            assert other in components or other.split("::")[0] in packages, other

# The package's own test builds a project of ours.
folder = os.path.join(recipes, "test_package")
test = recipe_class("test_package", "conanfile.py")(folder)
test.requirements()
test.build()
test.test()
assert test.required == [f"shaftcull/{version}"]
lists = os.path.join(test.configured, "CMakeLists.txt")
assert os.path.samefile(lists, os.path.join(project, "tests", "consumer", "CMakeLists.txt")), lists
with open(lists, encoding="utf-8") as file:
    assert re.search(rf"^add_executable\({os.path.basename(test.ran[0])} ", file.read(), re.M), test.ran
shutil.rmtree(work)
print("the recipe exports what its options configure, and names targets that there are")
