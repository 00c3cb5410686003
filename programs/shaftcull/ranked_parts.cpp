// SPDX-License-Identifier: MIT
#include "ranked_parts.hpp"

#include <cstdio>
#include <span>
#include <utility>

#include "batch/checksum.hpp"
#include "output_file.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {

std::string folder_beside(const std::string& file) { return file.empty() ? file : file_behind(file) + ".parts"; }

void require_file(const char* option, const std::string& path) {
  if (path.empty() || !is_stream(path)) return;
  throw InvalidArgument(fmt::format(
      "{} {}: ranks keep finished results beside this file, so it cannot be a stream; give a file", option, path));
}

RankedParts::RankedParts(std::string verb, std::string folder, batch::Ranks& ranks,
                         const batch::Surroundings& surroundings)
    : verb_(std::move(verb)),
      ranks_(ranks),
      surroundings_(surroundings),
      folder_(std::move(folder)),
      progress_(stderr, ranks.rank() == 0 ? batch::ProgressForm::text : batch::ProgressForm::none) {}

void RankedParts::open(const batch::JobDescription& job) {
  if (!keeps()) return;
  folder_.lock();
  folder_.begin(job);
}

void RankedParts::begin(const batch::JobDescription& job, std::size_t parts, std::uint64_t pairs) {
  pairs_ = pairs;
  finished_.assign(parts, 0);
  if (!keeps()) return;
  const std::string text = batch::text_of(job);
  store_.emplace(folder_.path(), batch::fingerprint(std::as_bytes(std::span(text))), ranks_.rank());
  batch::on_first(ranks_, [&] { store_->make_folders(1); });
}

void RankedParts::find(const std::function<bool(std::size_t)>& read) {
  std::uint64_t resumed = folder_.resumed() ? 1 : 0;
  ranks_.sum({&resumed, 1});
  if (resumed == 0) return;
  batch::on_all(ranks_, [&] {
    for (auto part = static_cast<std::size_t>(ranks_.rank()); part < finished_.size();
         part += static_cast<std::size_t>(ranks_.size())) {
      if (read(part)) finished_[part] = 1;
    }
  });
  ranks_.sum(finished_);
}

void RankedParts::compute(const std::function<void(std::size_t)>& ask) {
  compute_left([&](std::size_t part) -> batch::Dealing::Rest {
    ask(part);
    return {};
  });
}

void RankedParts::compute_left(const std::function<batch::Dealing::Rest(std::size_t)>& ask) {
  std::vector<std::size_t> left;
  for (std::size_t part = 0; part != finished_.size(); ++part) {
    if (finished_[part] == 0) left.push_back(part);
  }
  deal(
      "compute", left.size(), [&](std::uint64_t piece) { return ask(left[static_cast<std::size_t>(piece)]); },
      finished_.size() - left.size());
}

void RankedParts::deal(const char* phase, std::uint64_t pieces,
                       const std::function<batch::Dealing::Rest(std::uint64_t)>& work, std::uint64_t before) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const std::uint64_t all = before + pieces;
  batch::ProgressState state{
      phase, before,  all,    before, all == 0 ? 0 : static_cast<double>(pairs_) / static_cast<double>(all),
      0,     "pairs", "parts"};
  batch::Dealing dealing(ranks_, surroundings_, 1);
  const auto tell = [&] {
    state.blocks_done = before + dealing.finished();
    state.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    progress_.write(state);
  };
  const auto take_pieces = [&] {
    bool is_told = false;
    dealing.each(0, pieces, work, [&] {
      if (progress_.due()) tell();
      if (is_told || surroundings_.interrupted() == 0) return;
      is_told = true;
      static_cast<void>(std::fputs("ending when the parts under way are finished\n", stderr));
    });
  };
  dealing.on_all_until_stopped(
      take_pieces,
      keeps() ? fmt::format("{}: interrupted; finished results are in {}; run the same command again to resume", verb_,
                            folder_.path())
              : fmt::format("{}: interrupted", verb_));
  if (ranks_.rank() == 0) tell();
}

void RankedParts::remove() noexcept {
  if (keeps()) folder_.remove();
}

}  // namespace shaftcull::cli
