/// Bounds that touch a shaft, or miss touching it by an ulp or two: where rounding would decide.
#pragma once

#include "cull/agreement.hpp"
#include "dice.hpp"
#include "oracle.hpp"

namespace shaftcull {

/// A box with a corner, edge or face on the path of a corner of the moving box, which is where the shaft's edges
/// are; it extends outwards, or inwards, or lies across.
inline Box touching_box(Dice& dice, const Subject& subject) {
  const float t = dice.one_in(4) ? dice.integer(0, 1) : dice.uniform(0.0F, 1.0F);
  const bool inwards = dice.one_in(3);
  Box box{};
  for (std::size_t k = 0; k != 3; ++k) {
    const bool hi = dice.one_in(2);
    const double from = static_cast<double>(hi ? subject.a.hi[k] : subject.a.lo[k]);
    const double to = static_cast<double>(hi ? subject.b.hi[k] : subject.b.lo[k]);
    const float point = dice.nudge(static_cast<float>(from + static_cast<double>(t) * (to - from)));
    const double extent = dice.one_in(4) ? 0.0 : static_cast<double>(dice.uniform(0.0F, 0.3F)) * std::max(std::abs(from), 1e-3);
    const auto beyond = [&](double distance) {
      return static_cast<float>(std::clamp(static_cast<double>(point) + distance, -3e38, 3e38));
    };
    const bool across = dice.one_in(5);
    const bool upwards = hi != inwards;
    box.lo[k] = across || !upwards ? std::min(point, beyond(-extent)) : point;
    box.hi[k] = across || upwards ? std::max(point, beyond(extent)) : point;
  }
  return box;
}

/// A sphere around `centre` whose radius is, to an ulp or two, its distance from the shaft, or its depth in it.
inline Sphere touching_sphere(Dice& dice, const oracle::Hull& hull, const Vec3& centre) {
  const double squared = hull.squared_distance(centre).get_d();
  const double radius = squared > 0 ? std::sqrt(squared) : std::max(hull.depth(centre), 0.0);
  return {centre, std::max(0.0F, dice.nudge(static_cast<float>(radius)))};
}

}  // namespace shaftcull
