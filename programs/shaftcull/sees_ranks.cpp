// SPDX-License-Identifier: MIT
#include "sees_ranks.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "batch/block_store.hpp"
#include "batch/checksum.hpp"
#include "batch/dealing.hpp"
#include "batch/job_folder.hpp"
#include "batch/launcher.hpp"
#include "batch/progress_lines.hpp"
#include "batch/written_file.hpp"
#include "output_file.hpp"
#include "peak_memory.hpp"
#include "ranked_run.hpp"
#include "sees_estimate.hpp"
#include "sees_places.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/many.hpp"

namespace shaftcull::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A checksum of all that answers depend on.
std::uint64_t checksum_of(const SeesScene& scene) {
  batch::RunningChecksum sum;
  const auto add = [&](const auto& values) { sum.add(std::as_bytes(std::span(values))); };
  add(scene.boxes);
  add(scene.planes);
  add(scene.outlines.corners);
  for (const MeshPatch& patch : scene.patches) add(patch.corner);
  for (std::size_t i = 0; i < scene.occluders.size(); ++i) {
    const Box box = scene.occluders.box(i);
    add(box.lo);
    add(box.hi);
    add(scene.occluder_triangles[i]);
  }
  return sum.value();
}

/// Where answers are kept: beside the file that is written last, so that it is on the same file system.
std::string folder_beside(const SeesOptions& options) {
  const std::string& picture = options.svg.empty() ? options.ply : options.svg;
  const std::string& path = options.out.empty() ? picture : options.out;
  return path.empty() ? path : file_behind(path) + ".parts";
}

/// Nothing can be kept beside a stream.
void require_file(const char* option, const std::string& path) {
  if (path.empty() || !is_stream(path)) return;
  throw InvalidArgument(fmt::format(
      "{} {}: ranks keep finished results beside this file, so it cannot be a stream; give a file", option, path));
}

class RankedSees {
 public:
  RankedSees(SeesJob& job, batch::Ranks& ranks, const batch::Surroundings& surroundings)
      : job_(job),
        ranks_(ranks),
        surroundings_(surroundings),
        folder_(folder_beside(job.options())),
        keeps_(!folder_.path().empty()),
        part_(folder_.path() + "/result"),
        progress_(stderr, ranks.rank() == 0 ? batch::ProgressForm::text : batch::ProgressForm::none) {}

  void run() {
    batch::agree_on_version(ranks_, surroundings_.version);
    batch::on_all(ranks_, [&] { job_.prepare(); });
    describe();
    batch::on_all(ranks_, [&] { begin_files(); });
    batch::on_first(ranks_, [&] { announce(); });
    if (keeps_) {
      const std::string text = batch::text_of(description_);
      store_.emplace(folder_.path(), batch::fingerprint(std::as_bytes(std::span(text))), ranks_.rank());
      batch::on_first(ranks_, [&] { store_->make_folders(1); });
      find_finished();
    } else {
      finished_.assign(job_.patches().units(), 0);
    }
    compute();
    if (places_) write_file();
    finish();
  }

 private:
  void describe() {
    const SeesOptions& options = job_.options();
    const std::uint64_t scene = checksum_of(job_.scene());
    batch::agree_on(ranks_, scene, fmt::format("{} has other patches than on rank 0", job_.source()));
    description_ = {{"version", surroundings_.version},
                    {"scene", fmt::format("{} patches, {:016x}", job_.patches().size(), scene)},
                    {"rays", fmt::format("{}", options.content.rays)},
                    {"candidates", options.content.candidates ? "written" : "not written"},
                    {"seed", fmt::format("{}", options.scene.seed)}};
    const std::string text = batch::text_of(description_) + options.out + '\n' + options.svg + '\n' + options.ply +
                             (options.objects ? "\nobjects" : "");
    batch::agree_on(ranks_, batch::checksum(std::as_bytes(std::span(text))),
                    "was started with other options than rank 0");
  }

  void announce() const {
    std::string text = announcement(job_.source(), job_.scene(), job_.patches()) + '\n';
    const std::string likely =
        estimate(job_.scene(), job_.patches(), work_, job_.options().out, keeps_ || !sums_.empty(), ranks_.size());
    if (!likely.empty()) text += likely + '\n';
    static_cast<void>(std::fputs(text.c_str(), stderr));
  }

  void begin_files() {
    const std::string& out = job_.options().out;
    if (!out.empty()) places_ = sight_places(out, job_.scene(), job_.patches(), work_.content);
    sums_ = job_.open_sums();
    if (ranks_.rank() != 0) return;
    pictures_ = job_.open_pictures();
    if (keeps_) folder_.lock();
    if (keeps_) folder_.begin(description_);
    if (places_) file_.emplace(out, part_);
  }

