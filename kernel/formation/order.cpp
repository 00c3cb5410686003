// SPDX-License-Identifier: MIT
#include "formation/order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "formation/rule.hpp"
#include "formation/trimmed_box.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"

namespace shaftcull {
namespace kernel {
namespace {

/// Volumes, as fractions of the shaft box, that differ by less are the same but for rounding.
constexpr double same_volume = 1e-12;

/// The cut of the shaft box by the joining plane of faces `red` and `blue`, with the box scaled to a cube. Of flat
/// boxes this is the limit of boxes ever flatter: what counts is then the area.
CornerCut corner_cut(const Faces6& a, const Faces6& b, const JoiningPlane& plane) noexcept {
  const auto leg = [&](Face f) {
    const unsigned axis = axis_of(f);
    const double extent = double{std::max(a[axis + 3], b[axis + 3])} - double{std::min(a[axis], b[axis])};
    return std::fabs(double{b[f]} - double{a[f]}) / extent;  // an extent of 0 has no red or blue faces
  };
  return {plane.red, plane.blue, leg(plane.red), leg(plane.blue)};
}

/// A plane, and how much it would cut off at most.
struct Candidate {
  JoiningPlane plane;
  CornerCut cut;
  double volume;
  bool is_exact;  ///< volume is what it cuts off beyond the planes chosen so far, not an upper bound
};

using Candidates = std::array<Candidate, max_joining_planes>;

/// The candidate of most volume, the first of several such.
Candidate* largest(Candidate* begin, Candidate* end) noexcept {
  Candidate* best = begin;
  for (Candidate* candidate = begin; candidate != end; ++candidate) {
    if (candidate->volume > best->volume + same_volume) best = candidate;
  }
  return best;
}

/// Greedy choice. What a plane adds only shrinks as others are chosen, so its last known volume is an upper bound, and
/// one that is still the largest of all bounds when computed anew is the plane to choose.
void choose_greedily(Candidate* next, Candidate* end) noexcept {
  TrimmedBox left;
  for (; next != end; ++next) {
    Candidate* best = largest(next, end);
    while (!best->is_exact) {
      best->volume = left.volume_beyond(best->cut);
      best->is_exact = true;
      best = largest(next, end);
    }
    left.trim(best->cut);
    std::rotate(next, best, best + 1);
    for (Candidate* later = next + 1; later != end; ++later) later->is_exact = false;
  }
}

/// The fraction of `length` that lies beyond `size`, squared: the part of a triangle's area that is out of the box.
double beyond_squared(double size, double length) noexcept {
  const double excess = std::max(0.0, 1 - size / length);
  return excess * excess;
}

}  // namespace

void sort_planes(const Box& a, const Box& b, PlaneOrder order, std::span<JoiningPlane> planes) noexcept {
  if (order == PlaneOrder::unsorted || planes.size() < 2) return;
  const Faces6 a_faces = positions(a);
  const Faces6 b_faces = positions(b);
  Candidates candidates;
  Candidate* const begin = candidates.data();
  Candidate* end = begin;
  for (const JoiningPlane& plane : planes) {
    const CornerCut cut = corner_cut(a_faces, b_faces, plane);
    *end++ = {plane, cut, cut.volume(), true};
  }
  if (order == PlaneOrder::by_added_volume) {
    choose_greedily(begin, end);
  } else {
    for (Candidate* next = begin; next != end; ++next) {
      Candidate* const best = largest(next, end);
      std::rotate(next, best, best + 1);
    }
  }
  std::transform(begin, end, planes.begin(), [](const Candidate& candidate) { return candidate.plane; });
}

}  // namespace kernel

namespace {

double volume_beyond(const Box& box, const JoiningPlane& plane) noexcept {
  const kernel::Faces6 faces = kernel::positions(box);
  const unsigned i = kernel::axis_of(plane.red);
  const unsigned j = kernel::axis_of(plane.blue);
  const unsigned k = 3 - i - j;
  const auto extent = [&](unsigned axis) { return double{box.hi[axis]} - double{box.lo[axis]}; };
  const double red_normal = plane.plane.normal[i];
  const double blue_normal = plane.plane.normal[j];
  const double beyond = red_normal * faces[plane.red] + blue_normal * faces[plane.blue] - double{plane.plane.offset};
  if (!(beyond > 0)) return 0;

  // Legs of the triangle that the plane cuts off the corner, and of it what lies within the box.
  const double width = extent(i);
  const double height = extent(j);
  const double red_leg = beyond / std::fabs(red_normal);
  const double blue_leg = beyond / std::fabs(blue_normal);
  if (std::isinf(red_leg)) return width * std::min(blue_leg, height) * extent(k);
  if (std::isinf(blue_leg)) return height * std::min(red_leg, width) * extent(k);
  const double both = std::max(0.0, 1 - width / red_leg - height / blue_leg);
  const double within =
      1 - kernel::beyond_squared(width, red_leg) - kernel::beyond_squared(height, blue_leg) + both * both;
  return red_leg * blue_leg / 2 * within * extent(k);
}

}  // namespace

double culled_volume(const Box& box, const JoiningPlane& plane) {
  if (plane.red >= kernel::face_count || plane.blue >= kernel::face_count ||
      kernel::axis_of(plane.red) == kernel::axis_of(plane.blue)) {
    kernel::fail(InvalidArgument("culled_volume: faces red = " + std::to_string(plane.red) +
                                 " and blue = " + std::to_string(plane.blue) +
                                 " do not meet in an edge; faces are 0 to 5, and f and f + 3 opposite"));
  }
  return kernel::in_float_environment([&] { return volume_beyond(box, plane); });
}

}  // namespace shaftcull
