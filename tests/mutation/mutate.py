#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plants faults in a copy of the library, and finds out which of them the tests notice.

  mutate.py [option...] [FAULT...]     FAULT: names, or patterns of names, of those to try; all of faults.txt otherwise

All faults of faults.txt are planted at once, in build/mutate/source. Which of them is there is chosen at run time, by
the environment variable SHAFTCULL_PLANTED_FAULT, so all are built once. Tests are the entries of CTest of one layer
(tests/layers.cmake), without those with the label `sources`, which do not run the library. For each fault, entries run
until one fails, those of GoogleTest a test at a time: first those whose area is a folder in the path of the fault, then
the others. Of both, those are first that have noticed most for their time.

--layer every tries a fault in the cheapest place first: the layer quick, then ci, then ci under AddressSanitizer, then
under ThreadSanitizer, until one of them notices it.

What is found is written to build/mutate/PRESET/noticed_LAYER.csv, fault by fault. The exit status is 0 if at most --may-miss
faults are not noticed, 1 if more are, and 2 if there was nothing to find out.
"""
from __future__ import annotations

import argparse
import collections
import concurrent.futures
import csv
import dataclasses
import fnmatch
import hashlib
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, NoReturn, Optional, Sequence

ROOT = Path(__file__).resolve().parents[2]
LIST = Path(__file__).resolve().with_name("faults.txt")
MUTATE = ROOT / "build" / "mutate"
SOURCE = MUTATE / "source"

CHOICE = "SHAFTCULL_PLANTED_FAULT"
DECLARATION = """extern __attribute__((visibility("default"))) const int shaftcull_planted_fault;\n"""
DEFINED_IN = "kernel/support/error.cpp"
DEFINITION = f"""
#include <cstdlib>

