// SPDX-License-Identifier: MIT
/// A scene of the demonstration: bounds that move, and shafts that move among them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "shaftcull/shaftcull.hpp"

namespace shaftcull::cli {

/// How often a scene moves in a second of its time.
inline constexpr double frames_per_second = 30;

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
  /// Then keeps a second tree too: move_to() updates the one that is not asked(), which may be asked at the same time.
  virtual void use_second_tree() = 0;
  /// Moves what moves and updates its bounds in place, in parallel.
  virtual void move_to(double time) = 0;
  /// With a second tree: asked() are the bounds of the last move from now on. Without one they always are.
  virtual void swap_trees() noexcept = 0;
  /// Where the two ends of every shaft are: a[i] and b[i] have a.size() boxes each.
  virtual void place_shafts(double time, std::span<Box> a, std::span<Box> b) const = 0;
  /// What shafts are asked about, until it moves or trees are swapped.
  [[nodiscard]] virtual Bounds asked() const = 0;
};

/// A tree that is updated and asked; or two, one asked while the other is updated.
template <class Tree>
class TreeBuffers {
 public:
  [[nodiscard]] bool in_use() const noexcept { return asked_.size() != 0; }
  [[nodiscard]] const Tree& asked() const noexcept { return asked_; }
  [[nodiscard]] Tree& updated() noexcept { return updated_.size() != 0 ? updated_ : asked_; }

  void use(Tree tree) { asked_ = std::move(tree); }
  void use_second() { updated_ = asked_; }
  void swap() noexcept {
    if (updated_.size() != 0) std::swap(asked_, updated_);
  }

 private:
  Tree asked_;
  Tree updated_;  ///< empty without a second one
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
