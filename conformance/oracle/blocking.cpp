// SPDX-License-Identifier: MIT
#include "oracle/blocking.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace shaftcull::oracle {
namespace {

/// `steps` + 1 points on each axis of a box, or one where it is flat.
std::vector<RationalPoint> points_of(const Box& box, unsigned steps) {
  std::array<std::vector<mpq_class>, 3> on_axis;
  for (std::size_t k = 0; k != 3; ++k) {
    const mpq_class lo(box.lo[k]);
    const mpq_class hi(box.hi[k]);
    for (unsigned i = 0; i <= (lo == hi ? 0 : steps); ++i) on_axis[k].push_back(lo + (hi - lo) * i / steps);
  }
  std::vector<RationalPoint> points;
  for (const mpq_class& x : on_axis[0]) {
    for (const mpq_class& y : on_axis[1]) {
      for (const mpq_class& z : on_axis[2]) points.push_back({x, y, z});
    }
  }
  return points;
}

RationalPoint difference(const RationalPoint& p, const RationalPoint& q) {
  return {mpq_class(p[0] - q[0]), mpq_class(p[1] - q[1]), mpq_class(p[2] - q[2])};
}
RationalPoint cross(const RationalPoint& p, const RationalPoint& q) {
  return {mpq_class(p[1] * q[2] - p[2] * q[1]), mpq_class(p[2] * q[0] - p[0] * q[2]),
          mpq_class(p[0] * q[1] - p[1] * q[0])};
}
mpq_class dot(const RationalPoint& p, const RationalPoint& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

}  // namespace

bool passes_through(const RationalPoint& from, const RationalPoint& to, const std::vector<RationalPoint>& polygon) {
  RationalPoint normal = {0, 0, 0};  // twice the area long
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const RationalPoint part = cross(difference(polygon[i - 1], polygon[0]), difference(polygon[i], polygon[0]));
    for (std::size_t k = 0; k != 3; ++k) normal[k] += part[k];
  }
  const mpq_class before = dot(normal, difference(from, polygon[0]));
  const mpq_class after = dot(normal, difference(to, polygon[0]));
  if (sgn(before) * sgn(after) != -1) return false;
  const mpq_class t = before / (before - after);
  RationalPoint at;
  for (std::size_t k = 0; k != 3; ++k) at[k] = from[k] + t * (to[k] - from[k]);
  for (std::size_t i = 0; i != polygon.size(); ++i) {
    const RationalPoint& corner = polygon[i];
    const RationalPoint& next = polygon[(i + 1) % polygon.size()];
    if (corner != next && dot(cross(difference(next, corner), difference(at, corner)), normal) <= 0) return false;
  }
  return true;
}

bool blocks(const Box& a, const Box& b, const std::vector<Vec3>& polygon, unsigned steps) {
  std::vector<RationalPoint> corners;
  for (const Vec3& corner : polygon)
    corners.push_back({mpq_class(corner[0]), mpq_class(corner[1]), mpq_class(corner[2])});
  const std::vector<RationalPoint> ends = points_of(b, steps);
  for (const RationalPoint& from : points_of(a, steps)) {
    for (const RationalPoint& to : ends) {
      if (!passes_through(from, to, corners)) return false;
    }
  }
  return true;
}

bool passes_through(const RationalPoint& from, const RationalPoint& to, const Box& box) {
  // Those t for which from + t (to − from) is in the relative interior of both: an open interval, and maybe only one of
  // its numbers.
  mpq_class after = 0;
  mpq_class before = 1;
  std::optional<mpq_class> only;
  for (std::size_t k = 0; k != 3; ++k) {
    const float lo = box.lo[k];
    const float hi = box.hi[k];
    if (!(lo <= hi)) return false;
    if (lo == hi) {
      if (std::isinf(lo)) return false;
      if (from[k] == to[k]) {
        if (from[k] != mpq_class(lo)) return false;
        continue;
      }
      const mpq_class t = (mpq_class(lo) - from[k]) / (to[k] - from[k]);
      if (only && *only != t) return false;
      only = t;
      continue;
    }
    for (const float face : {lo, hi}) {
      const bool is_above = face == lo;  // the face, or the interior seen from it
      if (std::isinf(face)) {
        if ((face > 0) == is_above) return false;
        continue;
      }
      // from + t travel > face for the lo face, < for the hi face
      const mpq_class travel = is_above ? mpq_class(to[k] - from[k]) : mpq_class(from[k] - to[k]);
      const mpq_class way = is_above ? mpq_class(mpq_class(face) - from[k]) : mpq_class(from[k] - mpq_class(face));
      if (travel == 0) {
        if (way >= 0) return false;
      } else if (const mpq_class t = way / travel; travel > 0) {
        if (t > after) after = t;
      } else {
        if (t < before) before = t;
      }
    }
  }
  return only ? after < *only && *only < before : after < before;
}

bool blocks_samples(const Box& a, const Box& b, const Box& box, unsigned steps) {
  const std::vector<RationalPoint> ends = points_of(b, steps);
  for (const RationalPoint& from : points_of(a, steps)) {
    for (const RationalPoint& to : ends) {
      if (!passes_through(from, to, box)) return false;
    }
  }
  return true;
}

bool blocks(const Box& a, const Box& b, const Box& box) { return blocks_samples(a, b, box, 1); }

}  // namespace shaftcull::oracle
