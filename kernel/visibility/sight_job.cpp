// SPDX-License-Identifier: MIT
#include "visibility/sight_job.hpp"

namespace shaftcull::kernel {

std::uint64_t SightJob::pairs(std::uint32_t a_group, std::uint32_t b_group) const noexcept {
  const std::uint64_t in_a = a.tree.groups()[a_group].count;
  const std::uint64_t in_b = b.tree.groups()[b_group].count;
  return is_of_one_set && a_group == b_group ? in_a * (in_a - 1) / 2 : in_a * in_b;
}

void SightAnswers::clear() noexcept {
  counts = {};
  blocks.clear();
  undecided.clear();
  first_candidate.resize(1);
  candidates.clear();
  places.clear();
}

std::size_t SightAnswers::memory_bytes() const noexcept {
  return blocks.size() * sizeof(blocks[0]) + undecided.size() * sizeof(undecided[0]) +
         first_candidate.size() * sizeof(first_candidate[0]) + candidates.size() * sizeof(candidates[0]) +
         places.size() * sizeof(places[0]);
}

std::size_t SightAnswers::held_bytes() const noexcept {
  return blocks.capacity() * sizeof(blocks[0]) + undecided.capacity() * sizeof(undecided[0]) +
         first_candidate.capacity() * sizeof(first_candidate[0]) + candidates.capacity() * sizeof(candidates[0]) +
         places.capacity() * sizeof(places[0]);
}

std::size_t SightLists::held_bytes() const noexcept {
  return (candidates.capacity() + solids.capacity() + polygons.capacity()) * sizeof(candidates[0]);
}

}  // namespace shaftcull::kernel
