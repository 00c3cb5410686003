// SPDX-License-Identifier: MIT
#include "exact/convex_hull.hpp"

#include <cmath>

#include "exact/expansion.hpp"
#include "exact/hull_planes.hpp"
#include "shaftcull/compiled.hpp"

namespace shaftcull::kernel {
namespace {

using HullPlane = HullData::Plane;

/// The axes that the coordinates of a plane are on: all three of a face, two of an edge.
struct Axes {
  unsigned count;
  unsigned axis[3];

  Axes(const HullData& hull, unsigned plane) noexcept {
    if (plane < hull.faces) {
      count = 3;
      for (unsigned k = 0; k < 3; ++k) axis[k] = k;
    } else {
      count = 2;
      axis[0] = (hull.plane[plane].axis + 1U) % 3;
      axis[1] = (hull.plane[plane].axis + 2U) % 3;
    }
  }
};

/// Sign of the value of a plane at the corner of a box whose coordinate i is at stream[i].
int corner_side(const HullData& hull, unsigned number, const float (&bound)[6],
                const std::uint8_t (&stream)[3]) noexcept {
  const HullPlane& plane = hull.plane[number];
  if (number < hull.faces) {
    return plane.sign *
           plane_through(hull, plane.vertices).side({bound[stream[0]], bound[stream[1]], bound[stream[2]]});
  }
  const ProjectedLine line(hull, plane.axis, plane.vertices[0], plane.vertices[1]);
  return plane.sign * line.side(bound[stream[0]], bound[stream[1]]);
}

/// A plane's value at a point and the length of its normal, in doubles, and a bound on what they are off by.
struct Measure {
  double value = 0;
  double length = 0;
  double error = 0;
};

Measure measure(const HullData& hull, unsigned number, const float (&point)[4]) noexcept {
  const HullPlane& plane = hull.plane[number];
  const Axes axes(hull, number);
  double normal[3];
  if (number < hull.faces) {
    const SpannedPlane spanned = plane_through(hull, plane.vertices);
    for (unsigned k = 0; k < 3; ++k) normal[k] = spanned.normal(k);
  } else {
    const ProjectedLine line(hull, plane.axis, plane.vertices[0], plane.vertices[1]);
    normal[0] = line.along[1].rounded();
    normal[1] = -line.along[0].rounded();
  }
  Measure result;
  double square = 0;
  double magnitude = 0;
  for (unsigned i = 0; i < axes.count; ++i) {
    const double p = hull.vertex[plane.vertices[0]][axes.axis[i]];
    const double x = point[axes.axis[i]];
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): there are as many as axes.count
    result.value += plane.sign * normal[i] * (x - p);
    magnitude += std::fabs(normal[i]) * (std::fabs(x) + std::fabs(p));
    square += normal[i] * normal[i];
  }
  // Normals are off by 2⁻³⁰ of themselves at most where they were nearly cancelled; all else by less.
  result.error = 0x1p-28 * magnitude;
  result.length = std::sqrt(square);
  return result;
}

/// `x` − `face` compared with `radius`, exactly: the rounded difference of two floats in a double, if it is not equal
/// to a float, is on the same side of it as the exact one.
int compare_distance(double x, double face, double radius) noexcept {
  if (std::isinf(face)) return face > 0 ? -1 : 1;
  const TwoTerms distance = two_sum(x, -face);
  if (distance.sum != radius) return distance.sum > radius ? 1 : -1;
  return distance.error > 0 ? 1 : distance.error < 0 ? -1 : 0;
}

/// The smallest box around a sphere, in floats. Every node of a tree that holds the sphere holds this box, so a sphere
/// is answered alone as the node is.
struct BoxAround {
  float face[6];

  explicit BoxAround(const float (&sphere)[4]) noexcept {
    for (unsigned k = 0; k < 3; ++k) {
      face[k] = sum_rounded_down(sphere[k], -sphere[3]);
      face[k + 3] = sum_rounded_up(sphere[k], sphere[3]);
    }
  }
};

/// The streams that hold the coordinates of a plane's far corner.
struct FarCorner {
  std::uint8_t stream[3] = {};

