// SPDX-License-Identifier: MIT
#include "sees_ranks.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "batch/block_store.hpp"
#include "batch/checksum.hpp"
#include "batch/dealing.hpp"
#include "batch/job_folder.hpp"
#include "batch/launcher.hpp"
#include "batch/progress_lines.hpp"
#include "peak_memory.hpp"
#include "ranked_run.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A checksum of all that answers depend on.
std::uint64_t checksum_of(const SeesScene& scene) {
  batch::RunningChecksum sum;
  const auto add = [&](const auto& values) { sum.add(std::as_bytes(std::span(values))); };
  add(scene.boxes);
  add(scene.planes);
  for (const MeshPatch& patch : scene.patches) add(patch.corner);
  for (std::size_t i = 0; i < scene.blockers.size(); ++i) {
    const Box box = scene.blockers.box(i);
    add(box.lo);
    add(box.hi);
    add(scene.blocker_triangles[i]);
  }
  return sum.value();
}

/// Nothing can be kept beside a stream.
void require_file(const char* option, const std::string& path) {
  if (path.empty() || !is_stream(path)) return;
  throw InvalidArgument(
      fmt::format("{} {}: ranks keep what is finished beside a file; this is none. Give a file", option, path));
}

class RankedSees {
 public:
  RankedSees(SeesJob& job, batch::Ranks& ranks, const batch::Surroundings& surroundings)
      : job_(job),
        ranks_(ranks),
        surroundings_(surroundings),
        keeps_(!job.options().out.empty() || !job.options().svg.empty()),
        folder_((job.options().out.empty() ? job.options().svg : job.options().out) + ".parts"),
        progress_(stderr, ranks.rank() == 0 ? batch::ProgressForm::text : batch::ProgressForm::none) {}

  void run() {
    batch::agree_on_version(ranks_, surroundings_.version);
    batch::on_all(ranks_, [&] { job_.prepare(); });
    describe();
    std::span<SightSink* const> sinks;
    batch::on_first(ranks_, [&] {
      if (keeps_) folder_.lock();
      if (keeps_) folder_.begin(description_);
      sinks = job_.open();
    });
    if (keeps_) {
      const std::string text = batch::text_of(description_);
      store_.emplace(folder_.path(), batch::fingerprint(std::as_bytes(std::span(text))), ranks_.rank());
      batch::on_first(ranks_, [&] { store_->make_folders(1); });
      find_finished();
    } else {
      finished_.assign(job_.patches().units(), 0);
    }
    compute();
    hand_over_all(sinks);
  }

 private:
  void describe() {
    const SeesOptions& options = job_.options();
    const std::uint64_t scene = checksum_of(job_.scene());
    batch::agree_on(ranks_, scene, fmt::format("{} has other patches there than for rank 0", job_.source()));
    description_ = {{"version", surroundings_.version},
                    {"scene", fmt::format("{} patches, {:016x}", job_.patches().size(), scene)},
                    {"rays", fmt::format("{}", options.rays)},
                    {"seed", fmt::format("{}", options.seed)}};
    const std::string text = batch::text_of(description_) + options.out + '\n' + options.svg;
    batch::agree_on(ranks_, batch::checksum(std::as_bytes(std::span(text))),
                    "was started with other options than rank 0");
  }

  /// Which units earlier runs have stored: each rank reads its part of them, and all learn of all.
  void find_finished() {
    finished_.assign(job_.patches().units(), 0);
    std::uint64_t resumed = folder_.resumed() ? 1 : 0;
    ranks_.sum({&resumed, 1});
    if (resumed == 0) return;
    batch::on_all(ranks_, [&] {
      for (auto unit = static_cast<std::size_t>(ranks_.rank()); unit < finished_.size();
           unit += static_cast<std::size_t>(ranks_.size())) {
        finished_[unit] = store_->read<UnitAnswer>(0, unit) ? 1 : 0;
      }
    });
    ranks_.sum(finished_);
  }