  /// Takes from an answer what is to be known before all are there, while it is in memory.
  void note(std::size_t unit, const UnitAnswer& answer) {
    counts_ += hand_over(answer, std::vector<SightSink*>(sums_.begin(), sums_.end()));
    if (places_) places_->measure(unit, answer);
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
        const std::optional<UnitAnswer> answer = store_->read<UnitAnswer>(0, unit);
        if (!answer) continue;
        finished_[unit] = 1;
        note(unit, *answer);
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
    phase_begin_ = Clock::now();
    const batch::ProgressState state = state_of("compute", units - left.size(), units);
    UnitQuestion question(job_.scene(), job_.patches(), work_);
    const auto ask = [&](std::uint64_t piece) -> batch::Dealing::Rest {
      const std::size_t unit = left[static_cast<std::size_t>(piece)];
      threads_ = concurrency();
      if (!keeps_) {
        counts_ += question.deliver(unit, std::vector<SightSink*>(sums_.begin(), sums_.end()), {});
        return {};
      }
      const auto answer = std::make_shared<const UnitAnswer>(answer_of(question, unit));
      note(unit, *answer);
      return [this, answer, unit] { store_->write(0, unit, *answer); };
    };
    deal(dealing, left.size(), ask, state);
  }

  /// All ranks write pieces of the file to where they belong.
  void write_file() {
    ranks_.sum(places_->lengths());
    places_->arrange();
    batch::Dealing dealing(ranks_, surroundings_, 1);
    const std::size_t others = places_->other_pieces();
    const std::uint64_t pieces = others + finished_.size();
    phase_begin_ = Clock::now();
    std::optional<batch::WrittenFile> file;
    batch::on_all(ranks_, [&] { file.emplace(part_, false); });
    const auto read = [&](std::uint64_t piece) -> batch::Dealing::Rest {
      const auto number = static_cast<std::size_t>(piece);
      if (number < others) return [&, number] { places_->write_other(number, *file); };
      const std::size_t unit = number - others;
      const auto answer = std::make_shared<const UnitAnswer>(stored(unit));
      return [&, unit, answer] { places_->write_unit(unit, *answer, *file); };
    };
    deal(dealing, pieces, read, state_of("write", 0, pieces));
    ranks_.sum(places_->sums());
    batch::on_all(ranks_, [&] {
      if (ranks_.rank() == 0) places_->complete(*file);
      file->sync();
      file->close();
    });
  }

  /// The answers of a unit, which was whole on disk a moment ago. Throws if it no longer is.
  [[nodiscard]] UnitAnswer stored(std::size_t unit) const {
    if (std::optional<UnitAnswer> answer = store_->read<UnitAnswer>(0, unit)) return *std::move(answer);
    throw std::runtime_error(
        fmt::format("{}: is damaged; run the same command again to recompute it", store_->path(0, unit)));
  }

  [[nodiscard]] batch::ProgressState state_of(const char* phase, std::uint64_t before, std::uint64_t pieces) const {
    const double pairs = static_cast<double>(job_.patches().pairs());
    return {phase, before, pieces, before, pieces == 0 ? 0 : pairs / static_cast<double>(pieces), 0, "pairs"};
  }

  /// Deals all pieces of a phase, and tells now and then how far it is.
  void deal(batch::Dealing& dealing, std::uint64_t pieces,
            const std::function<batch::Dealing::Rest(std::uint64_t)>& work, batch::ProgressState state) {
    const auto tell = [&] {
      state.blocks_done = state.blocks_before + dealing.finished();
      state.seconds = std::chrono::duration<double>(Clock::now() - phase_begin_).count();
      progress_.write(state);
    };
    const auto take_pieces = [&] {
      dealing.each(0, pieces, work, [&] {
        if (progress_.due()) tell();
      });
    };
    dealing.on_all_until_stopped(
        take_pieces,
        keeps_ ? fmt::format("sees: interrupted; finished results are in {}; run the same command again to resume",
                             folder_.path())
               : std::string("sees: interrupted"));
    if (ranks_.rank() == 0) tell();
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
      if (keeps_) folder_.remove();
    });
  }

  SeesJob& job_;
  batch::Ranks& ranks_;
  const batch::Surroundings& surroundings_;
  batch::JobFolder folder_;
  const bool keeps_;        ///< answers, for files
  const std::string part_;  ///< the file of answers until it is finished
  batch::ProgressLines progress_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point phase_begin_ = begin_;
  const SeesWork work_ = job_.work();
  batch::JobDescription description_;
  std::optional<batch::BlockStore> store_;
  std::vector<std::uint64_t> finished_;  ///< 1 for each unit that an earlier run has stored
  std::unique_ptr<SightPlaces> places_;  ///< null if no file of answers is wanted
  std::optional<OutputFile> file_;       ///< of rank 0; answers are written under the name part_
  SeesPictures pictures_;                ///< of rank 0
  std::span<SummingSink* const> sums_;
  SeesCounts counts_;  ///< of units that this rank answered, or found stored
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
    require_file("--ply", options.ply);
    options.isa.select();
  };
  run_on_ranks(options.threads, check, [&](batch::Ranks& ranks, const batch::Surroundings& surroundings) {
    RankedSees(job, ranks, surroundings).run();
  });
}

}  // namespace shaftcull::cli
