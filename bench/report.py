#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes a page of plots and tables from the summary that `shaftcull-bench` writes (harness/summary.hpp).

The page is one HTML file that refers to no other. Matplotlib draws its plots as SVG, whose colours follow the reader's
choice of light or dark. The same summary always gives the same page.
"""
from __future__ import annotations

import argparse
import io
import json
import math
import os
import re
import statistics
import sys
from contextlib import suppress
from html import escape
from pathlib import Path
from typing import Any, Callable, Optional, Sequence

try:
    import matplotlib
    from matplotlib.figure import Figure
    from matplotlib.ticker import EngFormatter, LogLocator, MaxNLocator
except ImportError as missing:
    sys.exit(f"report.py: Matplotlib is missing ({missing}); Debian has it as python3-matplotlib")

# ---- The summary -----------------------------------------------------------------------------------------------------

KINDS = {"a text": lambda value: isinstance(value, str),
         "true or false": lambda value: isinstance(value, bool),
         "a whole number from 0": lambda value: type(value) is int and 0 <= value < 1e15,
         "a number from 0": lambda value: type(value) in (int, float) and 0 <= value < 1e15,
         "a number above 0": lambda value: type(value) in (int, float) and 0 < value < 1e15}
TEXT, BOOLEAN, COUNT, NUMBER, POSITIVE = KINDS

# The form of a summary: an object lists the members that it must have, or the form of every member as that of "*". A
# list has the form of its elements, and `...` behind it if it must not be empty.
SUMMARY = {
    "machine": {"cpu": TEXT, "cores": COUNT, "isa": [TEXT], "compiler": TEXT, "load": NUMBER + " or null", "date": TEXT,
                "caches": [{"level": COUNT, "type": TEXT, "bytes": POSITIVE}]},
    "run": {"quick": BOOLEAN, "bounds": POSITIVE, "shafts": POSITIVE},
    "results": {"*": {"per_s": POSITIVE, "vs_paper": POSITIVE + " or null"}},
    "reach": [{"row": TEXT, "against": TEXT + " or null", "value": POSITIVE + " or null", "target": POSITIVE,
               "unit": TEXT, "bound": TEXT, "met": BOOLEAN}],
    "limits": [{"row": TEXT, "per_s": POSITIVE, "fraction": POSITIVE,
                "ceilings": [{"what": TEXT, "per_s": POSITIVE}, ...]}],
}


def check(value: Any, form: Any, place: str = "") -> None:
    """Raises ValueError, which names the place, the value there and the rule, for a value that has not the form."""
    here = place or "the whole"
    if isinstance(form, str):
        rule, fits = form, KINDS[form.removesuffix(" or null")](value) or (value is None and form.endswith(" or null"))
    else:
        rule, fits = "an object" if isinstance(form, dict) else "a list", isinstance(value, type(form))
    if not fits:
        shown = {dict: "an object", list: "a list"}.get(type(value)) or json.dumps(value)
        raise ValueError(f"{here} is {shown if len(shown) <= 40 else shown[:40] + '…'}, not {rule}")
    if isinstance(form, str):
        return
    if not value and (... in form or "*" in form):
        raise ValueError(f"{here} is empty")
    if isinstance(form, list):
        members = {index: form[0] for index in range(len(value))}
    else:
        members = dict.fromkeys(value, form["*"]) if "*" in form else form
    for key, inner in members.items():
        if isinstance(value, dict) and key not in value:
            raise ValueError(f'{here} lacks "{key}"')
        name = json.dumps(key).strip('"')
        check(value[key], inner, f"{place}/{name}" if place else name)


def read_summary(path: str) -> dict:
    """The summary in a file. Raises OSError, RecursionError or ValueError if it cannot be read or is not a summary."""
    with open(path, encoding="utf-8-sig") as file:
        summary = json.load(file)
    check(summary, SUMMARY)
    return summary


def result_of(summary: dict, name: str, member: str = "per_s") -> Optional[float]:
    """A member of the result of a benchmark; None if it was not measured."""
    return summary["results"].get(name, {}).get(member)


def points_of(summary: dict, prefix: str, suffix: str = "") -> list[tuple[int, float]]:
    """(number, tests per second) of the benchmarks PREFIX/number/SUFFIX, by number."""
    pattern = re.compile(re.escape(prefix) + "/([1-9][0-9]{0,14})" + re.escape(suffix and "/" + suffix))
    matches = ((pattern.fullmatch(name), result["per_s"]) for name, result in summary["results"].items())
    return sorted((int(match[1]), rate) for match, rate in matches if match)


# ---- Inks, marks and axes --------------------------------------------------------------------------------------------

# Colours on light and on dark pages. Matplotlib draws with the light ones, and the page replaces each of these by the
# variable of CSS that has both. Those of AVX2 and AVX-512 are Okabe and Ito's, for colour-blind readers.
INKS = {"page": ("#fbfbfa", "#161615"), "card": ("#ffffff", "#1f1f1e"), "line": ("#e3e3e0", "#353533"),
        "text": ("#1c1c1a", "#ecece8"), "muted": ("#6a6a66", "#a3a39d"), "good": ("#00705b", "#3fc9a5"),
        "scalar": ("#7a7a76", "#a9a9a3"), "portable128": ("#7a3d9a", "#c792ea"), "neon": ("#00705a", "#3fc9a5"),
        "sse4_2": ("#a06a00", "#e6a117"), "avx2": ("#0067a5", "#5cb8ee"), "avx512": ("#c24a00", "#ff8c4d")}
LIGHT = {name: light for name, (light, _) in INKS.items()}

# Names and marks of instruction sets, slowest first. The ink of each has the name of its key.
SETS = {"scalar": ("scalar", "o"), "portable128": ("portable", "v"), "neon": ("NEON", "P"), "sse4_2": ("SSE4.2", "s"),
        "avx2": ("AVX2", "^"), "avx512": ("AVX-512", "D")}

matplotlib.rcdefaults()  # the reader's own settings change nothing
matplotlib.rcParams.update({
    "svg.fonttype": "none", "svg.hashsalt": "shaftcull", "font.family": ["DejaVu Sans"], "font.size": 11,
    "figure.facecolor": "none", "axes.facecolor": "none", "axes.edgecolor": LIGHT["muted"], "text.color": LIGHT["text"],
    "axes.labelcolor": LIGHT["muted"], "xtick.labelcolor": LIGHT["muted"], "ytick.labelcolor": LIGHT["muted"],
    "xtick.major.size": 0, "ytick.major.size": 0, "xtick.major.pad": 6, "ytick.major.pad": 8, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.left": False, "axes.spines.right": False, "axes.grid": True,
    "axes.grid.axis": "y", "grid.color": LIGHT["line"], "axes.titlelocation": "left", "axes.titlesize": 11,
    "axes.titlecolor": LIGHT["muted"], "axes.titlepad": 21, "lines.markersize": 6, "lines.markeredgewidth": 0.5,
    "lines.markeredgecolor": LIGHT["card"]})

with_prefix = EngFormatter(places=2)  # 4.21e9 is 4.21 G


def percent(share: float, _: Any = None) -> str:
    return f"{100 * share:.0f} %"


def set_name(isa: str) -> str:
    return SETS[isa][0] if isa in SETS else isa


def best_set(summary: dict) -> str:
    """The machine's best instruction set, of those that have a mark."""
    return next((isa for isa in reversed(summary["machine"]["isa"]) if isa in SETS), "scalar")


