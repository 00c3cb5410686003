#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of bench/report.py, on a stored summary of a run (summary.json). Skipped, which is 77, without Matplotlib."""
import collections
import html
import importlib.util
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

if importlib.util.find_spec("matplotlib") is None:
    print(f"skipped: {sys.executable} has no Matplotlib (Debian: python3-matplotlib)")
    sys.exit(77)

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.path import Path as Outline
from matplotlib.text import Text

SCRIPT = Path(__file__).resolve().parents[2] / "bench" / "report.py"
sys.path.insert(0, str(SCRIPT.parent))
sys.dont_write_bytecode = True
import report  # noqa: E402

STORED = Path(__file__).with_name("summary.json").read_text(encoding="utf-8")


def stored() -> dict:
    return json.loads(STORED)


def result(per_s: float, vs_paper=None) -> dict:
    return {"per_s": per_s, "vs_paper": vs_paper}


def close_figures() -> dict:
    """A machine whose instruction sets, arithmetic and caches are nearly alike."""
    summary = stored()
    results = summary["results"]
    for i, isa in enumerate(("scalar", "sse4_2", "avx2", "avx512")):
        for name in results:
            if name.startswith("test/") and name.endswith("/" + isa):
                results[name] = result((5 + 0.1 * i) * 1e9, 50 + i)
        results[f"roofline/slab_arithmetic/{isa}"] = result((5 + 0.1 * i) * 1e9)
        results[f"roofline/grid_arithmetic/{isa}"] = result((5.05 + 0.1 * i) * 1e9)
        for j, level in enumerate(("l1", "l2", "l3", "dram")):
            results[f"roofline/read_{level}_bytes/{isa}"] = result((60 - j) * 1e9)
        for n in (1000, 4096, 65536, 1048576, 4194304):
            results[f"sweep/bounds/{n}/{isa}"] = result((5 + 0.01 * i) * 1e9)
            results[f"sweep/one_shaft/{n}/{isa}"] = result((5.02 + 0.01 * i) * 1e9)
    for n in (1, 2):
        results[f"sweep/threads/{n}"] = results[f"sweep/threads_one_shaft/{n}"] = result(n * 4e9)
    summary["machine"]["caches"] = [{"level": level, "type": "Unified", "bytes": 2**(15 + level)} for level in (1, 2, 3)]
    return summary


def far_figures() -> dict:
    """A large 64-bit ARM, whose figures go from slow to fast."""
    summary = stored()
    machine, results = summary["machine"], summary["results"]
    machine.update(isa=["scalar", "portable128", "neon"], cores=192)
    machine["caches"] = [{"level": 1, "type": "Data", "bytes": 65536}, {"level": 2, "type": "Unified", "bytes": 2**20},
                         {"level": 3, "type": "Unified", "bytes": 2**25 - 2**20}]
    names = {"sse4_2": "portable128", "avx2": "neon"}
    for name, value in list(results.items()):
        prefix, _, isa = name.rpartition("/")
        if isa in ("sse4_2", "avx2", "avx512"):
            del results[name]
        if isa in names:
            results[f"{prefix}/{names[isa]}"] = value
        if isa == "scalar":
            value["per_s"] /= 20
            value["vs_paper"] = value["vs_paper"] and value["vs_paper"] / 20
    for n in (1, 2, 4, 8, 16, 32, 64, 96, 128, 192):
        results[f"sweep/threads/{n}"], results[f"sweep/threads_one_shaft/{n}"] = result(n * 4e9), result(7e9)
    for n in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024):
        results[f"sweep/shafts/{n}/neon"], results[f"sweep/shafts/{n}/scalar"] = result(4e9), result(5e7)
    results["roofline/slab_arithmetic/scalar"], results["roofline/grid_arithmetic/neon"] = result(6e7), result(1e10)
    summary["limits"][-1].update(row="form/batch", fraction=1.6)
    return summary


def figures_of(summary: dict) -> dict:
    """The pictures of a summary, by title."""
    return {title: figure for title, _, figure in (plot(summary) for plot in report.PLOTS) if figure}


