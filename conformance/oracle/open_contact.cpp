// SPDX-License-Identifier: MIT
#include "oracle/open_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shaftcull::oracle {
namespace {

/// Of vectors only the direction matters, so they are whole numbers.
using Vector = std::array<mpz_class, 3>;

int sign_of_product(const Vector& a, const Vector& b) {
  return sgn(mpz_class(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]));
}

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool is_zero(const Vector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/// A whole multiple of v.
Vector whole(const std::array<mpq_class, 3>& v) {
  const mpz_class scale = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
  Vector out;
  for (std::size_t k = 0; k != 3; ++k) out[k] = v[k].get_num() * (scale / v[k].get_den());
  return out;
}

/// Whether n or −n has no vector on its other side, and one on its own.
bool separates(const Vector& n, const std::vector<Vector>& vectors) {
  int side = 0;
  for (const Vector& v : vectors) {
    const int sign = sign_of_product(n, v);
    if (sign * side < 0) return false;
    if (sign != 0) side = sign;
  }
  return side != 0;
}

/// Whether any normal does.
bool can_be_separated(const std::vector<Vector>& vectors) {
  // What they span: by the first vector, the first across it, and the first across both.
  Vector normal{};
  std::size_t dimension = vectors.empty() ? 0 : 1;
  for (const Vector& v : vectors) {
    if (dimension == 1 && !is_zero(cross(vectors[0], v))) {
      normal = cross(vectors[0], v);
      dimension = 2;
    }
    if (dimension == 2 && sign_of_product(normal, v) != 0) dimension = 3;
  }
  if (dimension == 0) return false;
  if (dimension == 1) return separates(vectors[0], vectors);
  for (std::size_t i = 0; i != vectors.size(); ++i) {
    if (dimension == 2) {
      if (separates(cross(normal, vectors[i]), vectors)) return true;
      continue;
    }
    for (std::size_t j = i + 1; j != vectors.size(); ++j) {
      if (separates(cross(vectors[i], vectors[j]), vectors)) return true;
    }
  }
  return false;
}

/// Adds the corners of a box as vectors, those that are not zero, each once.
void add_corners(const std::array<std::array<mpq_class, 3>, 2>& box, std::vector<Vector>& vectors) {
  for (unsigned corner = 0; corner != 8; ++corner) {
    std::array<mpq_class, 3> point;
    for (std::size_t k = 0; k != 3; ++k) point[k] = box[corner >> k & 1U][k];
    const Vector v = whole(point);
    if (!is_zero(v) && std::find(vectors.begin(), vectors.end(), v) == vectors.end()) vectors.push_back(v);
  }
}

std::array<std::array<mpq_class, 3>, 2> corners(const Box& box) {
  return {{{mpq_class(box.lo[0]), mpq_class(box.lo[1]), mpq_class(box.lo[2])},
           {mpq_class(box.hi[0]), mpq_class(box.hi[1]), mpq_class(box.hi[2])}}};
}

/// The least normal · p − offset of the box's points p; false if there is none.
bool least_height(const RationalPlane& plane, const Box& box, mpq_class& height) {
  height = -plane.offset;
  for (std::size_t k = 0; k != 3; ++k) {
    const int slope = sgn(plane.normal[k]);
    if (slope == 0) continue;
    const float near = slope > 0 ? box.lo[k] : box.hi[k];
    if (std::isinf(near)) return false;
    height += plane.normal[k] * mpq_class(near);
  }
  return true;
}

}  // namespace

OpenHull::OpenHull(const ShaftInput& input) : between_(std::in_place, input.a, input.b, input.added) {
  boxes_ = {corners(input.a), corners(input.b)};
  add_planes(input.added);
}

OpenHull::OpenHull(const MovingInput& input) : moving_(std::in_place, input) {
  const Corners start = corners(input.box);
  Corners way;
  if (input.is_shadow()) {  // the points l + s (o − l), s from 1 to the reach: o + (s − 1) (o − l)
    const Corners light = corners(input.light);
    for (std::size_t k = 0; k != 3; ++k) {
      way[0][k] = start[0][k] - light[1][k];
      way[1][k] = start[1][k] - light[0][k];
    }
  } else {
    for (std::size_t k = 0; k != 3; ++k) way[0][k] = way[1][k] = mpq_class(input.displacement[k]);
  }
  boxes_ = {start};
  if (input.is_endless()) {
    ways_ = {way};
  } else {
    const mpq_class times = input.is_shadow() ? mpq_class(input.reach) - 1 : mpq_class(1);
    Corners end = start;
    for (std::size_t side = 0; side != 2; ++side) {
      for (std::size_t k = 0; k != 3; ++k) end[side][k] += times * way[side][k];
    }
    boxes_.push_back(end);
  }
  add_planes(input.added);
}

