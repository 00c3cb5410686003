// SPDX-License-Identifier: MIT
/// `shaftcull bench-report`: what the benchmark measured, as a page to look at.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "report/page.hpp"
#include "report/summary_file.hpp"
#include "shaftcull/error.hpp"
#include "subcommand.hpp"

namespace shaftcull::cli {
namespace {

struct ReportOptions {
  std::string in = "build/bench/summary.json";
  std::string out = "build/bench/report.html";
};

void write(const std::string& path, const std::string& page) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code ignored;  // a missing folder shows when the file is opened
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  std::ofstream file(path, std::ios::binary);
  file << page;
  if (!file.flush())
    throw InvalidArgument(fmt::format("--out {}: cannot be written; give a file in a folder that can", path));
}

void run(const ReportOptions& options) {
  write(options.out, report_page(read_summary(options.in)));
  fmt::print("Written to {}.\n", options.out);
}

}  // namespace

void add_bench_report(CLI::App& program) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& report = *program.add_subcommand("bench-report", "Make a page of plots from what the benchmark measured");
  report.add_option("--in", options->in, "Summary of a run of ./cmake/run bench (default: build/bench/summary.json)")
      ->type_name("FILE");
  report.add_option("--out", options->out, "The page (default: build/bench/report.html)")->type_name("FILE");
  report.footer("gnuplot draws the plots (Debian: gnuplot-nox). The page is one file that needs no other.");
  report.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
