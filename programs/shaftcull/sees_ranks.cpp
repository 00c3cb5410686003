// SPDX-License-Identifier: MIT
#include "sees_ranks.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "batch/checksum.hpp"
#include "batch/dealing.hpp"
#include "batch/job_folder.hpp"
#include "batch/written_file.hpp"
#include "output_file.hpp"
#include "part_count.hpp"
#include "peak_memory.hpp"
#include "ranked_parts.hpp"
#include "ranked_run.hpp"
#include "scene_checksum.hpp"
#include "sees_estimate.hpp"
#include "sees_places.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::cli {
namespace {

using Clock = std::chrono::steady_clock;

class RankedSees {
 public:
  RankedSees(SeesJob& job, batch::Ranks& ranks, const batch::Surroundings& surroundings)
      : job_(job),
        ranks_(ranks),
        surroundings_(surroundings),
        parts_("sees", folder_beside(job.options().kept_beside()), ranks, surroundings) {}

  void run() {
    batch::agree_on_version(ranks_, surroundings_.version);
    batch::on_all(ranks_, [&] { job_.prepare(); });
    describe();
    batch::on_all(ranks_, [&] { begin_files(); });
    batch::on_first(ranks_, [&] { announce(); });
    parts_.begin(description_, part_count(job_.patches().size(), parts_of_sees), pair_count(job_.patches().size()));
    compute();
    if (places_) write_file();
    finish();
  }

 private:
  using Note = std::function<void(std::size_t, const PartAnswer&)>;

  void describe() {
    const SeesOptions& options = job_.options();
    const std::string scene = scene_checksum(job_.scene());
    batch::agree_on(ranks_, batch::checksum(std::as_bytes(std::span(scene))),
                    fmt::format("{} has other patches than on rank 0", job_.source()));
    description_ = {{"command", "sees"},
                    {"version", surroundings_.version},
                    {"scene", scene},
                    {"--rays", fmt::format("{}", options.content.rays)},
                    {"--candidates", options.content.candidates ? "written" : "not written"},
                    {"--seed", fmt::format("{}", options.scene.seed)}};
    const std::string text = batch::text_of(description_) + options.out + '\n' + options.svg + '\n' + options.ply +
                             (options.objects ? "\nobjects" : "");
    batch::agree_on(ranks_, batch::checksum(std::as_bytes(std::span(text))),
                    "was started with other options than rank 0");
  }

  void announce() const {
    std::string text = announcement(job_.source(), job_.scene(), job_.patches()) + '\n';
    const std::string likely = estimate(job_.scene(), job_.patches(), work_, job_.options().out,
                                        parts_.keeps() || !sums_.empty(), ranks_.size());
    if (!likely.empty()) text += likely + '\n';
    static_cast<void>(std::fputs(text.c_str(), stderr));
  }

  void begin_files() {
    const std::string& out = job_.options().out;
    if (!out.empty()) places_ = sight_places(out, job_.scene(), job_.patches(), work_.content);
    sums_ = job_.open_sums();
    if (ranks_.rank() != 0) return;
    pictures_ = job_.open_pictures();
    parts_.open(description_);
    if (places_) file_.emplace(out, parts_.file("result"));
  }

  [[nodiscard]] std::vector<SightSink*> sinks() const { return {sums_.begin(), sums_.end()}; }

  void compute() {
    surroundings_.on_threads([&] { threads_ = concurrency(); });
    PartQuestion question(job_.scene(), job_.patches(), work_);
    if (!parts_.keeps()) {
      parts_.compute([&](std::size_t part) { counts_ += question.deliver(part, sinks(), {}); });
      return;
    }
    // Takes from an answer what is to be known before all are there, while it is in memory.
    const Note note = [&](std::size_t part, const PartAnswer& answer) {
      counts_ += hand_over(answer, sinks());
      if (places_) places_->measure(part, answer);
    };
    const std::function<PartAnswer(std::size_t)> answer = [&](std::size_t part) { return answer_of(question, part); };
    parts_.find_finished(note);
    parts_.compute(answer, note);
  }

  /// All ranks write pieces of the file to where they belong.
  void write_file() {
    ranks_.sum(places_->lengths());
    places_->arrange();
    const std::size_t others = places_->other_pieces();
    std::optional<batch::WrittenFile> file;
    batch::on_all(ranks_, [&] { file.emplace(parts_.file("result"), false); });
    const auto read = [&](std::uint64_t piece) -> batch::Dealing::Rest {
      const auto number = static_cast<std::size_t>(piece);
      if (number < others) return [&, number] { places_->write_other(number, *file); };
      const std::size_t part = number - others;
      const auto answer = std::make_shared<const PartAnswer>(parts_.stored<PartAnswer>(part));
      return [&, part, answer] { places_->write_part(part, *answer, *file); };
    };
    parts_.deal("write", others + part_count(job_.patches().size(), parts_of_sees), read);
    ranks_.sum(places_->sums());
    batch::on_all(ranks_, [&] {
      if (ranks_.rank() == 0) places_->complete(*file);
      file->sync();
      file->close();
    });
  }

  void finish() {
    SeesCounts::Numbers counts = counts_.numbers();
    ranks_.sum(counts);
    auto threads = static_cast<std::uint64_t>(threads_);
    ranks_.sum({&threads, 1});
    for (SummingSink* const sums : sums_) ranks_.sum(sums->sums());
    batch::on_first(ranks_, [&] {
      if (file_) file_->finish();
      for (SummingSink* const sums : sums_) sums->finish();
      SeesReport report = report_of(job_.scene(), work_, job_.source());
      report.counts = SeesCounts::of(counts);
      report.threads = static_cast<int>(threads);
      report.ranks = ranks_.size();
      report.seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
      report.memory = peak_memory();
      job_.finish(std::move(report), pictures_);
      parts_.remove();
    });
  }

  SeesJob& job_;
  batch::Ranks& ranks_;
  const batch::Surroundings& surroundings_;
  RankedParts parts_;
  Clock::time_point begin_ = Clock::now();
  const SeesWork work_ = job_.work();
  batch::JobDescription description_;
  std::unique_ptr<SightPlaces> places_;  ///< null if no file of answers is wanted
  std::optional<OutputFile> file_;       ///< of rank 0; answers are written under another name
  SeesPictures pictures_;                ///< of rank 0
  std::span<SummingSink* const> sums_;
  SeesCounts counts_;  ///< of parts that this rank answered, or found stored
  int threads_ = 0;
};

}  // namespace

void run_on_launched_ranks(SeesJob& job) {
  const SeesOptions& options = job.options();
  const auto check = [&] {
    options.require_files({});
    require_file("--out", options.out);
    require_file("--svg", options.svg);
    require_file("--ply", options.ply);
    options.isa.select();
  };
  run_on_ranks(options.threads, check, [&](batch::Ranks& ranks, const batch::Surroundings& surroundings) {
    RankedSees(job, ranks, surroundings).run();
  });
}

}  // namespace shaftcull::cli
