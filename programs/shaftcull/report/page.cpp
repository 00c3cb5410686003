// SPDX-License-Identifier: MIT
#include "report/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "report/gnuplot.hpp"
#include "report/plot.hpp"
#include "report/style.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::string escaped(std::string text) {
  text = replaced(std::move(text), "&", "&amp;");
  text = replaced(std::move(text), "<", "&lt;");
  text = replaced(std::move(text), ">", "&gt;");
  return replaced(std::move(text), "\"", "&quot;");
}

/// What browsers show for an element that a reader points at: gnuplot has its own commands there. Elements of the plot
/// command are numbered from 1.
std::string with_tooltips(std::string svg, const std::vector<std::string>& tooltips) {
  constexpr std::string_view open = "<title>";
  constexpr std::string_view close = "</title>";
  for (std::size_t i = 0; i < tooltips.size(); ++i) {
    const std::size_t element = svg.find(fmt::format("\"gnuplot_plot_{}\"", i + 1));
    const std::size_t begin = svg.find(open, element);
    const std::size_t end = svg.find(close, begin);
    if (element == std::string::npos || end == std::string::npos) continue;
    svg.replace(begin, end + close.size() - begin,
                tooltips[i].empty() ? "" : fmt::format("{}{}{}", open, escaped(tooltips[i]), close));
  }
  return svg;
}

/// gnuplot's picture as an element of the page: its numbers for inks become the page's colours, its names get
/// a prefix of their own, and screen readers get a title.
std::string inline_svg(const Plot& plot, std::size_t number) {
  std::string svg = with_tooltips(run_gnuplot(plot.drawing.script), plot.drawing.tooltips);
  svg.erase(0, svg.find("<svg"));
  for (int ink = ink_text; ink < ink_end; ++ink) {
    const std::string variable = fmt::format("var(--ink-{})", ink);
    svg = replaced(std::move(svg), fmt::format("rgb({0:3}, {0:3}, {0:3})", ink), variable);
    svg = replaced(std::move(svg), fmt::format("rgb({0},{0},{0})", ink), variable);
  }
  for (const char* prefix : {"id='", "id=\"", "href='#"}) {
    svg = replaced(std::move(svg), prefix, fmt::format("{}plot{}-", prefix, number));
  }
  svg = replaced(std::move(svg), "<title>Gnuplot</title>", fmt::format("<title>{}</title>", escaped(plot.title)));
  return replaced(std::move(svg), "<svg ", "<svg role=\"img\" ");
}

std::string figure(const Plot& plot, std::size_t number) {
  return fmt::format("<figure{}>\n<h2>{}</h2>\n<p>{}</p>\n{}</figure>\n", plot.wide ? " class=\"wide\"" : "",
                     escaped(plot.title), escaped(plot.caption), inline_svg(plot, number));
}

std::string reach_figure(const ReachRow& row, double value) {
  return row.is_time ? fmt::format("{:.1f} ns", value) : fmt::format("{:.{}f} ×", value, value < 9.995 ? 2 : 1);
}

std::string load_note(const BenchSummary& summary) {
  if (!summary.load) return "";
  return fmt::format(" Load average when measuring began: {:.1f}, on {} threads.", *summary.load, summary.cores);
}

std::string reach_table(const BenchSummary& summary) {
  std::string text = fmt::format(
      "<section><h2>Figures and targets</h2>\n<p>Speeds against each other within this run (≥), or times (≤), and "
      "times of one call. "
      "Targets are for a machine that does nothing else: on a busy one figures are worse than the library, so measure "
      "again "
      "when it is idle before you read much into one below its target.{}</p>\n"
      "<div class=\"scroll\"><table>\n<thead><tr><th>what</th><th>against</th><th class=\"n\">measured</th>"
      "<th class=\"n\">target</th><th class=\"n\">of the target</th></tr></thead>\n<tbody>\n",
      load_note(summary));
  for (const ReachRow& row : summary.reach) {
    const std::optional<double> share = row.share_of_target();
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{} {}</td><td class=\"n {}\">{}</td></tr>\n",
        escaped(row.row), row.is_time ? "time" : escaped(row.against), row.value ? reach_figure(row, *row.value) : "–",
        row.at_most ? "≤" : "≥", reach_figure(row, row.target),
        !share    ? "none"
        : row.met ? "met"
                  : "below",
        !share ? "not measured" : fmt::format("{}{:.0f} %", row.met ? "✓ " : "", std::floor(100 * *share)));
  }
  return text + "</tbody></table></div></section>\n";
}

