// SPDX-License-Identifier: MIT
#include "batch_job.hpp"

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "complaint.hpp"
#include "interrupt.hpp"
#include "printable.hpp"
#include "subcommand.hpp"
#include "table.hpp"
#include "workers.hpp"

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
  if (report.blocks_before != 0) text += fmt::format("; {} were there from before", grouped(report.blocks_before));
  return text + '\n';
}

}  // namespace

void run_batch_job(const batch::Job& job, int threads, const std::function<void()>& check) {
  std::unique_ptr<batch::Ranks> ranks;
  try {
    ranks = batch::launched_ranks();
    std::optional<Workers> workers;
    batch::on_all(*ranks, [&] {
      check();
      workers.emplace(threads);
    });
    const InterruptWatch interrupt;
    const batch::Surroundings surroundings{[&](const std::function<void()>& work) { workers->run(work); },
                                           [&] { return interrupt.signal(); }};
    const batch::JobReport report = batch::run_job(job, *ranks, surroundings);
    if (ranks->rank() == 0) std::fputs(summary(job, report, *ranks).c_str(), stdout);
  } catch (const batch::OtherRankFailed& other) {
    if (ranks) ranks->meet();
    throw EarlyExit(ranks ? other.code() : exit_ok);
  } catch (const std::exception& error) {
    const int code = complain(error.what(), batch::exit_code_of(std::current_exception()));
    if (ranks) {
      // Where others do not know of it, they would wait for this rank for ever. Where they do, they wait until it is
      // said: a launcher ends all when the first of them ends.
      if (ranks->size() > 1 && !ranks->have_failed()) ranks->abort(code);
      ranks->meet();
    }
    throw EarlyExit(code);
  }
}

}  // namespace shaftcull::cli
