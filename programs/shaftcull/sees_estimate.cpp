// SPDX-License-Identifier: MIT
#include "sees_estimate.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "part_count.hpp"
#include "patch_rays.hpp"
#include "printable.hpp"
#include "shaftcull/geometry.hpp"
#include "shaftcull/many.hpp"
#include "table.hpp"

namespace shaftcull::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Runs of fewer pairs and rays are short, and nothing is estimated.
constexpr std::uint64_t few_pairs = 2'000'000;
/// Each side of the sample has a tenth of all patches, so that the sample has a fiftieth of all pairs.
constexpr std::size_t part_of_patches = 10;
constexpr std::size_t most_sampled = 4096;
/// Patches of a run lie together, as they do where all pairs are answered.
constexpr std::size_t runs = 16;
constexpr std::chrono::milliseconds time_for_rays{200};
constexpr double moment = 10;  // seconds
constexpr double hour = 3600;

struct SampledPatches {
  std::vector<std::uint32_t> patches;
  PatchSet set;
};

/// Evenly spaced runs of the order, half a space further if they are the second ones.
SampledPatches sampled(const SeesScene& scene, std::span<const std::uint32_t> order, bool second) {
  const std::size_t count = std::clamp<std::size_t>(order.size() / part_of_patches, 1, most_sampled);
  const std::size_t length = (count + runs - 1) / runs;
  std::vector<std::uint32_t> patches;
  for (std::size_t run = 0; run < runs; ++run) {
    const std::size_t first = std::min((2 * run + (second ? 1 : 0)) * order.size() / (2 * runs), order.size() - 1);
    const auto some = order.subspan(first, std::min(length, order.size() - first));
    patches.insert(patches.end(), some.begin(), some.end());
  }
  PatchSet set = scene.patch_set(patches);
  return {std::move(patches), std::move(set)};
}