std::string limits_table(const BenchSummary& summary) {
  std::string text =
      "<section><h2>What limits each path</h2>\n<p>Each path against the lowest of what this machine's arithmetic and "
      "memory "
      "allow it, as measured.</p>\n<div class=\"scroll\"><table>\n<thead><tr><th>path</th><th class=\"n\">a second</th>"
      "<th class=\"n\">allowed</th><th class=\"n\">share</th><th>limit</th></tr></thead>\n<tbody>\n";
  for (const PathLimit& path : summary.limits) {
    const PathCeiling& least = path.ceilings.front();
    text += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{:.0f} %</td><td>{}</td></tr>\n",
        escaped(path.row), prefixed(path.per_second), prefixed(least.per_second), 100 * path.fraction,
        escaped(least.what));
  }
  return text + "</tbody></table></div></section>\n";
}

std::string machine_table(const BenchSummary& summary) {
  std::string isas;
  for (const std::string& isa : summary.isas) {
    const Look* const look = look_of(isa);
    isas += fmt::format("{}{}", isas.empty() ? "" : ", ", look == nullptr ? escaped(isa) : look->label);
  }
  std::string caches;
  for (const Cache& cache : summary.caches) {
    if (cache.type == "Instruction") continue;
    caches += fmt::format("{}L{} {:.0f} KiB", caches.empty() ? "" : ", ", cache.level, cache.bytes / 1024);
  }
  std::string text = "<section><h2>Machine</h2>\n<dl>\n";
  for (const auto& [what, value] : std::array<std::pair<const char*, std::string>, 5>{
           {{"processor", fmt::format("{}, {} threads", escaped(summary.cpu), summary.cores)},
            {"instruction sets", isas},
            {"caches", caches},
            {"compiler", escaped(summary.compiler)},
            {"measured", escaped(summary.date)}}}) {
    text += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", what, value);
  }
  return text + "</dl></section>\n";
}

/// The few figures that a reader takes home.
std::string headline(const BenchSummary& summary) {
  std::string tiles;
  const auto tile = [&](const std::string& value, const std::string& what) {
    tiles += fmt::format("<div><b>{}</b><span>{}</span></div>\n", value, what);
  };
  if (const Look* const best = best_look(summary)) {
    const std::string name = std::string("test/boxes/cull/slab/") + best->isa;
    if (const auto found = summary.results.find(name); found != summary.results.end()) {
      tile(prefixed(found->second.per_second), fmt::format("boxes culled a second, one thread, {}", best->label));
      if (found->second.vs_paper)
        tile(fmt::format("{:.0f} ×", *found->second.vs_paper), "as fast as the paper's method");
    }
  }
  if (const auto batch = summary.speed("form/batch"))
    tile(fmt::format("{:.1f} ns", 1e9 / *batch), "to form a shaft, in batches");
  std::size_t measured = 0;
  std::vector<double> below;
  for (const ReachRow& row : summary.reach) {
    const std::optional<double> share = row.share_of_target();
    if (share) ++measured;
    if (share && !row.met) below.push_back(*share);
  }
  if (measured > 0) {
    std::string rest;
    if (!below.empty()) {
      const auto middle = below.begin() + static_cast<std::ptrdiff_t>(below.size() / 2);
      std::nth_element(below.begin(), middle, below.end());
      rest = fmt::format(", the others {:.0f} % of it (median)", std::floor(100 * *middle));
    }
    tile(fmt::format("{} of {}", measured - below.size(), measured), "figures of this run reach their target" + rest);
  }
  return fmt::format("<div class=\"tiles\">\n{}</div>\n", tiles);
}

}  // namespace

std::string report_page(const BenchSummary& summary) {
  std::string figures;
  std::string missing;
  std::size_t number = 0;
  for (const auto& [plot, what] :
       std::array<std::pair<std::optional<Plot>, const char*>, 7>{{{plot_rates(summary), "by instruction set"},
                                                                   {plot_ratios(summary), "against the paper"},
                                                                   {plot_bounds(summary), "by number of boxes"},
                                                                   {plot_shafts(summary), "by number of shafts"},
                                                                   {plot_threads(summary), "by number of threads"},
                                                                   {plot_shares(summary), "share of the limits"},
                                                                   {plot_roofline(summary), "roofline"}}}) {
    if (plot) {
      figures += figure(*plot, number++);
    } else {
      missing += fmt::format("{}{}", missing.empty() ? "" : ", ", what);
    }
  }
  if (!missing.empty())
    missing = fmt::format("<p class=\"note\">Not measured in this run, and not shown: {}.</p>\n", missing);
  const std::string quick = summary.quick ? "<p class=\"note\">A quick run: fewer bounds and points than in full, so "
                                            "memory and curves show caches only.</p>\n"
                                          : "";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>shaftcull: how fast</title>\n"
      "<style>\n{}</style>\n</head>\n<body>\n<main>\n<header><h1>shaftcull: how fast</h1>\n<p>{}, {} threads, "
      "{}</p></header>\n"
      "{}{}{}<div class=\"figures\">\n{}</div>\n{}{}{}</main>\n</body>\n</html>\n",
      page_style, escaped(summary.cpu), summary.cores, escaped(summary.date), headline(summary), quick, missing,
      figures, reach_table(summary), limits_table(summary), machine_table(summary));
}

}  // namespace shaftcull::cli
