// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "factors_result.hpp"
#include "printable.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Sums over all patches.
struct Summary {
  double area = 0;
  double mean_sky = 0;  ///< by area
  double largest_sum = 0;
  std::size_t of_largest = 0;  ///< the patch
  double largest_error = 0;
  double left_out = 0;  ///< the largest of a row
};

Summary summary_of(const FactorsResult& result) {
  Summary of;
  for (std::size_t i = 0; i != result.factors.size(); ++i) {
    of.area += result.factors.area[i];
    of.mean_sky += result.factors.area[i] * result.sky(i);
    if (result.factors.sum[i] > of.largest_sum) {
      of.largest_sum = result.factors.sum[i];
      of.of_largest = i;
    }
    of.largest_error = std::max(of.largest_error, result.factors.error[i]);
    of.left_out = std::max(of.left_out, result.factors.left_out[i]);
  }
  if (of.area > 0) of.mean_sky /= of.area;
  return of;
}

double rounded(double x) { return std::round(x * 1e9) / 1e9; }

/// Calls row(from, to, factor) for each two objects that see each other.
template <class Row>
void for_each_pair(const FactorsResult& result, const Row& row) {
  const std::size_t objects = result.scene.mesh.names.size();
  const std::vector<double> factors = factors_of_objects(result);
  for (std::size_t a = 0; a != objects; ++a) {
    for (std::size_t b = 0; b != objects; ++b) {
      if (factors[a * objects + b] > 0)
        row(result.scene.mesh.names[a], result.scene.mesh.names[b], factors[a * objects + b]);
    }
  }
}

std::string text_of(const FactorsResult& result) {
  const Summary of = summary_of(result);
  const SightCounts& counts = result.factors.counts;
  std::string text = result.described();
  text += fmt::format("pairs: {} clear, {} by rays, {} occluded, {} facing away\n", grouped(counts.clear),
                      grouped(counts.undecided), grouped(counts.occluded), grouped(counts.facing_away));
  text += fmt::format("{} above 0; the largest estimated error of a row sum is {:.1e}\n",
                      counted(result.factors.factor.size(), "factor"), of.largest_error);
  if (of.largest_sum > 0) {
    text += fmt::format("the largest row sum is {:.6f}, for patch {} of object {}\n", of.largest_sum, of.of_largest,
                        printable(result.scene.mesh.names[result.object_of(of.of_largest)]));
  }
  text += fmt::format("sky: {:.2f} % of the radiation of all patches meets no patch\n", 100 * of.mean_sky);
  if (result.scene.tolerance > 0) {
    text += fmt::format("patches within {} of a plane count as lying in it, and see nothing of it\n",
                        result.scene.tolerance);
  }
  if (of.left_out > 0) text += fmt::format("left out because they are small: at most {:.6f} per row\n", of.left_out);
  if (result.shows_objects) {
    Table table({"from", "to", "factor"});
    for_each_pair(result, [&](const std::string& a, const std::string& b, double factor) {
      table.add_row({printable(a), printable(b), fmt::format("{:.6f}", factor)});
    });
    text += '\n' + table.text();
  }
  return text + result.spent("pair");
}

std::string csv_of(const FactorsResult& result) {
  if (result.shows_objects) {
    std::string text = "from,to,factor\n";
    for_each_pair(result, [&](const std::string& a, const std::string& b, double factor) {
      text += fmt::format("{},{},{:.9g}\n", csv_cell(a), csv_cell(b), factor);
    });
    return text;
  }
  std::string text = "patch,object,triangle,area,row_sum,sky,error,left_out\n";
  for (std::size_t i = 0; i != result.patches.size(); ++i) {
    text += fmt::format("{},{},{},{:.9g},{:.9g},{:.9g},{:.3g},{:.9g}\n", i,
                        csv_cell(result.scene.mesh.names[result.object_of(i)]), result.triangle_of(i),
                        result.factors.area[i], result.factors.sum[i], result.sky(i), result.factors.error[i],
                        result.factors.left_out[i]);
  }
  return text;
}

std::string json_of(const FactorsResult& result) {
  const Summary of = summary_of(result);
  const SightCounts& counts = result.factors.counts;
  Json root{{"scene", result.source},
            {"objects", result.scene.mesh.names.size()},
            {"triangles", result.scene.mesh.triangles.size()},
            {"patches", result.patches.size()},
            {"patch_size", result.patch_size},
            {"pairs",
             {{"clear", counts.clear},
              {"undecided", counts.undecided},
              {"occluded", counts.occluded},
              {"facing_away", counts.facing_away},
              {"all", counts.total()}}},
            {"factors", result.factors.factor.size()},
            {"area", rounded(of.area)},
            {"largest_row_sum", rounded(of.largest_sum)},
            {"largest_error", rounded(of.largest_error)},
            {"largest_left_out", rounded(of.left_out)},
            {"mean_sky", rounded(of.mean_sky)},
            {"most_rays", result.most_rays},
            {"seconds", std::round(result.seconds * 1e6) / 1e6},
            {"threads", result.threads},
            {"ranks", result.ranks},
            {"memory", result.memory}};
  if (result.shows_objects) {
    Json list = Json::array();
    for_each_pair(result, [&](const std::string& a, const std::string& b, double factor) {
      list.push_back({{"from", a}, {"to", b}, {"factor", rounded(factor)}});
    });
    root["object_factors"] = std::move(list);
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::vector<double> FactorsResult::skies() const {
  std::vector<double> skies(factors.size());
  for (std::size_t i = 0; i != skies.size(); ++i) skies[i] = sky(i);
  return skies;
}

std::vector<double> factors_of_objects(const FactorsResult& result) {
  const std::size_t objects = result.scene.mesh.names.size();
  std::vector<double> exchanged(objects * objects);
  std::vector<double> area(objects);
  for (std::size_t i = 0; i != result.factors.size(); ++i) {
    const std::size_t from = result.object_of(i);
    area[from] += result.factors.area[i];
    for (std::size_t k = result.factors.first[i]; k != result.factors.first[i + 1]; ++k) {
      exchanged[from * objects + result.object_of(result.factors.column[k])] +=
          result.factors.area[i] * result.factors.factor[k];
    }
  }
  for (std::size_t a = 0; a != objects; ++a) {
    for (std::size_t b = 0; b != objects; ++b) {
      if (area[a] > 0) exchanged[a * objects + b] /= area[a];
    }
  }
  return exchanged;
}

std::string format_report(const FactorsResult& result, ReportFormat format) {
  return in_format(format, result, text_of, json_of, csv_of);
}

}  // namespace shaftcull::cli
