// SPDX-License-Identifier: MIT
#include "city.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "workers.hpp"

namespace shaftcull::cli {
namespace {

constexpr float block_pitch = 100;  ///< from one street to the next
constexpr float street_width = 20;
constexpr std::size_t lots_across = 4;
constexpr std::size_t lots_up = 3;
constexpr std::size_t lots = lots_across * lots_up;
constexpr std::size_t cars_per_chunk = 1024;
constexpr Vec3 car_size{4.5F, 1.9F, 1.5F};
constexpr float helicopter_half_extent = 6;
constexpr double seconds_ahead = 5;

/// Uniform in [lo, hi): the same numbers with every standard library.
float uniform(std::mt19937& random, float lo, float hi) {
  return lo + (hi - lo) * static_cast<float>(random() >> 8) * 0x1p-24F;
}

/// A building on lot `lot` of the block whose corner is at (x, y).
Box building(std::mt19937& random, float x, float y, std::size_t lot, float tallest) {
  constexpr float width = (block_pitch - street_width) / lots_across;
  constexpr float depth = (block_pitch - street_width) / lots_up;
  const std::size_t column = lot % lots_across;
  const std::size_t row = lot / lots_across;
  const float left = x + street_width / 2 + width * static_cast<float>(column) + uniform(random, 0.5F, 3);
  const float front = y + street_width / 2 + depth * static_cast<float>(row) + uniform(random, 0.5F, 3);
  const float height = uniform(random, 6, tallest);
  return {{left, front, 0}, {left + width - uniform(random, 4, 7), front + depth - uniform(random, 4, 7), height}};
}

}  // namespace

City::City(std::size_t count) : buildings_(count - count / 4) {
  std::mt19937 random(1991);
  const std::size_t needed = (buildings_ + lots - 1) / lots;
  blocks_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(needed))));
  const float side = static_cast<float>(blocks_) * block_pitch;
  std::vector<Box> boxes;
  boxes.reserve(count);
  for (std::size_t i = 0; i < buildings_; ++i) {
    const std::size_t block = i / lots;
    const std::size_t column = block % blocks_;
    const std::size_t row = block / blocks_;
    const float x = static_cast<float>(column) * block_pitch;
    const float y = static_cast<float>(row) * block_pitch;
    // Towers in the middle, houses at the edge.
    const float from_middle = std::hypot(x - side / 2, y - side / 2) / side;
    boxes.push_back(building(random, x, y, i % lots, 15 + 200 * std::exp(-8 * from_middle)));
  }
  // Cars in the order of their streets, so that neighbours in memory are neighbours in the city.
  const std::size_t cars = count - buildings_;
  const std::size_t streets = 2 * blocks_;
  cars_.reserve(cars);
  for (std::size_t i = 0; i < cars; ++i) {
    const std::size_t street = i * streets / cars;
    const bool forward = i % 2 == 0;
    const std::size_t number = street / 2;  // one of each direction has it
    const float middle = static_cast<float>(number) * block_pitch;
    const float speed = uniform(random, 8, 20);
    cars_.push_back(
        {middle + (forward ? -3.0F : 3.0F), uniform(random, 0, side), forward ? speed : -speed, street % 2 == 0});
    boxes.push_back(car_at(cars_.back(), 0));
  }
  stream_ = BoxStream(boxes);
}

Box City::car_at(const Car& car, double time) const {
  const double side = static_cast<double>(blocks_) * static_cast<double>(block_pitch);
  const double travelled = static_cast<double>(car.start) + static_cast<double>(car.speed) * time;
  const auto along = static_cast<float>(travelled - side * std::floor(travelled / side));
  const float half_length = car_size[0] / 2;
  const float half_width = car_size[1] / 2;
  const float half_height = car_size[2] / 2;
  return car.along_x ? box_around({along, car.across, half_height}, {half_length, half_width, half_height})
                     : box_around({car.across, along, half_height}, {half_width, half_length, half_height});
}

void City::use_tree() {
  trees_.use(BoxTree(stream_.view()));
  stream_ = BoxStream();
  moving_.resize(cars_.size());
  std::iota(moving_.begin(), moving_.end(), static_cast<std::uint32_t>(buildings_));
  moved_.resize(cars_.size());
}

void City::move_to(double time) {
  if (trees_.in_use()) {
    Workers::for_chunks(cars_.size(), cars_per_chunk, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) moved_[i] = car_at(cars_[i], time);
    });
    trees_.updated().update(moving_, std::span<const Box>(moved_));
    trees_.updated().refit();
    return;
  }
  Workers::for_chunks(cars_.size(), cars_per_chunk, [&](std::size_t first, std::size_t count) {
    std::array<Box, cars_per_chunk> moved;
    for (std::size_t i = 0; i < count; ++i) moved[i] = car_at(cars_[first + i], time);
    stream_.update(buildings_ + first, std::span<const Box>(moved.data(), count));
  });
}

void City::place_shafts(double time, std::span<Box> a, std::span<Box> b) const {
  // Helicopters circle the middle, each at its own distance and height.
  const double middle = static_cast<double>(blocks_) * static_cast<double>(block_pitch) / 2;
  const auto helicopter_at = [&](std::size_t i, double when) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(a.size());
    const double distance = 0.9 * middle * share;
    constexpr double speed = 50;
    const double angle =
        speed / std::max(distance, 50.0) * when + 2 * std::numbers::pi * static_cast<double>(i) * 0.618;
    const Vec3 centre{static_cast<float>(middle + distance * std::cos(angle)),
                      static_cast<float>(middle + distance * std::sin(angle)), static_cast<float>(150 - 120 * share)};
    return box_around(centre, {helicopter_half_extent, helicopter_half_extent, helicopter_half_extent / 3});
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = helicopter_at(i, time);
    const bool follows_car = i % 2 == 1 && !cars_.empty();
    b[i] = follows_car ? car_at(cars_[i * 7919 % cars_.size()], time) : helicopter_at(i, time + seconds_ahead);
  }
}

}  // namespace shaftcull::cli
