// SPDX-License-Identifier: MIT
/// The edges of the shaft box along which planes can join the two object boxes, and the paper's 64-entry table of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace shaftcull::paper {

/// The edge between two neighbouring faces of a box; faces 0, 1, 2 are lo x, lo y, lo z; 3, 4, 5 are hi x, hi y, hi z.
struct Edge {
  std::uint8_t face1;
  std::uint8_t face2;
};

/// The edges that need a plane.
struct EdgeList {
  std::uint8_t count = 0;
  std::array<Edge, 8> edge{};
};

/// Opposite faces (lo y and hi y) share no edge.
[[nodiscard]] constexpr bool share_edge(std::size_t face1, std::size_t face2) noexcept { return face1 + 3 != face2; }

/// Entry `colours`, bit f of which is the colour of face f: the edges whose two faces differ in colour.
inline constexpr std::array<EdgeList, 64> edge_table = [] {
  std::array<EdgeList, 64> table{};
  for (std::size_t colours = 0; colours < table.size(); ++colours) {
    for (std::size_t face1 = 0; face1 < 5; ++face1) {
      for (std::size_t face2 = face1 + 1; face2 < 6; ++face2) {
        const bool differ = ((colours >> face1 ^ colours >> face2) & 1) != 0;
        if (!share_edge(face1, face2) || !differ) continue;
        EdgeList& list = table[colours];
        list.edge[list.count++] = {static_cast<std::uint8_t>(face1), static_cast<std::uint8_t>(face2)};
      }
    }
  }
  return table;
}();

}  // namespace shaftcull::paper