def new_axes(width: float, height: float, left: float, right: float, bottom: float = 42, top: float = 40) -> Any:
    """Axes in a figure of their own, with these margins, in pixels."""
    figure = Figure(figsize=(width / 72, height / 72), dpi=72)
    inner = (width - left - right) / width, (height - bottom - top) / height
    return figure.add_axes((left / width, bottom / height, *inner))


def set_log_ticks(axis: Any, formatter: Any, widest: float) -> None:
    """Ticks at 1, 2 and 5 times powers of ten, or at the powers alone where high / low is above `widest`."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < widest * low else (1,)))
    axis.set_major_formatter(formatter)


def apart(places: Sequence[float], gap: float) -> list[float]:
    """Places in [0, 1] in the same order, of which those that are too close are moved until they are `gap` apart."""
    moved = list(places)
    order = sorted(range(len(moved)), key=moved.__getitem__)
    for lower, upper in zip(order, order[1:]):
        moved[upper] = max(moved[upper], moved[lower] + gap)
    for rank, i in enumerate(reversed(order)):
        moved[i] = min(moved[i], 1 - rank * gap)
    return moved


def write_labels(axes: Any, x: float, labels: Sequence[tuple[float, str, str]], height: float, **style: Any) -> None:
    """Writes labels, each (y, text, ink), at x of the width of the axes: at y, or where they do not overlap."""
    to_axes = axes.transScale + axes.transLimits
    places = [to_axes.transform((axes.get_xlim()[0], y))[1] for y, _, _ in labels]
    gap = height / (axes.get_position().height * axes.figure.get_figheight() * 72)
    for place, (_, text, ink) in zip(apart(places, gap), labels):
        axes.text(x, place, text, color=LIGHT[ink], transform=axes.transAxes, va="center", **style)


# ---- Plots: each function returns a title, a caption, and a figure or None if too little of it was measured ----------

# A name for the benchmarks test/…, and the benchmark of the paper's method, which does not classify spheres.
JOBS = {f"test/{bounds}/{verb}/{form}/": (f"{bounds}, {verb}, {form}", "paper/" + paper.format(verb))
        for bounds, paper in (("boxes", "boxes_{}"), ("spheres", "spheres_cull"))
        for verb in ("cull", "classify") for form in ("slab", "planes")}
Plot = tuple[str, str, Optional[Figure]]
Values = list[tuple[str, Optional[float]]]  # of instruction sets or inks; those that are None are left out


def draw_dots(rows: Sequence[tuple[str, Values, Values]], text_of: Callable, tick_text_of: Callable,
              shares: bool = False) -> Optional[Figure]:
    """Rows of a name, dots of instruction sets, and ticks to compare with, from top to bottom. x is linear for shares."""
    rows = [(name, *([(ink, x) for ink, x in values if x] for values in row)) for name, *row in rows]
    rows = [row for row in rows if row[1]]
    if not rows:
        return None
    axes = new_axes(360, 62 + 34 * len(rows), 14, 14, 26, 36)
    values = [x for _, dots, ticks in rows for _, x in dots + ticks]
    if shares:
        axes.set_xlim(0, 1.02 * max(values))
        axes.set_xticks([0, 0.25, 0.5, 0.75, 1])
        axes.xaxis.set_major_formatter(tick_text_of)
    else:
        axes.set_xscale("log")
        axes.set_xlim(min(values) / 1.15, max(values) * 1.15)
        set_log_ticks(axes.xaxis, tick_text_of, 200)
    axes.set(ylim=(len(rows) - 0.5, -0.5), yticks=[])
    axes.minorticks_off()
    axes.grid(axis="x")
    for y, (name, dots, ticks) in enumerate(rows):
        best, most = max(dots, key=lambda dot: dot[1])
        words = {"transform": axes.get_yaxis_transform(), "va": "center"}
        axes.text(0, y - 0.28, name, **words)
        axes.text(1, y - 0.28, text_of(most), ha="right", color=LIGHT[best], **words)
        axes.hlines(y + 0.14, min(x for _, x in dots), most, color=LIGHT["line"])
        for ink, x in ticks:
            axes.vlines(x, y - 0.06, y + 0.34, color=LIGHT[ink], lw=2)
        for isa, x in dots:
            axes.plot(x, y + 0.14, SETS[isa][1], c=LIGHT[isa], ms=8, clip_on=False,
                      gid=f"tip {name}, {set_name(isa)}: {text_of(x)}")
    used = [isa for isa in SETS if any(isa == ink for _, dots, _ in rows for ink, _ in dots)]
    marks = [axes.plot([], [], SETS[isa][1], c=LIGHT[isa], ms=8, label=set_name(isa))[0] for isa in used]
    axes.legend(handles=marks, loc="lower left", bbox_to_anchor=(0, 1), ncol=len(used), borderaxespad=0.6, borderpad=0,
                handlelength=1, handletextpad=0.3, columnspacing=1.2, labelcolor="markerfacecolor", frameon=False)
    return axes.figure


def plot_rates(summary: dict) -> Plot:
    rows = [(name, [(isa, result_of(summary, job + isa)) for isa in SETS], [("muted", result_of(summary, paper))])
            for job, (name, paper) in JOBS.items()]
    run = summary["run"]
    return ("Tests per second, by instruction set and form",
            f"One thread, {run['shafts']:,.0f} shafts × {run['bounds']:,.0f} bounds, results as bits. Grey ticks are the "
            "paper's method.", draw_dots(rows, with_prefix, EngFormatter()))


def plot_ratios(summary: dict) -> Plot:
    targets = {row["row"]: row["target"] for row in summary["reach"] if (row["against"] or "").startswith("paper/")}
    benchmarks = {name: {isa: job + isa for isa in SETS} for job, (name, _) in JOBS.items()}
    benchmarks["forming shafts, batch"] = {best_set(summary): "form/batch"}
    rows = [(name, [(isa, result_of(summary, row, "vs_paper")) for isa, row in of_sets.items()],
             [(isa, targets.get(row)) for isa, row in of_sets.items()]) for name, of_sets in benchmarks.items()]
    return ("Speed relative to the paper's method",
            "Both were measured in this run. Ticks are targets, in the colours of their instruction sets.",
            draw_dots(rows, lambda ratio: f"{ratio:.{1 if ratio < 9.95 else 0}f} ×", lambda ratio, _: f"{ratio:g} ×"))


def plot_shares(summary: dict) -> Plot:
    share = {path["row"]: path["fraction"] for path in summary["limits"]}
    paths = {job: name for job, (name, _) in JOBS.items()} | {"memory/cull/": "boxes, cull, one shaft, from memory"}
    rows = [(name, [(isa, share.get(path + isa)) for isa in SETS], [("muted", 1)]) for path, name in paths.items()]
    rows.append(("forming shafts, batch", [(best_set(summary), share.get("form/batch"))], [("muted", 1)]))
    return ("Share of the machine's limit",
            "Arithmetic and memory each limit a path; the share is of the lower limit. The table below names it.",
            draw_dots(rows, percent, percent, shares=True))


def draw_curves(curves: Sequence[tuple[str, str, str, list]], x_label: str, base: Optional[int],
                text_of: Callable = lambda number, _: f"{number:,.0f}") -> Any:
    """Axes with curves (name, ink, line style, points); x has ticks at powers of a base. None without two points."""
    curves = [curve for curve in curves if len(curve[3]) > 1]
    if not curves:
        return None
    axes = new_axes(360, 270, 42, 84)
    if base:
        axes.set_xscale("log", base=base)
    axes.xaxis.set_major_locator(LogLocator(base) if base else MaxNLocator(6, integer=True))
    axes.xaxis.set_major_formatter(text_of)
    axes.minorticks_off()
    axes.set(xlabel=x_label, title="tests per second",
             xlim=(min(points[0][0] for *_, points in curves), max(points[-1][0] for *_, points in curves)),
             ylim=(0, 1.05 * max(rate for *_, points in curves for _, rate in points)))
    axes.yaxis.set_major_locator(MaxNLocator(7, steps=[1, 2, 5, 10]))
    axes.yaxis.set_major_formatter(EngFormatter())
    for name, ink, style, points in curves:
        most = with_prefix(max(rate for _, rate in points))
        axes.plot(*zip(*points), c=LIGHT[ink], ls=style, marker=SETS[ink][1] if ink in SETS else "", clip_on=False,
                  gid=f"tip {name}: up to {most} tests per second")
    ends = [(points[-1][1], name.replace(", ", ",\n"), ink) for name, ink, _, points in curves]
    write_labels(axes, 1.04, ends, 28 if any("\n" in text for _, text, _ in ends) else 15)
    return axes


def plot_bounds(summary: dict) -> Plot:
    kinds = (f"{summary['run']['shafts']:.0f} shafts", "bounds", "-"), ("1 shaft", "one_shaft", "--")
    curves = [(f"{shafts}, {set_name(isa)}", isa, style, points_of(summary, f"sweep/{family}", isa))
              for isa in dict.fromkeys(["avx2", best_set(summary)]) for shafts, family, style in kinds]
    axes = draw_curves(curves, "boxes", 16, lambda n, _: f"{n / 1024:.0f} K" if n < 2**20 else f"{n / 2**20:.0f} M")
    if axes:
        low, high = axes.get_xlim()
        caches = [cache for cache in summary["machine"]["caches"]  # each is full of boxes of 24 bytes at a place of x
                  if cache["type"] != "Instruction" and low < cache["bytes"] / 24 < high]
        places = [math.log(cache["bytes"] / 24 / low, high / low) for cache in caches]
        for place, cache in zip(apart(places, 0.31), caches):
            axes.axvline(cache["bytes"] / 24, color=LIGHT["muted"], lw=1, ls=":")
            kib = cache["bytes"] / 1024
            axes.text(place, 1.01, f"L{cache['level']}, " + (f"{kib:.0f} KiB" if kib < 1024 else f"{kib / 1024:.0f} MiB"),
                      color=LIGHT["muted"], transform=axes.transAxes)
    return ("By number of boxes",
            "Many shafts share each box that is read, so their speed does not depend on the number of boxes. One shaft "
            "reads each box for itself, and slows down where the boxes outgrow a cache.", axes and axes.figure)


def plot_shafts(summary: dict) -> Plot:
    sets = dict.fromkeys(["avx2", best_set(summary)])
    axes = draw_curves([(set_name(isa), isa, "-", points_of(summary, "sweep/shafts", isa)) for isa in sets], "shafts", 4)
    return ("By number of shafts", f"One thread, {summary['run']['bounds'] // 4:,.0f} boxes. The more shafts share a box "
            "that is read, the less each of them pays for reading it.", axes and axes.figure)


def plot_threads(summary: dict) -> Plot:
    best = best_set(summary)
    many, one = points_of(summary, "sweep/threads"), points_of(summary, "sweep/threads_one_shaft")
    ideal = [(threads, many[0][1] * threads / many[0][0]) for threads, _ in many]
    axes = draw_curves([(f"{summary['run']['shafts']:.0f} shafts", best, "-", many), ("1 shaft", best, "--", one),
                        ("in proportion", "muted", ":", ideal)], "threads", None)
    return ("By number of threads", f"{set_name(best)}, {summary['run']['bounds']:,.0f} boxes, by wall-clock time.",
            axes and axes.figure)


def plot_roofline(summary: dict) -> Plot:
    """What memory and arithmetic allow, and how far below that culling boxes with more and more shafts lies."""
    roofs = [(rate, isa, numbers) for isa in SETS for kind, numbers in (("slab", "floats"), ("grid", "16 bits"))
             if (rate := result_of(summary, f"roofline/{kind}_arithmetic/{isa}"))]
    highest, fastest, _ = max(roofs, default=(0, "scalar", ""))
    # A box takes 24 bytes, so a byte that is read once for n shafts is n / 24 tests.
    slopes = [(rate / 24, name) for level, name in (("l1", "L1"), ("l2", "L2"), ("l3", "L3"), ("dram", "memory"))
              if (rate := result_of(summary, f"roofline/read_{level}_bytes/{fastest}"))]
    curves = {isa: points_of(summary, "sweep/shafts", isa) for _, isa, _ in roofs}
    return ("Roofline",
            "A box takes 24 bytes. Left of a bend, reading is the limit; right of it arithmetic is: that of floats or, for "
            f"groups of eight shafts and more, of 16-bit integers. Reading was measured on six streams, with "
            f"{set_name(fastest)}. Points are {summary['run']['bounds'] // 4:,.0f} boxes on one thread.",
            draw_roofline(roofs, slopes, curves, highest) if slopes else None)


def draw_roofline(roofs: list, slopes: list, curves: dict, highest: float) -> Figure:
    steepest, flattest = max(slopes)[0], min(slopes)[0]
    low, high = min(highest / steepest / 6, 1), 1536  # so far left that the steepest line has room for its label
    axes = new_axes(760, 400, 52, 150)
    axes.set_xscale("log", base=4)
    axes.set_yscale("log")
    rates = [flattest * low] + [rate for points in curves.values() for _, rate in points]
    axes.set(xlim=(low, high), ylim=(0.8 * min(rates), 1.6 * highest), title="tests per second",
             xlabel="shafts that share each box that is read")
    axes.xaxis.set_major_formatter(lambda shafts, _: f"{shafts:,.0f}" if shafts >= 1 else "")
    set_log_ticks(axes.yaxis, EngFormatter(), 10_000)
    axes.minorticks_off()
    for slope, _ in slopes:
        end = min(high, highest / slope)
        axes.plot([low, end], [slope * low, slope * end], c=LIGHT["muted"], lw=1.3)
    (x0, y0), (x1, y1) = axes.transData.transform([(low, flattest * low), (high, flattest * high)])
    angle, near = math.atan2(y1 - y0, x1 - x0), 1.15 * low
    write_labels(axes, math.log(near / low, high / low),
                 [(slope * near, f"{name}, {24e-9 * slope:.0f} GB/s", "muted") for slope, name in slopes],
                 15 / math.cos(angle), rotation=math.degrees(angle), rotation_mode="anchor",
                 bbox={"facecolor": LIGHT["card"], "edgecolor": "none", "pad": 1.5})
    for rate, isa, _ in roofs:
        axes.plot([max(low, rate / steepest), high], [rate, rate], c=LIGHT[isa], lw=1.3)
    names = [(rate, f"{set_name(isa)}, {numbers}: {with_prefix(rate)}", isa) for rate, isa, numbers in roofs]
    write_labels(axes, 1.01, names, 15)
    for isa, points in curves.items():
        if points:
            count, rate = points[-1]
            axes.plot(*zip(*points), c=LIGHT[isa], marker=SETS[isa][1], ms=7, lw=1.3,
                      gid=f"tip {set_name(isa)}: {with_prefix(rate)} tests per second with {count:,} shafts")
    return axes.figure


PLOTS = plot_rates, plot_ratios, plot_shares, plot_bounds, plot_shafts, plot_threads, plot_roofline

# ---- The page --------------------------------------------------------------------------------------------------------

CSS = """* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text); font: 15px/1.5 system-ui, -apple-system, "Segoe UI",
  "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; overflow-wrap: break-word; }
