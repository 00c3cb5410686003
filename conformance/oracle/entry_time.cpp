// SPDX-License-Identifier: MIT
#include "oracle/entry_time.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace shaftcull::oracle {
namespace {

/// The times at which what was asked so far holds: from `from` to `to`, or on without end.
struct Times {
  mpq_class from = 0;
  std::optional<mpq_class> to;

  [[nodiscard]] bool are_none() const { return to && from > *to; }
};

/// Cuts times down to the t with start + t speed ≤ limit.
void keep_at_most(const mpq_class& start, const mpq_class& speed, const mpq_class& limit, Times& times) {
  if (speed == 0) {
    if (start > limit) times.to = times.from - 1;  // never
    return;
  }
  const mpq_class then = (limit - start) / speed;
  if (speed > 0) {
    if (!times.to || then < *times.to) times.to = then;
  } else {
    if (then > times.from) times.from = then;
  }
}

/// Where a face of a moving box is on an axis at time 0, and how far it goes in a unit of time.
struct Face {
  mpq_class start;
  mpq_class speed;
};

/// The first of some times at which a moving box and `box` have a common point; lo(k) and hi(k) are its faces.
template <class FaceOf>
std::optional<mpq_class> first_time(Times times, const FaceOf& lo, const FaceOf& hi, const Box& box) {
  for (std::size_t k = 0; k != 3; ++k) {
    // Two intervals meet where neither begins after the other has ended.
    if (std::isinf(box.hi[k])) {
      if (box.hi[k] < 0) return std::nullopt;
    } else {
      const Face face = lo(k);
      keep_at_most(face.start, face.speed, mpq_class(box.hi[k]), times);
    }
    if (std::isinf(box.lo[k])) {
      if (box.lo[k] > 0) return std::nullopt;
    } else {
      const Face face = hi(k);
      keep_at_most(-face.start, -face.speed, -mpq_class(box.lo[k]), times);
    }
    if (times.are_none()) return std::nullopt;
  }
  return times.from;
}

using FaceOf = std::function<Face(std::size_t)>;

/// How much farther than its radius the centre of a sphere is from the moving box at t, squared: the squared distance
/// less r².
mpq_class excess_at(const mpq_class& t, const FaceOf& lo, const FaceOf& hi, const Sphere& sphere) {
  const mpq_class radius = sphere.radius;
  mpq_class excess = -radius * radius;
  for (std::size_t k = 0; k != 3; ++k) {
    const mpq_class c = sphere.centre[k];
    const Face low = lo(k);
    const Face high = hi(k);
    const mpq_class from = low.start + t * low.speed;
    const mpq_class to = high.start + t * high.speed;
    const mpq_class distance = c < from ? mpq_class(from - c) : c > to ? mpq_class(c - to) : mpq_class(0);
    excess += distance * distance;
  }
  return excess;
}

/// The smaller root of the parabola with these values at t = from, from + step and from + 2 step, of which the first is
/// positive; none if it has no roots. A sum of squares is open upwards, or constant.
std::optional<RootTime> smaller_root(const mpq_class& from, const mpq_class& step,
                                     const std::array<mpq_class, 3>& value) {
  // value[0] + u (first + (u − 1) second / 2) with u = (t − from) / step.
  const mpq_class first = value[1] - value[0];
  const mpq_class second = value[2] - 2 * value[1] + value[0];
  if (second == 0) return std::nullopt;
  const mpq_class middle = mpq_class(1, 2) - first / second;
  const mpq_class square = middle * middle - 2 * value[0] / second;
  if (square < 0) return std::nullopt;
  return RootTime{from + step * middle, step * step * square};
}

/// As first_time(), of a sphere.
std::optional<RootTime> first_time_of_sphere(const Times& times, const FaceOf& lo, const FaceOf& hi,
                                             const Sphere& sphere) {
  if (sphere.radius < 0) return std::nullopt;
  if (std::isinf(sphere.radius)) return RootTime{times.from};
  // Between the times at which a face passes the centre the excess is a parabola.
  std::vector<mpq_class> breaks{times.from};
  for (std::size_t k = 0; k != 3; ++k) {
    for (const Face& face : {lo(k), hi(k)}) {
      if (face.speed == 0) continue;
      const mpq_class then = (mpq_class(sphere.centre[k]) - face.start) / face.speed;
      if (then > times.from && (!times.to || then < *times.to)) breaks.push_back(then);
    }
  }
  if (times.to) breaks.push_back(*times.to);
  std::sort(breaks.begin(), breaks.end());
  for (std::size_t i = 0; i != breaks.size(); ++i) {
    const mpq_class excess = excess_at(breaks[i], lo, hi, sphere);
    if (excess <= 0) return RootTime{breaks[i]};
    const bool is_last = i + 1 == breaks.size();
    if (is_last && times.to) break;
    const mpq_class step = is_last ? mpq_class(1) : mpq_class((breaks[i + 1] - breaks[i]) / 2);
    if (step == 0) continue;
    std::optional<RootTime> root = smaller_root(
        breaks[i], step,
        {excess, excess_at(breaks[i] + step, lo, hi, sphere), excess_at(breaks[i] + 2 * step, lo, hi, sphere)});
    if (root && *root > RootTime{breaks[i]} && (is_last || *root <= RootTime{breaks[i + 1]})) return root;
  }
  return std::nullopt;
}

/// The faces of a box that goes from a at 0 to b at 1.
struct FacesBetween {
  FaceOf lo;
  FaceOf hi;

