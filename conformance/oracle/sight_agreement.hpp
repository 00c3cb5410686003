// SPDX-License-Identifier: MIT
/// What is true of every pair of a scene, and whether the library says so.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "oracle/sight.hpp"
#include "oracle/sight_scene.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull {

/// A scene as sets and occluders.
struct SightCase {
  SightScene scene;
  PatchSet a;
  PatchSet b;
  Occluders occluders;
  VisibilityOptions options{};

  explicit SightCase(SightScene of)
      : scene(std::move(of)), a(first_set(scene)), b(second_set(scene)), occluders(occluders_of(scene)) {
    options.contact = scene.contact;
    options.solids_around_ends = scene.solids_around_ends;
    options.tolerance = scene.tolerance;
  }

  [[nodiscard]] bool has_pair(std::size_t i, std::size_t j) const { return !scene.is_of_one_set || i != j; }
  [[nodiscard]] std::uint64_t pairs() const {
    return scene.is_of_one_set ? a.size() * (a.size() - 1) / 2 : a.size() * b.size();
  }
  [[nodiscard]] Visibility collect(const VisibilityOptions& with) const {
    return scene.is_of_one_set ? collect_visibility(a, occluders, with) : collect_visibility(a, b, occluders, with);
  }
  [[nodiscard]] SightCounts count(const VisibilityOptions& with) const {
    return scene.is_of_one_set ? count_visibility(a, occluders, with) : count_visibility(a, b, occluders, with);
  }
  SightCounts deliver(FunctionRef<void(const SightBatch&)> to, const VisibilityOptions& with) const {
    return scene.is_of_one_set ? visibility(a, occluders, to, with) : visibility(a, b, occluders, to, with);
  }
  SightCounts bits(Sight sight, std::span<std::uint64_t> to, const VisibilityOptions& with) const {
    return scene.is_of_one_set ? visibility_bits(a, occluders, sight, to, with)
                               : visibility_bits(a, b, occluders, sight, to, with);
  }
};

/// The answers to all pairs, by patches.
class SightTable {
 public:
  /// What was answered for a pair; none if nothing was, or not this way round.
  struct Entry {
    std::optional<Sight> sight;
    std::vector<std::uint32_t> candidates;
  };

  SightTable(const SightCase& of, const Visibility& all) : columns_(of.b.size()), entries_(of.a.size() * columns_) {
    const PatchSet& b = of.scene.is_of_one_set ? of.a : of.b;
    for (const PairBlock& block : all.blocks) {
      if (block.sight == Sight::undecided) fail("a block is undecided");
      if (block.a.count == 0 || block.b.count == 0) fail("a block is empty");
      if (of.scene.is_of_one_set && block.a.first + block.a.count > block.b.first) fail("two runs overlap");
      for (const std::uint32_t i : of.a.order().subspan(block.a.first, block.a.count)) {
        for (const std::uint32_t j : b.order().subspan(block.b.first, block.b.count)) write(i, j).sight = block.sight;
      }
    }
    for (std::size_t p = 0; p != all.undecided.size(); ++p) {
      Entry& entry = write(all.undecided[p].a, all.undecided[p].b);
      entry.sight = Sight::undecided;
      if (all.first_candidate.empty()) continue;
      for (std::size_t c = all.first_candidate[p]; c != all.first_candidate[p + 1]; ++c) {
        entry.candidates.push_back(all.candidates[c]);
      }
    }
  }

  [[nodiscard]] const Entry& at(std::size_t i, std::size_t j) const { return entries_[i * columns_ + j]; }
  /// Empty, or what is wrong however pairs are answered.
  [[nodiscard]] const std::string& fault() const { return fault_; }
  /// How many of each kind.
  [[nodiscard]] SightCounts counts() const {
    SightCounts counts;
    for (const Entry& entry : entries_) {
      if (!entry.sight) continue;
      ++counts.of(*entry.sight);
    }
    return counts;
  }

 private:
  Entry& write(std::size_t i, std::size_t j) {
    Entry& entry = entries_[i * columns_ + j];
    if (entry.sight) fail("a pair was answered twice: " + std::to_string(i) + ", " + std::to_string(j));
    return entry;
  }
  void fail(const std::string& what) {
    if (fault_.empty()) fault_ = what;
  }

  std::size_t columns_;
  std::vector<Entry> entries_;
  std::string fault_;
};

/// What is true of all pairs of a case; of one set, of those with i < j.
class SightTruths {
 public:
  explicit SightTruths(const SightCase& of) : of_(of), columns_(of.b.size()) {
    const oracle::SightQuestion question = question_of(of.scene, of.occluders);
    const oracle::SightOracle oracle(question);
    truths_.resize(of.a.size() * columns_);
    for (std::size_t i = 0; i != of.a.size(); ++i) {
      for (std::size_t j = of.scene.is_of_one_set ? i + 1 : 0; j != columns_; ++j) {
        truths_[i * columns_ + j] = oracle.truth(i, j);
      }
    }
  }
  [[nodiscard]] const oracle::SightTruth& at(std::size_t i, std::size_t j) const {
    return of_.scene.is_of_one_set && j < i ? truths_[j * columns_ + i] : truths_[i * columns_ + j];
  }

  /// Empty, or what the answers say that is not so.
  [[nodiscard]] std::string fault_of(const Visibility& all, bool with_candidates = true) const {
    const SightTable table(of_, all);
    if (!table.fault().empty()) return table.fault();
    if (!(table.counts() == all.counts)) return "counts are not those of the answers";
    if (table.counts().total() != of_.pairs()) return "not every pair is answered";
    for (std::size_t i = 0; i != of_.a.size(); ++i) {
      for (std::size_t j = 0; j != columns_; ++j) {
        const SightTable::Entry& entry = table.at(i, j);
        if (!of_.has_pair(i, j) || (of_.scene.is_of_one_set && !entry.sight && table.at(j, i).sight)) {
          if (entry.sight && !of_.has_pair(i, j)) return "a patch was paired with itself";
          continue;
        }
        if (!entry.sight) return "a pair is missing: " + std::to_string(i) + ", " + std::to_string(j);
        const oracle::SightTruth& truth = at(i, j);
        const bool is_right = *entry.sight == Sight::facing_away ? truth.is_facing_away
                              : *entry.sight == Sight::occluded  ? truth.is_occluded
                              : *entry.sight == Sight::clear
                                  ? truth.is_clear() && !truth.is_facing_away && !truth.is_occluded
                                  : !truth.is_facing_away && !truth.is_occluded && !truth.is_clear();
        if (!is_right ||
            (with_candidates && *entry.sight == Sight::undecided && entry.candidates != truth.candidates)) {
          return say(i, j, entry, truth);
        }
      }
    }
    return {};
  }

 private:
  static void print(std::ostream& to, const std::vector<std::uint32_t>& list) {
    for (const std::uint32_t i : list) to << ' ' << i;
  }
  [[nodiscard]] std::string say(std::size_t i, std::size_t j, const SightTable::Entry& entry,
                                const oracle::SightTruth& truth) const {
    std::ostringstream text;
    text << "on " << name(active_isa()) << ", form visibility; pair " << i << ", " << j << " is "
         << (truth.is_facing_away ? "facing_away"
             : truth.is_occluded  ? "occluded"
             : truth.is_clear()   ? "clear"
                                  : "undecided")
         << ", answered " << name(*entry.sight) << "; candidates";
    print(text, truth.candidates);
    text << ", answered";
    print(text, entry.candidates);
    return text.str();
  }

  const SightCase& of_;
  std::size_t columns_;
  std::vector<oracle::SightTruth> truths_;
};

}  // namespace shaftcull
