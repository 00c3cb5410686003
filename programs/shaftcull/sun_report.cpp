// SPDX-License-Identifier: MIT
#include "sun_result.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "npz.hpp"
#include "printable.hpp"
#include "shaftcull/error.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

using SunJson = nlohmann::ordered_json;

/// Sums over all patches.
struct SunSummary {
  double area = 0;
  double mean = 0;           ///< hours, by area
  std::size_t sunniest = 0;  ///< the patch
  std::size_t never = 0;     ///< how many
  double largest_error = 0;  ///< of the hours of a patch
};

SunSummary sun_summary(const SunResult& result) {
  SunSummary of;
  for (std::size_t i = 0; i != result.hours.size(); ++i) {
    of.area += result.area[i];
    of.mean += result.area[i] * result.hours[i];
    if (result.hours[i] > result.hours[of.sunniest]) of.sunniest = i;
    of.never += result.hours[i] == 0 ? 1 : 0;
    of.largest_error = std::max(of.largest_error, std::sqrt(result.variance[i]));
  }
  if (of.area > 0) of.mean /= of.area;
  return of;
}

/// Calls row(name, area, hours) for each object, with the mean of its hours by area.
template <class Row>
void for_each_object(const SunResult& result, const Row& row) {
  const std::vector<std::string>& names = result.scene.mesh.names;
  std::vector<double> area(names.size());
  std::vector<double> hours(names.size());
  for (std::size_t i = 0; i != result.hours.size(); ++i) {
    area[result.object_of(i)] += result.area[i];
    hours[result.object_of(i)] += result.area[i] * result.hours[i];
  }
  for (std::size_t i = 0; i != names.size(); ++i) row(names[i], area[i], area[i] > 0 ? hours[i] / area[i] : 0);
}

double to_nine_places(double x) { return std::round(x * 1e9) / 1e9; }

std::string sun_text(const SunResult& result) {
  const SunSummary of = sun_summary(result);
  std::string text = result.described();
  text += fmt::format("sun: {} position{}, {:.2f} h; {}\n", grouped(result.positions.size()),
                      result.positions.size() == 1 ? "" : "s", result.daylight(), result.where);
  text += fmt::format("lit: {:.2f} h on average over all patches; {} of {} patches are never lit\n", of.mean,
                      grouped(of.never), grouped(result.patches.size()));
  if (of.never != result.hours.size()) {
    text += fmt::format("most sun: {2:.2f} h, for patch {0} of object {1}\n", of.sunniest,
                        printable(result.scene.mesh.names[result.object_of(of.sunniest)]), result.hours[of.sunniest]);
  }
  text += fmt::format("the standard error of the hours of a patch, from the number of rays, is at most {:.3f} h\n",
                      of.largest_error);
  if (result.shows_objects) {
    Table table({"object", "area", "hours"});
    for_each_object(result, [&](const std::string& name, double area, double hours) {
      table.add_row({printable(name), fmt::format("{:.6g}", area), fmt::format("{:.2f}", hours)});
    });
    text += '\n' + table.text();
  }
  return text + result.spent("patch and position");
}

std::string sun_csv(const SunResult& result) {
  if (result.shows_objects) {
    std::string text = "object,area,hours\n";
    for_each_object(result, [&](const std::string& name, double area, double hours) {
      text += fmt::format("{},{:.9g},{:.9g}\n", csv_cell(name), area, hours);
    });
    return text;
  }
  const std::vector<double> errors = result.errors();
  std::string text = "patch,object,triangle,area,hours,error\n";
  for (std::size_t i = 0; i != result.patches.size(); ++i) {
    text += fmt::format("{},{},{},{:.9g},{:.9g},{:.3g}\n", i, csv_cell(result.scene.mesh.names[result.object_of(i)]),
                        result.triangle_of(i), result.area[i], result.hours[i], errors[i]);
  }
  return text;
}

