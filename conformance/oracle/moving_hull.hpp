// SPDX-License-Identifier: MIT
/// The answers of shafts of moving boxes in exact rational arithmetic, from what the kinds mean to their users: a body
/// that moves, a segment that leaves a light. Slow, and shares no code with the library.
#pragma once

#include <gmpxx.h>

#include <array>
#include <string>
#include <vector>

#include "oracle/hull.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull {

/// A shaft of a moving box, as what its call is given.
struct MovingInput {
  enum class Kind : unsigned char { swept, swept_infinite, shadow, shadow_without_end };
  Kind kind;
  Box box;              ///< the body, or the occluder
  Vec3 displacement{};  ///< of a body
  Box light{};          ///< of an occluder
  float reach = 1;
  std::vector<Plane> added{};
  Contact contact = Contact::closed;

  [[nodiscard]] bool is_shadow() const { return kind == Kind::shadow || kind == Kind::shadow_without_end; }
  [[nodiscard]] bool is_endless() const { return kind == Kind::swept_infinite || kind == Kind::shadow_without_end; }
};

/// C++ source text that makes the same values again, to the bit.
std::string source_text(const MovingInput& input);

namespace oracle {

class MovingHull {
 public:
  explicit MovingHull(const MovingInput& input);

  /// Bounds are finite.
  [[nodiscard]] Answer answer(const Box& box) const;
  [[nodiscard]] Answer answer(const Sphere& sphere) const;

  /// Squared distance of a point from the volume, added planes left out.
  [[nodiscard]] Rational squared_distance(const Vec3& point) const;
  /// Squared distance of a point inside from the nearest of the volume's facets; −1 if it is not inside.
  /// Not to be asked by several threads at once, nor are spheres: facets are kept.
  [[nodiscard]] Rational squared_depth(const Vec3& point) const;

 private:
  using Point = std::array<Rational, 3>;
  /// A corner of the volume, or a direction in which it goes on without end.
  struct Vertex {
    Point at;
    bool is_direction;
  };

  [[nodiscard]] bool meets(const Box& box) const;
  /// Where the box is when it has moved t times its way: lo and hi. Shadows begin at t = 1.
  [[nodiscard]] std::array<Point, 2> position(const Rational& t) const;
  void find_facets() const;

  MovingInput input_;
  /// Of a volume that is not flat, all; of a flat one, its plane from both sides. Found when first asked for.
  mutable std::vector<RationalPlane> facets_;
  mutable bool has_facets_ = false;
  std::vector<RationalPlane> added_;
};

}  // namespace oracle
}  // namespace shaftcull
