// SPDX-License-Identifier: MIT
#include "batch_job.hpp"

#include <cstdio>

#include <fmt/format.h>

#include "printable.hpp"
#include "ranked_run.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

std::string plural(batch::BoundKind kind) {
  return kind == batch::BoundKind::box ? "boxes" : fmt::format("{}s", batch::name_of(kind));
}

std::string summary(const batch::Job& job, const batch::JobReport& report, const batch::Ranks& ranks) {
  std::string text =
      fmt::format("{}: {} of {} shafts against {} {}\n", printable(job.out), batch::name_of(job.question.answer),
                  grouped(report.shafts), grouped(report.bounds), plural(report.bound_kind));
  text += fmt::format("{} block{} of shafts, {} share{} of bounds, {} rank{}, {:.1f} s", grouped(report.blocks),
                      report.blocks == 1 ? "" : "s", grouped(report.shares), report.shares == 1 ? "" : "s",
                      ranks.size(), ranks.size() == 1 ? "" : "s", report.seconds);
  if (report.blocks_before != 0) text += fmt::format("; blocks from an earlier run: {}", grouped(report.blocks_before));
  return text + '\n';
}

}  // namespace

void run_batch_job(const batch::Job& job, int threads, const std::function<void()>& check) {
  run_on_ranks(threads, check, [&](batch::Ranks& ranks, const batch::Surroundings& surroundings) {
    const batch::JobReport report = batch::run_job(job, ranks, surroundings);
    if (ranks.rank() == 0) std::fputs(summary(job, report, ranks).c_str(), stdout);
  });
}

}  // namespace shaftcull::cli
