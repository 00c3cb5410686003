// SPDX-License-Identifier: MIT
#include "report/summary_file.hpp"

#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "file_path.hpp"
#include "report/json_text.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

std::optional<double> number_or_nothing(const JsonPart& value) {
  return value.is_null() ? std::nullopt : std::optional(value.number());
}

/// A speed, a ratio of two, or a target: all are finite and above 0.
double positive(const JsonPart& value) {
  const double number = value.number();
  if (!(number > 0) || !std::isfinite(number)) value.refuse(fmt::format("is {}; it should be above 0", number));
  return number;
}

std::size_t count(const JsonPart& value) {
  const double number = value.number();
  if (!(number >= 0 && number <= 1e9) || number != std::floor(number)) {
    value.refuse(fmt::format("is {}; it should be a count", number));
  }
  return static_cast<std::size_t>(number);
}

void read_machine(const JsonPart& machine, BenchSummary& summary) {
  summary.cpu = machine.at("cpu").text();
  summary.compiler = machine.at("compiler").text();
  summary.date = machine.at("date").text();
  summary.cores = count(machine.at("cores"));
  if (machine.has("load")) summary.load = number_or_nothing(machine.at("load"));
  for (const JsonPart& isa : machine.at("isa").elements()) summary.isas.push_back(isa.text());
  for (const JsonPart& cache : machine.at("caches").elements()) {
    summary.caches.push_back(
        {static_cast<int>(count(cache.at("level"))), cache.at("type").text(), positive(cache.at("bytes"))});
  }
}

void read_reach(const JsonPart& rows, BenchSummary& summary) {
  for (const JsonPart& row : rows.elements()) {
    const JsonPart against = row.at("against");
    const JsonPart value = row.at("value");
    summary.reach.push_back({row.at("row").text(), against.is_null() ? std::string() : against.text(),
                             value.is_null() ? std::nullopt : std::optional(positive(value)),
                             positive(row.at("target")), row.at("unit").text() == "ns",
                             row.at("bound").text() == "most", row.at("met").boolean()});
  }
}

void read_limits(const JsonPart& rows, BenchSummary& summary) {
  for (const JsonPart& row : rows.elements()) {
    PathLimit path{row.at("row").text(), positive(row.at("per_s")), row.at("fraction").number(), {}};
    const JsonPart ceilings = row.at("ceilings");
    for (const JsonPart& ceiling : ceilings.elements()) {
      path.ceilings.push_back({ceiling.at("by").text(), ceiling.at("what").text(), positive(ceiling.at("per_s"))});
    }
    if (path.ceilings.empty()) ceilings.refuse("is empty");
    summary.limits.push_back(std::move(path));
  }
}

BenchSummary summary_of(const JsonPart& json) {
  BenchSummary summary{};
  read_machine(json.at("machine"), summary);
  const JsonPart run = json.at("run");
  summary.quick = run.at("quick").boolean();
  summary.bounds = positive(run.at("bounds"));
  summary.shafts = positive(run.at("shafts"));
  const JsonPart results = json.at("results");
  for (const auto& [name, result] : results.members()) {
    const JsonPart ratio = result.at("vs_paper");
    summary.results[name] = {positive(result.at("per_s")),
                             ratio.is_null() ? std::nullopt : std::optional(positive(ratio))};
  }
  if (summary.results.empty()) results.refuse("is empty");
  read_reach(json.at("reach"), summary);
  read_limits(json.at("limits"), summary);
  return summary;
}

}  // namespace

std::optional<double> BenchSummary::speed(const std::string& name) const {
  const auto found = results.find(name);
  return found == results.end() ? std::nullopt : std::optional(found->second.per_second);
}

BenchSummary read_summary(const std::string& path) {
  constexpr const char* remedy = "; make one with ./cmake/run bench";
  std::ifstream file(file_path(path), std::ios::binary);
  if (!file) throw InvalidArgument(fmt::format("--in {}: there is no such file, or it cannot be read{}", path, remedy));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (file.bad()) throw InvalidArgument(fmt::format("--in {}: it cannot be read{}", path, remedy));
  if (text.empty()) throw InvalidArgument(fmt::format("--in {}: empty{}", path, remedy));
  try {
    return summary_of(JsonText(text).root());
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(fmt::format("--in {} {}{}", path, error.what(), remedy));
  }
}

}  // namespace shaftcull::cli
