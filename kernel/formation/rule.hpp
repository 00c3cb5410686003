// SPDX-License-Identifier: MIT
/// The rule of formation: faces of the shaft box have colours, and an edge between red and blue makes a joining plane.
///
/// From E. Haines, "A Shaft Culling Tool", Journal of Graphics Tools 5(1), 2000.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "shaftcull/bounds.hpp"
#include "shaftcull/paper.hpp"
#include "support/exact_floats.hpp"

namespace shaftcull::kernel {

inline constexpr Face face_count = 6;

/// Who touches a face of the shaft box: only box a, only box b, or both.
enum class Colour : std::uint8_t { red, blue, purple };

/// A colour for each face.
using Colouring = std::array<Colour, face_count>;

/// The axis that face `f` is perpendicular to, and whether it is the upper one of the two there.
constexpr unsigned axis_of(Face f) noexcept { return f % 3U; }
constexpr bool is_hi(Face f) noexcept { return f >= 3; }

/// Positions of the six faces of a box, each on its own axis.
using Faces6 = std::array<float, face_count>;
static_assert(sizeof(Faces6) == sizeof(Box));
constexpr Faces6 positions(const Box& box) noexcept { return std::bit_cast<Faces6>(box); }

/// The colour of face `f` of the shaft box, where box a has its face `f` at `a` and box b at `b`.
constexpr Colour colour_of(Face f, float a, float b) noexcept {
  if (a == b) return Colour::purple;
  return (a < b) == is_hi(f) ? Colour::blue : Colour::red;
}

constexpr Colouring colours(const Faces6& a, const Faces6& b) noexcept {
  Colouring colouring{};
  for (Face f = 0; f < face_count; ++f) colouring[f] = colour_of(f, a[f], b[f]);
  return colouring;
}

/// Two neighbouring faces of a box, in ascending order.
struct FacePair {
  Face first;
  Face second;
};

/// The twelve edges of a box: all pairs of faces but the three opposite ones. Joining planes come in this order.
inline constexpr std::array<FacePair, 12> box_edges = [] {
  std::array<FacePair, 12> edges{};
  std::size_t count = 0;
  for (Face first = 0; first < face_count; ++first) {
    for (Face second = first + 1; second < face_count; ++second) {
      if (axis_of(first) != axis_of(second)) edges[count++] = {first, second};
    }
  }
  return edges;
}();

/// An edge of the shaft box that a joining plane cuts off.
struct JoinedEdge {
  Face red;
  Face blue;
  friend constexpr bool operator==(const JoinedEdge&, const JoinedEdge&) = default;
};

/// The edges of one shaft that need a joining plane.
struct JoinedEdges {
  std::array<JoinedEdge, max_joining_planes> edge{};
  std::uint8_t count = 0;

  constexpr void add(JoinedEdge joined) noexcept { edge[count++] = joined; }
};

/// The rule itself.
constexpr JoinedEdges joined_edges(const Colouring& colouring) noexcept {
  JoinedEdges joined;
  for (const FacePair& pair : box_edges) {
    const Colour first = colouring[pair.first];
    const Colour second = colouring[pair.second];
    if (first == Colour::red && second == Colour::blue) joined.add({pair.first, pair.second});
    if (first == Colour::blue && second == Colour::red) joined.add({pair.second, pair.first});
  }
  return joined;
}

}  // namespace shaftcull::kernel
