// SPDX-License-Identifier: MIT
#include "harness/summary.hpp"

#include <chrono>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/verdict.hpp"
#include "shaftcull/isa.hpp"

namespace shaftcull::bench {
namespace {

using nlohmann::ordered_json;

/// The processor's name as Linux gives it.
std::string processor_name() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#elif defined(__GNUC__)
  return std::string("g++ ") + __VERSION__;
#else
  return "unknown";
#endif
}

ordered_json machine() {
  ordered_json isas = ordered_json::array();
  for (const Isa isa : available_isas()) isas.push_back(name(isa));
  ordered_json caches = ordered_json::array();
  for (const auto& cache : benchmark::CPUInfo::Get().caches) {
    caches.push_back({{"level", cache.level}, {"type", cache.type}, {"bytes", cache.size}});
  }
  // What else ran, before this process did. There is none where the system does not tell.
  const std::vector<double>& load = benchmark::CPUInfo::Get().load_avg;
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {{"cpu", processor_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"isa", isas},
          {"compiler", compiler_name()},
          {"caches", caches},
          {"load", load.empty() ? ordered_json(nullptr) : ordered_json(load.front())},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))}};
}

ordered_json number_or_null(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json(nullptr);
}

ordered_json run_of(const Suite& suite, const RunSize& size) {
  return {{"quick", suite.quick()},
          {"bounds", size.bounds},
          {"shafts", Workload::test_shafts},
          {"repetitions", size.repetitions}};
}

ordered_json reach_of(const Suite& suite, const Results& results) {
  ordered_json reach = ordered_json::array();
  for (const Target& target : suite.targets()) {
    const std::optional<double> figure = measured_figure(target, results);
    const bool ratio = target.kind != Target::Kind::nanoseconds;
    reach.push_back({{"row", target.measured},
                     {"against", ratio ? ordered_json(target.against) : ordered_json(nullptr)},
                     {"value", number_or_null(figure)},
                     {"target", target.figure},
                     {"unit", ratio ? "x" : "ns"},
                     {"bound", target.at_most() ? "most" : "least"},
                     {"met", figure.has_value() && is_met(target, *figure)}});
  }
  return reach;
}

ordered_json limits_of(const Suite& suite, const Results& results) {
  ordered_json limits = ordered_json::array();
  for (const PathLimits& path : limits_of_paths(suite, results)) {
    ordered_json ceilings = ordered_json::array();
    for (const auto& [limit, per_second] : path.ceilings) {
      ceilings.push_back({{"by", limit.by}, {"units", limit.units}, {"what", limit.what}, {"per_s", per_second}});
    }
    limits.push_back(
        {{"row", path.path}, {"per_s", path.per_second}, {"fraction", path.fraction()}, {"ceilings", ceilings}});
  }
  return limits;
}

}  // namespace

void write_summary(const std::filesystem::path& file, const Suite& suite, const RunSize& size, const Results& results) {
  ordered_json speeds = ordered_json::object();
  for (const Entry& entry : suite.entries()) {
    const std::optional<double> speed = results.per_second(entry.name);
    if (!speed) continue;
    speeds[entry.name] = {{"per_s", *speed}, {"vs_paper", number_or_null(results.ratio(entry.name, entry.paper))}};
  }
  const ordered_json summary = {{"machine", machine()},
                                {"run", run_of(suite, size)},
                                {"results", speeds},
                                {"reach", reach_of(suite, results)},
                                {"limits", limits_of(suite, results)}};
  std::ofstream out(file);
  out << summary.dump(2) << '\n';
  if (!out.flush()) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
}

}  // namespace shaftcull::bench
