// SPDX-License-Identifier: MIT
/// Formation by table: the rule worked out for every colouring when the library is compiled.
#pragma once

#include "formation/rule.hpp"

namespace shaftcull::kernel {

/// The joined edges of each of the Colours^6 colourings with colours below `Colours`: with 2 a row for every set
/// of blue faces (bit f for face f), with 3 a row for every number in base 3 (digit f for face f, the value of its
/// Colour).
template <unsigned Colours>
struct EdgeTable {
  static constexpr std::size_t size = Colours * Colours * Colours * Colours * Colours * Colours;
  std::array<JoinedEdges, size> row{};

  constexpr EdgeTable() noexcept {
    for (std::size_t r = 0; r < size; ++r) row[r] = joined_edges(colouring_of(r));
  }

  static constexpr Colouring colouring_of(std::size_t r) noexcept {
    Colouring colouring{};
    for (Colour& colour : colouring) {
      colour = static_cast<Colour>(r % Colours);
      r /= Colours;
    }
    return colouring;
  }
};

inline constexpr EdgeTable<2> table64;
inline constexpr EdgeTable<3> table729;

/// As search_edges(): the 64-entry table with purple faces looked up as red, and their edges dropped.
[[nodiscard]] JoinedEdges table64_edges(const Faces6& a, const Faces6& b) noexcept;

/// As search_edges(): a row of the 729-entry table.
[[nodiscard]] const JoinedEdges& table729_edges(const Faces6& a, const Faces6& b) noexcept;

}  // namespace shaftcull::kernel
