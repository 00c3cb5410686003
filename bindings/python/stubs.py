# SPDX-License-Identifier: MIT
"""Writes the docstrings of a built module into the stubs beside it, where editors read them. The build calls this.

    python3 bindings/python/stubs.py build/release/python/shaftcull/__init__.pyi
"""

import ast
import inspect
import pathlib
import sys
import textwrap

STUBS = pathlib.Path(__file__).parent / "shaftcull/__init__.pyi"


def member(path):
    """What the module has by a dotted name: functions of static methods, properties themselves."""
    import shaftcull

    thing = shaftcull
    for name in path:
        thing = inspect.getattr_static(thing, name)
        thing = getattr(thing, "__func__", thing)
    return thing


def docstring(thing):
    """Without the signature, which pybind11 writes in the first line of functions."""
    text = inspect.getdoc(thing) or ""
    if inspect.isroutine(thing) and not inspect.isfunction(thing):
        text = text.partition("\n")[2]
    return text.strip()


def documented(node, path=()):
    """Classes and functions of the stubs that have a docstring in the module, the last ones first."""
    for child in reversed(node.body):
        if isinstance(child, (ast.ClassDef, ast.FunctionDef)):
            yield from documented(child, (*path, child.name))
    if path and docstring(member(path)) and not path[-1] in ("__init__", "__iter__", "__len__"):
        yield node, docstring(member(path))


def with_docstrings(stubs):
    """The text of stubs that have no docstrings, with those of the module."""
    lines = stubs.splitlines()
    for node, text in documented(ast.parse(stubs)):
        text = f'"""{text}"""' if "\n" not in text else f'"""{text}\n"""'
        first = node.body[0]
        behind = node.lineno  # the line of a class that has members
        if isinstance(first, ast.Expr):
            behind = first.end_lineno
            lines[behind - 1] = lines[behind - 1].removesuffix(" ...")
        lines[behind:behind] = textwrap.indent(text, " " * (node.col_offset + 4)).splitlines()
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    built = pathlib.Path(sys.argv[1]).resolve()
    sys.path[0] = str(built.parents[1])  # in place of this folder, which has the package without the module
    built.write_text(with_docstrings(STUBS.read_text()))
