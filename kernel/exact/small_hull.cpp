// SPDX-License-Identifier: MIT
#include "exact/small_hull.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "exact/hull_planes.hpp"

namespace shaftcull::kernel {
namespace {

constexpr VertexSet only(unsigned vertex) noexcept { return VertexSet{1} << vertex; }

/// Whether a plane through 0 was found that has all directions of a hull strictly on one side.
bool are_on_one_side(const HullData& hull) noexcept {
  if (hull.vertices - hull.points < 2) return true;
  float normal[3] = {};
  const auto add = [&](const float(&direction)[3]) {
    const float size = std::max({std::fabs(direction[0]), std::fabs(direction[1]), std::fabs(direction[2])});
    for (unsigned k = 0; k < 3; ++k) normal[k] += direction[k] / size;
  };
  for (unsigned v = hull.points; v < hull.vertices; ++v) add(hull.vertex[v]);
  constexpr int most_tries = 64;
  for (int i = 0; i < most_tries; ++i) {
    bool is_found = true;
    for (unsigned v = hull.points; v < hull.vertices; ++v) {
      const float(&direction)[3] = hull.vertex[v];
      double sum = 0;
      double magnitude = 0;
      for (unsigned k = 0; k < 3; ++k) {
        const double term = double{normal[k]} * direction[k];
        sum += term;
        magnitude += std::fabs(term);
      }
      if (sum > 0x1p-40 * magnitude) continue;  // two sums of doubles are rounded; products of floats are not
      is_found = false;
      add(direction);
    }
    if (is_found) return true;
  }
  return false;
}

}  // namespace

SmallHull::SmallHull(const HullData& hull) noexcept : hull_(&hull) {
  VertexSet used = 0;
  if (!are_on_one_side(hull) || !begin(used)) return;
  for (unsigned v = 0; v < hull.vertices; ++v) {
    if ((used & only(v)) == 0) add(v);
  }
}

SmallHull::SmallHull(const HullData& hull, const SmallHull& of_others) noexcept
    : hull_(&hull), count_(of_others.count_) {
  const unsigned last = hull.vertices - 1U;
  std::copy_n(of_others.triangle_, count_, triangle_);
  for (unsigned v = 0; v < last; ++v) {
    std::copy_n(of_others.left_of_[v], last, left_of_[v]);
    std::copy_n(of_others.position_[v], 3, position_[v]);
  }
  double growth = 1;
  for (unsigned k = 0; k < 3; ++k) {
    std::copy_n(of_others.normal_[k], count_, normal_[k]);
    position_[last][k] = step_between(hull, 0, last, k).rounded();
    extent_[k] = std::max(of_others.extent_[k], std::fabs(position_[last][k]));
    growth = std::max(growth, extent_[k] / of_others.extent_[k]);  // with an interior, no extent is 0
  }
  std::copy_n(of_others.offset_, count_, offset_);
  std::copy_n(of_others.cancelled_, count_, cancelled_);
  for (unsigned t = 0; t < count_; ++t) error_[t] = of_others.error_[t] * growth * (1 + 0x1p-40);
  add(last);
}

/// Makes a tetrahedron of four vertices, if they are not all in one plane.
bool SmallHull::begin(VertexSet& used) noexcept {
  const auto place = [](unsigned vertex) { return static_cast<std::uint8_t>(vertex); };
  for (unsigned c = 2; c < hull_->vertices; ++c) {
    const SpannedPlane plane = plane_through(*hull_, {0, 1, place(c)});
    if (plane.normal(0) == 0 && plane.normal(1) == 0 && plane.normal(2) == 0) continue;  // on a line
    for (unsigned d = hull_->vertices - 1U; d > c; --d) {  // a view's first vertices are often in one plane
      const int side = plane.sign_along(
          {step_between(*hull_, 0, d, 0), step_between(*hull_, 0, d, 1), step_between(*hull_, 0, d, 2)});
      if (side == 0) continue;
      take_positions();
      const unsigned p = side > 0 ? c : 1;
      const unsigned q = side > 0 ? 1 : c;
      used = only(0) | only(1) | only(c) | only(d);
      count_ = 4;
      set(0, 0, p, q, used & ~only(d));
      set(1, p, 0, d, used & ~only(q));
      set(2, q, p, d, used & ~only(0));
      set(3, 0, q, d, used & ~only(p));
      return true;
    }
    return false;
  }
  return false;
}

void SmallHull::take_positions() noexcept {
  std::fill_n(extent_, 3, 0.0);
  for (unsigned v = 0; v < hull_->vertices; ++v) {
    for (unsigned k = 0; k < 3; ++k) {
      position_[v][k] = step_between(*hull_, 0, v, k).rounded();
      extent_[k] = std::max(extent_[k], std::fabs(position_[v][k]));
    }
  }
}

/// Puts triangles from the horizon, as seen from a vertex, to the vertex in place of those that are seen from there.
void SmallHull::add(unsigned vertex) noexcept {
  const std::uint64_t seen = seen_from(vertex);
  if (seen == 0) return;
  // The horizon is one ring, which passes each vertex once.
  HorizonEdge horizon[HullData::most_vertices];
  unsigned edges = 0;
  for (std::uint64_t left = seen; left != 0; left &= left - 1) {
    const Triangle& triangle = triangle_[std::countr_zero(left)];
    const auto second = triangle.vertex[triangle.sign > 0 ? 1 : 2];
    const auto third = triangle.vertex[triangle.sign > 0 ? 2 : 1];
    const std::uint8_t corner[4] = {triangle.vertex[0], second, third, triangle.vertex[0]};
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint8_t from = corner[i];
      const std::uint8_t to = corner[i + 1];
      const unsigned across = left_of_[to][from];
      if ((seen >> across & 1U) != 0) continue;
      // If the vertex is in the plane across, it extends that. If not, others in the new plane are on the edge.
      const VertexSet beyond = triangle_[across].in_plane;
      const bool extends = (beyond & only(vertex)) != 0;
      horizon[edges++] = {from, to, extends ? beyond : (beyond & triangle.in_plane) | only(vertex)};
    }
  }
  std::uint64_t free = seen;
  for (unsigned i = 0; i < edges; ++i) {
    const unsigned t = free != 0 ? static_cast<unsigned>(std::countr_zero(free)) : count_++;
    free &= free - 1;
    set(t, horizon[i].from, horizon[i].to, vertex, horizon[i].in_plane);
  }
  for (; free != 0; free &= ~(std::uint64_t{1} << (std::bit_width(free) - 1))) {  // last first
    remove(static_cast<unsigned>(std::bit_width(free) - 1));
  }
}