// Which of the planted faults is there, 0 for none.
const int shaftcull_planted_fault = [] {{
  const char* const chosen = std::getenv("{CHOICE}");
  return chosen == nullptr ? 0 : std::atoi(chosen);
}}();
"""

# A layer's target, and the labels of its entries.
LAYERS = {
    "quick": ("shaftcull_quick_tests", "^quick$"),
    "ci": ("shaftcull_ci_tests", "^(quick|ci)$"),
    "all": ("shaftcull_tests", None),
}
NOT_OF_THE_LIBRARY = "sources"  # label of entries that do not run what is built
USUAL_TIMEOUT = 1500.0  # of CTest, in seconds
LEAST_TIMEOUT = 60.0
SLOWER = 20  # so many times its own time an entry may take with a fault
LEAST_SECONDS = 0.05  # of any test, its program's start included
KEPT_OUTPUT = 8 << 20  # bytes of an entry's output
SHARDING = ("GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX")

COLUMNS = ["kind", "name", "file", "entry", "test", "seconds", "how", "text"]

# Where a fault may be noticed, the cheapest place first: the layer, and the presets that it runs.
PLACES = [("quick", "release"), ("ci", "release"), ("ci", "asan"), ("ci", "tsan")]


class Refusal(Exception):
    """Something that the user has to put right."""


# The list of faults


@dataclass(frozen=True)
class Fault:
    number: int  # from 1 on
    kind: str
    name: str
    file: str
    line: int  # of faults.txt
    removed: tuple[str, ...]
    added: tuple[str, ...]

    @property
    def label(self) -> str:
        return f"{self.kind}.{self.name}"

    @property
    def text(self) -> str:
        """Tells whether it is the same as in an earlier run."""
        parts = [self.kind, self.name, self.file, *self.removed, "", *self.added]
        return hashlib.sha256("\n".join(parts).encode()).hexdigest()[:16]

    def planted(self) -> list[str]:
        chosen = f"(::shaftcull_planted_fault == {self.number})"
        return [re.sub(r"\bFAULT\b", chosen, line) for line in self.added]


def parse_faults(path: Path) -> list[Fault]:
    faults: list[Fault] = []
    names: dict[str, int] = {}

    def refuse(number: int, why: str) -> NoReturn:
        raise Refusal(f"{path.name}:{number}: {why}")

    def add(block: list[tuple[int, str]]) -> None:
        first, heading = block[0]
        words = heading.split()
        if len(words) != 3 or heading[0] in "+-":
            refuse(first, f"a block begins with a kind, a name and a file, not with {heading!r}")
        kind, name, file = words
        if name in names:
            refuse(first, f"the name {name} is that of a fault in line {names[name]}, too")
        names[name] = first
        removed: list[str] = []
        added: list[str] = []
        for number, line in block[1:]:
            if line[0] == "-" and not added:
                removed.append(line[1:].strip())
            elif line[0] == "+" and removed:
                added.append(line[1:].rstrip())
            else:
                refuse(number, "behind the heading come lines that begin with '-', and then such with '+'")
        if not removed or not added:
            refuse(first, f"{name} lacks lines that begin with {'+' if removed else '-'!r}")
        if not any(re.search(r"\bFAULT\b", line) for line in added):
            refuse(first, f"{name} has no FAULT in what it adds: the fault would always be there")
        faults.append(Fault(len(faults) + 1, kind, name, file, first, tuple(removed), tuple(added)))

    block: list[tuple[int, str]] = []
    for number, line in enumerate([*path.read_text(encoding="utf-8").splitlines(), ""], start=1):
        if line.startswith("#"):
            continue
        if line.strip():
            block.append((number, line))
        elif block:
            add(block)
            block = []
    if not faults:
        raise Refusal(f"{path} has no faults")
    return faults


def place_of(fault: Fault, lines: Sequence[str]) -> int:
    """Where the lines of a fault are among those of its file, which are stripped."""
    size = len(fault.removed)
    places = [at for at in range(len(lines) - size + 1) if tuple(lines[at : at + size]) == fault.removed]
    if len(places) == 1:
        return places[0]
    where = f"{LIST.name}:{fault.line}: {fault.label}, {fault.file}: "
    if places:
        raise Refusal(where + "its lines are there more than once: " + ", ".join(f"line {at + 1}" for at in places))
    for count in range(size, 0, -1):  # how far they are found
        for at in range(len(lines) - count + 1):
            if tuple(lines[at : at + count]) != fault.removed[:count]:
                continue
            found = lines[at + count] if at + count < len(lines) else "the end of the file"
            wanted = fault.removed[count]
            raise Refusal(where + f"line {at + count} is found, but then comes\n    {found}\nand not\n    {wanted}")
    raise Refusal(where + f"there is no line\n    {fault.removed[0]}")


def with_faults(text: str, faults: Sequence[Fault]) -> str:
    """The text of a file in which faults are planted."""
    lines = text.splitlines()
    stripped = [line.strip() for line in lines]
    places = sorted(((place_of(fault, stripped), fault) for fault in faults), key=lambda place: place[0])
    for (at, fault), (next_at, other) in zip(places, places[1:]):
        if next_at < at + len(fault.removed):
            raise Refusal(f"{LIST.name}: {fault.label} and {other.label} replace the same line of {fault.file}")
    for at, fault in reversed(places):
        lines[at : at + len(fault.removed)] = fault.planted()
    return DECLARATION + "\n".join(lines) + "\n"


def by_file(faults: Iterable[Fault]) -> dict[str, list[Fault]]:
    files: dict[str, list[Fault]] = collections.defaultdict(list)
    for fault in faults:
        files[fault.file].append(fault)
    return dict(files)


def chosen_faults(faults: Sequence[Fault], patterns: Sequence[str]) -> list[Fault]:
    if not patterns:
        return list(faults)

    def is_named(fault: Fault, pattern: str) -> bool:
        return fnmatch.fnmatchcase(fault.label, pattern) or fnmatch.fnmatchcase(fault.name, pattern)

    for pattern in patterns:
        if not any(is_named(fault, pattern) for fault in faults):
            raise Refusal(f"no fault is called {pattern} (--list shows all)")
    return [fault for fault in faults if any(is_named(fault, pattern) for pattern in patterns)]


# The copy of the sources, and its build


def tracked_files() -> list[str]:
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout.decode()
    return sorted({name for name in listed.split("\0") if name and (ROOT / name).is_file()})


def planted_texts(faults: Sequence[Fault], files: Iterable[str]) -> dict[str, bytes]:
    """The files that differ from the project's."""
    known = set(files)
    texts: dict[str, bytes] = {}
    for file, of_file in by_file(faults).items():
        if file not in known:
            raise Refusal(f"{LIST.name}:{of_file[0].line}: {of_file[0].label}: there is no file {file}")
        texts[file] = with_faults((ROOT / file).read_text(encoding="utf-8"), of_file).encode()
    text = texts.get(DEFINED_IN, DECLARATION.encode() + (ROOT / DEFINED_IN).read_bytes())
    texts[DEFINED_IN] = text + DEFINITION.encode()
    return texts