  FarCorner(const HullPlane& plane, unsigned coordinates) noexcept {
    for (unsigned i = 0; i < coordinates; ++i) {
      stream[i] = static_cast<std::uint8_t>(plane.near[i] < 3 ? plane.near[i] + 3 : plane.near[i] - 3);
    }
  }
};

/// Whether a plane holds both the hull and a box that has its near corner in it.
bool holds_both(const HullData& hull, unsigned number, const float (&bound)[6]) noexcept {
  const unsigned coordinates = Axes(hull, number).count;
  const FarCorner far(hull.plane[number], coordinates);
  for (unsigned i = 0; i < coordinates; ++i) {
    if (!std::isfinite(bound[far.stream[i]])) return false;
  }
  return corner_side(hull, number, bound, far.stream) == 0 && plane_holds_hull(hull, number);
}

/// Whether one of the planes [first, last) parts a box from the hull: has the box beyond it, or with open contact on
/// it, unless it holds both.
template <Contact contact>
bool is_parted_by_any(const HullData& hull, unsigned first, unsigned last, const float (&bound)[6]) noexcept {
  for (unsigned number = first; number < last; ++number) {
    const HullPlane& plane = hull.plane[number];
    bool is_bounded = true;  // an infinite extent leads behind the plane, and a NaN says nothing
    for (unsigned i = 0; i < Axes(hull, number).count; ++i) is_bounded &= std::isfinite(bound[plane.near[i]]);
    if (!is_bounded) continue;
    const int side = corner_side(hull, number, bound, plane.near);
    if (side > 0) return true;
    if constexpr (contact == Contact::open) {
      if (side == 0 && !holds_both(hull, number, bound)) return true;
    }
  }
  return false;
}

/// Likewise a face of the hull's box.
template <Contact contact>
bool is_parted_by_box(const HullData& hull, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    const float lo = hull.box[k];
    const float hi = hull.box[k + 3];
    if (bound[k + 3] < lo || bound[k] > hi) return true;
    if constexpr (contact == Contact::open) {
      const bool touches = (bound[k + 3] == lo && std::isfinite(lo)) || (bound[k] == hi && std::isfinite(hi));
      if (touches && !(lo == hi && bound[k] == bound[k + 3])) return true;
    }
  }
  return false;
}

bool is_empty(const float (&bound)[6]) noexcept {
  return bound[0] > bound[3] || bound[1] > bound[4] || bound[2] > bound[5];
}

/// Whether a box and the hull, or with open contact their relative interiors, have no point in common.
template <Contact contact>
bool box_misses_hull(const HullData& hull, const float (&bound)[6]) noexcept {
  return is_empty(bound) || is_parted_by_box<contact>(hull, bound) ||
         is_parted_by_any<contact>(hull, 0, hull.faces + hull.edges, bound);
}

template <Contact contact>
bool is_box_outside(const HullData& hull, const float (&bound)[6]) noexcept {
  if (!hull.is_conservative) return box_misses_hull<contact>(hull, bound);
  return is_empty(bound) || (hull.culls_by_box && is_parted_by_box<contact>(hull, bound)) ||
         is_parted_by_any<contact>(hull, 0, hull.apart, bound) ||
         is_parted_by_any<contact>(hull, hull.faces, hull.faces + hull.face_edges, bound);
}

/// Whether a box is behind all planes of the hull, in none if `most` is −1; some may hold it if `most` is 0.
bool is_behind_all(const HullData& hull, const float (&bound)[6], int most) noexcept {
  for (unsigned number = 0; number < hull.faces + hull.edges; ++number) {
    const unsigned coordinates = Axes(hull, number).count;
    const FarCorner far(hull.plane[number], coordinates);
    for (unsigned i = 0; i < coordinates; ++i) {
      if (!std::isfinite(bound[far.stream[i]])) return false;
    }
    if (corner_side(hull, number, bound, far.stream) > most) return false;
  }
  return true;
}