main { max-width: 1240px; margin: 0 auto; padding: 32px 20px 64px; }
h1, h2 { font-size: 26px; line-height: 1.25; margin: 0; }
h2 { font-size: 17px; }
p { margin: 4px 0 0; color: var(--muted); }
.tiles, .plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(200px, 1fr)); gap: 16px; margin: 20px 0; }
.plots { grid-template-columns: repeat(auto-fit, minmax(min(100%, 340px), 1fr)); }
.tiles div { border-left: 3px solid var(--avx2); padding: 2px 0 2px 12px; color: var(--muted); }
.tiles b { display: block; font-size: 26px; line-height: 1.2; color: var(--text); }
figure, section { margin: 0 0 16px; padding: 18px; background: var(--card); border: 1px solid var(--line);
  border-radius: 8px; }
.plots > * { margin: 0; display: flex; flex-direction: column; }
figure .scroll { margin-top: auto; padding-top: 12px; }
svg { display: block; width: 100%; max-width: 480px; height: auto; margin: 0 auto; }
svg text { font-family: inherit !important; }
.wide { grid-column: 1 / -1; }
.wide svg { min-width: 620px; max-width: 1000px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; margin-top: 12px; }
th, td { padding: 5px 16px 5px 0; border-bottom: 1px solid var(--line); vertical-align: top; text-align: left; }
th { font-weight: 600; color: var(--muted); }
.n { text-align: right; white-space: nowrap; }
.met { color: var(--good); }
.below { font-weight: 600; }
.none { color: var(--muted); }
@media (max-width: 480px) { main { padding: 20px 12px 40px; } figure, section { padding: 12px; } }
"""


def plot_html(number: int, title: str, caption: str, figure: Figure) -> str:
    """A plot as an element of the page, with names of its own, the page's colours, and tooltips."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    svg = buffer.getvalue()
    svg = re.sub(r"(?s)<metadata>.*?</metadata>|<style.*?</style>|<!--.*?-->", "", svg[svg.index("<svg"):])
    svg = re.sub(r'<svg [^>]*?(viewBox="[^"]*")[^>]*>', rf'<svg role="img" aria-label="{escape(title)}" \1>', svg)
    svg = re.sub(r'<g id="tip ([^"]*)">', r"<g><title>\1</title>", svg)
    svg = re.sub(r'(\bid="|href="#|url\(#)', rf"\g<1>plot{number}-", svg)
    for name, light in LIGHT.items():
        svg = svg.replace(light, f"var(--{name})")
    return (f'<figure{" class=wide" if figure.get_figwidth() > 6 else ""}>\n<h2>{escape(title)}</h2>\n'
            f'<p>{escape(caption)}</p>\n<div class="scroll">{svg}</div></figure>\n')