def copy_sources(faults: Sequence[Fault]) -> None:
    """Writes what is not there already, so that little is built again."""
    files = tracked_files()
    texts = planted_texts(faults, files)
    for name in files:
        content = texts[name] if name in texts else (ROOT / name).read_bytes()
        to = SOURCE / name
        if not to.is_file() or to.read_bytes() != content:
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_bytes(content)
        shutil.copymode(ROOT / name, to)
    known = set(files)
    for path in sorted(SOURCE.rglob("*")):
        if path.is_file() and path.relative_to(SOURCE).as_posix() not in known:
            path.unlink()


def build(preset: str, layer: str, jobs: int) -> Path:
    folder = MUTATE / preset
    options = ["-DSHAFTCULL_BUILD_TESTS=ON", "-DSHAFTCULL_BUILD_PYTHON=AUTO"]
    if layer != "quick":
        options.append("-DSHAFTCULL_BUILD_PROGRAM=ON")
    if preset == "release":
        options.append("-DSHAFTCULL_INSTRUCTION_SETS=BEST" if layer == "quick" else "-USHAFTCULL_INSTRUCTION_SETS")
    steps = [
        ["cmake", "--preset", preset, "-B", str(folder), *options],
        ["cmake", "--build", str(folder), "-j", str(jobs), "--target", LAYERS[layer][0]],
    ]
    for step in steps:
        print("+", " ".join(step), flush=True)
        if subprocess.run(step, cwd=SOURCE, check=False).returncode != 0:
            raise Refusal("the copy with all faults could not be built")
    return folder


# The entries of CTest


@dataclass
class Entry:
    name: str
    command: list[str]
    environment: dict[str, str]
    folder: str
    timeout: float
    skip_code: Optional[int]
    passes: list[re.Pattern[str]]
    fails: list[re.Pattern[str]]
    skips: list[re.Pattern[str]]
    will_fail: bool
    labels: list[str]
    seconds: float = 0  # without a fault
    noticed: int = 0  # faults, so far

    @property
    def price(self) -> float:
        """In seconds for a fault that is noticed, as far as is known."""
        return max(self.seconds, LEAST_SECONDS) / (1 + self.noticed)

    # Scripts may write files of their own to a folder that they are given: they are not run twice at once.
    alone: threading.Lock = field(default_factory=threading.Lock)

    @property
    def is_script(self) -> bool:
        return len(self.command) > 1


def as_list(value: Any) -> list[str]:
    return [str(each) for each in value] if isinstance(value, list) else [str(value)]


def entry_of(described: dict[str, Any], folder: Path) -> Entry:
    properties = {each["name"]: each["value"] for each in described.get("properties", [])}

    def expressions(name: str) -> list[re.Pattern[str]]:
        return [re.compile(each) for each in as_list(properties.get(name, []))]

    skip_code = properties.get("SKIP_RETURN_CODE")
    return Entry(
        name=described["name"],
        command=described.get("command", []),
        environment=dict(each.partition("=")[::2] for each in as_list(properties.get("ENVIRONMENT", []))),
        folder=properties.get("WORKING_DIRECTORY", str(folder)),
        timeout=float(properties.get("TIMEOUT", USUAL_TIMEOUT)),
        skip_code=None if skip_code is None else int(skip_code),
        passes=expressions("PASS_REGULAR_EXPRESSION"),
        fails=expressions("FAIL_REGULAR_EXPRESSION"),
        skips=expressions("SKIP_REGULAR_EXPRESSION"),
        will_fail=bool(properties.get("WILL_FAIL", False)),
        labels=as_list(properties.get("LABELS", [])),
    )


