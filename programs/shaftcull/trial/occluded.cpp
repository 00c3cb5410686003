// SPDX-License-Identifier: MIT
/// What trials ask about solid boxes that hide one end of a shaft from the other.
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "bits.hpp"
#include "oracle/blocking.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/occluded.hpp"
#include "shaftcull/tree.hpp"
#include "trial/trial.hpp"

namespace shaftcull::cli {
void Trial::note_blocking(std::size_t i, const ShaftInput& input) {
  // What blocks meets the shaft between the boxes; whether a plane that was added is in the way does not matter.
  const bool is_outside = input.added.empty() && !BitView(kept_)[i];
  if (!is_outside && oracle::blocks(input.a, input.b, boxes()[i])) blocking_[i / 64] |= bit_of(i);
}

void Trial::note_blocking(std::size_t i, const HullInput& input) {
  const auto end = input.points.begin() + static_cast<std::ptrdiff_t>(input.first_end);
  const std::vector<Vec3> p(input.points.begin(), end);
  const std::vector<Vec3> q(end, input.points.end());
  if (oracle::blocks(p, q, boxes()[i])) blocking_[i / 64] |= bit_of(i);
}

void Trial::ask_blocking(const CompiledShaft& shaft, const char* how) {
  const auto* const hull = std::get_if<HullInput>(&input_);
  const bool has_ends = hull != nullptr ? hull->first_end != 0 : std::holds_alternative<ShaftInput>(input_);
  if (spheres_ || !has_ends) return;
  const auto question = [&](const char* call) {
    return [=] { return fmt::format("{}, {}, {}", call, how, name(active_isa())); };
  };
  std::vector<std::uint32_t> listed(count_);
  listed.resize(list_occluders(shaft, boxes(), listed));
  std::vector<std::uint64_t> blocking(blocking_.size());
  for (const std::uint32_t i : listed) blocking[i / 64] |= bit_of(i);
  compare(blocking, blocking_, question("list_occluders"));
  std::vector<std::uint64_t> alone(blocking_.size());
  for (std::size_t i = 0; i != count_; ++i) {
    if (occluded(shaft, boxes()[i])) alone[i / 64] |= bit_of(i);
  }
  compare(alone, blocking_, question("occluded, one box"));
  const bool is_occluded = BitView(blocking_).count() != 0;
  if (occluded(shaft, boxes()) != is_occluded) fail(0, question("occluded, a view")());
  if (occluded(shaft, BoxTree(boxes())) != is_occluded) fail(0, question("occluded, a tree")());
}

}  // namespace shaftcull::cli
