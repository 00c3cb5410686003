// SPDX-License-Identifier: MIT
/// The sphereflake: a sphere with nine spheres of a third of its radius on it, and so on.
///
/// E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987: the "balls" scene of the
/// Standard Procedural Databases. Six children stand around a sphere's equator and three above, where spheres in the
/// closest packing touch; a child's pole points away from its parent.
#pragma once

#include <vector>

#include "moving_scene.hpp"

namespace shaftcull::cli {

/// Turns about its pole and breathes, above a floor: shafts lead from light patches over it to tiles of the floor.
class Sphereflake : public MovingScene {
 public:
  /// Eight generations: (9⁸ − 1) / 8 spheres.
  static constexpr std::size_t full_size = 5'380'840;

  /// The first `count` spheres, by generation. The largest sphere has radius 1 and is at the origin; all lie within 2
  /// of it.
  explicit Sphereflake(std::size_t count);

  [[nodiscard]] std::string_view name() const override { return "sphereflake"; }
  [[nodiscard]] std::size_t bounds() const override { return at_rest_.size(); }
  [[nodiscard]] std::size_t moving() const override { return at_rest_.size(); }
  void use_tree() override;
  void use_second_tree() override { trees_.use_second(); }
  void move_to(double time) override;
  void swap_trees() noexcept override { trees_.swap(); }
  void place_shafts(double time, std::span<Box> a, std::span<Box> b) const override;
  [[nodiscard]] Bounds asked() const override { return trees_.in_use() ? Bounds(trees_.asked()) : Bounds(stream_); }

 private:
  std::vector<Sphere> at_rest_;    ///< in tree order if there are trees
  SphereStream stream_;            ///< either this, or
  TreeBuffers<SphereTree> trees_;  ///< these, with what they are updated from:
  std::vector<Sphere> moved_;
};

}  // namespace shaftcull::cli