def environment_of(preset: str) -> dict[str, str]:
    """What CTest sets for all entries of a preset: options of sanitizers."""
    presets = json.loads((SOURCE / "CMakePresets.json").read_text(encoding="utf-8"))["testPresets"]
    environment = next((each.get("environment", {}) for each in presets if each["name"] == preset), {})
    return {name: value.replace("${sourceDir}", str(SOURCE)) for name, value in environment.items()}


def entries_of(folder: Path, label: Optional[str], only: Optional[str]) -> list[Entry]:
    command = ["ctest", "--test-dir", str(folder), "--show-only=json-v1", *(["-L", label] if label else [])]
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if run.returncode != 0:
        raise Refusal(f"{' '.join(command)} failed:\n{run.stderr.decode(errors='replace')}")
    all_entries = [entry_of(each, folder) for each in json.loads(run.stdout)["tests"]]
    entries = [
        entry
        for entry in all_entries
        if NOT_OF_THE_LIBRARY not in entry.labels and (only is None or re.search(only, entry.name))
    ]
    if not entries:
        raise Refusal("no entry of CTest is left to run (--layer, --only)")
    return entries


# Running them


@dataclass
class Outcome:
    result: str  # passed, skipped or failed
    how: str = ""  # of one that failed: wrong answer, crash or timeout
    test: str = ""  # the first test of GoogleTest that failed, if that says one
    seconds: float = 0
    output: str = ""


SANITIZER = re.compile(r"ERROR: \w+Sanitizer|WARNING: ThreadSanitizer|: runtime error: ")
FAILED_TEST = re.compile(r"^\[  FAILED  \] ([^\s,(]+[.][^\s,(]+)", re.MULTILINE)