  void compute() {
    std::vector<std::size_t> left;
    for (std::size_t unit = 0; unit != finished_.size(); ++unit) {
      if (finished_[unit] == 0) left.push_back(unit);
    }
    batch::Dealing dealing(ranks_, surroundings_, 1);
    const std::uint64_t units = finished_.size();
    batch::ProgressState state{"compute", 0, units, units - left.size(), 0, 0, "pairs"};
    if (units != 0) state.things_a_block = static_cast<double>(job_.patches().pairs()) / static_cast<double>(units);
    const auto tell = [&] {
      state.blocks_done = state.blocks_before + dealing.finished();
      state.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
      progress_.write(state);
    };
    UnitQuestion question(job_.scene(), job_.patches(), work_);
    const auto ask = [&](std::uint64_t piece) -> batch::Dealing::Rest {
      const std::size_t unit = left[static_cast<std::size_t>(piece)];
      threads_ = concurrency();
      if (!keeps_) {
        counts_ += question.deliver(unit, {}, {});
        return {};
      }
      const auto answer = std::make_shared<const UnitAnswer>(answer_of(question, unit));
      return [this, answer, unit] { store_->write(0, unit, *answer); };
    };
    const auto work = [&] {
      dealing.each(0, left.size(), ask, [&] {
        if (progress_.due()) tell();
      });
    };
    dealing.on_all_until_stopped(
        work, keeps_ ? fmt::format("sees: interrupted; what is finished is in {}: the same command goes on with it",
                                   folder_.path())
                     : std::string("sees: interrupted"));
    if (ranks_.rank() == 0) tell();
  }

  void hand_over_all(std::span<SightSink* const> sinks) {
    if (!keeps_) {
      SeesCounts::Numbers all = counts_.numbers();
      ranks_.sum(all);
      counts_ = SeesCounts::of(all);
    }
    std::uint64_t threads = static_cast<std::uint64_t>(threads_);
    ranks_.sum({&threads, 1});
    batch::on_first(ranks_, [&] {
      for (std::size_t unit = 0; keeps_ && unit != job_.patches().units(); ++unit) {
        const std::optional<UnitAnswer> answer = store_->read<UnitAnswer>(0, unit);
        if (!answer) {
          throw std::runtime_error(
              fmt::format("{}: is damaged; the same command does it again", store_->path(0, unit)));
        }
        counts_ += hand_over(*answer, sinks);
      }
      for (SightSink* const sink : sinks) sink->finish();
      SeesReport report = report_of(job_.scene(), work_, job_.source());
      report.counts = counts_;
      report.threads = static_cast<int>(threads);
      report.ranks = ranks_.size();
      report.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
      report.memory = peak_memory();
      job_.finish(report);
      if (keeps_) folder_.remove();
    });
  }

  SeesJob& job_;
  batch::Ranks& ranks_;
  const batch::Surroundings& surroundings_;
  const bool keeps_;
  batch::JobFolder folder_;
  batch::ProgressLines progress_;
  Clock::time_point begin_ = Clock::now();
  const SeesWork work_ = job_.work();
  batch::JobDescription description_;
  std::optional<batch::BlockStore> store_;
  std::vector<std::uint64_t> finished_;  ///< 1 for each unit that an earlier run has stored
  SeesCounts counts_;
  int threads_ = 0;
};

}  // namespace

bool is_launched() noexcept {
  const batch::Launch launch = batch::launch();
  return launch.mpi || launch.processes > 1;
}

void run_on_launched_ranks(SeesJob& job) {
  const SeesOptions& options = job.options();
  const auto check = [&] {
    job.check();
    require_file("--out", options.out);
    require_file("--svg", options.svg);
    options.isa.select();
  };
  run_on_ranks(options.threads, check, [&](batch::Ranks& ranks, const batch::Surroundings& surroundings) {
    RankedSees(job, ranks, surroundings).run();
  });
}

}  // namespace shaftcull::cli
