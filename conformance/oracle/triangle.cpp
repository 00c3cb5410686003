// SPDX-License-Identifier: MIT
#include "oracle/triangle.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "oracle/hull.hpp"
#include "oracle/open_contact.hpp"

namespace shaftcull {

std::string source_text(const Triangle& triangle) {
  const auto& [p, q, r] = triangle.vertex;
  return "Triangle{{{" + source_text(p) + ", " + source_text(q) + ", " + source_text(r) + "}}}";
}

namespace oracle {
namespace {

/// What is asked for: a time t, from where the shaft begins, and a point v0 + p (v1 − v0) + q (v2 − v0) of the
/// triangle.
enum Unknown : std::size_t { time_passed, toward_1, toward_2, unknowns };

/// factor · (t, p, q) + constant ≥ 0.
struct Condition {
  std::array<mpq_class, unknowns> factor;
  mpq_class constant;
};

/// Fourier and Motzkin: the conditions on the other unknowns that leave a value for this one.
std::vector<Condition> without(std::size_t unknown, const std::vector<Condition>& conditions) {
  std::vector<Condition> left;
  for (const Condition& below : conditions) {
    if (below.factor[unknown] == 0) left.push_back(below);
    if (below.factor[unknown] <= 0) continue;
    for (const Condition& above : conditions) {
      if (above.factor[unknown] >= 0) continue;
      const mpq_class scale = -below.factor[unknown] / above.factor[unknown];
      Condition both = below;
      for (std::size_t i = 0; i != unknowns; ++i) both.factor[i] += scale * above.factor[i];
      both.factor[unknown] = 0;
      both.constant += scale * above.constant;
      left.push_back(both);
    }
  }
  return left;
}

/// Whether some time satisfies conditions that hold no other unknown: the latest beginning is not after the first end.
bool leave_a_time(const std::vector<Condition>& conditions) {
  std::optional<mpq_class> begin;
  std::optional<mpq_class> end;
  for (const Condition& condition : conditions) {
    const mpq_class& factor = condition.factor[time_passed];
    if (factor == 0) {
      if (condition.constant < 0) return false;
      continue;
    }
    const mpq_class at = -condition.constant / factor;
    if (factor > 0 ? !begin || at > *begin : !end || at < *end) (factor > 0 ? begin : end) = at;
  }
  return !begin || !end || *begin <= *end;
}

/// A box whose faces are at start + t · slope, t from 0 to `end`, or without end if that is negative.
struct Motion {
  std::array<mpq_class, 6> start;
  std::array<mpq_class, 6> slope;
  mpq_class end = 1;
};

bool meets(const Motion& motion, const Triangle& triangle) {
  std::vector<Condition> conditions(4);
  conditions[0].factor[time_passed] = 1;
  conditions[1].factor[toward_1] = 1;
  conditions[2].factor[toward_2] = 1;
  conditions[3].factor[toward_1] = conditions[3].factor[toward_2] = -1;
  conditions[3].constant = 1;
  if (motion.end >= 0) {
    conditions.push_back({});
    conditions.back().factor[time_passed] = -1;
    conditions.back().constant = motion.end;
  }
  for (std::size_t face = 0; face != 6; ++face) {
    const std::size_t k = face % 3;
    const int sign = face < 3 ? 1 : -1;  // of the point, which is above a lo face and below a hi face
    const mpq_class v0(triangle.vertex[0][k]);
    Condition within;
    within.factor[time_passed] = -sign * motion.slope[face];
    within.factor[toward_1] = sign * (mpq_class(triangle.vertex[1][k]) - v0);
    within.factor[toward_2] = sign * (mpq_class(triangle.vertex[2][k]) - v0);
    within.constant = sign * (v0 - motion.start[face]);
    conditions.push_back(within);
  }
  for (std::size_t unknown = unknowns; --unknown != 0;) conditions = without(unknown, conditions);
  return leave_a_time(conditions);
}

mpq_class face_of(const Box& box, std::size_t face) { return mpq_class(face < 3 ? box.lo[face] : box.hi[face - 3]); }

}  // namespace

bool meets(const ShaftInput& input, const Triangle& triangle) {
  Motion motion;
  for (std::size_t face = 0; face != 6; ++face) {
    motion.start[face] = face_of(input.a, face);
    motion.slope[face] = face_of(input.b, face) - motion.start[face];
  }
  return meets(motion, triangle);
}

bool meets(const MovingInput& input, const Triangle& triangle) {
  Motion motion;
  for (std::size_t face = 0; face != 6; ++face) {
    motion.start[face] = face_of(input.box, face);
    // A segment from a light goes on as far as it has come, in each unit of time.
    motion.slope[face] = input.is_shadow() ? mpq_class(motion.start[face] - face_of(input.light, (face + 3) % 6))
                                           : mpq_class(input.displacement[face % 3]);
  }
  motion.end = input.is_endless() ? mpq_class(-1) : input.is_shadow() ? mpq_class(input.reach) - 1 : mpq_class(1);
  return meets(motion, triangle);
}

bool is_beyond_one(const std::vector<Plane>& planes, const Triangle& triangle, Contact contact) {
  return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    return std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](const Vec3& vertex) {
      mpq_class height = -mpq_class(plane.offset);
      for (std::size_t k = 0; k != 3; ++k) height += mpq_class(plane.normal[k]) * mpq_class(vertex[k]);
      return contact == Contact::open ? height >= 0 : height > 0;
    });
  });
}

Box box_around(const Triangle& triangle) {
  Box box{triangle.vertex[0], triangle.vertex[0]};
  for (const Vec3& vertex : triangle.vertex) {
    for (std::size_t k = 0; k != 3; ++k) {
      box.lo[k] = std::min(box.lo[k], vertex[k]);
      box.hi[k] = std::max(box.hi[k], vertex[k]);
    }
  }
  return box;
}

namespace {

template <class Input>
bool is_openly_outside(Input input, const Triangle& triangle, TriangleTest test) {
  input.added.clear();
  const OpenHull hull(input);
  return test == TriangleTest::exact ? hull.is_separated(triangle)
                                     : hull.answer(box_around(triangle)) == Answer::outside;
}

}  // namespace

bool is_outside(const ShaftInput& input, const Triangle& triangle, TriangleTest test) {
  if (is_beyond_one(input.added, triangle, input.contact)) return true;
  if (input.contact == Contact::open) return is_openly_outside(input, triangle, test);
  return test == TriangleTest::exact ? !meets(input, triangle)
                                     : Hull(input.a, input.b).answer(box_around(triangle)) == Answer::outside;
}

bool is_outside(const MovingInput& input, const Triangle& triangle, TriangleTest test) {
  if (is_beyond_one(input.added, triangle, input.contact)) return true;
  if (input.contact == Contact::open) return is_openly_outside(input, triangle, test);
  if (test == TriangleTest::exact) return !meets(input, triangle);
  MovingInput without_planes = input;
  without_planes.added.clear();
  return MovingHull(without_planes).answer(box_around(triangle)) == Answer::outside;
}

bool is_outside(const HullInput& input, const Triangle& triangle, TriangleTest test, Contact contact) {
  const auto misses = [&](const auto& hull) {
    return test == TriangleTest::exact ? hull.misses(triangle) : hull.answer(box_around(triangle)) == Answer::outside;
  };
  return contact == Contact::open ? misses(OpenConvexHull(input)) : misses(ConvexHull(input));
}

}  // namespace oracle
}  // namespace shaftcull