class Runner:
    """Runs entries, each in a group of processes of its own, so that all of them can be ended."""

    def __init__(self) -> None:
        self._mutex = threading.Lock()
        self._running: set[int] = set()
        self._is_stopped = False

    def run(self, entry: Entry, fault: int, timeout: float) -> Outcome:
        if not entry.is_script:
            return self._run(entry, fault, timeout)
        with entry.alone:
            return self._run(entry, fault, timeout)

    def stop(self) -> None:
        """Ends everything that runs, and starts nothing more."""
        with self._mutex:
            self._is_stopped = True
            for group in self._running:
                self._kill(group)

    def _run(self, entry: Entry, fault: int, timeout: float) -> Outcome:
        with tempfile.TemporaryDirectory(prefix="shaftcull-mutate-") as own:
            environment = {**os.environ, **entry.environment, CHOICE: str(fault), "TMPDIR": own}
            if "-P" not in entry.command:  # scripts of CMake run tests in their own way
                environment.update(GTEST_FAIL_FAST="1")
            begin = time.monotonic()
            try:
                process = self._start(entry, environment)
            except OSError as error:
                return Outcome("failed", "crash", output=f"could not be started: {error}")
            output, is_late = self._wait(process, timeout)
            return classified(entry, process.returncode, is_late, output, time.monotonic() - begin)

    def _start(self, entry: Entry, environment: dict[str, str]) -> subprocess.Popen[bytes]:
        with self._mutex:
            if self._is_stopped:
                raise OSError("stopped")
            process = subprocess.Popen(
                entry.command,
                cwd=entry.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            self._running.add(process.pid)
            return process

    def _wait(self, process: subprocess.Popen[bytes], timeout: float) -> tuple[str, bool]:
        """What it writes, and whether it took too long. Nothing of it runs on after that."""
        kept: list[bytes] = []

        def read() -> None:
            assert process.stdout is not None
            size = 0
            while piece := os.read(process.stdout.fileno(), 1 << 16):
                if size < KEPT_OUTPUT:
                    kept.append(piece)
                size += len(piece)

        reader = threading.Thread(target=read, daemon=True)
        reader.start()
        is_late = False
        try:
            process.wait(timeout)
        except subprocess.TimeoutExpired:
            is_late = True
        with self._mutex:
            self._kill(process.pid)
            self._running.discard(process.pid)
        process.wait()
        reader.join(10)
        return b"".join(kept).decode(errors="replace"), is_late

    @staticmethod
    def _kill(group: int) -> None:
        try:
            os.killpg(group, signal.SIGKILL)
        except (ProcessLookupError, PermissionError):
            pass  # all of it has ended


def classified(entry: Entry, code: int, is_late: bool, output: str, seconds: float) -> Outcome:
    """What CTest would say of an entry that ended so."""

    def matches(expressions: list[re.Pattern[str]]) -> bool:
        return any(expression.search(output) for expression in expressions)

    def failed(how: str) -> Outcome:
        test = FAILED_TEST.search(output)
        return Outcome("failed", how, test.group(1) if test else "", seconds, output)

    if is_late:
        return failed("timeout")
    if (code >= 0 and code == entry.skip_code) or matches(entry.skips):
        return Outcome("skipped", seconds=seconds, output=output)
    if code < 0:
        return failed("crash")
    is_right = (bool(entry.passes) or code == 0) and not matches(entry.fails)
    is_right = is_right and (not entry.passes or matches(entry.passes))
    if is_right != entry.will_fail:
        return Outcome("passed", seconds=seconds, output=output)
    return failed("crash" if SANITIZER.search(output) else "wrong answer")


PASSED_TEST = re.compile(r"^\[       OK \] (\S+[.]\S+) \((\d+) ms\)$", re.MULTILINE)


def tests_of(entry: Entry, output: str) -> list[Entry]:
    """The entry once for each test of GoogleTest that it ran; itself if it ran none."""
    kept = {name: value for name, value in entry.environment.items() if name not in SHARDING}
    return [
        dataclasses.replace(
            entry, environment={**kept, "GTEST_FILTER": name}, seconds=int(milliseconds) / 1000, alone=threading.Lock()
        )
        for name, milliseconds in (() if entry.is_script else PASSED_TEST.findall(output))
    ] or [entry]


def run_without_fault(runner: Runner, entries: Sequence[Entry], jobs: int) -> list[Entry]:
    """Those entries that pass, as tests_of() has them."""
    usable: list[Entry] = []
    left_out: list[str] = []

    def run(entry: Entry) -> Outcome:
        if not entry.command or not Path(entry.command[0]).exists():
            return Outcome("skipped", output="not built")
        return runner.run(entry, 0, entry.timeout)

    print(f"{len(entries)} entries without a fault", flush=True)
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        try:
            for entry, outcome in zip(entries, pool.map(run, entries)):
                entry.seconds = outcome.seconds
                if outcome.result == "passed":
                    usable.extend(tests_of(entry, outcome.output))
                    continue
                end = outcome.output.strip().splitlines()[-1:] or [""]
                what = outcome.how if outcome.result == "failed" else outcome.result
                left_out.append(f"  {entry.name}: {what}: {end[0][:120]}")
        except BaseException:
            runner.stop()
            raise
    if left_out:
        print("left out, for without a fault they do not pass:", *left_out, sep="\n", flush=True)
    if not usable:
        raise Refusal("no entry passes without a fault")
    total = sum(entry.seconds for entry in usable)
    print(f"{len(usable)} tests pass, in {total:.0f} s one after the other", flush=True)
    return usable


Row = dict[str, str]


def likely_first(fault: Fault, entries: Sequence[Entry]) -> list[Entry]:
    """The cheapest first, those of the area that the file's folders name before the others."""
    folders = set(re.split(r"[/_.]", fault.file))
    return sorted(entries, key=lambda entry: (re.split(r"[._]", entry.name)[0] not in folders, entry.price))


def try_fault(runner: Runner, fault: Fault, entries: Sequence[Entry]) -> Row:
    begin = time.monotonic()
    row = dict(zip(COLUMNS, [fault.kind, fault.name, fault.file, "", "", "", "", fault.text]))
    for entry in likely_first(fault, entries):
        outcome = runner.run(entry, fault.number, max(LEAST_TIMEOUT, SLOWER * entry.seconds))
        if outcome.result == "failed":
            row.update(entry=entry.name, test=outcome.test, how=outcome.how)
            entry.noticed += 1
            break
    row["seconds"] = f"{time.monotonic() - begin:.1f}"
    return row


# What was found


def known_rows(path: Path, faults: Sequence[Fault]) -> dict[str, Row]:
    """Rows of an earlier run about faults that are still the same, by label. Tests may have changed since."""
    if not path.is_file():
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        rows = {f"{row['kind']}.{row['name']}": row for row in csv.DictReader(file) if set(row) == set(COLUMNS)}
    texts = {fault.label: fault.text for fault in faults}
    return {label: row for label, row in rows.items() if texts.get(label) == row["text"]}


def try_faults(runner: Runner, faults: Sequence[Fault], entries: Sequence[Entry], path: Path, known: dict[str, Row],
               jobs: int) -> dict[str, Row]:
    """Tries those that nothing is known of, and writes down what is found at once."""
    rows = dict(known)
    left = [fault for fault in faults if fault.label not in rows]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows.values())
        file.flush()
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            tries = {pool.submit(try_fault, runner, fault, entries): fault for fault in left}
            try:
                for done, ended in enumerate(concurrent.futures.as_completed(tries), start=1):
                    row = ended.result()
                    rows[tries[ended].label] = row
                    writer.writerow(row)
                    file.flush()
                    found = ", ".join(filter(None, [row["entry"], row["test"], row["how"]])) or "NOT NOTICED"
                    print(f"[{done}/{len(left)}] {tries[ended].label}: {found}, {row['seconds']} s", flush=True)
            except BaseException:
                runner.stop()
                pool.shutdown(wait=True, cancel_futures=True)
                raise
    return rows


