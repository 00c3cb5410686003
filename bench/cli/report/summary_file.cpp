#include "report/summary_file.hpp"

#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

using Json = nlohmann::json;

std::optional<double> number_or_nothing(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

double speed_of(const Json& value, const std::string& row) {
  const auto speed = value.get<double>();
  if (!(speed > 0) || !std::isfinite(speed)) {
    throw InvalidArgument(fmt::format("{} has the speed {}, which should be above 0", row, speed));
  }
  return speed;
}

void read_machine(const Json& machine, BenchSummary& summary) {
  summary.cpu = machine.at("cpu").get<std::string>();
  summary.compiler = machine.at("compiler").get<std::string>();
  summary.date = machine.at("date").get<std::string>();
  summary.cores = machine.at("cores").get<std::size_t>();
  summary.isas = machine.at("isa").get<std::vector<std::string>>();
  for (const Json& cache : machine.at("caches")) {
    summary.caches.push_back(
        {cache.at("level").get<int>(), cache.at("type").get<std::string>(), cache.at("bytes").get<double>()});
  }
}

void read_reach(const Json& rows, BenchSummary& summary) {
  for (const Json& row : rows) {
    summary.reach.push_back({row.at("row").get<std::string>(),
                             row.at("against").is_null() ? std::string() : row.at("against").get<std::string>(),
                             number_or_nothing(row.at("value")), row.at("target").get<double>(),
                             row.at("unit").get<std::string>() == "ns", row.at("met").get<bool>()});
  }
}

void read_limits(const Json& rows, BenchSummary& summary) {
  for (const Json& row : rows) {
    PathLimit path{row.at("row").get<std::string>(), 0, row.at("fraction").get<double>(), {}};
    path.per_second = speed_of(row.at("per_s"), path.row);
    for (const Json& ceiling : row.at("ceilings")) {
      path.ceilings.push_back({ceiling.at("by").get<std::string>(), ceiling.at("what").get<std::string>(),
                               speed_of(ceiling.at("per_s"), path.row)});
    }
    if (path.ceilings.empty()) throw InvalidArgument(fmt::format("{} has no ceilings", path.row));
    summary.limits.push_back(std::move(path));
  }
}

BenchSummary summary_of(const Json& json) {
  BenchSummary summary{};
  read_machine(json.at("machine"), summary);
  const Json& run = json.at("run");
  summary.quick = run.at("quick").get<bool>();
  summary.bounds = run.at("bounds").get<double>();
  summary.shafts = run.at("shafts").get<double>();
  for (const auto& [name, result] : json.at("results").items()) {
    const Json& ratio = result.at("vs_paper");
    summary.results[name] = {speed_of(result.at("per_s"), name),
                             ratio.is_null() ? std::nullopt : std::optional(speed_of(ratio, name))};
  }
  if (summary.results.empty()) throw InvalidArgument("there are no results");
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
  std::ifstream file(path);
  if (!file) throw InvalidArgument(fmt::format("--in {}: there is no such file, or it cannot be read{}", path, remedy));
  if (file.peek() == std::ifstream::traits_type::eof()) {
    throw InvalidArgument(fmt::format("--in {}: empty{}", path, remedy));
  }
  try {
    return summary_of(Json::parse(file));
  } catch (const Json::parse_error& error) {
    throw InvalidArgument(fmt::format("--in {}: not JSON, or cut short at byte {}{}", path, error.byte, remedy));
  } catch (const Json::exception& error) {
    throw InvalidArgument(fmt::format("--in {}: not what shaftcull-bench writes ({}){}", path, error.what(), remedy));
  } catch (const InvalidArgument& error) {
    throw InvalidArgument(fmt::format("--in {}: {}{}", path, error.what(), remedy));
  }
}

}  // namespace shaftcull::cli
