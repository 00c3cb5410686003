// SPDX-License-Identifier: MIT
/// `shaftcull bench-report`: what the benchmark measured, as a page to look at.
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "output_file.hpp"
#include "report/page.hpp"
#include "report/summary_file.hpp"
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
  OutputFile file(path);
  file.write(page);
  file.finish();
}

void run(const ReportOptions& options) {
  write(options.out, report_page(read_summary(options.in)));
  if (!is_standard_output(options.out)) fmt::print("Written to {}.\n", options.out);
}

}  // namespace

void add_bench_report(CLI::App& program) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App& report = *program.add_subcommand("bench-report", "Make a page of plots from what the benchmark measured");
  report.add_option("--in", options->in, "Summary of a run of ./cmake/run bench (default: build/bench/summary.json)")
      ->type_name("FILE");
  report.add_option("--out", options->out, "The page; - is standard output (default: build/bench/report.html)")
      ->type_name("FILE");
  report.footer("gnuplot draws the plots (Debian: gnuplot-nox). The page is one file that needs no other.");
  report.callback([options] { run(*options); });
}

}  // namespace shaftcull::cli