def drawn(figure) -> dict:
    """What has a tooltip in a picture: the points of each line, by tooltip."""
    lines = (line for axes in figure.axes for line in axes.lines if (line.get_gid() or "").startswith("tip "))
    return {line.get_gid()[4:]: list(zip(*(map(float, data) for data in line.get_data(orig=False)))) for line in lines}


def drawn_texts(figure) -> list:
    """The texts that Matplotlib draws: an axis has labels beyond its ends, too, and leaves them out."""
    texts = []
    draw = Text.draw

    def note(text, renderer):
        if text.get_visible() and text.get_text():
            texts.append(text)
        draw(text, renderer)

    with unittest.mock.patch.object(Text, "draw", note):
        FigureCanvasAgg(figure).draw()
    return texts


def outline(text: Text, renderer) -> Outline:
    """The box around a text, turned as the text is, in pixels."""
    angle = text.get_rotation()
    text.set_rotation(0)
    box = text.get_window_extent(renderer)
    text.set_rotation(angle)
    x, y = text.get_transform().transform(text.get_position())
    turn = complex(math.cos(math.radians(angle)), math.sin(math.radians(angle)))
    corners = ((box.x0, box.y0), (box.x1, box.y0), (box.x1, box.y1), (box.x0, box.y1))
    turned = [complex(x, y) + turn * complex(a - x, b - y) for a, b in corners]
    return Outline([(corner.real, corner.imag) for corner in turned + turned[:1]], closed=True)