def table(title: str, note: str, columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table of cells in HTML. Columns whose names begin with > have their cells on the right."""
    def line(tag: str, cells: Sequence[str]) -> str:
        kinds = [' class="n"' * column.startswith(">") for column in columns]
        return "<tr>" + "".join(f"<{tag}{kind}>{cell}</{tag}>" for kind, cell in zip(kinds, cells)) + "</tr>\n"

    head = line("th", [column.lstrip(">") for column in columns])
    return (f'<section><h2>{title}</h2>\n<p>{note}</p>\n<div class="scroll"><table>\n<thead>{head}</thead>\n<tbody>\n'
            f'{"".join(line("td", row) for row in rows)}</tbody></table></div></section>\n')


def share_of_target(row: dict) -> Optional[float]:
    """At least 1 where the target is met, else the part of it that was reached. None if it was not measured."""
    if row["value"] is None:
        return None
    return row["target"] / row["value"] if row["bound"] == "most" else row["value"] / row["target"]


def targets_table(summary: dict) -> str:
    def cells(row: dict) -> list[str]:
        measured, target = (f"{value:.1f} ns" if row["unit"] == "ns" else f"{value:.{2 if value < 9.995 else 1}f} ×"
                            for value in (row["value"] or 0, row["target"]))
        share = share_of_target(row)
        kind, mark = ("met", "✓ ") if row["met"] else ("below", "")
        return [escape(row["row"]), escape(row["against"] or "time"), measured if share else "–",
                f"{'≤' if row['bound'] == 'most' else '≥'} {target}",
                f'<span class="{kind}">{mark}{math.floor(100 * share)} %</span>' if share else
                '<span class="none">not measured</span>']

    load, cores = summary["machine"]["load"], summary["machine"]["cores"]
    note = ("Speeds (≥) or times (≤) relative to another benchmark of this run, and times of one call. Targets are for an "
            "idle machine. A busy one misses them whatever the library does, so measure again when it is idle before you "
            "look for a cause.")
    return table("Figures and targets", note + (f" Load average when measuring began: {load:.1f}, on {cores} threads."
                                                if load is not None else ""),
                 ["benchmark", "against", ">measured", ">target", ">share of target"], list(map(cells, summary["reach"])))


def limits_table(summary: dict) -> str:
    rows = [[escape(path["row"]), with_prefix(path["per_s"]), with_prefix(path["ceilings"][0]["per_s"]),
             percent(path["fraction"]), escape(path["ceilings"][0]["what"])] for path in summary["limits"]]
    return table("What limits each path", "Each path against the lowest of the limits that this machine's arithmetic and "
                 "memory set to it, as measured.", ["path", ">per second", ">limit", ">share", "limited by"], rows)


def machine_text(machine: dict) -> str:
    caches = [f"L{cache['level']} of {cache['bytes'] / 1024:,.0f} KiB" for cache in machine["caches"]
              if cache["type"] != "Instruction"]
    return escape(f"{machine['cpu']}, {machine['cores']} threads; {', '.join(map(set_name, machine['isa']))}; "
                  f"{', '.join(caches)}. Compiled by {machine['compiler']}, measured {machine['date']}.")


def tiles(summary: dict) -> str:
    """The figures that a reader takes home."""
    best = best_set(summary)
    culled = f"test/boxes/cull/slab/{best}"
    figures = []
    if rate := result_of(summary, culled):
        figures.append((with_prefix(rate), f"boxes culled per second, on one thread with {set_name(best)}"))
    if ratio := result_of(summary, culled, "vs_paper"):
        figures.append((f"{ratio:.0f} ×", "as fast as the paper's method"))
    if batch := result_of(summary, "form/batch"):
        figures.append((f"{1e9 / batch:.1f} ns", "to form a shaft, in batches"))
    shares = [(share, row["met"]) for row in summary["reach"] if (share := share_of_target(row))]
    if shares:
        below = [share for share, met in shares if not met]
        rest = f"; the others reach {math.floor(100 * statistics.median(below))} % of it (median)" if below else ""
        figures.append((f"{len(shares) - len(below)} of {len(shares)}", "figures of this run reach their target" + rest))
    return '<div class="tiles">\n' + "".join(f"<div><b>{value}</b>{text}</div>\n" for value, text in figures) + "</div>\n"


def page_of(summary: dict) -> str:
    plots = [plot(summary) for plot in PLOTS]
    figures = "".join(plot_html(number, *plot) for number, plot in enumerate(plots) if plot[2])
    lacking = ", ".join(f"“{title}”" for title, _, figure in plots if not figure)
    notes = f"<p>Not measured in this run, and so not shown: {lacking}.</p>\n" if lacking else ""
    if summary["run"]["quick"]:
        notes += "<p>This was a quick run, with fewer points, and so few bounds that a cache may hold them all.</p>\n"
    light, dark = ("; ".join(f"--{name}: {inks[i]}" for name, inks in INKS.items()) for i in (0, 1))
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>shaftcull: measured speed</title>
<style>
:root {{ color-scheme: light dark; {light}; }}
@media (prefers-color-scheme: dark) {{ :root {{ {dark}; }} }}
{CSS}</style>
</head>
<body>
<main>
<h1>shaftcull: measured speed</h1>
<p>{machine_text(summary["machine"])}</p>
{tiles(summary)}{notes}<div class="plots">
{figures}</div>
{targets_table(summary)}{limits_table(summary)}</main>
</body>
</html>
"""


def write(page: bytes, path: str) -> None:
    """Writes a file as a whole or not at all: under another name beside it, which is then renamed."""
    if path == "-" or (os.path.exists(path) and not os.path.isfile(path)):  # also a device, or a pipe with a name
        with open(1 if path == "-" else path, "wb", closefd=path != "-") as stream:
            stream.write(page)
        return
    file = Path(os.path.realpath(path))  # a symbolic link stays
    with suppress(OSError):  # a folder that is missing still shows when the file is opened
        file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        part.write_bytes(page)
        part.replace(file)
    finally:
        part.unlink(missing_ok=True)


def main() -> Optional[str]:
    """Makes the page. Returns what was wrong, in one line."""
    parser = argparse.ArgumentParser(description="Makes a page of plots and tables from what ./cmake/run bench measured.")
    folder = Path(__file__).resolve().parents[1] / "build" / "bench"
    parser.add_argument("--in", dest="summary", metavar="FILE", default=str(folder / "summary.json"),
                        help="the summary of the run (default: build/bench/summary.json)")
    parser.add_argument("--out", metavar="FILE", default=str(folder / "report.html"),
                        help="the page; - is standard output (default: build/bench/report.html)")
    options = parser.parse_args()
    try:
        summary = read_summary(options.summary)
    except (OSError, RecursionError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        return f"report.py: {options.summary}: {why}; ./cmake/run bench makes a summary"
    try:
        write(page_of(summary).encode("utf-8", "replace"), options.out)
    except OSError as error:
        return f"report.py: {options.out}: cannot be written: {error.strerror}"
    if options.out != "-":
        print(f"Written to {options.out}.")
    return None


if __name__ == "__main__":
    sys.exit(main())
