// SPDX-License-Identifier: MIT
/// A city: blocks of buildings on a square grid of streets, and cars that drive along them.
#pragma once

#include <vector>

#include "moving_scene.hpp"

namespace shaftcull::cli {

/// A quarter of the bounds are cars; buildings stay where they are. Lengths are metres. Shafts are, in turn, the space
/// that a helicopter sweeps in the next five seconds, and the view from it to a car.
class City : public MovingScene {
 public:
  static constexpr std::size_t full_size = 1'000'000;

  explicit City(std::size_t count);

  [[nodiscard]] std::string_view name() const override { return "city"; }
  [[nodiscard]] std::size_t bounds() const override { return buildings_ + cars_.size(); }
  [[nodiscard]] std::size_t moving() const override { return cars_.size(); }
  void use_tree() override;
  void use_second_tree() override { trees_.use_second(); }
  void move_to(double time) override;
  void swap_trees() noexcept override { trees_.swap(); }
  void place_shafts(double time, std::span<Box> a, std::span<Box> b) const override;
  [[nodiscard]] Bounds asked() const override { return trees_.in_use() ? Bounds(trees_.asked()) : Bounds(stream_); }

 private:
  /// Drives up and down no lane but its own, and comes in again at the other end of the city.
  struct Car {
    float across;  ///< where its lane is, across the street
    float start;   ///< where it is along the street at time 0
    float speed;   ///< metres a second, negative in the opposite lane
    bool along_x;
  };

  [[nodiscard]] Box car_at(const Car& car, double time) const;

  std::size_t buildings_;
  std::size_t blocks_;  ///< along each side of the city
  std::vector<Car> cars_;
  BoxStream stream_;                   ///< buildings, then cars; or nothing, and
  TreeBuffers<BoxTree> trees_;         ///< the same
  std::vector<std::uint32_t> moving_;  ///< with trees: the cars' indices in them, and where they are now
  std::vector<Box> moved_;
};

}  // namespace shaftcull::cli
