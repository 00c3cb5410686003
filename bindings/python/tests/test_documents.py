# SPDX-License-Identifier: MIT
"""What the pages say of Python."""

import ast
import contextlib
import io
import pathlib
import re

import shaftcull

ROOT = pathlib.Path(__file__).parents[3]
PAGE = (ROOT / "docs/python.md").read_text()


def blocks():
    """Lines that are indented by four, in which an empty line may stand."""
    for block in re.findall(r"(?:^    .*\n(?:\n(?=    ))?)+", PAGE, re.MULTILINE):
        yield re.sub("^    ", "", block, flags=re.MULTILINE)


def is_python(block):
    try:
        ast.parse(block)
    except SyntaxError:
        return False
    return True


def test_the_page_runs():
    printed, names, run = io.StringIO(), {}, 0
    with contextlib.redirect_stdout(printed):
        for block in filter(is_python, blocks()):
            exec(compile(block, "docs/python.md", "exec"), names)
            run += 1
    assert run == 5
    assert printed.getvalue() == "[ True False]\n" and f"`{printed.getvalue().strip()}`" in PAGE
    assert names["counts"].shape == (500,) and len(names["lists"]) == 500 and (names["hit"] != -1).any()
    assert names["tops"].max() > 50 and names["moves"].shape == (1,)
    assert len(names["clear"]) > 100 and len(names["in_the_way"]) > 0
    assert all(names["sees"].counts[kind] > 100 for kind in ("undecided", "clear"))


def test_every_verb_is_a_method():
    """The first column of the table names verbs of C++, the second one methods, perhaps with an argument."""
    table = dict(re.findall(r"^\| `(\w+)` \| (`\w.*?`) \|", PAGE, re.MULTILINE))
    rows = re.findall(r"^\| [^|`]+ \|((?: (?:–|`[a-z_]+`) \|){2,})$", (ROOT / "docs" / "questions.md").read_text(), re.MULTILINE)
    verbs = {re.sub("_many$", "", verb) for row in rows for verb in re.findall("`([a-z_]+)`", row)}
    assert len(verbs) >= 12 and verbs == set(table)
    for methods in table.values():
        for method, argument in re.findall(r"`(?:Shafts\.)?(\w+)(?:\((\w+)=\w+\))?`", methods):
            signature = (getattr(shaftcull.BoxTree, method, None) or getattr(shaftcull.Shafts, method)).__doc__
            assert argument is None or argument in signature.splitlines()[0]


def test_the_page_names_what_there_is():
    for name in re.findall(r"`(?:shaftcull\.)?([A-Z][a-z]\w+)(?:\.\w+)?(?:\(.*?\))?`", PAGE):
        builtin = {"TypeError", "ValueError", "IndexError", "RuntimeError", "InvalidArgument"}
        assert name in builtin or hasattr(shaftcull, name), name