class Pictures(unittest.TestCase):
    def test_dots_are_the_figures_of_the_run(self):
        summary = stored()
        figures = figures_of(summary)
        rates = drawn(figures["Tests per second, by instruction set and form"])
        ratios = drawn(figures["Speed relative to the paper's method"])
        measured = 0
        for name, value in summary["results"].items():
            if match := re.fullmatch("test/(boxes|spheres)/(cull|classify)/(slab|planes)/([a-z0-9_]+)", name):
                *words, isa = match.groups()
                row = f"{', '.join(words)}, {report.set_name(isa)}: "
                for dots, figure in ((rates, value["per_s"]), (ratios, value["vs_paper"])):
                    places = [points for tip, points in dots.items() if tip.startswith(row)]
                    self.assertEqual([[x for x, _ in points] for points in places], [[figure]], row)
                measured += 1
        self.assertEqual((len(rates), len(ratios)), (measured, measured + 1))
        self.assertIn("forming shafts, batch, AVX-512: 14 ×", ratios)
        self.assertIn("boxes, cull, slab, AVX-512: 5.82 G", rates)
        shares = drawn(figures["Share of the machine's limit"])
        self.assertEqual([x for x, _ in shares["boxes, classify, slab, AVX2: 42 %"]], [0.4214])
        self.assertEqual(len(shares), 6)  # two_threads is no instruction set

    def test_curves_are_the_figures_of_the_run(self):
        summary = stored()
        figures = figures_of(summary)
        curves = {"By number of boxes": {"64 shafts, AVX2": "bounds/{}/avx2", "64 shafts, AVX-512": "bounds/{}/avx512",
                                         "1 shaft, AVX2": "one_shaft/{}/avx2", "1 shaft, AVX-512": "one_shaft/{}/avx512"},
                  "By number of shafts": {"AVX2": "shafts/{}/avx2", "AVX-512": "shafts/{}/avx512"},
                  "By number of threads": {"64 shafts": "threads/{}", "1 shaft": "threads_one_shaft/{}"},
                  "Roofline": {"AVX2": "shafts/{}/avx2", "AVX-512": "shafts/{}/avx512"}}
        for title, names in curves.items():
            lines = {tip.split(":")[0]: points for tip, points in drawn(figures[title]).items()}
            lines.pop("in proportion", None)
            self.assertEqual(lines.keys(), names.keys(), title)
            for name, points in lines.items():
                pattern = re.compile("sweep/" + names[name].format("([0-9]+)"))
                expected = {float(match[1]): value["per_s"] for key, value in summary["results"].items()
                            if (match := pattern.fullmatch(key))}
                self.assertEqual(dict(points), expected, (title, name))
                self.assertEqual(sorted(points), points)

    def test_roofs_and_bandwidths_are_named_with_their_figures(self):
        texts = [text.get_text() for text in figures_of(stored())["Roofline"].findobj(Text)]
        for text in ("AVX-512, floats: 9.37 G", "AVX2, floats: 4.72 G", "L1, 291 GB/s", "L2, 167 GB/s", "L3, 33 GB/s",
                     "memory, 17 GB/s"):
            self.assertEqual(texts.count(text), 1, text)

    def test_no_text_overlaps_another_or_leaves_its_picture(self):
        for summary in (stored(), close_figures(), far_figures()):
            figures = figures_of(summary)
            self.assertEqual(len(figures), 7)
            for title, figure in figures.items():
                texts = drawn_texts(figure)
                self.assertGreater(len(texts), 5)
                outlines = [outline(text, figure.canvas.get_renderer()) for text in texts]
                for i, (text, box) in enumerate(zip(texts, outlines)):
                    with self.subTest(title, text=text.get_text()):
                        self.assertTrue(all(figure.bbox.contains(*corner) for corner in box.vertices), "leaves the picture")
                        over = [other.get_text() for other, outline_of_other in zip(texts[:i], outlines)
                                if box.intersects_path(outline_of_other, filled=True)]
                        self.assertEqual(over, [])


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.page = report.page_of(stored())

    def test_has_every_plot_and_table(self):
        self.assertEqual(self.page.count("<svg "), 7)
        for title in (*figures_of(stored()), "Figures and targets", "What limits each path"):
            self.assertIn(f"<h2>{html.escape(title)}</h2>", self.page)
        self.assertNotIn("Not measured in this run", self.page)

    def test_has_a_row_of_every_target_and_limit(self):
        rows = [re.findall("<td[^>]*>(.*?)</td>", row) for row in re.findall("<tr>(<td.*?)</tr>", self.page)]
        rows = collections.Counter(row[0] for row in rows)
        summary = stored()
        self.assertEqual(rows, collections.Counter(row["row"] for row in summary["reach"] + summary["limits"]))

    def test_shows_how_much_of_a_target_was_reached(self):
        summary = stored()
        forms = ("a", "b", 0.9, 1.0, "x", "least", False), ("c", "d", 1.5, 1.2, "x", "most", False), \
                ("e", None, 50.0, 60.0, "ns", "most", True), ("f", "g", None, 2.0, "x", "least", False)
        members = "row", "against", "value", "target", "unit", "bound", "met"
        summary["reach"] = [dict(zip(members, form)) for form in forms]
        page = re.sub("<[^>]*>", "|", report.page_of(summary))
        for row in ("|a||b||0.90 ×||≥ 1.00 ×|||90 %|", "|c||d||1.50 ×||≤ 1.20 ×|||80 %|",
                    "|e||time||50.0 ns||≤ 60.0 ns|||✓ 120 %|", "|f||g||–||≥ 2.00 ×|||not measured|"):
            self.assertIn(row, page)
        self.assertIn("|1 of 3|figures of this run reach their target; the others reach 85 % of it (median)|", page)

    def test_reports_the_load_of_the_machine(self):
        summary = stored()
        summary["machine"]["load"] = 5.25
        self.assertIn("Load average when measuring began: 5.2, on 2 threads.", report.page_of(summary))
        summary["machine"]["load"] = None
        self.assertNotIn("Load average", report.page_of(summary))

    def test_refers_to_no_other_file(self):
        for reference in ("<link", "<script", "src=", "@import", "http:", "https:"):
            self.assertNotIn(reference, self.page)
        self.assertEqual(re.findall(r"url\((?!#)", self.page), [])

    def test_gives_every_name_once_and_refers_to_no_other(self):
        names = collections.Counter(re.findall(r'\bid="([^"]*)"', self.page))
        self.assertEqual([name for name, count in names.items() if count > 1], [])
        self.assertLessEqual(set(re.findall(r'(?:href="#|url\(#)([^")]*)', self.page)), set(names))

    def test_takes_all_colours_from_its_variables(self):
        body = self.page[self.page.index("<body>"):]
        self.assertEqual(re.findall(r"(?:fill|stroke): (?!none|var\()[^;\"]*", body), [])
        self.assertEqual(re.findall("#[0-9a-f]{6}", body), [])
        self.assertLessEqual(set(re.findall(r"var\(--([a-z0-9_]+)\)", self.page)), set(report.INKS))
        self.assertIn("prefers-color-scheme: dark", self.page)

    def test_has_tooltips(self):
        for tip in ("boxes, cull, slab, AVX-512: 46 ×", "64 shafts, AVX2: up to 4.30 G tests per second",
                    "AVX-512: 5.71 G tests per second with 1,024 shafts"):
            self.assertIn(f"<title>{tip}</title>", self.page)

    def test_shows_names_as_text(self):
        self.assertIn("Made-up &lt;Processor&gt; &amp; Co.", self.page)
        self.assertNotIn("<Processor>", self.page)

    def test_names_what_a_run_lacks(self):
        parts = {"test/": 2, "sweep/bounds": 0, "sweep/": 3, "roofline/": 1, "": 7}
        for prefix, lacking in parts.items():
            summary = stored()
            results = summary["results"]
            summary["results"] = {name: value for name, value in results.items() if not name.startswith(prefix)} or \
                {"other": result(1)}
            if not prefix:
                summary["limits"] = []
            page = report.page_of(summary)
            lacking -= prefix == "test/"  # of which forming shafts is left
            self.assertEqual(page.count("<svg "), 7 - lacking, prefix)
            self.assertEqual(page.count("“"), lacking, prefix)

    def test_is_the_same_for_the_same_summary(self):
        self.assertEqual(self.page, report.page_of(stored()))


