// SPDX-License-Identifier: MIT
/// Asks what sees what, and hands answers to files and pictures while they come.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "output_file.hpp"
#include "sees_scene.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::cli {

/// What is wanted of undecided pairs.
struct SightContent {
  std::uint32_t rays = 0;   ///< of each pair, 0 for none; with rays no solid blocks pairs of a patch that it holds
  bool candidates = false;  ///< the occluders that reach between its patches
};

/// How it is asked.
struct SeesWork {
  SightContent content;
  std::uint64_t seed = 1;
  std::size_t memory = std::size_t{256} << 20;
  /// As VisibilityOptions::progress.
  std::function<bool(const VisibilityProgress&)> progress;
  /// Whether to end now, which throws Cancelled; asked by many threads, also while rays are cast.
  std::function<bool()> stops;
};

/// How many pairs there are of each kind. The last three are parts of the undecided ones, and 0 without rays.
struct SeesCounts {
  SightCounts sights;
  std::uint64_t visible = 0;  ///< all of their rays arrive
  std::uint64_t partial = 0;  ///< some do
  std::uint64_t hidden = 0;   ///< none does

  SeesCounts& operator+=(const SeesCounts& more) noexcept;

  /// As they are stored and added up: undecided, clear, occluded, facing away; by rays visible, partly, hidden.
  using Numbers = std::array<std::uint64_t, 7>;
  [[nodiscard]] Numbers numbers() const noexcept;
  [[nodiscard]] static SeesCounts of(std::span<const std::uint64_t, 7> numbers) noexcept;
};

/// Takes answers while they come.
class SightSink {
 public:
  SightSink() = default;
  SightSink(const SightSink&) = delete;
  SightSink& operator=(const SightSink&) = delete;
  virtual ~SightSink() = default;

  /// `seen` has for each undecided pair of the batch how many of its rays arrive; it is empty without rays. Arrays of
  /// candidates are empty unless SightContent wants them.
  virtual void take(const SightBatch& batch, std::span<const std::uint32_t> seen) = 0;
  /// All answers were taken.
  virtual void finish() = 0;
};

/// A sink that adds up answers which several processes take.
class SummingSink : public SightSink {
 public:
  /// What was taken until now, to be added up over the processes before finish().
  [[nodiscard]] virtual std::span<std::uint64_t> sums() noexcept = 0;
};

/// Asks in the caller's task_arena. Throws Cancelled if the progress callback says so, and what sinks throw.
[[nodiscard]] SeesCounts find_what_sees(const SeesScene& scene, const PatchSet& patches, const SeesWork& work,
                                        std::span<SightSink* const> sinks);

/// The answers of one part, as they are kept until those of others are there.
struct PartAnswer {
  std::vector<std::uint64_t> counts;      ///< SeesCounts::Numbers
  std::vector<std::uint32_t> blocks;      ///< five a block: runs of two patches, and what they see
  std::vector<PatchPair> undecided;       ///< pairs
  std::vector<std::uint64_t> ends;        ///< of each pair, where its candidates end; empty unless they are wanted
  std::vector<std::uint32_t> candidates;  ///< of all pairs
  std::vector<std::uint32_t> seen;        ///< of each pair with rays, how many arrive

  /// As batch::BlockStore wants them.
  template <class Self>
  [[nodiscard]] static auto arrays(Self& self) {
    return std::tie(self.counts, self.blocks, self.undecided, self.ends, self.candidates, self.seen);
  }
};

/// Asks about parts one by one, in the caller's task_arena.
class PartQuestion {
 public:
  PartQuestion(const SeesScene& scene, const PatchSet& patches, const SeesWork& work);
  PartQuestion(const PartQuestion&) = delete;
  PartQuestion& operator=(const PartQuestion&) = delete;
  ~PartQuestion();

  /// Hands answers to sinks while they come. `progress` may be empty.
  SeesCounts deliver(std::size_t part, std::span<SightSink* const> sinks,
                     const std::function<bool(const VisibilityProgress&)>& progress);

 private:
  class RayAnswers;

  const SeesScene& scene_;
  const PatchSet& patches_;
  VisibilityOptions options_;
  SightContent content_;
  std::unique_ptr<RayAnswers> ray_answers_;
};

/// Where the candidates of each undecided pair end; empty if they are not wanted.
[[nodiscard]] inline std::span<const std::size_t> ends_of(const UndecidedPairs& undecided) {
  return undecided.first_candidate.empty() ? undecided.first_candidate : undecided.first_candidate.subspan(1);
}

/// All answers of a part.
[[nodiscard]] PartAnswer answer_of(PartQuestion& question, std::size_t part);

/// Hands such answers to sinks, and gives their counts.
SeesCounts hand_over(const PartAnswer& answer, std::span<SightSink* const> sinks);

/// What kinds of files of answers there are.
enum class SightForm : std::uint8_t { npz, csv };

/// What kind of file a path names, by the end of the name: .npz or .csv. A stream (output_file.hpp) whose name does not
/// say is CSV. Throws InvalidArgument for another name, or if a CSV file cannot have all pairs of so many patches.
[[nodiscard]] SightForm sight_form(const std::string& path, std::uint64_t patches);

/// A sink that writes such a file of all pairs. `order` is that of the patches. Throws InvalidArgument as sight_form(),
/// for a CSV file of candidates, and for a file that cannot be made.
[[nodiscard]] std::unique_ptr<SightSink> sight_file(const std::string& path, const SeesScene& scene,
                                                    std::span<const std::uint32_t> order, const SightContent& content);

/// What share of the others each patch sees: of pairs that are clear all; of those with rays the share of the rays that
/// arrive; of others nothing. And, without rays, of what share that is undecided.
class SeenShares final : public SummingSink {
 public:
  SeenShares(std::span<const std::uint32_t> order, std::uint32_t rays);

  void take(const SightBatch& batch, std::span<const std::uint32_t> seen) override;
  void finish() override;

  [[nodiscard]] std::span<std::uint64_t> sums() noexcept override { return sums_; }
  /// One for each patch, from 0 to 1, when all answers were taken.
  [[nodiscard]] std::span<const double> seen() const noexcept { return std::span(shares_).first(order_.size()); }
  /// Likewise; all are 0 with rays.
  [[nodiscard]] std::span<const double> undecided() const noexcept { return std::span(shares_).last(order_.size()); }

 private:
  std::span<const std::uint32_t> order_;
  std::uint64_t most_;               ///< what one other patch can add: its rays, or 1 without
  std::vector<std::uint64_t> sums_;  ///< seen, then undecided; integers, so that their order does not matter
  std::vector<double> shares_;
};

/// An SVG picture of the scene as seen along axis `up`, from where it points: patches that face there, in the colour of
/// the share that they see. If any is undecided, a second one beside it shows of what share.
[[nodiscard]] std::string svg_of_shares(const SeesScene& scene, const SeenShares& shares, std::size_t up);

/// Writes a PLY file of all patches: face i is patch i, in the colour of the share that it sees, with both shares and
/// its object as numbers.
void write_ply(const SeesScene& scene, const SeenShares& shares, OutputFile& file);

}  // namespace shaftcull::cli