template <Contact contact>
bool is_sphere_outside(const HullData& hull, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (std::isnan(radius)) return false;
  if (radius < 0) return true;
  // A sphere without a radius is a box.
  const int least = contact == Contact::open && radius > 0 ? 0 : 1;
  for (unsigned k = 0; k < 3; ++k) {
    const double c = sphere[k];
    if (std::isnan(c)) continue;
    if (std::isinf(c)) {
      const double face = c < 0 ? hull.box[k] : hull.box[k + 3];
      if (std::isfinite(face) && std::isfinite(radius)) return true;
      continue;
    }
    if (std::isinf(radius)) continue;
    if (compare_distance(-c, -static_cast<double>(hull.box[k]), radius) >= least ||
        compare_distance(c, hull.box[k + 3], radius) >= least) {
      return true;
    }
  }
  if (std::isinf(radius)) return false;
  if (std::isfinite(sphere[0]) && std::isfinite(sphere[1]) && std::isfinite(sphere[2]) &&
      box_misses_hull<contact>(hull, BoxAround(sphere).face)) {
    return true;
  }
  for (unsigned number = 0; number < hull.faces + hull.edges; ++number) {
    const Axes axes(hull, number);
    bool is_bounded = true;
    for (unsigned i = 0; i < axes.count; ++i) is_bounded &= std::isfinite(sphere[axes.axis[i]]);
    if (!is_bounded) continue;
    const Measure plane = measure(hull, number, sphere);
    if (plane.value > radius * plane.length * (1 + 0x1p-28) + plane.error) return true;
  }
  return false;
}

}  // namespace

SpannedPlane plane_through(const HullData& hull, const std::uint8_t (&vertices)[3]) noexcept {
  double point[3];
  Step u[3];
  Step v[3];
  for (unsigned k = 0; k < 3; ++k) {
    point[k] = hull.vertex[vertices[0]][k];
    u[k] = step_between(hull, vertices[0], vertices[1], k);
    v[k] = step_between(hull, vertices[0], vertices[2], k);
  }
  return {point, u, v};
}

bool plane_holds_hull(const HullData& hull, unsigned number) noexcept {
  const HullPlane& plane = hull.plane[number];
  if (number >= hull.faces) {
    const ProjectedLine line(hull, plane.axis, plane.vertices[0], plane.vertices[1]);
    for (unsigned v = 0; v < hull.vertices; ++v) {
      if (line.side_of(hull, v) != 0) return false;
    }
    return true;
  }
  const SpannedPlane face = plane_through(hull, plane.vertices);
  const unsigned p = plane.vertices[0];
  for (unsigned v = 0; v < hull.vertices; ++v) {
    const Step to[3] = {step_between(hull, p, v, 0), step_between(hull, p, v, 1), step_between(hull, p, v, 2)};
    if (face.sign_along(to) != 0) return false;
  }
  return true;
}

bool hull_box_outside(const HullData& hull, const float (&bound)[6]) noexcept {
  return is_box_outside<Contact::closed>(hull, bound);
}

bool hull_box_outside_openly(const HullData& hull, const float (&bound)[6]) noexcept {
  return is_box_outside<Contact::open>(hull, bound);
}

bool hull_box_inside(const HullData& hull, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (!(bound[k] <= bound[k + 3] && bound[k] >= hull.box[k] && bound[k + 3] <= hull.box[k + 3])) return false;
  }
  return is_behind_all(hull, bound, 0);
}

bool hull_box_strictly_inside(const HullData& hull, const float (&bound)[6]) noexcept {
  for (unsigned k = 0; k < 3; ++k) {
    if (!(bound[k] > hull.box[k] && bound[k + 3] < hull.box[k + 3])) return false;
  }
  return is_behind_all(hull, bound, -1);
}

bool hull_sphere_outside(const HullData& hull, const float (&sphere)[4]) noexcept {
  return is_sphere_outside<Contact::closed>(hull, sphere);
}

bool hull_sphere_outside_openly(const HullData& hull, const float (&sphere)[4]) noexcept {
  return is_sphere_outside<Contact::open>(hull, sphere);
}

bool hull_sphere_inside(const HullData& hull, const float (&sphere)[4]) noexcept {
  const double radius = sphere[3];
  if (!(radius >= 0) || std::isinf(radius)) return false;
  for (unsigned k = 0; k < 3; ++k) {
    const double c = sphere[k];
    if (!std::isfinite(c)) return false;
    if (compare_distance(c, hull.box[k], radius) < 0 || compare_distance(hull.box[k + 3], c, radius) < 0) return false;
  }
  if (hull_box_inside(hull, BoxAround(sphere).face)) return true;
  for (unsigned number = 0; number < hull.faces + hull.edges; ++number) {
    const Measure plane = measure(hull, number, sphere);
    if (!(plane.value + radius * plane.length * (1 + 0x1p-28) + plane.error <= 0)) return false;
  }
  return true;
}

}  // namespace shaftcull::kernel