class Program(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.out = self.folder / "out.html"

    def run_it(self, *arguments):
        return subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, check=False)

    def make(self, summary, *arguments):
        """Runs the script on these bytes, text or summary."""
        if isinstance(summary, dict):
            summary = json.dumps(summary, indent=2)
        file = self.folder / "in.json"
        file.write_bytes(summary if isinstance(summary, bytes) else summary.encode())
        return self.run_it("--in", file, "--out", *(arguments or [self.out]))

    def refuse(self, words, outcome):
        """Expects an error of one line that holds these words, and nothing else."""
        error = outcome.stderr.decode()
        self.assertEqual((outcome.returncode, outcome.stdout, error.count("\n")), (1, b"", 1), error)
        self.assertIn(words, error)

    def refuse_summary(self, words, summary):
        with self.subTest(words):
            self.out.write_text("old")
            self.refuse(f"{self.folder / 'in.json'}: {words}", self.make(summary))
            self.assertEqual(self.out.read_text(), "old")
            self.assertEqual(sorted(os.listdir(self.folder)), ["in.json", "out.html"])

    def test_writes_the_page(self):
        outcome = self.make(STORED)
        self.assertEqual((outcome.returncode, outcome.stderr), (0, b""))
        self.assertEqual(outcome.stdout.decode(), f"Written to {self.out}.\n")
        self.assertEqual(self.out.read_text(encoding="utf-8"), report.page_of(stored()))
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.json", "out.html"])

    def test_reads_files_as_editors_on_windows_write_them(self):
        outcome = self.make(b"\xef\xbb\xbf" + STORED.replace("\n", "\r\n").encode(), self.folder / "räume λ 屋.html")
        self.assertEqual((outcome.returncode, outcome.stderr), (0, b""))
        self.assertEqual((self.folder / "räume λ 屋.html").read_text(encoding="utf-8"), report.page_of(stored()))

    def test_writes_to_standard_output_for_a_minus(self):
        outcome = self.make(STORED, "-")
        self.assertEqual((outcome.returncode, outcome.stdout.decode(), outcome.stderr), (0, report.page_of(stored()), b""))

    def test_replaces_the_file_behind_a_link(self):
        link = self.folder / "link.html"
        self.out.write_text("old")
        link.symlink_to(self.out)
        self.assertEqual(self.make(STORED, link).returncode, 0)
        self.assertTrue(link.is_symlink())
        self.assertTrue(self.out.read_text(encoding="utf-8").startswith("<!DOCTYPE html>"))

    def test_reports_where_a_page_cannot_be_written(self):
        (self.folder / "file").write_text("")
        below = self.folder / "file" / "report.html"
        self.refuse(f"{below}: cannot be written: Not a directory", self.make(STORED, below))
        self.refuse(f"{self.folder}: cannot be written: Is a directory", self.make(STORED, self.folder))
        self.refuse("/dev/full: cannot be written: No space left on device", self.make(STORED, "/dev/full"))
        self.assertTrue(Path("/dev/full").is_char_device())

    def test_refuses_a_file_that_cannot_be_read(self):
        missing = self.folder / "none.json"
        words = f"{missing}: No such file or directory; ./cmake/run bench makes a summary"
        self.refuse(words, self.run_it("--in", missing, "--out", self.out))
        self.refuse("Is a directory", self.run_it("--in", self.folder, "--out", self.out))

    def test_refuses_text_that_is_not_json(self):
        self.refuse_summary("Expecting value: line 1 column 1", "")
        self.refuse_summary("Expecting value: line 1 column 1", "speed!")
        self.refuse_summary("Expecting ':' delimiter: line 3 column 7", '{\n"machine": {\n"cpu" 7}}')
        half = STORED[:len(STORED) // 2]
        self.refuse_summary(f"Unterminated string starting at: line {half.count(chr(10)) + 1} column 1", half)
        self.refuse_summary("'utf-8' codec can't decode byte 0xff in position 0", b"\xff\xfe{}")
        self.refuse_summary("maximum recursion depth exceeded", "[" * 100_000)
        self.refuse_summary("Exceeds the limit", "1" * 10_000)

    def test_refuses_json_that_is_not_a_summary(self):
        self.refuse_summary("the whole is a list, not an object", "[]")
        self.refuse_summary('the whole lacks "machine"', "{}")
        for member in report.SUMMARY:
            summary = stored()
            del summary[member]
            self.refuse_summary(f'the whole lacks "{member}"', summary)

    def test_refuses_every_member_of_a_wrong_kind(self):
        """Each value of the summary that the page uses, in place of which there is one of another kind."""
        wrong = dict(zip(report.KINDS, (7, "yes", 1.5, -1, 0)))
        tried = 0
        for place, form in members_of(report.SUMMARY):
            summary = stored()
            around = summary
            for key in place[:-1]:
                around = around[key]
            around[place[-1]] = value = wrong[form.removesuffix(" or null")]
            names = [str(key) for key in place]
            self.assertEqual(complaint(summary), f"{'/'.join(names)} is {json.dumps(value)}, not {form}")
            del around[place[-1]]
            if isinstance(around, dict):
                self.assertEqual(complaint(summary), f"{'/'.join(names[:-1])} lacks \"{names[-1]}\"")
            tried += 1
        self.assertEqual(tried, 26)

    def test_refuses_figures_that_cannot_be(self):
        for words, value in (('is "fast", not a number above 0', "fast"), ("is 0, not a number above 0", 0),
                             ("is true, not a number above 0", True), ("is an object, not a number above 0", {"a": 1}),
                             ("is NaN, not a number above 0", math.nan), ("is Infinity, not a number above 0", math.inf),
                             ('is "' + "x" * 39 + "…, not a number above 0", "x" * 100)):
            summary = stored()
            summary["results"]["form/batch"]["per_s"] = value
            self.refuse_summary("results/form/batch/per_s " + words, summary)
        summary = stored()
        summary["results"]["two\nlines"] = None
        self.refuse_summary("results/two\\nlines is null, not an object", summary)
        summary["results"] = {}
        self.refuse_summary("results is empty", summary)
        summary = stored()
        summary["limits"][1]["ceilings"] = []
        self.refuse_summary("limits/1/ceilings is empty", summary)


def complaint(summary: dict) -> str:
    try:
        report.check(summary, report.SUMMARY)
    except ValueError as error:
        return str(error)
    return "none"


def members_of(form, place=()):
    """Every place of a form, with the first member in place of every one, and its kind."""
    if isinstance(form, str):
        yield place, form
    elif isinstance(form, list):
        yield from members_of(form[0], (*place, 0))
    else:
        for key, inner in form.items():
            yield from members_of(inner, (*place, "form/batch" if key == "*" else key))


if __name__ == "__main__":
    unittest.main()
