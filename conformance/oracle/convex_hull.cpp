// SPDX-License-Identifier: MIT
#include "oracle/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "oracle/shaft_input.hpp"

namespace shaftcull {

std::string source_text(const HullInput& input) {
  const auto list = [](const std::vector<Vec3>& vectors) {
    std::string text = "{";
    for (const Vec3& v : vectors) {
      if (text.size() != 1) text += ", ";
      text += source_text(v);
    }
    return text + "}";
  };
  const char* const contact = input.contact == Contact::open ? ", Contact::open" : ", Contact::closed";
  return "HullInput{" + list(input.points) + ", " + list(input.directions) + contact + ", " +
         std::to_string(input.first_end) + "}";
}

namespace oracle {
namespace {

using Vector = std::array<mpq_class, 3>;

Vector vector(const Vec3& v) { return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])}; }

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vector unit(std::size_t axis) {
  Vector v{};
  v[axis] = 1;
  return v;
}

}  // namespace

ConvexHull::ConvexHull(std::span<const Vec3> points, std::span<const Vec3> directions) {
  for (const Vec3& p : points) {
    if (std::find(points_.begin(), points_.end(), vector(p)) == points_.end()) points_.push_back(vector(p));
    for (std::size_t k = 0; k != 3; ++k) largest_[k] = std::max(largest_[k], mpq_class(abs(points_.back()[k])));
  }
  for (const Vec3& d : directions) directions_.push_back(vector(d));
  std::vector<Vector> along;  // all ways along which a face or an edge may lead
  for (std::size_t i = 0; i != points_.size(); ++i) {
    along = directions_;
    for (std::size_t j = i + 1; j != points_.size(); ++j) along.push_back(minus(points_[j], points_[i]));
    for (std::size_t u = 0; u != along.size(); ++u) {
      for (std::size_t axis = 0; axis != 3; ++axis) add_planes(cross(along[u], unit(axis)), &points_[i]);
      for (std::size_t v = u + 1; v != along.size(); ++v) add_planes(cross(along[u], along[v]), &points_[i]);
    }
  }
  for (std::size_t axis = 0; axis != 3; ++axis) add_planes(unit(axis), nullptr);
}

void ConvexHull::add_planes(const Vector& normal, const Vector* through) {
  if (normal == Vector{}) return;
  for (const int sign : {1, -1}) {
    Plane plane{{sign * normal[0], sign * normal[1], sign * normal[2]}, 0, true};
    const bool is_bounded =
        std::all_of(directions_.begin(), directions_.end(), [&](const Vector& d) { return dot(plane.normal, d) <= 0; });
    if (!is_bounded) continue;
    plane.offset = dot(plane.normal, points_[0]);
    for (const Vector& p : points_) plane.offset = std::max(plane.offset, dot(plane.normal, p));
    plane.is_spanned = through == nullptr || dot(plane.normal, *through) == plane.offset;
    planes_.push_back(std::move(plane));
  }
}

Answer ConvexHull::answer(const Box& box) const {
  bool inside = true;
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) return Answer::outside;
  }
  for (const Plane& plane : planes_) {
    mpq_class least = -plane.offset;
    mpq_class greatest = -plane.offset;
    bool has_least = true;
    bool has_greatest = true;
    for (std::size_t k = 0; k != 3; ++k) {
      const int slope = sgn(plane.normal[k]);
      if (slope == 0) continue;
      const float near = slope > 0 ? box.lo[k] : box.hi[k];
      const float far = slope > 0 ? box.hi[k] : box.lo[k];
      has_least = has_least && std::isfinite(near);
      has_greatest = has_greatest && std::isfinite(far);
      if (has_least) least += plane.normal[k] * mpq_class(near);
      if (has_greatest) greatest += plane.normal[k] * mpq_class(far);
    }
    if (has_least && sgn(least) > 0) return Answer::outside;
    inside = inside && has_greatest && sgn(greatest) <= 0;
  }
  return inside ? Answer::inside : Answer::overlap;
}

