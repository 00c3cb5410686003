// SPDX-License-Identifier: MIT
#include "sees_report.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "printable.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

/// A kind of pairs, as tables and files call it.
struct PairKind {
  std::string_view words;
  std::string_view key;
  std::uint64_t pairs;
};

std::vector<PairKind> kinds_of(const SeesReport& report) {
  const SeesCounts& counts = report.counts;
  const auto kind = [](Sight sight, std::uint64_t pairs) { return PairKind{name(sight), name(sight), pairs}; };
  std::vector<PairKind> kinds{kind(Sight::clear, counts.sights.clear), kind(Sight::occluded, counts.sights.occluded),
                              kind(Sight::facing_away, counts.sights.facing_away),
                              kind(Sight::undecided, counts.sights.undecided)};
  if (report.rays != 0) {
    kinds.push_back({"  rays: visible", "rays_visible", counts.visible});
    kinds.push_back({"  rays: partly", "rays_partly", counts.partial});
    kinds.push_back({"  rays: hidden", "rays_hidden", counts.hidden});
  }
  return kinds;
}

double share_of(const SeesReport& report, std::uint64_t pairs) {
  const std::uint64_t total = report.counts.sights.total();
  return total == 0 ? 0 : static_cast<double>(pairs) / static_cast<double>(total);
}

double rate_of(const SeesReport& report) {
  return report.seconds > 0 ? static_cast<double>(report.counts.sights.total()) / report.seconds : 0;
}

/// What was found, and what was named and skipped, in lines.
std::string solids_text(const SeesSolids& solids) {
  std::string text;
  if (solids.hulls + solids.polygons + solids.inner_boxes != 0) {
    text += fmt::format("solids found: {}, {}, {}\n", counted(solids.hulls, "convex body", "convex bodies"),
                        counted(solids.polygons, "flat polygon"),
                        counted(solids.inner_boxes, "box inside others", "boxes inside others"));
  }
  if (solids.skipped != 0) {
    text += fmt::format("--solid: skipped {} that cannot be solid; the first is {}\n",
                        counted(solids.skipped, "object"), printable(solids.skipped_because));
  }
  return text;
}

/// A float in the fewest digits that tell it apart, as JSON is to print it.
double short_number(float x) { return std::strtod(fmt::format("{}", x).c_str(), nullptr); }

constexpr std::array object_sights{Sight::clear, Sight::occluded, Sight::facing_away, Sight::undecided};

std::string table_of_objects(const SeesReport& report) {
  std::vector<std::string> header{"pairs of objects", "pairs"};
  for (const Sight sight : object_sights) header.emplace_back(name(sight));
  if (report.rays != 0) header.emplace_back("rays seen");
  Table table(std::move(header));
  for (const ObjectPair& pair : report.object_pairs) {
    const auto total = static_cast<double>(pair.sights.total());
    std::vector<std::string> cells{printable(pair.a) + " - " + printable(pair.b), grouped(pair.sights.total())};
    for (const Sight sight : object_sights) {
      cells.push_back(fmt::format("{:.1f} %", 100 * static_cast<double>(pair.sights.of(sight)) / total));
    }
    if (report.rays != 0) cells.push_back(fmt::format("{:.1f} %", 100 * pair.rays_seen));
    table.add_row(std::move(cells));
  }
  return table.text();
}

