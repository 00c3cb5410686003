// SPDX-License-Identifier: MIT
/// The program `shaftcull-bench`: measures the library against the paper's method and against the machine, in one run.
#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "harness/results.hpp"
#include "harness/run_size.hpp"
#include "harness/suite.hpp"
#include "harness/summary.hpp"
#include "harness/table.hpp"
#include "scenes/workload.hpp"

namespace {

using namespace shaftcull::bench;

constexpr std::array families{
    declare_paper,    declare_form,         declare_many,
    declare_volumes,  declare_contact,      declare_hull,
    declare_outputs,  declare_occluded,     declare_memory,
    declare_small,    declare_single,       declare_sweep,
    declare_roofline, declare_tree,         declare_picking,
    declare_frame,    declare_dynamic,      declare_flat_against_tree,
    declare_touching, declare_short_sweeps, declare_triangles,
    declare_sees,     declare_factors,      declare_origin,
#ifdef SHAFTCULL_BENCH_WITH_AVX2
    declare_exact,
#endif
};

/// Google Benchmark takes its settings as a command line only.
void set_up_benchmark(const RunSize& size, const std::string& filter, const std::filesystem::path& raw) {
  std::vector<std::string> settings{"shaftcull-bench",
                                    "--benchmark_enable_random_interleaving=true",
                                    fmt::format("--benchmark_repetitions={}", size.repetitions),
                                    fmt::format("--benchmark_min_time={}", size.seconds),
                                    "--benchmark_filter=" + filter,
                                    "--benchmark_out=" + raw.string(),
                                    "--benchmark_out_format=json"};
  std::vector<char*> arguments;
  for (std::string& setting : settings) arguments.push_back(setting.data());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
}

/// Makes the folder of `file` and opens it, so that minutes of measuring are not lost at the end.
void require_writable(const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error || !std::ofstream(file, std::ios::app)) {
    throw std::invalid_argument(
        fmt::format("--out {}: cannot be written; give a file in a folder that can", file.string()));
  }
}

int run(int argc, char** argv) {
  bool quick = false;
  std::filesystem::path out = "build/bench/summary.json";
  std::string filter = ".";
  CLI::App program{"Measures shaftcull against the paper's method and against the machine.", "shaftcull-bench"};
  program.add_flag("--quick", quick, "Fewer bounds and shorter repetitions: less than a minute");
  program.add_option("--out", out, "The summary; Google Benchmark's own file goes next to it")->capture_default_str();
  program.add_option("--filter", filter, "Measure only the benchmarks that this regular expression matches");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return program.exit(error);
    throw std::invalid_argument(fmt::format("{} (see shaftcull-bench --help)", error.what()));
  }

  require_writable(out);
  std::filesystem::path raw = out;
  raw.replace_filename(out.stem().string() + ".raw.json");

  const RunSize& size = quick ? quick_run : full_run;
  const Workload workload(size.bounds);
  Suite suite(quick);
  for (const auto declare : families) declare(suite, workload);
  set_up_benchmark(size, filter, raw);
  fmt::print("Measuring {} bounds × {} shafts, {} repetitions in random order; {}.\n", size.bounds,
             Workload::test_shafts, size.repetitions, quick ? "less than a minute" : "some minutes");
  std::fflush(stdout);

  if (quick) {
    suite.note(
        fmt::format("--quick: {} bounds, not {}, so memory/…, sweep/… and their targets are those of an L3 cache, and "
                    "curves have few points",
                    quick_run.bounds, full_run.bounds));
  }

  Results results;
  if (benchmark::RunSpecifiedBenchmarks(&results) == 0) {
    throw std::invalid_argument(fmt::format("--filter {}: matches no benchmark", filter));
  }
  print_table(suite, results);
  write_summary(out, suite, size, results);
  fmt::print("\nWritten to {} and {}.\n", out.string(), raw.string());
  for (const std::string& error : results.errors()) fmt::print(stderr, "shaftcull-bench: {}\n", error);
  return results.errors().empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "shaftcull-bench: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "shaftcull-bench: {}\n", error.what());
    return 1;
  }
}
