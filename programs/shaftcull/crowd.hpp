// SPDX-License-Identifier: MIT
/// A crowd: bodies that come, go and move, in a dynamic tree and snapshots of it.
#pragma once

#include <cstdint>
#include <vector>

#include "moving_scene.hpp"

namespace shaftcull::cli {

/// In each frame one body in a hundred goes while another comes, and one in a hundred moves. Lengths are metres. Shafts
/// are lines of sight between watchers that turn.
class Crowd : public MovingScene {
 public:
  static constexpr std::size_t full_size = 1'000'000;

  explicit Crowd(std::size_t count);

  [[nodiscard]] std::string_view name() const override { return "crowd"; }
  [[nodiscard]] std::size_t bounds() const override { return count_; }
  [[nodiscard]] std::size_t moving() const override;
  void use_tree() override;
  void use_second_tree() override { snapshot_ = tree_.snapshot(); }
  void move_to(double time) override;
  void swap_trees() noexcept override;
  void place_shafts(double time, std::span<Box> a, std::span<Box> b) const override;
  [[nodiscard]] Bounds asked() const override;

 private:
  [[nodiscard]] Box body_at(std::size_t i, std::uint64_t frame) const;
  void move_all(std::uint64_t frame);
  void take_step();

  std::size_t count_;
  float side_;  ///< of the square that they are in
  std::uint64_t frame_ = 0;
  BoxStream stream_;     ///< either this, or
  DynamicBoxTree tree_;  ///< this, with
  std::vector<BoundId> ids_;
  BoxTreeSnapshot snapshot_;  ///< what is asked while the tree goes on; empty without
  // What changes in a frame.
  std::vector<std::uint32_t> bodies_;
  std::vector<BoundId> changed_ids_;
  std::vector<Box> boxes_;
};

}  // namespace shaftcull::cli