/// The triangles that a vertex is in front of. Those that have it in their planes are told so.
std::uint64_t SmallHull::seen_from(unsigned vertex) noexcept {
  const double(&x)[3] = position_[vertex];
  const double share = vertex < hull_->points ? 1 : 0;
  double height[most_triangles];
  for (unsigned t = 0; t < count_; ++t) {
    height[t] = normal_[0][t] * x[0] + normal_[1][t] * x[1] + normal_[2][t] * x[2] - share * offset_[t];
  }
  std::uint64_t seen = 0;
  for (unsigned t = 0; t < count_; ++t) {
    bool is_seen = height[t] > 0;
    if (!(std::fabs(height[t]) > error_[t])) {
      const int side = exact_side(t, vertex);
      is_seen = side > 0;
      if (side == 0) triangle_[t].in_plane |= only(vertex);
    }
    seen |= std::uint64_t{is_seen} << t;
  }
  return seen;
}

int SmallHull::exact_side(unsigned t, unsigned vertex) const noexcept {
  const Triangle& triangle = triangle_[t];
  const unsigned from = triangle.vertex[0];
  return triangle.sign * plane_through(*hull_, triangle.vertex)
                             .sign_along({step_between(*hull_, from, vertex, 0), step_between(*hull_, from, vertex, 1),
                                          step_between(*hull_, from, vertex, 2)});
}

/// Writes a triangle. Its vertices are counterclockwise as seen from outside.
void SmallHull::set(unsigned t, unsigned a, unsigned b, unsigned c, VertexSet in_plane) noexcept {
  left_of_[a][b] = left_of_[b][c] = left_of_[c][a] = static_cast<std::uint8_t>(t);
  double sign = 1;
  const auto order = [&](unsigned& less, unsigned& more) {  // two that change places turn the normal round
    const bool is_swapped = less > more;
    const unsigned least = std::min(less, more);
    more = std::max(less, more);
    less = least;
    sign = is_swapped ? -sign : sign;
  };
  order(a, b);
  order(b, c);
  order(a, b);
  triangle_[t] = {{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(c)},
                  static_cast<std::int8_t>(sign),
                  in_plane};
  if (a >= hull_->points) {  // all points are behind for certain, and directions are not in front
    for (auto& component : normal_) component[t] = 0;
    offset_[t] = 1;
    error_[t] = -1;
    return;
  }
  double u[3];
  double v[3];
  for (unsigned k = 0; k < 3; ++k) {
    u[k] = step_between(*hull_, a, b, k).rounded();
    v[k] = step_between(*hull_, a, c, k).rounded();
  }
  double offset = 0;
  double error = 0;
  unsigned cancelled = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const unsigned i = k == 2 ? 0 : k + 1;
    const unsigned j = k == 0 ? 2 : k - 1;
    const double left = u[i] * v[j];
    const double right = u[j] * v[i];
    const double normal = left - right;
    const double size = std::fabs(left) + std::fabs(right);
    normal_[k][t] = sign * normal;
    cancelled |= static_cast<unsigned>(!is_well_rounded(normal, size)) << k;
    offset += normal * position_[a][k];
    error += size * extent_[k];
  }
  offset_[t] = sign * offset;
  // Up to the product with a coordinate, a term rounds 6 times; sums and the difference make it 9, and the offset too.
  error_[t] = 0x1p-48 * error;
  cancelled_[t] = static_cast<std::uint8_t>(cancelled);
}

/// Puts the last triangle in the place of one that is gone.
void SmallHull::remove(unsigned t) noexcept {
  const unsigned last = --count_;
  if (t == last) return;
  triangle_[t] = triangle_[last];
  for (auto& component : normal_) component[t] = component[last];
  offset_[t] = offset_[last];
  error_[t] = error_[last];
  cancelled_[t] = cancelled_[last];
  const Triangle& moved = triangle_[t];
  for (unsigned i = 0; i < 3; ++i) left_of_[moved.corner(i)][moved.corner((i + 1) % 3)] = static_cast<std::uint8_t>(t);
}

}  // namespace shaftcull::kernel