double elapsed(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// What a share of all pairs took, to be multiplied.
struct Sample {
  std::uint64_t pairs = 0;
  double seconds = 0;
  std::uint64_t blocks = 0;
  std::uint64_t undecided = 0;
  std::uint64_t candidates = 0;
};

class Sampler {
 public:
  Sampler(const SeesScene& scene, const PatchSet& patches, const SeesWork& work)
      : scene_(scene),
        work_(work),
        a_(sampled(scene, patches.order(), false)),
        b_(sampled(scene, patches.order(), true)) {
    options_.memory = work.memory;
    options_.tolerance = scene.tolerance;
    options_.candidates = work.content.candidates || work.content.rays != 0;
  }

  Sample take(bool delivers) {
    Sample sample;
    sample.pairs = std::uint64_t{a_.patches.size()} * b_.patches.size();
    const auto begin = Clock::now();
    if (delivers) {
      const auto take = [&](const SightBatch& batch) {
        sample.blocks += batch.blocks.size();
        sample.undecided += batch.undecided.pairs.size();
        sample.candidates += batch.undecided.candidates.size();
        if (work_.content.rays != 0 && !some_) some_ = batch_of(batch.undecided);
      };
      visibility(a_.set, b_.set, scene_.occluders, take, options_);
    } else {
      static_cast<void>(count_visibility(a_.set, b_.set, scene_.occluders, options_));
    }
    sample.seconds = elapsed(begin);
    if (some_) sample.seconds += static_cast<double>(sample.undecided) * seconds_per_pair_of_rays() / concurrency();
    return sample;
  }

 private:
  struct Undecided {
    std::vector<PatchPair> pairs;
    std::vector<std::size_t> first_candidate;
    std::vector<std::uint32_t> candidates;
  };

  static std::optional<Undecided> batch_of(const UndecidedPairs& undecided) {
    if (undecided.pairs.empty()) return {};
    return Undecided{{undecided.pairs.begin(), undecided.pairs.end()},
                     {undecided.first_candidate.begin(), undecided.first_candidate.end()},
                     {undecided.candidates.begin(), undecided.candidates.end()}};
  }

  /// So many pairs, or the rest, of those that were kept, in leaps through them from the n-th on.
  Undecided some_from(std::size_t n, std::size_t most) const {
    Undecided batch;
    batch.first_candidate.push_back(0);
    for (const std::size_t end = std::min(n + most, some_->pairs.size()); n < end; ++n) {
      const std::size_t i = n * 7919 % some_->pairs.size();
      const auto candidate = [&](std::size_t place) {
        return some_->candidates.begin() + static_cast<std::ptrdiff_t>(some_->first_candidate[place]);
      };
      batch.pairs.push_back({a_.patches[some_->pairs[i].a], b_.patches[some_->pairs[i].b]});
      batch.candidates.insert(batch.candidates.end(), candidate(i), candidate(i + 1));
      batch.first_candidate.push_back(batch.candidates.size());
    }
    return batch;
  }

  /// On one thread. The first pair also prepares the scene, and is not timed.
  double seconds_per_pair_of_rays() const {
    constexpr std::size_t pairs_of_a_thread = 64;  // or fewer: a call of visible_fractions() takes one thread for them
    const PatchRays rays(scene_, work_.content.rays, work_.seed);
    std::array<std::uint32_t, pairs_of_a_thread> seen{};
    const auto cast = [&](const Undecided& batch) {
      rays.count_seen({batch.pairs, batch.first_candidate, batch.candidates},
                      std::span(seen).first(batch.pairs.size()));
      return batch.pairs.size();
    };
    cast(some_from(0, 1));
    const auto begin = Clock::now();
    std::size_t count = 0;
    do {
      count += cast(some_from(count, pairs_of_a_thread));
    } while (count < some_->pairs.size() && Clock::now() - begin < time_for_rays);
    return elapsed(begin) / static_cast<double>(count);
  }

  const SeesScene& scene_;
  const SeesWork& work_;
  VisibilityOptions options_;
  SampledPatches a_;
  SampledPatches b_;
  std::optional<Undecided> some_;  ///< of the first batch that has any
};

/// Bytes of a file, if it is like the sample.
double bytes_of(const Sample& sample, double pairs, std::size_t patches, const SeesWork& work, const std::string& out) {
  if (sight_form(out, patches) == SightForm::csv) {
    constexpr double rest_of_line = 12;  // of words and separators
    return pairs * (2 * std::ceil(std::log10(static_cast<double>(patches))) + rest_of_line);
  }
  constexpr double patch = 4 + 24 + 16 + 72 + 4;
  const double undecided = static_cast<double>(sample.undecided) *
                           (8.0 + (work.content.rays != 0 ? 4 : 0) + (work.content.candidates ? 8 : 0));
  const double candidates = work.content.candidates ? 4.0 * static_cast<double>(sample.candidates) : 0;
  return patch * static_cast<double>(patches) + (20.0 * static_cast<double>(sample.blocks) + undecided + candidates) *
                                                    pairs / static_cast<double>(sample.pairs);
}

/// How far floats of this size are apart.
double step_at(float size) {
  return double{std::nextafter(size, std::numeric_limits<float>::infinity())} - double{size};
}

/// A line about coordinates whose floats are coarse for what they describe; empty if they are not, or if it is no help
/// to move the scene to the origin.
std::string coarseness(const SeesScene& scene) {
  float largest = 0;
  float longest = 0;
  float thinnest = std::numeric_limits<float>::infinity();
  Box all = scene.mesh.boxes.front();
  for (const Box& box : scene.mesh.boxes) {
    all = joined(all, box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      largest = std::max({largest, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
      longest = std::max(longest, all.hi[axis] - all.lo[axis]);
      if (box.hi[axis] > box.lo[axis]) thinnest = std::min(thinnest, box.hi[axis] - box.lo[axis]);
    }
  }
  constexpr double steps_of_a_patch = 128;
  constexpr double steps_of_an_object = 16;
  constexpr double gain = 8;
  const double step = step_at(largest);
  const double step_near_origin = step_at(longest / 2);
  const bool is_coarse = step * steps_of_a_patch > scene.patch_size || step * steps_of_an_object > double{thinnest};
  if (!is_coarse || step < gain * step_near_origin) return {};
  return fmt::format(
      "\nCoordinates reach {}, where floats are {:.2g} apart; patches are {:.4g} long, and the thinnest object is "
      "{:.2g} thick: walls may be flat or lost. --origin moves the scene; near 0, floats are {:.1g} apart",
      largest, step, scene.patch_size, thinnest, step_near_origin);
}

std::string duration(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", std::ceil(seconds));
  return seconds < hour ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / hour);
}

}  // namespace

std::string announcement(const std::string& source, const SeesScene& scene, const PatchSet& patches) {
  const WorldPoint& origin = scene.mesh.origin;
  const std::string relative =
      origin == WorldPoint{} ? ""
                             : fmt::format("\nCoordinates are relative to {}, {}, {}", origin[0], origin[1], origin[2]);
  return fmt::format("{}: {} patches, {} pairs{}{}", printable(source), grouped(patches.size()),
                     grouped(pair_count(patches.size())), relative, coarseness(scene));
}

std::string estimate(const SeesScene& scene, const PatchSet& patches, const SeesWork& work, const std::string& out,
                     bool delivers, int ranks) {
  if (pair_count(patches.size()) * (1 + std::uint64_t{work.content.rays}) < few_pairs) return {};
  const double pairs = static_cast<double>(pair_count(patches.size()));
  const Sample sample = Sampler(scene, patches, work).take(delivers || work.content.rays != 0);
  const double seconds = sample.seconds * pairs / static_cast<double>(sample.pairs) / ranks;
  if (out.empty() && seconds < moment) return {};
  std::string text = fmt::format("This will take about {}", duration(seconds));
  if (!out.empty()) {
    text += fmt::format(", and write {}B to {}", prefixed(bytes_of(sample, pairs, patches.size(), work, out)),
                        printable(out));
  }
  if (seconds < hour) return text;
  const double larger = 2 * scene.patch_size;
  const std::uint64_t fewer = count_patches(scene.mesh.triangles, larger, most_patches);
  return text + fmt::format("; --patches {} would make {} pairs", larger, grouped(fewer * (fewer - 1) / 2));
}

}  // namespace shaftcull::cli