OpenHull::OpenHull(const HullInput& input) : still_(std::in_place, input) {
  const auto corners_at = [](const Vec3& v) { return corners(Box{v, v}); };
  for (const Vec3& point : input.points) boxes_.push_back(corners_at(point));
  for (const Vec3& direction : input.directions) ways_.push_back(corners_at(direction));
}

void OpenHull::add_planes(const std::vector<Plane>& added) {
  for (const Plane& plane : added) {
    added_.push_back({{mpq_class(plane.normal[0]), mpq_class(plane.normal[1]), mpq_class(plane.normal[2])},
                      mpq_class(plane.offset)});
  }
}

bool OpenHull::is_separated(const Box& box) const {
  std::vector<Vector> vectors;
  Corners finite;
  for (std::size_t k = 0; k != 3; ++k) {
    Vector direction{};
    for (const int sign : {1, -1}) {  // of shaft − box
      direction[k] = sign;
      if (std::isinf(sign > 0 ? box.lo[k] : box.hi[k])) vectors.push_back(direction);
    }
    const float any = std::isfinite(box.lo[k]) ? box.lo[k] : std::isfinite(box.hi[k]) ? box.hi[k] : 0.0F;
    finite[0][k] = std::isfinite(box.lo[k]) ? box.lo[k] : any;
    finite[1][k] = std::isfinite(box.hi[k]) ? box.hi[k] : any;
  }
  for (const Corners& of_shaft : boxes_) {
    Corners difference;
    for (std::size_t k = 0; k != 3; ++k) {
      difference[0][k] = of_shaft[0][k] - finite[1][k];
      difference[1][k] = of_shaft[1][k] - finite[0][k];
    }
    add_corners(difference, vectors);
  }
  for (const Corners& way : ways_) add_corners(way, vectors);
  return can_be_separated(vectors);
}

bool OpenHull::is_separated(const Triangle& triangle) const {
  std::vector<Vector> vectors;
  for (const Corners& of_shaft : boxes_) {
    for (const Vec3& vertex : triangle.vertex) {
      Corners difference = of_shaft;
      for (Point& corner : difference) {
        for (std::size_t k = 0; k != 3; ++k) corner[k] -= mpq_class(vertex[k]);
      }
      add_corners(difference, vectors);
    }
  }
  for (const Corners& way : ways_) add_corners(way, vectors);
  return can_be_separated(vectors);
}

Answer OpenHull::answer(const Box& box) const {
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) return Answer::outside;
  }
  if (is_separated(box)) return Answer::outside;
  for (const RationalPlane& plane : added_) {
    mpq_class height;
    if (least_height(plane, box, height) && height >= 0) return Answer::outside;
  }
  const Answer closed = between_ ? between_->answer(box) : moving_ ? moving_->answer(box) : still_->answer(box);
  return closed == Answer::inside ? Answer::inside : Answer::overlap;
}

Answer OpenHull::answer(const Sphere& sphere) const {
  if (std::isinf(sphere.radius)) return Answer::overlap;
  if (sphere.radius < 0) return Answer::outside;
  const mpq_class square = mpq_class(sphere.radius) * mpq_class(sphere.radius);
  if (sphere.radius == 0) {
    if (is_separated(Box{sphere.centre, sphere.centre})) return Answer::outside;
  } else if ((between_ ? between_->squared_distance(sphere.centre) : moving_->squared_distance(sphere.centre)) >=
             square) {
    return Answer::outside;
  }
  for (const RationalPlane& plane : added_) {
    mpq_class height = -plane.offset;
    mpq_class length = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      height += plane.normal[k] * mpq_class(sphere.centre[k]);
      length += plane.normal[k] * plane.normal[k];
    }
    if (height >= 0 && height * height >= square * length) return Answer::outside;
  }
  const Answer closed = between_ ? between_->answer(sphere) : moving_->answer(sphere);
  return closed == Answer::inside ? Answer::inside : Answer::overlap;
}

Answer OpenConvexHull::corrected(const Sphere& sphere, Answer answer) const {
  if (sphere.radius == 0) return open_.answer(Box{sphere.centre, sphere.centre});
  return closed_.corrected(sphere, answer, Contact::open);
}

}  // namespace shaftcull::oracle
