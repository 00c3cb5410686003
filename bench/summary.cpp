#include "summary.hpp"

#include <chrono>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {{"cpu", processor_name()},
          {"cores", std::thread::hardware_concurrency()},
          {"isa", isas},
          {"compiler", compiler_name()},
          {"caches", caches},
          {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now))}};
}

ordered_json number_or_null(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json(nullptr);
}

}  // namespace

void write_summary(const std::filesystem::path& file, const Suite& suite, const Results& results) {
  ordered_json speeds = ordered_json::object();
  for (const Entry& entry : suite.entries()) {
    const std::optional<double> speed = results.per_second(entry.name);
    if (!speed) continue;
    speeds[entry.name] = {{"per_s", *speed}, {"vs_paper", number_or_null(results.ratio(entry.name, entry.paper))}};
  }
  ordered_json reach = ordered_json::array();
  for (const Target& target : suite.targets()) {
    const std::optional<double> ratio = results.ratio(target.measured, target.against);
    reach.push_back({{"row", target.measured},
                     {"value", number_or_null(ratio)},
                     {"target", target.ratio},
                     {"met", ratio.has_value() && *ratio >= target.ratio}});
  }
  const ordered_json summary = {{"machine", machine()}, {"results", speeds}, {"reach", reach}};
  std::ofstream out(file);
  out << summary.dump(2) << '\n';
  if (!out.flush()) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
}

}  // namespace shaftcull::bench