  FacesBetween(const Box& a, const Box& b)
      : lo([=](std::size_t k) {
          return Face{a.lo[k], mpq_class(b.lo[k]) - mpq_class(a.lo[k])};
        }),
        hi([=](std::size_t k) {
          return Face{a.hi[k], mpq_class(b.hi[k]) - mpq_class(a.hi[k])};
        }) {}
};

/// Those of a body that is swept and of a shadow, and how long they move.
struct FacesOfMovingBox {
  FaceOf lo;
  FaceOf hi;
  Times times;

  // A box of a shadow is as wide as what lies between the light's far sides: its lo comes from the light's hi.
  explicit FacesOfMovingBox(const MovingInput& input)
      : lo([=](std::size_t k) {
          const mpq_class start = input.box.lo[k];
          return Face{start,
                      input.is_shadow() ? mpq_class(start - mpq_class(input.light.hi[k])) : input.displacement[k]};
        }),
        hi([=](std::size_t k) {
          const mpq_class start = input.box.hi[k];
          return Face{start,
                      input.is_shadow() ? mpq_class(start - mpq_class(input.light.lo[k])) : input.displacement[k]};
        }) {
    if (!input.is_endless()) times.to = input.is_shadow() ? mpq_class(mpq_class(input.reach) - 1) : mpq_class(1);
  }
  [[nodiscard]] bool moves() const { return !times.to || *times.to > 0; }
};

/// The normal of the contact of a moving box with `box` at a time: on each axis the intervals of both are compared at
/// that time, and where they were before it.
Vec3 normal_at(const mpq_class& time, const FaceOf& lo, const FaceOf& hi, const Box& box) {
  Vec3 normal{};
  for (std::size_t k = 0; k != 3; ++k) {
    // Beyond the bound's hi, or before its lo, up to this time.
    const auto arrives = [&](const Face& face, float at, int side) {
      if (std::isinf(at)) return false;
      const bool is_there = face.start + time * face.speed == mpq_class(at);
      return is_there && side * sgn(face.speed) < 0;
    };
    normal[k] = arrives(lo(k), box.hi[k], 1) ? 1.0F : arrives(hi(k), box.lo[k], -1) ? -1.0F : 0.0F;
    if (normal[k] != 0) break;
  }
  return normal;
}

/// −1, 0 or 1: the sign of x + y √square.
int sign_of_sum(const mpq_class& x, const mpq_class& y, const mpq_class& square) {
  const int of_x = sgn(x);
  const int of_root = square == 0 ? 0 : sgn(y);
  if (of_x == 0 || of_x == of_root) return of_root;
  if (of_root == 0) return of_x;
  return of_x * cmp(mpq_class(x * x), mpq_class(y * y * square));
}

/// x + y √square, which is from 0 to 1, rounded to nearest, to even.
float nearest_float(const mpq_class& x, const mpq_class& y, const mpq_class& square) {
  std::uint32_t low = 0;
  std::uint32_t high = std::bit_cast<std::uint32_t>(1.0F);
  while (low != high) {
    const std::uint32_t below = low + (high - low) / 2;
    const mpq_class middle = (mpq_class(std::bit_cast<float>(below)) + mpq_class(std::bit_cast<float>(below + 1))) / 2;
    const int side = sign_of_sum(x - middle, y, square);
    if (side > 0 || (side == 0 && below % 2 == 1)) {
      low = below + 1;
    } else {
      high = below;
    }
  }
  return std::bit_cast<float>(low);
}

/// As normal_at(), of a sphere.
Vec3 normal_of_sphere_at(const RootTime& time, const FaceOf& lo, const FaceOf& hi, const Sphere& sphere) {
  if (std::isinf(sphere.radius)) return {};
  if (sphere.radius == 0) return normal_at(time.whole, lo, hi, {sphere.centre, sphere.centre});
  if (time == RootTime{}) {
    // A half of how fast the squared distance grows.
    mpq_class growth = 0;
    for (std::size_t k = 0; k != 3; ++k) {
      const mpq_class c = sphere.centre[k];
      if (lo(k).start > c) growth += (lo(k).start - c) * lo(k).speed;
      if (hi(k).start < c) growth += (hi(k).start - c) * hi(k).speed;
    }
    if (excess_at(0, lo, hi, sphere) < 0 || growth >= 0) return {};
  }
  Vec3 normal{};
  for (std::size_t k = 0; k != 3; ++k) {
    // How far a face is from the centre then, as a share of the radius: x + y √square.
    const auto share = [&](const Face& face, int side) {
      const mpq_class x =
          side * (face.start + time.whole * face.speed - mpq_class(sphere.centre[k])) / mpq_class(sphere.radius);
      const mpq_class y = -side * face.speed / mpq_class(sphere.radius);
      return sign_of_sum(x, y, time.square) > 0 ? nearest_float(x, y, time.square) : 0.0F;
    };
    if (const float of_lo = share(lo(k), 1); of_lo != 0) normal[k] = of_lo;
    if (const float of_hi = share(hi(k), -1); of_hi != 0) normal[k] = -of_hi;
  }
  return normal;
}

/// The largest float whose value, as `Time`, is not larger than a time.
template <class Time>
float largest_float_not_above(const Time& time) {
  // Floats that are not negative are in the order of their bits.
  std::uint32_t low = 0;
  std::uint32_t high = std::bit_cast<std::uint32_t>(std::numeric_limits<float>::infinity());
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    (Time{mpq_class(std::bit_cast<float>(middle))} <= time ? low : high) = middle;
  }
  return std::bit_cast<float>(low);
}

}  // namespace