std::string sun_json(const SunResult& result) {
  const SunSummary of = sun_summary(result);
  SunJson root{{"scene", result.source},
               {"objects", result.scene.mesh.names.size()},
               {"triangles", result.scene.mesh.triangles.size()},
               {"patches", result.patches.size()},
               {"patch_size", result.patch_size},
               {"positions", result.positions.size()},
               {"daylight", to_nine_places(result.daylight())},
               {"area", to_nine_places(of.area)},
               {"mean_hours", to_nine_places(of.mean)},
               {"most_hours", result.hours.empty() ? 0 : to_nine_places(result.hours[of.sunniest])},
               {"never_lit", of.never},
               {"largest_error", to_nine_places(of.largest_error)},
               {"most_rays", result.most_rays},
               {"seconds", std::round(result.seconds * 1e6) / 1e6},
               {"threads", result.threads},
               {"ranks", result.ranks},
               {"memory", result.memory}};
  if (result.shows_objects) {
    SunJson list = SunJson::array();
    for_each_object(result, [&](const std::string& name, double area, double hours) {
      list.push_back({{"object", name}, {"area", to_nine_places(area)}, {"hours", to_nine_places(hours)}});
    });
    root["object_hours"] = std::move(list);
  }
  return root.dump(2, ' ', false, SunJson::error_handler_t::replace) + '\n';
}

}  // namespace

double SunResult::daylight() const {
  double hours_of_all = 0;
  for (const SunPosition& position : positions) hours_of_all += position.hours;
  return hours_of_all;
}

std::vector<double> SunResult::errors() const {
  std::vector<double> errors;
  for (const double v : variance) errors.push_back(std::sqrt(v));
  return errors;
}

void set_normals(SunResult& result) {
  const FactorPatches& patches = result.patches;
  for (std::size_t i = 0; i != patches.size(); ++i) {
    const std::span<const Vec3> corners = patches.of(i);
    double normal[3]{};
    for (std::size_t c = 2; c != corners.size(); ++c) {
      for (std::size_t k = 0; k != 3; ++k) {
        const std::size_t u = (k + 1) % 3;
        const std::size_t v = (k + 2) % 3;
        const auto way = [&](std::size_t to, std::size_t axis) { return double{corners[to][axis]} - corners[0][axis]; };
        normal[k] += way(c - 1, u) * way(c, v) - way(c - 1, v) * way(c, u);
      }
    }
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    result.area.push_back(length / 2);
    Vec3& unit = result.normals.emplace_back();
    for (std::size_t k = 0; k != 3 && length > 0; ++k) unit[k] = static_cast<float>(normal[k] / length);
  }
}

std::string format_report(const SunResult& result, ReportFormat format) {
  return in_format(format, result, sun_text, sun_json, sun_csv);
}

void require_sun_name(const std::string& path) {
  if (path.ends_with(".npz")) return;
  throw InvalidArgument(fmt::format("--out {}: this file is for NumPy; give a name that ends in .npz", path));
}

void write_sun(const SunResult& result, const std::string& path) {
  NpzFile file(path);
  std::vector<Vec3> directions;
  std::vector<double> hours;
  for (const SunPosition& position : result.positions) {
    directions.push_back(position.towards);
    hours.push_back(position.hours);
  }
  const std::vector<double> errors = result.errors();
  file.add({"hours", "<f8"}).append(std::span<const double>(result.hours));
  file.add({"error", "<f8"}).append(std::span<const double>(errors));
  file.add({"lit", "<f4", {result.positions.size()}}).append(std::span<const float>(result.lit));
  file.add({"directions", "<f4", {3}}).append(std::span<const Vec3>(directions));
  file.add({"direction_hours", "<f8"}).append(std::span<const double>(hours));
  file.add({"area", "<f8"}).append(std::span<const double>(result.area));
  file.add({"normals", "<f4", {3}}).append(std::span<const Vec3>(result.normals));
  add_patches(file, result);
  file.finish();
}

}  // namespace shaftcull::cli
