# SPDX-License-Identifier: MIT
"""The type stubs say what the module has."""

import ast
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest
import shaftcull

sys.path.append(str(pathlib.Path(__file__).parents[1]))
from stubs import docstring, member

PACKAGE = pathlib.Path(shaftcull.__file__).resolve().parent
STUBS = ast.parse((PACKAGE / "__init__.pyi").read_text())


def parameters(function):
    """Names, kinds and defaults, without types."""
    arguments = function.args
    assert not arguments.posonlyargs and arguments.vararg is None and arguments.kwarg is None
    names = [argument.arg for argument in arguments.args]
    without = len(names) - len(arguments.defaults)
    defaults = [None] * without + [ast.unparse(default) for default in arguments.defaults]
    named = list(zip(names, defaults))
    keywords = [
        (argument.arg, None if default is None else ast.unparse(default))
        for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults)
    ]
    return named, keywords


def declared():
    """Functions of the stubs, by qualified name."""
    for node in STUBS.body:
        if isinstance(node, ast.FunctionDef):
            yield node.name, node
        elif isinstance(node, ast.ClassDef):
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    yield f"{node.name}.{member.name}", member


def signature(thing):
    """What a function takes: pybind11 writes it in the first line of the docstring."""
    return f"function{inspect.signature(thing)}" if inspect.isfunction(thing) else thing.__doc__.splitlines()[0]


@pytest.mark.parametrize("name, stub", declared(), ids=[name for name, _ in declared()])
def test_stubs_have_the_parameters_of_the_module(name, stub):
    thing = member(name.split("."))
    if isinstance(thing, property) or name.endswith(".__len__"):
        return
    named, keywords = parameters(ast.parse(f"def {signature(thing)}: ...").body[0])
    wanted_named, wanted_keywords = parameters(stub)
    assert [(argument, default) for argument, default in named] == wanted_named
    assert keywords == wanted_keywords


def test_stubs_name_all_that_there_is():
    wanted = {name for name, _ in declared()}
    classes = [node for node in STUBS.body if isinstance(node, ast.ClassDef)]
    wanted |= {f"{node.name}.{x.target.id}" for node in classes for x in node.body if isinstance(x, ast.AnnAssign)}
    for name in shaftcull.__all__:
        thing = getattr(shaftcull, name)
        if inspect.isclass(thing) and not issubclass(thing, Exception):
            for member in vars(thing):
                if not member.startswith("_") or member in ("__len__", "__getitem__"):
                    assert f"{name}.{member}" in wanted
        elif not inspect.isclass(thing) and name != "__version__":
            assert name in wanted
    assert {node.name for node in classes} == {name for name in shaftcull.__all__ if inspect.isclass(getattr(shaftcull, name))}


def test_stubs_have_the_docstrings_of_the_module():
    """The build writes them."""
    classes = [(node.name, node) for node in STUBS.body if isinstance(node, ast.ClassDef)]
    for name, node in [*classes, *declared()]:
        if not name.endswith((".__init__", ".__iter__", ".__len__")):
            assert (ast.get_docstring(node) or "") == docstring(member(name.split("."))), name
    assert not [line for line in (PACKAGE / "__init__.pyi").read_text().splitlines() if len(line) > 120]


def test_everything_has_a_description():
    for name, stub in declared():
        text = docstring(member(name.split(".")))
        assert "__" in name or len(text.split()) > 2, name
        # Calls that take arguments say what refuses them.
        names, keywords = parameters(stub)
        if "__" not in name and len(names) + len(keywords) > ("." in name):
            assert re.search("Errors|Error|BadBound", text), name
    for name in shaftcull.__all__:
        if inspect.isclass(getattr(shaftcull, name)):
            assert docstring(getattr(shaftcull, name))


def test_mypy_agrees(tmp_path):
    """Stubs are valid, and name what is there. That classes have a metaclass of pybind11's is no matter of theirs."""
    pytest.importorskip("mypy", reason="no mypy (Debian: python3-mypy)")
    allowed = tmp_path / "allowed"
    classes = [name for name in shaftcull.__all__ if inspect.isclass(getattr(shaftcull, name))]
    allowed.write_text("\n".join(rf"shaftcull\.{name}(\.__init__)?" for name in classes))
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent), "PYTHONPATH": str(PACKAGE.parent)}
    done = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "shaftcull", "--ignore-missing-stub", "--allowlist", allowed,
         "--ignore-unused-allowlist"],
        capture_output=True, text=True, cwd=tmp_path, env=environment,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert (PACKAGE / "py.typed").exists()


def test_a_program_that_uses_it_passes_the_type_checker(tmp_path):
    pytest.importorskip("mypy", reason="no mypy (Debian: python3-mypy)")
    program = tmp_path / "program.py"
    program.write_text(
        "import numpy as np\n"
        "import shaftcull\n"
        "tree = shaftcull.BoxTree(np.zeros((3, 6), dtype=np.float32))\n"
        "shafts = shaftcull.Shafts.between([0] * 6, [1] * 6, contact='open')\n"
        "lists = tree.list(shafts[:1], exclude_each=[[0, 1]])\n"
        "reveal_type(tree.order)\n"
        "tree.list(shafts, owner=3)\n"
    )
    environment = {**os.environ, "MYPYPATH": str(PACKAGE.parent), "PYTHONPATH": str(PACKAGE.parent)}
    command = [sys.executable, "-m", "mypy", "--cache-dir", tmp_path, program]
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert re.search(r'program.py:6: note: Revealed type is ".*ndarray\[.*unsignedinteger', done.stdout), done.stdout
    assert re.search(r'program.py:7: error: Unexpected keyword argument "owner"', done.stdout)
    assert "Found 1 error" in done.stdout


def test_the_version_is_that_of_the_library():
    assert re.fullmatch(r"\d+\.\d+\.\d+", shaftcull.__version__)
    header = pathlib.Path(__file__).parents[3] / "include/shaftcull/version.hpp"
    numbers = re.findall(r"#define SHAFTCULL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", header.read_text())
    assert shaftcull.__version__ == ".".join(numbers)
