// SPDX-License-Identifier: MIT
/// The oracle for long runs: proves most answers in interval arithmetic, a hundred times as fast as rationals, and says
/// so where it cannot. Shares no code with the library.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "oracle/interval.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull::oracle {

class QuickHull {
 public:
  explicit QuickHull(const ShaftInput& input);

  /// The answer if it has been proved; nothing for what touches or nearly touches. Bounds are finite with lo ≤ hi.
  ///
  /// Boxes: the definition with six constraints on t, as the rational oracle has it. Spheres: a point of the shaft
  /// within the radius proves that they meet, a plane between them farther than the radius from the centre that they do
  /// not.
  [[nodiscard]] std::optional<Answer> answer(const Box& box) const;
  [[nodiscard]] std::optional<Answer> answer(const Sphere& sphere) const;

  /// About the radius of the sphere around `point` that touches conv(a ∪ b), from outside or from inside.
  [[nodiscard]] double distance_to_surface(const Vec3& point) const;

 private:
  enum class Truth : unsigned char { no, unknown, yes };
  /// normal · (p − point) ≤ 0 is inside; the point is a corner of the plane's two axes on the first box.
  struct JoiningPlane {
    std::size_t red_axis;
    std::size_t blue_axis;
    Interval red_normal;
    Interval blue_normal;
    double red_point;
    double blue_point;
  };

  [[nodiscard]] Truth meets(const Box& box) const;
  [[nodiscard]] Truth holds(const Box& box) const;
  [[nodiscard]] Truth meets(const Sphere& sphere) const;
  [[nodiscard]] Truth holds(const Sphere& sphere) const;
  /// About the t at which box(t) is nearest to the point.
  [[nodiscard]] double nearest_t(const std::array<double, 3>& point) const;
  [[nodiscard]] static Interval height(const JoiningPlane& plane, const std::array<double, 3>& point);

  std::array<double, 6> a_;  ///< lo x, y, z, hi x, y, z
  std::array<double, 6> b_;
  std::vector<JoiningPlane> joining_;
  std::vector<Plane> added_;
};

}  // namespace shaftcull::oracle
