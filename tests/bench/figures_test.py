#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The list of times in the documentation: what bench/figures.py finds wrong with it."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

FIGURES = pathlib.Path(__file__).resolve().parents[2] / "bench/figures.py"
LISTED = "README.md\ttakes 12 ns alone\tform/one\n"


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "docs").mkdir()
        self.write("A shaft\ntakes 12 ns alone.", LISTED)

    def write(self, readme, listed):
        (self.root / "README.md").write_text(readme, encoding="utf-8")
        (self.root / "docs/figures.tsv").write_text(listed, encoding="utf-8")

    def run_with(self, *options, results=None):
        """The exit status, and all that is printed."""
        arguments = [sys.executable, str(FIGURES), "--root", str(self.root), *options]
        if results is not None:
            summary = self.root / "summary.json"
            rows = {row: {"per_s": 1e9 / time} for row, time in results.items()}
            summary.write_text(json.dumps({"results": rows}), encoding="utf-8")
            arguments.append(str(summary))
        done = subprocess.run(arguments, capture_output=True, text=True, check=False, encoding="utf-8")
        return done.returncode, done.stdout + done.stderr

    def test_all_times_of_the_project_are_listed(self):
        done = subprocess.run([sys.executable, str(FIGURES), "--words"], capture_output=True, text=True, check=False,
                              encoding="utf-8")
        self.assertEqual((done.returncode, done.stdout + done.stderr), (0, ""))

    def test_a_list_of_all_times_is_right(self):
        self.assertEqual(self.run_with("--words"), (0, ""))

    def test_a_time_that_is_not_listed_is_shown(self):
        self.write("A shaft takes 12 ns alone, and 3 to 4 µs together.", LISTED)
        status, said = self.run_with("--words")
        self.assertEqual(status, 1)
        self.assertIn("3 to 4 µs", said)

    def test_words_that_are_gone_are_shown(self):
        self.write("A shaft takes no time.", LISTED)
        status, said = self.run_with("--words")
        self.assertEqual(status, 1)
        self.assertIn('does not say "takes 12 ns alone"', said)

    def test_a_time_needs_a_row(self):
        self.write("A shaft takes 12 ns; 15 ns or more.", "README.md\t12 ns; 15 ns or\tform/one\n")
        status, said = self.run_with("--words")
        self.assertEqual(status, 1)
        self.assertIn("2 times", said)

    def test_times_are_compared_with_the_best_set_of_a_row(self):
        status, said = self.run_with(results={"form/one/avx2": 90, "form/one/avx512": 13})
        self.assertEqual(status, 0, said)
        self.assertIn("13 ns", said)

    def test_times_that_are_not_as_stated_are_shown(self):
        for time, verdict in ((30, "longer"), (5, "shorter")):
            status, said = self.run_with(results={"form/one": time})
            self.assertEqual(status, 1)
            self.assertIn(verdict, said)

    def test_times_of_another_machine_are_scaled_by_the_papers_table(self):
        status, said = self.run_with(results={"form/one": 24, "paper/form_table": 208.8})
        self.assertEqual(status, 0, said)
        self.assertIn("multiplied by 0.50", said)

    def test_a_row_that_was_not_measured_is_shown(self):
        status, said = self.run_with(results={"form/batch": 5})
        self.assertEqual(status, 1)
        self.assertIn("missing", said)


if __name__ == "__main__":
    unittest.main()
