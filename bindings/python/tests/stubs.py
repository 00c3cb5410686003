# SPDX-License-Identifier: MIT
"""Writes the docstrings of the built module into the stubs, where editors read them. python.stubs compares both.

    PYTHONPATH=build/release/python python3 bindings/python/tests/stubs.py
"""

import ast
import inspect
import pathlib
import textwrap

import shaftcull

STUBS = pathlib.Path(__file__).parents[1] / "shaftcull/__init__.pyi"


def member(path):
    """What the module has by a dotted name: functions of static methods, properties themselves."""
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
    """The text of stubs, with the docstrings of the module in place of those that it has."""
    lines = stubs.splitlines()
    for node, text in documented(ast.parse(stubs)):
        text = f'"""{text}"""' if "\n" not in text else f'"""{text}\n"""'
        first = node.body[0]
        start = end = node.lineno  # behind the line of a class that has members and no docstring
        if isinstance(first, ast.Expr) and first.value.value is ...:
            start = end = first.end_lineno
            lines[start - 1] = lines[start - 1].removesuffix(" ...")
        elif isinstance(first, ast.Expr):
            start, end = first.lineno - 1, first.end_lineno
        lines[start:end] = textwrap.indent(text, " " * (node.col_offset + 4)).splitlines()
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    STUBS.write_text(with_docstrings(STUBS.read_text()))