std::string text_of(const SeesReport& report) {
  std::string text = fmt::format("{}: {}, {}, {} of at most {:.4g}, {}, {} named as solid\n", printable(report.source),
                                 counted(report.objects, "object"), counted(report.triangles, "triangle"),
                                 grouped(report.patches) + " patches", report.patch_size,
                                 counted(report.occluders, "occluder"), grouped(report.solids.named));
  text += solids_text(report.solids);
  if (report.tolerance > 0) {
    text += fmt::format("patches within {:.2g} of a plane count as lying in it\n", report.tolerance);
  }
  text += "\n";
  Table table({"pairs of patches", "number", "share"});
  const auto add = [&](std::string_view words, std::uint64_t pairs) {
    table.add_row({std::string(words), grouped(pairs), fmt::format("{:.3f} %", 100 * share_of(report, pairs))});
  };
  for (const PairKind& kind : kinds_of(report)) add(kind.words, kind.pairs);
  add("all", report.counts.sights.total());
  text += table.text();
  if (!report.object_pairs.empty()) text += '\n' + table_of_objects(report);
  return text + fmt::format("\n{:.2f} s, {}pairs/s, {}{}, {}, {} MB of memory{}\n", report.seconds,
                            prefixed(rate_of(report)), counted(static_cast<std::size_t>(report.threads), "thread"),
                            report.ranks == 1 ? "" : fmt::format(" on {} ranks", report.ranks), report.isa,
                            grouped((report.memory + 999'999) / 1'000'000),
                            report.rays == 0 ? "" : fmt::format(", {} per pair", counted(report.rays, "ray")));
}

std::string csv_of_objects(const SeesReport& report) {
  std::string text = "a,b,pairs";
  for (const Sight sight : object_sights) text += fmt::format(",{}", name(sight));
  text += report.rays != 0 ? ",rays_seen\n" : "\n";
  for (const ObjectPair& pair : report.object_pairs) {
    text += fmt::format("{},{},{}", csv_cell(pair.a), csv_cell(pair.b), pair.sights.total());
    for (const Sight sight : object_sights) text += fmt::format(",{}", pair.sights.of(sight));
    text += report.rays != 0 ? fmt::format(",{:.6g}\n", pair.rays_seen) : "\n";
  }
  return text;
}

nlohmann::ordered_json json_of_objects(const SeesReport& report) {
  auto list = nlohmann::ordered_json::array();
  for (const ObjectPair& pair : report.object_pairs) {
    nlohmann::ordered_json entry{{"a", pair.a}, {"b", pair.b}, {"pairs", pair.sights.total()}};
    for (const Sight sight : object_sights) entry[name(sight)] = pair.sights.of(sight);
    if (report.rays != 0) entry["rays_seen"] = std::round(pair.rays_seen * 1e6) / 1e6;
    list.push_back(std::move(entry));
  }
  return list;
}

std::string csv_of(const SeesReport& report) {
  if (!report.object_pairs.empty()) return csv_of_objects(report);
  std::string text = "kind,pairs,share\n";
  for (const PairKind& kind : kinds_of(report)) {
    text += fmt::format("{},{},{:.6g}\n", kind.key, kind.pairs, share_of(report, kind.pairs));
  }
  return text;
}

std::string json_of(const SeesReport& report) {
  nlohmann::ordered_json pairs;
  for (const PairKind& kind : kinds_of(report)) pairs[kind.key] = kind.pairs;
  pairs["all"] = report.counts.sights.total();
  nlohmann::ordered_json found{
      {"hulls", report.solids.hulls}, {"polygons", report.solids.polygons}, {"inner_boxes", report.solids.inner_boxes}};
  nlohmann::ordered_json root{{"scene", report.source},
                              {"objects", report.objects},
                              {"triangles", report.triangles},
                              {"patches", report.patches},
                              {"patch_size", report.patch_size},
                              {"tolerance", short_number(report.tolerance)},
                              {"occluders", report.occluders},
                              {"solids", report.solids.named},
                              {"solids_skipped", report.solids.skipped},
                              {"found", std::move(found)},
                              {"rays", report.rays},
                              {"pairs", std::move(pairs)},
                              {"seconds", std::round(report.seconds * 1e6) / 1e6},
                              {"pairs_per_second", std::llround(rate_of(report))},
                              {"threads", report.threads},
                              {"ranks", report.ranks},
                              {"memory", report.memory},
                              {"isa", report.isa}};
  if (!report.object_pairs.empty()) root["object_pairs"] = json_of_objects(report);
  return root.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string format_report(const SeesReport& report, ReportFormat format) {
  return in_format(format, report, text_of, json_of, csv_of);
}

}  // namespace shaftcull::cli
