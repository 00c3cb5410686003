// SPDX-License-Identifier: MIT
#include "visibility/verdicts.hpp"

#include <cstddef>
#include <string>
#include <utility>

#include "visibility/visibility_arguments.hpp"

namespace shaftcull::kernel {
namespace {

std::vector<std::uint32_t> places(const PatchTree& tree) {
  std::vector<std::uint32_t> place(tree.order().size());
  for (std::size_t p = 0; p != place.size(); ++p) place[tree.order()[p]] = static_cast<std::uint32_t>(p);
  return place;
}

}  // namespace

UndecidedPairs undecided_of(const SightJob& job, const SightAnswers& answers) noexcept {
  if (!job.wants_candidates) return {answers.undecided, {}, {}};
  return {answers.undecided, answers.first_candidate, answers.candidates};
}

Verdicts::Verdicts(const VisibilityOptions& options, const SightJob& job, const CallersModes& modes)
    : options_(options), job_(job), modes_(modes) {
  if (!options.resolve) return;
  a_place_ = places(job.a.tree);
  b_place_ = job.is_of_one_set ? a_place_ : places(job.b.tree);
}

void Verdicts::resolve(SightAnswers& answers) const {
  if (!options_.resolve || answers.undecided.empty()) return;
  std::vector<Sight> verdict(answers.undecided.size(), Sight::undecided);
  modes_([&] { options_.resolve(undecided_of(job_, answers), verdict); });
  for (std::size_t i = 0; i != verdict.size(); ++i) {
    if (verdict[i] <= Sight::facing_away) continue;
    const PatchPair pair = answers.undecided[i];
    refuse_sight("verdict[" + std::to_string(i) + "]", verdict[i],
                 ", of patches " + std::to_string(pair.a) + " and " + std::to_string(pair.b) + ",");
  }
  apply(verdict, answers);
}

/// Blocks are put where their pairs were found, so that it does not matter where a part of the answers ends.
void Verdicts::apply(std::span<const Sight> verdict, SightAnswers& answers) const {
  std::vector<PairBlock> blocks;
  if (job_.wants_blocks) blocks.reserve(answers.blocks.size() + verdict.size());
  std::size_t taken = 0;
  const auto take = [&](std::size_t end) {
    const auto at = [&](std::size_t i) { return answers.blocks.begin() + static_cast<std::ptrdiff_t>(i); };
    blocks.insert(blocks.end(), at(taken), at(end));
    taken = end;
  };
  std::size_t left = 0;
  std::size_t candidates = 0;
  for (std::size_t i = 0; i != verdict.size(); ++i) {
    const PatchPair pair = answers.undecided[i];
    if (verdict[i] == Sight::undecided) {
      answers.undecided[left++] = pair;
      if (!job_.wants_candidates) continue;
      for (std::size_t c = answers.first_candidate[i]; c != answers.first_candidate[i + 1]; ++c) {
        answers.candidates[candidates++] = answers.candidates[c];
      }
      answers.first_candidate[left] = candidates;  // at or before what is still to be read
      continue;
    }
    --answers.counts.undecided;
    ++answers.counts.of(verdict[i]);
    if (!job_.wants_blocks) continue;
    take(answers.places[i]);
    blocks.push_back({{a_place_[pair.a], 1}, {b_place_[pair.b], 1}, verdict[i]});
  }
  take(answers.blocks.size());
  answers.blocks = std::move(blocks);
  answers.undecided.resize(left);
  if (!job_.wants_candidates) return;
  answers.first_candidate.resize(left + 1);
  answers.candidates.resize(candidates);
}

}  // namespace shaftcull::kernel
