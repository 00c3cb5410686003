#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws docs/speed.svg from the summary of a run: the time of other methods divided by the time of shaftcull.

    build/bench/bin/shaftcull-bench --filter "$(bench/chart.py --filter)" && bench/chart.py
"""
from __future__ import annotations

import argparse
import io
import re
import sys
from pathlib import Path
from typing import NamedTuple, Optional

import report

ROOT = Path(__file__).resolve().parents[1]


class Bar(NamedTuple):
    """A method, the task, and the rows of the benchmark. {best} stands for the best instruction set of the machine."""

    method: str
    task: str
    ours: str
    theirs: str


BARS = [Bar("Boost R-tree", "1 M boxes, 1 % replaced and 1 % moved", "dynamic/1m/frame", "dynamic/1m/frame_boost"),
        Bar("Bullet btDbvt", "boxes swept through a tree of 1 M boxes", "tree/tiny_short/tree", "tree/tiny_short/bullet"),
        Bar("The paper’s method", "4 M boxes against 64 shafts", "test/boxes/cull/slab/{best}", "paper/boxes_cull"),
        Bar("Bullet btDbvt", "1 M boxes, 1 % replaced and 1 % moved", "dynamic/1m/frame", "dynamic/1m/frame_bullet"),
        Bar("Embree", "visible part of pairs in a city, 16 rays each", "sees/city/anywhere/16",
            "sees/city/anywhere/16/embree"),
        Bar("Six planes, rounded", "2,048 boxes against a camera", "hull/frustum/boxes/{best}", "hull/six_planes/boxes/avx2"),
        Bar("Uniform grid", "short sweeps among 100,000 equal boxes", "tree/equal_short/tree/{best}",
            "tree/equal_short/grid/{best}")]


def pattern() -> str:
    """The filter of shaftcull-bench that measures all bars."""
    rows = {row.replace("{best}", "[^/]+") for bar in BARS for row in (bar.ours, bar.theirs)}
    return "^(" + "|".join(sorted(rows)) + ")(/|$)"  # names go on with how often a row is run


def ratio_of(summary: dict, bar: Bar, best: str) -> Optional[float]:
    """The time of the other method over ours; None if a row was not measured."""
    ours, theirs = (report.result_of(summary, row.replace("{best}", best)) for row in (bar.ours, bar.theirs))
    return ours / theirs if ours and theirs else None


def text_of(ratio: float) -> str:
    """Two digits, and no exponent."""
    return f"{ratio:.2f}" if ratio < 1 else f"{ratio:.1f}" if ratio < 10 else f"{ratio:.0f}"


def chart_of(summary: dict) -> bytes:
    """The chart as SVG. Raises ValueError, which names the rows, if something was not measured."""
    best = report.best_set(summary)
    ratios = [ratio_of(summary, bar, best) for bar in BARS]
    missing = [f"{bar.ours} and {bar.theirs}" for bar, ratio in zip(BARS, ratios) if ratio is None]
    if missing:
        raise ValueError(f"the run lacks {missing[0]}; measure with --filter \"$(bench/chart.py --filter)\"")
    bars = sorted(((bar, ratio) for bar, ratio in zip(BARS, ratios) if ratio), key=lambda entry: -entry[1])
    known = [ratio for _, ratio in bars]
    axes = report.new_axes(860, 70 + 44 * len(BARS), 330, 60)
    axes.set_xscale("log")
    axes.set_xlim(min(0.25, min(known) / 2), 2 * max(known))
    axes.set_ylim(len(BARS) - 0.4, -0.6)
    axes.grid(False)
    axes.set_yticks([])
    axes.spines["bottom"].set_visible(False)
    axes.set_xticks([])
    axes.minorticks_off()
    axes.axvline(1, color=report.LIGHT["muted"], linewidth=1)
    axes.text(1, -0.75, "shaftcull = 1", color=report.LIGHT["muted"], ha="center", va="bottom")
    for place, (bar, ratio) in enumerate(bars):
        ink = report.LIGHT["avx2" if ratio >= 1 else "avx512"]
        axes.barh(place, ratio - 1, left=1, height=0.5, color=ink)
        to_left = ratio < 1
        axes.annotate(f"{text_of(ratio)} ×", (ratio, place), xytext=(-6 if to_left else 6, 0),
                      textcoords="offset points", ha="right" if to_left else "left", va="center", weight="bold")
        left = axes.get_xlim()[0]
        axes.annotate(bar.method, (left, place), xytext=(-12, 8), textcoords="offset points", ha="right", va="center",
                      weight="bold")
        axes.annotate(bar.task, (left, place), xytext=(-12, -8), textcoords="offset points", ha="right", va="center",
                      color=report.LIGHT["muted"])
    axes.figure.set_facecolor(report.LIGHT["card"])
    stream = io.BytesIO()
    machine = summary["machine"]
    description = f"{machine['cpu']}, {report.set_name(best)}, {machine['compiler']}, {machine['date'][:10]}"
    axes.figure.savefig(stream, format="svg", metadata={"Date": None, "Description": description})
    svg = stream.getvalue().decode("utf-8")
    svg = re.sub(r"-?\d+\.\d{3,}", lambda digits: f"{float(digits.group(0)):.2f}", svg)
    return re.sub(r"[ \t]+\n", "\n", svg).encode("utf-8")


def main() -> Optional[str]:
    """Draws the chart. Returns what was wrong, in one line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--in", dest="summary", metavar="FILE", default=str(ROOT / "build" / "bench" / "summary.json"),
                        help="the summary of the run (default: build/bench/summary.json)")
    parser.add_argument("--out", metavar="FILE", default=str(ROOT / "docs" / "speed.svg"),
                        help="the chart; - is standard output (default: docs/speed.svg)")
    parser.add_argument("--filter", action="store_true", help="print the filter that measures all bars, and stop")
    options = parser.parse_args()
    if options.filter:
        print(pattern())
        return None
    try:
        report.write(chart_of(report.read_summary(options.summary)), options.out)
    except (OSError, RecursionError, ValueError) as error:
        return f"chart.py: {options.summary}: {getattr(error, 'strerror', None) or error}"
    return None


if __name__ == "__main__":
    sys.exit(main())
