// SPDX-License-Identifier: MIT
#include "oracle/blocking.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace shaftcull::oracle {
namespace {

/// A power of 2 that is as good as infinitely small where polynomials in it have coefficients of degree `degree` in
/// coordinates. These and their differences are multiples of 2⁻¹⁴⁹ below 2¹²⁹, so coefficients that are not 0 are in
/// proportion 2^(278 · degree) at most, but for the number of terms, which is below 2⁵⁰.
mpq_class tiny(unsigned degree) { return mpq_class(mpz_class(1), mpz_class(mpz_class(1) << (278 * degree + 50))); }

/// A segment passes a box by comparisons of quotients, and a polygon by (q − p) × (r − p) · n, where r is linear in the
/// quotient of two products (n, p) and n has degree 2.
const mpq_class tiny_for_boxes = tiny(2);
const mpq_class tiny_for_polygons = tiny(8);

/// Points of an end, and the same moved a tiny part of their way towards its middle: into the relative interior.
struct EndPoints {
  std::vector<RationalPoint> points;
  std::vector<RationalPoint> inner;

  EndPoints(std::vector<RationalPoint> of, const RationalPoint& middle, const mpq_class& part)
      : points(std::move(of)), inner(points) {
    for (RationalPoint& point : inner) {
      for (std::size_t k = 0; k != 3; ++k) point[k] += part * (middle[k] - point[k]);
    }
  }
};

RationalPoint rational(const Vec3& p) { return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])}; }

std::vector<RationalPoint> rational(const std::vector<Vec3>& points) {
  std::vector<RationalPoint> result;
  for (const Vec3& point : points) result.push_back(rational(point));
  return result;
}

/// `steps` + 1 points on each axis of a box, or one where it is flat.
EndPoints points_of(const Box& box, unsigned steps, const mpq_class& part) {
  std::array<std::vector<mpq_class>, 3> on_axis;
  RationalPoint middle;
  for (std::size_t k = 0; k != 3; ++k) {
    const mpq_class lo(box.lo[k]);
    const mpq_class hi(box.hi[k]);
    middle[k] = (lo + hi) / 2;
    for (unsigned i = 0; i <= (lo == hi ? 0 : steps); ++i) on_axis[k].push_back(lo + (hi - lo) * i / steps);
  }
  std::vector<RationalPoint> points;
  for (const mpq_class& x : on_axis[0]) {
    for (const mpq_class& y : on_axis[1]) {
      for (const mpq_class& z : on_axis[2]) points.push_back({x, y, z});
    }
  }
  return {std::move(points), middle, part};
}

/// The corners of a polygon or the like.
EndPoints points_of(const std::vector<Vec3>& corners, const mpq_class& part) {
  RationalPoint mean = {0, 0, 0};
  for (const Vec3& corner : corners) {
    for (std::size_t k = 0; k != 3; ++k) mean[k] += mpq_class(corner[k]) / static_cast<unsigned>(corners.size());
  }
  return {rational(corners), mean, part};
}

/// Whether all segments between inner points pass. If `is_open`, points near those of a segment that passes have
/// segments that pass: so most are seen to pass by their short numbers.
template <class Passes>
bool all_segments(const EndPoints& a, const EndPoints& b, bool is_open, const Passes& passes) {
  for (std::size_t i = 0; i != a.points.size(); ++i) {
    for (std::size_t j = 0; j != b.points.size(); ++j) {
      if (is_open && passes(a.points[i], b.points[j])) continue;
      if (!passes(a.inner[i], b.inner[j])) return false;
    }
  }
  return true;
}

bool all_segments(const EndPoints& a, const EndPoints& b, const Box& box) {
  int flat_axes = 0;
  for (std::size_t k = 0; k != 3; ++k) flat_axes += box.lo[k] == box.hi[k] ? 1 : 0;
  return all_segments(a, b, flat_axes == 0, [&](const RationalPoint& from, const RationalPoint& to) {
    return passes_through(from, to, box);
  });
}

bool all_segments(const EndPoints& a, const EndPoints& b, const std::vector<Vec3>& polygon) {
  return all_segments(a, b, true, [corners = rational(polygon)](const RationalPoint& from, const RationalPoint& to) {
    return passes_through(from, to, corners);
  });
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
  return all_segments(points_of(a, steps, tiny_for_polygons), points_of(b, steps, tiny_for_polygons), polygon);
}

bool blocks(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<Vec3>& polygon) {
  return all_segments(points_of(a, tiny_for_polygons), points_of(b, tiny_for_polygons), polygon);
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
  return all_segments(points_of(a, steps, tiny_for_boxes), points_of(b, steps, tiny_for_boxes), box);
}

bool blocks(const Box& a, const Box& b, const Box& box) { return blocks_samples(a, b, box, 1); }

bool blocks(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Box& box) {
  return all_segments(points_of(a, tiny_for_boxes), points_of(b, tiny_for_boxes), box);
}

}  // namespace shaftcull::oracle
