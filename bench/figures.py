#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the times that the README, headers and some pages give with a run of the benchmark.

    ./cmake/run bench && bench/figures.py            compares, and fails if a time is more than half as long again
    bench/figures.py --words                         looks at the words only, which needs no benchmark

docs/figures.tsv has a line for each time in these files: the file, the words that give it, and the row of the
benchmark that measures it, in nanoseconds an item. Of a row that is measured on several instruction sets, the best one
counts, unless its name has one. A line with more times has as many rows. A row "-" says that no row measures the time.

Ratios carry over to other machines, times do not. So all times of a run are scaled by that of a row that has been the
same for long, the paper's method with its table of 64, from what it took where the figures are from.
"""
import argparse
import glob
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FILES = ["README.md", "docs/speed.md", "docs/when-to-use.md", "docs/which-call.md",
         "include/shaftcull/*.hpp", "include/shaftcull.h"]
NUMBER = r"\d+(?:\.\d+)?"
TIME = re.compile(rf"(?<![\w.])({NUMBER})(?:(?: to |–)({NUMBER}))? (ns|µs|ms)\b")
IN_NANOSECONDS = {"ns": 1, "µs": 1e3, "ms": 1e6}
SETS = ["avx512", "avx2", "neon", "sse4_2", "portable128", "scalar"]
MOST = 1.5  # of a stated time, and of its inverse
SCALE = ("paper/form_table", 104.4)  # its nanoseconds on the machine that stated times are from


def words_of(path):
    """The text of a file in one line, without signs of comments."""
    text = path.read_text(encoding="utf-8")
    if path.suffix != ".md":
        text = re.sub(r"\n\s*///? ?", " ", text)
    return re.sub(r"\s+", " ", text)


def read_figures(path):
    """Yields (line number, file, words, rows)."""
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line or line.startswith("#"):
            continue
        fields = line.split("\t")
        if len(fields) != 3:
            raise SystemExit(f"{path.name}:{number}: a line has three fields, with tabs between them")
        yield number, fields[0], fields[1], fields[2].split(" ")


def check_words(root, figures):
    """What is wrong with the list: words that are not there, and times that it lacks."""
    wrong = []
    texts = {}
    for pattern in FILES:
        for name in sorted(glob.glob(str(root / pattern))):
            path = pathlib.Path(name)
            texts[path.relative_to(root).as_posix()] = words_of(path)
    listed = {name: set() for name in texts}
    for number, name, words, rows in figures:
        if name not in texts:
            wrong.append(f"figures.tsv:{number}: {name} is no file whose times are listed")
            continue
        places = [m.start() for m in re.finditer(re.escape(words), texts[name])]
        if not places:
            wrong.append(f'figures.tsv:{number}: {name} does not say "{words}"')
        times = TIME.findall(words)
        if len(times) != len(rows):
            wrong.append(f'figures.tsv:{number}: "{words}" has {len(times)} times, and there are {len(rows)} rows')
        for place in places:
            listed[name].update(place + m.start() for m in TIME.finditer(words))
    for name, text in texts.items():
        for time in TIME.finditer(text):
            if time.start() not in listed[name]:
                near = text[max(0, time.start() - 40):time.end() + 20]
                wrong.append(f'{name}: docs/figures.tsv lacks the time in "…{near}…"')
    return wrong


def measured(row, results):
    """Nanoseconds an item, or None."""
    for name in [row] + [f"{row}/{one}" for one in SETS]:
        if name in results:
            return 1e9 / results[name]["per_s"]
    return None


def compare(figures, results):
    """Prints a line for each time. Returns how many are not as stated."""
    bad = 0
    reference = measured(SCALE[0], results)
    scale = 1 if reference is None else SCALE[1] / reference
    if reference is not None:
        print(f"{SCALE[0]} takes {reference:.1f} ns here: times are multiplied by {scale:.2f}\n")
    print(f"{'stated':>16} {'measured':>12}         row")
    for _, name, words, rows in figures:
        for (low, high, unit), row in zip(TIME.findall(words), rows):
            if row == "-":
                continue
            least, most = float(low) * IN_NANOSECONDS[unit], float(high or low) * IN_NANOSECONDS[unit]
            stated = f"{low}–{high} {unit}" if high else f"{low} {unit}"
            time = measured(row, results)
            time = None if time is None else scale * time
            if time is None:
                verdict, shown, bad = "missing", "-", bad + 1
            else:
                shown = f"{time / IN_NANOSECONDS[unit]:.3g} {unit}"
                verdict = "" if least / MOST <= time <= most * MOST else "longer" if time > most else "shorter"
                bad += verdict != ""
            print(f"{stated:>16} {shown:>12} {verdict:8}{row}  ({name})")
    return bad


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("summary", nargs="?", type=pathlib.Path, default=ROOT / "build/bench/summary.json")
    parser.add_argument("--words", action="store_true", help="look at the words only")
    parser.add_argument("--root", type=pathlib.Path, default=ROOT, help="where the files are")
    options = parser.parse_args()
    figures = list(read_figures(options.root / "docs/figures.tsv"))
    wrong = check_words(options.root, figures)
    for problem in wrong:
        print(problem, file=sys.stderr)
    if options.words or wrong:
        return 1 if wrong else 0
    try:
        results = json.loads(options.summary.read_text(encoding="utf-8"))["results"]
    except (OSError, ValueError, KeyError) as problem:
        print(f"{options.summary}: no summary of the benchmark ({problem}): ./cmake/run bench writes one", file=sys.stderr)
        return 1
    bad = compare(figures, results)
    print(f"\n{bad} times are not as stated" if bad else "\nall times are as stated")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
