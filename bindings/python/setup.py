# SPDX-License-Identifier: MIT
"""Builds the extension module with CMake. All else is said in pyproject.toml.

Environment: CMAKE_ARGS, more arguments for CMake; SHAFTCULL_PYTHON_MODULE, a module that was built already, with
the stubs beside it.
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parents[2]


class BuildWithCMake(build_ext):
    def build_extension(self, extension):
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        module = pathlib.Path(os.environ.get("SHAFTCULL_PYTHON_MODULE") or self.build_module())
        shutil.copy(module, target)
        shutil.copy(module.with_name("__init__.pyi"), target.parent)  # these have docstrings

    def build_module(self):
        folder = pathlib.Path(self.build_temp).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        arguments = [
            *(["-G", "Ninja"] if shutil.which("ninja") else []),
            "-DCMAKE_BUILD_TYPE=Release",
            "-DSHAFTCULL_BUILD_PYTHON=ON",
            f"-DPython3_EXECUTABLE={sys.executable}",
            "-DSHAFTCULL_BUILD_C=OFF",
            "-DSHAFTCULL_INSTALL=OFF",
            *shlex.split(os.environ.get("CMAKE_ARGS", "")),
        ]
        subprocess.run(["cmake", "-S", ROOT, "-B", folder, *arguments], check=True)
        jobs = str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", folder, "--target", "shaftcull_python", "--parallel", jobs], check=True)
        return next((folder / "python/shaftcull").glob("_shaftcull.*"))


def version():
    numbers = re.findall(
        r"^#define SHAFTCULL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)$",
        (ROOT / "include/shaftcull/version.hpp").read_text(),
        re.MULTILINE,
    )
    return ".".join(numbers)


setup(
    version=version(),
    ext_modules=[Extension("shaftcull._shaftcull", sources=[])],
    cmdclass={"build_ext": BuildWithCMake},
)