std::strong_ordering operator<=>(const RootTime& a, const RootTime& b) {
  // a − b = d + s with d = a.whole − b.whole and s = √b.square − √a.square.
  const mpq_class d = a.whole - b.whole;
  const int sign_of_d = sgn(d);
  const int sign_of_s = cmp(b.square, a.square) > 0 ? 1 : cmp(b.square, a.square) < 0 ? -1 : 0;
  const auto ordering = [](int sign) { return sign <=> 0; };
  if (sign_of_d == 0) return ordering(sign_of_s);
  if (sign_of_s == 0 || sign_of_s == sign_of_d) return ordering(sign_of_d);
  // Whichever is larger has its sign: d² − s² = e + 2 √(a.square b.square).
  const mpq_class e = d * d - a.square - b.square;
  const mpq_class product = 4 * a.square * b.square;
  const int larger = e >= 0 ? (e > 0 || product > 0 ? 1 : 0) : sgn(mpq_class(product - e * e));
  return ordering(larger > 0 ? sign_of_d : larger < 0 ? sign_of_s : 0);
}

std::optional<mpq_class> entry_time(const Box& a, const Box& b, const Box& box) {
  const FacesBetween faces(a, b);
  return first_time<FaceOf>({0, 1}, faces.lo, faces.hi, box);
}

std::optional<RootTime> entry_time(const Box& a, const Box& b, const Sphere& sphere) {
  const FacesBetween faces(a, b);
  return first_time_of_sphere({0, 1}, faces.lo, faces.hi, sphere);
}

std::optional<mpq_class> entry_time(const MovingInput& input, const Box& box) {
  const FacesOfMovingBox faces(input);
  return first_time<FaceOf>(faces.times, faces.lo, faces.hi, box);
}

std::optional<RootTime> entry_time(const MovingInput& input, const Sphere& sphere) {
  const FacesOfMovingBox faces(input);
  return first_time_of_sphere(faces.times, faces.lo, faces.hi, sphere);
}

Vec3 contact_normal(const Box& a, const Box& b, const Box& box) {
  const FacesBetween faces(a, b);
  return normal_at(entry_time(a, b, box).value(), faces.lo, faces.hi, box);
}

Vec3 contact_normal(const MovingInput& input, const Box& box) {
  const FacesOfMovingBox faces(input);
  return faces.moves() ? normal_at(entry_time(input, box).value(), faces.lo, faces.hi, box) : Vec3{};
}

Vec3 contact_normal(const Box& a, const Box& b, const Sphere& sphere) {
  const FacesBetween faces(a, b);
  return normal_of_sphere_at(entry_time(a, b, sphere).value(), faces.lo, faces.hi, sphere);
}

Vec3 contact_normal(const MovingInput& input, const Sphere& sphere) {
  const FacesOfMovingBox faces(input);
  return faces.moves() ? normal_of_sphere_at(entry_time(input, sphere).value(), faces.lo, faces.hi, sphere) : Vec3{};
}

float rounded_down(const mpq_class& time) { return largest_float_not_above(time); }

float rounded_down(const RootTime& time) { return largest_float_not_above(time); }

}  // namespace shaftcull::oracle
