// SPDX-License-Identifier: MIT
/// The parts of a job that ranks share: dealt to whoever is free, kept in a folder, and found there by a later run.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "batch/block_store.hpp"
#include "batch/dealing.hpp"
#include "batch/job_folder.hpp"
#include "batch/progress_lines.hpp"
#include "batch/ranks.hpp"

namespace shaftcull::cli {

/// The folder in which a job that writes this file keeps what is finished: beside the file, so on the same file system.
[[nodiscard]] std::string folder_beside(const std::string& file);

/// Throws InvalidArgument if the file of an option is a stream: nothing can be kept beside it. An empty path is not
/// checked.
void require_file(const char* option, const std::string& path);

/// Parts of some pairs, numbered from 0. All ranks make a RankedParts, and call its members in the same order. Members
/// that say *all* throw as batch::on_all() does.
class RankedParts {
 public:
  /// `verb` is what messages call the job. With an empty folder nothing is kept.
  RankedParts(std::string verb, std::string folder, batch::Ranks& ranks, const batch::Surroundings& surroundings);

  [[nodiscard]] batch::Ranks& ranks() noexcept { return ranks_; }
  [[nodiscard]] bool keeps() const noexcept { return !folder_.path().empty(); }
  /// The path of a file in the folder.
  [[nodiscard]] std::string file(const char* name) const { return folder_.path() + '/' + name; }

  /// Rank 0: begins a job, or resumes one. Throws InvalidArgument if the folder belongs to another job.
  void open(const batch::JobDescription& job);
  /// All, after open(): sets the number of parts and of pairs.
  void begin(const batch::JobDescription& job, std::size_t parts, std::uint64_t pairs);

  /// All: finds the parts that an earlier run has finished. Each is read by one rank, which calls note(part, answer).
  template <class Answer>
  void find_finished(const std::function<void(std::size_t, const Answer&)>& note) {
    find([&](std::size_t part) {
      const std::optional<Answer> answer = store_->read<Answer>(0, part);
      if (answer) note(part, *answer);
      return answer.has_value();
    });
  }

  /// All: finds the answers of all other parts: answer(part) is called by one rank each, and note(part, answer) by the
  /// same rank.
  template <class Answer>
  void compute(const std::function<Answer(std::size_t)>& answer,
               const std::function<void(std::size_t, const Answer&)>& note) {
    compute_left([&, this](std::size_t part) -> batch::Dealing::Rest {
      const auto found = std::make_shared<const Answer>(answer(part));
      note(part, *found);
      return [this, found, part] { store_->write(0, part, *found); };
    });
  }

  /// All: calls ask(part) once for each part, on one rank each. For jobs without a folder.
  void compute(const std::function<void(std::size_t)>& ask);

  /// The answer of a part, which was whole on disk a moment ago. Throws std::runtime_error if it no longer is.
  template <class Answer>
  [[nodiscard]] Answer stored(std::size_t part) const {
    if (std::optional<Answer> answer = store_->read<Answer>(0, part)) return *std::move(answer);
    throw std::runtime_error(
        fmt::format("{}: is damaged; run the same command again to recompute it", store_->path(0, part)));
  }

  /// All: hands out pieces of work to free ranks, and reports progress. `before` pieces were done by earlier runs, and
  /// are not among `pieces`.
  void deal(const char* phase, std::uint64_t pieces, const std::function<batch::Dealing::Rest(std::uint64_t)>& work,
            std::uint64_t before = 0);

  /// On rank 0, at the end: removes the folder.
  void remove() noexcept;

 private:
  void find(const std::function<bool(std::size_t)>& read);
  void compute_left(const std::function<batch::Dealing::Rest(std::size_t)>& ask);

  std::string verb_;
  batch::Ranks& ranks_;
  const batch::Surroundings& surroundings_;
  batch::JobFolder folder_;
  batch::ProgressLines progress_;
  std::optional<batch::BlockStore> store_;
  std::vector<std::uint64_t> finished_;  ///< 1 for each part that an earlier run has stored
  std::uint64_t pairs_ = 0;
};

}  // namespace shaftcull::cli
