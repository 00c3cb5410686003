# SPDX-License-Identifier: MIT
"""The wheel: built without the network, installed, and used as a user would."""

import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

import pytest
import shaftcull

PACKAGE = pathlib.Path(__file__).parents[1]
ROOT = PACKAGE.parents[1]


def test_a_wheel_is_built_installed_and_used(tmp_path):
    pytest.importorskip("build", reason="no build (Debian: python3-build)")
    pytest.importorskip("wheel", reason="no wheel (Debian: python3-wheel)")
    copy = tmp_path / "source/bindings/python"
    shutil.copytree(PACKAGE, copy, ignore=shutil.ignore_patterns("build", "dist", "*.egg-info"))
    header = copy.parents[1] / "include/shaftcull/version.hpp"
    header.parent.mkdir(parents=True)
    shutil.copy(ROOT / "include/shaftcull/version.hpp", header)
    shutil.copy(ROOT / "LICENSE", copy.parents[1])
    module = next(pathlib.Path(shaftcull.__file__).parent.glob("_shaftcull.*"))
    environment = {**os.environ, "SHAFTCULL_PYTHON_MODULE": str(module)}
    done = subprocess.run(
        [sys.executable, "-m", "build", "--no-isolation", "--wheel", copy, "--outdir", tmp_path],
        capture_output=True, text=True, env=environment,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    (wheel,) = tmp_path.glob("*.whl")
    # A module of machine code: for this Python and this platform.
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    assert wheel.name.startswith(f"shaftcull-{shaftcull.__version__}-{tag}-{tag}-")
    installed = tmp_path / "installed"
    with zipfile.ZipFile(wheel) as files:
        names = set(files.namelist())
        files.extractall(installed)
    assert {"shaftcull/__init__.py", "shaftcull/__init__.pyi", "shaftcull/py.typed"} <= names
    assert (installed / "shaftcull/__init__.pyi").read_bytes() == module.with_name("__init__.pyi").read_bytes()
    assert [name for name in names if name.startswith("shaftcull/_shaftcull.")]
    assert [name for name in names if name.endswith(".dist-info/LICENSE")]
    assert_it_is_used(installed, tmp_path)


def assert_it_is_used(installed, folder):
    program = "import shaftcull; print(shaftcull.__file__, shaftcull.BoxTree([[0] * 6]).count([0] * 6, [1] * 6))"
    command = [sys.executable, "-c", program]
    environment = {**os.environ, "PYTHONPATH": str(installed)}
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=folder)
    assert done.stdout == f"{installed}/shaftcull/__init__.py 1\n", done.stderr


def test_cmake_installs_the_package_as_a_component(tmp_path):
    build = pathlib.Path(shaftcull.__file__).parents[2]
    if not (build / "cmake_install.cmake").exists():
        pytest.skip("the package is not that of a build folder")
    command = ["cmake", "--install", build, "--component", "shaftcull_python", "--prefix", tmp_path]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    (package,) = tmp_path.rglob("shaftcull")
    assert {file.name for file in package.iterdir()} >= {"__init__.py", "__init__.pyi", "py.typed"}
    stubs = pathlib.Path(shaftcull.__file__).with_name("__init__.pyi")
    assert (package / "__init__.pyi").read_bytes() == stubs.read_bytes()
    assert_it_is_used(package.parent, tmp_path)


def test_importing_the_sources_says_so():
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    command = [sys.executable, "-B", "-c", "import shaftcull"]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=PACKAGE)
    assert f"\nImportError: {PACKAGE}/shaftcull has no compiled module. If it belongs to the sources" in done.stderr