def report(faults: Sequence[Fault], rows: dict[str, Row], seconds: float) -> int:
    """Prints how many are noticed, and returns how many are not."""
    missed = [fault for fault in faults if not rows[fault.label]["how"]]
    planted = collections.Counter(fault.kind for fault in faults)
    unnoticed = collections.Counter(fault.kind for fault in missed)
    print(f"\n{'kind':<12}{'planted':>8}{'noticed':>8}")
    for kind, count in planted.items():
        print(f"{kind:<12}{count:>8}{count - unnoticed[kind]:>8}")
    print(f"{'all':<12}{len(faults):>8}{len(faults) - len(missed):>8}")
    ways = collections.Counter(rows[fault.label]["how"] for fault in faults if fault not in missed)
    if ways:
        print("noticed by " + ", ".join(f"{how}: {count}" for how, count in sorted(ways.items())))
    if missed:
        print("not noticed:", *(f"  {fault.label} ({fault.file})" for fault in missed), sep="\n")
    print(f"{seconds:.0f} s")
    return len(missed)


# The page of the documentation

PAGE = ROOT / "docs" / "faults.md"
PAGE_HEAD = """# Planted faults

Which faults do the tests notice? `./cmake/run mutate` plants faults in a copy of the library and finds out
([how](testing.md#mutation)). A fault is noticed if a test answers wrong, crashes or does not end. This page is written by
`./cmake/run mutate --page`.
"""


def write_page(faults: Sequence[Fault]) -> int:
    """Writes the page of what is known, and returns how many faults nobody is known to notice."""
    known = {place: known_rows(MUTATE / place[1] / f"noticed_{place[0]}.csv", faults) for place in PLACES}
    for fault in faults:
        if fault.label not in known[PLACES[0]]:
            raise Refusal(f"{fault.label} was not tried: ./cmake/run mutate {fault.label}")
    lines = ["| fault | file | layer | noticed by |", "|---|---|---|---|"]
    noticed: dict[str, collections.Counter[str]] = collections.defaultdict(collections.Counter)
    for fault in faults:
        noticed[fault.kind]["planted"] += 1
        found = None
        for place in PLACES:
            row = known[place].get(fault.label)
            if row and row["how"]:
                found = (place, row)
                break
        if found is None:
            is_tried = all(fault.label in known[place] for place in PLACES)
            noticed[fault.kind]["none" if is_tried else "not tried"] += 1
            lines.append(f"| {fault.label} | `{fault.file}` | {'none' if is_tried else 'not quick'} | |")
            continue
        (layer, preset), row = found
        noticed[fault.kind][layer] += 1
        test = f", {row['test']}" if row["test"] else ""
        by = row["entry"] + ("" if preset == "release" else f" of {preset}") + test
        how = "" if row["how"] == "wrong answer" else f" ({row['how']})"
        lines.append(f"| {fault.label} | `{fault.file}` | {layer} | {by}{how} |")
    columns = ["planted", "quick", "ci", "none", "not tried"]
    table = ["| kind | planted | noticed by quick | by ci alone | by neither | not by quick, not tried in all of ci |"]
    table.append("|---|---|---|---|---|---|")
    total: collections.Counter[str] = collections.Counter()
    for kind, counts in noticed.items():
        table.append(f"| {kind} | " + " | ".join(str(counts[column]) for column in columns) + " |")
        total.update(counts)
    table.append("| all | " + " | ".join(str(total[column]) for column in columns) + " |")
    PAGE.write_text("\n".join([PAGE_HEAD, *table, "", *lines, ""]), encoding="utf-8")
    return total["none"] + total["not tried"]


