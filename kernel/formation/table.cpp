// SPDX-License-Identifier: MIT
#include "formation/table.hpp"

#include <algorithm>

namespace shaftcull::kernel {
namespace {

// Facts about the rule that need no table to be known.
static_assert(decltype(table64)::size == 64 && decltype(table729)::size == 729);
static_assert(table64.row[0].count == 0 && table64.row[63].count == 0, "one box around the other: nothing to join");
static_assert(table64.row[0b000001].count == 4, "a single blue face is joined along its four edges");
static_assert(table64.row[0b001001].count == 8, "two opposite blue faces are joined along theirs");
static_assert(table64.row[0b000111].count == 6, "boxes in opposite corners: the silhouette of a cube is a hexagon");
static_assert(table729.row[728].count == 0, "equal boxes: nothing to join");
static_assert(std::ranges::all_of(table729.row,
                                  [](const JoinedEdges& row) { return row.count <= max_joining_planes; }));
static_assert(std::ranges::any_of(table729.row,
                                  [](const JoinedEdges& row) { return row.count == max_joining_planes; }));

}  // namespace

JoinedEdges table64_edges(const Faces6& a, const Faces6& b) noexcept {
  unsigned blue = 0;
  unsigned purple = 0;
  for (Face f = 0; f < face_count; ++f) {
    // Without branches: colours of random boxes are coin tosses.
    const bool b_is_further = is_hi(f) ? b[f] > a[f] : b[f] < a[f];
    blue |= static_cast<unsigned>(b_is_further) << f;
    purple |= static_cast<unsigned>(a[f] == b[f]) << f;
  }
  if (purple == 0) return table64.row[blue];
  // Whichever colour a purple face is looked up as, it adds only edges that touch it.
  JoinedEdges joined;
  const JoinedEdges& row = table64.row[blue];
  for (std::size_t i = 0; i < row.count; ++i) {
    const JoinedEdge edge = row.edge[i];
    if (((purple >> edge.red | purple >> edge.blue) & 1) == 0) joined.add(edge);
  }
  return joined;
}

const JoinedEdges& table729_edges(const Faces6& a, const Faces6& b) noexcept {
  unsigned row = 0;
  for (Face f = face_count; f-- > 0;) {
    const bool b_is_further = is_hi(f) ? b[f] > a[f] : b[f] < a[f];
    row = 3 * row + static_cast<unsigned>(b_is_further) + 2 * static_cast<unsigned>(a[f] == b[f]);
  }
  return table729.row[row];
}

}  // namespace shaftcull::kernel
