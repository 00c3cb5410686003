// SPDX-License-Identifier: MIT
#include "peers/paper/shaft.hpp"

#include <cmath>
#include <cstdlib>
#include <new>

#include "peers/paper/edges.hpp"

namespace shaftcull::paper {
namespace {

/// Faces 0, 1, 2 are the low ones.
[[nodiscard]] constexpr bool is_high(std::size_t face) noexcept { return face >= 3; }
[[nodiscard]] constexpr std::size_t axis_of(std::size_t face) noexcept { return is_high(face) ? face - 3 : face; }

[[nodiscard]] float coordinate(const Corners& box, std::size_t face) noexcept {
  return box[is_high(face) ? 1 : 0][axis_of(face)];
}

}  // namespace

Shaft::Shaft(const Corners& box1, const Corners& box2, const Options& options) {
  for (int axis = 0; axis < 3; ++axis) {
    box_[0][axis] = box1[0][axis] < box2[0][axis] ? box1[0][axis] : box2[0][axis];
    box_[1][axis] = box1[1][axis] > box2[1][axis] ? box1[1][axis] : box2[1][axis];
  }
  try {
    if (options.formation == Formation::run_time) {
      join_by_search(box1, box2, options);
    } else {
      join_by_table(box1, box2, options);
    }
  } catch (const std::bad_alloc&) {
    free_planes();
    throw;
  }
}

Shaft::Shaft(Shaft&& other) noexcept : first_(other.first_) {
  for (int axis = 0; axis < 3; ++axis) {
    box_[0][axis] = other.box_[0][axis];
    box_[1][axis] = other.box_[1][axis];
  }
  other.first_ = nullptr;
}

Shaft::~Shaft() { free_planes(); }

void Shaft::free_planes() noexcept {
  for (PlaneRecord* plane = first_; plane != nullptr;) {
    PlaneRecord* const next = plane->next;
    std::free(plane);
    plane = next;
  }
}

void Shaft::join_by_search(const Corners& box1, const Corners& box2, const Options& options) {
  bool match[6];
  bool second[6];  // the colour: whether box 2 is further out
  for (std::size_t face = 0; face < 6; ++face) {
    const float x1 = coordinate(box1, face);
    const float x2 = coordinate(box2, face);
    match[face] = x1 == x2;
    second[face] = is_high(face) ? x2 > x1 : x2 < x1;
  }
  for (std::size_t face1 = 0; face1 < 5; ++face1) {
    if (match[face1]) continue;
    for (std::size_t face2 = face1 + 1; face2 < 6; ++face2) {
      if (match[face2] || !share_edge(face1, face2) || second[face1] == second[face2]) continue;
      join(box1, box2, face1, face2, options);
    }
  }
}

void Shaft::join_by_table(const Corners& box1, const Corners& box2, const Options& options) {
  std::size_t colours = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    colours |= static_cast<std::size_t>(box2[0][axis] < box1[0][axis]) << axis;
    colours |= static_cast<std::size_t>(box2[1][axis] > box1[1][axis]) << (axis + 3);
  }
  const EdgeList& list = edge_table[colours];
  for (std::size_t i = 0; i < list.count; ++i) join(box1, box2, list.edge[i].face1, list.edge[i].face2, options);
}

/// The plane holds the edge (face1, face2) of either box, so that in its two axes n = (Δ2, Δ1) up to signs, where Δ is
/// the distance between the boxes' faces; it points outwards on both.
void Shaft::join(const Corners& box1, const Corners& box2, std::size_t face1, std::size_t face2,
                 const Options& options) {
  const std::size_t axis1 = axis_of(face1);
  const std::size_t axis2 = axis_of(face2);
  const std::size_t along = 3 - axis1 - axis2;
  const float x1 = coordinate(box1, face1);
  const float x2 = coordinate(box1, face2);
  const float delta1 = std::fabs(coordinate(box2, face1) - x1);
  const float delta2 = std::fabs(coordinate(box2, face2) - x2);
  float n1 = is_high(face1) ? delta2 : -delta2;
  float n2 = is_high(face2) ? delta1 : -delta1;
  if (options.spheres) {
    const float scale = 1.0F / std::sqrt(n1 * n1 + n2 * n2);
    n1 *= scale;
    n2 *= scale;
  }

  auto* const plane = static_cast<PlaneRecord*>(std::malloc(sizeof(PlaneRecord)));
  if (plane == nullptr) throw std::bad_alloc();
  plane->normal[axis1] = n1;
  plane->normal[axis2] = n2;
  plane->normal[along] = 0.0F;
  plane->offset = n1 * x1 + n2 * x2;
  // Low corners are nearest to the shaft where the normal points up.
  plane->near[axis1] = is_high(face1) ? 0 : 1;
  plane->near[axis2] = is_high(face2) ? 0 : 1;
  plane->near[along] = 0;
  plane->far[axis1] = is_high(face1) ? 1 : 0;
  plane->far[axis2] = is_high(face2) ? 1 : 0;
  plane->far[along] = 1;
  plane->culled_area = 0.5F * delta1 * delta2;

  PlaneRecord** at = &first_;
  if (options.sorted) {
    while (*at != nullptr && (*at)->culled_area >= plane->culled_area) at = &(*at)->next;
  }
  plane->next = *at;
  *at = plane;
}

}  // namespace shaftcull::paper