bool ConvexHull::misses(const Triangle& triangle) const {
  const Vector corner[3] = {vector(triangle.vertex[0]), vector(triangle.vertex[1]), vector(triangle.vertex[2])};
  const auto least_of = [&](const Vector& normal) {
    return std::min({dot(normal, corner[0]), dot(normal, corner[1]), dot(normal, corner[2])});
  };
  for (const Plane& plane : planes_) {
    if (least_of(plane.normal) > plane.offset) return true;
  }
  const auto parts = [&](const Vector& normal) {
    if (normal == Vector{}) return false;
    for (const int sign : {1, -1}) {
      const Vector outward{sign * normal[0], sign * normal[1], sign * normal[2]};
      const bool is_bounded =
          std::all_of(directions_.begin(), directions_.end(), [&](const Vector& d) { return dot(outward, d) <= 0; });
      if (!is_bounded) continue;
      const mpq_class least = least_of(outward);
      const auto is_below = [&](const Vector& p) { return dot(outward, p) < least; };
      if (std::all_of(points_.begin(), points_.end(), is_below)) return true;
    }
    return false;
  };
  std::vector<Vector> along = directions_;
  for (std::size_t axis = 0; axis != 3; ++axis) along.push_back(unit(axis));
  for (std::size_t i = 0; i != points_.size(); ++i) {
    for (std::size_t j = i + 1; j != points_.size(); ++j) along.push_back(minus(points_[j], points_[i]));
  }
  for (std::size_t e = 0; e != 3; ++e) {
    const Vector edge = minus(corner[(e + 1) % 3], corner[e]);
    for (const Vector& other : along) {
      if (parts(cross(edge, other))) return true;
    }
  }
  return parts(cross(minus(corner[1], corner[0]), minus(corner[2], corner[0])));
}

bool ConvexHull::is_beyond(const Sphere& sphere, double slack, Contact contact) const {
  const Vector centre = vector(sphere.centre);
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    if (!plane.is_spanned) return false;
    mpq_class terms = 0;
    for (std::size_t k = 0; k != 3; ++k) terms += abs(plane.normal[k]) * (abs(centre[k]) + largest_[k]);
    const mpq_class value = dot(plane.normal, centre) - plane.offset - slack * terms;
    const mpq_class radius = mpq_class(sphere.radius) * (1 + slack);
    const mpq_class reach = radius * radius * dot(plane.normal, plane.normal);
    return sgn(value) > 0 && (value * value > reach || (contact == Contact::open && value * value == reach));
  });
}

bool ConvexHull::is_within(const Sphere& sphere, double slack) const {
  const Vector centre = vector(sphere.centre);
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    if (!plane.is_spanned) return true;
    mpq_class terms = 0;
    for (std::size_t k = 0; k != 3; ++k) terms += abs(plane.normal[k]) * (abs(centre[k]) + largest_[k]);
    const mpq_class depth = plane.offset - dot(plane.normal, centre) - slack * terms;
    const mpq_class radius = mpq_class(sphere.radius) * (1 + slack);
    return sgn(depth) >= 0 && depth * depth >= radius * radius * dot(plane.normal, plane.normal);
  });
}

double ConvexHull::distance_to_surface(const Vec3& centre) const {
  constexpr unsigned bits = 128;
  const Vector point = vector(centre);
  double most = -HUGE_VAL;
  for (const Plane& plane : planes_) {
    if (!plane.is_spanned) continue;
    const mpq_class height = dot(plane.normal, point) - plane.offset;
    const mpq_class square = height * height / dot(plane.normal, plane.normal);
    most = std::max(most, sgn(height) * mpf_class(sqrt(mpf_class(square, bits))).get_d());
  }
  return std::isfinite(most) ? std::fabs(most) : 0;
}

bool ConvexHull::touches_box(const Sphere& sphere) const {
  const Vector centre = vector(sphere.centre);
  const mpq_class radius(sphere.radius);
  return std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    const auto zeros = std::count_if(plane.normal.begin(), plane.normal.end(), [](const auto& n) { return n == 0; });
    return zeros == 2 && dot(plane.normal, centre) - plane.offset ==
                             radius * (abs(plane.normal[0]) + abs(plane.normal[1]) + abs(plane.normal[2]));
  });
}

Answer ConvexHull::corrected(const Sphere& sphere, Answer answer, Contact contact) const {
  constexpr double rounding = 0x1p-24;
  if (answer == Answer::outside) return is_beyond(sphere, 0, contact) ? Answer::outside : Answer::overlap;
  if (is_beyond(sphere, rounding)) return Answer::outside;
  if (contact == Contact::open && touches_box(sphere)) return Answer::outside;
  if (answer == Answer::inside) return is_within(sphere) ? Answer::inside : Answer::overlap;
  return is_within(sphere, rounding) ? Answer::inside : Answer::overlap;
}

}  // namespace oracle
}  // namespace shaftcull
