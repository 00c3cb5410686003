/// Tree order: which bounds share a node.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "shaftcull/bounds.hpp"

namespace shaftcull::kernel {

/// Integers in the order of floats, −0 before 0; x must not be NaN. Differences of integers take no branch to compare.
[[nodiscard]] constexpr std::uint32_t ordered_key(float x) noexcept {
  // All bits of a negative number turn, and the sign of the others: again without a branch.
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return bits ^ ((0U - (bits >> 31)) | 0x80000000U);
}
[[nodiscard]] constexpr float coordinate_of(std::uint32_t key) noexcept {
  return std::bit_cast<float>(key ^ (((key >> 31) - 1U) | 0x80000000U));
}

/// What the order is made from: where the centre of a bound is.
struct OrderEntry {
  std::array<std::uint32_t, 3> key;
  std::uint32_t index;

  OrderEntry() = default;
  OrderEntry(const Vec3& centre, std::uint32_t i) noexcept
      : key{ordered_key(centre[0]), ordered_key(centre[1]), ordered_key(centre[2])}, index(i) {}
};

/// Bounds are put in order class by class: see size_class().
inline constexpr unsigned size_classes = 10;

/// Sorts entries of one class after the other, entries of class c being [class_first[c], class_first[c + 1]), so that
/// any 64, 4096, … in a row from a multiple of that on are close together.
void sort_into_tree_order(OrderEntry* entries, const std::size_t (&class_first)[size_classes + 1]);

}  // namespace shaftcull::kernel
