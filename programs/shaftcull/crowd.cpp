// SPDX-License-Identifier: MIT
#include "crowd.hpp"

#include <cmath>
#include <numbers>

namespace shaftcull::cli {
namespace {

constexpr std::uint64_t life = 100;  ///< frames from when a body comes until it goes; it moves half way
constexpr float metres_a_body = 8;   ///< the side of the square that each has, on average
constexpr float tallest_place = 20;
constexpr double sight = 80;  ///< how far a watcher sees

/// A number in [0, 1) that `a`, `b` and `axis` determine: the same on every machine (the finaliser of splitmix64).
float number_of(std::uint64_t a, std::uint64_t b, std::uint64_t axis) {
  std::uint64_t x = (a * 3 + axis) * 0x9e3779b97f4a7c15U + b * 0xd1b54a32d192ed03U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return static_cast<float>((x ^ (x >> 31)) >> 40) * 0x1p-24F;
}

}  // namespace

Crowd::Crowd(std::size_t count) : count_(count), side_(metres_a_body * std::sqrt(static_cast<float>(count))) {
  std::vector<Box> boxes;
  boxes.reserve(count);
  for (std::size_t i = 0; i != count; ++i) boxes.push_back(body_at(i, 0));
  stream_ = BoxStream(boxes);
}

std::size_t Crowd::moving() const { return count_ / (life / 2); }

Box Crowd::body_at(std::size_t i, std::uint64_t frame) const {
  const std::uint64_t generation = (frame + i) / life;
  const bool has_moved = (frame + i) % life >= life / 2;
  Vec3 centre{side_ * number_of(i, generation, 0), side_ * number_of(i, generation, 1),
              tallest_place * number_of(i, generation, 2)};
  if (has_moved) {
    for (std::size_t axis = 0; axis != 3; ++axis) centre[axis] += 4 * number_of(i, ~generation, axis) - 2;
  }
  return box_around(centre, {0.5F, 0.5F, 0.9F});
}

void Crowd::use_tree() {
  ids_.resize(count_);
  std::vector<Box> boxes;
  boxes.reserve(count_);
  for (std::size_t i = 0; i != count_; ++i) boxes.push_back(stream_.view()[i]);
  tree_.insert(boxes, ids_);
  tree_.commit();
  stream_ = BoxStream();
}

void Crowd::move_to(double time) {
  const auto frame = static_cast<std::uint64_t>(std::llround(time * frames_per_second));
  if (frame == frame_ + 1) {
    frame_ = frame;
    take_step();
  } else if (frame != frame_) {
    frame_ = frame;
    move_all(frame);
  }
}

void Crowd::move_all(std::uint64_t frame) {
  boxes_.clear();
  for (std::size_t i = 0; i != count_; ++i) boxes_.push_back(body_at(i, frame));
  if (ids_.empty()) {
    stream_.update(0, boxes_);
  } else {
    tree_.move(ids_, boxes_);
    tree_.commit();
  }
}

void Crowd::take_step() {
  // Those that have come to the end of their life, and those that have come to the middle of it.
  const auto change = [&](std::uint64_t age, const auto& change_them) {
    bodies_.clear();
    boxes_.clear();
    for (std::uint64_t i = (age + life - frame_ % life) % life; i < count_; i += life) {
      bodies_.push_back(static_cast<std::uint32_t>(i));
      boxes_.push_back(body_at(i, frame_));
    }
    if (ids_.empty()) {
      for (std::size_t k = 0; k != bodies_.size(); ++k) stream_.update(bodies_[k], std::span(&boxes_[k], 1));
      return;
    }
    changed_ids_.clear();
    for (const std::uint32_t body : bodies_) changed_ids_.push_back(ids_[body]);
    change_them();
  };
  change(0, [&] {
    tree_.erase(changed_ids_);
    tree_.insert(boxes_, changed_ids_);
    for (std::size_t k = 0; k != bodies_.size(); ++k) ids_[bodies_[k]] = changed_ids_[k];
  });
  change(life / 2, [&] { tree_.move(changed_ids_, boxes_); });
  if (!ids_.empty()) tree_.commit();
}

void Crowd::swap_trees() noexcept {
  if (snapshot_.bound_count() != 0) snapshot_ = tree_.snapshot();
}

void Crowd::place_shafts(double time, std::span<Box> a, std::span<Box> b) const {
  for (std::size_t i = 0; i != a.size(); ++i) {
    const Vec3 watcher{side_ * number_of(i, 1, 0), side_ * number_of(i, 1, 1), 25};
    const double angle = 0.5 * time + 2 * std::numbers::pi * static_cast<double>(number_of(i, 2, 0));
    const Vec3 seen{watcher[0] + static_cast<float>(sight * std::cos(angle)),
                    watcher[1] + static_cast<float>(sight * std::sin(angle)), 1};
    a[i] = box_around(watcher, {1, 1, 1});
    b[i] = box_around(seen, {5, 5, 1});
  }
}

Bounds Crowd::asked() const {
  if (snapshot_.bound_count() != 0) return snapshot_;
  return ids_.empty() ? Bounds(stream_) : Bounds(tree_);
}

}  // namespace shaftcull::cli