def list_faults(faults: Sequence[Fault]) -> None:
    planted_texts(faults, tracked_files())  # refuses those that do not fit
    for fault in faults:
        print(f"{fault.number:4} {fault.label:<28} {fault.file}")
    kinds = collections.Counter(fault.kind for fault in faults)
    print(f"{len(faults)} faults: " + ", ".join(f"{kind} {count}" for kind, count in kinds.items()))


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description="Plants faults in a copy of the library, and finds out which of them the tests notice.",
        epilog="Faults are those of tests/mutation/faults.txt. What is found is in build/mutate/PRESET/noticed_LAYER.csv.",
    )
    parser.add_argument("faults", nargs="*", metavar="FAULT", help="names or patterns of those to try, as ties.* (all)")
    parser.add_argument("--preset", help="of CMakePresets.json (release)")
    parser.add_argument("--layer", choices=[*LAYERS, "every"], default="quick", help="of tests (quick)")
    parser.add_argument("--only", metavar="REGEX", help="only entries with such names")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="at once (processors)")
    parser.add_argument("--resume", action="store_true", help="keep what is known of faults that are the same")
    parser.add_argument("--may-miss", type=int, default=0, metavar="N", help="succeed if so many are not noticed (0)")
    parser.add_argument("--page", action="store_true", help="write what is known to docs/faults.md, and try nothing")
    parser.add_argument("--list", action="store_true", help="print the faults, and whether they fit the sources")
    arguments = parser.parse_args()
    if arguments.jobs < 1:
        parser.error("--jobs is 1 or more")
    if arguments.layer == "every" and arguments.preset:
        parser.error("--layer every has presets of its own")
    return arguments


def rows_of_place(layer: str, preset: str, faults: Sequence[Fault], all_faults: Sequence[Fault],
                  arguments: argparse.Namespace) -> dict[str, Row]:
    """Tries faults in one layer of one preset, and returns their rows."""
    folder = build(preset, layer, arguments.jobs)
    path = folder / f"noticed_{layer}.csv"
    if arguments.only:  # what some entries miss says nothing of the layer
        path = folder / "noticed_only.csv"
    rows = known_rows(path, all_faults)
    if not arguments.resume:
        for fault in faults:
            rows.pop(fault.label, None)
    if any(fault.label not in rows for fault in faults):
        runner = Runner()
        os.environ.update(environment_of(preset))
        os.environ["SHAFTCULL_TEST_LAYER"] = layer  # how many random cases there are (tests/sanitizers.hpp)
        entries = run_without_fault(runner, entries_of(folder, LAYERS[layer][1], arguments.only), arguments.jobs)
        rows = try_faults(runner, faults, entries, path, rows, arguments.jobs)
    return {fault.label: rows[fault.label] for fault in faults}


def main() -> int:
    begin = time.monotonic()
    arguments = parse_arguments()
    all_faults = parse_faults(LIST)
    faults = chosen_faults(all_faults, arguments.faults)
    if arguments.list:
        list_faults(faults)
        return 0
    if arguments.page:
        return 0 if write_page(all_faults) <= arguments.may_miss else 1
    copy_sources(all_faults)
    places = PLACES if arguments.layer == "every" else [(arguments.layer, arguments.preset or "release")]
    rows: dict[str, Row] = {}
    for layer, preset in places:
        left = [fault for fault in faults if fault.label not in rows or not rows[fault.label]["how"]]
        if left:
            rows.update(rows_of_place(layer, preset, left, all_faults, arguments))
    missed = report(faults, rows, time.monotonic() - begin)
    return 0 if missed <= arguments.may_miss else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refusal as refusal:
        print(f"mutate.py: {refusal}", file=sys.stderr)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)
