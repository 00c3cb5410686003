/// A scene of the demonstration: bounds that move, and shafts that move among them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull::cli {

/// Times are in seconds since the scene began. Calls belong inside Workers::run().
class MovingScene {
 public:
  MovingScene() = default;
  MovingScene(const MovingScene&) = delete;
  MovingScene& operator=(const MovingScene&) = delete;
  virtual ~MovingScene() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;
  /// How many bounds there are, and how many of them move.
  [[nodiscard]] virtual std::size_t bounds() const = 0;
  [[nodiscard]] virtual std::size_t moving() const = 0;
  /// Keeps the bounds in a tree from now on, no longer in a stream.
  virtual void use_tree() = 0;
  /// Moves what moves and updates its bounds in place, in parallel.
  virtual void move_to(double time) = 0;
  /// Where the two ends of every shaft are: a[i] and b[i] have a.size() boxes each.
  virtual void place_shafts(double time, std::span<Box> a, std::span<Box> b) const = 0;
  /// Counts what each shaft keeps.
  virtual void count(std::span<const CompiledShaft> shafts, std::span<std::uint64_t> kept) const = 0;
};

/// The box around a centre.
[[nodiscard]] inline Box box_around(const Vec3& centre, const Vec3& half_extent) {
  Box box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lo[axis] = centre[axis] - half_extent[axis];
    box.hi[axis] = centre[axis] + half_extent[axis];
  }
  return box;
}

}  // namespace shaftcull::cli
